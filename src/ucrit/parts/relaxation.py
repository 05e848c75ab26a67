"""Side force of a tire that needs some distance to build up. Signs as for tires; SI units and radians."""

from __future__ import annotations

from typing import Any


def force_lag(sigma: Any, rolling_speed: Any, F: Any, dF: Any, steady: Any) -> Any:
    """Return ``sigma/|v| F' + F - F_steady`` [N], zero while the force F lags by a relaxation length [m].

    A first-order lag in distance rolled (Karnopp 2004, section 8.VI).
    """
    return sigma / abs(rolling_speed) * dF + F - steady
