"""The verdict on a vehicle at one operating point: stable, neutral or unstable, and in which way."""

from __future__ import annotations

from dataclasses import dataclass

from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.numeric.compiled import compiled, direction
from ...core.numeric.reach import characteristic, unusable
from ...core.record import Record
from ...numerics.routh import routh


@dataclass(frozen=True)
class Verdict(Record):
    """Stability of the basic motion for small disturbances.

    Attributes
    ----------
    state
        ``"asymptotically stable"``, ``"neutral"`` (nothing grows, something does not decay) or ``"unstable"``.
    static
        ``"stable"``, ``"neutral"`` or ``"unstable"``: the sign of a_0, that is whether the vehicle, held away from
        the basic motion, is drawn back.
    growing, marginal
        Number of roots in the right half plane and, beside the harmless ones, on the imaginary axis.
    rigid_positions
        Number of roots that are zero whatever the parameters: the vehicle may run anywhere on the road.
    """

    state: str
    static: str
    growing: int
    marginal: int
    rigid_positions: int

    @property
    def stable(self) -> bool:
        """Whether nothing grows and all that does not decay are rigid positions."""
        return self.growing == 0 and self.marginal == 0

    def _repr_html_(self) -> str:
        from ..results import notebook

        return notebook.verdict(self)

    def __str__(self) -> str:
        if self.growing:
            how = "statically" if self.static == "unstable" else "dynamically"
            text = f"{how} unstable: {self.growing} growing root{'s' if self.growing > 1 else ''}"
        elif self.state == "neutral" and not self.marginal:
            text = "neutral: nothing grows and nothing dies out"
        elif self.marginal:
            text = (
                f"neutral: {self.marginal} root{'s' if self.marginal > 1 else ''} on the imaginary axis, nothing grows"
            )
        else:
            text = "asymptotically stable: every disturbance dies out"
        if self.rigid_positions:
            count = self.rigid_positions
            zeros = "one zero root" if count == 1 else f"{count} zero roots"
            text += f"; {zeros} of positions or speeds that nothing restores, which is harmless"
        return text


def verdict(vehicle: Model) -> Verdict:
    """Judge a vehicle with scalar parameters by Routh's array of its characteristic polynomial.

    The coefficients are rounded once, to doubles; for those the counts are exact. A vehicle within rounding of
    a boundary is judged as its rounded coefficients are. Where parameters are so large or small that doubles overflow,
    coefficients are exact.

    Examples
    --------
    >>> from ucrit import load, verdict
    >>> str(verdict(load("bmw-320i")))
    'asymptotically stable: every disturbance dies out'
    """
    if vehicle.dims:
        raise UcritError("a verdict is about one vehicle: give scalar parameters, or use sweep")
    zeros = compiled(type(vehicle), direction(vehicle)).structural_zeros
    a = characteristic(vehicle)
    if not a[-1]:
        raise unusable(vehicle)
    if len(a) == 1:
        return Verdict("neutral", "neutral", 0, 0, zeros)
    array = routh(a)
    assert array.right_half_plane is not None
    assert array.imaginary_axis is not None
    growing, marginal = array.right_half_plane, array.imaginary_axis
    held = a[0] * a[-1]
    return Verdict(
        "unstable" if growing else "neutral" if marginal else "asymptotically stable",
        "stable" if held > 0 else "unstable" if held < 0 else "neutral",
        growing,
        marginal,
        zeros,
    )
