"""The Cornell box as measured: https://www.graphics.cornell.edu/online/box/data.html.

The published data are millimetres; the room here is 5.5 units wide. Two things are not Cornell's:
the light is a sphere below the ceiling, as in "light vectors" (2003), scenes A and B, and the
spectra are given as the usual linear Rec. 709 triples.
"""

from __future__ import annotations

from math import radians
from pathlib import Path

from .gltf import Document
from .shapes import icosphere, polygons, prism
from .vectors import Vec3

MILLIMETRES = 0.01  # scene units

FLOOR = ((552.8, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 559.2), (549.6, 0.0, 559.2))
CEILING = ((556.0, 548.8, 0.0), (556.0, 548.8, 559.2), (0.0, 548.8, 559.2), (0.0, 548.8, 0.0))
BACK = ((549.6, 0.0, 559.2), (0.0, 0.0, 559.2), (0.0, 548.8, 559.2), (556.0, 548.8, 559.2))
LEFT = ((552.8, 0.0, 0.0), (549.6, 0.0, 559.2), (556.0, 548.8, 559.2), (556.0, 548.8, 0.0))
RIGHT = ((0.0, 0.0, 559.2), (0.0, 0.0, 0.0), (0.0, 548.8, 0.0), (0.0, 548.8, 559.2))
SHORT = ((130.0, 165.0, 65.0), (82.0, 165.0, 225.0), (240.0, 165.0, 272.0), (290.0, 165.0, 114.0))
TALL = ((423.0, 330.0, 247.0), (265.0, 330.0, 296.0), (314.0, 330.0, 456.0), (472.0, 330.0, 406.0))

WHITE = (0.73, 0.73, 0.73)
RED = (0.63, 0.065, 0.05)
GREEN = (0.14, 0.45, 0.091)

EYE = (278.0, 273.0, -800.0)
YFOV = radians(39.3)  # a 35 mm lens before 25 mm of film

LIGHT_CENTRE = (278.0, 460.0, 279.6)
LIGHT_RADIUS = 50.0
LIGHT_RADIANCE = 17.0


def units(points: tuple[Vec3, ...]) -> list[Vec3]:
    return [tuple(x * MILLIMETRES for x in point) for point in points]


def make(name: str, glossy: bool, folder: Path) -> list[Path]:
    """Writes the box; glossy makes the tall block rough metal."""
    scene = Document(name)
    white = scene.add_matte("white", WHITE, doubleSided=True)
    red = scene.add_matte("red", RED, doubleSided=True)
    green = scene.add_matte("green", GREEN, doubleSided=True)
    light = scene.add_light_material("light", (1.0, 1.0, 1.0), LIGHT_RADIANCE)
    tall = white
    if glossy:
        tall = scene.add_material(
            "metal",
            baseColorFactor=[0.91, 0.92, 0.92],
            metallicFactor=1.0,
            roughnessFactor=0.2,
            doubleSided=True,
        )
    for part, shape, material in (
        ("white", polygons([units(FLOOR), units(CEILING), units(BACK)]), white),
        ("red", polygons([units(LEFT)]), red),
        ("green", polygons([units(RIGHT)]), green),
        ("short", prism(units(SHORT)), white),
        ("tall", prism(units(TALL)), tall),
    ):
        scene.add_node(part, mesh=scene.add_mesh(part, shape, material))
    scene.add_node(
        "light",
        mesh=scene.add_mesh("light", icosphere(3), light),
        translation=[x * MILLIMETRES for x in LIGHT_CENTRE],
        scale=[LIGHT_RADIUS * MILLIMETRES] * 3,
    )
    scene.add_camera(
        YFOV,
        1.0,
        translation=[x * MILLIMETRES for x in EYE],
        rotation=[0.0, 1.0, 0.0, 0.0],  # from -Z to +Z, into the box
    )
    return scene.write(folder)


def make_diffuse(folder: Path) -> list[Path]:
    """Scene A of the paper."""
    return make("cornell_box_1", False, folder)


def make_glossy(folder: Path) -> list[Path]:
    """Scene B of the paper."""
    return make("cornell_box_2", True, folder)
