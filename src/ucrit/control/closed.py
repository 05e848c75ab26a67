"""The closed loop: the vehicle's own equations with the law in place of the inputs that the controller drives."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any, ClassVar

from ..core.declare import Input, Output, Parameter
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
    if not isinstance(vehicle, Model):
        raise UcritError(f"close takes a vehicle; for a model without numbers take closed; got {vehicle!r}")
    model = closed(type(vehicle), *controllers)
    found = model(**{**vehicle.values, **values})
    found.__dict__["info"] = vehicle.info
    return found


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
        plant = made(_close, plant, _cut_of(plant, input))
    for controller in chain:
        plant = made(_close, plant, controller)
        if not cut and input in plant.declaration.inputs:  # an input that a controller brought: a desired value
            plant, cut = made(_close, plant, _cut_of(plant, input)), True
    return plant  # type: ignore[no-any-return]


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


def driven(model: type[Model]) -> list[str]:
    """Return the inputs of the vehicle itself, without controllers, that are driven."""
    plant, chain = chain_of(model)
    names = dict.fromkeys(name for controller in chain for name in controller.drives)
    return [name for name in names if name in plant.declaration.inputs]


def chain_of(model: type[Model]) -> tuple[Any, list[type[Controller]]]:
    """Return the vehicle's own model and its controllers, the first one closed first."""
    chain: list[type[Controller]] = []
    while issubclass(model, ClosedLoop):
        chain.insert(0, model._controller)
        model = model._plant
    return model, chain


def _close(plant: type[Model], controller: type[Controller]) -> type[Model]:
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
    if hasattr(plant, "possible") or hasattr(controller, "possible"):
        body["possible"] = _possible
    body |= {"drawing": _drawing} if hasattr(plant, "drawing") else {}
    body |= {"events": _events} if hasattr(plant, "events") or hasattr(controller, "events") else {}
    return type(f"{plant.__name__}With{controller.__name__}", (ClosedLoop,), body)


def _free(name: str, taken: Mapping[str, Any]) -> str:
    """Return a name that is not taken: a second controller in line reports its own demand."""
    found, number = name, 1
    while found in taken:
        number += 1
        found = f"{name}_{number}"
    return found


def _events(self: ClosedLoop, x: Any, dx: Any, ddx: Any, u: Any) -> Any:
    """Return the events of vehicle and controller."""
    groups = {"x": x, "dx": dx, "ddx": ddx, "u": u}
    given, found = self._driven(groups), {}
    if hasattr(self._plant, "events"):
        driven = {name: given[_reaching(name)] for name in self._controller.drives}
        found = dict(call(self._bound(self._plant).events, {**groups, "u": Names("u", {**_named(u), **driven})}))
    if hasattr(self._controller, "events"):
        found |= call(self._law().events, self._seen(groups, given))
    return found


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
    _reaches: tuple[tuple[str, str], ...]

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
        residuals = [self._inner(r).xreplace(driven) for r in plant.residuals]
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
        found = {name: self._inner(e).xreplace(driven) for name, e in zip(names, plant.outputs, strict=True)}
        found |= {name: driven[_reaching(given)] for given, name in self._reaches}
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
        for name, of in getattr(self._controller, "stands_for", {}).items():
            if of in given["u"]:
                given["u"][name] = given["u"][of]
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

    def _inner(self, expression: Any) -> Any:
        """Return an expression of the vehicle with other symbols for the inputs that are driven."""
        plant = self._traced()
        return expression.xreplace({s: _reaching(s.name) for s in plant.u if s.name in self._controller.drives})

    def _driven(self, groups: Mapping[str, Any]) -> dict[Any, Any]:
        """Return the symbols of the driven inputs with what the law puts in their place."""
        import sympy as sp

        drives = self._controller.drives
        given = call(self._law().law, self._seen(groups, {})) if drives else {}
        if set(given) != set(drives):
            odd = ", ".join(sorted(set(given).symmetric_difference(drives)))
            raise ModelError(f"{self._controller.model_id()}: what the law returns and what it drives differ in {odd}")
        law = {_reaching(name): sp.sympify(value) for name, value in given.items()}
        if any(value.has(*law) for value in law.values()):
            solved = sp.solve([s - value for s, value in law.items()], list(law), dict=True)
            if len(solved) != 1:
                raise ModelError(f"{self.model_id()}: the law and an output that it uses depend on one another")
            law = dict(solved[0])
        return law

    def _seen(self, groups: Mapping[str, Any], driven: Mapping[Any, Any]) -> dict[str, Any]:
        """Return the groups that a law may ask for."""
        plant = self._traced()
        outputs = dict(zip(self._plant.declaration.outputs, plant.outputs, strict=True))
        y = Names("y", {name: self._inner(e).xreplace(dict(driven)) for name, e in outputs.items()})
        x0 = Names("x0", {c[0].name: plant.basic.get(c[0], 0) for c in plant.q})
        u0 = Names("u0", {s.name: plant.basic.get(s, 0) for s in plant.u})
        return {**groups, "y": y, "x0": x0, "u0": u0}


def _reaching(name: str) -> Any:
    """Return the symbol of what reaches the vehicle, while the input's own name may stand for a demand."""
    import sympy as sp

    return sp.Symbol(f"{name} that reaches the vehicle", real=True)


def _trace_once(plant: type[Model], direction: int | None) -> Any:
    from ..core.trace import trace

    return trace(plant, direction)


_trace: Any = cache(_trace_once)
