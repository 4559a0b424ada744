"""A stage for looking at materials: plastics, metals, coats, glass, cut-outs and maps on tiles.

An area light, a strip and a spot light it, so that a white surface has a radiance near 1 and no
exposure is needed.
"""

from __future__ import annotations

from math import atan2, cos, pi, radians, sin
from pathlib import Path

from . import textures
from .gltf import Document, Geometry
from .shapes import grid, icosphere, polygons, rectangle, rounded_cube, torus, turned, uv_sphere
from .vectors import Vec3, axis_angle, compose, cross, look, normalize, subtract

RADIUS = 0.42  # of the spheres
X_AXIS, Y_AXIS = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
ROOM_HALF_WIDTH, ROOM_HEIGHT, ROOM_BACK, ROOM_FRONT = 5.0, 4.2, -3.2, 7.0

AREA_LIGHT_RADIANCE = 20.0  # cd/m²
STRIP_LIGHT_RADIANCE = 18.0
SPOT_INTENSITY = 30.0  # cd


def add_room(scene: Document) -> None:
    """A tiled floor, a cove behind, and grey walls for the metals to reflect."""
    color, normal, roughness = (
        scene.add_texture(f"textures/tile_{map}.png") for map in ("color", "normal", "roughness")
    )
    tiles = scene.add_material(
        "glazed tiles",
        baseColorTexture=scene.texture(color),
        metallicRoughnessTexture=scene.texture(roughness),
        normalTexture=scene.texture(normal),
    )
    w, y, back, front = ROOM_HALF_WIDTH, ROOM_HEIGHT, ROOM_BACK, ROOM_FRONT
    floor = rectangle(
        (-w, 0.0, front), (2.0 * w, 0.0, 0.0), (0.0, 0.0, back - front), (w, (front - back) / 2.0)
    )
    scene.add_node("floor", mesh=scene.add_mesh("floor", floor, tiles))

    wall = scene.add_matte("wall", (0.46, 0.45, 0.44))
    sides = polygons(
        [
            ((-w, 0.0, front), (-w, 0.0, back), (-w, y, back), (-w, y, front)),
            ((w, 0.0, back), (w, 0.0, front), (w, y, front), (w, y, back)),
            ((w, 0.0, front), (-w, 0.0, front), (-w, y, front), (w, y, front)),
            ((-w, y, back), (w, y, back), (w, y, front), (-w, y, front)),
        ]
    )
    scene.add_node("walls", mesh=scene.add_mesh("walls", sides, wall))
    backdrop = scene.add_matte("backdrop", (0.42, 0.46, 0.50))
    scene.add_node("backdrop", mesh=scene.add_mesh("backdrop", cove(w, y, back), backdrop))


def cove(half_width: float, height: float, back: float) -> Geometry:
    """A wall that meets the floor in a quarter circle."""
    bend, steps = 0.9, 24
    arc = [pi / 2.0 * i / steps for i in range(steps + 1)]
    profile = [(height, back, 0.0)] + [
        (bend * (1.0 - cos(a)), back + bend * (1.0 - sin(a)), a) for a in reversed(arc)
    ]
    profile = [(h, z, pi / 2.0 if i == 0 else a) for i, (h, z, a) in enumerate(profile)]
    rows = len(profile) - 1

    def point(u: float, v: float) -> Vec3:
        h, z, _ = profile[round(v * rows)]
        return ((2.0 * u - 1.0) * half_width, h + 0.002, z)

    def normal(u: float, v: float) -> Vec3:
        a = profile[round(v * rows)][2]
        return (0.0, cos(a), sin(a))

    return grid(point, normal, 1, rows)


def add_lights(scene: Document) -> None:
    """A soft key from the upper left, a narrow strip on the right, a spot for crisp shadows."""
    key = scene.add_light_material("key light", (1.0, 0.95, 0.88), AREA_LIGHT_RADIANCE)
    strip = scene.add_light_material("strip light", (0.82, 0.91, 1.0), STRIP_LIGHT_RADIANCE)
    for name, material, centre, target, width, height in (
        ("key light", key, (-2.6, 3.5, 2.2), (0.0, 0.3, 0.0), 2.6, 1.8),
        ("strip light", strip, (4.2, 2.0, 1.6), (0.0, 0.5, 0.2), 0.5, 2.6),
    ):
        quad = rectangle((-width / 2.0, -height / 2.0, 0.0), (width, 0.0, 0.0), (0.0, height, 0.0))
        away = look(subtract(centre, target))  # the quad faces +Z, so its -Z points away
        scene.add_node(
            name,
            mesh=scene.add_mesh(name, quad, material),
            translation=list(centre),
            rotation=list(away),
        )
    place: Vec3 = (1.6, 3.9, 2.6)
    spot = scene.add_punctual_light(
        {
            "type": "spot",
            "name": "spot",
            "color": [1.0, 0.9, 0.75],
            "intensity": SPOT_INTENSITY,
            "spot": {"innerConeAngle": radians(14.0), "outerConeAngle": radians(24.0)},
        }
    )
    scene.add_node(
        "spot",
        translation=list(place),
        rotation=list(look(subtract((0.3, 0.2, -0.2), place))),
        extensions=spot,
    )


def add_spheres(scene: Document) -> None:
    """Plastics, metals, glass and a lamp, all exact spheres of two meshes."""
    hammered = scene.add_texture("textures/hammered_normal.png")
    gold = scene.add_material(
        "hammered gold",
        baseColorFactor=[1.0, 0.77, 0.34],
        metallicFactor=1.0,
        roughnessFactor=0.18,
        normalTexture=scene.texture(hammered, repeat=(4.0, 2.0)),
    )
    steel = scene.add_material(
        "polished steel",
        baseColorFactor=[0.66, 0.65, 0.63],
        metallicFactor=1.0,
        roughnessFactor=0.06,
    )
    copper = scene.add_material(
        "satin copper",
        baseColorFactor=[0.95, 0.64, 0.54],
        metallicFactor=1.0,
        roughnessFactor=0.35,
    )
    aluminium = scene.add_material(
        "blasted aluminium",
        baseColorFactor=[0.91, 0.92, 0.92],
        metallicFactor=1.0,
        roughnessFactor=0.6,
    )
    glossy = scene.add_material(
        "glossy plastic",
        baseColorFactor=[0.05, 0.28, 0.12],
        roughnessFactor=0.1,
    )
    rough = scene.add_material(
        "rough plastic",
        baseColorFactor=[0.10, 0.22, 0.55],
        roughnessFactor=0.55,
    )
    paint = scene.add_material(
        "car paint",
        baseColorFactor=[0.55, 0.03, 0.03],
        metallicFactor=0.6,
        roughnessFactor=0.45,
        extensions={
            "KHR_materials_clearcoat": {"clearcoatFactor": 1.0, "clearcoatRoughnessFactor": 0.03}
        },
    )
    amber = scene.add_material(
        "amber glass",
        roughnessFactor=0.0,
        extensions={
            "KHR_materials_transmission": {"transmissionFactor": 1.0},
            "KHR_materials_ior": {"ior": 1.5},
            "KHR_materials_volume": {
                "thicknessFactor": 2.0,
                "attenuationDistance": 0.5,
                "attenuationColor": [0.92, 0.52, 0.12],
            },
        },
    )
    lamp = scene.add_light_material("lamp", (1.0, 0.62, 0.3), 6.0)
    smooth, mapped = icosphere(3), uv_sphere(64, 32)
    shared = scene.add_mesh("paint sphere", smooth, paint)
    for name, material, x, z, radius in (
        ("rough plastic", rough, -1.75, 1.2, RADIUS),
        ("glossy plastic", glossy, -0.6, 1.45, RADIUS),
        ("amber glass", amber, 0.55, 1.5, RADIUS),
        ("car paint", paint, 1.75, 1.2, RADIUS),
        ("polished steel", steel, -1.2, 0.15, RADIUS),
        ("satin copper", copper, 0.05, 0.25, RADIUS),
        ("blasted aluminium", aluminium, 1.2, 0.1, RADIUS),
        ("lamp", lamp, -0.05, 2.1, 0.11),
    ):
        mesh = shared if material == paint else scene.share_mesh(name, shared, material)
        scene.add_node(name, mesh=mesh, translation=[x, radius, z], scale=[radius] * 3)
    scene.add_node(
        "hammered gold",
        mesh=scene.add_mesh("hammered gold", mapped, gold),
        translation=[0.1, 0.62, -1.1],
        scale=[0.62] * 3,
    )


def add_objects(scene: Document) -> None:
    """A ring, a covered cube and a pane of glass."""
    color, normal = (scene.add_texture(f"textures/weave_{map}.png") for map in ("color", "normal"))
    cloth = scene.add_material(
        "woven cloth",
        baseColorTexture=scene.texture(color, repeat=(2.0, 2.0)),
        normalTexture=scene.texture(normal, repeat=(2.0, 2.0)),
        roughnessFactor=0.85,
    )
    half = 0.52
    scene.add_node(
        "cloth cube",
        mesh=scene.add_mesh("cloth cube", rounded_cube(half, 0.12, 6), cloth),
        translation=[-1.75, half, -1.1],
        rotation=list(axis_angle(Y_AXIS, radians(28.0))),
    )
    lacquer = scene.add_material(
        "lacquered weave",
        baseColorFactor=[0.72, 0.20, 0.05],
        normalTexture=scene.texture(normal, repeat=(6.0, 2.0), scale=0.6),
        roughnessFactor=0.5,
        extensions={
            "KHR_materials_clearcoat": {"clearcoatFactor": 1.0, "clearcoatRoughnessFactor": 0.08}
        },
    )
    minor = 0.14
    ring = torus(0.40, minor, 96, 32, (1.0, 1.0))
    scene.add_node(
        "lacquered ring",
        mesh=scene.add_mesh("lacquered ring", ring, lacquer),
        translation=[-1.75, 2.0 * half + minor, -1.1],
        rotation=list(axis_angle(Y_AXIS, radians(28.0))),
    )
    pane = scene.add_material(
        "window pane",
        baseColorFactor=[0.62, 0.90, 0.82],
        roughnessFactor=0.0,
        doubleSided=True,
        extensions={"KHR_materials_transmission": {"transmissionFactor": 1.0}},
    )
    sheet = rectangle((-0.5, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.35, 0.0))
    scene.add_node(
        "window pane",
        mesh=scene.add_mesh("window pane", sheet, pane),
        translation=[1.75, 0.0, -0.55],
        rotation=list(axis_angle(Y_AXIS, radians(-18.0))),
    )


def add_plant(scene: Document) -> None:
    """Leaves cut out by alpha, in a clay pot."""
    pot = scene.add_material("fired clay", baseColorFactor=[0.62, 0.26, 0.14], roughnessFactor=0.8)
    profile = [
        (0.0, 0.34),
        (0.24, 0.34),
        (0.245, 0.36),
        (0.26, 0.42),
        (0.27, 0.43),
        (0.30, 0.43),
        (0.31, 0.42),
        (0.31, 0.34),
        (0.30, 0.33),
        (0.275, 0.325),
        (0.27, 0.31),
        (0.20, 0.01),
        (0.19, 0.0),
    ]
    where = (1.95, 0.0, -1.35)
    scene.add_node(
        "pot", mesh=scene.add_mesh("pot", turned(profile, 48), pot), translation=list(where)
    )
    picture = scene.add_texture("textures/leaf_color.png")
    leaf = scene.add_material(
        "leaf",
        baseColorTexture=scene.texture(picture),
        roughnessFactor=0.5,
        alphaMode="MASK",
        alphaCutoff=0.5,
        doubleSided=True,
    )
    mesh = scene.add_mesh("leaf", bent_leaf(), leaf)
    golden_angle = radians(137.508)
    for i in range(11):
        lean = radians(8.0 + 5.5 * i)
        turn = compose(axis_angle(X_AXIS, lean), axis_angle(Y_AXIS, i * golden_angle))
        size = 0.95 - 0.025 * i
        scene.add_node(
            "leaf",
            mesh=mesh,
            translation=[where[0], 0.32, where[2]],
            rotation=list(turn),
            scale=[size] * 3,
        )


def bent_leaf() -> Geometry:
    """A strip that grows up from the origin and bends over towards +Z; v = 0 is its tip."""
    length, width, bend = 1.0, 0.36, 0.9

    def point(u: float, v: float) -> Vec3:
        s = 1.0 - v
        fold = 0.05 * abs(2.0 * u - 1.0)
        along = length * sin(bend * s) / bend
        over = length * (1.0 - cos(bend * s)) / bend
        return ((u - 0.5) * width, along + fold * sin(bend * s), over - fold * cos(bend * s))

    def normal(u: float, v: float) -> Vec3:
        s = 1.0 - v
        tilt = atan2(0.1, width) * (1.0 if u > 0.5 else -1.0 if u < 0.5 else 0.0)
        flat = (0.0, -sin(bend * s), cos(bend * s))
        side = normalize(cross((0.0, cos(bend * s), sin(bend * s)), flat))
        return normalize(tuple(a * cos(tilt) + b * sin(tilt) for a, b in zip(flat, side)))

    return grid(point, normal, 6, 12)


def make(folder: Path) -> list[Path]:
    pictures = folder / "textures"
    pictures.mkdir(exist_ok=True)
    maps = [
        path
        for make_maps in (textures.tiles, textures.hammered, textures.weave, textures.leaf)
        for path in make_maps(pictures)
    ]
    scene = Document("materials")
    add_room(scene)
    add_lights(scene)
    add_spheres(scene)
    add_objects(scene)
    add_plant(scene)
    eye: Vec3 = (0.0, 2.15, 6.2)
    scene.add_camera(
        radians(29.0),
        16.0 / 9.0,
        translation=list(eye),
        rotation=list(look(subtract((0.0, 0.58, -0.2), eye))),
    )
    return scene.write(folder) + maps
