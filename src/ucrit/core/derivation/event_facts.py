"""Derived once per model: the values of its events and what they set."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import sympy as sp

from ..contract.events import WAYS, Event
from ..contract.methods import call
from ..contract.model import Model
from ..errors import ModelError, near_match
from ..formulas.codegen import generate
from .dimensions import check_sum
from .trace import groups_of, symbolic_instance, trace


def event_facts(model: type[Model]) -> dict[str, Any]:
    """Derive the values of a model's events and what they set, as functions of states, rates, inputs, parameters."""
    where = model.model_id()
    traced = trace(model, direction=None)
    instance = symbolic_instance(model, traced.parameters)
    count = len(model.declaration.variables)
    returned = call(instance.events, groups_of(model, list(traced.q[:count]), traced.u))  # type: ignore[attr-defined]
    if not isinstance(returned, Mapping):
        raise ModelError(f"{where}: events must be a dictionary of names and values, got {returned!r}")
    found = {name: e if isinstance(e, Event) else Event(e) for name, e in returned.items()}
    values = []
    for name, e in found.items():
        check_sum(traced, sp.sympify(e.value), f"{where}: event '{name}'")
        values.append(sp.Piecewise((e.value, e.during)))  # undefined, and without a sign, while it cannot happen
    places, settings = [], []
    states, inputs = [s.name for s in traced.states], list(model.declaration.inputs)
    for name, e in found.items():
        own = []
        for group, label, value in _settings(e):
            known = inputs if group == "u" else states
            if label not in known:
                raise ModelError(f"{where}: event '{name}' sets '{label}', no state or input{near_match(label, known)}")
            own.append(("u" if group == "u" else "w", known.index(label)))
            settings.append(sp.sympify(value))
        places.append(own)
    groups = [traced.states, traced.highest, traced.u, list(traced.parameters.values())]
    return {
        "names": list(found),
        "ends": [e.ends for e in found.values()],
        "ways": [WAYS[e.when] for e in found.values()],
        "starts": [e.from_start for e in found.values()],
        "values": generate("values", groups, values),
        "places": places,
        "settings": generate("settings", groups, settings),
    }


def _settings(e: Event) -> list[tuple[str, str, Any]]:
    """Return group, label and new value of what an event sets."""
    marks = {"x": "", "dx": "'", "ddx": "''", "u": ""}
    return [(group, name + marks[group], value) for group, given in e.after.items() for name, value in given.items()]
