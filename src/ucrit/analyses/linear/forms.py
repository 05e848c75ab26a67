"""The forms in which linear equations of motion are written, and the way from each to each.

One equation of n-th order, state space, second-order sets and the descriptor form are all cases of
``sum_k P_k q^(k) = 0`` and go over into one another through it, in exact arithmetic with numbers and symbols.
Eigenvalues are the same in all of them (Karnopp 2004, section 3.II).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.html import Rich

Array = npt.NDArray[Any]


@dataclass(frozen=True)
class LinearForm(Rich):
    """What all forms share: entries are exact, numbers taken as the decimals they print, symbols allowed."""

    title: ClassVar[str]

    @property
    def matrices(self) -> tuple[Any, ...]:
        """``(P_0, P_1, ...)`` of the equations ``sum_k P_k q^(k) = 0`` that the form is a case of."""
        raise NotImplementedError

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the variables q."""
        return tuple(f"x{i}" for i in range(1, self.matrices[0].rows + 1))

    @cached_property
    def coefficients(self) -> tuple[Any, ...]:
        """Ascending coefficients of the characteristic polynomial; in numbers the last of them is 1."""
        from ...core.derivation.characteristic import characteristic_polynomial

        found = characteristic_polynomial(self.matrices, "linear equations").expressions
        return tuple(a / found[-1] for a in found) if all(a.is_number for a in found) else found

    @property
    def order(self) -> int:
        """Number of eigenvalues."""
        return len(self.coefficients) - 1

    @cached_property
    def rigid_positions(self) -> int:
        """Number of eigenvalues that are exactly zero: positions that nothing restores, which is harmless."""
        return next(i for i, a in enumerate(self.coefficients) if a != 0)

    @cached_property
    def eigenvalues(self) -> Array:
        """Eigenvalues [1/s], by falling real part, to the accuracy of LAPACK's balanced QR.

        Rigid positions, which exact arithmetic recognises, are exact zeros. Raises `UcritError` where symbols
        are left.
        """
        from .forms_convert import numeric

        values = np.linalg.eigvals(numeric(self.to_state_space().A)).astype(complex)
        values[np.argsort(np.abs(values))[: self.rigid_positions]] = 0
        return np.asarray(values[np.lexsort((-values.imag, -values.real))])

    def to_nth_order(self) -> NthOrder:
        """Return the one equation that the free motion of every variable satisfies."""
        return NthOrder(self.coefficients)

    def to_state_space(self) -> StateSpace:
        """Return first-order equations solved for the rates, in exact arithmetic; constraints are eliminated."""
        from .forms_convert import solved_for_rates

        return StateSpace(*solved_for_rates(self.matrices, self.names))

    def to_second_order(self) -> SecondOrder:
        """Return a set of second-order equations, in which as many states as can be are a position and its rate."""
        from .forms_convert import paired

        return SecondOrder(*paired(self.to_state_space().A))

    def to_descriptor(self) -> Descriptor:
        """Return ``E x' = A x`` without solving for anything, the variables and their lower derivatives being x."""
        from .forms_convert import companion

        return Descriptor(*companion(self.matrices))

    def __str__(self) -> str:
        from .forms_convert import text

        given = {field.name: getattr(self, field.name) for field in fields(self)}
        return "\n".join([self.title, *(f"{name} = {text(value)}" for name, value in given.items())])


@dataclass(frozen=True)
class NthOrder(LinearForm):
    """``a_0 y + a_1 y' + ... + a_n y^(n) = 0``, coefficients ascending.

    Examples
    --------
    >>> NthOrder([4, 2, 1]).to_state_space().A
    Matrix([
    [ 0,  1],
    [-4, -2]])
    """

    a: Any
    title = "one equation of n-th order, a_0 y + a_1 y' + ... = 0"

    def __post_init__(self) -> None:
        from .forms_convert import exact

        try:
            a = tuple(exact(entry) for entry in self.a)
        except TypeError:
            raise UcritError(f"a must be a list of coefficients, got {self.a!r}") from None
        if len(a) < 2 or a[-1] == 0:
            raise UcritError(f"a must be two coefficients or more, the last of them not zero, got {self.a!r}")
        object.__setattr__(self, "a", a)

    @property
    def matrices(self) -> tuple[Any, ...]:
        """The coefficients as matrices of one entry."""
        from .forms_convert import square

        return tuple(square([[entry]], "a") for entry in self.a)

    @property
    def names(self) -> tuple[str, ...]:
        """The variable is y."""
        return ("y",)


@dataclass(frozen=True)
class StateSpace(LinearForm):
    """``x' = A x``; ``states`` names x, with a prime for each derivative.

    Examples
    --------
    >>> StateSpace([[0, 1], [-4, -2]]).to_nth_order().a
    (4, 2, 1)
    """

    A: Any
    states: tuple[str, ...] = ()
    title = "state space, x' = A x"

    def __post_init__(self) -> None:
        _make_square(self, "A")
        if isinstance(self.states, str) or not all(isinstance(name, str) for name in self.states):
            raise UcritError(f"states must be names, one for each row of A, got {self.states!r}")
        object.__setattr__(self, "states", tuple(self.states) or self.names)

    @property
    def matrices(self) -> tuple[Any, ...]:
        """``(-A, I)``."""
        return -self.A, self.A**0

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the states."""
        return self.states or super().names

    def to_state_space(self) -> StateSpace:
        """Return the form itself."""
        return self


@dataclass(frozen=True)
class SecondOrder(LinearForm):
    """``M q'' + B q' + K q = 0``; M may be singular: constraints and parts without mass are allowed.

    Examples
    --------
    >>> SecondOrder([[2]], [[1]], [[0]]).eigenvalues.real
    array([ 0. , -0.5])
    """

    M: Any
    B: Any
    K: Any
    title = "second-order set, M q'' + B q' + K q = 0"

    def __post_init__(self) -> None:
        _make_square(self, "M", "B", "K")

    @property
    def matrices(self) -> tuple[Any, ...]:
        """``(K, B, M)``."""
        return self.K, self.B, self.M

    def to_second_order(self) -> SecondOrder:
        """Return the form itself."""
        return self


@dataclass(frozen=True)
class Descriptor(LinearForm):
    """``E x' = A x``; E may be singular.

    Examples
    --------
    >>> Descriptor([[1, 0], [0, 0]], [[-3, 1], [1, -1]]).to_state_space().A
    Matrix([[-2]])
    """

    E: Any
    A: Any
    title = "descriptor form, E x' = A x"

    def __post_init__(self) -> None:
        _make_square(self, "E", "A")

    @property
    def matrices(self) -> tuple[Any, ...]:
        """``(-A, E)``."""
        return -self.A, self.E

    def to_descriptor(self) -> Descriptor:
        """Return the form itself."""
        return self


@dataclass(frozen=True)
class Forms(Rich):
    """The linear equations of one vehicle or model in four forms."""

    nth_order: NthOrder
    state_space: StateSpace
    second_order: SecondOrder
    descriptor: Descriptor

    @property
    def rigid_positions(self) -> int:
        """Number of eigenvalues that are exactly zero: positions that nothing restores, which is harmless."""
        return self.nth_order.rigid_positions

    def __iter__(self) -> Iterator[LinearForm]:
        return iter((self.nth_order, self.state_space, self.second_order, self.descriptor))

    def __str__(self) -> str:
        zeros = f"\n\neigenvalues that are zero, rigid positions: {self.rigid_positions}"
        return "\n\n".join(map(str, self)) + zeros


def forms(vehicle: Model | type[Model], *, direction: int | None = None) -> Forms:
    """Return the linear equations of a vehicle in numbers, or of a model in symbols, in all forms.

    Parameters
    ----------
    vehicle
        A vehicle with scalar parameters, or a model class.
    direction
        +1 forward, -1 backing up; that of the vehicle's speed by default.

    Raises
    ------
    UcritError
        If parameters are arrays.

    Examples
    --------
    >>> from ucrit import find_model
    >>> print(forms(find_model("oscillator")).state_space)
    state space, x' = A x
    A = [[0, 1], [-k/m, -b/m]]
    states = x, x'
    """
    from ...core.derivation.derive import symbolic
    from ...core.numeric.compiled import direction as direction_of
    from .forms_convert import exact, solved_for_rates

    model = vehicle if isinstance(vehicle, type) else type(vehicle)
    system = symbolic(model, direction or (1 if isinstance(vehicle, type) else direction_of(vehicle)))
    if isinstance(vehicle, Model):
        if vehicle.dims:
            raise UcritError("forms are those of one vehicle: give scalar parameters")
        values = vehicle.values
        system = system.substituted({p: exact(values[name]) for name, p in system.traced.parameters.items()})
    nothing = system.P[0] * 0
    K, B, M = (*system.P, nothing, nothing)[:3]
    second = SecondOrder(M, B, K)
    names = [chain[0].name for chain in system.traced.q]
    state = StateSpace(*solved_for_rates(second.matrices, names))
    return Forms(second.to_nth_order(), state, second, second.to_descriptor())


def _make_square(form: LinearForm, *names: str) -> None:
    """Replace the named entries by exact square matrices, all of one size."""
    from .forms_convert import square

    found = {name: square(getattr(form, name), name) for name in names}
    sizes = {name: M.rows for name, M in found.items()}
    if len(set(sizes.values())) > 1:
        raise UcritError(f"matrices must be of one size, got {', '.join(f'{k}: {v}' for k, v in sizes.items())} rows")
    for name, M in found.items():
        object.__setattr__(form, name, M)
