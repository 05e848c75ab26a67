"""Transfer functions by Cramer's rule: two determinants of polynomials in the parameters and s."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..contract.model import Model
from ..errors import UcritError, near_match

if TYPE_CHECKING:
    from .linear import LinearSystem


@dataclass(frozen=True)
class Rational:
    """``numerator / denominator``, both polynomials in s (the ring's last generator) and the parameters.

    ``cancelled`` holds the factors with s that were common to both; ``functions`` what some symbols stand
    for.
    """

    numerator: Any
    denominator: Any
    cancelled: tuple[Any, ...]
    functions: Mapping[Any, Any]

    def in_s(self, polynomial: Any) -> list[Any]:
        """Return the coefficients of a polynomial in s, ascending, over the ring of the parameters alone."""
        return coefficients_in_s(polynomial)


def output_names(model: type[Model]) -> tuple[str, ...]:
    """Names of possible outputs: variables, their derivatives below the highest, declared outputs."""
    declared = model.declaration
    states = [v.label(k) for v in declared.variables.values() for k in range(max(v.order, 1))]
    return (*states, *declared.outputs)


def cramer(system: LinearSystem, input: str, output: str) -> Rational:
    """Return the transfer function from an input to an output, in lowest terms.

    The determinant of P(s), bordered by the input's column and the output's row, is that of P(s) times the
    transfer function (F. R. Gantmacher, The Theory of Matrices (1959), volume 1, section II.5).

    Raises
    ------
    UcritError
        If there is no such input or output.
    """
    from sympy import ZZ, Dummy, S
    from sympy.polys.rings import PolyRing

    from ..formulas.minors import blocks, determinant, part
    from .rings import cleared_row, polynomial_field

    entries = _bordered(system, input, output)
    flat = [e for row in entries for chain in row for e in chain]
    domain, elements, functions = polynomial_field([*flat, S.One], system.bounds)
    symbols = domain.symbols if domain.is_Composite else ()
    ring = PolyRing((*symbols, Dummy("s")), ZZ, "lex")
    source, one, n = iter(elements), elements[-1], len(entries) - 1
    rows = []
    for row in entries:
        chains = [[next(source) for _ in chain] for chain in row]
        rows.append(cleared_row([*chains, [one]], domain, ring, ring.gens[-1]))
    scale, square = rows[-1][-1], [row[:-1] for row in rows]
    apart = blocks(square, ring)
    inner = next(block for block in apart if n in block)
    above = determinant(part(square, inner), ring)
    below = scale * determinant(part(square, [i for i in inner if i != n]), ring)
    beside = [determinant(part(square, block), ring) for block in apart if block is not inner]
    return _lowest_terms(above, below, beside, functions)


def check_names(model: type[Model], input: str, output: str) -> None:
    """Raise `UcritError` where a model has no such input or output."""
    known = {"input": (input, tuple(model.declaration.inputs)), "output": (output, output_names(model))}
    for what, (name, names) in known.items():
        if name not in names:
            raise UcritError(f"{model.model_id()}: there is no {what} '{name}'{near_match(name, names)}")


def _bordered(system: LinearSystem, input: str, output: str) -> list[list[list[Any]]]:
    """Return rows of chains: entry [i][j][k] belongs to ``s**k``."""
    model, top = system.traced.model, len(system.P)
    check_names(model, input, output)
    n, column = system.P[0].rows, list(model.declaration.inputs).index(input)
    rows = [[[system.P[k][i, j] for k in range(top)] for j in range(n)] + [[-system.Q[i, column]]] for i in range(n)]
    declared = list(model.declaration.outputs)
    if output in declared:
        i = declared.index(output)
        last = [[M[i, j] for M in system.C] for j in range(n)] + [[system.D[i, column]]]
    else:
        at = list(model.declaration.variables).index(output.rstrip("'"))
        order = len(output) - len(output.rstrip("'"))
        last = [[int(j == at and k == order) for k in range(order + 1)] for j in range(n)] + [[0]]
    return [*rows, last]


def _lowest_terms(above: Any, below: Any, beside: Sequence[Any], functions: Mapping[Any, Any]) -> Rational:
    """Divide numerator and denominator by what they share; ``beside`` are factors of both that were left out."""
    from ..formulas.factor import common_divisor, definite_sign, factors

    common = common_divisor(above, below) if above else below
    numerator, denominator = above.exquo(common), below.exquo(common)
    leading = coefficients_in_s(denominator)[-1]
    if definite_sign(leading) == -1 or (definite_sign(leading) is None and leading.LC < 0):
        numerator, denominator = -numerator, -denominator
    found = [f for each in (common, *beside) for f, _ in factors(each)[1]] if above else []
    shared = list(dict.fromkeys(f for f in found if any(m[-1] for m in f.itermonoms())))
    return Rational(numerator, denominator, tuple(shared), functions)


def coefficients_in_s(polynomial: Any) -> list[Any]:
    """Return the coefficients of a polynomial in the ring's last generator, ascending."""
    from sympy.polys.rings import PolyRing

    ring = PolyRing(polynomial.ring.symbols[:-1], polynomial.ring.domain, polynomial.ring.order)
    parts: dict[int, dict[tuple[int, ...], Any]] = {0: {}}
    for monom, c in polynomial.terms():
        parts.setdefault(monom[-1], {})[monom[:-1]] = c
    return [ring.from_dict(parts.get(k, {})) for k in range(max(parts) + 1)]


def split_in_s(polynomial: Any) -> tuple[int, list[tuple[Sequence[Any], int]]]:
    """Return content and factors of a polynomial, each factor as its coefficients in s."""
    from ..formulas.factor import factors

    content, found = factors(polynomial)
    return content, [(coefficients_in_s(f), m) for f, m in found]
