"""The equations of motion, the derivation and the criterion, typeset as the report does."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..analyses.about.show import show
from ..analyses.stability.analyze import analyze
from ..report import derivation, tables
from .answers import say_speed

if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..core.contract.model import Model

HERE = Path(__file__).resolve().parent


def equations(vehicle: Model, body: Mapping[str, Any]) -> dict[str, Any]:
    """Return a piece of page with MathML: conditions for stability, then the steps that lead to them."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(
        loader=FileSystemLoader(HERE), autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    found, described, say = analyze(vehicle, advise=False, free="few"), show(vehicle), say_speed(body)
    content = {
        "why": "" if found.criteria else found.why_no_criteria,
        "scope": found.criteria.scope if found.criteria else "",
        "in_few": found.criteria is not None and found.criteria.free is not None,
        "settled": found.criteria.settled if found.criteria else None,
        "neutral": bool(found.criteria and found.criteria.kind == "neutral"),
        "criteria": tables.criteria(found),
        "critical": [
            (say(c.value), row["closed"])
            for c, row in zip(found.critical or (), tables.critical(tuple(found.critical or ())), strict=True)
            if row["closed"]
        ],
        "steps": derivation.steps(described),
        "sources": described.sources,
    }
    return {"html": environment.get_template("equations.html.jinja").render(content)}
