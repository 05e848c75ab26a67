"""Delays as they are: what is demanded leaves the model, and comes back into it one delay later as an input."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..core.contract.declare import Input, Output
from ..core.contract.model import Model
from ..core.made import made
from .actuators import Delay
from .closed import closed
from .controller import Controller
from .loop import chain_of


@dataclass(frozen=True)
class Late:
    """An ``input`` that is what a ``quantity``, a state or an output, was one delay before."""

    input: str
    quantity: str
    delay: str
    """Name of the parameter that holds the delay [s]."""


def _law(self: Any, u: Any) -> Any:
    return {self._input: getattr(u, f"{self._input}_late")}


def _outputs(self: Any, u: Any) -> Any:
    return {f"{self._input}_demanded": getattr(u, self._input)}


def _make_exact(approximate: type[Delay], input: str, unit: str, meaning: str) -> type[Controller]:
    """Make a delay as it is; the states of its approximation are kept for laws that feed them back."""
    body: dict[str, Any] = {"__doc__": "Delay as it is.", "stands_for": {f"{input}_late": input}}
    body[f"{input}_late"] = Input(unit, f"{meaning}, demanded one delay before")
    body[f"{input}_demanded"] = Output(unit, f"{meaning} that is demanded")
    body |= {"law": _law, "outputs": _outputs}
    return type("Exact", (approximate,), body)


def exactly_delayed(model: type[Model]) -> tuple[type[Model], list[Late]]:
    """Return a model with its delays as they are, and the inputs that are late; the model itself if it has none."""
    plant, chain = chain_of(model)
    found: list[Late] = []
    for controller in chain:
        if issubclass(controller, Delay) and "stands_for" not in vars(controller):
            name = controller._input
            quantity = plant.declaration.inputs[name]
            controller = made(_make_exact, controller, name, quantity.unit, quantity.meaning)
            found.append(Late(f"{name}_late", f"{name}_demanded", f"T_{name}"))
        plant = closed(plant, controller)
    return (plant, found) if found else (model, [])
