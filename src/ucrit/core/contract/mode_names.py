"""What modes can be called: by the motion words of a model's variables, or as the field calls them.

The first name of a mode is ``<motion> <going>``: the motion of the variable that takes part most, and how it goes:
``yaw oscillation``, ``lateral decay``, ``forward speed``. A model's ``mode_names`` maps such names to the field's.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from ..errors import ModelError, near_match
from ..units import dimension
from .declare import Variable

GOING = ("oscillation", "decay", "divergence")
"""How a mode can go whose eigenvalue is not zero."""
STAYS = {dimension(unit): word for unit, word in (("m", "position"), ("1", "value"), ("m/s", "speed"), ("1/s", "rate"))}
"""What a state is called that a zero eigenvalue leaves where it is, by its dimension."""


def motion_word(variable: Variable) -> str:
    """Return the word that modes are named by in which a variable takes part most."""
    return variable.motion or variable.meaning


def staying_word(variable: Variable, derivative: int = 0) -> str:
    """Return what it is that nothing restores, by the unit of the state.

    >>> from ucrit.core import coordinate
    >>> staying_word(coordinate("rad", "yaw angle")), staying_word(coordinate("m", "position"), 1)
    ('angle', 'speed')
    """
    unit = variable.state_unit(derivative)
    return "angle" if unit == "rad" else STAYS.get(dimension(unit), "value")


def derived_names(variables: Iterable[Variable]) -> Iterator[str]:
    """Yield every name that a mode of a model with these variables can have before ``mode_names`` are asked.

    >>> from ucrit.core import state
    >>> list(derived_names([state("rad", "lean angle", motion="lean")]))
    ['lean oscillation', 'lean decay', 'lean divergence', 'lean angle']
    """
    for variable in variables:
        for going in (*GOING, *(staying_word(variable, k) for k in range(variable.order))):
            yield f"{motion_word(variable)} {going}"


def check_mode_names(model: str, own: Mapping[str, str], variables: Iterable[Variable]) -> None:
    """Raise `ModelError` for a name that no mode can have, or one that sentences cannot be made of."""
    known = list(derived_names(v for v in variables if v.order))
    for name, called in own.items():
        if name not in known:
            raise ModelError(f"{model}: mode_names: no mode is called '{name}'{near_match(name, known)}")
        if name.endswith(" divergence") and not called.endswith(" divergence"):
            raise ModelError(f"{model}: mode_names: '{name}' must be called '... divergence', got '{called}'")
