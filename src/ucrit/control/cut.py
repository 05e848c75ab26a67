"""A loop that is cut where an input enters the vehicle: what goes in there, and what comes back."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from ..core.contract.declare import Input, Output
from ..core.contract.model import Model
from ..core.errors import UcritError
from ..core.made import made
from .closed import close_once
from .controller import Controller
from .loop import chain_of


def broken(model: type[Model], input: str) -> type[Model]:
    """Return a model under control whose loop is cut where an input enters the vehicle.

    Parameters
    ----------
    model
        Made by `closed`.
    input
        An input of the vehicle, ``delta_f``, that some controller drives. Where several do, one after the other, the
        loop is cut next to the vehicle.

    Returns
    -------
    type[Model]
        With the input ``delta_f_cut``, which the vehicle gets, and the output ``delta_f_return``, which comes back
        from the controllers. The loop's transfer function is minus that from one to the other.

    Raises
    ------
    UcritError
        If no controller drives the input.
    """
    plant, chain = chain_of(model)
    known_names = [name for controller in chain for name in controller.drives]
    if input not in known_names:
        known = ", ".join(dict.fromkeys(known_names)) or "none"
        raise UcritError(f"{model.model_id()}: no controller drives '{input}'; driven inputs: {known}")
    cut = input in plant.declaration.inputs
    if cut:
        plant = made(close_once, plant, _cut_of(plant, input))
    for controller in chain:
        plant = made(close_once, plant, controller)
        if not cut and input in plant.declaration.inputs:  # an input that a controller brought: a desired value
            plant, cut = made(close_once, plant, _cut_of(plant, input)), True
    return plant  # type: ignore[no-any-return]


def driven(model: type[Model]) -> list[str]:
    """Return the inputs of the vehicle itself, without controllers, that are driven."""
    plant, chain = chain_of(model)
    names = dict.fromkeys(name for controller in chain for name in controller.drives)
    return [name for name in names if name in plant.declaration.inputs]


class _Cut(Controller):
    """Cut of the loop, next to the vehicle."""

    through = True
    stands_for: ClassVar[Mapping[str, str]] = {}
    _cut = ""

    def law(self, u: Any) -> Any:
        return {self._cut: getattr(u, f"{self._cut}_cut")}

    def outputs(self, u: Any) -> Any:
        return {f"{self._cut}_return": getattr(u, self._cut)}


def _make_cut(input: str, unit: str, meaning: str) -> type[Controller]:
    body: dict[str, Any] = {"drives": (input,), "_cut": input, "__doc__": _Cut.__doc__}
    body["stands_for"] = {f"{input}_cut": input}
    body[f"{input}_cut"] = Input(unit, f"{meaning} where the loop is cut")
    body[f"{input}_return"] = Output(unit, f"{meaning} that comes back")
    return type("Cut", (_Cut,), body)


def _cut_of(plant: type[Model], input: str) -> type[Controller]:
    quantity = plant.declaration.inputs[input]
    return made(_make_cut, input, quantity.unit, quantity.meaning)  # type: ignore[no-any-return]
