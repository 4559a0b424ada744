"""Three-component vectors as tuples, and the few rotations that placing things needs."""

from __future__ import annotations

from math import cos, sin, sqrt

Vec2 = tuple[float, float]
Vec3 = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]  # x y z w, as glTF writes it


def add(a: Vec3, b: Vec3) -> Vec3:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def subtract(a: Vec3, b: Vec3) -> Vec3:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(a: Vec3, factor: float) -> Vec3:
    return (a[0] * factor, a[1] * factor, a[2] * factor)


def dot(a: Vec3, b: Vec3) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vec3, b: Vec3) -> Vec3:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalize(a: Vec3) -> Vec3:
    return scale(a, 1.0 / sqrt(dot(a, a)))


def rotate(v: Vec3, axis: Vec3, angle: float) -> Vec3:
    """Turns v about the unit vector axis by angle (radians, Rodrigues)."""
    c, s = cos(angle), sin(angle)
    return add(
        add(scale(v, c), scale(cross(axis, v), s)), scale(axis, dot(axis, v) * (1.0 - c))
    )


def axis_angle(axis: Vec3, angle: float) -> Quaternion:
    """The rotation by angle (radians) about the unit vector axis."""
    s = sin(angle / 2.0)
    return (axis[0] * s, axis[1] * s, axis[2] * s, cos(angle / 2.0))


def compose(first: Quaternion, then: Quaternion) -> Quaternion:
    """The rotation that turns by first and then by then."""
    x1, y1, z1, w1 = then
    x2, y2, z2, w2 = first
    return (
        w1 * x2 + x1 * w2 + y1 * z2 - z1 * y2,
        w1 * y2 - x1 * z2 + y1 * w2 + z1 * x2,
        w1 * z2 + x1 * y2 - y1 * x2 + z1 * w2,
        w1 * w2 - x1 * x2 - y1 * y2 - z1 * z2,
    )


def look(direction: Vec3, up: Vec3 = (0.0, 1.0, 0.0)) -> Quaternion:
    """The rotation that turns -Z to direction and keeps +Y as near to up as it can be."""
    z = normalize(scale(direction, -1.0))
    x = normalize(cross(up, z))
    y = cross(z, x)
    trace = x[0] + y[1] + z[2]
    if trace > 0.0:
        s = 2.0 * sqrt(trace + 1.0)
        return ((y[2] - z[1]) / s, (z[0] - x[2]) / s, (x[1] - y[0]) / s, s / 4.0)
    if x[0] > y[1] and x[0] > z[2]:
        s = 2.0 * sqrt(1.0 + x[0] - y[1] - z[2])
        return (s / 4.0, (y[0] + x[1]) / s, (z[0] + x[2]) / s, (y[2] - z[1]) / s)
    if y[1] > z[2]:
        s = 2.0 * sqrt(1.0 + y[1] - x[0] - z[2])
        return ((y[0] + x[1]) / s, s / 4.0, (z[1] + y[2]) / s, (z[0] - x[2]) / s)
    s = 2.0 * sqrt(1.0 + z[2] - x[0] - y[1])
    return ((z[0] + x[2]) / s, (z[1] + y[2]) / s, s / 4.0, (x[1] - y[0]) / s)
