"""Enclosures hold: the exact value at every point of a box lies inside, by ball arithmetic of python-flint."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import ucrit
from ucrit.analyses.regions.enclosing import Enclosing
from ucrit.catalogue import vehicle_names
from ucrit.core.formulas.codegen import build
from ucrit.core.numeric.compiled import compiled, deciding, direction
from ucrit.numerics.rigorous import Boxes, Proved, ProvedFunctions, exact_pair

ONE_EACH = list({type(ucrit.load(name)): name for name in vehicle_names()}.values())


class BallFunctions:
    """Functions of python-flint under NumPy's names."""

    def __init__(self, flint):
        self.pi = flint.arb.pi()

    def __getattr__(self, name):
        return lambda x: getattr(x, name)()


def ball(flint, value):
    exact = Fraction(value)
    return flint.arb(flint.fmpq(exact.numerator, exact.denominator))


def not_outside(flint, low, high, value):
    """Whether no number of a ball is certain to lie outside."""
    return not (value < ball(flint, float(low)) or value > ball(flint, float(high)))


@pytest.mark.parametrize("name", ONE_EACH)
def test_coefficients_of_every_model_lie_in_their_enclosures(name):
    flint = pytest.importorskip("flint")
    vehicle = ucrit.load(name)
    functions, random = compiled(type(vehicle), direction(vehicle)), np.random.default_rng(3)
    moving = [key for key, value in vehicle.values.items() if value][:3]
    centre = np.array([float(vehicle.values[key]) for key in moving])[:, None]
    size = np.abs(centre) * np.array([[0, 1e-9, 1e-3, 0.1]])
    boxes = Boxes(centre - size, centre + size)
    asked = Enclosing(vehicle, moving, direction(vehicle))
    with np.errstate(all="ignore"):
        found = asked.coefficients(boxes.variables())
    exactly = build(functions.source, "coefficients", functions=BallFunctions(flint))
    for column in range(4):
        for _ in range(3):
            lower, upper = boxes.lower[:, column], boxes.upper[:, column]
            at = np.clip(lower + random.uniform(size=len(moving)) * (upper - lower), lower, upper)
            point = {k: float(x) for k, x in vehicle.values.items()} | dict(zip(moving, at, strict=True))
            a = deciding(functions, exactly([ball(flint, float(x)) for x in point.values()]))
            for true, enclosed in zip(a, found, strict=True):
                low, high = (np.broadcast_to(end, 4)[column] for end in enclosed.ends)
                assert not_outside(flint, low, high, true if isinstance(true, flint.arb) else flint.arb(true))


OPERATIONS = (
    lambda x, y: x + y,
    lambda x, y: x - y,
    lambda x, y: x * y,
    lambda x, y: x / (y * y + 1),
    lambda x, y: 3 - x * Fraction(1, 3),
    lambda x, y: x**3 * y,
    lambda x, y: 1 / (x**2 + 2),
)


@given(
    st.lists(st.sampled_from(OPERATIONS), min_size=1, max_size=8),
    st.lists(st.floats(-5, 5), min_size=2, max_size=2),
    st.floats(0, 2),
    st.lists(st.fractions(0, 1), min_size=2, max_size=2),
)
def test_chains_of_operations_are_enclosed_with_their_slopes(chain, lower, width, share):
    lower = np.array(lower)[:, None]
    boxes = Boxes(lower, lower + width)
    ends = zip(boxes.lower[:, 0], boxes.upper[:, 0], share, strict=True)
    at = [Fraction(float(a)) * (1 - t) + Fraction(float(b)) * t for a, b, t in ends]
    centre = [Fraction(float(c)) for c in boxes.centre[:, 0]]
    steps = [p - c for p, c in zip(at, centre, strict=True)]
    with np.errstate(all="ignore"):
        (x, y), (u, v), (f, g) = boxes.variables(), at, centre
        for operation in chain:
            x, y = operation(x, y), x
            (u, v), (f, g) = (operation(u, v), u), (operation(f, g), f)
    assert not float(x.ends[0][0]) > u
    assert not float(x.ends[1][0]) < u
    assert not x.centre[0][0] > f
    assert not x.centre[1][0] < f
    slopes = [[Fraction(float(s)) for s in row[:, 0]] for row in x.slopes if np.isfinite(row).all()]
    if len(slopes) == 2:  # the mean value theorem, exactly
        products = [sorted((low * h, high * h)) for low, high, h in zip(*slopes, steps, strict=True)]
        assert sum(low for low, _ in products) <= u - f <= sum(high for _, high in products)


@pytest.mark.parametrize("name", ["sin", "cos", "tan", "exp", "sqrt"])
def test_functions_are_enclosed(name):
    flint = pytest.importorskip("flint")
    random, wide = np.random.default_rng(5), np.array([0.0, 1e-12, 1e-3, 0.4])
    lower = 0.01 + 0.5 * random.uniform(size=4)
    boxes = Boxes(lower[None], (lower + wide)[None])
    found = getattr(ProvedFunctions, name)(boxes.variables()[0])
    for column in range(4):
        for share in random.uniform(size=20):
            at = lower[column] + share * (boxes.upper[0, column] - lower[column])
            value = getattr(ball(flint, at), name)()
            assert not_outside(flint, found.ends[0][column], found.ends[1][column], value)
    assert np.all(found.ends[1] - found.ends[0] < 4 * wide + 1e-13)


def test_slopes_make_ranges_narrow():
    (x,) = Boxes(np.array([[1.0]]), np.array([[1.01]])).variables()
    flat = x * x - 2 * x  # least at 1, where naive intervals are wide
    assert flat.ends[1][0] - flat.ends[0][0] < 0.0005


def test_numbers_are_taken_exactly_or_outward():
    assert exact_pair(Fraction(1, 4)) == (0.25, 0.25)
    low, high = exact_pair(Fraction(1, 3))
    assert Fraction(low) < Fraction(1, 3) < Fraction(high)
    assert Proved.constant(3.0).ends == (3.0, 3.0)
    low, high = Proved.constant(0.1).ends
    assert Fraction(low) < Fraction(1, 10) < Fraction(high)


def test_what_cannot_be_enclosed_is_said():
    with pytest.raises(NotImplementedError, match="where"):
        ProvedFunctions().where(1, 2, 3)
    with pytest.raises(NotImplementedError):
        assert Proved.constant(1.0) > 0
    with pytest.raises(NotImplementedError):
        Proved.constant(2.0) ** 0.3
