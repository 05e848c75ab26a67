"""Compiled functions of a model: state matrices, characteristic coefficients and motion for arrays of parameters.

Nothing here imports SymPy unless a piece has never been derived before on this machine (see
`ucrit.core.numeric.cache`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ..contract.model import Model
from ..errors import UcritError
from ..formulas.codegen import build
from .cache import cached

Array = npt.NDArray[Any]
Arguments = Sequence[Any]


class StateSpace(NamedTuple):
    """Arrays of shape (..., rows, columns): ``w' = A w + B u``, ``y = C w + D u``."""

    A: Array
    B: Array
    C: Array
    D: Array


@dataclass(frozen=True)
class Compiled:
    """Numeric functions of one model class; get it from `compiled`.

    ``direction`` is the sign of the speed for which the equations were derived.
    """

    model: type[Model]
    direction: int = 1

    @cached_property
    def _facts(self) -> Any:
        return cached(
            self.model, f"linear{self.direction:+d}", lambda: derive_facts("linear", self.model, self.direction)
        )

    @cached_property
    def _slopes(self) -> Any:
        return cached(
            self.model, f"slopes{self.direction:+d}", lambda: derive_facts("slope", self.model, self.direction)
        )

    @cached_property
    def size_facts(self) -> Any:
        """Sources of functions that bound the coefficients' sizes, and rounding units: `ucrit.core.numeric.bounds`."""
        return cached(self.model, f"sizes{self.direction:+d}", lambda: derive_facts("size", self.model, self.direction))

    @cached_property
    def corners(self) -> list[tuple[str, str]]:
        """Where a law jumps or has a kink on the basic motion: ``("jump", "v")`` where v vanishes."""
        piece = f"corners{self.direction:+d}"
        found = cached(self.model, piece, lambda: derive_facts("corner", self.model, self.direction))
        return [(kind, where) for kind, where in found]

    @property
    def order(self) -> int:
        """Number of states, equal to the degree of the characteristic polynomial."""
        return int(self._facts["order"])

    @property
    def structural_zeros(self) -> int:
        """Number of eigenvalues that are zero whatever the parameters (rigid positions)."""
        return int(self._facts["zeros"])

    @property
    def undamped(self) -> bool:
        """Whether the characteristic polynomial is even whatever the parameters: no motion can decay."""
        return bool(self._facts["undamped"]) and self.order > self.structural_zeros

    @property
    def states(self) -> tuple[tuple[str, int], ...]:
        """Variable name and derivative of every state."""
        return tuple((name, int(k)) for name, k in self._facts["states"])

    @property
    def labels(self) -> tuple[str, ...]:
        """State names such as ``theta'``."""
        return tuple(name + "'" * k for name, k in self.states)

    def degrees(self, parameter: str) -> list[int] | None:
        """Degree of each characteristic coefficient in a parameter, ``None`` if not a polynomial in it."""
        degrees: list[int] | None = self._facts["degrees"][parameter]
        return degrees

    @cached_property
    def coefficients(self) -> Callable[[Arguments], tuple[Any, ...]]:
        """Function of the parameters giving a_0 ... a_n, each broadcast only over what it depends on."""
        return build(self._facts["coefficients"], "coefficients")

    @property
    def source(self) -> str:
        """Source of `coefficients`, straight-line code of one function."""
        return str(self._facts["coefficients"])

    @cached_property
    def exact_coefficients(self) -> Callable[[Arguments], tuple[Any, ...]]:
        """The same function for `fractions.Fraction`: exact, but for functions such as cosines of parameters."""
        return build(self._facts["coefficients"], "coefficients", exact=True)

    def exact_factors(self, arguments: Arguments) -> list[list[Any]]:
        """Return the coefficients of each factor of the polynomial for `fractions.Fraction`, without roots at zero."""
        flat, found = iter(self._exact_factors(arguments)), []
        for size in self._facts["sizes"]:
            found.append([next(flat) for _ in range(size)])
        return found

    @cached_property
    def _exact_factors(self) -> Callable[[Arguments], tuple[Any, ...]]:
        return build(self._facts["factors"], "factors", exact=True)

    @cached_property
    def _matrices(self) -> Callable[[Arguments], tuple[Any, ...]]:
        return build(self._facts["matrices"], "matrices")

    @cached_property
    def _matrix_slopes(self) -> Callable[[Arguments], tuple[Any, ...]]:
        return build(self._slopes["source"], "slopes")

    @cached_property
    def static_slopes(self) -> Callable[[Arguments], tuple[Any, ...]]:
        """Function of the parameters giving da/dp for each, a the first coefficient not always zero."""
        piece = f"static{self.direction:+d}"
        found = cached(self.model, piece, lambda: derive_facts("static_slope", self.model, self.direction))
        return build(found["slopes"], "static")

    def blocks(self, arguments: Arguments) -> list[Array]:
        """Return L, R, Q, Cw, Cz, D of ``L z = R w + Q u``, ``y = Cw w + Cz z + D u`` as stacked arrays."""
        with np.errstate(all="ignore"):
            entries = self._matrices(tuple(map(np.asarray, arguments)))  # whose powers overflow to infinity
        return _stack(entries, self._facts["shapes"], _shape(arguments))

    def state_space(self, arguments: Arguments) -> StateSpace:
        """Return A, B, C, D for arrays of parameters.

        Raises
        ------
        UcritError
            If the leading matrix is singular for some of the parameters (no such motion exists).
        """
        L, R, Q, Cw, Cz, D = self.blocks(arguments)
        joined = np.concatenate([R, Q], axis=-1)
        try:
            z = np.linalg.solve(L, joined)
        except np.linalg.LinAlgError:
            raise UcritError(
                f"{self.model.model_id()}: the equations cannot be solved for the accelerations with these parameters"
            ) from None
        zw, zu = z[..., : R.shape[-1]], z[..., R.shape[-1] :]
        pick, shift = self._structure
        with np.errstate(all="ignore"):
            return StateSpace(pick @ zw + shift, pick @ zu, Cw + Cz @ zw, D + Cz @ zu)

    @cached_property
    def _structure(self) -> tuple[Array, Array]:
        """Matrices that place solved derivatives and chains of integrators in ``w'``."""
        names = [name for name, _ in self.states]
        variables: list[str] = self._facts["variables"]
        pick, shift = np.zeros((self.order, len(variables))), np.zeros((self.order, self.order))
        for i, (name, _) in enumerate(self.states):
            if i + 1 < self.order and names[i + 1] == name:
                shift[i, i + 1] = 1
            else:
                pick[i, variables.index(name)] = 1
        return pick, shift

    def state_slopes(self, arguments: Arguments) -> dict[str, Array]:
        """Return dA/dp for every parameter p, each of shape (..., n, n)."""
        L, R, *_ = self.blocks(arguments)
        with np.errstate(all="ignore"):
            entries = self._matrix_slopes(arguments)
        pick, _ = self._structure
        z, shapes = np.linalg.solve(L, R), self._facts["shapes"][:2]
        count = sum(rows * columns for rows, columns in shapes)
        changes: list[dict[int, Any]] = [{} for _ in self.model.declaration.parameters]
        for (i, j), value in zip(self._slopes["places"], entries, strict=True):
            changes[j][i] = value
        slopes = {}
        for name, change in zip(self.model.declaration.parameters, changes, strict=True):
            dL, dR = _stack([change.get(i, 0.0) for i in range(count)], shapes, _shape(arguments))
            with np.errstate(all="ignore"):
                slopes[name] = pick @ np.linalg.solve(L, dR - dL @ z)
        return slopes


def derive_facts(piece: str, *arguments: Any) -> Any:
    """Derive facts that are not cached yet; not imported before, because that imports SymPy."""
    from ..derivation import derive

    return getattr(derive, f"{piece}_facts")(*arguments)


def _shape(arguments: Arguments) -> tuple[int, ...]:
    return np.broadcast_shapes(*(np.shape(a) for a in arguments))


def _stack(entries: Sequence[Any], shapes: Sequence[Sequence[int]], lead: tuple[int, ...]) -> list[Array]:
    blocks, position = [], 0
    for rows, columns in shapes:
        block = np.empty((*lead, rows * columns))
        for k in range(rows * columns):
            block[..., k] = entries[position + k]
        position += rows * columns
        blocks.append(block.reshape(*lead, rows, columns))
    return blocks


_compiled: Any = cache(Compiled)


def compiled(model: type[Model], direction: int = 1) -> Compiled:
    """Return the compiled functions of a model class."""
    found: Compiled = _compiled(model, direction)
    return found


def _by_direction(
    vehicle: Model, evaluate: Callable[[Compiled, Arguments], Sequence[Any]], trailing: int = 0
) -> tuple[Any, ...]:
    """Evaluate with the equations of each speed's direction; results end in ``trailing`` more axes."""
    model, arguments = type(vehicle), vehicle.arguments()
    name = model.declaration.speed
    if name is None:
        return tuple(evaluate(compiled(model), arguments))
    U = np.asarray(arguments[list(model.declaration.parameters).index(name)])
    if np.all(U > 0) or np.all(U < 0):
        return tuple(evaluate(compiled(model, 1 if U.flat[0] > 0 else -1), arguments))
    ahead, back = evaluate(compiled(model, 1), arguments), evaluate(compiled(model, -1), arguments)
    forward = (U > 0).reshape(U.shape + (1,) * trailing)
    return tuple(np.where(forward, a, b) for a, b in zip(ahead, back, strict=True))


def state_space(vehicle: Model) -> StateSpace:
    """Return the linear state equations of a vehicle, its array parameters spanning leading dimensions.

    Returns
    -------
    StateSpace
        A (..., n, n), B (..., n, m), C (..., p, n), D (..., p, m) in SI units; ``...`` is the shape of
        ``vehicle.dims``. States are named by ``compiled(type(vehicle)).labels``.
    """
    return StateSpace(*_by_direction(vehicle, lambda c, arguments: c.state_space(arguments), trailing=2))


def state_slopes(vehicle: Model) -> dict[str, Array]:
    """Return dA/dp of a vehicle's state matrix for every parameter p, by name, each of shape (..., n, n).

    ``...`` is the shape of ``vehicle.dims``; units are those of A divided by the parameter's.
    """
    slopes = _by_direction(vehicle, lambda c, arguments: [*c.state_slopes(arguments).values()], trailing=2)
    return dict(zip(type(vehicle).declaration.parameters, slopes, strict=True))


def coefficients(vehicle: Model) -> tuple[Any, ...]:
    """Return a_0 ... a_n of the characteristic polynomial, each broadcast only over what it depends on."""
    return _by_direction(vehicle, lambda c, arguments: c.coefficients(arguments))


def deciding_coefficients(vehicle: Model) -> tuple[Any, ...]:
    """Return ascending coefficients of the polynomial whose roots decide stability.

    Structural zeros, harmless, are divided out. Where no motion can decay, ``p + p'`` takes the place of the even
    ``p``: its roots lie in the left half plane if and only if those of p are simple and on the imaginary axis
    (F. R. Gantmacher, The Theory of Matrices (1959), volume 2, chapter XV, sections 7 and 16).
    """
    return deciding(compiled(type(vehicle), direction(vehicle)), coefficients(vehicle))


def deciding(functions: Compiled, a: Sequence[Any]) -> tuple[Any, ...]:
    """Return `deciding_coefficients` from all characteristic coefficients."""
    a = tuple(a)[functions.structural_zeros :]
    if not functions.undamped:
        return a
    return tuple(c + (k + 1) * a[k + 1] if k + 1 < len(a) else c for k, c in enumerate(a))


def labels(vehicle: Model) -> tuple[str, ...]:
    """Return the names of a vehicle's linear states."""
    return compiled(type(vehicle), direction(vehicle)).labels


def direction(vehicle: Model) -> int:
    """Return the sign of a vehicle's speed, +1 where it has none or several."""
    name = type(vehicle).declaration.speed
    return -1 if name is not None and np.all(np.asarray(vehicle.values[name]) < 0) else 1
