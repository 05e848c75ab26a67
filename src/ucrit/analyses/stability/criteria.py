"""Which inequalities between the parameters decide stability, in symbols.

The characteristic polynomial is stable if its coefficients and every second Hurwitz determinant are positive
(A. Lienard and M. H. Chipart, J. Math. Pures Appl. 10 (1914) 291-346). Each is factored; factors that the declared
bounds make positive are dropped. What is left is the criterion.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ...core.contract.model import Model
from ...core.errors import UcritError, near_match
from ...core.formulas.codegen import build
from ...core.numeric.cache import cached
from ...core.numeric.compiled import direction as direction_of
from ...core.numeric.reach import extremes
from ...core.record import Record

if TYPE_CHECKING:
    from ...core.derivation.characteristic import CharacteristicPolynomial, Part


@dataclass(frozen=True)
class Boundary:
    """A critical value in closed form: ``parameter**power = expression``."""

    parameter: str
    power: int
    expression: str
    latex: str
    mathml: str

    def __str__(self) -> str:
        left = self.parameter if self.power == 1 else f"{self.parameter}**{self.power}"
        return f"{left} = {self.expression}"


@dataclass(frozen=True)
class Criterion(Record):
    """One inequality ``expression > 0`` that stability needs.

    Attributes
    ----------
    name
        ``a_0`` (a coefficient) or ``H_3`` (a Hurwitz determinant) of the characteristic polynomial.
    expression, latex, mathml
        What is left of it after dropping the factors that are positive by their bounds.
    dropped
        The factors that were dropped.
    failure
        ``"divergence"`` when a real root passes through zero as it fails, ``"flutter"`` when a pair of roots passes
        through the imaginary axis, ``"order"`` when a root passes through infinity.
    boundaries
        Closed forms of the parameter values at which it fails, where these are linear or purely quadratic.
    """

    name: str
    expression: str
    latex: str
    mathml: str
    dropped: tuple[str, ...]
    failure: str
    boundaries: tuple[Boundary, ...]
    source: str = field(repr=False)
    parameters: tuple[str, ...] = field(repr=False)

    @cached_property
    def _function(self) -> Callable[..., tuple[Any, ...]]:
        return build(self.source, "criterion")

    def value(self, vehicle: Model) -> Any:
        """Return the value of the left-hand side for a vehicle, an array where its parameters are arrays."""
        arguments = dict(zip(vehicle.values, vehicle.arguments(), strict=True))
        return self._function([arguments[name] for name in self.parameters])[0]

    def holds(self, vehicle: Model) -> bool:
        """Return whether a vehicle (with scalar parameters) meets it; exactly where doubles overflow."""
        with np.errstate(all="ignore"):
            value = self.value(vehicle)
        if np.isfinite(value) and not extremes(vehicle):
            return bool(value > 0)
        exact = build(self.source, "criterion", exact=True)
        try:
            return bool(exact([Fraction(float(vehicle.values[name])) for name in self.parameters])[0] > 0)
        except ArithmeticError:
            return False

    def boundary(self, parameter: str) -> Boundary | None:
        """Return the closed form for one parameter, if there is one."""
        return next((b for b in self.boundaries if b.parameter == parameter), None)

    def __str__(self) -> str:
        return f"{self.expression} > 0"

    def _repr_html_(self) -> str:
        from ...core.html import math_of

        return f"<p>{math_of(self.mathml, '> 0')}</p>"

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex} > 0$"


@dataclass(frozen=True)
class Criteria(Record):
    """The conditions for stability of a model, in symbols.

    Attributes
    ----------
    conditions
        The inequalities that are not settled by the parameters' bounds; all must hold.
    kind
        ``"asymptotic"``, or ``"neutral"`` where no motion decays and stability can only be neutral.
    settled
        ``True``: stable for all allowed parameters; ``False``: for none; ``None``: it depends.
    zeros
        Number of roots that are zero whatever the parameters; they were divided out.
    order
        Degree of the characteristic polynomial without these.
    conflict
        Where it is ``False`` because two conditions cannot both hold: their left-hand sides.
    free
        The parameters that are symbols, ``None`` for all; a vehicle's numbers stand for the others.
    """

    model: str
    conditions: tuple[Criterion, ...]
    kind: str
    settled: bool | None
    zeros: int
    order: int
    conflict: tuple[str, ...] = ()
    free: tuple[str, ...] | None = None

    @property
    def scope(self) -> str:
        """What the conditions are about, in words: all parameters that are allowed, or the values of some."""
        return "allowed parameters" if self.free is None else f"allowed values of {in_words(self.free)}"

    def __str__(self) -> str:
        word = "stable" if self.kind == "asymptotic" else "neutrally stable"
        if self.settled is not None:
            needs = " and ".join(f"{expression} > 0" for expression in self.conflict)
            why = f": it needs {needs}, which cannot both hold" if needs else ""
            return f"{self.model}: {word if self.settled else 'unstable'} for all {self.scope}{why}"
        numbers = "" if self.free is None else f" in {in_words(self.free)}, the vehicle's numbers for the rest"
        lines = [f"{self.model}{numbers}: {word} if and only if"]
        return "\n".join([*lines, *(f"    {condition}" for condition in self.conditions)])

    def _repr_html_(self) -> str:
        from ..results import notebook

        return notebook.criteria(self)

    def _repr_latex_(self) -> str:
        return r"$\displaystyle " + r" \quad\wedge\quad ".join(f"{c.latex} > 0" for c in self.conditions) + "$"

    def __iter__(self) -> Any:
        return iter(self.conditions)

    def failing(self, vehicle: Model) -> tuple[Criterion, ...]:
        """Return the conditions that a vehicle (with scalar parameters) does not meet."""
        return tuple(c for c in self.conditions if not c.holds(vehicle))


def criteria(
    model: type[Model] | Model, *, direction: int | None = None, free: Sequence[str] | str | None = None
) -> Criteria:
    """Derive the conditions for stability in symbols.

    Parameters
    ----------
    model
        A model class, or a vehicle (needed for ``free``).
    direction
        +1 forward, -1 backing up; that of the vehicle's speed by default.
    free
        Parameters to keep as symbols; the vehicle's values are put in for the others. ``"few"`` chooses those that
        the critical speed depends on most, as many as give conditions that can be read. Needed above order 6 or so,
        where fully symbolic conditions have too many terms.

    Returns
    -------
    Criteria
        Conditions, each with the kind of failure it guards against.

    Raises
    ------
    UcritError
        If the conditions would be too long to be read, ``free`` names no parameter, or the vehicle has arrays.
    """
    cls = model if isinstance(model, type) else type(model)
    if free == "few":
        return _in_few(model, cls)
    if isinstance(free, str):
        free = [name for name in re.split(r"[\s,]+", free) if name]
    sense = direction or (1 if isinstance(model, type) else direction_of(model))
    values: dict[str, Any] = {}
    kept: dict[str, Any] = {}
    if free is not None:
        if isinstance(model, type):
            raise UcritError(f"{cls.model_id()}: free parameters need a vehicle, whose values the others take")
        for name in free:
            if name not in model.values:
                raise UcritError(f"{cls.model_id()}: there is no parameter '{name}'{near_match(name, model.values)}")
        if model.dims:
            raise UcritError(
                f"criteria with free parameters need scalar values, got arrays for {', '.join(model.dims)}"
            )
        values = {name: value for name, value in model.values.items() if name not in free}
        kept = {name: model.values[name] for name in free}
    key = f"criteria{sense:+d}" + "".join(f"-{k}={v!r}" for k, v in [*values.items(), *kept.items()])
    piece = key if not values else f"criteria-{_short_hash(repr(list(kept)) + key)}"
    facts = cached(cls, piece, lambda: _derive(cls, sense, values, kept))
    if "refused" in facts:
        raise UcritError(facts["refused"])
    conditions = tuple(
        Criterion(
            **{
                **c,
                "dropped": tuple(c["dropped"]),
                "parameters": tuple(c["parameters"]),
                "boundaries": tuple(Boundary(**b) for b in c["boundaries"]),
            }
        )
        for c in facts["conditions"]
    )
    plain = facts["kind"], facts["settled"], facts["zeros"], facts["order"]
    symbols = None if free is None else tuple(kept)
    return Criteria(cls.model_id(), conditions, *plain, tuple(facts.get("conflict", ())), symbols)


def in_words(names: Sequence[str]) -> str:
    """Return names as a list in words.

    >>> in_words(["U", "a", "b"])
    'U, a and b'
    """
    return " and ".join(text for text in (", ".join(names[:-1]), *names[-1:]) if text)


def _in_few(model: type[Model] | Model, cls: type[Model]) -> Criteria:
    from .few import few_criteria

    if isinstance(model, type):
        raise UcritError(f"{cls.model_id()}: the few that matter most are a vehicle's; give one with its numbers")
    found = few_criteria(model)
    if found is None:
        raise UcritError(
            f"{cls.model_id()}: no parameter gives conditions that can be read; critical gives the values of one "
            "parameter at which they fail"
        )
    return found


def _short_hash(text: str) -> str:
    import hashlib

    return hashlib.sha256(text.encode()).hexdigest()[:16]


def _derive(cls: type[Model], direction: int, values: Mapping[str, Any], kept: Mapping[str, Any]) -> dict[str, Any]:
    from ...core.derivation.derive import symbolic
    from .conditions import conditions

    system = symbolic(cls, direction)
    if values:
        full, symbols = system.polynomial, system.traced.parameters
        system = system.substituted({symbols[name]: _rational(v) for name, v in values.items()})
        if system.polynomial.zeros > full.zeros:  # a_0 vanishes for these numbers: a root stays at zero
            order = full.order - full.zeros
            return {"conditions": [], "kind": "asymptotic", "settled": False, "zeros": full.zeros, "order": order}
        polynomial = _with_sign_of(system.polynomial, {symbols[name]: _rational(v) for name, v in kept.items()})
    else:
        polynomial = system.polynomial
    parameters = [symbol for name, symbol in system.traced.parameters.items() if name not in values]
    try:
        return conditions(polynomial, parameters, cls.model_id())
    except UcritError as error:  # kept like a result: finding out that it is too long takes long too
        if not values:
            return {"refused": str(error)}
        free = ", ".join(symbol.name for symbol in parameters)
        return {
            "refused": f"{cls.model_id()}: the conditions in {free} are too long to be read; "
            "critical gives the values of one parameter at which they fail"
        }


def _rational(value: Any) -> Any:
    import sympy as sp

    return sp.Rational(str(value))


def _with_sign_of(polynomial: CharacteristicPolynomial, point: Mapping[Any, Any]) -> CharacteristicPolynomial:
    """Return a polynomial whose factors' first coefficients are positive for the vehicle."""
    functions = dict(polynomial.functions)

    def signed(part: Part) -> Part:
        first = part[-1].as_expr().xreplace(functions).subs(point)
        return part if first >= 0 else tuple(-a for a in part)

    return replace(polynomial, parts=tuple(map(signed, polynomial.parts)))
