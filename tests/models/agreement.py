"""Random vehicles, and the agreement of closed form, Routh boundary and eigenvalues on critical values."""

import numpy as np
import pytest
from scipy.optimize import brentq

from ucrit import critical, modes
from ucrit.core.contract.possible import holds

SETS = 40


def varied(vehicle, seed):
    """Return a vehicle whose parameters differ from the given one's by up to a factor of two."""
    rng = np.random.default_rng(seed)
    while True:
        values = {name: value * 2 ** rng.uniform(-1, 1) for name, value in vehicle.values.items()}
        if all(holds(type(vehicle), values).values()):
            return vehicle.with_(**values)


def growth(vehicle):
    return float(modes(vehicle).growth)


def crossing(vehicle, parameter, near, within=1e-3):
    """Return the parameter's value near a given one at which an eigenvalue crosses the imaginary axis."""

    def function(value):
        return growth(vehicle.with_(**{parameter: value}))

    return brentq(function, near * (1 - within), near * (1 + within), xtol=1e-13 * abs(near))


def agree(vehicle, parameter, expected, rel=1e-9):
    """Assert that Routh boundary and eigenvalue crossing are where a formula says, and nowhere else."""
    found = critical(vehicle, parameter)
    assert [c.value for c in found] == pytest.approx([expected], rel=rel)
    assert crossing(vehicle, parameter, expected) == pytest.approx(expected, rel=rel)
    return found[0]
