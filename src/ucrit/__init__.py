"""Is the vehicle stable, up to what speed, how does it fail, and what should be changed?"""

from __future__ import annotations

import importlib
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:  # the same names as in _PUBLIC, for type checkers and editors
    from .analyses.analyze import analyze as analyze
    from .analyses.approximation import approximation as approximation
    from .analyses.audit import audit as audit
    from .analyses.basin import basin as basin
    from .analyses.bonds import bonds as bonds
    from .analyses.boundary import boundary as boundary
    from .analyses.certify import certify as certify
    from .analyses.cite import cite as cite
    from .analyses.compare import compare as compare
    from .analyses.convert import to_control as to_control
    from .analyses.convert import to_scipy as to_scipy
    from .analyses.criteria import criteria as criteria
    from .analyses.critical import critical as critical
    from .analyses.cycles import limit_cycles as cycles  # noqa: F401
    from .analyses.cycles import limit_cycles as limit_cycles
    from .analyses.delays import simulate_delayed as simulate_delayed
    from .analyses.dwell import dwell_criteria as dwell_criteria
    from .analyses.forms import Descriptor as Descriptor
    from .analyses.forms import NthOrder as NthOrder
    from .analyses.forms import SecondOrder as SecondOrder
    from .analyses.forms import StateSpace as StateSpace
    from .analyses.forms import forms as forms
    from .analyses.handling import handling_diagram as handling  # noqa: F401
    from .analyses.handling import handling_diagram as handling_diagram
    from .analyses.laws import describe_controller as describe_controller
    from .analyses.lazy import lazy as lazy
    from .analyses.limits import limit as limit
    from .analyses.listing import listing as list  # noqa: F401
    from .analyses.listing import template as new  # noqa: F401
    from .analyses.locus import locus as locus
    from .analyses.manoeuvres import Gust as Gust
    from .analyses.manoeuvres import Measured as Measured
    from .analyses.manoeuvres import Pulse as Pulse
    from .analyses.manoeuvres import Ramp as Ramp
    from .analyses.manoeuvres import Sine as Sine
    from .analyses.manoeuvres import SineWithDwell as SineWithDwell
    from .analyses.manoeuvres import Step as Step
    from .analyses.margins import margins as margins
    from .analyses.modes import modes as modes
    from .analyses.percussion import percussion as percussion
    from .analyses.pitching import moment_line as moment_line
    from .analyses.pitching import static_margin as static_margin
    from .analyses.power_flow import power_flow as power_flow
    from .analyses.remedies import remedies as remedies
    from .analyses.response import frequency_response as frequency_response
    from .analyses.response import impulse_response as impulse_response
    from .analyses.response import step_response as step_response
    from .analyses.rollover import rollover as rollover
    from .analyses.routh import routh as routh
    from .analyses.sensitivity import sensitivity as sensitivity
    from .analyses.show import show as show
    from .analyses.simulate import simulate as simulate
    from .analyses.stability_map import stability_map as stability_map
    from .analyses.static import static_stability as static_stability
    from .analyses.steady import axle_loads as axle_loads
    from .analyses.steady import steady_turn as steady_turn
    from .analyses.steady_family import steady_family as steady_family
    from .analyses.stream import stream as stream
    from .analyses.sweep import sweep as sweep
    from .analyses.tire_curves import cornering_coefficient as cornering_coefficient
    from .analyses.tire_curves import tire_curves as tire_curves
    from .analyses.transfer import transfer as transfer
    from .analyses.trim import trim as trim
    from .analyses.uncertainty import uncertainty as uncertainty
    from .analyses.verdict import verdict as verdict
    from .catalogue import find_model as find_model
    from .catalogue import load as load
    from .catalogue import tire as tire
    from .checks import check_model as check  # noqa: F401
    from .checks import check_model as check_model
    from .core import Model as Model
    from .core import ModelError as ModelError
    from .core import Part as Part
    from .core import UcritError as UcritError
    from .core import algebraic as algebraic
    from .core import coordinate as coordinate
    from .core import input as input
    from .core import output as output
    from .core import param as param
    from .core import slot as slot
    from .core import speed as speed
    from .core import state as state
    from .numerics.matrices import stable_matrices as stable_matrices
    from .plots import animate as animate
    from .plots import plot as plot
    from .report import write_report as write_report
    from .web.serve import app as app

__version__ = "0.1.0"

_PUBLIC: dict[str, str | tuple[str, str]] = {
    "Model": "core",
    "ModelError": "core",
    "Part": "core",
    "UcritError": "core",
    "algebraic": "core",
    "coordinate": "core",
    "input": "core",
    "output": "core",
    "param": "core",
    "slot": "core",
    "speed": "core",
    "state": "core",
    "load": "catalogue",
    "find_model": "catalogue",
    "tire": "catalogue",
    "analyze": "analyses.analyze",
    "criteria": "analyses.criteria",
    "critical": "analyses.critical",
    "locus": "analyses.locus",
    "modes": "analyses.modes",
    "remedies": "analyses.remedies",
    "sensitivity": "analyses.sensitivity",
    "stability_map": "analyses.stability_map",
    "sweep": "analyses.sweep",
    "to_control": "analyses.convert",
    "to_scipy": "analyses.convert",
    "verdict": "analyses.verdict",
    "approximation": "analyses.approximation",
    "audit": "analyses.audit",
    "axle_loads": "analyses.steady",
    "certify": "analyses.certify",
    "basin": "analyses.basin",
    "cornering_coefficient": "analyses.tire_curves",
    "boundary": "analyses.boundary",
    "cite": "analyses.cite",
    "compare": "analyses.compare",
    "cycles": ("analyses.cycles", "limit_cycles"),
    "frequency_response": "analyses.response",
    "impulse_response": "analyses.response",
    "step_response": "analyses.response",
    "Descriptor": "analyses.forms",
    "NthOrder": "analyses.forms",
    "SecondOrder": "analyses.forms",
    "StateSpace": "analyses.forms",
    "forms": "analyses.forms",
    "lazy": "analyses.lazy",
    "handling": ("analyses.handling", "handling_diagram"),
    "handling_diagram": "analyses.handling",
    "limit": "analyses.limits",
    "limit_cycles": "analyses.cycles",
    "percussion": "analyses.percussion",
    "moment_line": "analyses.pitching",
    "static_margin": "analyses.pitching",
    "dwell_criteria": "analyses.dwell",
    "rollover": "analyses.rollover",
    "routh": "analyses.routh",
    "simulate": "analyses.simulate",
    "margins": "analyses.margins",
    "simulate_delayed": "analyses.delays",
    "describe_controller": "analyses.laws",
    "Step": "analyses.manoeuvres",
    "Ramp": "analyses.manoeuvres",
    "Sine": "analyses.manoeuvres",
    "SineWithDwell": "analyses.manoeuvres",
    "Pulse": "analyses.manoeuvres",
    "Gust": "analyses.manoeuvres",
    "Measured": "analyses.manoeuvres",
    "static_stability": "analyses.static",
    "steady_family": "analyses.steady_family",
    "steady_turn": "analyses.steady",
    "tire_curves": "analyses.tire_curves",
    "transfer": "analyses.transfer",
    "stream": "analyses.stream",
    "trim": "analyses.trim",
    "uncertainty": "analyses.uncertainty",
    "bonds": "analyses.bonds",
    "power_flow": "analyses.power_flow",
    "show": "analyses.show",
    "list": ("analyses.listing", "listing"),
    "new": ("analyses.listing", "template"),
    "check": ("checks", "check_model"),
    "check_model": "checks",
    "animate": "plots",
    "plot": "plots",
    "stable_matrices": "numerics.matrices",
    "write_report": "report",
    "app": "web.serve",
}
"""Public names, and the module that has each, with its name there where it is another."""


def __getattr__(name: str) -> Any:
    """Import public names when they are first used: starting up stays as quick as importing NumPy."""
    if name not in _PUBLIC:
        raise AttributeError(f"module 'ucrit' has no attribute '{name}'")
    place = _PUBLIC[name]
    module, attribute = place if isinstance(place, tuple) else (place, name)
    value = getattr(importlib.import_module(f"ucrit.{module}"), attribute)
    globals()[name] = value
    return value


def __dir__() -> Iterable[str]:
    return sorted({*globals(), *_PUBLIC})
