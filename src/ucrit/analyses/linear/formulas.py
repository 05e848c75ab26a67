"""Equations of a model in the shape in which people read them; needs SymPy, so imported only to derive."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

import sympy as sp

from ...core.contract.model import Model
from ...core.derivation.derive import symbolic
from ...core.derivation.linear import LinearSystem
from ...core.derivation.trace import Traced, written
from ...core.formulas import typeset as to
from ...core.formulas.factor import factored
from .pieces import named_pieces

LONGER = 2
"""An equation this many times longer multiplied out is left as stated: collecting may take minutes, and never won."""
DOTS = {1: ("\\dot", "&#729;"), 2: ("\\ddot", "&#168;")}


def derive(model: type[Model], sense: int) -> dict[str, Any]:
    """Return equations of motion, linear matrices and characteristic polynomial in text, LaTeX and MathML."""
    system = symbolic(model, sense)
    functions, traced, told = dict(system.polynomial.functions), system.traced, written(system.traced)
    defined = told.definitions
    found, pieces = named_pieces([*told.residuals, *defined.values()], _names(traced))
    equations, further = found[: len(told.residuals)], found[len(told.residuals) :]
    where = {**dict(zip(defined, further, strict=True)), **pieces}
    return {
        "equations": [_motion(_tidied(e, traced), traced) for e in equations],
        "definitions": {symbol.name: _motion(e, traced) for symbol, e in where.items()},
        "unknowns": [chain[0].name for chain in system.traced.q],
        "P": [_matrix(M) for M in _matrices(system)],
        "Q": _matrix(system.Q),
        "polynomial": [_plain(factored(a).xreplace(functions)) for a in system.polynomial.coefficients],
    }


def _names(traced: Traced) -> list[str]:
    declared = traced.model.declaration
    return [*declared.parameters, *declared.variables, *declared.inputs, *declared.outputs]


def _matrices(system: LinearSystem) -> list[Any]:
    P = list(system.P)
    while len(P) > 1 and P[-1].is_zero_matrix:
        P.pop()
    return P


def _matrix(M: Any) -> list[list[dict[str, str]]]:
    return [[_plain(_entry(e)) for e in M.row(i)] for i in range(M.rows)]


def _entry(e: Any) -> Any:
    return e if e.is_Atom else _shortest([sp.factor(e), sp.together(e), e])


def _shortest(candidates: Iterable[Any]) -> Any:
    return min(candidates, key=sp.count_ops)


def _plain(expression: Any) -> dict[str, str]:
    return {"text": to.text(expression), "latex": to.latex(expression), "mathml": to.mathml(expression)}


def _tidied(residual: Any, traced: Traced) -> Any:
    """Return the shortest of the equation as it was stated and as multiplied out with sin^2 + cos^2 = 1.

    Energies differentiated by the machine hold pairs such as ``a**2*sin(x)**2 + a**2*cos(x)**2``.
    """
    angles = {f.args[0] for f in residual.atoms(sp.sin, sp.cos)}
    flat = _expanded(residual)
    for angle in sorted(angles, key=str):
        flat = _expanded(flat.replace(sp.cos(angle) ** 2, 1 - sp.sin(angle) ** 2))
    if sp.count_ops(flat) > LONGER * sp.count_ops(residual):
        return residual
    fastest = [s for s in traced.highest if flat.has(s)]
    laws = sorted((f for f in flat.atoms(sp.Function) if not isinstance(f, sp.sin | sp.cos)), key=str)
    groups = [fastest, [*fastest, *laws]] if laws else [fastest]
    collected = [sp.collect(flat, keys, form) for keys in groups for form in (None, sp.factor)]
    return _shortest([residual, flat, *collected])


def _expanded(expression: Any) -> Any:
    """Multiply out, but not inside functions: slip angles stay as they were stated."""
    terms = [sp.expand_mul(sp.expand_power_base(t, deep=False), deep=False) for t in sp.Add.make_args(expression)]
    wider = sp.Add(*terms)
    return wider if wider == expression else _expanded(wider)


def _motion(expression: Any, traced: Traced) -> dict[str, str]:
    """Typeset an equation with dots for the time derivatives (primes in plain text)."""
    dotted, latex_names, mathml_names = {}, {}, {}
    for i, chain in enumerate(traced.q):
        for order, symbol in enumerate(chain[1:], 1):
            name = "Zz" + chr(ord("a") + i) + "q" * order  # letters only: digits would become subscripts
            dotted[symbol] = sp.Symbol(name, real=True)
            over, mark = DOTS[order]
            latex_names[name] = f"{over}{{{to.latex(chain[0])}}}"
            mathml_names[name] = f"<mover>{to.mathml(chain[0])}<mo>{mark}</mo></mover>"
    swapped = expression.xreplace(dotted)
    latex, mathml = to.latex(swapped), to.mathml(swapped)
    for name in sorted(latex_names, key=len, reverse=True):
        latex = latex_names[name].join(re.split(rf"{name}(?![a-z])", latex))
        mathml = mathml.replace(f"<mi>{name}</mi>", mathml_names[name])
    return {"text": to.text(expression), "latex": latex, "mathml": mathml}
