"""Where double numbers end: exact coefficients for parameters of extreme size, and what to say where none help."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from ..contract.model import Model
from ..errors import UcritError
from .bounds import coefficient_bounds
from .compiled import coefficients, compiled, direction

USUAL = 1e-60, 1e60
"""Sizes of parameters [SI] whose products in the equations of any vehicle stay within double numbers by far."""

SPREAD = math.log(1e24)
"""Logarithm of the ratio of eigenvalues above which small ones are taken as lost; a vanishing cosine makes 1e16."""

LOST = 0.01
"""Share by which the product of the eigenvalues may miss the one that the coefficients tell."""


def extremes(vehicle: Model) -> dict[str, float]:
    """Return the parameters of a vehicle (scalars) beside the usual sizes."""
    small, large = USUAL
    return {n: float(x) for n, x in vehicle.values.items() if x and not small <= abs(float(x)) <= large}


def characteristic(vehicle: Model) -> Sequence[Any]:
    """Return the characteristic coefficients of a vehicle (scalars) without structural zeros.

    They are doubles; fractions, exact for the parameters given, where these are of extreme size or doubles overflow.

    Raises
    ------
    UcritError
        If there are none.
    """
    functions = compiled(type(vehicle), direction(vehicle))
    with np.errstate(all="ignore"):
        a = [float(x) for x in coefficients(vehicle)][functions.structural_zeros :]
    if np.isfinite(a).all() and not extremes(vehicle):
        return a
    exact = _exact(vehicle)
    if exact is None:
        raise unusable(vehicle)
    return exact[functions.structural_zeros :]


def unusable(vehicle: Model) -> UcritError:
    """Return what to raise where the equations of a vehicle give numbers that are not finite."""
    model = type(vehicle).model_id()
    exact = None if vehicle.dims else _exact(vehicle)
    if vehicle.dims or (exact is not None and not exact[-1]) or (exact is None and not extremes(vehicle)):
        return UcritError(f"{model}: the equations are singular for these parameters")
    units = type(vehicle).declaration.parameters
    told = [f"{n} = {x:g} {units[n].unit}".removesuffix(" 1") for n, x in extremes(vehicle).items()]
    where = " and ".join(told) or "these parameters"
    return UcritError(f"{model}: with {where} the equations leave the range of double numbers, 1e-308 to 1e308")


def refuse_lost(vehicle: Model, values: Any) -> None:
    """Refuse eigenvalues (n,) of a vehicle, sorted in any way, if the small ones are lost beside the large ones.

    Their product is, up to its sign, the ratio of the last and the first coefficient.
    """
    functions = compiled(type(vehicle), direction(vehicle))
    a = np.array([float(x) for x in coefficients(vehicle)])[functions.structural_zeros :]
    moduli = np.sort(np.abs(values))[functions.structural_zeros :]
    if len(a) < 3 or not np.isfinite(a).all() or not a[0] or not a[-1]:
        return
    with np.errstate(all="ignore"):
        missed = np.log(moduli).sum() - np.log(np.abs(a[0])) + np.log(np.abs(a[-1]))
        if abs(missed) < LOST:
            return
        if functions.undamped:
            return
        found = coefficient_bounds(functions, vehicle.arguments(), whole=False)
        sizes, errors = ([float(x) for x in group] for group in found)
        logs, powers = np.log(sizes), np.arange(len(sizes))
        largest = ((logs[:-1] - logs[-1]) / powers[:0:-1]).max()
        smallest = ((logs[0] - logs[1:]) / powers[1:]).min()
    if largest - smallest > SPREAD and abs(a[0]) > 1e3 * errors[0]:
        least, most = (f"1e{round(x / math.log(10)):+d}" for x in (smallest, largest))
        raise UcritError(
            f"{type(vehicle).model_id()}: the eigenvalues are of sizes from about {least} to {most} 1/s, too far apart "
            "for double numbers; take less extreme parameters"
        )


def _exact(vehicle: Model) -> Sequence[Fraction] | None:
    functions = compiled(type(vehicle), direction(vehicle))
    try:
        found = functions.exact_coefficients([Fraction(float(x)) for x in vehicle.values.values()])
    except (ArithmeticError, ValueError):
        return None
    return [Fraction(x) for x in found]
