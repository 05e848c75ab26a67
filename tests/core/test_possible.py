"""Values that are impossible together: refused everywhere, ranges end where they begin."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ucrit import UcritError, analyze, critical, find_model, load, locus, sweep
from ucrit.catalogue import model_names
from ucrit.checks.subject import Subject
from ucrit.core.contract.possible import allowed, holds
from ucrit.parts.rigid_body import inertia_tensor, is_possible

RULED = [name for name in model_names() if hasattr(find_model(name), "possible")]
COORDINATE = st.floats(-2, 2).map(lambda x: round(x, 3))
POINTS = st.lists(st.tuples(st.floats(0.1, 3), COORDINATE, COORDINATE, COORDINATE), min_size=1, max_size=5)
SIX = st.tuples(*[st.floats(0.1, 3)] * 3, *[st.floats(-1, 1)] * 3)


def tensor(points):
    """Return moments and products of inertia of point masses."""
    m, x, y, z = np.array(points).T
    return [float((m * e).sum()) for e in (y * y + z * z, x * x + z * z, x * x + y * y, x * y, x * z, y * z)]


@given(POINTS)
def test_every_set_of_point_masses_is_possible(points):
    values = tensor(points)
    if sum(values[:3]) > 1e-3:
        assert is_possible(inertia_tensor(*values))


@given(SIX)
def test_principal_moments_decide(values):
    one, two, three = np.linalg.eigvalsh(np.array(inertia_tensor(*values)))
    excess = (three - one - two) / sum(values[:3])
    if abs(excess) > 1e-4:  # rounding decides nearer to the boundary
        assert bool(is_possible(inertia_tensor(*values))) == (excess < 0)


@pytest.mark.parametrize("name", RULED)
def test_random_values_are_possible(name):
    model = find_model(name)
    sets = dict(zip(model.declaration.parameters, Subject.of(model, 3, None).parameter_sets("x", 200), strict=True))
    assert all(np.all(true) for true in holds(model, sets).values())


# integrals of x**2 and z**2 of the large airplane, whose moments are 25, 45 and 67 (times 1e6)
LARGEST = 1e6 * ((45 + 67 - 25) / 2 * (25 + 45 - 67) / 2) ** 0.5
NAVION = (1048 * 3530) ** 0.5 * 1.3558179483314004

# model's vehicle, parameter, the last value that is possible: sums, differences and roots of the vehicle's others
LIMITS = [
    ("motorcycle-lean", "I_1", 75 - 59, 75 + 59),
    ("motorcycle-lean", "I_2", 59 - 35, 35 + 59),
    ("motorcycle-lean", "I_3", 75 - 35, 75 + 35),
    ("satellite-middle-axis", "I_zz", 10, 50),
    ("satellite-largest-axis-damped", "I_yy", 20 - 0.2, 40 - 0.2),
    ("satellite-largest-axis-damped", "J", 20 - 19.8, 40 - 19.8),
    ("large-airplane-symmetric", "I_xz", -LARGEST, LARGEST),
    ("navion-lateral", "I_xz", -NAVION, NAVION),
]


@pytest.mark.parametrize(("name", "parameter", "least", "most"), LIMITS)
def test_limits_of_single_parameters(name, parameter, least, most):
    vehicle = load(name)
    size = most - least
    for inside in (least + 1e-4 * size, most - 1e-4 * size):
        vehicle.with_(**{parameter: inside})
    for outside in (least - 1e-4 * size, most + 1e-4 * size):
        with pytest.raises(UcritError, match=f"{parameter} = "):
            vehicle.with_(**{parameter: outside})


REFUSED = "satellite: with I_xx, I_yy, I_zz no principal moment .* got I_xx = 31, I_yy = 20, I_zz = 10"


def test_impossible_values_are_refused_in_one_sentence():
    satellite = load("satellite-largest-axis")
    for I_xx in (31, [25, 31], np.linspace(31, 11, 7)):
        with pytest.raises(UcritError, match=REFUSED):
            satellite.with_(I_xx=I_xx)
    with pytest.raises(UcritError, match="got I_xx = 50, I_yy = 20, I_zz = 10"):
        sweep(satellite, I_xx=(15, 50), Omega=(1, 2))
    with pytest.raises(UcritError, match="no principal moment"):
        load("large-airplane-body").with_(I_xz=3e7)
    with pytest.raises(UcritError, match="I_xz must lie between"):
        load("boeing-747-lateral").with_(I_xz=1e9)


def test_arrays_that_vary_together_are_judged_one_by_one():
    satellite = load("satellite-largest-axis")
    grown = satellite.along("size", I_xx=[3, 30], I_yy=[2, 20], I_zz=[1, 10])
    assert grown.with_(Omega=[1, 2, 3]).dims.keys() == {"size", "Omega"}
    with pytest.raises(UcritError, match="got I_xx = 3, I_yy = 20, I_zz = 1"):
        satellite.along("size", I_xx=[3, 3], I_yy=[2, 20], I_zz=[1, 1])


def test_bounds_are_what_the_other_values_leave():
    satellite = load("satellite-largest-axis")
    bounds = allowed(satellite, "I_xx")
    assert (bounds.lower, bounds.upper) == pytest.approx((10, 30), rel=1e-6)
    assert bounds.allowed == "at least 10 kg m^2 and at most 30 kg m^2"
    assert allowed(satellite, "Omega") == type(satellite).declaration.parameters["Omega"]
    free = allowed(load("boeing-747-lateral"), "I_x")
    assert free.upper == np.inf
    assert free.lower > 0


def test_analyses_stay_within_what_is_possible():
    satellite = load("satellite-largest-axis")
    assert [c.value for c in critical(satellite, "I_xx")] == [20]
    assert locus(satellite, "I_xx").values[[0, -1]] == pytest.approx([10, 30], rel=1e-4)
    remedies = {r.parameter: r.value for r in analyze(load("satellite-middle-axis")).remedies}
    assert remedies["I_xx"] == pytest.approx(30, rel=1e-3)
