"""How notebooks show results: small tables, made from what a result holds; every text in them is escaped."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from ...core.html import lines, math_of, quantity, table, text, with_unit
from .digits import percent

if TYPE_CHECKING:
    from ..linear.modes import Mode
    from ..regions.stability_map import StabilityMap
    from ..stability.advice import Advice
    from ..stability.analyze import Analysis
    from ..stability.criteria import Boundary, Criteria
    from ..stability.critical import Critical, CriticalValues
    from ..stability.limits import LimitResult
    from ..stability.remedies import Remedy
    from ..stability.sensitivity import Sensitivity
    from ..stability.verdict import Verdict
    from .convert import Table, Tabular

ROWS, COLUMNS = 8, 8
"""How much of a table is shown."""


def name_of(vehicle: Any) -> str:
    """Return a vehicle's name, its model's where it has none."""
    return str(vehicle.info.name or type(vehicle).model_id())


def tabular(result: Tabular) -> str:
    """Return the first rows and columns of a result's flat table, and its text where it has one."""
    found = result.table()
    columns = list(itertools.islice(found.columns(), COLUMNS + 1))
    count = len(columns[0][2]) if columns else 0
    shown = columns[:COLUMNS]
    rows: list[Sequence[Any]] = list(zip(*(values[:ROWS] for _, _, values in shown), strict=True))
    if count > ROWS:
        rows.append(["..."] * len(shown))
    told = lines(str(result)) if type(result).__str__ is not object.__str__ else ""
    head = [with_unit(name, unit) for name, unit, _ in shown]
    return table(rows, head, _caption(found, count, len(columns) > COLUMNS)) + told


def _caption(found: Table, count: int, further: bool) -> str:
    more = [f"{count} rows"] if count > ROWS else []
    more += ["further columns in .to_dataframe()"] if further else []
    return ", ".join([f"{found.title}: {name_of(found.vehicle)}", *more])


def modes(found: Iterable[Mode], caption: str = "") -> str:
    """Return modes, a row each."""
    rows = [
        (m.name, m.eigenvalue, m.frequency_hz, m.damping_ratio, min(m.time_to_half, m.time_to_double)) for m in found
    ]
    head = ("mode", "eigenvalue [1/s]", "frequency [Hz]", "damping ratio", "halves or doubles in [s]")
    return table(rows, head, caption)


def mode(found: Mode) -> str:
    """Return one mode, and what takes part in it."""
    shares = [(name, share, found.shape[name]) for name, share in found.participation.items()]
    return modes([found]) + table(shares, ("state", "participation", "shape"))


def sensitivity(found: Sensitivity) -> str:
    """Return what one percent of each parameter does to growth and critical speeds, a row each."""
    rows = []
    for key, slope in found.growth.items():
        p = float(found.vehicle.values[key])
        speeds = [of.normalised.get(key) for of in found.critical]
        rows.append((key, p * float(slope) / 100, *(None if s is None or math.isnan(s) else s for s in speeds)))
    heads = [f"{of.critical.value:.4g} {of.critical.unit} [%]" for of in found.critical]
    caption = f"Change for +1 % of each parameter: {name_of(found.vehicle)}"
    return table(rows, ("parameter", "growth [1/s]", *heads), caption)


def critical(found: Sequence[Critical], caption: str = "") -> str:
    """Return critical values of one parameter, a row each; with formulas where there are any."""
    formulas = any(c.closed_form for c in found)
    rows = []
    for c in found:
        kind = "root through infinity" if c.kind == "order" else c.kind
        row = [f"{c.value:.10g}", kind, c.frequency_hz or None, c.mode, c.stable]
        rows.append(row + ([_boundary(c.closed_form)] if formulas else []))
    head = [with_unit(found[0].parameter, found[0].unit), "kind", "frequency [Hz]", "mode", "stable"]
    return table(rows, head + (["formula"] if formulas else []), caption)


def _boundary(form: Boundary | None) -> Any:
    if form is None:
        return None
    left = form.parameter if form.power == 1 else f"{form.parameter}^{form.power}"
    return f"{left} = {form.expression}"


def critical_values(found: CriticalValues) -> str:
    """Return the critical values of a vehicle, or a sentence that there are none."""
    if not found.values:
        return f"<p>{text(f'{name_of(found.vehicle)}: {found}')}</p>"
    return critical(found.values, f"Critical values of {found.parameter}: {name_of(found.vehicle)}")


def remedies(found: Sequence[Remedy], advised: Sequence[Advice] = ()) -> str:
    """Return remedies, a row each, their values rounded to the side that helps; or as an analysis advises them."""
    rows = []
    for r, advice in itertools.zip_longest(found, advised):
        word, value, change = (advice.word, advice.text, advice.relative) if advice else (*r.told(), r.relative)
        share = "" if r.value is None or change is None else percent(change)
        unit = "" if r.unit == "1" or r.value is None else f" {r.unit}"
        rows.append((r.parameter, word, f"{value}{unit}", quantity(r.present, r.unit), share, r.meaning))
    if not rows:
        return "<p>nothing to remedy</p>"
    return table(rows, ("parameter", "", "value", "now", "change", "meaning"), "Remedies, each enough alone")


def verdict(found: Verdict) -> str:
    """Return a verdict's parts under its sentence."""
    names = ("state", "static", "growing", "marginal", "rigid_positions")
    return table([(name.replace("_", " "), getattr(found, name)) for name in names], caption=str(found))


def criteria(found: Criteria) -> str:
    """Return the conditions for stability, typeset."""
    first = str(found).splitlines()[0]
    if found.settled is not None:
        return f"<p>{text(first)}</p>"
    rows = [(c.name, math_of(c.mathml, "> 0"), c.failure) for c in found.conditions]
    return table(rows, ("condition", "formula", "if it fails"), first)


def limit(found: LimitResult) -> str:
    """Return the polynomial that a limit leaves, typeset, and what the limit says about it."""
    head, _, *lines = str(found).splitlines()
    told = "<br>".join(text(line.strip()) for line in lines)
    return f"<p>{text(head)}</p><p>{math_of(found.mathml, '= 0' if found.order else '')}</p><p>{told}</p>"


def stability_map(found: StabilityMap) -> str:
    """Return ranges and share of a map, with a small picture of one over two parameters."""
    from .convert import unit_of
    from .thumbnail import image

    rows = [
        (with_unit(key, unit_of(found.vehicle, key)), f"{x[0]:.6g} ... {x[-1]:.6g}", x.size)
        for key, x in found.coords.items()
    ]
    caption = f"Stability map: {name_of(found.vehicle)}, {found.share:.1%} stable"
    facts = table(rows, ("parameter", "range", "values"), caption)
    if len(found.dims) != 2:
        return facts
    across, up = found.dims
    return facts + image(found.stable, f"Stable points are green; {across} to the right, {up} upwards")


def analysis(found: Analysis, advised: Sequence[Advice]) -> str:
    """Return the verdict, then modes, critical speeds, criteria and remedies."""
    parts = [
        f"<p><b>{text(name_of(found.vehicle))}</b>: {text(str(found).removeprefix(f'{name_of(found.vehicle)}: '))}</p>",
        modes(found.modes, "Modes"),
    ]
    if found.critical:
        parts.append(critical_values(found.critical))
    if found.criteria is not None:
        parts.append(criteria(found.criteria))
    if advised:
        parts.append(remedies([r for r in found.remedies if r.value is not None], advised))
    return "".join(parts)
