"""Limits of the characteristic polynomial as parameters grow without bound or vanish.

As C grows, the finite roots of ``sum_k a_k(C) s^k`` tend to the roots of the terms of highest degree in C;
the other roots go to infinity or to zero like powers of C, which the edges of the Newton polygon of the
points (k, degree of a_k) give (V. Puiseux, J. Math. Pures Appl. 15 (1850) 365-480). A limit to zero is the
same with degrees counted downwards.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from ..contract.model import Model
from ..errors import UcritError, near_match

if TYPE_CHECKING:
    from .characteristic import CharacteristicPolynomial
    from .linear import LinearSystem


@dataclass(frozen=True)
class Escape:
    """Roots that leave the finite part of the plane: ``s = z C**power``, or ``z / p**power`` as p vanishes.

    ``polynomial`` has the factors z as its roots. A positive power means that they go to infinity, a
    negative one that they go to zero.
    """

    parameter: str
    power: Fraction
    polynomial: CharacteristicPolynomial

    @property
    def count(self) -> int:
        """Number of these roots."""
        return self.polynomial.order


def limit_polynomial(
    system: type[Model] | LinearSystem | CharacteristicPolynomial, to: Mapping[str, float], direction: int = 1
) -> tuple[CharacteristicPolynomial, tuple[Escape, ...]]:
    """Take parameters to infinity or to zero, one after the other.

    Parameters
    ----------
    system
        A model class, its linear system, or a characteristic polynomial in its parameters.
    to
        ``{"C": inf}``: infinity or zero for each parameter, in the order in which the limits are taken.
    direction
        Sign of the speed that a model class is linearised for.

    Returns
    -------
    CharacteristicPolynomial, tuple of Escape
        The polynomial of the roots that stay finite, free of common factors, and the roots that do not.

    Raises
    ------
    UcritError
        If a limit is neither infinity nor zero, or the parameter occurs inside a function (an angle of rake).

    Examples
    --------
    >>> from ucrit import find_model
    >>> polynomial, escapes = limit_polynomial(find_model("trailer-undamped-hitch"), {"C": math.inf})
    >>> len(polynomial.coefficients) - 1, [escape.count for escape in escapes]
    (3, [1])
    """
    polynomial = _polynomial(system, direction)
    escapes: list[Escape] = []
    for name, value in to.items():
        symbol = _symbol(polynomial, name, value)
        if symbol is None:
            continue
        polynomial, lost = _one(polynomial, symbol, -1 if value == 0 else 1)
        escapes += lost
    return polynomial, tuple(escapes)


def _polynomial(system: Any, direction: int) -> CharacteristicPolynomial:
    if isinstance(system, type):
        from .derive import symbolic

        system = symbolic(system, direction)
    return getattr(system, "polynomial", system)  # type: ignore[no-any-return]


def _symbol(polynomial: CharacteristicPolynomial, name: str, value: float) -> Any:
    """Return the symbol of a parameter, ``None`` where the polynomial does not depend on it."""
    if value not in (math.inf, 0):
        raise UcritError(f"the limit of {name} must be infinity or 0, got {value}")
    if any(f.has(s) for f in polynomial.functions.values() for s in f.free_symbols if s.name == name):
        raise UcritError(f"{name} occurs inside a function, so that its limit is not that of a polynomial")
    return next((s for s in polynomial.ring.symbols if s.name == name), None)


def _one(polynomial: CharacteristicPolynomial, symbol: Any, sign: int) -> tuple[Any, list[Escape]]:
    index = polynomial.ring.symbols.index(symbol)
    points = {
        k: max(sign * monom[index] for monom in a.itermonoms()) for k, a in enumerate(polynomial.coefficients) if a
    }
    hull, a = _upper_hull(sorted(points.items())), polynomial.coefficients
    top = max(points.values())
    finite = [_leading(c, index, sign, Fraction(top)) for c in a]
    while not finite[-1]:
        finite.pop()
    kept = next(k for k, c in enumerate(finite) if c)
    escapes = []
    for (k, d), (k2, d2) in pairwise(hull):
        power = Fraction(d - d2, k2 - k)
        if power:
            edge = [_leading(a[i], index, sign, d - power * (i - k)) for i in range(k, k2 + 1)]
            escapes.append(Escape(symbol.name, power, _primitive(polynomial, edge)))
    zeros = [polynomial.ring.zero] * polynomial.zeros
    return _primitive(polynomial, [*zeros, *finite[kept:]]), escapes


def _upper_hull(points: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """Corners of the upper convex hull of points with rising first coordinate."""
    hull: list[tuple[int, int]] = []
    for x, y in points:
        while len(hull) > 1 and (hull[-1][1] - hull[-2][1]) * (x - hull[-2][0]) <= (y - hull[-2][1]) * (
            hull[-1][0] - hull[-2][0]
        ):
            hull.pop()
        hull.append((x, y))
    return hull


def _leading(a: Any, index: int, sign: int, degree: Fraction) -> Any:
    """Terms of one degree in a parameter, with that power of it taken out."""
    return a.ring.from_dict(
        {(*monom[:index], 0, *monom[index + 1 :]): c for monom, c in a.terms() if sign * monom[index] == degree}
    )


def _primitive(polynomial: CharacteristicPolynomial, coefficients: list[Any]) -> CharacteristicPolynomial:
    """Return a polynomial with what its coefficients share divided out, its leading term positive."""
    from .characteristic import primitive

    return type(polynomial)(polynomial.ring, (primitive(coefficients),), polynomial.functions)


def check_names(model: type[Model], names: Mapping[str, Any]) -> None:
    """Raise `UcritError` for a name that is no parameter of the model."""
    declared = model.declaration.parameters
    for name in names:
        if name not in declared:
            raise UcritError(f"{model.model_id()}: there is no parameter '{name}'{near_match(name, declared)}")
