"""What the page draws and says: plain data made of the results of analyses, SI units and full precision throughout."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ..analyses.about.listing import listing
from ..analyses.nonlinear.handling import has_handling
from ..analyses.regions.stability_map import stability_map
from ..analyses.regions.uncertainty import uncertainty
from ..analyses.stability.advice import advice
from ..analyses.stability.analyze import Analysis, analyze
from ..analyses.stability.critical import CriticalValues, critical
from ..analyses.stability.locus import Locus, locus
from ..analyses.stability.remedies import Remedy
from ..analyses.stability.wording import describe, speed_text
from ..core.errors import UcritError, near_match
from ..plots.branches import marks, upper, view
from ..plots.labels import percent
from ..report import choices, formulas, tables
from .ranges import drawn_range, slider_range
from .subject import ends, parameter

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from ..core.contract.model import Model

POINTS = 60
"""Even steps of a root locus on the page; it is refined where eigenvalues move fast."""

DEPTH = 2
"""Times that steps in doubt are halved, so that the picture can follow a slider."""

ACROSS, UP = 140, 100
"""Points of the stability map."""

SPEEDS: dict[str, Callable[[float], str]] = {
    "si": speed_text,
    "kmh": lambda speed: f"{speed * 3.6:.4g} km/h",
    "mph": lambda speed: f"{speed / 0.44704:.4g} mph",
}
"""How sentences write a speed [m/s], by the units that the page shows."""

Answer = dict[str, Any]


def catalogue() -> Answer:
    """Return the vehicles to choose from."""
    titles = {entry.name: entry.title for entry in listing("models").models}
    return {
        "vehicles": [
            {"name": e.name, "title": e.title, "model": e.model, "about": titles.get(e.model, "")}
            for e in listing("vehicles").vehicles
        ]
    }


def opened(vehicle: Model, body: Mapping[str, Any]) -> Answer:
    """Return what a vehicle declares: its parameters with ranges for their sliders, its states, what to draw first."""
    found = analyze(vehicle)
    model, declared = type(vehicle), type(vehicle).declaration
    pair = choices.map_parameters(found, None)
    return {
        "name": vehicle.info.name,
        "source": vehicle.info.source,
        "note": vehicle.info.note,
        "model": model.model_id(),
        "title": model.title(),
        "made": _made_of(vehicle),
        "speed": declared.speed,
        "along": declared.speed or (pair[0] if pair else next(iter(declared.parameters), None)),
        "map": pair,
        "moves": hasattr(vehicle, "drawing"),
        "turns": has_handling(vehicle),
        "states": _states(vehicle),
        "parameters": [
            {
                "name": name,
                "symbol": formulas.symbol(name),
                "meaning": p.meaning,
                "unit": p.unit,
                "allowed": p.allowed,
                "value": float(vehicle.values[name]),
                "range": slider_range(found, name),
                "known": _known(vehicle, name),
            }
            for name, p in declared.parameters.items()
        ],
    }


def _made_of(vehicle: Model) -> str:
    """Return the laws in the model's slots and its controllers as words."""
    made, slots = type(vehicle).ingredients(), type(vehicle).declaration.slots
    told = [f"{slots[name].meaning if name in slots else name}: {law}" for name, law in made.get("parts", {}).items()]
    controllers = made.get("controllers", ())
    return "; ".join([*told, *([f"controllers: {', '.join(controllers)}"] if controllers else [])])


def _known(vehicle: Model, name: str) -> Answer | None:
    """Return how well a vehicle file says that a parameter is known [SI]."""
    tolerance = vehicle.info.tolerances.of(name)
    if tolerance is None:
        return None
    bounded = math.isfinite(tolerance.low)
    return {"sd": tolerance.sd or None, "range": [tolerance.low, tolerance.high] if bounded else None}


def say_speed(body: Mapping[str, Any]) -> Callable[[float], str]:
    """Return what writes a speed in the units that a request asks for, those of Python where it asks for none."""
    units = body.get("units", "si")
    if not isinstance(units, str) or units not in SPEEDS:
        raise UcritError(f"there are no units '{str(units)[:30]}'{near_match(str(units)[:30], SPEEDS)}")
    return SPEEDS[units]


def _states(vehicle: Model) -> list[Answer]:
    from ..core.numeric.compiled import labels

    variables, found = type(vehicle).declaration.variables, []
    for label in labels(vehicle):
        order = label.count("'")
        variable = variables[label.rstrip("'")]
        rate = "rate of " if order else ""
        found.append({"name": label, "meaning": rate + variable.meaning, "unit": variable.state_unit(order)})
    return found


def state(vehicle: Model, body: Mapping[str, Any]) -> Answer:
    """Return the verdict, the modes and the root locus: all that follows a slider."""
    say = say_speed(body)
    found = analyze(vehicle, advise=False)
    judged, sentence = tables.judgement(found, say), describe(found, say)
    return {
        "values": {name: float(value) for name, value in vehicle.values.items()},
        "word": judged.word,
        "style": judged.style,
        "sign": judged.sign,
        "sentence": sentence[:1].upper() + sentence[1:] + "." + (f" But {found.caveat}." if found.caveat else ""),
        "analysis": found.to_dict(),
        **_curves(found, body),
    }


def _curves(found: Analysis, body: Mapping[str, Any]) -> Answer:
    """Return the locus along the parameter that was asked for, with critical values and stable ranges."""
    vehicle = found.vehicle
    name = parameter(vehicle, body.get("along") or type(vehicle).declaration.speed)
    low, high = ends(body["range"], f"the range of {name}") if body.get("range") else slider_range(found, name)
    try:
        path = locus(vehicle, name, *drawn_range(vehicle, name, low, high), points=POINTS, depth=DEPTH)
        branches = upper(path)
    except UcritError as error:
        return {"locus": None, "why": str(error), "critical": [], "stable": []}
    if found.critical is not None and name == found.critical.parameter:
        edges = found.critical
    else:
        edges = critical(vehicle, name)
    design = float(vehicle.values[name])
    marked = [v for v in (design, *(c.value for c in marks(edges, path.values))) if low <= v <= high]
    return {
        "locus": {
            "parameter": name,
            "values": path.values.tolist(),
            "branches": [
                {"index": b.index, "name": b.name, "re": _plain(b.values.real), "im": _plain(b.values.imag)}
                for b in branches
            ],
            "box": view(branches, path.values, marked),
        },
        "critical": _critical(edges, path),
        "stable": [[max(a, path.values[0]), min(b, path.values[-1])] for a, b in _inside(edges, path)],
    }


def _critical(edges: CriticalValues, path: Locus) -> list[Answer]:
    return [
        {"value": c.value, "unit": c.unit, "kind": c.kind, "hertz": c.frequency_hz, "mode": c.mode, "stable": c.stable}
        for c in marks(edges, path.values)
    ]


def _inside(edges: CriticalValues, path: Locus) -> list[tuple[float, float]]:
    return [(a, b) for a, b in edges.stable_ranges() if a < path.values[-1] and b > path.values[0]]


def _plain(values: Any) -> list[float | None]:
    return [None if math.isnan(v) else v for v in values.tolist()]


def remedies(vehicle: Model, body: Mapping[str, Any]) -> Answer:
    """Return the changes that each make the vehicle stable, with the values that a click sets."""
    found = analyze(vehicle)
    helping = [r for r in found.remedies if r.value is not None]
    return {
        "stable": found.stable,
        "remedies": [_remedy(r, found) for r in helping],
        "helpless": [r.parameter for r in found.remedies if r.value is None],
    }


def _remedy(r: Remedy, found: Analysis) -> Answer:
    told = advice(r, found)
    exact = told.text == "0"
    return {
        "parameter": r.parameter,
        "symbol": formulas.symbol(r.parameter),
        "meaning": r.meaning,
        "unit": r.unit,
        "present": r.present,
        "word": told.word,
        "value": r.value if exact else float(told.text),
        "change": percent(math.inf if told.relative is None else told.relative),
    }


def sure(vehicle: Model, body: Mapping[str, Any]) -> Answer:
    """Return what the tolerances that still hold mean for the critical speed, in a sentence; empty without any."""
    say, speed = say_speed(body), type(vehicle).declaration.speed
    known = vehicle.info.tolerances.around(vehicle.values)
    if not known or speed is None:
        return {"sentence": ""}
    now = abs(float(vehicle.values[speed]))
    found = uncertainty(vehicle.with_info(tolerances=known))
    share = f"{100 * float(found.probability(now)):.3g} %"
    return {"sentence": f"With these tolerances: {found.words(say)}; unstable at {say(now)} in {share} of all."}


def plane(vehicle: Model, body: Mapping[str, Any]) -> Answer:
    """Return where in the plane of two parameters the vehicle is stable, row by row as ends of runs."""
    x, y = parameter(vehicle, body.get("x")), parameter(vehicle, body.get("y"))
    if x == y:
        raise UcritError(f"a map needs two different parameters, got {x} twice")
    across = _spread(vehicle, x, body.get("x_range"), ACROSS)
    up = _spread(vehicle.with_(**{x: across[[0, -1]]}), y, body.get("y_range"), UP)
    result = stability_map(vehicle, **{x: across, y: up})
    edges = np.diff(np.pad(result.stable.T.astype(np.int8), ((0, 0), (1, 1))), axis=1)
    return {
        "x": {"name": x, "low": across[0], "high": across[-1], "count": ACROSS},
        "y": {"name": y, "low": up[0], "high": up[-1], "count": UP},
        "runs": [np.flatnonzero(row).tolist() for row in edges],
        "share": result.share,
    }


def _spread(vehicle: Model, name: str, given: Any, count: int) -> Any:
    low, high = drawn_range(vehicle, name, *ends(given, f"the range of {name}"))
    return np.linspace(low, high, count)
