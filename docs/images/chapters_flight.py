"""Pictures of chapters 7 and 9."""

import numpy as np
from pictures import curve, figure_with_axes, picture

from ucrit import load, moment_line, simulate, static_margin, step_response, trim
from ucrit.core.numeric.compiled import state_space
from ucrit.parts import wings
from ucrit.plots import style


@picture("chapter-07-steps")
def lean_steps():
    figure, panels = figure_with_axes(3.0, 2, sharey=True)
    motorcycle = load("motorcycle-lean").with_(U=5.0)
    times = np.linspace(0, 0.6, 300)
    for axes, name, text in zip(panels, ("delta_f", "delta_r"), ("front", "rear"), strict=True):
        size = np.deg2rad(2)
        exact = simulate(motorcycle, 0.6, inputs={name: size}, times=times)["theta"]
        linear = step_response(motorcycle, name, "theta", times, size=size)["theta"]
        curve(axes, times, np.rad2deg(exact), 0, "non-linear")
        curve(axes, times, np.rad2deg(linear), 1, "linear")
        axes.axhline(0, color=style.MUTED, linewidth=0.8)
        axes.set_xlabel(f"time after 2 degrees of {text} steer to the right [s]")
    panels[0].set_ylabel("lean to the right [degrees]")
    panels[0].legend(frameon=False, loc="lower left")
    return figure


@picture("chapter-09-section")
def section_lift():
    figure, (axes, moment) = figure_with_axes(2.9, 2)
    alpha = np.deg2rad(np.linspace(-10, 60, 500))
    curve(axes, np.rad2deg(alpha), wings.stalling_lift(alpha), 0, "with stall")
    small = alpha < np.deg2rad(20)
    curve(axes, np.rad2deg(alpha[small]), wings.thin_section(alpha[small])[0], 1, "attached flow")
    axes.axhline(0, color=style.MUTED, linewidth=0.8)
    axes.set_xlabel("angle of attack from zero lift [degrees]")
    axes.set_ylabel("lift coefficient of a section")
    axes.legend(frameon=False, loc="upper right")
    alpha = np.deg2rad(np.linspace(-4, 10, 50))
    lift, leading = wings.thin_section(alpha, 0.05)
    curve(moment, lift, leading, 2, "about the leading edge")
    curve(moment, lift, leading + lift / 4, 3, "about a quarter of the chord")
    moment.axhline(0, color=style.MUTED, linewidth=0.8)
    moment.set_xlabel("lift coefficient")
    moment.set_ylabel("moment coefficient, with camber")
    moment.set_ylim(-0.4, 0.2)
    moment.legend(frameon=False, loc="upper right")
    return figure


@picture("chapter-09-moment")
def moment_lines():
    figure, (elevator, place) = figure_with_axes(3.3, 2, sharey=True)
    plane = load("navion-from-geometry")
    level = trim(plane)
    changes = np.array([-3.0, 0.0, 3.0])
    lines = moment_line(plane, "delta_e", level["delta_e"] + np.deg2rad(changes), angles=(-0.08, 0.1))
    words = ("3 degrees up", "level flight", "3 degrees down")
    for number, (lift, moment, trimmed) in enumerate(zip(lines.lift, lines.moment, lines.trimmed, strict=True)):
        curve(elevator, lift, moment, number, words[number])
        elevator.plot([trimmed], [0], "o", color=style.INK, markersize=5, zorder=5)
    neutral = static_margin(plane).neutral_point
    for number, (h, text) in enumerate(((plane.h, "ahead of"), (neutral, "at"), (neutral + 0.1, "behind"))):
        line = moment_line(plane.with_(h=h), angles=(-0.08, 0.1))
        curve(place, line.lift[0], line.moment[0], number, f"{text} the neutral point")
    for axes, title in ((elevator, "elevator"), (place, "centre of mass")):
        axes.axhline(0, color=style.MUTED, linewidth=0.8)
        axes.set_xlabel("lift coefficient")
        axes.set_ylim(-0.22, 0.18)
        axes.legend(frameon=False, loc="lower left", title=title)
    elevator.set_ylabel("moment coefficient")
    return figure


@picture("chapter-09-phugoid")
def phugoid_speeds():
    figure, axes = figure_with_axes(2.9)
    full, simple = load("navion-from-geometry"), load("navion-phugoid")
    times = np.linspace(0, 120, 600)
    flight = simulate(full, 120, {"u": full.U + 5}, times=times)
    curve(axes, times, np.hypot(flight["u"], flight["w"]), 0, "airplane with wing, tail and elevator")
    curve(axes, times, simulate(simple, 120, {"V": simple.U + 5}, times=times)["V"], 1, "phugoid with drag")
    axes.axhline(full.U, color=style.MUTED, linewidth=0.8)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("speed [m/s]")
    axes.legend(frameon=False, loc="upper right")
    return figure


@picture("chapter-09-last-term")
def last_terms():
    figure, (left, right) = figure_with_axes(3.1, 2)
    plane = load("navion-plane")
    for number, (x_a, text) in enumerate(((plane.x_a, "as it is"), (0.55, "0.55 m"), (0.8, "0.8 m"))):
        U = np.linspace(5, 80, 200)
        curve(left, U, np.linalg.det(state_space(plane.with_(x_a=x_a, U=U)).A), number, text)
    for number, name in enumerate(("understeering-car", "neutral-car", "oversteering-car")):
        U = np.linspace(20, 60, 200)
        car = load(name)
        curve(right, U, np.linalg.det(state_space(car.with_(U=U)).A), number, car.info.name)
    left.legend(frameon=False, loc="upper left", title="centre of mass to wing")
    right.legend(frameon=False, loc="upper right")
    right.set_ylim(-10, 40)
    for axes in (left, right):
        axes.axhline(0, color=style.INK, linewidth=0.9)
        axes.set_xlabel("speed [m/s]")
    left.set_ylabel("last term per leading term [1/s²]")
    return figure
