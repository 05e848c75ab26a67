"""What a model says: its quantities, its equations of motion, and what is derived from them."""

from __future__ import annotations

import inspect
import os
import sys
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from ...catalogue import BONDS, PUBLISHED, controller_names, find_model, load, model_names, vehicle_names
from ...core import html
from ...core.contract.declare import Input, Output, Parameter, Variable
from ...core.contract.model import Model
from ...core.errors import UcritError, near_match
from ...core.numeric.cache import cached
from ...core.numeric.compiled import direction
from ...core.record import Record
from ..stability.analyze import criteria_or_why
from ..stability.criteria import Criteria


@dataclass(frozen=True)
class Formula:
    """One expression in three notations; the text is read back by Python and SymPy."""

    text: str
    latex: str
    mathml: str

    def __str__(self) -> str:
        return self.text

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex}$"

    def _repr_html_(self) -> str:
        return f"<p>{html.math_of(self.mathml)}</p>"


class Polynomial(tuple[Formula, ...]):
    """Coefficients a_0, a_1, ... of a polynomial in s: a tuple that a notebook shows as formulas.

    >>> print(show("cart").polynomial)
    a_0 = 0
    a_1 = U*b*m
    a_2 = I_z + b**2*m
    """

    __slots__ = ()

    def __str__(self) -> str:
        return "\n".join(f"a_{k} = {coefficient}" for k, coefficient in enumerate(self))

    def _repr_html_(self) -> str:
        rows = [(html.Raw(f"<i>s</i><sup>{k}</sup>"), html.math_of(a.mathml)) for k, a in enumerate(self)]
        return html.table(rows, ("power", "coefficient"))

    def _repr_latex_(self) -> str:
        powers = ("", "s", *(f"s^{{{k}}}" for k in range(2, len(self))))
        terms = [f"\\left({a.latex}\\right) {s}" for a, s in zip(self, powers, strict=False) if a.text != "0"]
        return f"$\\displaystyle {' + '.join(terms)}$"


Matrix = tuple[tuple[Formula, ...], ...]


@dataclass(frozen=True)
class ModelDescription(Record):
    """What `show` finds.

    Attributes
    ----------
    model, title, notes
        Name, first line, and the remarks on axes and conventions.
    sources
        Where the equations that it is checked against are printed.
    equations
        Left-hand sides of the equations of motion; each is zero. ``theta'`` is the rate of ``theta``.
    definitions
        What further names in the equations stand for: inputs that a controller drives, by its law, and the outputs
        that it uses.
    unknowns
        Names of the columns of ``P``: the variables, then the constraint forces.
    P, Q
        Linear equations about the basic motion: ``P[0] q + P[1] q' + P[2] q'' = Q u``.
    polynomial
        Coefficients a_0, a_1, ... of the characteristic polynomial, of rising powers of s.
    criteria
        Conditions for stability; ``None`` where they would be too long.
    why_no_criteria
        Why these are not the conditions in all parameters; empty where they are.
    vehicle
        The vehicle that was asked about, ``None`` when it was a model.
    """

    model: str
    title: str
    notes: str
    sources: tuple[str, ...]
    parameters: tuple[Parameter, ...]
    variables: tuple[Variable, ...]
    inputs: tuple[Input, ...]
    outputs: tuple[Output, ...]
    equations: tuple[Formula, ...]
    definitions: dict[str, Formula]
    unknowns: tuple[str, ...]
    P: tuple[Matrix, ...]
    Q: Matrix
    polynomial: Polynomial
    criteria: Criteria | None
    why_no_criteria: str
    vehicle: Model | None

    def to_dict(self) -> dict[str, Any]:
        """Return the description as plain data, in the documented schema; expressions as text and LaTeX."""
        vehicle = self.vehicle
        return {
            "schema": 1,
            "model": {
                "name": self.model,
                "title": self.title,
                "notes": self.notes,
                "sources": list(self.sources),
            },
            "vehicle": None
            if vehicle is None
            else {
                **_info(vehicle),
                "parameters": {k: float(v) for k, v in vehicle.values.items()},
                **vehicle.info.tolerances.to_dict(),
            },
            "parameters": [
                {
                    "name": p.name,
                    "unit": p.unit,
                    "meaning": p.meaning,
                    "allowed": p.allowed,
                    "default": p.default,
                }
                for p in self.parameters
            ],
            "variables": [
                {"name": v.name, "unit": v.unit, "meaning": v.meaning, "order": v.order} for v in self.variables
            ],
            "inputs": [_quantity(q) for q in self.inputs],
            "outputs": [_quantity(q) for q in self.outputs],
            "equations": [_plain(f) for f in self.equations],
            "definitions": {name: _plain(f) for name, f in self.definitions.items()},
            "unknowns": list(self.unknowns),
            "P": [[[f.text for f in row] for row in M] for M in self.P],
            "Q": [[f.text for f in row] for row in self.Q],
            "polynomial": [_plain(f) for f in self.polynomial],
            "criteria": [
                {"name": c.name, "condition": str(c), "failure": c.failure, "latex": c.latex}
                for c in self.criteria or ()
            ],
        }

    def __str__(self) -> str:
        lines = [f"{self.model}: {self.title}", ""]
        lines += [f"{p.name:<10} {p.unit:<10} {p.meaning}, {p.allowed}" for p in self.parameters]
        defined = [f"{name} = {f}" for name, f in self.definitions.items()]
        return "\n".join([*lines, "", *(f"{f} = 0" for f in self.equations), *defined])

    def _repr_html_(self) -> str:
        rows = [(p.name, "" if p.unit == "1" else p.unit, p.meaning, p.allowed) for p in self.parameters]
        table = html.table(rows, ("parameter", "unit", "meaning", "allowed"), self.title)
        lines = [f"{f.mathml}<mo>=</mo><mn>0</mn>" for f in self.equations]
        lines += [f"<mi>{html.text(name)}</mi><mo>=</mo>{f.mathml}" for name, f in self.definitions.items()]
        equations = "".join(f'<p><math display="block"><mrow>{line}</mrow></math></p>' for line in lines)
        head = f"<p>{html.text(f'Characteristic polynomial of degree {len(self.polynomial) - 1}')}</p>"
        return table + equations + head + self.polynomial._repr_html_()


def show(
    subject: type[Model] | Model | str | os.PathLike[str], *, free: Sequence[str] | str | None = None
) -> ModelDescription:
    """Describe a model: quantities, equations of motion, matrices, characteristic polynomial, criteria.

    Parameters
    ----------
    subject
        A model class, a vehicle, or the name of one; also a vehicle file or a Python file with a model.
    free
        Parameters that the criteria of a vehicle keep as symbols, its numbers standing for the rest; all by default.
        ``"few"`` takes all too, but where that is too long the few that matter most, see `criteria`.

    Raises
    ------
    UcritError
        If there is no such model or vehicle, or its equations cannot be right.

    Examples
    --------
    >>> from ucrit import show
    >>> print(show("trailer-kinematic").equations[0])
    U*sin(theta) + theta'*(a + b)
    """
    model, vehicle = resolve(subject)
    sense = 1 if vehicle is None else direction(vehicle)
    facts = cached(model, f"show{sense:+d}", lambda: _derive(model, sense))
    if vehicle is None and free not in (None, "few"):
        raise UcritError(f"{model.model_id()}: free parameters need a vehicle, whose values the others take")
    found, why = criteria_or_why(model, vehicle, sense, free)
    declared = model.declaration
    return ModelDescription(
        model=model.model_id(),
        title=model.title(),
        notes=_notes(model),
        sources=_sources(model),
        parameters=tuple(declared.parameters.values()),
        variables=tuple(declared.variables.values()),
        inputs=tuple(declared.inputs.values()),
        outputs=tuple(declared.outputs.values()),
        equations=_formulas(facts["equations"]),
        definitions={name: Formula(**fact) for name, fact in facts["definitions"].items()},
        unknowns=tuple(facts["unknowns"]),
        P=tuple(_matrix(M) for M in facts["P"]),
        Q=_matrix(facts["Q"]),
        polynomial=Polynomial(_formulas(facts["polynomial"])),
        criteria=found,
        why_no_criteria=why,
        vehicle=vehicle,
    )


def resolve(subject: type[Model] | Model | str | os.PathLike[str]) -> tuple[type[Model], Model | None]:
    """Return a model class, and the vehicle if it was one that was named."""
    if isinstance(subject, Model):
        return type(subject), subject
    if isinstance(subject, type):
        return subject, None
    name = os.fspath(subject)
    if ".py" in name or name.endswith(BONDS) or name.replace("_", "-") in model_names():
        return find_model(name), None
    if name in vehicle_names() or name.endswith(".toml") or os.sep in name or os.path.isfile(name):
        vehicle = load(name)
        return type(vehicle), vehicle
    if name.replace("_", "-") in controller_names():
        raise UcritError(f"'{name}' is a controller: it can be shown alone, and judged with a vehicle")
    raise UcritError(f"there is no model or vehicle '{name}'{near_match(name, [*model_names(), *vehicle_names()])}")


def _info(vehicle: Model) -> dict[str, str]:
    info = asdict(vehicle.info)
    return {key: info[key] for key in ("name", "source", "file")}


def _quantity(quantity: Input | Output) -> dict[str, str]:
    return {"name": quantity.name, "unit": quantity.unit, "meaning": quantity.meaning}


def _plain(formula: Formula) -> dict[str, str]:
    return {"text": formula.text, "latex": formula.latex}


def _formulas(facts: Sequence[Mapping[str, str]]) -> tuple[Formula, ...]:
    return tuple(Formula(**fact) for fact in facts)


def _matrix(rows: Sequence[Sequence[Mapping[str, str]]]) -> Matrix:
    return tuple(_formulas(row) for row in rows)


def _notes(model: type[Model]) -> str:
    """Remarks of the model's file and class, without the title."""
    module = sys.modules.get(model.__module__)
    own = model.__module__.startswith("ucrit.models.")
    described = (inspect.getdoc(model) or "").partition("\n")[2]
    texts = ((module and own and module.__doc__) or "", described)
    return "\n\n".join(text.strip() for text in texts if text.strip())


def _sources(model: type[Model]) -> tuple[str, ...]:
    """Sources named in the file of published equations and numbers, if the model has one."""
    path = PUBLISHED / f"{model.__module__.rpartition('.')[2]}.toml"
    if not (model.__module__.startswith("ucrit.models.") and path.is_file()):
        return ()
    groups = tomllib.loads(path.read_text(encoding="utf-8")).values()
    entries = [e for group in groups if isinstance(group, list) for e in group]
    return tuple(dict.fromkeys(e["source"] for e in entries if isinstance(e, dict) and "source" in e))


def _derive(model: type[Model], sense: int) -> dict[str, Any]:
    from ..linear import formulas

    return formulas.derive(model, sense)
