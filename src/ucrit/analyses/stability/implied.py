"""Conditions that others imply: sums never negative that vanish only where another condition fails."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ...core.formulas.factor import definite_sign, factors, sign_of_power

if TYPE_CHECKING:
    from sympy.polys.rings import PolyElement


def implied(poly: PolyElement, others: Sequence[PolyElement]) -> bool:
    """Tell whether ``poly > 0`` follows from the bounds and from the other conditions ``other > 0``.

    Sufficient, not necessary: ``b > 0`` follows from ``a*b*m - I_c > 0`` with ``b >= 0``, because ``b = 0``
    makes the latter negative.
    """
    zeros = _vanishing(poly)
    return zeros is not None and any(_never_positive(_without(other, zeros)) for other in others)


def excluded(conditions: Sequence[PolyElement]) -> tuple[int, int] | None:
    """Return two conditions ``poly > 0`` that cannot both hold, ``None`` where none are found.

    Sufficient, not necessary: ``-G > 0`` excludes ``G*U**2 - g > 0``, because the first settles the sign of ``G``.
    """
    for i, poly in enumerate(conditions):
        settled = _settled_sign(poly)
        if settled is None:
            continue
        for j, other in enumerate(conditions):
            if j != i and _never_positive(_with_sign(other, *settled)):
                return min(i, j), max(i, j)
    return None


def _settled_sign(poly: PolyElement) -> tuple[int, int] | None:
    """Return the generator and its sign where ``poly > 0`` says no more than the sign of one generator."""
    content, found = factors(poly)
    sign, left = (1 if content > 0 else -1), []
    for factor, multiplicity in found:
        if (known := definite_sign(factor)) is not None:
            sign *= known**multiplicity
        else:
            left.append((factor, multiplicity))
    if len(left) != 1 or left[0][1] % 2 == 0 or len(left[0][0]) != 1:
        return None
    monom, c = left[0][0].terms()[0]
    powers = [i for i, e in enumerate(monom) if e]
    return (powers[0], sign if c > 0 else -sign) if sum(monom) == 1 else None


def _with_sign(poly: PolyElement, place: int, sign: int) -> PolyElement:
    """The polynomial with a generator whose sign is known."""
    import sympy as sp
    from sympy.polys.rings import PolyRing

    symbols = list(poly.ring.symbols)
    symbols[place] = sp.Symbol(symbols[place].name, **{"positive" if sign > 0 else "negative": True})
    return PolyRing(symbols, poly.ring.domain, poly.ring.order).from_dict(dict(poly.terms()))


def _vanishing(poly: PolyElement) -> set[int] | None:
    """Generators all zero where ``poly`` vanishes; ``None`` where it may be negative or that is unclear."""
    zeros: set[int] = set()
    for monom, c in poly.terms():
        powers = [(i, *sign_of_power(g, e)) for i, (g, e) in enumerate(zip(poly.ring.symbols, monom, strict=True)) if e]
        product = 1 if c > 0 else -1
        for _, sign, _ in powers:
            product *= sign or 0
        weak = [i for i, _, surely in powers if not surely]
        if product <= 0 or len(weak) != 1:
            return None
        zeros.add(weak[0])
    return zeros


def _without(poly: PolyElement, zeros: set[int]) -> PolyElement:
    """The polynomial with some generators set to zero."""
    return poly.ring.from_dict({monom: c for monom, c in poly.terms() if not any(monom[i] for i in zeros)})


def _never_positive(poly: PolyElement) -> bool:
    return not poly or definite_sign(poly) == -1
