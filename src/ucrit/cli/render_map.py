"""A stability map as text for a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .terminal import Page, vehicle_head
from .wrap import number

if TYPE_CHECKING:
    from rich.console import Console

    from ..analyses.regions.stability_map import StabilityMap
    from ..core.contract.model import Model


def show_map(console: Console, vehicle: Model, found: StabilityMap) -> None:
    """Print what share of a map is stable, its ranges, and the most and the least stable of its points."""
    page = Page(console)
    vehicle_head(page, vehicle)
    page.line()
    page.paragraph(_sentence(found), "bold")
    declared = type(vehicle).declaration.parameters
    page.heading("Over")
    page.table(
        [
            (name, f"{number(x.min())} to {number(x.max())}", declared[name].unit, f"{x.size:,} values")
            for name, x in found.coords.items()
        ],
    )
    if found.growth is None or found.damping is None:
        return
    page.heading("At the most and the least stable of them")
    names = list(found.coords)
    rows = []
    for word, at in (("most", found.growth.argmin()), ("least", found.growth.argmax())):
        place = np.unravel_index(at, found.growth.shape)
        rows.append(
            (
                word,
                *(number(x[i]) for x, i in zip(found.coords.values(), place, strict=True)),
                number(found.growth[place]),
                number(found.damping[place]),
            )
        )
    page.table(rows, head=("", *names, "growth [1/s]", "least damping ratio"), right=range(1, len(names) + 3))


def _sentence(found: StabilityMap) -> str:
    count, stable = found.stable.size, int(np.count_nonzero(found.stable))
    if stable in (0, count):
        return f"{'Stable' if stable else 'Unstable'} at all {count:,} points."
    share = min(max(found.share, 1e-3), 0.999)
    about = f"{100 * share:.1f} %" if share == found.share else "Less than 0.1 %" if share < 0.5 else "More than 99.9 %"
    return f"{about} of {count:,} points are stable."
