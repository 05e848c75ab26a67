"""Pictures of chapters 7 (control) and 11."""

import re
import sys
import types
from pathlib import Path

import numpy as np
from pictures import curve, figure_with_axes, picture

from ucrit import load, margins, simulate, step_response
from ucrit.catalogue import find_controller
from ucrit.control import close, observer, place, slide

PAGE = Path(__file__).parent.parent / "chapter-11.md"


@picture("chapter-07-front")
def step_of_lean():
    ridden = load("motorcycle-steered-to-lean")
    size = np.radians(5)
    moved = simulate(ridden, 4, inputs={"theta_d": size})
    linear = step_response(ridden, "theta_d", ["theta", "delta_f"], np.linspace(0, 4, 41))
    figure, axes = figure_with_axes(2.9)
    for number, (name, text) in enumerate((("theta", "lean"), ("delta_f", "front steer angle"))):
        curve(axes, moved.times, np.degrees(moved[name]), number, text)
        column = list(linear.outputs).index(name)
        values = np.degrees(size * linear.values[..., column])
        curve(axes, linear.times, values, number, None, linestyle="none", marker=".")
    axes.axhline(5, color="0.6", linewidth=0.8)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("angle [degrees]")
    axes.legend(frameon=False)
    return figure


@picture("chapter-07-turn")
def step_of_curvature():
    ridden = close(load("motorcycle-steered-to-lean"), find_controller("lean-from-curvature"))
    figure, axes = figure_with_axes(2.9, columns=2)
    for number, radius in enumerate((400, 200, 100)):
        moved = simulate(ridden, 4, inputs={"kappa_d": 1 / radius})
        curve(axes[0], moved.times, np.degrees(moved["theta"]), number, f"{radius} m wanted")
        curve(axes[1], moved.times, 1e3 * moved["r"] / ridden.U, number, f"{radius} m wanted")
    axes[0].set_ylabel("lean [degrees]")
    axes[1].set_ylabel("curvature of the path [1/km]")
    for one in axes:
        one.set_xlabel("time [s]")
    axes[1].legend(frameon=False)
    return figure


def windy_car():
    """Run the model that the page shows."""
    text = re.search(r"^```python\n(# file: windy_car.py\n.*?)^```$", PAGE.read_text(), re.MULTILINE | re.DOTALL)[1]
    module = types.ModuleType("windy_car")
    sys.modules["windy_car"] = module
    exec(text, module.__dict__)
    tires = {"front_C": 45e3, "rear_C": 50e3, "front_mu": 0.9, "rear_mu": 0.9}
    return module.WindyCar(m=1500, I_z=2500, a=1.25, b=1.5, x_w=0.4, U=25, **tires)


@picture("chapter-11-robust", compared="build")
def robustness():
    car, reference = windy_car(), load("neutral-car")
    changed = ["m", "I_z", "front_C", "rear_C", "front_mu", "rear_mu"]
    seen = observer(car, "r", [-15, -20], own=changed, unknown=["F_w"])
    options = {"alpha": 4, "phi": 0.05, "reference": reference, "own": changed}
    held = {
        "not controlled": car,
        "placed poles": place(car, "delta_f", [-6 + 3j, -6 - 3j]),
        "reference, G = 0.2 s": close(car, find_controller("yaw-rate-reference"), G=0.2),
        "sliding, V estimated": slide(seen, "delta_f", "r", estimated=["V"], **options),
    }
    figure, axes = figure_with_axes(3.1, columns=2, sharey=True)
    for number, (text, one) in enumerate(held.items()):
        for place_of, (changes, force) in zip(axes, (({"rear_C": 35e3}, 0), ({}, 2500)), strict=True):
            inputs = {"delta_f": lambda t: 0.025 * min(t / 0.2, 1)}
            gust = {"F_w": lambda t, force=force: force * (1.5 < t < 2.5)}
            moved = simulate(one.with_(**changes), 3, inputs=inputs | gust, tolerance=1e-6)
            plain = simulate(one, 3, inputs=inputs, tolerance=1e-6)
            curve(place_of, moved.times, 100 * (moved["r"] - plain["r"]) / plain["r"][-1], number, text)
    for one, title in zip(axes, ("rear tires 30 % softer", "gust from 1.5 s to 2.5 s"), strict=True):
        one.set_title(title, fontsize=9)
        one.set_xlabel("time [s]")
    axes[0].set_ylabel("change of the yaw rate [%]")
    axes[0].legend(frameon=False, fontsize=8)
    return figure


@picture("chapter-11-margins")
def margins_over_speed():
    figure, axes = figure_with_axes(2.9, columns=2)
    U = np.linspace(6, 80, 400)
    for number, (name, input) in enumerate(
        (("motorcycle-steered-to-lean", "delta_f"), ("motorcycle-steered-at-the-rear", "delta_r"))
    ):
        found = margins(load(name).with_(U=U), input)
        text = "front" if input == "delta_f" else "rear"
        curve(axes[0], U, found.disk, number, text)
        curve(axes[1], U, 1e3 * found.delay, number, text)
    axes[0].set_ylabel("disk margin")
    axes[1].set_ylabel("delay margin [ms]")
    for one in axes:
        one.set_xlabel("speed [m/s]")
        one.set_ylim(bottom=0)
    axes[0].legend(frameon=False)
    return figure
