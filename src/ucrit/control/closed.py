"""Vehicle and controller put together: the class of the closed loop, with the declarations of both."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..core.contract.declare import Output, Parameter
from ..core.contract.model import Model
from ..core.errors import ModelError, UcritError, near_match
from ..core.made import made
from .controller import Controller
from .loop import ClosedLoop, methods


def closed(plant: type[Model], *controllers: type[Controller]) -> type[Model]:
    """Return the model of a vehicle under control; every analysis applies to it.

    Parameters
    ----------
    plant
        A model with inputs.
    controllers
        Closed one after the other: an actuator that drives ``delta_f`` and has an input ``delta_demand`` comes
        before the law that drives ``delta_demand``.

    Returns
    -------
    type[Model]
        With the parameters, states and inputs of vehicle and controllers, but for the inputs that are driven: those
        become outputs.

    Raises
    ------
    ModelError
        If a controller drives what is no input, or its names mean something else in the vehicle.
    """
    for controller in controllers:
        if not (isinstance(controller, type) and issubclass(controller, Controller)):
            raise UcritError(f"a controller must be a class derived from Controller, got {controller!r}")
        plant = made(close_once, plant, controller)
    return plant


def close(vehicle: Model, *controllers: type[Controller], **values: Any) -> Model:
    """Return a vehicle under control: its own parameters, and values for the controllers' (gains).

    Raises
    ------
    UcritError
        If a value is missing, misspelt or not allowed; see also `closed`.
    """
    if not isinstance(vehicle, Model):
        raise UcritError(f"close takes a vehicle; for a model without numbers take closed; got {vehicle!r}")
    model = closed(type(vehicle), *controllers)
    found = model(**{**vehicle.values, **values})
    found.__dict__["info"] = vehicle.info
    return found


def close_once(plant: type[Model], controller: type[Controller]) -> type[Model]:
    """Make the class of the closed loop."""
    theirs, ours, where = plant.declaration, controller.declaration, controller.model_id()
    for name in controller.drives:
        if name not in theirs.inputs:
            raise ModelError(
                f"{where}: {plant.model_id()} has no input '{name}' to drive{near_match(name, theirs.inputs)}"
            )
    if not (controller.drives or ours.variables or ours.outputs):
        raise ModelError(f"{where}: say which inputs of the vehicle it drives, as in drives = ('delta_f',)")
    body: dict[str, Any] = {**theirs.parameters, **theirs.variables, **theirs.inputs, **theirs.outputs}
    for name, quantity in {**ours.parameters, **ours.variables, **ours.inputs, **ours.outputs}.items():
        shared = isinstance(quantity, Parameter) and isinstance(body.get(name), Parameter)
        if name in body and not (shared and quantity.dimension == body[name].dimension):
            raise ModelError(f"{where}: {plant.model_id()} has a '{name}' already, {body[name].meaning}")
        body.setdefault(name, quantity)
    reaches = []
    for name in controller.drives:
        unit, meaning = theirs.inputs[name].unit, theirs.inputs[name].meaning
        reaches.append((name, _free(f"{name}_actual", body) if controller.through else name))
        body[reaches[-1][1]] = Output(unit, f"{meaning} that is reached" if controller.through else meaning)
    body |= {"_plant": plant, "_controller": controller, "__doc__": _title(plant, controller)}
    body |= {"_reaches": tuple(reaches)}
    body |= {"even": (*getattr(plant, "even", ()), *getattr(controller, "even", ()))}
    body |= {"mirror": getattr(plant, "mirror", True) and getattr(controller, "mirror", True)}
    body |= {"sides": (*getattr(plant, "sides", ()), *getattr(controller, "sides", ()))}
    body |= {"twins": {**getattr(plant, "twins", {}), **getattr(controller, "twins", {})}}
    body |= {name: getattr(plant, name) for name in ("keeps_speed", "wheel_loads", "valid") if hasattr(plant, name)}
    body |= {"mode_names": plant.mode_names}
    body |= methods(plant, controller)
    return type(f"{plant.__name__}With{controller.__name__}", (ClosedLoop,), body)


def _free(name: str, taken: Mapping[str, Any]) -> str:
    """Return a name that is not taken: a second controller in line reports its own demand."""
    found, number = name, 1
    while found in taken:
        number += 1
        found = f"{name}_{number}"
    return found


def _title(plant: type[Model], controller: type[Controller]) -> str:
    law = controller.title().rstrip(".")
    return f"{plant.title().rstrip('.')}, under control: {law[:1].lower()}{law[1:]}."
