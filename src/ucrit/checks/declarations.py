"""Is everything that is declared explained and used?"""

from __future__ import annotations

import re

from .report import FailedCheckError
from .subject import Subject

YEAR = re.compile(r"\b1[6-9]\d\d|20\d\d\b")


def declarations(subject: Subject) -> str:
    """Every quantity has a meaning and is used; the class says in its description where it comes from."""
    model = subject.model
    described = model.__dict__.get("__doc__") or ""
    if not described.strip():
        raise FailedCheckError("the class has no description")
    if not YEAR.search(described):
        raise FailedCheckError("the class's description names no source with its year")
    declared = model.declaration
    quantities = {**declared.parameters, **declared.variables, **declared.inputs, **declared.outputs}
    for name, quantity in quantities.items():
        if not quantity.meaning.strip():
            raise FailedCheckError(f"{name} has no meaning")
    for name, parameter in declared.parameters.items():
        if parameter.default is not None and not parameter.allows(parameter.default):
            raise FailedCheckError(f"the default of {name} must be {parameter.allowed}, got {parameter.default:g}")
    return f"{len(quantities)} quantities with unit and meaning"


def used(subject: Subject) -> str:
    """Every parameter, variable and input occurs in the equations or outputs, but for what a part need not use."""
    traced = subject.traced
    of_parts = {name for slot in subject.model.declaration.slots.values() for name in slot.declared}
    occurring = set().union(*(e.free_symbols for e in (*traced.residuals, *traced.outputs, *traced.basic.values())))
    for name, symbol in {
        **traced.parameters,
        **dict(zip(subject.model.declaration.inputs, traced.u, strict=True)),
    }.items():
        if symbol not in occurring and name not in of_parts:
            raise FailedCheckError(f"{name} is declared and never used")
    for chain in traced.q:
        if chain[-1] not in occurring:
            raise FailedCheckError(f"{chain[-1]}, the highest derivative declared, does not occur in the equations")
    return "every parameter, variable and input occurs in the equations"


def equations(subject: Subject) -> str:
    """Units agree in every term, unknowns and equations in number, and the basic motion is a solution."""
    for direction in subject.directions:
        subject.system(direction).polynomial  # noqa: B018, deriving is the check
    count = len(subject.traced.residuals)
    return f"{count} equation{'s' * (count > 1)} with matching units, solved by the basic motion"
