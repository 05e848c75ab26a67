"""Constitutive laws as expressions: from Python functions of what they take, inverted where another causality needs it.

A law gives one variable of each port from another one: a mass gives momentum from flow, ``momentum = m*flow``.
What it takes is written ``flow``, ``effort``, ``momentum`` or ``displacement``, in fields ``flow_1``, ``flow_2`` ...
It may read other elements: ``f.x`` is the flow of the 1-junction or one-port x, ``e.x`` an effort, ``p.x`` and
``q.x`` momentum and displacement; ``p.x.2`` belongs to the second port of a field. Such readings are signals.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..core.errors import ModelError
from .formulas import formula

VARIABLES = ("effort", "flow", "momentum", "displacement")
READINGS = ("e", "f", "p", "q")


@dataclass(frozen=True)
class Law:
    """What an element gives, what it takes for that, and the expressions that relate them, one a port.

    ``gives`` is ``"ratio"`` for transformers and gyrators; nothing is taken by these and by sources.
    """

    gives: str
    takes: str
    expressions: tuple[Any, ...]

    @property
    def ports(self) -> int:
        """Number of ports."""
        return len(self.expressions)

    @property
    def taken(self) -> tuple[Any, ...]:
        """Symbols of what is taken, one a port."""
        return placeholders(self.takes, self.ports)

    @property
    def reads(self) -> tuple[Any, ...]:
        """Symbols of what is read from other elements, sorted by name."""
        found = {symbol for x in self.expressions for symbol in x.free_symbols if is_reading(symbol)}
        return tuple(sorted(found, key=str))

    @property
    def coefficients(self) -> Any:
        """Matrix of a linear law, ``None`` for any other."""
        import sympy as sp

        if not self.takes:
            return None
        rows = [[sp.diff(x, t) for t in self.taken] for x in self.expressions]
        matrix = sp.Matrix(self.ports, self.ports, [entry for row in rows for entry in row])
        rest = [sp.expand(x.xreplace(dict.fromkeys(self.taken, sp.S.Zero))) for x in self.expressions]
        constant = not matrix.free_symbols & set(self.taken) and not any(rest)
        return matrix if constant else None

    def replaced(self, swap: Mapping[Any, Any]) -> Law:
        """Return the law with symbols replaced."""
        return Law(self.gives, self.takes, tuple(x.xreplace(dict(swap)) for x in self.expressions))

    def solved(self, where: str, given: Sequence[bool], taken: Sequence[Any], gives: Sequence[Any]) -> list[Any]:
        """Return the unknown of each port: what the law gives, or what it takes where ``given`` says it is known.

        ``taken`` and ``gives`` are the symbols of the two variables of each port.
        """
        import sympy as sp

        swap = dict(zip(self.taken, taken, strict=True))
        right = [x.xreplace(swap) for x in self.expressions]
        if not any(given):
            return right
        unknown = [t if known else g for known, t, g in zip(given, taken, gives, strict=True)]
        residuals = [g - x for g, x in zip(gives, right, strict=True)]
        found = _solve(residuals, unknown)
        if found is None:
            raise ModelError(
                f"{where}: its law gives {self.gives} and cannot be solved for {self.takes}, which its causality "
                f"asks for; state the law as {self.takes}=... too, or change what sets its {self.gives}"
            )
        return [sp.sympify(x) for x in found]

    def __str__(self) -> str:
        if not self.takes:
            return formula(self.expressions[0])
        if is_plain(self):
            rows = [", ".join(map(formula, self.coefficients.row(i))) for i in range(self.ports)]
            return rows[0] if self.ports == 1 else "[" + "; ".join(rows) + "]"
        given = [self.gives] if self.ports == 1 else [f"{self.gives}_{k}" for k in range(1, self.ports + 1)]
        return "; ".join(f"{g} = {formula(x)}" for g, x in zip(given, self.expressions, strict=True))


def is_plain(law: Law) -> bool:
    """Tell whether a number or a matrix says it all, as it does of sources, ratios and linear laws of the usual way."""
    return not law.takes or ((law.gives, law.takes) in LINEAR and law.coefficients is not None)


LINEAR = (("momentum", "flow"), ("displacement", "effort"), ("effort", "flow"))
"""Laws that a single number or a matrix states: I, C and R in this order."""

TAKES = {
    "I": {"momentum": "flow", "flow": "momentum"},
    "C": {"displacement": "effort", "effort": "displacement"},
    "R": {"effort": "flow", "flow": "effort"},
}
"""What a law of a kind may give, and what it takes for it."""


def placeholders(name: str, ports: int) -> tuple[Any, ...]:
    """Return the symbols of what a law of so many ports takes."""
    import sympy as sp

    if not name:
        return ()
    names = [name] if ports == 1 else [f"{name}_{k}" for k in range(1, ports + 1)]
    return tuple(sp.Symbol(n, real=True) for n in names)


def reading(variable: str, name: str, port: int | None = None) -> Any:
    """Return the symbol of a variable of another element: ``reading("f", "axle")``."""
    import sympy as sp

    return sp.Symbol(f"{variable}.{name}" + ("" if port is None else f".{port}"), real=True)


def is_reading(symbol: Any) -> bool:
    """Tell whether a symbol stands for a variable of an element."""
    return "." in symbol.name and symbol.name.partition(".")[0] in READINGS


def split(symbol: Any) -> tuple[str, str, int | None]:
    """Return variable, element and port of a reading; the port is ``None`` where none is named."""
    variable, name, *port = symbol.name.split(".")
    return variable, name, int(port[0]) if port else None


def linear_law(kind: str, value: Any) -> Law:
    """Return the law of a single number or a square matrix: ``momentum = m*flow``."""
    import sympy as sp

    gives = next(iter(TAKES[kind]))
    is_matrix = isinstance(value, list | tuple) or hasattr(value, "shape")
    matrix = sp.Matrix(value) if is_matrix else sp.Matrix([[exact(value)]])
    if matrix.rows != matrix.cols:
        raise ModelError(f"{kind}: a field needs a square matrix, got {matrix.rows} rows and {matrix.cols} columns")
    taken = sp.Matrix(placeholders(TAKES[kind][gives], matrix.rows))
    return Law(gives, TAKES[kind][gives], tuple(matrix.applyfunc(exact) * taken))


def stated_law(kind: str, gives: str, law: Callable[..., Any] | Any, ports: int | None = None) -> Law:
    """Return a law from a function of what it takes, or from an expression in the placeholders."""
    takes = TAKES[kind][gives]
    if callable(law) and not hasattr(law, "free_symbols"):
        count = len(inspect.signature(law).parameters)
        law = law(*placeholders(takes, count))
    values = tuple(law) if isinstance(law, list | tuple) else (law,)
    if ports is not None and ports != len(values):
        raise ModelError(f"{kind}: the law has {len(values)} results for {ports} ports")
    return Law(gives, takes, tuple(exact(x) for x in values))


def exact(value: Any) -> Any:
    """Return a number or expression with its decimal numbers as fractions."""
    import sympy as sp

    expression = sp.sympify(value)
    floats = {f: sp.Rational(str(f)) for f in expression.atoms(sp.Float)}
    return expression.xreplace(floats) if floats else expression


def _solve(residuals: list[Any], unknown: list[Any]) -> list[Any] | None:
    """Return the one solution of equations that are zero; ``None`` where there is none or there are several."""
    import sympy as sp
    from sympy.solvers.solveset import NonlinearError

    try:
        A, b = sp.linear_eq_to_matrix(residuals, unknown)
    except NonlinearError:
        if len(unknown) > 1:
            return None
        try:
            found = sp.solve(residuals[0], unknown[0])
        except NotImplementedError:
            return None
        return found if len(found) == 1 else None
    return solve_linear(A, b)


def solve_linear(A: Any, b: Any) -> list[Any] | None:
    """Return the solution of a small linear system, ``None`` where its determinant is zero."""
    import sympy as sp

    determinant = sp.expand(A.det(method="berkowitz"))
    if is_zero(determinant):
        return None
    if A.rows == 1:
        return [sp.factor_terms(b[0] / determinant)]
    return [sp.factor_terms(x) / determinant for x in A.adjugate() * b]


def is_zero(expression: Any) -> bool:
    """Tell whether an expression vanishes whatever its symbols, from its values at points taken at random.

    Forty digits are computed; that anything but zero vanishes at all three points has no chance worth naming.
    """
    import random

    import mpmath
    import sympy as sp

    expression = sp.sympify(expression)
    symbols = sorted(expression.free_symbols, key=str)
    if not symbols:
        return bool(sp.simplify(expression) == 0)
    terms = sp.lambdify(symbols, list(sp.Add.make_args(expression)), "mpmath", cse=True)
    rng = random.Random(len(symbols))
    with mpmath.workdps(40):
        for _ in range(3):
            values = terms(*(mpmath.mpf(rng.uniform(0.1, 1)) for _ in symbols))
            if abs(mpmath.fsum(values)) > mpmath.mpf(10) ** -25 * mpmath.fsum(map(abs, values)):
                return False
    return True
