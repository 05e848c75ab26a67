"""Compiled kernels: characteristic coefficients and stability conditions fused into straight-line scalar code.

One generated body serves the processor (numba) and the graphics processor (numba.cuda). Numba is imported when a
kernel is made, not before; machine code is kept in the folder of derived facts.
"""

from __future__ import annotations

import hashlib
import importlib
import os
import re
import sys
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

from .cache import folder
from .compiled import Compiled
from .errors import MissingExtraError, UcritError

ENGINES = ("auto", "numpy", "numba", "cuda")

_INTEGER = re.compile(r"(?<![\w.])(\d+)(?![\w.])")
_MATH = {"arctan2": "atan2", "arctan": "atan", "arcsin": "asin", "arccos": "acos", "abs": "fabs"}

STABLE, OPEN = 1, 2
"""Codes that kernels write: stable for sure, and not sure; 0 is unstable for sure."""


def number_of_limits(degree: int) -> int:
    """Return how many limits a kernel for polynomials of a degree takes."""
    return degree + 1 if degree != 3 else 4


def body(functions: Compiled, indent: str) -> str:
    """Return lines that compute ``code`` from parameters ``v0, v1, ...`` and limits ``e0, e1, ...``."""
    lines = functions.source.splitlines()[2:]
    raw = functions.order + 1
    zeros, degree = functions.structural_zeros, functions.order - functions.structural_zeros
    steps = [_scalar(line.strip()) for line in lines[:-1]]
    values = _scalar(lines[-1].strip().removeprefix("return "))
    steps.append(f"{', '.join(f'q{k}' for k in range(raw))}, = {values}")
    for k in range(degree + 1):
        term = f" + {k + 1}.0*q{zeros + k + 1}" if functions.undamped and k < degree else ""
        steps.append(f"p{k} = q{zeros + k}{term}")
    steps.append(f"sign = -1.0 if p{degree} < 0.0 else 1.0")
    steps += [f"a{k} = sign*p{k}" for k in range(degree + 1)]
    steps += _routh(degree) if degree > 4 else _up_to_4(degree)
    return "\n".join(indent + step for step in steps)


def _scalar(line: str) -> str:
    """Write a line for one number: the mathematics of scalars, and no integers that could be too large."""
    line = re.sub(r"numpy\.(\w+)", lambda m: f"math.{_MATH.get(m[1], m[1])}", line)
    return _INTEGER.sub(r"\1.0", line)


def _up_to_4(degree: int) -> list[str]:
    """Conditions of Lienard and Chipart, in the order of `ucrit.numerics.rounded.slacks`."""
    tests = [f"a{k}" for k in reversed(range(degree + 1))]
    if degree == 3:
        tests = ["a3", "a0", "a2", "a1*a2 - a0*a3"]
    elif degree == 4:
        tests = ["a4", "a0", "a1", "a3", "a1*(a2*a3 - a4*a1) - a0*(a3*a3)"]
    named = [f"c{i} = {test}" for i, test in enumerate(tests)]
    sure = " & ".join(f"(c{i} > e{i})" for i in range(len(tests)))
    wrong = " | ".join(f"(c{i} < -e{i})" for i in range(len(tests)))
    return [*named, f"sure = {sure}", f"wrong = {wrong}", "code = sure + 2*((not sure) & (not wrong))"]


def _routh(degree: int) -> list[str]:
    """Routh's recursion with a running error bound, as in `ucrit.numerics.hurwitz`; limits are the first errors."""
    steps = ["wrong = " + " | ".join(f"(a{k} < -e{k})" for k in range(degree + 1)), f"sure = a{degree} > e{degree}"]
    upper = [(f"a{k}", f"e{k}") for k in range(degree, -1, -2)]
    lower = [(f"a{k}", f"e{k}") for k in range(degree - 1, -1, -2)]
    number = 0
    while lower:
        (u, du), (w, dw) = upper[0], lower[0]
        steps += [f"wrong = wrong | (sure & ({w} < -2.0*{dw}))", f"sure = sure & ({w} > 2.0*{dw})"]
        steps += [f"ratio = {u}/{w}", "size = abs(ratio)", f"slack = ({du} + size*{dw})/({w} - {dw}) + EPS*size"]
        row = upper[1:]
        for j, (x, dx) in enumerate(lower[1:]):
            y, dy = row[j]
            new, error = f"x{number}", f"d{number}"
            number += 1
            steps += [f"product = ratio*{x}", f"{new} = {y} - product"]
            grown = f"(size + slack)*{dx} + slack*abs({x})"
            steps.append(f"{error} = {dy} + {grown} + (EPS*(abs(product) + abs({new})) + TINY)")
            row[j] = (new, error)
        upper, lower = lower, row
    return [*steps, "code = sure + 2*((not sure) & (not wrong))"]


_HEAD = "import math\n\nimport numpy\n\nEPS = 2.220446049250313e-16\nTINY = 1e-300\n\n\n"


def processor_source(functions: Compiled, outer: Sequence[int], inner: int) -> str:
    """Return a function for rows of a grid: some parameters change from row to row, one along the row."""
    degree = functions.order - functions.structural_zeros
    fixed = [k for k in range(len(functions.model.declaration.parameters)) if k not in (*outer, inner)]
    lines = ["def kernel(fixed, limits, rows, outer, start, inner, out):", "    count = 0"]
    lines += [f"    v{k} = fixed[{k}]" for k in fixed]
    lines += [f"    e{k} = limits[{k}]" for k in range(number_of_limits(degree))]
    lines += ["    for i in range(rows.size):", "        line = out[rows[i], start : start + inner.size]"]
    lines += [f"        v{k} = outer[i, {column}]" for column, k in enumerate(outer)]
    lines += ["        for j in range(inner.size):", f"            v{inner} = inner[j]"]
    lines += [body(functions, " " * 12), "            line[j] = numpy.uint8(code)", "            count += code >> 1"]
    return _HEAD + "\n".join([*lines, "    return count", ""])


def graphics_source(functions: Compiled, outer: Sequence[int], inner: int) -> str:
    """Return a kernel for the same grid in which each thread judges one point."""
    degree = functions.order - functions.structural_zeros
    fixed = [k for k in range(len(functions.model.declaration.parameters)) if k not in (*outer, inner)]
    lines = ["def kernel(fixed, limits, outer, inner, out):", "    j, i = cuda.grid(2)"]
    lines += ["    if i < outer.shape[0] and j < inner.size:"]
    lines += [f"        v{k} = fixed[{k}]" for k in fixed]
    lines += [f"        e{k} = limits[{k}]" for k in range(number_of_limits(degree))]
    lines += [f"        v{k} = outer[i, {column}]" for column, k in enumerate(outer)]
    lines += [f"        v{inner} = inner[j]", body(functions, " " * 8), "        out[i, j] = code"]
    return "import math\n\nfrom numba import cuda\n\n" + _HEAD.split("import numpy\n\n")[1] + "\n".join([*lines, ""])


def needed(engine: str) -> Any:
    """Return the module of an engine, and refuse one that is unknown or not there."""
    if engine not in ENGINES:
        from .errors import near_match

        raise UcritError(f"there is no engine '{engine}'{near_match(engine, ENGINES)}")
    try:
        numba = importlib.import_module("numba")
    except ImportError as error:
        raise MissingExtraError(f"the engine '{engine}' needs numba ({error}): pip install 'ucrit[fast]'") from None
    if engine != "cuda":
        return numba
    cuda = importlib.import_module("numba.cuda")
    if not cuda.is_available():
        raise UcritError(
            "the engine 'cuda' needs an NVIDIA GPU with its driver and CUDA libraries, and none is found; "
            "take engine='numba' or 'numpy'"
        )
    return cuda


@cache
def processor_kernel(functions: Compiled, outer: tuple[int, ...], inner: int) -> Any:
    """Return the compiled function of `processor_source`; compiled before, it is loaded."""
    numba = needed("numba")
    source = processor_source(functions, outer, inner)
    path = _written(source)
    module = ModuleType(f"ucrit_{Path(path).stem}" if path else "ucrit_kernel")
    if path is not None:
        module.__file__ = path
        sys.modules[module.__name__] = module  # machine code that is loaded names the module it came from
    exec(compile(source, path or "<generated kernel>", "exec"), module.__dict__)
    options: dict[str, Any] = {"nogil": True, "error_model": "numpy", "cache": path is not None}
    return numba.njit(**options)(module.__dict__["kernel"])


@cache
def graphics_kernel(functions: Compiled, outer: tuple[int, ...], inner: int) -> Any:
    """Return the compiled kernel of `graphics_source`."""
    cuda = needed("cuda")
    namespace: dict[str, Any] = {}
    exec(compile(graphics_source(functions, outer, inner), "<generated kernel>", "exec"), namespace)
    return cuda.jit(namespace["kernel"])


def _written(source: str) -> str | None:
    """Write a source where numba can keep its machine code beside it; ``None`` where that is not possible."""
    base = folder()
    if base is None:
        return None
    path = Path(base) / "kernels" / f"kernel_{hashlib.sha256(source.encode()).hexdigest()[:24]}.py"
    try:
        if not path.is_file():
            path.parent.mkdir(parents=True, exist_ok=True)
            temporary = path.with_suffix(f".{os.getpid()}.tmp")
            temporary.write_text(source)
            os.replace(temporary, path)
        return str(path) if os.access(path.parent, os.W_OK) else None
    except OSError:
        return None
