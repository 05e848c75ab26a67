"""Units as people type them: the built-in table agrees with pint, and no text can stall the reader."""

from __future__ import annotations

import time

import pytest

from ucrit.core.errors import UcritError
from ucrit.core.units import COMMON, _convert, to_si


@pytest.mark.parametrize("unit", COMMON)
def test_common_units_agree_with_pint(unit: str) -> None:
    base, _ = COMMON[unit]
    assert to_si(f"3.7 {unit}", base, "x") == pytest.approx(_convert(3.7, unit, base, "x"), rel=1e-15)


@pytest.mark.parametrize(
    "text",
    ["1 9**9**9**9", "1 m^999", "1 m**(999999999)", "1 (((((((", "1 m\n/s", "1e-999999999 km"],
)
def test_odd_units_end_soon(text: str) -> None:
    start = time.perf_counter()
    refused = ""
    try:
        value = to_si(text, "m", "x")
    except UcritError as error:
        value, refused = 0.0, str(error)
    assert value == 0
    assert "\n" not in refused
    assert time.perf_counter() - start < 2
