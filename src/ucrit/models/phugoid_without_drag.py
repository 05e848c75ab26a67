"""Axes and assumptions as in the phugoid, without drag and thrust. SI units and radians."""

from ..core import cos
from .phugoid import Phugoid


class PhugoidWithoutDrag(Phugoid):
    """Lanchester's phugoid: constant angle of attack, no drag (F. W. Lanchester, Aerodonetics, 1908)."""

    epsilon = 0

    def conserved(self, x):
        ratio = x.V / self.U
        return {"curve of Lanchester's chart": ratio * cos(x.gamma) - ratio**3 / 3}
