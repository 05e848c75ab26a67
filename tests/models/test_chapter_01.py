"""Shopping cart: stable forward, unstable pushed backward, and its exact motion when it swings round."""

import numpy as np
import pytest
from agreement import SETS, varied
from scipy.integrate import solve_ivp

from ucrit import criteria, find_model, load, modes
from ucrit.checks import check_model
from ucrit.core.numeric.motion import motion

CARTS = ("cart", "cart-inertial")


@pytest.mark.parametrize("name", CARTS)
def test_every_check_passes(name):
    check_model(find_model(name)).raise_if_failed()


@pytest.mark.parametrize("name", CARTS)
def test_stable_forward_and_unstable_backward_for_all_parameters(name):
    assert criteria(find_model(name), direction=1).settled is True
    assert criteria(find_model(name), direction=-1).settled is False


@pytest.mark.parametrize("name", ["supermarket-cart", "supermarket-cart-pushed-backward"])
@pytest.mark.parametrize("seed", range(SETS))
def test_eigenvalue(name, seed):
    cart = varied(load(name), seed)
    p = cart.values
    expected = -p["m"] * p["b"] * p["U"] / (p["I_z"] + p["m"] * p["b"] ** 2)
    found = [value for value in modes(cart).eigenvalues if value != 0]
    assert found == pytest.approx([expected], rel=1e-12)


@pytest.fixture(scope="module")
def swing():
    """The cart rolls backward and is hardly disturbed; the last row is the heading."""
    cart = load("supermarket-cart").with_(U=-1.2)
    v, b, r = cart.values["U"], cart.values["b"], 1e-3
    rhs = motion(type(cart)).rhs

    def rates(_, w):
        return np.append(rhs(w[:3], np.zeros(0), cart.arguments()), w[2])

    return cart, solve_ivp(rates, (0, 12), [v, b * r, r, 0], method="DOP853", rtol=1e-13, atol=1e-15).y


def test_pushed_backward_it_swings_round_and_ends_rolling_forward(swing):
    cart, y = swing
    m, b, I_z = (cart.values[name] for name in ("m", "b", "I_z"))
    radius = np.sqrt((I_z + m * b**2) / m)
    speed = np.hypot(y[0, 0], radius * y[2, 0])
    assert y[0, 0] < 0
    assert y[0, -1] == pytest.approx(speed, rel=1e-9)
    turns = np.pi - np.arcsin(radius * y[2, 0] / speed) - np.arcsin(radius * y[2, -1] / speed)
    assert y[3, -1] == pytest.approx(radius / b * turns, rel=1e-9)


def test_kinetic_energy_is_conserved_while_it_swings(swing):
    cart, y = swing
    energy = cart.m * (y[0] ** 2 + y[1] ** 2) / 2 + cart.I_z * y[2] ** 2 / 2
    assert energy == pytest.approx(energy[0], rel=1e-9)
    assert np.abs(y[1] - cart.b * y[2]).max() < 1e-11
