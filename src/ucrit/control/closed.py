"""The closed loop: the vehicle's own equations with the law in place of the inputs that the controller drives."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

from ..core.declare import Output, Parameter
from ..core.errors import ModelError, UcritError, near_match
from ..core.made import made
from ..core.model import Model, Names, as_tuple, call
from .controller import Controller


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
        plant = made(_close, plant, controller)
    return plant


def close(vehicle: Model, *controllers: type[Controller], **values: Any) -> Model:
    """Return a vehicle under control: its own parameters, and values for the controllers' (gains).

    Raises
    ------
    UcritError
        If a value is missing, misspelt or not allowed; see also `closed`.
    """
    model = closed(type(vehicle), *controllers)
    found = model(**{**vehicle.values, **values})
    found.__dict__["info"] = vehicle.info
    return found


def _close(plant: type[Model], controller: type[Controller]) -> type[Model]:
    """Make the class of the closed loop."""
    theirs, ours, where = plant.declaration, controller.declaration, controller.model_id()
    for name in controller.drives:
        if name not in theirs.inputs:
            raise ModelError(
                f"{where}: {plant.model_id()} has no input '{name}' to drive{near_match(name, theirs.inputs)}"
            )
    if not controller.drives:
        raise ModelError(f"{where}: say which inputs of the vehicle it drives, as in drives = ('delta_f',)")
    body: dict[str, Any] = {**theirs.parameters, **theirs.variables, **theirs.inputs, **theirs.outputs}
    for name, quantity in {**ours.parameters, **ours.variables, **ours.inputs, **ours.outputs}.items():
        shared = isinstance(quantity, Parameter) and isinstance(body.get(name), Parameter)
        if name in body and not (shared and quantity.dimension == body[name].dimension):
            raise ModelError(f"{where}: {plant.model_id()} has a '{name}' already, {body[name].meaning}")
        body.setdefault(name, quantity)
    for name in controller.drives:
        body[name] = Output(theirs.inputs[name].unit, theirs.inputs[name].meaning)
    body |= {"_plant": plant, "_controller": controller, "__doc__": _title(plant, controller)}
    body |= {"even": (*getattr(plant, "even", ()), *getattr(controller, "even", ()))}
    body |= {"mirror": getattr(plant, "mirror", True) and getattr(controller, "mirror", True)}
    body |= {"sides": (*getattr(plant, "sides", ()), *getattr(controller, "sides", ()))}
    body |= {name: getattr(plant, name) for name in ("keeps_speed", "wheel_loads", "valid") if hasattr(plant, name)}
    if hasattr(plant, "possible") or hasattr(controller, "possible"):
        body["possible"] = _possible
    body |= {name: own for name, own in {"events": _events, "drawing": _drawing}.items() if hasattr(plant, name)}
    return type(f"{plant.__name__}With{controller.__name__}", (ClosedLoop,), body)


def _events(self: ClosedLoop, x: Any, dx: Any, ddx: Any, u: Any) -> Any:
    """Return the vehicle's events."""
    groups = {"x": x, "dx": dx, "ddx": ddx, "u": u}
    driven = {symbol.name: value for symbol, value in self._driven(groups).items()}
    return call(self._bound(self._plant).events, {**groups, "u": Names("u", {**_named(u), **driven})})


def _drawing(self: ClosedLoop, x: Any, u: Any) -> Any:
    """Return the vehicle's drawing, its driven inputs at rest: a wheel is shown straight."""
    rest = dict.fromkeys(self._controller.drives, 0.0)
    return call(self._bound(self._plant).drawing, {"x": x, "u": Names("u", {**_named(u), **rest})})


def _named(group: Any) -> dict[str, Any]:
    return {name: value for name, value in vars(group).items() if not name.startswith("_")}


def _possible(self: ClosedLoop) -> dict[str, Any]:
    """Return what values must be possible together, for vehicle and controller."""
    stated = [self._bound(cls) for cls in (self._plant, self._controller) if hasattr(cls, "possible")]
    return {statement: true for instance in stated for statement, true in instance.possible().items()}


def _title(plant: type[Model], controller: type[Controller]) -> str:
    law = controller.title().rstrip(".")
    return f"{plant.title().rstrip('.')}, under control: {law[:1].lower()}{law[1:]}."


class ClosedLoop(Model):
    """Base of all vehicles under control; made by `closed`."""

    _plant: type[Model]
    _controller: type[Controller]

    @classmethod
    def model_id(cls) -> str:
        """Names of vehicle and controller."""
        return f"{cls._plant.model_id()} with {cls._controller.model_id()}"

    @classmethod
    def ingredients(cls) -> dict[str, Any]:
        """Return model, parts and controllers as vehicle files name them."""
        found = cls._plant.ingredients()
        return {**found, "controllers": [*found.get("controllers", []), cls._controller.model_id()]}

    def closed_loop(self, q: Any, groups: Mapping[str, Names]) -> tuple[list[Any], list[Any]]:
        """Return the residuals of vehicle and controller, and the multipliers of the vehicle's constraints."""
        plant, driven = self._traced(), self._driven(groups)
        own = self._law()
        residuals = [r.xreplace(driven) for r in plant.residuals]
        if hasattr(own, "equations"):
            seen = self._seen(groups, driven)
            end = len(residuals) - plant.multipliers
            residuals[end:end] = as_tuple(call(own.equations, seen))
        return residuals, [chain[0] for chain in plant.q[len(plant.q) - plant.multipliers :]]

    def outputs(self, x: Any, dx: Any, ddx: Any, u: Any) -> dict[str, Any]:
        """Return the vehicle's outputs, the driven inputs and the controller's outputs."""
        groups = {"x": x, "dx": dx, "ddx": ddx, "u": u}
        plant, driven = self._traced(), self._driven(groups)
        own, names = self._law(), self._plant.declaration.outputs
        found = {name: e.xreplace(driven) for name, e in zip(names, plant.outputs, strict=True)}
        found |= {symbol.name: value for symbol, value in driven.items()}
        return {**found, **(call(own.outputs, self._seen(groups, driven)) if hasattr(own, "outputs") else {})}

    def basic_motion(self) -> dict[str, dict[str, Any]]:
        """Return the vehicle's basic motion and the controller's own."""
        declared = type(self).declaration
        own = self._law()
        given: dict[str, dict[str, Any]] = {"x": {}, "dx": {}, "u": {}}
        for instance in (self._bound(self._plant), own):
            if hasattr(instance, "basic_motion"):
                for group, values in instance.basic_motion().items():
                    given.setdefault(group, {}).update(values)
        given["u"] = {name: value for name, value in given["u"].items() if name in declared.inputs}
        return given

    def _bound(self, cls: type[Model]) -> Any:
        instance = object.__new__(cls)
        values = {name: self.__dict__[name] for name in cls.declaration.parameters}
        instance.__dict__.update(values, _values=values, _shared={})
        return instance

    def _law(self) -> Any:
        return self._bound(self._controller)

    def _traced(self) -> Any:
        name = self._plant.declaration.speed
        U = self.__dict__[name] if name else None
        return _trace(self._plant, 1 if U is None or U.is_positive else -1 if U.is_negative else None)

    def _driven(self, groups: Mapping[str, Any]) -> dict[Any, Any]:
        """Return the symbols of the driven inputs and what the law puts in their place."""
        import sympy as sp

        plant, drives = self._traced(), self._controller.drives
        symbols = {s.name: s for s in plant.u if s.name in drives}
        given = call(self._law().law, self._seen(groups, {}))
        if set(given) != set(drives):
            odd = ", ".join(sorted(set(given).symmetric_difference(drives)))
            raise ModelError(f"{self._controller.model_id()}: what the law returns and what it drives differ in {odd}")
        law = {symbols[name]: sp.sympify(value) for name, value in given.items()}
        if not any(value.has(*symbols.values()) for value in law.values()):
            return law
        solved = sp.solve([s - value for s, value in law.items()], list(law), dict=True)
        if len(solved) != 1:
            raise ModelError(f"{self.model_id()}: the law and an output that it uses depend on one another")
        return dict(solved[0])

    def _seen(self, groups: Mapping[str, Any], driven: Mapping[Any, Any]) -> dict[str, Any]:
        """Return the groups that a law may ask for."""
        plant = self._traced()
        outputs = dict(zip(self._plant.declaration.outputs, plant.outputs, strict=True))
        y = Names("y", {name: e.xreplace(dict(driven)) for name, e in outputs.items()})
        x0 = Names("x0", {c[0].name: plant.basic.get(c[0], 0) for c in plant.q})
        u0 = Names("u0", {s.name: plant.basic.get(s, 0) for s in plant.u})
        return {**groups, "y": y, "x0": x0, "u0": u0}


def _trace_once(plant: type[Model], direction: int | None) -> Any:
    from ..core.trace import trace

    return trace(plant, direction)


_trace: Any = cache(_trace_once)
