"""Which inequalities between the parameters decide stability, in symbols.

The characteristic polynomial is stable if its coefficients and every second Hurwitz determinant are positive
(A. Lienard and M. H. Chipart, J. Math. Pures Appl. 10 (1914) 291-346). Each is factored; factors that the declared
bounds make positive are dropped. What is left is the criterion.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.cache import cached
from ..core.codegen import build, generate
from ..core.compiled import direction as direction_of
from ..core.errors import UcritError, near_match
from ..core.model import Model
from ..numerics.determinants import determinant, hurwitz_matrix

if TYPE_CHECKING:
    from sympy.polys.rings import PolyElement

MAX_TERMS = 20_000


@dataclass(frozen=True)
class Boundary:
    """A critical value in closed form: ``parameter**power = expression``."""

    parameter: str
    power: int
    expression: str
    latex: str
    mathml: str

    def __str__(self) -> str:
        left = self.parameter if self.power == 1 else f"{self.parameter}**{self.power}"
        return f"{left} = {self.expression}"


@dataclass(frozen=True)
class Criterion:
    """One inequality ``expression > 0`` that stability needs.

    Attributes
    ----------
    name
        ``a_0`` (a coefficient) or ``H_3`` (a Hurwitz determinant) of the characteristic polynomial.
    expression, latex, mathml
        What is left of it after dropping the factors that are positive by their bounds.
    dropped
        The factors that were dropped.
    failure
        ``"divergence"`` when a real root passes through zero as it fails, ``"flutter"`` when a pair of roots passes
        through the imaginary axis, ``"order"`` when a root passes through infinity.
    boundaries
        Closed forms of the parameter values at which it fails, where these are linear or purely quadratic.
    """

    name: str
    expression: str
    latex: str
    mathml: str
    dropped: tuple[str, ...]
    failure: str
    boundaries: tuple[Boundary, ...]
    source: str = field(repr=False)
    parameters: tuple[str, ...] = field(repr=False)

    @cached_property
    def _function(self) -> Callable[..., tuple[Any, ...]]:
        return build(self.source, "criterion")

    def value(self, vehicle: Model) -> Any:
        """Return the value of the left-hand side for a vehicle, an array where its parameters are arrays."""
        arguments = dict(zip(vehicle.values, vehicle.arguments(), strict=True))
        return self._function([arguments[name] for name in self.parameters])[0]

    def boundary(self, parameter: str) -> Boundary | None:
        """Return the closed form for one parameter, if there is one."""
        return next((b for b in self.boundaries if b.parameter == parameter), None)

    def __str__(self) -> str:
        return f"{self.expression} > 0"

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex} > 0$"


@dataclass(frozen=True)
class Criteria:
    """The conditions for stability of a model, in symbols.

    Attributes
    ----------
    conditions
        The inequalities that are not settled by the parameters' bounds; all must hold.
    kind
        ``"asymptotic"``, or ``"neutral"`` where no motion decays and stability can only be neutral.
    settled
        ``True``: stable for all allowed parameters; ``False``: for none; ``None``: it depends.
    zeros
        Number of roots that are zero whatever the parameters; they were divided out.
    order
        Degree of the characteristic polynomial without these.
    """

    model: str
    conditions: tuple[Criterion, ...]
    kind: str
    settled: bool | None
    zeros: int
    order: int

    def __str__(self) -> str:
        word = "stable" if self.kind == "asymptotic" else "neutrally stable"
        if self.settled is not None:
            return f"{self.model}: {word if self.settled else 'unstable'} for all allowed parameters"
        lines = [f"{self.model}: {word} if and only if"]
        return "\n".join([*lines, *(f"    {condition}" for condition in self.conditions)])

    def _repr_latex_(self) -> str:
        return r"$\displaystyle " + r" \quad\wedge\quad ".join(f"{c.latex} > 0" for c in self.conditions) + "$"

    def __iter__(self) -> Any:
        return iter(self.conditions)

    def failing(self, vehicle: Model) -> tuple[Criterion, ...]:
        """Return the conditions that a vehicle (with scalar parameters) does not meet."""
        return tuple(c for c in self.conditions if not c.value(vehicle) > 0)


def criteria(model: type[Model] | Model, *, direction: int | None = None, free: Sequence[str] | None = None) -> Criteria:
    """Derive the conditions for stability in symbols.

    Parameters
    ----------
    model
        A model class, or a vehicle (needed for ``free``).
    direction
        +1 forward, -1 backing up; that of the vehicle's speed by default.
    free
        Parameters to keep as symbols; the vehicle's values are put in for the others. Needed above order 6, where
        fully symbolic conditions have too many terms.

    Returns
    -------
    Criteria
        Conditions, each with the kind of failure it guards against.

    Raises
    ------
    UcritError
        If the conditions would have more than 20,000 terms, or ``free`` names no parameter.
    """
    cls = model if isinstance(model, type) else type(model)
    sense = direction or (1 if isinstance(model, type) else direction_of(model))
    values: dict[str, Any] = {}
    if free is not None:
        if isinstance(model, type):
            raise UcritError(f"{cls.model_id()}: free parameters need a vehicle, whose values the others take")
        for name in free:
            if name not in model.values:
                raise UcritError(f"{cls.model_id()}: there is no parameter '{name}'{near_match(name, model.values)}")
        values = {name: value for name, value in model.values.items() if name not in free}
    key = f"criteria{sense:+d}" + "".join(f"-{k}={v!r}" for k, v in values.items())
    piece = key if not values else f"criteria-{_short_hash(key)}"
    facts = cached(cls, piece, lambda: _derive(cls, sense, values))
    conditions = tuple(
        Criterion(**{
            **c,
            "dropped": tuple(c["dropped"]),
            "parameters": tuple(c["parameters"]),
            "boundaries": tuple(Boundary(**b) for b in c["boundaries"]),
        })
        for c in facts["conditions"]
    )
    return Criteria(cls.model_id(), conditions, facts["kind"], facts["settled"], facts["zeros"], facts["order"])


def _short_hash(text: str) -> str:
    import hashlib

    return hashlib.sha256(text.encode()).hexdigest()[:16]


def _derive(cls: type[Model], direction: int, values: Mapping[str, Any]) -> dict[str, Any]:
    import sympy as sp

    from ..core.derive import symbolic

    system = symbolic(cls, direction)
    if values:
        symbols = system.traced.parameters
        system = system.substituted({symbols[name]: sp.Rational(str(v)) for name, v in values.items()})
    zeros = system.polynomial.zeros
    a = list(system.polynomial.coefficients[zeros:])
    even = len(a) > 1 and not any(a[1::2])
    if even:  # all roots on the axis and simple if and only if p + p' is stable
        a = [c + (k + 1) * a[k + 1] if k + 1 < len(a) else c for k, c in enumerate(a)]
    parameters = [s for name, s in system.traced.parameters.items() if name not in values]
    conditions, settled = [], True
    for name, failure, poly in _lienard_chipart(a, cls.model_id()):
        condition = _condition(name, failure, poly, parameters)
        if condition is False:
            conditions, settled = [], False
            break
        if condition is not True and condition["expression"] not in [c["expression"] for c in conditions]:
            conditions.append(condition)
    return {
        "conditions": conditions,
        "kind": "neutral" if even else "asymptotic",
        "settled": None if conditions else settled,
        "zeros": zeros,
        "order": len(a) - 1,
    }


def _lienard_chipart(a: list[PolyElement], where: str) -> list[tuple[str, str, PolyElement]]:
    """Return name, failure and polynomial of each condition; the sign of a_n is made positive first."""
    from ..core.factor import definite_sign

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
    n = len(a) - 1
    terms = sum(len(c) for c in a) / (n + 1)
    if terms**size > 40 * MAX_TERMS and size > 4:
        raise UcritError(
            f"{where}: the conditions of order {n} in all parameters have too many terms to be of use; "
            "keep a few symbols and take numbers for the rest: criteria(vehicle, free=[\"U\", ...])"
        )
    return determinant([row[:size] for row in hurwitz_matrix(a)[:size]])


def _condition(name: str, failure: str, poly: PolyElement, parameters: list[Any]) -> Any:
    """Return ``True`` or ``False`` where the bounds settle ``poly > 0``, else the facts of the criterion."""
    from ..core.factor import definite_sign, factors, readable

    if not poly:
        return False
    content, found = factors(poly)
    sign, left, dropped = (1 if content > 0 else -1), [], []
    for factor, multiplicity in found:
        settled = definite_sign(factor)
        if settled is None:
            left.append((factor, 2 - multiplicity % 2))
        else:
            dropped.append(typeset(readable(factor if settled > 0 else -factor))["expression"])
            sign *= settled**multiplicity
    if not left:
        return sign > 0
    if sign < 0:
        odd = next((i for i, (_, m) in enumerate(left) if m == 1), None)
        if odd is None:
            return False
        left[odd] = (-left[odd][0], 1)
    return _facts(name, failure, left, dropped, parameters)


def typeset(expression: Any) -> dict[str, str]:
    """Return an expression as text, LaTeX and MathML."""
    from ..core import typeset as to

    return {"expression": to.text(expression), "latex": to.latex(expression), "mathml": to.mathml(expression)}


def _facts(
    name: str, failure: str, left: list[tuple[PolyElement, int]], dropped: list[str], parameters: list[Any]
) -> dict[str, Any]:
    import sympy as sp

    from ..core.factor import readable

    parts = [(readable(factor), power) for factor, power in left]
    product = sp.Mul(*(sp.Pow(e, p, evaluate=False) if p > 1 else e for e, p in parts), evaluate=False)
    used = [p for p in parameters if product.has(p)]
    return {
        "name": name,
        **typeset(product),
        "dropped": dropped,
        "failure": failure,
        "boundaries": [b for factor, _ in left for b in _boundaries(factor)],
        "source": generate("criterion", [used], [product]),
        "parameters": [p.name for p in used],
    }


def _boundaries(factor: PolyElement) -> list[dict[str, Any]]:
    """Solve ``factor = 0`` for every parameter in which it is linear or purely quadratic."""
    from ..core.factor import readable_ratio

    found, ring = [], factor.ring
    for i, generator in enumerate(ring.symbols):
        powers = {m[i] for m in factor.itermonoms()}
        if not generator.is_Symbol or any(g != generator and g.has(generator) for g in ring.symbols):
            continue
        if powers in ({0, 1}, {0, 2}):
            power = max(powers)
            split: dict[int, dict[Any, Any]] = {0: {}, power: {}}
            for monom, c in factor.terms():
                split[monom[i]][(*monom[:i], 0, *monom[i + 1 :])] = c
            value = readable_ratio(-ring.from_dict(split[0]), ring.from_dict(split[power]))
            found.append({
                "parameter": generator.name,
                "power": power,
                **typeset(value),
            })
    return found
