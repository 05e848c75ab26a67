"""Responses that chapters 1, 3 and 9 sketch."""

import numpy as np
from pictures import curve, figure_with_axes, picture

from ucrit import load, modes, simulate
from ucrit.plots import style

DROPPED = (("understeering-car", 30), ("oversteering-car-on-the-road", 20), ("oversteering-car-on-the-road", 40))


@picture("chapter-01-responses")
def cart_responses():
    figure, axes = figure_with_axes(2.9)
    times = np.linspace(0, 1.5, 200)
    for number, (U, text) in enumerate(((-1.2, "pushed backward"), (1.2, "pushed forward"))):
        cart = load("supermarket-cart").with_(U=U)
        root = modes(cart).eigenvalues.real
        root = root[np.argmax(np.abs(root))]
        curve(axes, times, np.exp(root * times), number, f"{text}, s = {root:.2f} 1/s")
    axes.set_xlabel("time [s]")
    axes.set_ylabel("yaw rate over its first value")
    axes.set_ylim(0, 8)
    axes.legend(frameon=False, loc="upper left")
    return figure


@picture("chapter-03-responses")
def marbles_and_mass():
    figure, (marble, mass) = figure_with_axes(3.0, 2)
    times = np.linspace(0, 3, 400)
    for number, place in enumerate(("in-a-bowl", "on-the-flat", "on-a-hill")):
        found = simulate(load(f"marble-{place}"), 3, {"x": 0.01}, times=times)["x"]
        end = int(np.argmax(np.abs(found) > 0.03)) or times.size
        curve(marble, times[:end], 100 * found[:end], number, place.replace("-", " "))
    marble.set_ylabel("distance from rest [cm]")
    marble.set_ylim(-1.2, 3)
    driven = load("driven-mass")
    times = np.linspace(0, 15, 600)
    for number, (sense, text) in enumerate(((-1, "b > 0"), (0, "b = 0"), (1, "b < 0"))):
        found = simulate(driven.with_(b=sense * driven.b), 15, {"x": 0.01}, times=times)["x"]
        curve(mass, times, 100 * found, number, text)
    mass.set_ylabel("displacement [cm]")
    for axes, place in ((marble, "upper right"), (mass, "upper left")):
        axes.axhline(0, color=style.MUTED, linewidth=0.8)
        axes.set_xlabel("time [s]")
        axes.legend(frameon=False, loc=place)
    return figure


@picture("chapter-09-paths")
def dropped_cars():
    figure, axes = figure_with_axes(3.0)
    words = ("understeering, 30 m/s", "oversteering below its critical speed, 20 m/s", "oversteering above it, 40 m/s")
    for number, ((name, U), text) in enumerate(zip(DROPPED, words, strict=True)):
        values = {key: load(name).values[key] for key in ("m", "I_z", "a", "b", "C_f", "C_r")}
        car = load("oversteering-car-on-the-road").with_(**values, U=U)
        times = np.linspace(0, 120 / U, 300)
        found = simulate(car, times[-1], {"psi": np.deg2rad(3)}, times=times)
        curve(axes, U * times, found["y"], number, text)
    axes.axhline(0, color=style.MUTED, linewidth=0.8)
    axes.set_xlabel("distance along the road [m]")
    axes.set_ylabel("to the right [m]")
    axes.invert_yaxis()
    axes.legend(frameon=False, loc="lower left")
    return figure
