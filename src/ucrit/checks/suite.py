"""The checks, in the order in which they run: what is cheap and tells most comes first."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from ..core.errors import UcritError
from . import (
    bonds,
    conservation,
    declarations,
    derivations,
    double_entry,
    eigenvalues,
    mirror,
    numeric,
    scaling,
    stability,
)
from .report import Check, NotApplicableError
from .subject import Subject

CHECKS: tuple[tuple[str, Callable[[Subject], str]], ...] = (
    ("declarations", declarations.declarations),
    ("equations", declarations.equations),
    ("everything is used", declarations.used),
    ("published polynomial", double_entry.polynomial),
    ("published equations", double_entry.matrices),
    ("published state matrix", double_entry.state_matrix),
    ("published transfer functions", double_entry.transfer),
    ("published motion", derivations.published_motion),
    ("further derivations", derivations.derivations),
    ("bond graph", bonds.bond_graph),
    ("bond graph in motion", bonds.bond_graph_in_motion),
    ("published critical values", stability.critical),
    ("published criteria", stability.criterion),
    ("published numbers", eigenvalues.numbers),
    ("change of units", scaling.scaling),
    ("mirror symmetry", mirror.mirror),
    ("energy balance", conservation.energy),
    ("conserved quantities", conservation.conserved),
    ("compiled functions", numeric.functions),
    ("linearisation", numeric.linearisation),
    ("derived criterion", stability.derived_criterion),
)
DERIVING = "equations"


def run(subject: Subject) -> Iterator[Check]:
    """Run the checks one by one; where the equations cannot be derived the rest is not run."""
    derived = True
    for name, function in CHECKS:
        check = _run(name, function, subject) if derived else Check(name, None, "not run without equations")
        derived &= not (name == DERIVING and check.passed is False)
        yield check


def _run(name: str, function: Callable[[Subject], Any], subject: Subject) -> Check:
    try:
        return Check(name, True, function(subject))
    except NotApplicableError as reason:
        return Check(name, None, f"does not apply: {reason}")
    except UcritError as error:
        return Check(name, False, str(error))
    except Exception as error:  # a user's equations may raise anything
        return Check(name, False, f"{type(error).__name__}: {error}")
