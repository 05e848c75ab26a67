"""Stability control."""

import numpy as np
from pictures import curve, figure_with_axes, picture

from ucrit import SineWithDwell, dwell_criteria, load, simulate
from ucrit.analyses.motion.scene import scene

BARE, CAR = load("car-on-worn-rear-tires"), load("car-with-stability-control")
FAST = {"tolerance": 1e-5}
STEERED = SineWithDwell("7 deg", at=0.5)


def three_curves(motions):
    """Yaw rate, sideslip angle and path of several motions."""
    figure, (turn, slide, ground) = figure_with_axes(2.7, 3)
    for number, (label, motion) in enumerate(motions.items()):
        shown = np.abs(motion["beta"]) < np.deg2rad(80)
        last = len(shown) if shown.all() else int(np.argmin(shown))
        curve(turn, motion.times[:last], np.rad2deg(motion["r"][:last]), number, label)
        curve(slide, motion.times[:last], np.rad2deg(motion["beta"][:last]), number, None)
        path = scene(motion).path
        curve(ground, path[:, 0], -path[:, 1], number, None)
    for axes, text in ((turn, "yaw rate [deg/s]"), (slide, "sideslip angle [deg]")):
        axes.set_xlabel("time [s]")
        axes.set_ylabel(text)
    ground.set_xlabel("ahead [m]")
    ground.set_ylabel("to the right [m]")
    ground.invert_yaxis()
    turn.legend(frameon=False, loc="best", fontsize=8)
    return figure


@picture("stability-control-dwell", compared="build")
def dwell():
    """The sine with dwell of 7 degrees at 80 km/h."""
    cars = {"without": BARE, "with control": CAR}
    return three_curves(
        {label: simulate(car, 4.5, inputs={"delta_f": STEERED}, **FAST) for label, car in cars.items()},
    )


@picture("stability-control-split", compared="build")
def split():
    """Full braking from 80 km/h with 0.3 of the friction on the left."""
    road, brake = {"mu_left": 0.3}, {"brake": 9000}
    front, rear = CAR.share / 2 * 9000, (1 - CAR.share) / 2 * 9000
    locked = {"brake_fl": front, "brake_fr": front, "brake_rl": rear, "brake_rr": rear}
    return three_curves(
        {
            "brakes only": simulate(BARE, 6, inputs=road | locked, **FAST),
            "slip control": simulate(CAR.with_(G=0), 6, inputs=road | brake, **FAST),
            "stability control": simulate(CAR, 6, inputs=road | brake, **FAST),
        },
    )


def passes(car, U, size):
    steered = SineWithDwell(size, at=0.1)
    motion = simulate(car.with_(U=U), 3.8, inputs={"delta_f": steered}, tolerance=1e-4)
    return dwell_criteria(motion, steered).stable


def largest(car, U, top, step):
    """Steer angle [rad] up to which the car passes with all, in steps, and then to an eighth of a step."""
    low, high = 0.0, step
    while high <= top and passes(car, U, high):  # a car that has spun may pass again at a larger one
        low, high = high, high + step
    if high > top:
        return top
    for _ in range(3):
        middle = (low + high) / 2
        low, high = (middle, high) if passes(car, U, middle) else (low, middle)
    return low


@picture("stability-control-limits", compared="hand")
def limits():
    """Largest steer angle of a sine with dwell that is passed, over speed."""
    figure, axes = figure_with_axes(3.0)
    speeds = np.arange(50, 211, 40) / 3.6
    for number, (label, car) in enumerate({"without": BARE, "with control": CAR}.items()):
        held = np.array([largest(car, U, *np.deg2rad((16, 2))) for U in speeds])
        shown = np.where(held < np.deg2rad(15.9), np.rad2deg(held), np.nan)
        curve(axes, speeds * 3.6, shown, number, label, marker="o", markersize=3)
    axes.set_ylim(0, 16)
    axes.set_xlabel("speed [km/h]")
    axes.set_ylabel("steer angle that is passed [deg]")
    axes.legend(frameon=False)
    return figure
