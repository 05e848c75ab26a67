"""The sine-with-dwell test of stability control: does the car stop turning when the steering does?

A car that is steered through one period of a sine, held at its second peak, must have all but ceased to yaw 1 s and
1.75 s after the steering is straight again, and must have moved aside enough soon after it began (49 CFR 571.126,
S5.2: Federal Motor Vehicle Safety Standard No. 126 of the United States).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.contract.model import Model
from ...core.errors import UcritError
from ..results.convert import Array, Series, Table, Tabular
from .manoeuvres import SineWithDwell
from .scene import scene
from .simulation import Simulation

CHECKED = ((1.0, 0.35), (1.75, 0.20))
"""Times [s] after the steering is straight, and the largest share of the second peak of the yaw rate left then."""

ASIDE_AT = 1.07
"""Time [s] after the steering began at which the car must have moved aside."""

STEP = 1e-3
"""Times between which a peak is looked for [s]."""


@dataclass(frozen=True)
class DwellVerdict(Tabular):
    """How a car came through a sine with dwell.

    Attributes
    ----------
    vehicle, manoeuvre
        What was driven, and how it was steered.
    begin, complete
        Times [s] at which the steering begins and is straight again.
    peak
        Second peak of the yaw rate [rad/s], the first after the steer angle changed its sign.
    times, remainders
        Times [s] after completion, and the yaw rate then over that peak; nan where the motion had ended before.
    allowed
        The largest remainders that pass, in the same order.
    displacement, needed
        How far the centre of mass had moved aside 1.07 s after the beginning [m], and how far it must.
    ended
        Name of the event that ended the motion, if one did.
    """

    vehicle: Model
    manoeuvre: SineWithDwell
    begin: float
    complete: float
    peak: float
    times: Array
    remainders: Array
    allowed: Array
    displacement: float
    needed: float
    ended: str = ""

    @property
    def stable(self) -> bool:
        """Whether little enough is left of the yaw rate."""
        return bool(np.all(self.remainders <= self.allowed))  # nan is above all

    @property
    def responsive(self) -> bool:
        """Whether the car moved aside far enough; asked only of large steer angles (S5.2.3)."""
        return self.displacement >= self.needed

    def __str__(self) -> str:
        name = self.vehicle.info.name or type(self.vehicle).model_id()
        lines = [f"{name}: {'stable' if self.stable else 'NOT STABLE'} in a sine with dwell of {self.manoeuvre.size}"]
        lines.append(f"    yaw rate: second peak {np.degrees(self.peak):.1f} deg/s")
        for time, left, most in zip(self.times, self.remainders, self.allowed, strict=True):
            shown = f"{round(100 * left)} %" if np.isfinite(left) else f"before that it {self.ended}"
            lines.append(f"    {time:g} s after completion: {shown} (at most {100 * most:.0f} %)")
        verb = "enough" if self.responsive else "too little"
        lines.append(f"    {ASIDE_AT} s after the beginning: {self.displacement:.2f} m aside, {verb}")
        return "\n".join(lines)

    def table(self) -> Table:
        """Return remainders over time, and displacement."""
        data = (
            Series("remainder", ("after",), self.remainders, "1"),
            Series("allowed", ("after",), self.allowed, "1"),
            Series("peak", (), np.array(self.peak), "rad/s"),
            Series("displacement", (), np.array(self.displacement), "m"),
        )
        return Table("sine with dwell", self.vehicle, (Series("after", ("after",), self.times, "s"),), data, ("after",))


def dwell_criteria(
    simulation: Simulation, manoeuvre: SineWithDwell, *, yaw_rate: str = "r", needed: float = 1.83
) -> DwellVerdict:
    """Judge a simulated sine with dwell.

    Parameters
    ----------
    simulation
        A single motion that `simulate` followed until at least 1.75 s after the steering is straight, or to an event.
    manoeuvre
        What the vehicle was steered by.
    yaw_rate
        Name of the yaw rate [rad/s], a state or an output.
    needed
        Displacement [m] that is asked for: 1.83 for a car of up to 3500 kg, 1.52 for a heavier one.

    Returns
    -------
    DwellVerdict
        By 49 CFR 571.126, S5.2.1 to S5.2.3; its sides are the same for both directions of steering.

    Raises
    ------
    UcritError
        If the simulation is a batch, too short, or its model says not what it looks like, hence how it travels.

    Examples
    --------
    >>> from ucrit import SineWithDwell, load, simulate
    >>> steered = SineWithDwell("2 deg", at=0.5)
    >>> found = dwell_criteria(simulate(load("understeering-car"), 5, inputs={"delta_f": steered}), steered)
    >>> found.stable, found.responsive, round(float(np.degrees(found.peak)), 1)
    (True, False, -12.4)
    """
    begin, change, complete = instants(manoeuvre)
    end = float(simulation.times[-1])
    if not simulation.ended and end < complete + CHECKED[-1][0]:
        raise UcritError(
            f"the manoeuvre must be followed until {complete + CHECKED[-1][0]:g} s at least, got {end:g} s"
        )
    grid = np.arange(change, min(complete, end), STEP)
    if simulation.dims or grid.size < 3:
        raise UcritError("a sine with dwell is judged for one motion that gets as far as its second half")
    peak = _first_peak(simulation.at(grid)[yaw_rate])
    after = np.array([time for time, _ in CHECKED])
    reached = complete + after <= end
    left = np.full(len(after), np.nan)
    if reached.any():
        left[reached] = simulation.at(complete + after[reached])[yaw_rate] / peak
    aside = np.nan
    if begin + ASIDE_AT <= end:
        path = scene(simulation, np.linspace(0.0, begin + ASIDE_AT, 400)).path
        aside = float(abs(path[-1, 1] - np.interp(begin, np.linspace(0.0, begin + ASIDE_AT, 400), path[:, 1])))
    allowed = np.array([most for _, most in CHECKED])
    return DwellVerdict(
        simulation.vehicle, manoeuvre, begin, complete, peak, after, left, allowed, aside, needed, simulation.ended
    )


def instants(manoeuvre: SineWithDwell) -> tuple[float, float, float]:
    """Return when a sine with dwell begins, changes its sign and is completed [s]."""
    begin, quarter, dwell, rest = np.diff((0.0, *manoeuvre.times()))
    return begin, begin + 2 * quarter / 3, begin + quarter + dwell + rest


def _first_peak(rates: Array) -> float:
    """Return the first extreme of the yaw rate that a changed steer angle leads to, or where it has got by the end."""
    side = np.sign(rates[-1])
    turned = side * rates
    higher = (turned[1:-1] > 0) & (turned[1:-1] >= turned[:-2]) & (turned[1:-1] > turned[2:])
    place = int(np.argmax(higher)) + 1 if higher.any() else len(rates) - 1
    return float(rates[place])
