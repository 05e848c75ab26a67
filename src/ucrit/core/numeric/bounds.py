"""How far rounding can move the characteristic coefficients, and hence which verdicts are sure.

A sum of products is off by at most a few rounding units of the sum of the products' sizes; those sizes grow with
the sizes of the parameters, so that their values at a tile's largest parameters bound the whole tile.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np

from ..formulas.codegen import build
from .compiled import Compiled

EPS = float(np.finfo(float).eps)


@cache
def _functions(source: str, name: str) -> Any:
    return build(source, name)


def coefficient_bounds(functions: Compiled, arguments: Sequence[Any], *, whole: bool) -> tuple[list[Any], list[Any]]:
    """Return bounds of the deciding coefficients' sizes and of their rounding errors.

    Parameters
    ----------
    functions
        The model's compiled functions.
    arguments
        Parameter values in declared order, floats or arrays that broadcast.
    whole
        Whether one bound shall hold for all of the values; else there is one for each.

    Returns
    -------
    list, list
        One entry for each coefficient that `ucrit.core.numeric.compiled.deciding_coefficients` returns.
    """
    facts = functions.size_facts
    with np.errstate(all="ignore"):
        inner = _functions(facts["functions"], "functions")(arguments)
        parts = [[np.abs(x) for x in group] for group in (arguments, inner)]
        if whole:
            parts = [[np.max(x) for x in group] for group in parts]
        sizes = _functions(facts["magnitudes"], "magnitudes")(*parts)
        errors = [size * (units * EPS) for size, units in zip(sizes, facts["units"], strict=True)]
    zeros = functions.structural_zeros
    return _deciding(functions, sizes[zeros:]), _deciding(functions, errors[zeros:])


def _deciding(functions: Compiled, a: Sequence[Any]) -> list[Any]:
    """Follow `deciding_coefficients`, in which those of an undamped model are sums; 1.01 for errors of second order."""
    if functions.undamped:
        a = [c + (k + 1) * a[k + 1] if k + 1 < len(a) else c for k, c in enumerate(a)]
    return [1.01 * c for c in a]
