"""Rigid body: Newton's and Euler's laws in axes that move and turn with it, whatever its inertia and the loads.

Axes: x, y, z through the centre of mass, right-handed, fixed to the body; vectors are triples of components
along them. Products of inertia are I_xy = integral of x y dm, so that they enter the tensor with a minus. SI
units and radians.
"""

from __future__ import annotations

from typing import Any

Vector = tuple[Any, Any, Any]
Tensor = tuple[Vector, Vector, Vector]


def components(group: Any, names: str) -> Vector:
    """Return the variables of these names as a vector, 0 for those that a model does without."""
    declared = vars(group)
    x, y, z = (declared.get(name, 0) for name in names.split())
    return x, y, z


def cross(a: Vector, b: Vector) -> Vector:
    """Return the vector product.

    >>> cross((1, 0, 0), (0, 1, 0))
    (0, 0, 1)
    """
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot(a: Vector, b: Vector) -> Any:
    """Return the scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def inertia_tensor(I_xx: Any, I_yy: Any, I_zz: Any, I_xy: Any = 0, I_xz: Any = 0, I_yz: Any = 0) -> Tensor:
    """Return the tensor of inertia [kg m^2] about the centre of mass."""
    return (I_xx, -I_xy, -I_xz), (-I_xy, I_yy, -I_yz), (-I_xz, -I_yz, I_zz)


def is_possible(inertia: Tensor, share: float = 1e-9) -> Any:
    """Tell whether a body can have a tensor of inertia: no principal moment is above the sum of the other two.

    The second moments of its mass, integrals of x**2, x*y and so on, then form a matrix without a negative
    eigenvalue, so that no principal minor is negative. Numbers or arrays; ``share`` of the trace is for rounding.

    >>> is_possible(inertia_tensor(2, 1, 1)), is_possible(inertia_tensor(2.1, 1, 1))
    (True, False)
    """
    trace = inertia[0][0] + inertia[1][1] + inertia[2][2]
    xx, yy, zz = ((trace / 2 - inertia[i][i]) / trace for i in range(3))
    xy, xz, yz = (-inertia[i][j] / trace for i, j in ((0, 1), (0, 2), (1, 2)))
    true = (xx >= -share) & (yy >= -share) & (zz >= -share)
    for one, other, mixed in ((xx, yy, xy), (xx, zz, xz), (yy, zz, yz)):
        true = true & (one * other - mixed**2 >= -share)
    determinant = xx * (yy * zz - yz**2) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)
    return true & (determinant >= -share)


def possible_inertia(names: str, inertia: Tensor) -> dict[str, Any]:
    """Return the statement that a tensor of inertia is possible, for a model's method ``possible``."""
    return {f"with {names} no principal moment of inertia may be above the sum of the other two": is_possible(inertia)}


def angular_momentum(inertia: Tensor, spin: Vector) -> Vector:
    """Return the angular momentum [N m s] about the centre of mass (Karnopp 2004, eq. (2.18))."""
    return dot(inertia[0], spin), dot(inertia[1], spin), dot(inertia[2], spin)


def rate_in_space(vector: Vector, rate: Vector, frame: Vector) -> Vector:
    """Return how fast a vector changes in space, from its rate in a frame that turns (Karnopp 2004, eq. (2.13))."""
    a, b, c = (own + carried for own, carried in zip(rate, cross(frame, vector), strict=True))
    return a, b, c


def newton(m: Any, velocity: Vector, rate: Vector, force: Vector, frame: Vector) -> Vector:
    """Return mass times acceleration less force [N], zero along the motion (Karnopp 2004, eq. (2.17))."""
    acceleration = rate_in_space(velocity, rate, frame)
    x, y, z = (m * a - f for a, f in zip(acceleration, force, strict=True))
    return x, y, z


def euler(inertia: Tensor, spin: Vector, rate: Vector, moment: Vector, frame: Vector) -> Vector:
    """Return rate of angular momentum less moment [N m], zero along the motion (Karnopp 2004, eq. (2.19)).

    The frame turns with the body, ``frame = spin``, unless the body's tensor is the same in all axes.
    """
    change = rate_in_space(angular_momentum(inertia, spin), angular_momentum(inertia, rate), frame)
    x, y, z = (h - n for h, n in zip(change, moment, strict=True))
    return x, y, z
