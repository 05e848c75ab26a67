"""What a controller of the catalogue says: its quantities and its law, as text."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from typing import Any

from ...catalogue import find_controller
from ...control import Controller
from ...core.contract.declare import Input, Output, Parameter, Variable
from ...core.contract.methods import as_tuple, call
from ...core.contract.model import Model
from ...core.html import Rich


@dataclass(frozen=True)
class ControllerDescription(Rich):
    """What `describe_controller` finds.

    Attributes
    ----------
    controller, title, notes
        Name, first line, and the remarks on signs.
    drives
        Names of the vehicle's inputs that it drives.
    through
        Whether these stay inputs, as demands.
    law
        Formula of each driven input.
    equations
        Left-hand sides of the controller's own equations; each is zero.
    """

    controller: str
    title: str
    notes: str
    drives: tuple[str, ...]
    through: bool
    parameters: tuple[Parameter, ...]
    variables: tuple[Variable, ...]
    inputs: tuple[Input, ...]
    outputs: tuple[Output, ...]
    law: dict[str, str]
    equations: tuple[str, ...]

    def to_dict(self) -> dict[str, Any]:
        """Return the description as plain data."""
        groups = {"parameters": self.parameters, "variables": self.variables}
        more: dict[str, Any] = {"inputs": self.inputs, "outputs": self.outputs}
        return {
            "schema": 1,
            "controller": {"name": self.controller, "title": self.title, "notes": self.notes},
            "drives": list(self.drives),
            "through": self.through,
            **{
                key: [{"name": q.name, "unit": q.unit, "meaning": q.meaning} for q in group]
                for key, group in {**groups, **more}.items()
            },
            "law": self.law,
            "equations": list(self.equations),
        }

    def __str__(self) -> str:
        laws = [f"{name} = {text}" for name, text in self.law.items()]
        return "\n".join([f"{self.controller}: {self.title}", *laws, *(f"{e} = 0" for e in self.equations)])


class _Symbols:
    """Any name as a symbol: a law is run without knowing its vehicle."""

    def __init__(self, primes: str = "") -> None:
        self._primes = primes

    def __getattr__(self, name: str) -> Any:
        import sympy as sp

        if name.startswith("__"):
            raise AttributeError(name)
        return sp.Symbol(name + self._primes, real=True)


def describe_controller(subject: type[Controller] | str) -> ControllerDescription:
    """Describe a controller: quantities, what it drives, its law.

    Parameters
    ----------
    subject
        A controller's class, or its name in the catalogue.

    Raises
    ------
    UcritError
        If there is no such controller.

    Examples
    --------
    >>> print(describe_controller("yaw-rate-feedback").law["delta_f"])
    G*(-r + r_d)
    """
    from ...core.derivation.trace import parameter_symbol, symbolic_instance

    cls: type[Model] = find_controller(subject) if isinstance(subject, str) else subject
    declared = cls.declaration
    law: Any = symbolic_instance(cls, {name: parameter_symbol(p, 1) for name, p in declared.parameters.items()})
    plain = _Symbols()
    groups: Any = {"x": plain, "dx": _Symbols("'"), "ddx": _Symbols("''"), "u": plain, "y": plain}
    groups |= {"x0": _Symbols("_0"), "u0": _Symbols("_0")}
    module = sys.modules.get(cls.__module__)
    return ControllerDescription(
        controller=cls.model_id(),
        title=cls.title(),
        notes=((module and module.__doc__) or "").strip() if cls.__module__.startswith("ucrit.control.laws") else "",
        drives=cls.drives,  # type: ignore[attr-defined]
        through=cls.through,  # type: ignore[attr-defined]
        parameters=tuple(declared.parameters.values()),
        variables=tuple(declared.variables.values()),
        inputs=tuple(declared.inputs.values()),
        outputs=tuple(declared.outputs.values()),
        law={name: str(value) for name, value in call(law.law, groups).items()} if hasattr(law, "law") else {},
        equations=tuple(str(e) for e in as_tuple(call(law.equations, groups))) if hasattr(law, "equations") else (),
    )
