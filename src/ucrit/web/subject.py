"""What a request is about: a vehicle of the catalogue or one that was loaded, with the values on the page."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any

from ..catalogue import load, read_vehicle, vehicle_names
from ..core.contract.model import Model
from ..core.errors import UcritError, near_match

LOADED = "the loaded text"
LONGEST_NUMBER = 64
LONGEST_FILE = 32 * 1024
"""Characters; some that are meant badly take seconds to read when they are twice as many."""


def read_json(content: bytes) -> dict[str, Any]:
    """Return the body of a request; raise `UcritError` for anything but an object."""
    try:
        found = json.loads(content, parse_constant=_refuse_constant)
    except (ValueError, RecursionError):  # UnicodeDecodeError and numbers of 5000 digits among them
        raise UcritError("the request is not valid JSON") from None
    if not isinstance(found, dict):
        raise UcritError("the request must be a JSON object")
    return found


def _refuse_constant(name: str) -> Any:
    raise ValueError(name)


def read_subject(body: Mapping[str, Any]) -> Model:
    """Return the vehicle of a request, with its values.

    Parameters
    ----------
    body
        With ``vehicle``, a name in the catalogue, or ``toml``, the text of a vehicle file; maybe ``values``, numbers
        [SI] or texts with a unit by the parameters' names.
    """
    name, text = body.get("vehicle"), body.get("toml")
    if (name is None) == (text is None):
        raise UcritError("a request names a vehicle of the catalogue or brings the text of a vehicle file")
    if text is not None:
        if not isinstance(text, str) or len(text) > LONGEST_FILE:
            raise UcritError(f"a vehicle file is a text of at most {LONGEST_FILE // 1024} kB")
        vehicle = read_vehicle(text, LOADED).with_info(file="")
    elif not isinstance(name, str) or name not in vehicle_names():
        raise UcritError(f"there is no vehicle '{str(name)[:100]}'{near_match(str(name)[:100], vehicle_names())}")
    else:
        vehicle = load(name)
    return changed(vehicle, body.get("values", {}))


def changed(vehicle: Model, values: Any) -> Model:
    """Return a vehicle with other values; each must be one number or one text with a unit."""
    if not isinstance(values, dict):
        raise UcritError("values must be an object of numbers by parameter")
    for name, value in values.items():
        parameter(vehicle, name)
        if isinstance(value, bool) or not isinstance(value, int | float | str):
            raise UcritError(f"{name} must be a number or a text with a unit")
        if isinstance(value, str) and len(value) > LONGEST_NUMBER:
            raise UcritError(f"{name} is a number of at most {LONGEST_NUMBER} characters, with its unit")
    return vehicle.with_(**values) if values else vehicle


def parameter(vehicle: Model, name: Any) -> str:
    """Return the name of a parameter; raise `UcritError` for one that the vehicle does not have."""
    known = type(vehicle).declaration.parameters
    if not isinstance(name, str) or name not in known:
        raise UcritError(
            f"{type(vehicle).model_id()}: there is no parameter '{str(name)[:100]}'{near_match(str(name)[:100], known)}"
        )
    return name


def ends(given: Any, thing: str) -> tuple[float, float]:
    """Return a range that a request gives as two rising numbers."""
    if not isinstance(given, list) or len(given) != 2 or any(isinstance(v, bool) for v in given):
        raise UcritError(f"{thing} must be two numbers")
    try:
        low, high = map(float, given)
    except (TypeError, ValueError, OverflowError):
        raise UcritError(f"{thing} must be two numbers") from None
    if not (math.isfinite(low) and math.isfinite(high) and low < high):
        raise UcritError(f"{thing} must be two rising numbers, got {low:g} and {high:g}")
    return low, high
