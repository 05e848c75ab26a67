"""Do published eigenvalues come out?"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ..catalogue import load
from ..core.contract.model import Model
from ..core.numeric.compiled import state_space
from .published import Entry
from .report import FailedCheckError
from .subject import Subject

NEAR = 1e-7


def numbers(subject: Subject) -> str:
    """Published eigenvalues come out to the digits that are printed."""
    entries = subject.published("numbers")
    for entry in entries:
        vehicle = _vehicle(subject.model, entry)
        expected = [complex(*pair) for pair in entry.content["eigenvalues"]]
        got = np.linalg.eigvals(state_space(vehicle).A)
        size = float(np.abs(got).max())
        if len(expected) > len(got):
            raise FailedCheckError(f"{entry.where}: {len(expected)} eigenvalues published, {len(got)} found")
        for value in expected:
            nearest, got = _taken(got, value)
            if abs(nearest - value) > float(entry.content["tolerance"]) * max(abs(value), NEAR * size):
                raise FailedCheckError(f"{entry.where}: eigenvalue {value:g} published, {nearest:.9g} found")
    return f"{sum(len(entry.content['eigenvalues']) for entry in entries)} published eigenvalues agree"


def _taken(values: npt.NDArray[Any], near: complex) -> tuple[complex, npt.NDArray[Any]]:
    """Return the nearest value and the others."""
    nearest = int(np.argmin(np.abs(values - near)))
    return complex(values[nearest]), np.delete(values, nearest)


def _vehicle(model: type[Model], entry: Entry) -> Model:
    values = dict(entry.content.get("parameters", {}))
    if "vehicle" in entry.content:
        values = {**load(entry.content["vehicle"]).values, **values}
    return model(**values)
