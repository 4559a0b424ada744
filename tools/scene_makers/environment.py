"""A few objects on a plane under an open sky, and the sky.

glTF has no environment of its own: the sky is a picture beside the scene, to be given to the
renderer.
"""

from __future__ import annotations

from math import acos, cos, exp, pi, radians, sin
from pathlib import Path

from . import textures
from .gltf import Document
from .pictures import write_hdr
from .shapes import icosphere, rectangle, rounded_cube
from .textures import mix, smooth
from .vectors import Vec3, axis_angle, dot, look, normalize, subtract

WIDTH, HEIGHT = 512, 256  # pixels

SUN_DIRECTION = normalize((-0.55, 0.62, 0.56))  # 38 degrees high, to the left behind the camera
SUN_RADIUS = radians(2.0)  # eight times the sun's: soft shadows, and six pixels of the map
SUN_ILLUMINANCE = 1.9  # lx on a facing surface
SUN_COLOR: Vec3 = (1.0, 0.92, 0.78)
ZENITH: Vec3 = (0.12, 0.22, 0.46)
HORIZON: Vec3 = (0.50, 0.58, 0.66)
GROUND: Vec3 = (0.31, 0.30, 0.29)
SUN_EDGE = 0.15  # share of the disc's radius over which it fades, so that pixels do not alias


def radiance(direction: Vec3) -> Vec3:
    """What comes from a direction (towards the sky, unit length), cd/m²."""
    height = direction[1]
    if height < 0.0:
        return mix(HORIZON, GROUND, smooth(0.0, 0.06, -height))
    sky = mix(HORIZON, ZENITH, 1.0 - exp(-3.5 * height))
    angle = acos(max(-1.0, min(1.0, dot(direction, SUN_DIRECTION))))
    glow = 0.5 * exp(-angle / 0.22)
    disc = 1.0 - smooth(1.0 - SUN_EDGE, 1.0 + SUN_EDGE, angle / SUN_RADIUS)
    sun = SUN_ILLUMINANCE / (pi * sin(SUN_RADIUS) ** 2) * disc
    return tuple(s + c * (glow + sun) for s, c in zip(sky, SUN_COLOR))


def pixel_radiance(column: int, row: int) -> Vec3:
    """The mean over a pixel; the centre column looks along -Z and columns grow towards +X."""
    samples = 4
    total = [0.0, 0.0, 0.0]
    for j in range(samples):
        colatitude = pi * (row + (j + 0.5) / samples) / HEIGHT
        for i in range(samples):
            longitude = 2.0 * pi * ((column + (i + 0.5) / samples) / WIDTH - 0.5)
            ring = sin(colatitude)
            direction = (ring * sin(longitude), cos(colatitude), -ring * cos(longitude))
            total = [t + x for t, x in zip(total, radiance(direction))]
    return tuple(t / samples**2 for t in total)


def make_sky(folder: Path) -> Path:
    rows = [[pixel_radiance(column, row) for column in range(WIDTH)] for row in range(HEIGHT)]
    return write_hdr(folder / "environment.hdr", rows)


def make(folder: Path) -> list[Path]:
    pictures = folder / "textures"
    pictures.mkdir(exist_ok=True)
    squares = textures.checker(pictures)
    scene = Document("environment")
    floor = scene.add_material(
        "checker",
        baseColorTexture=scene.texture(scene.add_texture(f"textures/{squares[0].name}", True)),
        roughnessFactor=0.6,
    )
    half = 40.0
    plane = rectangle(
        (-half, 0.0, half), (2.0 * half, 0.0, 0.0), (0.0, 0.0, -2.0 * half), (half, half)
    )
    scene.add_node("plane", mesh=scene.add_mesh("plane", plane, floor))
    chrome = scene.add_material(
        "chrome", baseColorFactor=[0.85, 0.85, 0.86], metallicFactor=1.0, roughnessFactor=0.0
    )
    gold = scene.add_material(
        "satin gold", baseColorFactor=[1.0, 0.77, 0.34], metallicFactor=1.0, roughnessFactor=0.3
    )
    glass = scene.add_material(
        "glass",
        roughnessFactor=0.0,
        extensions={
            "KHR_materials_transmission": {"transmissionFactor": 1.0},
            "KHR_materials_ior": {"ior": 1.5},
            "KHR_materials_volume": {"thicknessFactor": 2.0},
        },
    )
    plaster = scene.add_matte("plaster", (0.72, 0.70, 0.67))
    coated = scene.add_material(
        "coated plastic",
        baseColorFactor=[0.60, 0.07, 0.04],
        roughnessFactor=0.5,
        extensions={
            "KHR_materials_clearcoat": {"clearcoatFactor": 1.0, "clearcoatRoughnessFactor": 0.02}
        },
    )
    shared = scene.add_mesh("chrome ball", icosphere(3), chrome)
    for name, material, x, z, radius in (
        ("chrome ball", chrome, 0.0, -0.6, 0.9),
        ("gold ball", gold, 1.5, 0.2, 0.6),
        ("glass ball", glass, 0.55, 1.1, 0.45),
        ("plaster ball", plaster, -1.55, 0.1, 0.6),
    ):
        mesh = shared if material == chrome else scene.share_mesh(name, shared, material)
        scene.add_node(name, mesh=mesh, translation=[x, radius, z], scale=[radius] * 3)
    size = 0.36
    scene.add_node(
        "coated cube",
        mesh=scene.add_mesh("coated cube", rounded_cube(size, 0.08, 6), coated),
        translation=[-0.6, size, 1.15],
        rotation=list(axis_angle((0.0, 1.0, 0.0), radians(35.0))),
    )
    eye: Vec3 = (0.0, 1.9, 6.4)
    scene.add_camera(
        radians(30.0),
        16.0 / 9.0,
        translation=list(eye),
        rotation=list(look(subtract((0.0, 0.7, 0.0), eye))),
    )
    return scene.write(folder) + [make_sky(folder), *squares]
