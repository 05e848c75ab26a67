"""Limit cycles."""

import math

import numpy as np
from pictures import WIDTH, curve, figure_with_axes, picture

from ucrit import limit_cycles, load, plot, simulate
from ucrit.plots import style


@picture("beyond-nose-gear", compared="build")
def nose_gear():
    """Amplitude against speed, and the simulation that comes to the cycle."""
    gear = load("nose-gear", {"k": -10})
    found = limit_cycles(gear)
    figure, (left, right) = figure_with_axes(3.0, 2)
    branch = found.branches[0]
    speeds, angles = [branch.critical.value, *branch.values], [0, *np.degrees(branch.amplitudes[:, 0])]
    curve(left, speeds, angles, 0, "limit cycle")
    left.plot([25], [24.33], "o", color=style.INK, markersize=5)
    left.annotate("published", (25, 24.33), xytext=(8, -12), textcoords="offset points", fontsize=8.5)
    left.set_xlabel("forward speed [m/s]")
    left.set_ylabel("amplitude of the swivel angle [deg]")
    left.set_ylim(0, 30)
    run = simulate(gear, 2, {"psi": "5 deg"}, times=np.linspace(0, 2, 8000))
    curve(right, run.times, np.degrees(run["psi"]), 0, "swivel angle", linewidth=0.5)
    for sign in (-1, 1):
        right.axhline(sign * 24.33, color=style.INK, linewidth=1, linestyle=(0, (4, 2.2)))
    right.set_xlabel("time [s], at 25 m/s from 5 deg")
    right.set_ylabel("swivel angle [deg]")
    return figure


@picture("beyond-caravan")
def caravan():
    figure = style.new_figure(WIDTH, 3.6)
    return plot(limit_cycles(load("caravan-with-stabiliser"), upper=40), figure=figure)


@picture("beyond-caravan-motion", compared="build")
def motions_of_caravan():
    """One motion on either side of the unstable cycle."""
    figure, axes = figure_with_axes(2.7)
    vehicle = load("caravan-with-stabiliser", {"U": "90 km/h"})
    for number, angle in enumerate((8, 16)):
        run = simulate(vehicle, 60, {"theta": math.radians(angle)}, times=np.linspace(0, 60, 1600))
        curve(axes, run.times, np.degrees(run["theta"]), number, f"from {angle} deg")
    axes.set_xlabel("time [s]")
    axes.set_ylabel("yaw angle of the trailer [deg]")
    axes.legend(frameon=False, loc="upper left", ncols=2)
    axes.set_ylim(-35, 42)
    return figure


@picture("beyond-wheelset")
def wheelset():
    """A wheelset between its flanges."""
    figure = style.new_figure(WIDTH, 3.6)
    return plot(limit_cycles(load("worn-wheelset"), upper=60), figure=figure)
