"""How the cornering coefficient of a tire depends on its load. SI units and radians."""

from __future__ import annotations

from typing import Any

from ...core.formulas.functions import grouped


def degressive_coefficient(C_max: Any, F_max: Any, F_z: Any) -> Any:
    """Return a cornering coefficient [N/rad] that rises with the load, ever less, to C_max at F_max, and then falls.

    ``C_max sin(2 atan(F_z/F_max))``, written without the angles (E. Bakker, H. B. Pacejka and L. Lidner, SAE paper
    890087, 1989).

    >>> [degressive_coefficient(80e3, 8e3, F_z) for F_z in (4e3, 8e3, 16e3)]
    [64000.0, 80000.0, 64000.0]
    """
    u = F_z / F_max
    return C_max * grouped(2 * u / (1 + u * u))
