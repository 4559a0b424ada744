"""Meshes: flat polygons, spheres, torus, rounded cube, turned and bent surfaces."""

from __future__ import annotations

from math import cos, pi, sin, tan
from typing import Callable, Sequence

from .gltf import Geometry
from .vectors import Vec2, Vec3, add, cross, normalize, scale, subtract


def polygons(faces: Sequence[Sequence[Vec3]]) -> Geometry:
    """Convex faces, each a fan of triangles from its first corner, flat triangle by triangle."""
    shape = Geometry([], [], [])
    for face in faces:
        for second, third in zip(face[1:], face[2:]):
            corners = (face[0], second, third)
            normal = normalize(cross(subtract(second, face[0]), subtract(third, face[0])))
            first = len(shape.positions)
            shape.positions.extend(corners)
            shape.normals.extend([normal] * 3)
            shape.triangles.append((first, first + 1, first + 2))
    return shape


def prism(top: Sequence[Vec3]) -> Geometry:
    """A block that stands on y = 0 without a bottom; top is counter-clockwise seen from above."""
    sides = []
    for a, b in zip(top, [*top[1:], top[0]]):
        foot_a, foot_b = (a[0], 0.0, a[2]), (b[0], 0.0, b[2])
        sides.append((foot_a, foot_b, b, a))
    return polygons([top, *sides])


def rectangle(corner: Vec3, u: Vec3, v: Vec3, uv_size: Vec2 = (1.0, 1.0)) -> Geometry:
    """A parallelogram of two triangles that faces u × v; its UVs run from (0, 0) to uv_size."""
    normal = normalize(cross(u, v))
    positions = [corner, add(corner, u), add(add(corner, u), v), add(corner, v)]
    uvs = [(0.0, uv_size[1]), uv_size, (uv_size[0], 0.0), (0.0, 0.0)]
    return Geometry(positions, [normal] * 4, [(0, 1, 2), (0, 2, 3)], uvs)


def icosphere(subdivisions: int) -> Geometry:
    """The unit sphere: an icosahedron whose triangles are split in four, subdivisions times."""
    golden = (1.0 + 5.0**0.5) / 2.0
    points = [
        normalize(p)
        for s in (-1.0, 1.0)
        for t in (-golden, golden)
        for p in ((0.0, s, t), (s, t, 0.0), (t, 0.0, s))
    ]
    # Corners of a face are mutual neighbours, at the length of an edge.
    edge2 = 4.0 / (1.0 + golden * golden)
    near = [
        [j for j, q in enumerate(points) if j != i and _distance2(p, q) < 1.1 * edge2]
        for i, p in enumerate(points)
    ]
    faces = [
        _outward(points, (i, j, k))
        for i in range(len(points))
        for j in near[i]
        for k in near[j]
        if i < j < k and k in near[i]
    ]
    for _ in range(subdivisions):
        middle: dict[tuple[int, int], int] = {}

        def between(i: int, j: int) -> int:
            key = (min(i, j), max(i, j))
            if key not in middle:
                middle[key] = len(points)
                points.append(normalize(add(points[i], points[j])))
            return middle[key]

        finer = []
        for i, j, k in faces:
            ij, jk, ki = between(i, j), between(j, k), between(k, i)
            finer += [(i, ij, ki), (ij, j, jk), (ki, jk, k), (ij, jk, ki)]
        faces = finer
    return Geometry(points, list(points), faces, sphere_radius=1.0)


def _distance2(a: Vec3, b: Vec3) -> float:
    return sum((x - y) ** 2 for x, y in zip(a, b))


def _outward(points: list[Vec3], face: tuple[int, int, int]) -> tuple[int, int, int]:
    a, b, c = (points[i] for i in face)
    normal = cross(subtract(b, a), subtract(c, a))
    return face if sum(x * y for x, y in zip(normal, a)) > 0.0 else (face[0], face[2], face[1])


def grid(
    point: Callable[[float, float], Vec3],
    normal: Callable[[float, float], Vec3],
    columns: int,
    rows: int,
    uv_size: Vec2 = (1.0, 1.0),
) -> Geometry:
    """A surface over (u, v) in the unit square whose front is where ∂v × ∂u points.

    Texture coordinates are (u, v) × uv_size. Rows that shrink to a pole leave no empty triangles.
    """
    shape = Geometry([], [], [])
    for row in range(rows + 1):
        for column in range(columns + 1):
            u, v = column / columns, row / rows
            shape.positions.append(point(u, v))
            shape.normals.append(normal(u, v))
            shape.uvs.append((u * uv_size[0], v * uv_size[1]))
    for row in range(rows):
        for column in range(columns):
            a = row * (columns + 1) + column
            b, c, d = a + 1, a + columns + 1, a + columns + 2
            for triangle in ((a, c, d), (a, d, b)):
                corners = [shape.positions[i] for i in triangle]
                if min(_distance2(corners[i], corners[i - 1]) for i in range(3)) > 1e-12:
                    shape.triangles.append(triangle)
    return shape


def uv_sphere(columns: int, rows: int) -> Geometry:
    """The unit sphere by longitude and latitude: u = atan2(z, x) / 2π + 1/2, v = acos(y) / π."""

    def point(u: float, v: float) -> Vec3:
        longitude, colatitude = (u - 0.5) * 2.0 * pi, v * pi
        ring = sin(colatitude) if 0.0 < v < 1.0 else 0.0
        return (ring * cos(longitude), cos(colatitude), ring * sin(longitude))

    shape = grid(point, point, columns, rows)
    shape.triangles = [(a, c, b) for a, b, c in shape.triangles]  # u turns the other way round
    shape.sphere_radius = 1.0
    return shape


def torus(major: float, minor: float, columns: int, rows: int, uv_size: Vec2) -> Geometry:
    """A ring about +Y; u runs round the axis, v round the tube."""

    def direction(u: float, v: float) -> Vec3:
        a, b = 2.0 * pi * u, 2.0 * pi * v
        return (cos(b) * cos(a), -sin(b), -cos(b) * sin(a))

    def point(u: float, v: float) -> Vec3:
        a = 2.0 * pi * u
        return add((major * cos(a), 0.0, -major * sin(a)), scale(direction(u, v), minor))

    return grid(point, direction, columns, rows, uv_size)


def turned(profile: Sequence[Vec2], columns: int) -> Geometry:
    """A smooth surface of revolution about +Y; profile is (radius, height) from the top down."""

    def at(v: float) -> tuple[int, float]:
        x = v * (len(profile) - 1)
        i = min(int(x), len(profile) - 2)
        return i, x - i

    def point(u: float, v: float) -> Vec3:
        i, t = at(v)
        radius = profile[i][0] * (1.0 - t) + profile[i + 1][0] * t
        height = profile[i][1] * (1.0 - t) + profile[i + 1][1] * t
        return (radius * cos(2.0 * pi * u), height, -radius * sin(2.0 * pi * u))

    def normal(u: float, v: float) -> Vec3:
        i = round(v * (len(profile) - 1))
        before, after = profile[max(i - 1, 0)], profile[min(i + 1, len(profile) - 1)]
        out, up = before[1] - after[1], after[0] - before[0]
        return normalize((out * cos(2.0 * pi * u), up, -out * sin(2.0 * pi * u)))

    return grid(point, normal, columns, len(profile) - 1)


def rounded_cube(half: float, radius: float, steps: int) -> Geometry:
    """A cube of half edge half whose edges are rounded by radius; every face has UVs of its own."""
    shape = Geometry([], [], [])
    inner = half - radius
    # Lines on a face: the rounding in steps, the flat middle in one piece.
    bend = [inner + radius * tan(pi / 4.0 * i / steps) for i in range(steps + 1)]
    lines = [-x for x in reversed(bend)] + bend
    for axis in range(3):
        for sign in (1.0, -1.0):
            first = len(shape.positions)
            for q in lines:
                for p in lines:
                    raw = [0.0, 0.0, 0.0]
                    raw[axis] = sign * half
                    raw[(axis + 1) % 3] = p * sign
                    raw[(axis + 2) % 3] = q
                    core = tuple(max(-inner, min(inner, x)) for x in raw)
                    normal = normalize(subtract(tuple(raw), core))
                    shape.positions.append(add(core, scale(normal, radius)))
                    shape.normals.append(normal)
                    shape.uvs.append(((p / half + 1.0) / 2.0, (1.0 - q / half) / 2.0))
            n = len(lines)
            for row in range(n - 1):
                for column in range(n - 1):
                    a = first + row * n + column
                    shape.triangles += [(a, a + 1, a + n + 1), (a, a + n + 1, a + n)]
    return shape
