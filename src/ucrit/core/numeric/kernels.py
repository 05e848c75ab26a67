"""Compiled kernels: characteristic coefficients and stability conditions fused into scalar code for rows of a grid.

One generated body serves the processor (numba) and the graphics processor (numba.cuda). Numba is imported when a
kernel is made, not before; machine code is kept in the folder of derived facts.
"""

from __future__ import annotations

import hashlib
import importlib
import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

from ..errors import MissingExtraError, UcritError
from .cache import folder
from .compiled import Compiled
from .rows import NotAPolynomialError, Polynomial, Rows, conditions, polynomials

ENGINES = ("auto", "numpy", "numba", "cuda")

STABLE, OPEN = 1, 2
"""Codes that kernels write: stable for sure, and not sure; 0 is unstable for sure."""

THREADS = 128
"""Threads of a block on a graphics processor."""

CONSTANTS = ("EPS = 2.220446049250313e-16", "TINY = 1e-300")
"""What the statements of a body name."""


@dataclass(frozen=True)
class Body:
    """Statements for each row of a grid, and for each of its points, at which the inner parameter is ``x``.

    Those of a point tell in ``sure`` whether it is stable for sure, and in ``doubt`` whether that is not sure.
    """

    row: list[str]
    point: list[str]


def body(functions: Compiled, inner: int) -> Body:
    """Return what judges from parameters ``v0, v1, ...`` and limits ``e0, e1, ...``; up to degree 4 their inverses."""
    rows = Rows()
    try:
        return _judging(polynomials(functions, inner, rows), rows)
    except NotAPolynomialError:
        rows = Rows()
        whole = _judging(polynomials(functions, None, rows), rows)
        return Body([], [f"v{inner} = x", *whole.row, *whole.point])


def _judging(a: list[Polynomial], rows: Rows) -> Body:
    """Conditions as multiples of their limits, the least of which decides; rows in which they overflow stay open."""
    lead = a[-1]
    if len(a) > 5:
        point = [f"sign = -1.0 if {rows.horner(lead)} < 0.0 else 1.0"]
        return Body(
            rows.steps, [*point, *(f"a{k} = sign*{rows.horner(p)}" for k, p in enumerate(a)), *_routh(len(a) - 1)]
        )
    changes, tests = any(lead[1:]), conditions(a, rows)
    row, point = [*rows.steps, "least, total = math.inf, 0.0"], ["least = lowest"]
    (point if changes else row).append(f"sign = -1.0 if {rows.horner(lead)} < 0.0 else 1.0")
    for i, (polynomial, odd) in enumerate(tests):
        row.append(f"scale = {f'sign*e{i}' if odd and not changes else f'e{i}'}")
        names: Polynomial = tuple(c and f"c{i}_{k}" for k, c in enumerate(polynomial))
        row += [f"{name} = {c}*scale" for name, c in zip(names, polynomial, strict=True) if name]
        row += [f"total += abs({name})" for name in names if name]
        varies = any(names[1:]) or (odd and changes)
        value = f"sign*{rows.horner(names)}" if odd and changes else rows.horner(names)
        (point if varies else row).extend([f"c{i} = {value}", f"least = c{i} if c{i} < least else least"])
    # a leading coefficient that may have the other sign turns the conditions round: nothing is sure then
    doubt = "not abs(least) > limit"
    doubt = f"({doubt}) | (not abs(c0) > limit)" if changes else doubt
    row += ["lowest, limit = least, 1.0 if total < math.inf else math.inf"]
    row += [] if changes else ["limit = limit if c0 > 1.0 else math.inf"]
    return Body(row, [*point, "sure = least > limit", f"doubt = {doubt}"])


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
    return [*steps, f"doubt = not (sure | (wrong & (a{degree} > e{degree})))"]


def source(functions: Compiled, outer: Sequence[int], inner: int, target: str) -> str:
    """Return a function for rows of a grid: some parameters change from row to row, one along the row.

    Parameters
    ----------
    functions
        The model's compiled functions.
    outer, inner
        Numbers of the parameters.
    target
        ``"numba"``: all rows one after the other, and how many points were left open is returned. ``"cuda"``: a block
        of threads takes one row in one piece of it, as `ucrit.analyses.stability.device` lays them out, and rows in
        which points were left open are marked.
    """
    degree = functions.order - functions.structural_zeros
    fixed = [k for k in range(len(functions.model.declaration.parameters)) if k not in (*outer, inner)]
    values = [f"v{k} = fixed[{k}]" for k in fixed]
    at = "kinds[i], pieces[p, 2], " if target == "cuda" else ""
    limits = [f"e{k} = limits[{at}{k}]" for k in range(degree + 1)]
    changing = [f"v{k} = outer[i, {column}]" for column, k in enumerate(outer)]
    made = body(functions, inner)
    lines = (_for_graphics if target == "cuda" else _for_processors)([*values, *limits], changing, made)
    return "\n".join(["import math", *lines, ""])


def _for_processors(once: list[str], changing: list[str], made: Body) -> list[str]:
    points, judged = "for j in range(inner.size):", _indented("x = inner[j]", *made.point)
    # doubts are rare: rows that have any are gone through again
    again = ["count += doubts", points, *judged, *_indented("if doubt:", f"    line[j] = {OPEN}")]
    return [
        *CONSTANTS,
        "def kernel(fixed, limits, rows, outer, start, inner, out):",
        *_indented("count = 0", *once, "for i in range(rows.size):"),
        *_indented("line = out[rows[i], start : start + inner.size]", *changing, *made.row, by=8),
        *_indented("doubts = 0", points, *judged, "    line[j] = sure", "    doubts += doubt", by=8),
        *_indented("if doubts:", *_indented(*again), by=8),
        "    return count",
    ]


def _for_graphics(once: list[str], changing: list[str], made: Body) -> list[str]:
    """A thread takes what is dear once for each row, and then points; unsigned indices need no look at their sign."""
    return [
        "import numpy as np",
        "from numba import cuda",
        *CONSTANTS,
        f"STEP = np.uint64({THREADS})",
        "def kernel(fixed, limits, rows, kinds, outer, pieces, inner, out, doubts):",
        *_indented("i, p = cuda.blockIdx.x, cuda.blockIdx.y", *once, *changing, *made.row),
        *_indented("row, marked = rows[i], False", "line = out[row]"),
        *_indented("j, stop = np.uint64(pieces[p, 0] + cuda.threadIdx.x), np.uint64(pieces[p, 1])", "while j < stop:"),
        *_indented("x = inner[j]", *made.point, by=8),
        *_indented(f"line[j] = {OPEN} if doubt else {STABLE} if sure else 0", by=8),
        *_indented("marked = marked | doubt", "j += STEP", by=8),
        *_indented("if marked:", "    doubts[row] = 1"),
    ]


def _indented(*lines: str, by: int = 4) -> list[str]:
    return [" " * by + line for line in lines]


def needed(engine: str) -> Any:
    """Return the module of an engine, and refuse one that is unknown or not there."""
    if engine not in ENGINES:
        from ..errors import near_match

        raise UcritError(f"there is no engine '{engine}'{near_match(str(engine), ENGINES)}")
    try:
        numba = importlib.import_module("numba")
    except ImportError as error:
        raise MissingExtraError(f"the engine '{engine}' needs numba ({error}): pip install 'ucrit[fast]'") from None
    if engine != "cuda":
        return numba
    cuda = importlib.import_module("numba.cuda")
    if not cuda.is_available():
        raise UcritError(
            "the engine 'cuda' needs an NVIDIA GPU, its driver and CUDA libraries (pip install 'numba-cuda[cu12]'); "
            "none is found: take engine='numba' or 'numpy'"
        )
    return cuda


@cache
def processor_kernel(functions: Compiled, outer: tuple[int, ...], inner: int) -> Any:
    """Return the compiled function of `source`; compiled before, it is loaded."""
    numba = needed("numba")
    text = source(functions, outer, inner, "numba")
    path = _written(text)
    module = ModuleType(f"ucrit_{Path(path).stem}" if path else "ucrit_kernel")
    if path is not None:
        module.__file__ = path
        sys.modules[module.__name__] = module  # machine code that is loaded names the module it came from
    exec(compile(text, path or "<generated kernel>", "exec"), module.__dict__)
    options: dict[str, Any] = {
        "nogil": True,
        "error_model": "numpy",
        "cache": path is not None,
        "fastmath": {"contract"},
    }
    return numba.njit(**options)(module.__dict__["kernel"])


@cache
def graphics_kernel(functions: Compiled, outer: tuple[int, ...], inner: int) -> Any:
    """Return the compiled kernel of `source` for graphics processors."""
    cuda = needed("cuda")
    namespace: dict[str, Any] = {}
    exec(compile(source(functions, outer, inner, "cuda"), "<generated kernel>", "exec"), namespace)
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
