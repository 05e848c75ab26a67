"""Pictures of chapters 1, 5, 6, 8 and 10."""

import numpy as np
from pictures import WIDTH, curve, figure_with_axes, picture
from scipy.integrate import solve_ivp

from ucrit import critical, load, locus, stability_map, steady_turn, step_response, sweep
from ucrit.core.numeric.motion import motion
from ucrit.plots import plot_damping, plot_map, style
from ucrit.plots.labels import math_symbol


def simulate(vehicle, start, end, points=600):
    """Integrate the non-linear equations of a vehicle; return times and states."""
    moving, values = motion(type(vehicle)), vehicle.arguments()
    times = np.linspace(0, end, points)
    found = solve_ivp(lambda t, w: moving.rhs(w, [], values), (0, end), start, t_eval=times, rtol=1e-9, atol=1e-12)
    return found.t, dict(zip(moving.labels, found.y, strict=True))


@picture("chapter-01-wheelset")
def wheelset_paths():
    wheelset = load("wheelset-1-in-20")
    speed = wheelset.values["r_0"] * wheelset.values["Omega"]
    figure, axes = figure_with_axes(2.9)
    for number, (Psi, text) in enumerate(
        ((0.05, "taper 1 in 20"), (0.0, "no taper"), (-0.05, "taper the wrong way round"))
    ):
        times, states = simulate(wheelset.with_(Psi=Psi), [5e-3, 0], 40 / speed)
        y = 1e3 * states["y"]
        end = int(np.argmax(np.abs(y) > 12)) or y.size
        curve(axes, speed * times[:end], y[:end], number, text)
    axes.set_xlabel("distance along the track [m]")
    axes.set_ylabel("lateral displacement [mm]")
    axes.set_ylim(-6, 12)
    axes.legend(frameon=False, loc="upper right")
    return figure


@picture("chapter-01-cart")
def cart_swings_round():
    cart = load("supermarket-cart").with_(U=-1.2)
    b = cart.values["b"]
    times, states = simulate(cart, [-1.2, b * 0.01, 0.01], 6)
    v_x, v_y, r = (states[name] for name in ("v_x", "v_y", "r"))

    def integral(values):
        return np.concatenate([[0], np.cumsum((values[1:] + values[:-1]) / 2 * np.diff(times))])

    psi = integral(r)
    X = integral(v_x * np.cos(psi) - v_y * np.sin(psi))
    Y = integral(v_x * np.sin(psi) + v_y * np.cos(psi))
    figure = style.new_figure(WIDTH, 3.1)
    seen, over = figure.subplots(1, 2, width_ratios=(1.15, 1))
    for one in (seen, over):
        style.tidy(one)
    seen.plot(X, Y, color=style.MUTED, linewidth=1)
    corners = np.array([[-b, 0.28], [-b, -0.28], [0.5, -0.22], [0.5, 0.22], [-b, 0.28]])
    for at in (0, 1.5, 3.0, 4.25, 5.5):
        i = int(np.argmin(np.abs(times - at)))
        c, s = np.cos(psi[i]), np.sin(psi[i])
        x, y = X[i] + corners @ [c, -s], Y[i] + corners @ [s, c]
        seen.plot(x, y, color=style.colour(0), linewidth=1)
        seen.plot(x[:2], y[:2], color=style.INK, linewidth=3)
        place = (0, 22) if at < 3 else (-26, 16) if at < 5 else (36, -8)
        style.label(seen, f"{at:g} s", (X[i], Y[i]), xytext=place, textcoords="offset points", ha="center")
    seen.set_aspect("equal", adjustable="datalim")
    seen.set_xlabel("X [m]")
    seen.set_ylabel("Y [m]")
    curve(over, times, v_x, 0, "forward velocity [m/s]")
    curve(over, times, r, 1, "yaw rate [rad/s]")
    over.axhline(0, color=style.MUTED, linewidth=0.8)
    over.set_xlabel("time [s]")
    over.legend(frameon=False, loc="upper left")
    over.set_ylim(-1.5, 3.6)
    return figure


@picture("chapter-05-damping")
def trailer_damping():
    caravan = load("caravan")
    figure = style.new_figure(WIDTH, 3.6)
    grid = stability_map(caravan, c=np.linspace(0, 12e3, 400), U=np.linspace(1, 40, 400))
    plot_map(grid, vehicle=caravan, figure=figure)
    axes = figure.axes[0]
    rigid = critical(load("caravan-rigid-tire"))[0].value / load("caravan-rigid-tire").values["c"]
    c = np.array([0, 12e3])
    axes.plot(c, rigid * c, color=style.colour(1), linestyle=style.dash(1), linewidth=1.6, zorder=5)
    axes.set_ylim(1, 40)
    style.label(axes, "tires that do not slip", (4500, 20.9), rotation=32, ha="center", va="top")
    return figure


@picture("chapter-05-locus")
def trailer_locus():
    trailer = load("caravan-rigid-hitch")
    p = trailer.values
    inertia, stiffness = p["I_c"] + p["m"] * p["a"] ** 2, p["C"] * (p["a"] + p["b"])
    meet = stiffness * (p["a"] + p["b"]) / (2 * np.sqrt(stiffness * inertia))
    figure, axes = figure_with_axes(3.9)
    axes.axvspan(0, 2, color=style.UNSTABLE, zorder=0)
    slow = sweep(trailer, U=meet * np.append(np.linspace(0.2, 0.99, 80), 1 - np.geomspace(1e-2, 1e-9, 40)))
    fast = sweep(trailer, U=meet * np.append(1 + np.geomspace(1e-9, 1e-2, 40), np.geomspace(1.02, 400, 200)))
    real = np.sort(slow.eigenvalues.real, axis=-1)
    upper = fast.eigenvalues[fast.eigenvalues.imag > 0]
    for part in (real[:, 0], real[:, 1]):
        axes.plot(part, np.zeros(part.size), color=style.colour(0), linewidth=1.8)
    for sign in (1, -1):
        axes.plot(upper.real, sign * upper.imag, color=style.colour(0), linewidth=1.8)
    for U in (4, 6, 10, 15, 20, 30, 50, 200):
        roots = sweep(trailer, U=[U]).eigenvalues[0]
        axes.plot(roots.real, roots.imag, "o", color=style.colour(0), markersize=4)
        for root in roots[roots.imag >= 0]:
            style.label(axes, f"{U}", (root.real, root.imag), xytext=(0, 6), textcoords="offset points", ha="center")
    style.label(axes, f"they meet at {meet:.2f} m/s", (-4.6, -1.6), ha="right")
    style.label(axes, "speeds in m/s", (-13.8, 4.4))
    axes.axhline(0, color=style.MUTED, linewidth=0.8, zorder=1)
    axes.set_xlim(-14, 2)
    axes.set_ylim(-5.2, 5.4)
    axes.set_xlabel("real part [1/s]")
    axes.set_ylabel("imaginary part [rad/s]")
    style.label(axes, "unstable", (1, 4.8), ha="center")
    return figure


@picture("chapter-08-flexible-pivot")
def caster_map():
    caster = load("shimmying-caster")
    figure = style.new_figure(WIDTH, 3.6)
    grid = stability_map(caster, a=np.linspace(0.005, 0.4, 500), k="3e3:3e5:500:log")
    plot_map(grid, vehicle=caster, figure=figure)
    return figure


@picture("chapter-08-damped")
def caster_damped():
    caster = load("shimmying-caster-damped")
    figure = style.new_figure(WIDTH, 3.7)
    plot_damping(locus(caster, "U", 0.5, 25.0), critical=critical(caster), figure=figure)
    return figure


@picture("chapter-10-truck")
def truck_damping():
    truck = load("coach-truck")
    figure = style.new_figure(WIDTH, 4.4)
    plot_damping(locus(truck, "V", 5.0, 90.0), critical=critical(truck), figure=figure)
    return figure


@picture("chapter-10-formula")
def creep_and_conicity():
    wheelset = load("wheelset").with_(k_1=1e7)
    figure, (left, right) = figure_with_axes(3.1, 2)
    f = np.geomspace(4e6, 2e8, 60)
    found = [critical(wheelset.with_(f_x=one, f_y=one)) for one in f]
    exact = np.array([c[0].value if len(c) else np.nan for c in found])
    p = wheelset.values
    simple = np.sqrt(
        p["d"] * p["r_0"] * (p["d"] ** 2 * p["k_1"] + p["k_2"]) / (p["lambda_"] * (p["I"] + p["m"] * p["d"] ** 2))
    )
    curve(left, f, exact, 0, "exact")
    curve(left, f, np.full(f.size, simple), 1, "large-creep formula")
    left.set_xscale("log")
    left.set_ylim(0, 420)
    left.set_xlabel(f"creep coefficients {math_symbol('f_x')} = {math_symbol('f_y')} [N]")
    left.set_ylabel("critical speed [m/s]")
    left.legend(frameon=False, loc="lower right")
    slopes = np.linspace(0.03, 0.4, 40)
    for number, (name, text) in enumerate(
        (("wheelset", "wheelset"), ("coach-truck", "truck"), ("coach-truck-rigid", "rigid truck"))
    ):
        vehicle = load(name)
        speeds = [critical(vehicle.with_(lambda_=one)) for one in slopes]
        curve(right, slopes, [c[0].value if len(c) else np.nan for c in speeds], number, text)
    right.set_ylim(0, 140)
    right.set_xlabel("conicity")
    right.set_ylabel("critical speed [m/s]")
    right.legend(frameon=False, loc="upper right")
    return figure


BESIDE = {"textcoords": "offset points", "ha": "right"}
CARS = ("understeering-car", "neutral-car", "oversteering-car")


@picture("chapter-06-gains")
def car_gains():
    figure, (acceleration, yaw) = figure_with_axes(3.3, 2)
    for number, name in enumerate(CARS):
        turn = steady_turn(load(name))
        top = turn.critical_speed * 0.97 if turn.handling == "oversteer" else 55
        U = np.linspace(0, top, 300)
        curve(acceleration, U, turn.acceleration_gain(U), number, turn.handling)
        curve(yaw, U, turn.yaw_rate_gain(U), number, turn.handling)
        if turn.handling == "understeer":
            at = turn.characteristic_speed
            yaw.plot([at], [turn.yaw_rate_gain(at)], "o", color=style.INK, markersize=5, zorder=5)
            style.label(yaw, "characteristic speed", (at, turn.yaw_rate_gain(at)), xytext=(-3, -24), **BESIDE)
        if turn.handling == "oversteer":
            for one in (acceleration, yaw):
                one.axvline(turn.critical_speed, color=style.MUTED, linewidth=0.9)
            style.label(yaw, "critical speed", (turn.critical_speed, 0.6), xytext=(4, 0), textcoords="offset points")
    acceleration.set_ylim(0, 600)
    yaw.set_ylim(0, 40)
    acceleration.set_ylabel("lateral acceleration gain [(m/s²)/rad]")
    yaw.set_ylabel("yaw rate gain [(rad/s)/rad]")
    for one in (acceleration, yaw):
        one.set_xlabel("speed [m/s]")
        one.set_xlim(0, 55)
    acceleration.legend(frameon=False, loc="upper left")
    return figure


@picture("chapter-06-steps")
def car_steps():
    figure, axes = figure_with_axes(2.9)
    car = load("understeering-car")
    times = np.linspace(0, 2, 400)
    for number, (name, sense, text) in enumerate(
        (("delta_f", 1, "front wheels, 1 degree to the right"), ("delta_r", -1, "rear wheels, 1 degree to the left"))
    ):
        step = step_response(car, name, "a_y", times, size=sense * np.deg2rad(1))
        curve(axes, times, step["a_y"], number, text)
    axes.axhline(0, color=style.MUTED, linewidth=0.8)
    axes.set_xlabel("time after the step [s]")
    axes.set_ylabel("lateral acceleration [m/s²]")
    axes.legend(frameon=False, loc="lower right")
    return figure


@picture("chapter-06-weave")
def car_weave():
    figure, (speed, trail) = figure_with_axes(3.1, 2)
    car = load("released-steering-wheel")
    U = np.linspace(5, 100, 200)
    for number, e in enumerate((0.015, 0.03, 0.06)):
        curve(speed, U, sweep(car.with_(e=e), U=U).damping, number, f"trail {100 * e:g} cm")
    speed.axhline(0, color=style.INK, linewidth=0.9)
    speed.set_xlabel("speed [m/s]")
    speed.set_ylabel("least damping ratio")
    speed.legend(frameon=False, loc="upper right")
    e = np.linspace(0.006, 0.1, 60)
    found = [critical(car.with_(e=float(one))) for one in e]
    curve(trail, 100 * e, [c[-1].value if len(c) else np.nan for c in found], 0, "critical speed")
    trail.set_xlabel("trail [cm]")
    trail.set_ylabel("critical speed [m/s]")
    trail.set_ylim(0, 260)
    return figure
