"""Sphere Flake in clear glass: scene C of "light vectors" (2003).

The flake is Haines' (Standard Procedural Databases, "balls"): every sphere carries nine of a third
of its radius, six round its equator and three above, "above" being away from the sphere that
carries it. The room, its rectangular light and the glass are the paper's idea and our measures.
"""

from __future__ import annotations

from math import acos, asin, pi, radians, sqrt
from pathlib import Path

from .gltf import Document
from .shapes import icosphere, polygons, rectangle
from .vectors import Vec3, add, cross, dot, look, normalize, rotate, scale, subtract

Ball = tuple[Vec3, float]  # centre, radius

CENTRAL_RADIUS = 0.5
DEFAULT_DEPTH = 3  # 1 + 9 + 81 + 729 = 820 spheres
DEEPEST_NODES = 4  # one node a sphere is a megabyte here; beyond, instancing holds them

ROOM_LOW: Vec3 = (-2.6, -CENTRAL_RADIUS, -2.6)
ROOM_HIGH: Vec3 = (2.6, 2.6, 2.6)
LIGHT_HALF = 1.1
LIGHT_RADIANCE = 6.5


def nine_directions() -> list[Vec3]:
    """Where the nine stand on a sphere whose "above" is +Z."""
    d = 1.0 / sqrt(2.0)
    axis = normalize((1.0, -1.0, 0.0))
    trio = [
        rotate(v, axis, asin(2.0 / sqrt(6.0))) for v in ((d, d, 0.0), (d, 0.0, -d), (0.0, d, -d))
    ]
    return [rotate(v, (0.0, 0.0, 1.0), turn * 2.0 * pi / 3.0) for turn in range(3) for v in trio]


def from_z(v: Vec3, direction: Vec3) -> Vec3:
    """Turns v as +Z turns to direction by the shortest way."""
    if direction[2] >= 1.0:
        return v
    if direction[2] <= -1.0:
        return (-v[0], v[1], -v[2])
    axis = normalize(cross((0.0, 0.0, 1.0), direction))
    return rotate(v, axis, acos(dot((0.0, 0.0, 1.0), direction)))


def flake(depth: int) -> list[Ball]:
    """All spheres of the published flake, z up, a parent before its children."""
    nine = nine_directions()
    balls: list[Ball] = []

    def grow(centre: Vec3, direction: Vec3, radius: float, levels: int) -> None:
        balls.append((centre, radius))
        if levels == 0:
            return
        for above in nine:
            outward = normalize(from_z(above, direction))
            step = scale(outward, radius * (1.0 + 1.0 / 3.0))
            grow(add(centre, step), outward, radius / 3.0, levels - 1)

    grow((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), CENTRAL_RADIUS, depth)
    return balls


def y_up(v: Vec3) -> Vec3:
    return (v[0], v[2], -v[1])


def add_room(scene: Document) -> None:
    """Six walls that face inwards, and the light below the ceiling."""
    (x0, y0, z0), (x1, y1, z1) = ROOM_LOW, ROOM_HIGH
    white = scene.add_matte("white", (0.75, 0.75, 0.73))
    blue = scene.add_matte("blue", (0.22, 0.36, 0.58))
    ochre = scene.add_matte("ochre", (0.68, 0.42, 0.16))
    floor = scene.add_matte("floor", (0.5, 0.47, 0.43))
    for name, material, faces in (
        ("floor", floor, [((x0, y0, z1), (x1, y0, z1), (x1, y0, z0), (x0, y0, z0))]),
        (
            "ceiling and near walls",
            white,
            [
                ((x0, y1, z0), (x1, y1, z0), (x1, y1, z1), (x0, y1, z1)),
                ((x0, y0, z0), (x1, y0, z0), (x1, y1, z0), (x0, y1, z0)),
                ((x1, y0, z0), (x1, y0, z1), (x1, y1, z1), (x1, y1, z0)),
            ],
        ),
        ("blue wall", blue, [((x0, y0, z1), (x0, y0, z0), (x0, y1, z0), (x0, y1, z1))]),
        ("ochre wall", ochre, [((x1, y0, z1), (x0, y0, z1), (x0, y1, z1), (x1, y1, z1))]),
    ):
        scene.add_node(name, mesh=scene.add_mesh(name, polygons(faces), material))
    light = scene.add_light_material("light", (1.0, 0.96, 0.9), LIGHT_RADIANCE)
    h = LIGHT_HALF
    quad = rectangle((-h, y1 - 0.01, -h), (2.0 * h, 0.0, 0.0), (0.0, 0.0, 2.0 * h))
    scene.add_node("light", mesh=scene.add_mesh("light", quad, light))


def make(folder: Path, depth: int = DEFAULT_DEPTH) -> list[Path]:
    scene = Document("sphere_flake")
    add_room(scene)
    glass = scene.add_material(
        "clear glass",
        roughnessFactor=0.0,
        extensions={
            "KHR_materials_transmission": {"transmissionFactor": 1.0},
            "KHR_materials_ior": {"ior": 1.5},
            "KHR_materials_volume": {"thicknessFactor": 2.0},
        },
    )
    ball = scene.add_mesh("ball", icosphere(2), glass)
    balls = [(y_up(centre), radius) for centre, radius in flake(depth)]
    if depth <= DEEPEST_NODES:
        children = [
            scene.add_node("ball", root=False, mesh=ball, translation=list(c), scale=[r] * 3)
            for c, r in balls
        ]
        scene.add_node("flake", children=children)
    else:
        attributes = {
            "TRANSLATION": scene.add_floats([c for c, _ in balls]),
            "SCALE": scene.add_floats([(r, r, r) for _, r in balls]),
        }
        extensions = {"EXT_mesh_gpu_instancing": {"attributes": attributes}}
        scene.extensions.add("EXT_mesh_gpu_instancing")
        scene.required.add("EXT_mesh_gpu_instancing")
        scene.add_node("flake", mesh=ball, extensions=extensions)
    eye = y_up((2.1, 1.3, 1.7))  # as published
    scene.add_camera(
        radians(45.0),
        1.0,
        translation=list(eye),
        rotation=list(look(subtract((0.0, 0.0, 0.0), eye))),
    )
    return scene.write(folder)
