"""How far the modes of a simple model are from those of a fuller one of the same vehicle."""

from __future__ import annotations

from dataclasses import dataclass

from ...core.contract.model import Model
from ...core.errors import UcritError
from ...core.html import Rich
from ..linear.modes import Mode, modes


@dataclass(frozen=True)
class ModeError(Rich):
    """A mode as the full and as the simple model have it."""

    full: Mode
    simple: Mode

    @property
    def name(self) -> str:
        """Name of the mode in both models."""
        return self.full.name

    @property
    def frequency(self) -> float:
        """Relative error of the simple model's natural frequency ``|eigenvalue|``."""
        return abs(self.simple.eigenvalue) / abs(self.full.eigenvalue) - 1

    @property
    def damping(self) -> float:
        """The simple model's damping ratio less the full one's."""
        return self.simple.damping_ratio - self.full.damping_ratio

    def __str__(self) -> str:
        full, simple = self.full, self.simple
        frequency = f"{abs(simple.eigenvalue):.4g} rad/s instead of {abs(full.eigenvalue):.4g}"
        damping = f"damping ratio {simple.damping_ratio:.4g} instead of {full.damping_ratio:.4g}"
        return f"{self.name}: {frequency}, {100 * self.frequency:+.1f} %; {damping}"


@dataclass(frozen=True)
class Approximation(Rich):
    """Errors of a simple model, mode by mode.

    Attributes
    ----------
    errors
        One for each mode that both models name alike.
    missing
        Names of the full model's modes that the simple one does not have.
    """

    full: Model
    simple: Model
    errors: tuple[ModeError, ...]
    missing: tuple[str, ...]

    def __str__(self) -> str:
        names = [v.info.name or type(v).model_id() for v in (self.simple, self.full)]
        left_out = [f"    not in it: {', '.join(self.missing)}"] if self.missing else []
        return "\n".join([f"{names[0]}, against {names[1]}", *(f"    {error}" for error in self.errors), *left_out])


def approximation(full: Model, simple: Model) -> Approximation:
    """Compare the modes of a simple model with those of a fuller one.

    Parameters
    ----------
    full, simple
        The same vehicle by two models, with scalar parameters.

    Returns
    -------
    Approximation
        Modes are matched by their names.

    Raises
    ------
    UcritError
        If no mode of one is named like a mode of the other.

    Examples
    --------
    >>> from ucrit import approximation, load
    >>> print(approximation(load("boeing-747"), load("boeing-747-phugoid")))
    Boeing 747-100, slow exchange of speed and height, against Boeing 747-100 at 40,000 ft and Mach 0.8
        phugoid oscillation: 0.05883 rad/s instead of 0.0673, -12.6 %; damping ratio 0.04649 instead of 0.04888
        not in it: short period oscillation
    """
    found = {mode.name: mode for mode in modes(simple)}
    exact = list(modes(full))
    errors = tuple(ModeError(mode, found[mode.name]) for mode in exact if mode.name in found)
    if not errors:
        lists = (", ".join(names) for names in ([m.name for m in exact], list(found)))
        raise UcritError("the two models have no mode in common: {}; {}".format(*lists))
    return Approximation(full, simple, errors, tuple(mode.name for mode in exact if mode.name not in found))
