"""Is the vehicle stable, up to what speed, how does it fail, and what should be changed?"""

from __future__ import annotations

import importlib
from typing import Any

__version__ = "0.1.0"

_PUBLIC = {
    "Model": "core",
    "ModelError": "core",
    "UcritError": "core",
    "algebraic": "core",
    "coordinate": "core",
    "input": "core",
    "output": "core",
    "param": "core",
    "speed": "core",
    "state": "core",
    "load": "catalogue",
    "find_model": "catalogue",
    "analyze": "analyses.analyze",
    "criteria": "analyses.criteria",
    "critical": "analyses.critical",
    "modes": "analyses.modes",
    "remedies": "analyses.remedies",
    "verdict": "analyses.verdict",
}


def __getattr__(name: str) -> Any:
    """Import public names when they are first used: starting up stays as quick as importing NumPy."""
    if name not in _PUBLIC:
        raise AttributeError(f"module 'ucrit' has no attribute '{name}'")
    value = getattr(importlib.import_module(f"ucrit.{_PUBLIC[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_PUBLIC})
