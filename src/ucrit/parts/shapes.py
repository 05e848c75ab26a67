"""Shapes of vehicles for drawings: bodies and wheels in proportion to what the model knows, widths made up.

``at`` and ``angle`` place the vehicle's own origin; an angle counts from the drawing's first axis to its second.
"""

import math

import numpy as np

from ..core.contract.drawing import Body, box, disc, line, moved, wheel

WHEEL = 0.22, 0.08
"""Length and width of a wheel, as shares of the vehicle's length."""


def pair_of_wheels(size, track, at, angle, ahead, steer=0.0):
    """Two wheels of an axle that lies ahead of the vehicle's origin."""
    places = (moved(at, angle, ahead, side) for side in (track / 2, -track / 2))
    return tuple(wheel(WHEEL[0] * size, WHEEL[1] * size, place, angle + steer) for place in places)


def car(a, b, front=0.0, rear=0.0, at=(0.0, 0.0), angle=0.0):
    """Car from above about its centre of mass; ``front`` and ``rear`` are steer angles."""
    size = a + b
    body = box(1.5 * size, 0.64 * size, at, angle, ahead=(a - b) / 2)
    window = line((a - 0.3 * size, 0.26 * size), (a - 0.3 * size, -0.26 * size), at=at, angle=angle)
    steered = pair_of_wheels(size, 0.58 * size, at, angle, a, front)
    return (body, window, *steered, *pair_of_wheels(size, 0.58 * size, at, angle, -b, rear))


def trailer(a, b, at=(0.0, 0.0), angle=0.0, steer=0.0):
    """Trailer from above about its hitch: centre of mass a, axle a + b behind."""
    size = a + b
    bar = line((0, 0), (-0.35 * size, 0), at=at, angle=angle)
    body = box(1.1 * size, 0.55 * size, at, angle, ahead=-0.35 * size - 0.55 * size)
    return (bar, body, *pair_of_wheels(0.8 * size, 0.52 * size, at, angle, -size, steer), joint(0.03 * size, at, angle))


def joint(radius, at, angle=0.0):
    """Hitch or pivot."""
    return disc(radius, at, angle, look="wheel")


def caster(trail, at=(0.0, 0.0), angle=0.0):
    """Caster from above about its pivot."""
    fork = line((0, 0), (-trail, 0), at=at, angle=angle)
    return (
        wheel(1.6 * abs(trail), 0.4 * abs(trail), moved(at, angle, -trail), angle),
        fork,
        joint(0.12 * trail, at, angle),
    )


def shopping_cart(b, at=(0.0, 0.0), angle=0.0):
    """Shopping cart from above about its centre of mass: fixed rear wheels, casters in front."""
    rear = pair_of_wheels(1.2 * b, 1.1 * b, at, angle, -b)
    front = tuple(disc(0.1 * b, moved(at, angle, b, side * b), angle, look="wheel") for side in (0.4, -0.4))
    handle = line((-1.3 * b, 0.6 * b), (-1.3 * b, -0.6 * b), at=at, angle=angle)
    return (box(2.3 * b, 1.2 * b, at, angle), handle, *rear, *front)


def rails(half_gauge, reach):
    """Two rails along the first axis."""
    return tuple(line((-reach, side), (reach, side), look="ground") for side in (half_gauge, -half_gauge))


def wheelset(half_gauge, radius, at=(0.0, 0.0), angle=0.0):
    """Wheelset from above: axle and two wheels over the rails."""
    axle = line((0, half_gauge), (0, -half_gauge), at=at, angle=angle)
    places = (moved(at, angle, 0, side) for side in (half_gauge, -half_gauge))
    return (axle, *(wheel(2 * radius, 0.18 * half_gauge, place, angle) for place in places))


def leaning(height, lean, at=(0.0, 0.0)):
    """Two-wheeler from behind; ``lean`` is positive to the right."""
    ground = line((-1.5 * height, 0), (1.5 * height, 0), look="ground")
    tire = Body(box(0.09 * height, 0.62 * height).points + np.array([0, 0.31 * height]), at, -lean, "wheel")
    rider = Body(box(0.42 * height, 0.75 * height).points + np.array([0, 0.95 * height]), at, -lean)
    head = disc(0.14 * height, moved(at, -lean, 0, 1.5 * height), -lean)
    return (ground, tire, rider, head)


def airplane_side(length, at=(0.0, 0.0), angle=0.0, up=1.0):
    """Airplane from the side about its centre of mass; ``up`` is -1 where the second axis points down."""
    hull = [
        (0.45, 0.0),
        (0.38, 0.05),
        (0.1, 0.06),
        (-0.45, 0.03),
        (-0.55, 0.2),
        (-0.62, 0.2),
        (-0.58, 0.0),
        (0.3, -0.05),
    ]
    body = Body(length * np.array([(x, up * z) for x, z in hull]), at, angle)
    wing = line(
        (0.12 * length, -up * 0.01 * length), (-0.08 * length, -up * 0.02 * length), at=at, angle=angle, look="wheel"
    )
    tail = line(
        (-0.48 * length, up * 0.04 * length), (-0.6 * length, up * 0.04 * length), at=at, angle=angle, look="wheel"
    )
    return (body, wing, tail)


def airplane_rear(span, roll, at=(0.0, 0.0)):
    """Airplane from behind; ``roll`` is positive to the right."""
    wing = line((-span / 2, 0.02 * span), (span / 2, 0.02 * span), at=at, angle=-roll, look="wheel")
    fin = line((0, 0), (0, 0.16 * span), at=at, angle=-roll)
    return (wing, fin, disc(0.05 * span, at, -roll))


def pendulum_upright(length, radius, angle):
    """Ball on a stick that stands on the ground; ``angle`` to the vertical, positive to the first axis."""
    ground = line((-1.3 * length, 0), (1.3 * length, 0), look="ground")
    stick = line((0, 0), (0, length), angle=-angle)
    return (ground, stick, disc(radius, moved((0.0, 0.0), -angle, 0, length), -angle))


def ball_on_a_path(curvature, x):
    """Ball whose centre is on a parabola, from the side; its size is made up."""
    reach = max(0.5 / abs(curvature) if curvature else 0.5, 1.1 * float(np.max(np.abs(x))))
    places = np.linspace(-reach, reach, 61)
    path = line(*zip(places.tolist(), (curvature * places**2 / 2).tolist(), strict=True), look="ground")
    radius = reach / 12
    return (path, disc(radius, (x, curvature * x**2 / 2), -x / radius))


def mass_on_a_spring(size, x):
    """Block on a line with a mark at its place of rest."""
    ground = line((-5 * size, -size / 2), (5 * size, -size / 2), look="ground")
    mark = line((0, -size / 2), (0, -0.8 * size), look="ground")
    return (ground, mark, box(size, size, (x, 0.0)))


def radius_of_gyration(moment, mass):
    """Radius of gyration, by which bodies of unknown length are drawn."""
    return math.sqrt(moment / mass)
