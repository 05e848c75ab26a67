"""Conditions that others imply: sums never negative that vanish only where another condition fails."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ..core.factor import definite_sign, sign_of_power

if TYPE_CHECKING:
    from sympy.polys.rings import PolyElement


def implied(poly: PolyElement, others: Sequence[PolyElement]) -> bool:
    """Tell whether ``poly > 0`` follows from the bounds and from the other conditions ``other > 0``.

    Sufficient, not necessary: ``b > 0`` follows from ``a*b*m - I_c > 0`` with ``b >= 0``, because ``b = 0``
    makes the latter negative.
    """
    zeros = _vanishing(poly)
    return zeros is not None and any(_never_positive(_without(other, zeros)) for other in others)


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
