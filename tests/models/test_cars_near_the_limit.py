"""Cars with tires in slots: they linearise to the linear car; loads, wheels and symmetry of the four-wheel car."""

import numpy as np
import pytest
from agreement import varied

from ucrit import find_model, handling_diagram, load, modes, param, rollover, simulate, steady_family, steady_turn
from ucrit.core.numeric.compiled import state_space
from ucrit.core.numeric.motion import motion
from ucrit.parts.tires import Forces, Tire
from ucrit.parts.tires.linear import Linear

SEEDS = range(6)
WHEELS = ("fl", "fr", "rl", "rr")


class Degressive(Tire):
    """Tire whose cornering coefficient grows less than its load, made for a test in 2026."""

    c: float = param("1", "cornering coefficient per small load", above=0)
    F_0: float = param("N", "load at which the coefficient is largest", above=0)

    def forces(self, F_z, alpha, kappa=0):
        C = self.c * F_z * (1 - F_z / (2 * self.F_0))
        return Forces(C * kappa, -C * alpha, 0)


def linear_car(car):
    """Return the linear car that a car with two tires an axle comes down to."""
    same = {name: car.values[name] for name in ("m", "I_z", "a", "b", "U")}
    return find_model("car")(**same, C_f=2 * car.front_C, C_r=2 * car.rear_C)


def shaken(seed):
    """A random four-wheel car; shares stay shares."""
    return varied(load("four-wheel-car", {"zeta": 0.4, "xi": 0.5}), seed)


def start(car, **changes):
    """State and inputs on the basic motion, some of them changed."""
    made = motion(type(car))
    w, u = (v.copy() for v in made.basic(car.arguments()))
    names = (*made.labels, *type(car).declaration.inputs)
    for name, value in changes.items():
        k = names.index(name)
        (w if k < len(w) else u)[k if k < len(w) else k - len(w)] = value
    return made, w, u


def degressive(car, F_0):
    """Return the car on degressive tires."""
    kept = {n: v for n, v in car.values.items() if not n.startswith(("front_", "rear_"))}
    law = {f"{axle}_{k}": v for axle in ("front", "rear") for k, v in (("c", 20), ("F_0", F_0))}
    return type(car).fitted(front=Degressive, rear=Degressive)(**kept, **law)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_single_track_car_is_the_linear_car(seed):
    car = varied(load("spinning-car"), seed)
    for law in (None, Linear):
        if law:
            kept = {n: v for n, v in car.values.items() if not n.endswith("mu")}
            car = type(car).fitted(front=law, rear=law)(**kept)
        for mine, linear in zip(state_space(car)[:2], state_space(linear_car(car))[:2], strict=True):
            np.testing.assert_allclose(mine, linear, rtol=1e-10, atol=1e-12)
        assert steady_turn(car).gradient == pytest.approx(steady_turn(linear_car(car)).gradient, rel=1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_four_wheel_car_with_light_wheels_is_the_linear_car(seed):
    car = shaken(seed).with_(I_w=1e-8)
    found = modes(car).eigenvalues
    slow = found[np.argsort(np.abs(found))][:5]  # the wheels' are out of sight
    expected = [0, -1 / car.T, -1 / car.T, *modes(linear_car(car)).eigenvalues]
    np.testing.assert_allclose(np.sort_complex(slow), np.sort_complex(expected), rtol=2e-5, atol=1e-6)


def test_its_gentle_turns_are_those_of_the_linear_car():
    car = load("four-wheel-car")
    found = handling_diagram(car)
    assert found.gradient[0] == pytest.approx(steady_turn(linear_car(car)).gradient, rel=1e-4)
    assert found.family["v_x"] == pytest.approx(car.U)
    assert found.family["drive"][-1] > 0  # what the front wheels' side forces take
    assert found.family.end == "F_fr is at its least, 0 N"


def test_without_forces_it_runs_straight_on():
    car = load("four-wheel-car")
    made, w, u = start(car)
    assert np.abs(made.rhs(w, u, car.arguments())).max() < 1e-12
    turned = simulate(car, 2, {"v_y": 0.3, "r": 0.1}, tolerance=1e-8)
    assert abs(turned["v_y"][-1]) < 1e-3
    energy = car.m * (turned["v_x"] ** 2 + turned["v_y"] ** 2) / 2 + car.I_z * turned["r"] ** 2 / 2
    energy += sum(car.I_w * turned[f"omega_{w}"] ** 2 / 2 for w in WHEELS)
    assert np.all(np.diff(energy) <= 1e-6 * energy[0])  # tires only take


def test_loads_are_those_of_statics():
    """Sums of forces and of moments about the ground's middle, in a turn with braking."""
    car = load("four-wheel-car")
    a_x, a_y = -3.0, 5.0
    made, w, u = start(car, A_x=a_x, A_y=a_y)
    y = dict(zip(type(car).declaration.outputs, made.outputs(w, u, car.arguments()), strict=True))
    fl, fr, rl, rr = (y[f"F_{w}"] for w in WHEELS)
    assert fl + fr + rl + rr == pytest.approx(car.m * car.g)
    assert car.t_f / 2 * (fl - fr) + car.t_r / 2 * (rl - rr) == pytest.approx(car.m * a_y * car.h)
    assert car.a * (fl + fr) - car.b * (rl + rr) == pytest.approx(-car.m * a_x * car.h)
    assert fl - fr == pytest.approx(2 * car.zeta * car.m * a_y * car.h / car.t_f)
    assert y["load_transfer"] == pytest.approx((fl + rl - fr - rr) / (car.m * car.g))


@pytest.mark.parametrize("seed", SEEDS)
def test_it_rolls_over_at_half_its_track_over_its_height(seed):
    car = shaken(seed)
    car = car.with_(t_r=car.t_f)
    found = rollover(car)
    assert found.threshold == pytest.approx(car.g * car.t_f / (2 * car.h), rel=1e-6)
    assert set(found.lifts) == {"F_fr", "F_rr"}
    balanced = rollover(car.with_(zeta=car.b / (car.a + car.b)))
    assert list(balanced.lifts.values()) == pytest.approx([balanced.threshold] * 2, rel=1e-6)
    assert np.isinf(rollover(car.with_(h=0)).threshold)


def test_braking_makes_a_neutral_car_oversteer():
    """A cornering coefficient in proportion to load makes every car neutral; braking loads the front axle."""
    car = load("four-wheel-car")
    fitted = degressive(car, F_0=1e12)

    def moment(A_x):
        made, w, u = start(fitted, A_x=A_x)
        A = made.slopes(w, u, fitted.arguments()).A
        return A[made.labels.index("r"), made.labels.index("v_y")]

    assert moment(0.0) == pytest.approx(0, abs=1e-6 * moment(4.0))
    assert moment(-4.0) < 0 < moment(4.0)  # pushed sideways, a braking car turns its tail out


def test_load_transfer_takes_cornering_coefficient_from_the_axle_that_bears_it():
    car = load("four-wheel-car")
    stiff, soft = (handling_diagram(degressive(car.with_(zeta=zeta), F_0=9000), slip=0.1) for zeta in (0.8, 0.2))
    assert stiff.gradient[0] == pytest.approx(soft.gradient[0], rel=1e-9)
    at = min(stiff.a_y.max(), soft.a_y.max()) * 0.8
    gradients = [np.interp(at, h.a_y, h.difference) for h in (stiff, soft)]
    assert gradients[0] > gradients[1]  # a stiff front axle makes the car understeer
    C, F, dF = 20 * 3000 * (1 - 3000 / 18000), 3000, 1000
    pair = sum(20 * load * (1 - load / 18000) for load in (F + dF, F - dF))
    assert pair == pytest.approx(2 * C - 20 * dF**2 / 9000)


def test_a_braked_wheel_locks_and_a_driven_one_spins_up():
    car = load("four-wheel-car")
    assert simulate(car, 0.3, inputs={f"brake_{w}": 4000 for w in WHEELS}, tolerance=1e-6)["a_x"][-1] < -8
    slippery = car.with_(front_C_x=6e3)  # 1800 N m are all that the road can turn the wheel with
    held = simulate(slippery, 0.15, inputs={"brake_fl": 3000}, tolerance=1e-4)
    assert abs(held["omega_fl"][-1]) < 0.5 < held["omega_fr"][-1]
    assert held["r"][-1] < 0  # the braked side pulls it round
    driven = simulate(car, 0.3, inputs={"drive": 2000}, tolerance=1e-6)
    assert car.R * driven["omega_fl"][-1] > driven["v_x"][-1] > car.U
    assert driven["omega_fl"] == pytest.approx(driven["omega_fr"])


def test_a_turn_can_be_held_by_the_brakes_of_one_side():
    car = load("four-wheel-car")
    turn = steady_family(car, "a_y", -1, free=("brake_fl", "drive"), hold={"v_x": car.U})
    assert turn["brake_fl"][-1] > 0
    assert turn["r"][-1] < 0
    assert turn.stable.all()


def test_formulas_with_conditions_are_well_formed():
    from ucrit.core.derivation.trace import trace
    from ucrit.core.formulas.typeset import mathml
    from ucrit.report.formulas import formula

    reference = mathml(trace(type(load("car-with-stability-control"))).residuals[-1])
    assert any(f"<mo>{sign}</mo>" in reference for sign in ("&lt;", ">"))
    assert "math" in formula(reference)


@pytest.mark.parametrize("law", ["brush", "dugoff"])
def test_the_four_wheel_car_on_tires_that_friction_limits_is_the_linear_one_in_gentle_motion(law):
    from ucrit import check
    from ucrit.catalogue import find_part

    base = load("four-wheel-car")
    fitted = type(base).fitted(front=find_part(law, Tire), rear=find_part(law, Tire))
    names = fitted.declaration.parameters
    car = fitted(**{n: base.values[n] for n in names if n in base.values})
    if law == "brush":
        base = base.with_(front_C_x=base.front_C, rear_C_x=base.rear_C)  # as stiff along as across
    for mine, linear in zip(state_space(car)[:2], state_space(base)[:2], strict=True):
        np.testing.assert_allclose(mine, linear, rtol=1e-10, atol=1e-10)
    report = check(car)
    assert report.ok, str(report)
    assert "published for these parts" in str(report)


ROLLING = {
    "linear": {"C": 5e4},
    "degressive": {"C_max": 8e4, "F_max": 8e3},
    "brush": {"C": 6e4, "mu": 0.8},
    "brush-degressive": {"C_max": 8e4, "F_max": 8e3, "mu": 0.8},
    "brush-moment": {"C": 6e4, "mu": 0.8, "l_c": 0.08},
    "dugoff": {"C": 6e4, "mu": 0.8},
    "clipped": {"c_F": 12, "c_M": 0.3},
    "hmmwv-pac89": {},
    "pac2002-235-60r16": {},
    "pacejka-205-60r15:SLIP=angle": {},
}
"""A tire of every law, as the command line names it."""


def on(slot, name):
    """Changes that put a tire into a slot."""
    return {slot: name, **{f"{slot}_{key}": value for key, value in ROLLING[name].items()}}


def test_every_law_is_tried():
    from ucrit.catalogue import part_names

    assert set(part_names(Tire)) - {"magic-formula", "magic-formula-89"} <= set(ROLLING)


@pytest.mark.parametrize("number", range(len(ROLLING)))
def test_any_tire_on_each_axle_linearises_to_the_linear_vehicle(number):
    front, rear = list(ROLLING)[number], list(ROLLING)[number - 3]
    car = load("spinning-car", {**on("front", front), **on("rear", rear)})
    load_ = car.m * car.g / (2 * (car.a + car.b))
    same = {name: car.values[name] for name in ("m", "I_z", "a", "b", "U")}
    C_f, C_r = car.front.cornering_coefficient(load_ * car.b), car.rear.cornering_coefficient(load_ * car.a)
    linear = find_model("car")(**same, C_f=2 * float(C_f), C_r=2 * float(C_r))
    for mine, expected in zip(state_space(car)[:2], state_space(linear)[:2], strict=True):
        np.testing.assert_allclose(mine, expected, rtol=1e-9, atol=1e-11)
    for name, plain in (
        ("caravan-on-brush-tires", "trailer"),
        ("caster-on-brush-tire", "caster-flexible-pivot-damped"),
    ):
        towed = load(name, on("tire", front))
        kept = {n: towed.values[n] for n in find_model(plain).declaration.parameters if n in towed.values}
        same = find_model(plain)(**kept, C=float(towed.tire.cornering_coefficient(towed.F_z)))
        np.testing.assert_allclose(modes(towed).eigenvalues, modes(same).eigenvalues, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("along", ["delta_f", "a_y", "curvature", "U"])
@pytest.mark.parametrize("tire", ["pac2002-235-60r16", "pacejka-205-60r15:SLIP=angle"])
def test_families_go_through_folds_in_steer_angle_acceleration_curvature_and_speed(tire, along):
    less = {"rear_LMUY": 0.6, "U": 5 if along == "U" else 30}
    car = load("spinning-car", {**on("front", tire), **on("rear", tire), **less})
    held = {} if along != "U" else {"curvature": 1 / 80}
    free = () if along == "delta_f" else ("delta_f",)
    within = {"alpha_f": (-0.3, 0.3), "alpha_r": (-0.3, 0.3)}
    turns = steady_family(car, along, {"U": 80}.get(along, 20), free=free, hold=held, within=within)
    assert len(turns.folds) >= 1
    assert turns[along].max() <= turns.folds[0] * (1 + 1e-9) <= turns[along].max() * 1.003  # between two points
    assert turns[along][-1] < 0.9999 * turns[along].max()
    assert turns.stable[0]
    assert not turns.stable[-1]


def test_a_wheel_that_comes_to_roll_backward_ends_the_motion():
    """Tire laws in the tangent of the slip angle turn their sign there."""
    run = simulate(load("ploughing-car"), 12, inputs={"delta_f": lambda t: 0.17 * t}, tolerance=1e-6)
    assert run.ended == "rolls backward on its front wheels"
    assert np.abs(run["alpha_f"]).max() == pytest.approx(np.pi / 2, abs=1e-6)


def test_a_sidewall_never_asks_for_more_than_its_tire_has():
    caster = load("pneumatic-caster-sidewall")
    most = caster.C * np.pi / 2 / caster.k_s
    run = simulate(caster, 1, {"z": 1.1 * most}, tolerance=1e-6)
    assert run.ended == "asks its tire for more than its largest force"
    assert run.times[-1] == 0
    assert simulate(caster, 0.1, {"z": 0.9 * most}, tolerance=1e-6).ended == ""
