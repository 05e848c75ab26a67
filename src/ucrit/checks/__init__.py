"""Checks of a model: units, published equations and numbers, further derivations, symmetry, conservation.

``check_model`` runs every check that applies to a model, shipped or your own, and says why others do not::

    print(check_model(MyTrailer, published="my_trailer.toml"))
"""

from __future__ import annotations

import os
from pathlib import Path

from ..analyses.about.show import resolve
from ..core.contract.model import Model
from .report import Check, Report
from .subject import Subject
from .suite import run

__all__ = ["Check", "Report", "check_model"]


def check_model(
    model: type[Model] | Model | str | os.PathLike[str],
    seed: int = 0,
    published: str | os.PathLike[str] | None = None,
) -> Report:
    """Run every check that applies to a model and report what came out.

    Parameters
    ----------
    model
        A model class, or a vehicle, about whose values random parameters are then drawn; or the name of one; also
        a vehicle file or a Python file with a model.
    seed
        Seed of the random parameters and states.
    published
        TOML file of equations and numbers to compare with; by default the shipped one of the model.

    Returns
    -------
    Report
        One `Check` per check; those that did not apply say why.

    Raises
    ------
    UcritError
        If there is no model or vehicle of that name, or a file cannot be read.

    Examples
    --------
    >>> report = check_model("trailer-kinematic")
    >>> report.ok
    True
    >>> print(report.checks[1])
    pass  equations: 1 equation with matching units, solved by the basic motion
    """
    named, vehicle = resolve(model)
    subject = Subject.of(named if vehicle is None else vehicle, seed, None if published is None else Path(published))
    return Report(subject.model.model_id(), tuple(run(subject)))
