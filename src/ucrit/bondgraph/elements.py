"""The elements of bond graphs, as frozen data; a law is a number, a matrix, or a function written with operators.

Laws that a single number states, and what the number means: ``I`` an inertia (``momentum = m*flow``), ``C`` a
compliance (``displacement = c*effort``, so 1/k of a spring), ``R`` a resistance (``effort = r*flow``). A
transformer makes ``f_out = n*f_in, e_in = n*e_out``, a gyrator ``e_in = r*f_out, e_out = r*f_in``.

Source: D. Karnopp, D. Margolis and R. Rosenberg, System Dynamics (2000), chapters 3 and 4.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from ..core.errors import ModelError
from .laws import TAKES, Law, exact, linear_law, reading, stated_law

JUNCTIONS = ("0", "1")
SOURCES = ("Se", "Sf")
STORES = ("I", "C")
TWO_PORTS = ("TF", "GY")
KINDS = (*SOURCES, "I", "C", "R", *TWO_PORTS, *JUNCTIONS)
MODULATED = {"MSe": "Se", "MSf": "Sf", "MTF": "TF", "MGY": "GY", "MR": "R"}
"""Kinds whose law reads other elements, as they are drawn, and what they are otherwise."""


@dataclass(frozen=True)
class Element:
    """One element: its kind, its name and its law; junctions have none."""

    kind: str
    name: str
    law: Law | None = None

    def __post_init__(self) -> None:
        if not self.name.isidentifier():
            raise ModelError(f"{self.kind} '{self.name}': a name is made of letters, digits and _, a letter first")

    @property
    def label(self) -> str:
        """The kind as it is drawn: with an M where the law reads other elements."""
        modulated = {plain: letter for letter, plain in MODULATED.items()}
        return modulated[self.kind] if self.kind in modulated and self.law and self.law.reads else self.kind

    def __str__(self) -> str:
        return f"{self.kind}-junction '{self.name}'" if self.kind in JUNCTIONS else f"{self.label} '{self.name}'"


def zero(name: str) -> Element:
    """Return a 0-junction: one effort for all its bonds, whose flows add up to zero."""
    return Element("0", name)


def one(name: str) -> Element:
    """Return a 1-junction: one flow for all its bonds, whose efforts add up to zero."""
    return Element("1", name)


def Se(name: str, effort: Any) -> Element:
    """Return a source of effort: a force or a moment, given or read from other elements."""
    return Element("Se", name, Law("effort", "", (exact(effort),)))


def Sf(name: str, flow: Any) -> Element:
    """Return a source of flow: a velocity or a rate of turning, given or read from other elements."""
    return Element("Sf", name, Law("flow", "", (exact(flow),)))


def I(  # noqa: E743
    name: str,
    inertia: Any = None,
    *,
    momentum: Callable[..., Any] | Any = None,
    flow: Callable[..., Any] | Any = None,
) -> Element:
    """Return an inertia: a number or matrix, or momentum as a function of flow, or flow of momentum.

    >>> I("mass", 3).law.expressions
    (3*flow,)
    """
    return _passive("I", name, inertia, {"momentum": momentum, "flow": flow})


def C(
    name: str,
    compliance: Any = None,
    *,
    displacement: Callable[..., Any] | Any = None,
    effort: Callable[..., Any] | Any = None,
) -> Element:
    """Return a spring: its compliance, or displacement as a function of effort, or effort of displacement.

    >>> C("spring", effort=lambda z: 2 * z + z**3).law.expressions
    (displacement**3 + 2*displacement,)
    """
    return _passive("C", name, compliance, {"displacement": displacement, "effort": effort})


def R(
    name: str,
    resistance: Any = None,
    *,
    effort: Callable[..., Any] | Any = None,
    flow: Callable[..., Any] | Any = None,
) -> Element:
    """Return a resistance: a number or matrix, or effort as a function of flow, or flow of effort."""
    return _passive("R", name, resistance, {"effort": effort, "flow": flow})


def TF(name: str, ratio: Any) -> Element:
    """Return a transformer: ``f_out = ratio*f_in``, ``e_in = ratio*e_out``; an MTF where the ratio reads something."""
    return Element("TF", name, Law("ratio", "", (exact(ratio),)))


def GY(name: str, ratio: Any) -> Element:
    """Return a gyrator: ``e_in = ratio*f_out``, ``e_out = ratio*f_in``; an MGY where the ratio reads something."""
    return Element("GY", name, Law("ratio", "", (exact(ratio),)))


MTF, MGY, MSe, MSf = TF, GY, Se, Sf


def e(name: str, port: int | None = None) -> Any:
    """Return the effort of a 0-junction or one-port, to be read by a law."""
    return reading("e", name, port)


def f(name: str, port: int | None = None) -> Any:
    """Return the flow of a 1-junction or one-port, to be read by a law."""
    return reading("f", name, port)


def p(name: str, port: int | None = None) -> Any:
    """Return the momentum of an inertia, or the effort of a 0-junction added up over time."""
    return reading("p", name, port)


def q(name: str, port: int | None = None) -> Any:
    """Return the displacement of a spring, or the flow of a 1-junction added up over time."""
    return reading("q", name, port)


def renamed(element: Element, names: dict[str, str]) -> Element:
    """Return an element with another name that reads elements by their other names."""
    law = element.law
    if law is not None:
        from .laws import split

        parts = {symbol: split(symbol) for symbol in law.reads}
        law = law.replaced({s: reading(v, names.get(n, n), port) for s, (v, n, port) in parts.items()})
    return replace(element, name=names.get(element.name, element.name), law=law)


def _passive(kind: str, name: str, number: Any, laws: dict[str, Any]) -> Element:
    stated = {gives: law for gives, law in laws.items() if law is not None}
    if len(stated) + (number is not None) != 1:
        ways = " or ".join(f"{gives}=..." for gives in TAKES[kind])
        raise ModelError(f"{kind} '{name}': state its law once, by a number, a matrix or {ways}")
    if number is not None:
        return Element(kind, name, linear_law(kind, number))
    gives, law = stated.popitem()
    return Element(kind, name, stated_law(kind, gives, law))
