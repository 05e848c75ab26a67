"""Names that MATLAB can read."""

from __future__ import annotations

import re
from collections.abc import Sequence

RESERVED = frozenset({"units", "names", "parameters"})
"""What else a MATLAB file holds."""


def matlab_names(names: Sequence[str]) -> dict[str, str]:
    """Return a name that MATLAB can read for each name, no two of them equal.

    >>> matlab_names(["theta'", "amplitude of x'", "theta_dot"])
    {"theta'": 'theta_dot_2', "amplitude of x'": 'amplitude_of_x_dot', 'theta_dot': 'theta_dot'}
    """
    found: dict[str, str] = {}
    plain = {name for name in names if re.fullmatch(r"[A-Za-z]\w*", name, re.ASCII)} | RESERVED
    for name in names:
        word = re.sub(r"\W", "_", name.replace("'", "_dot"), flags=re.ASCII)
        word = word if word[:1].isalpha() and word[:1].isascii() else f"x{word}"
        taken = {*found.values(), *(plain - {name})}
        tries = (word, *(f"{word}_{k}" for k in range(2, len(names) + 3)))
        found[name] = next(one for one in tries if one not in taken)
    return found
