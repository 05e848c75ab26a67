"""Cars near the limit, for chapter 6."""

import numpy as np
from pictures import WIDTH, curve, figure_with_axes, picture

from ucrit import handling_diagram, load, rollover
from ucrit.plots import plot_handling, style


@picture("chapter-06-handling")
def handling():
    figure = style.new_figure(WIDTH, 2.9)
    plot_handling(handling_diagram(load("spinning-car")), figure=figure)
    return figure


@picture("chapter-06-limit")
def steering():
    """Figure 6.15: steer angle against curvature at three speeds."""
    figure, (spins, ploughs) = figure_with_axes(3.1, 2)
    for axes, name in ((spins, "spinning-car"), (ploughs, "ploughing-car")):
        for number, U in enumerate((15, 25, 35)):
            found = handling_diagram(load(name).with_(U=U))
            delta = np.rad2deg(found.delta)
            for flag, dash in ((True, "-"), (False, (0, (3, 1.6)))):
                shown = np.where(found.stable == flag, delta, np.nan)
                label = f"{U} m/s" if flag else None
                curve(axes, found.curvature, shown, number, label, linestyle=dash)
        axes.set_title(load(name).info.name, fontsize=9)
        axes.set_ylim(-1, 10)
        axes.set_xlim(0, 0.036)
        axes.set_xlabel("curvature 1/R [1/m]")
        axes.set_ylabel("steer angle [deg]")
    spins.legend(frameon=False, loc="upper right", title="dashed: unstable", title_fontsize=8.5)
    return figure


@picture("chapter-06-loads")
def loads():
    """Problem 6.8: loads of the four wheels in a turn to the right."""
    car = load("four-wheel-car")
    found, turns = rollover(car), handling_diagram(car).family
    figure, axes = figure_with_axes(3.0)
    names = {"F_fl": "front left", "F_rl": "rear left", "F_rr": "rear right", "F_fr": "front right"}
    for number, (name, text) in enumerate(names.items()):
        curve(axes, turns["a_y"] / car.g, turns[name] / 1e3, number, text)
    axes.axvline(found.threshold / car.g, color=style.MUTED, linewidth=0.9)
    style.label(
        axes, "rolls over", (found.threshold / car.g, 8), xytext=(-4, 0), textcoords="offset points", ha="right"
    )
    axes.set_ylim(0, 9)
    axes.set_xlim(0, 1.45)
    axes.set_xlabel("lateral acceleration [g]")
    axes.set_ylabel("load of a wheel [kN]")
    axes.legend(frameon=False, loc="upper left")
    return figure
