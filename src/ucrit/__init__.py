"""Is the vehicle stable, up to what speed, how does it fail, and what should be changed?"""

from __future__ import annotations

import builtins
import importlib
from collections.abc import Iterable
from types import FunctionType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:  # the same names as in _PUBLIC, for type checkers and editors
    from .analyses.about.bonds import bonds as bonds
    from .analyses.about.cite import cite as cite
    from .analyses.about.laws import describe_controller as describe_controller
    from .analyses.about.listing import listing as list  # noqa: F401
    from .analyses.about.listing import template as new  # noqa: F401
    from .analyses.about.show import show as show
    from .analyses.linear.forms import Descriptor as Descriptor
    from .analyses.linear.forms import NthOrder as NthOrder
    from .analyses.linear.forms import SecondOrder as SecondOrder
    from .analyses.linear.forms import StateSpace as StateSpace
    from .analyses.linear.forms import forms as forms
    from .analyses.linear.modes import modes as modes
    from .analyses.linear.percussion import percussion as percussion
    from .analyses.linear.response import frequency_response as frequency_response
    from .analyses.linear.response import impulse_response as impulse_response
    from .analyses.linear.response import step_response as step_response
    from .analyses.linear.steady import axle_loads as axle_loads
    from .analyses.linear.steady import steady_turn as steady_turn
    from .analyses.linear.transfer import transfer as transfer
    from .analyses.linear.trim import trim as trim
    from .analyses.motion.audit import audit as audit
    from .analyses.motion.delays import simulate_delayed as simulate_delayed
    from .analyses.motion.dwell import dwell_criteria as dwell_criteria
    from .analyses.motion.manoeuvres import Gust as Gust
    from .analyses.motion.manoeuvres import Measured as Measured
    from .analyses.motion.manoeuvres import Pulse as Pulse
    from .analyses.motion.manoeuvres import Ramp as Ramp
    from .analyses.motion.manoeuvres import Sine as Sine
    from .analyses.motion.manoeuvres import SineWithDwell as SineWithDwell
    from .analyses.motion.manoeuvres import Step as Step
    from .analyses.motion.power_flow import power_flow as power_flow
    from .analyses.motion.simulate import simulate as simulate
    from .analyses.nonlinear.basin import basin as basin
    from .analyses.nonlinear.cycles import limit_cycles as cycles  # noqa: F401
    from .analyses.nonlinear.cycles import limit_cycles as limit_cycles
    from .analyses.nonlinear.handling import handling_diagram as handling  # noqa: F401
    from .analyses.nonlinear.handling import handling_diagram as handling_diagram
    from .analyses.nonlinear.rollover import rollover as rollover
    from .analyses.nonlinear.steady_family import steady_family as steady_family
    from .analyses.nonlinear.tire_curves import cornering_coefficient as cornering_coefficient
    from .analyses.nonlinear.tire_curves import tire_curves as tire_curves
    from .analyses.regions.boundary import boundary as boundary
    from .analyses.regions.certify import certify as certify
    from .analyses.regions.lazy import lazy as lazy
    from .analyses.regions.stability_map import stability_map as map  # noqa: F401
    from .analyses.regions.stability_map import stability_map as stability_map
    from .analyses.regions.stream import stream as stream
    from .analyses.regions.sweep import sweep as sweep
    from .analyses.regions.uncertainty import uncertainty as uncertainty
    from .analyses.results.convert import to_control as to_control
    from .analyses.results.convert import to_scipy as to_scipy
    from .analyses.stability.analyze import analyze as analyze
    from .analyses.stability.approximation import approximation as approximation
    from .analyses.stability.compare import compare as compare
    from .analyses.stability.criteria import criteria as criteria
    from .analyses.stability.critical import critical as critical
    from .analyses.stability.limits import limit as limit
    from .analyses.stability.locus import locus as locus
    from .analyses.stability.margins import margins as margins
    from .analyses.stability.pitching import moment_line as moment_line
    from .analyses.stability.pitching import static_margin as static_margin
    from .analyses.stability.remedies import remedies as remedies
    from .analyses.stability.routh import routh as routh
    from .analyses.stability.sensitivity import sensitivity as sensitivity
    from .analyses.stability.static import static_stability as static_stability
    from .analyses.stability.verdict import verdict as verdict
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
    "analyze": "analyses.stability.analyze",
    "criteria": "analyses.stability.criteria",
    "critical": "analyses.stability.critical",
    "locus": "analyses.stability.locus",
    "modes": "analyses.linear.modes",
    "remedies": "analyses.stability.remedies",
    "sensitivity": "analyses.stability.sensitivity",
    "stability_map": "analyses.regions.stability_map",
    "sweep": "analyses.regions.sweep",
    "to_control": "analyses.results.convert",
    "to_scipy": "analyses.results.convert",
    "verdict": "analyses.stability.verdict",
    "approximation": "analyses.stability.approximation",
    "audit": "analyses.motion.audit",
    "axle_loads": "analyses.linear.steady",
    "certify": "analyses.regions.certify",
    "basin": "analyses.nonlinear.basin",
    "cornering_coefficient": "analyses.nonlinear.tire_curves",
    "boundary": "analyses.regions.boundary",
    "cite": "analyses.about.cite",
    "compare": "analyses.stability.compare",
    "cycles": ("analyses.nonlinear.cycles", "limit_cycles"),
    "frequency_response": "analyses.linear.response",
    "impulse_response": "analyses.linear.response",
    "step_response": "analyses.linear.response",
    "Descriptor": "analyses.linear.forms",
    "NthOrder": "analyses.linear.forms",
    "SecondOrder": "analyses.linear.forms",
    "StateSpace": "analyses.linear.forms",
    "forms": "analyses.linear.forms",
    "lazy": "analyses.regions.lazy",
    "handling": ("analyses.nonlinear.handling", "handling_diagram"),
    "handling_diagram": "analyses.nonlinear.handling",
    "limit": "analyses.stability.limits",
    "limit_cycles": "analyses.nonlinear.cycles",
    "percussion": "analyses.linear.percussion",
    "moment_line": "analyses.stability.pitching",
    "static_margin": "analyses.stability.pitching",
    "dwell_criteria": "analyses.motion.dwell",
    "rollover": "analyses.nonlinear.rollover",
    "routh": "analyses.stability.routh",
    "simulate": "analyses.motion.simulate",
    "margins": "analyses.stability.margins",
    "simulate_delayed": "analyses.motion.delays",
    "describe_controller": "analyses.about.laws",
    "Step": "analyses.motion.manoeuvres",
    "Ramp": "analyses.motion.manoeuvres",
    "Sine": "analyses.motion.manoeuvres",
    "SineWithDwell": "analyses.motion.manoeuvres",
    "Pulse": "analyses.motion.manoeuvres",
    "Gust": "analyses.motion.manoeuvres",
    "Measured": "analyses.motion.manoeuvres",
    "static_stability": "analyses.stability.static",
    "steady_family": "analyses.nonlinear.steady_family",
    "steady_turn": "analyses.linear.steady",
    "tire_curves": "analyses.nonlinear.tire_curves",
    "transfer": "analyses.linear.transfer",
    "stream": "analyses.regions.stream",
    "trim": "analyses.linear.trim",
    "uncertainty": "analyses.regions.uncertainty",
    "bonds": "analyses.about.bonds",
    "power_flow": "analyses.motion.power_flow",
    "show": "analyses.about.show",
    "list": ("analyses.about.listing", "listing"),
    "map": ("analyses.regions.stability_map", "stability_map"),
    "new": ("analyses.about.listing", "template"),
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
    if name == "__all__":  # what a star brings: all but the names that would hide Python's own
        return sorted(_PUBLIC.keys() - vars(builtins).keys())
    if name not in _PUBLIC:
        raise AttributeError(f"module 'ucrit' has no attribute '{name}'")
    place = _PUBLIC[name]
    module, attribute = place if isinstance(place, tuple) else (place, name)
    value = getattr(importlib.import_module(f"ucrit.{module}"), attribute)
    if isinstance(value, FunctionType):
        if attribute != name and attribute in _PUBLIC:  # another name for the same function
            return globals().setdefault(name, __getattr__(attribute))
        value = importlib.import_module("ucrit.core.asked").asked(value, name)
    elif "__dataclass_fields__" in vars(value):
        value = importlib.import_module("ucrit.core.asked").asked_class(value, name)
    return globals().setdefault(name, value)


def __dir__() -> Iterable[str]:
    return sorted({*globals(), *_PUBLIC})
