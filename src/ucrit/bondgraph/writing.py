"""Bond graphs written as text; see `ucrit.bondgraph.text` for the form."""

from __future__ import annotations

import math
from collections.abc import Mapping

from ..core.contract.declare import Input, Parameter
from ..core.errors import ModelError
from .elements import Element
from .formulas import unnamed
from .graph import ARROW, Graph
from .laws import is_plain
from .text import BOUNDS


def write_graph(graph: Graph) -> str:
    """Return a graph as text that `read_graph` reads back to an equal one.

    Raises
    ------
    ModelError
        If a law holds a function that the text form has no name for.
    """
    lines = [_element_line(element) for element in graph.elements]
    return "\n".join([*lines, *(f"{b.tail} {ARROW} {b.head}" for b in graph.bonds)])


def write_sheet(title: str, parameters: Mapping[str, Parameter], inputs: Mapping[str, Input], graph: Graph) -> str:
    """Return a graph with the declarations of its parameters as text."""
    lines = [f"title {title}"] if title else []
    for name, p in parameters.items():
        if p.is_speed:
            given = "" if p.default is None else f" default {p.default:.17g}"
            lines.append(f"speed {name}{'' if p.above >= 0 else ' reverse'}{given}: {p.meaning}")
            continue
        bounds = [
            f"{b} {getattr(p, b):.17g}" for b in BOUNDS if getattr(p, b) is not None and math.isfinite(getattr(p, b))
        ]
        lines.append(" ".join(["param", name, f"[{p.unit}]", *bounds]) + f": {p.meaning}")
    lines += [f"input {name} [{u.unit}]: {u.meaning}" for name, u in inputs.items()]
    return "\n".join([*lines, *([""] if lines else []), write_graph(graph)]) + "\n"


def _element_line(element: Element) -> str:
    law = element.law
    if law is None:
        return f"{element.kind} {element.name}"
    for x in law.expressions:
        if (odd := unnamed(x)) is not None:
            raise ModelError(f"{element}: the text form has no name for {odd}")
    sign = " =" if is_plain(law) else ":"
    return f"{element.label} {element.name}{sign} {law}"
