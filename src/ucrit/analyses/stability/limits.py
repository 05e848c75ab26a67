"""What a model becomes when parameters grow without bound or vanish: rigid tires, a stiff hitch, no
relaxation length.

One symbolic operation on the characteristic polynomial gives the model of lower order, its criteria and the
roots that are lost; whether leaving those out is harmless is told too.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from itertools import permutations
from typing import Any

import numpy as np

from ...core.contract.model import Model
from ...core.derivation.limits import check_names, limit_polynomial
from ...core.errors import UcritError
from ...core.formulas.codegen import build
from ...core.numeric.cache import cached
from ...core.numeric.compiled import direction as direction_of
from ...core.record import Record
from .criteria import Boundary, Criteria, Criterion


@dataclass(frozen=True)
class LostRoots:
    """Roots that do not stay finite, or go to zero, in a limit.

    Attributes
    ----------
    parameter
        The parameter whose limit it is.
    count
        Number of roots.
    power
        They behave like this power of the parameter.
    fast
        Whether they go to infinity; to zero otherwise.
    stable
        ``True``: they decay; ``False``: at least one grows; ``None``: that depends on the parameters, or
        they are undamped to leading order.
    criteria
        The conditions for their decay; ``None`` where they would be too long to be read.
    """

    parameter: str
    count: int
    power: float
    fast: bool
    stable: bool | None
    criteria: Criteria | None

    def __str__(self) -> str:
        where = "infinity" if self.fast else "zero"
        number = f"{self.count} root{'s go' if self.count > 1 else ' goes'}"
        like = self.parameter if self.power == 1 else f"{self.parameter}**{self.power:g}"
        if self.criteria and self.criteria.kind == "neutral" and self.stable is None:
            how = "undamped to leading order"
        else:
            how = {True: "decaying", False: "growing", None: "decaying under conditions of their own"}[self.stable]
        return f"{number} to {where} like {like}, {how}"


@dataclass(frozen=True)
class LimitResult(Record):
    """A model in the limit of some of its parameters.

    Attributes
    ----------
    model
        Name of the model.
    to
        Limits by parameter, in the order in which they were taken.
    polynomial
        Coefficients of the characteristic polynomial that is left, ascending in s, as text.
    text, latex, mathml
        The polynomial as a whole, highest power first.
    criteria
        Conditions for the stability of what is left; ``None`` where they would be too long to be read.
    lost
        The roots that are not in it.
    order_matters
        Whether another order of the limits gives another polynomial.
    """

    model: str
    to: dict[str, float]
    polynomial: tuple[str, ...]
    text: str
    latex: str
    mathml: str
    criteria: Criteria | None
    lost: tuple[LostRoots, ...]
    order_matters: bool
    source: str = field(repr=False)
    parameters: tuple[str, ...] = field(repr=False)

    @property
    def order(self) -> int:
        """Degree of the polynomial that is left."""
        return len(self.polynomial) - 1

    @cached_property
    def _coefficients(self) -> Callable[..., tuple[Any, ...]]:
        return build(self.source, "coefficients")

    def roots(self, vehicle: Model) -> Any:
        """Return the roots [1/s] that the limit leaves, for the other parameters of a vehicle (scalars)."""
        values = [float(vehicle.values[name]) for name in self.parameters]
        return np.roots([float(c) for c in self._coefficients(values)][::-1])

    def __str__(self) -> str:
        taken = ", ".join(f"{name} -> {'infinity' if value else '0'}" for name, value in self.to.items())
        left = f"{self.text} = 0" if self.order else "no root stays finite"
        lines = [f"{self.model}, {taken}:", f"    {left}", *(f"    {lost}" for lost in self.lost)]
        if self.order_matters:
            lines.append("    another order of these limits gives another result")
        too_long = f"{self.model}: the conditions for stability are too long to be read"
        why = str(self.criteria) if self.criteria else too_long
        return "\n".join([*lines, *(why.splitlines() if self.order else [])])

    def _repr_html_(self) -> str:
        from ..results import notebook

        return notebook.limit(self)

    def _repr_latex_(self) -> str:
        return rf"$\displaystyle {self.latex} = 0$"


def limit(model: type[Model] | Model, *, direction: int | None = None, **to: float) -> LimitResult:
    """Let parameters of a model grow without bound or vanish, and tell what is left.

    Parameters
    ----------
    model
        A model class, or a vehicle, whose numbers play no part.
    direction
        +1 forward, -1 backing up; that of the vehicle's speed by default.
    **to
        ``math.inf`` or 0 for each parameter. Limits are taken one after the other, in the order given.

    Returns
    -------
    LimitResult
        The polynomial that is left, its criteria, and the roots that are lost.

    Raises
    ------
    UcritError
        If there is no such parameter, a limit is neither infinity nor 0, or no limit is given.

    Examples
    --------
    >>> from math import inf
    >>> from ucrit import find_model
    >>> rigid_tires = limit(find_model("trailer-undamped-hitch"), C=inf)
    >>> [str(condition) for condition in rigid_tires.criteria]
    ['a*b*m - I_c > 0']
    """
    cls = model if isinstance(model, type) else type(model)
    sense = direction or (1 if isinstance(model, type) else direction_of(model))
    if not to:
        raise UcritError(f"{cls.model_id()}: name the parameters that go to infinity or 0, such as C=math.inf")
    check_names(cls, to)
    for name, value in to.items():
        if value not in (math.inf, 0):
            raise UcritError(f"{cls.model_id()}: the limit of {name} must be infinity or 0, got {value!r}")
    piece = f"limit{sense:+d}" + "".join(f"-{name}{'inf' if value else '0'}" for name, value in to.items())
    facts = cached(cls, piece, lambda: _derive(cls, sense, to))
    lost = tuple(LostRoots(**{**entry, "criteria": _criteria(cls, entry["criteria"])}) for entry in facts["lost"])
    return LimitResult(
        cls.model_id(),
        dict(to),
        tuple(facts["polynomial"]),
        facts["text"],
        facts["latex"],
        facts["mathml"],
        _criteria(cls, facts["criteria"]),
        lost,
        facts["order_matters"],
        facts["source"],
        tuple(facts["parameters"]),
    )


def _criteria(cls: type[Model], facts: dict[str, Any] | None) -> Criteria | None:
    if facts is None:
        return None
    found = tuple(
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
    return Criteria(cls.model_id(), found, facts["kind"], facts["settled"], facts["zeros"], facts["order"])


def _derive(cls: type[Model], direction: int, to: dict[str, float]) -> dict[str, Any]:
    from ...core.derivation.derive import symbolic
    from ...core.formulas import typeset
    from ...core.formulas.codegen import generate
    from ..linear.polynomials import in_s, product

    system = symbolic(cls, direction)
    parameters = list(system.traced.parameters.values())
    polynomial, escapes = limit_polynomial(system, to)
    orders = [limit_polynomial(system, dict(order))[0] for order in permutations(to.items())] if len(to) < 4 else []
    left = [product(a, polynomial.functions) for a in polynomial.coefficients]
    lost = []
    for escape in escapes:
        found = _conditions(escape.polynomial, parameters)
        neutral = found is not None and found["kind"] == "neutral" and found["settled"] is not False
        stable = None if neutral or found is None else found["settled"]
        lost.append(
            {
                "parameter": escape.parameter,
                "count": escape.count,
                "power": float(escape.power) * (1 if to[escape.parameter] else -1),
                "fast": escape.power > 0,
                "stable": stable,
                "criteria": found,
            }
        )
    return {
        "polynomial": [typeset.text(a) for a in left],
        **in_s(left),
        "criteria": _conditions(polynomial, parameters),
        "lost": lost,
        "order_matters": any(other.coefficients != polynomial.coefficients for other in orders),
        "source": generate("coefficients", [parameters], polynomial.expressions),
        "parameters": [p.name for p in parameters],
    }


def _conditions(polynomial: Any, parameters: list[Any]) -> dict[str, Any] | None:
    """Return the conditions for stability, ``None`` where they are too long: the limit is worth having without them."""
    from .conditions import conditions

    try:
        return conditions(polynomial, parameters, "limit")
    except UcritError:
        return None
