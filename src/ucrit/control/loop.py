"""A vehicle under control as a model: its equations are the vehicle's own, with the law in place of driven inputs."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING, Any

from ..core.contract.methods import Names, as_tuple, call
from ..core.contract.model import Model
from ..core.errors import ModelError
from .controller import Controller

if TYPE_CHECKING:
    from ..core.derivation.trace import Traced, Written


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

    def written_loop(self, traced: Traced) -> Written:
        """Return the equations as people write them: the vehicle's, the controller's, and the law by the side."""
        from sympy import Symbol

        from ..core.derivation.trace import Written, groups_of, written

        plant, own, reaches = self._traced(), self._law(), dict(self._reaches)
        q = list(traced.q[: len(traced.q) - traced.multipliers])
        named = Names("y", {name: Symbol(name, real=True) for name in self._plant.declaration.outputs})
        seen = {**self._seen(groups_of(type(self), q, traced.u), {}), "y": named}
        inner = written(plant)
        swap = {s: Symbol(reaches[s.name], real=True) for s in plant.u if s.name in reaches}
        law = call(own.law, seen) if reaches else {}
        equations = as_tuple(call(own.equations, seen)) if hasattr(own, "equations") else ()
        outputs = call(own.outputs, seen) if hasattr(own, "outputs") else {}
        return Written(
            (*(r.xreplace(swap) for r in inner.residuals), *equations),
            {
                **{name: e.xreplace(swap) for name, e in inner.outputs.items()},
                **{Symbol(name, real=True): e for name, e in outputs.items()},
            },
            {
                **{name: e.xreplace(swap) for name, e in inner.law.items()},
                **{Symbol(reaches[name], real=True): value for name, value in law.items()},
            },
        )

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


def methods(plant: type[Model], controller: type[Controller]) -> dict[str, Any]:
    """Return the methods that a closed loop has only where its vehicle or its controller has them."""
    either = {"possible": _possible, "events": _events}
    found = {name: method for name, method in either.items() if hasattr(plant, name) or hasattr(controller, name)}
    return found | ({"drawing": _drawing} if hasattr(plant, "drawing") else {})


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


def _reaching(name: str) -> Any:
    """Return the symbol of what reaches the vehicle, while the input's own name may stand for a demand."""
    import sympy as sp

    return sp.Symbol(f"{name} that reaches the vehicle", real=True)


def _trace_once(plant: type[Model], direction: int | None) -> Any:
    from ..core.derivation.trace import trace

    return trace(plant, direction)


_trace: Any = cache(_trace_once)


def chain_of(model: type[Model]) -> tuple[Any, list[type[Controller]]]:
    """Return the vehicle's own model and its controllers, the first one closed first."""
    chain: list[type[Controller]] = []
    while issubclass(model, ClosedLoop):
        chain.insert(0, model._controller)
        model = model._plant
    return model, chain
