"""The benchmark bicycle: matrices and speeds as Meijaard, Papadopoulos, Ruina and Schwab (2007) print them."""

import numpy as np
import pytest

from ucrit import critical, load, modes
from ucrit.analyses.linear.modes import eigenvalues
from ucrit.analyses.stability.exact import exact_search
from ucrit.core.derivation.derive import symbolic

M = [[80.81722, 2.31941332208709], [2.31941332208709, 0.29784188199686]]
C1 = [[0, 33.8664139149249], [-0.850356414569784, 1.6854039739756]]
K0 = [[-80.95, -2.59951685249872], [-2.59951685249872, -0.803294884586176]]
K2 = [[0, 76.5973458957322], [0, 2.65431523794604]]


@pytest.fixture(scope="module")
def bicycle():
    return load("benchmark-bicycle")


def test_the_matrices_are_the_published_ones(bicycle):
    # M, C1, K0 and K2 of the paper's section 5, in the canonical form of its equation (5.3)
    system = symbolic(type(bicycle))
    values = {symbol: float(bicycle.values[name]) for name, symbol in system.traced.parameters.items()}
    for v in (0.3, 4.6, 20.0):
        values[system.traced.parameters["U"]] = v
        P_0, P_1, P_2 = (np.array(P.subs(values), dtype=float) for P in system.P)
        np.testing.assert_allclose(P_2, M, rtol=2e-14)
        np.testing.assert_allclose(P_1, v * np.array(C1), rtol=1e-13)
        expected = 9.81 * np.array(K0) + v**2 * np.array(K2)
        np.testing.assert_allclose(P_0, expected, rtol=1e-13, atol=1e-12)


def test_weave_and_capsize_speed(bicycle):
    weave, capsize = critical(bicycle)
    assert (weave.kind, capsize.kind) == ("flutter", "divergence")
    assert weave.value == pytest.approx(4.29238253634111, rel=1e-14)
    assert capsize.value == pytest.approx(6.02426201538837, rel=1e-14)
    assert exact_search(bicycle, "U", 0.0, np.inf) is not None


def test_two_unstable_real_roots_meet_where_the_weave_begins(bicycle):
    # the paper's v_d, where two real eigenvalues meet and become the weave mode
    below, above = (eigenvalues(bicycle.with_(U=0.684283078892246 + step)) for step in (-1e-7, 1e-7))
    assert not below.imag.any()
    assert np.count_nonzero(above.imag) == 2
    assert above[0].real == pytest.approx(3.78290405129320, abs=1e-6)


def test_modes_have_the_names_of_the_field(bicycle):
    assert [c.mode for c in critical(bicycle)] == ["weave", "capsize divergence"]
    assert {mode.name for mode in modes(bicycle)} == {"weave", "capsize decay", "castering decay"}
    assert modes(bicycle.with_(U=8)).list()[0].name == "capsize divergence"
