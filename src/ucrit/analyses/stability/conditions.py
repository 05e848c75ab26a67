"""The conditions of Lienard and Chipart for one characteristic polynomial, as facts that a cache can keep."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import sympy as sp
from sympy.polys.rings import PolyElement

from ...core.derivation.characteristic import CharacteristicPolynomial
from ...core.errors import UcritError
from ...core.formulas import typeset as to
from ...core.formulas.codegen import generate
from ...core.formulas.factor import definite_sign, factors, readable, readable_ratio
from ...numerics.determinants import hurwitz_matrix
from .implied import excluded, implied

MAX_PRODUCTS = 10**5
"""Products that expanding a determinant may take; more of them give a condition that nobody can read."""

LARGE = 10**15
"""Whole numbers up to which coefficients are exact as doubles."""

DIGITS = 17
"""Digits of a double that reads back as the same."""

MAX_TERMS = 1500
"""Terms that a condition may have before it is factored."""


def conditions(polynomial: CharacteristicPolynomial, parameters: Sequence[Any], where: str) -> dict[str, Any]:
    """Derive the conditions for stability of one polynomial.

    Parameters
    ----------
    polynomial
        Its structural zeros are divided out first; it is stable where each of its factors is.
    parameters
        Symbols of all parameters that may occur, in declared order.
    where
        Name of the model, for messages.

    Returns
    -------
    dict
        ``conditions``, ``conflict``, ``kind``, ``settled``, ``zeros`` and ``order``, as
        `ucrit.analyses.stability.criteria.Criteria` has them.
    """
    parts, even = _parts(polynomial)
    found: list[tuple[dict[str, Any], PolyElement]] = []
    settled = True
    for name, failure, poly in _of_all(parts, where):
        condition = _condition(name, failure, poly, parameters, polynomial.functions)
        if condition is False:
            found, settled = [], False
            break
        if condition is not True and condition["expression"] not in [c["expression"] for c, _ in found]:
            found.append((condition, poly))
    for pair in list(found):
        others = [poly for _, poly in found if poly is not pair[1]]
        if implied(pair[1], others) or _square_of_others(pair[1], others):
            found.remove(pair)
    conflict = excluded([poly for _, poly in found])
    if conflict:
        settled, against = False, [found[i][0]["expression"] for i in conflict]
        found = []
    return {
        "conditions": [condition for condition, _ in found],
        "conflict": against if conflict else [],
        "kind": "neutral" if even or not parts else "asymptotic",
        "settled": None if found else settled,
        "zeros": polynomial.zeros,
        "order": polynomial.order - polynomial.zeros,
    }


def _parts(polynomial: CharacteristicPolynomial) -> tuple[list[list[PolyElement]], bool]:
    """Return factors without zero roots, and whether the polynomial is even."""
    parts = [list(factor) for factor in polynomial.factors]
    if len(parts) != 1 or any(parts[0][1::2]):
        return parts, False
    a = parts[0]  # all roots on the axis and simple if and only if p + p' is stable
    return [[c + (k + 1) * a[k + 1] if k + 1 < len(a) else c for k, c in enumerate(a)]], True


def _of_all(parts: Sequence[list[PolyElement]], where: str) -> Iterator[tuple[str, str, PolyElement]]:
    """Return the conditions of all factors; which factor it is stands behind the name, where there are several."""
    for i, part in enumerate(parts, 1):
        for name, failure, poly in _lienard_chipart(part, where):
            yield (name if len(parts) == 1 else f"{name}, factor {i}"), failure, poly


def _square_of_others(poly: PolyElement, others: Sequence[PolyElement]) -> bool:
    """Tell whether a condition only asks for factors not to vanish that another condition keeps from vanishing."""
    open_factors = [(f, m) for f, m in factors(poly)[1] if definite_sign(f) is None]
    return all(m % 2 == 0 and any(not other.rem(f) for other in others) for f, m in open_factors)


def _lienard_chipart(a: list[PolyElement], where: str) -> list[tuple[str, str, PolyElement]]:
    """Return name, failure and polynomial of each condition; the sign of a_n is made positive first."""
    n = len(a) - 1
    if definite_sign(a[n]) == -1:
        a = [-c for c in a]
    found = [(f"a_{k}", "divergence" if k == 0 else "flutter", a[k]) for k in range(n)]
    found.append((f"a_{n}", "order", a[n]))
    for size in range(n - 1, 1, -2):
        found.append((f"H_{size}", "flutter", hurwitz_determinant(a, size, where)))
    return found


def hurwitz_determinant(a: Sequence[PolyElement], size: int, where: str = "model") -> PolyElement:
    """Return the leading principal minor of the given size of the Hurwitz matrix of ``sum a_k s^k``.

    Raises `UcritError` when it would have far too many terms to be read.
    """
    lengths = [row[:size] for row in hurwitz_matrix([len(c) for c in a])[:size]]
    too_long = UcritError(
        f"{where}: the conditions in all parameters, of order {len(a) - 1}, are too long to be read; keep a few "
        'as symbols and take the vehicle\'s numbers for the rest: criteria(vehicle, free="few"), or free=["name", ...]'
    )
    if _permanent(lengths) > MAX_PRODUCTS:
        raise too_long
    found = _expanded([row[:size] for row in hurwitz_matrix(a)[:size]])
    if len(found) > MAX_TERMS:
        raise too_long
    return found


def _expanded(matrix: Sequence[Sequence[PolyElement]]) -> PolyElement:
    """Expand a determinant by rows, minors shared: no divisions, which cost most for sparse polynomials."""
    minors = {0: matrix[0][0].ring.one}
    for row in matrix:
        following: dict[int, PolyElement] = {}
        for used, minor in minors.items():
            for j, entry in enumerate(row):
                if entry and not used >> j & 1:
                    term = -entry * minor if (used >> j).bit_count() % 2 else entry * minor
                    following[used | 1 << j] = following.get(used | 1 << j, 0) + term
        minors = following
    return minors.get(2 ** len(matrix) - 1, matrix[0][0].ring.zero)


def _permanent(matrix: list[list[int]]) -> int:
    """Number of products in the expansion of a determinant whose entries have these numbers of terms."""
    totals = {0: 1}
    for row in matrix:
        following: dict[int, int] = {}
        for used, total in totals.items():
            for j, terms in enumerate(row):
                if terms and not used >> j & 1:
                    following[used | 1 << j] = following.get(used | 1 << j, 0) + total * terms
        totals = following
    return totals.get(2 ** len(matrix) - 1, 0)


def _condition(name: str, failure: str, poly: PolyElement, parameters: Sequence[Any], functions: Any) -> Any:
    """Return ``True`` or ``False`` where the bounds settle ``poly > 0``, else the facts of the criterion."""
    if not poly:
        return False
    content, found = factors(poly)
    sign, left, dropped = (1 if content > 0 else -1), [], []
    for factor, multiplicity in found:
        settled = definite_sign(factor)
        if settled is None:
            left.append((factor, 2 - multiplicity % 2))
        else:
            dropped.append(to.text(readable(factor if settled > 0 else -factor).xreplace(functions)))
            sign *= settled**multiplicity
    if not left:
        return sign > 0
    if sign < 0:
        odd = next((i for i, (_, m) in enumerate(left) if m == 1), None)
        if odd is None:
            return False
        left[odd] = (-left[odd][0], 1)
    return _facts(name, failure, left, dropped, parameters, functions)


def typeset(expression: Any) -> dict[str, str]:
    """Return an expression as text, LaTeX and MathML."""
    return {"expression": to.text(expression), "latex": to.latex(expression), "mathml": to.mathml(expression)}


def _facts(
    name: str,
    failure: str,
    left: list[tuple[PolyElement, int]],
    dropped: list[str],
    parameters: Sequence[Any],
    functions: Any,
) -> dict[str, Any]:
    parts = [((_rounded(factor) or readable(factor)).xreplace(functions), power) for factor, power in left]
    product = sp.Mul(*(sp.Pow(e, p, evaluate=False) if p > 1 else e for e, p in parts), evaluate=False)
    used = [p for p in parameters if product.has(p)]
    return {
        "name": name,
        **typeset(product),
        "dropped": dropped,
        "failure": failure,
        "boundaries": [b for factor, _ in left for b in _boundaries(factor, functions)],
        "source": generate("criterion", [used], [product]),
        "parameters": [p.name for p in used],
    }


def _rounded(factor: PolyElement) -> Any:
    """Return a polynomial with its coefficients as doubles, the largest being 1, ``None`` where whole numbers do.

    The numbers of a vehicle, cleared of denominators, have hundreds of digits, which nobody can read.
    """
    largest = max(abs(int(c)) for c in factor.coeffs())
    if largest < LARGE:
        return None
    return sp.Add(
        *(
            _double(int(c) / largest) * sp.Mul(*(g**e for g, e in zip(factor.ring.symbols, monom, strict=True)))
            for monom, c in factor.terms()
        )
    )


def _double(value: float) -> Any:
    """Return a double with the fewest digits that tell it."""
    return sp.Integer(value) if value.is_integer() else sp.Float(repr(value))


def _boundaries(factor: PolyElement, functions: Any) -> list[dict[str, Any]]:
    """Solve ``factor = 0`` for every parameter in which it is linear or purely quadratic."""
    found, ring = [], factor.ring
    for i, generator in enumerate(ring.symbols):
        powers = {m[i] for m in factor.itermonoms()}
        if not generator.is_Symbol or generator in functions or any(f.has(generator) for f in functions.values()):
            continue
        if powers in ({0, 1}, {0, 2}):
            power = max(powers)
            split: dict[int, dict[Any, Any]] = {0: {}, power: {}}
            for monom, c in factor.terms():
                split[monom[i]][(*monom[:i], 0, *monom[i + 1 :])] = c
            value = readable_ratio(-ring.from_dict(split[0]), ring.from_dict(split[power])).xreplace(functions)
            found.append(
                {
                    "parameter": generator.name,
                    "power": power,
                    **typeset(value.n(DIGITS) if _rounded(factor) else value),
                }
            )
    return found
