"""Procedural maps that repeat without a seam: tiles, hammered metal, weave, leaf, checker."""

from __future__ import annotations

from math import cos, exp, floor, hypot, pi, sin, sqrt
from pathlib import Path
from random import Random
from typing import Callable

from .pictures import write_png
from .vectors import Vec3, normalize

Field = list[list[float]]  # heights or shares, rows from the top


def field(size: int, value: Callable[[float, float], float]) -> Field:
    """Samples value over the unit square at pixel centres."""
    return [
        [value((column + 0.5) / size, (row + 0.5) / size) for column in range(size)]
        for row in range(size)
    ]


def smooth(low: float, high: float, x: float) -> float:
    """0 below low, 1 above high, a smooth step between."""
    t = max(0.0, min(1.0, (x - low) / (high - low)))
    return t * t * (3.0 - 2.0 * t)


def noise(seed: int, cells: int, octaves: int) -> Callable[[float, float], float]:
    """Value noise of period 1 with mean near 1/2: cells to a side, halved each octave."""
    random = Random(seed)
    lattices = []
    for octave in range(octaves):
        n = cells << octave
        lattices.append((n, [[random.random() for _ in range(n)] for _ in range(n)]))

    def value(u: float, v: float) -> float:
        total, weight = 0.0, 0.0
        for octave, (n, lattice) in enumerate(lattices):
            x, y = u * n, v * n
            i, j = floor(x), floor(y)
            s, t = x - i, y - j
            s, t = s * s * (3.0 - 2.0 * s), t * t * (3.0 - 2.0 * t)
            row0, row1 = lattice[j % n], lattice[(j + 1) % n]
            i0, i1 = i % n, (i + 1) % n
            upper = row0[i0] + (row0[i1] - row0[i0]) * s
            lower = row1[i0] + (row1[i1] - row1[i0]) * s
            share = 0.5**octave
            total += share * (upper + (lower - upper) * t)
            weight += share
        return total / weight

    return value


def mix(a: Vec3, b: Vec3, t: float) -> Vec3:
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def write_normals(path: Path, heights: Field, strength: float) -> Path:
    """The normal map of a repeating field; strength is height 1 as a share of the map's side."""
    size = len(heights)
    rows = []
    for j in range(size):
        above, here, below = heights[j - 1], heights[j], heights[(j + 1) % size]
        row = []
        for i in range(size):
            dx = (here[(i + 1) % size] - here[i - 1]) * size / 2.0 * strength
            dy = (above[i] - below[i]) * size / 2.0 * strength  # +Y is up in the picture
            normal = normalize((-dx, -dy, 1.0))
            row.append([x / 2.0 + 0.5 for x in normal])
        rows.append(row)
    return write_png(path, rows)


def tiles(folder: Path) -> list[Path]:
    """Glazed floor tiles, two by two a map: colour, normals, metallic-roughness."""
    size, tiles_a_side, grout = 512, 2, 0.022
    grain, stain = noise(1, 24, 3), noise(2, 4, 4)
    shades = [0.90, 1.04, 0.98, 1.08]

    def inside(u: float, v: float) -> float:
        """0 in the grout, 1 on a tile; corners and edges are rounded."""
        x, y = (u * tiles_a_side) % 1.0, (v * tiles_a_side) % 1.0
        edge, bevel = grout, 0.03
        dx, dy = bevel - (min(x, 1.0 - x) - edge), bevel - (min(y, 1.0 - y) - edge)
        return 1.0 - smooth(0.0, bevel, hypot(max(dx, 0.0), max(dy, 0.0)))

    shape = field(size, inside)
    cloud = field(size, stain)
    rough = field(size, grain)
    color_rows, data_rows = [], []
    for j in range(size):
        color_row, data_row = [], []
        for i in range(size):
            on, s, g = shape[j][i], cloud[j][i], rough[j][i]
            shade = shades[(2 * i // size) + 2 * (2 * j // size)]
            glaze = mix((0.36, 0.42, 0.45), (0.56, 0.60, 0.60), smooth(0.25, 0.75, s))
            glaze = tuple(x * shade for x in glaze)
            mortar = mix((0.50, 0.48, 0.45), (0.62, 0.60, 0.56), g)
            color_row.append(mix(mortar, glaze, smooth(0.05, 0.3, on)))
            roughness = 0.9 + (0.22 + 0.28 * smooth(0.45, 0.75, s) - 0.9) * smooth(0.05, 0.3, on)
            data_row.append((1.0, roughness, 0.0))
        color_rows.append(color_row)
        data_rows.append(data_row)
    heights = [
        [
            shape[j][i] + 0.4 * cloud[j][i] + 0.03 * rough[j][i] * (1.0 - shape[j][i])
            for i in range(size)
        ]
        for j in range(size)
    ]
    return [
        write_png(folder / "tile_color.png", color_rows),
        write_normals(folder / "tile_normal.png", heights, 0.008),
        write_png(folder / "tile_roughness.png", data_rows),
    ]


def hammered(folder: Path) -> list[Path]:
    """Dents of a hammer: normals only."""
    size, cells = 256, 7
    random = Random(5)
    dents = [
        ((i + random.random()) / cells, (j + random.random()) / cells)
        for j in range(cells)
        for i in range(cells)
    ]

    def height(u: float, v: float) -> float:
        distances = sorted(
            min(abs(u - x), 1.0 - abs(u - x)) ** 2 + min(abs(v - y), 1.0 - abs(v - y)) ** 2
            for x, y in dents
        )
        nearest, second = (d * cells * cells for d in distances[:2])
        soft_ridge = 0.12 * exp((nearest - second) / 0.12)
        return nearest - soft_ridge  # bowls that meet in ridges

    return [write_normals(folder / "hammered_normal.png", field(size, height), 0.016)]


def weave(folder: Path) -> list[Path]:
    """A plain weave of two yarns: colour and normals."""
    size, threads = 256, 8
    fuzz = noise(7, 32, 2)
    warp, weft = (0.62, 0.55, 0.42), (0.30, 0.17, 0.13)

    def yarns(u: float, v: float) -> tuple[float, float]:
        x, y = u * threads, v * threads
        over = cos(pi * x) * cos(pi * y)  # sign tells which yarn lies above
        ridge_x, ridge_y = sqrt(abs(sin(pi * x))), sqrt(abs(sin(pi * y)))
        up, down = ridge_x * (0.5 + 0.5 * over), ridge_y * (0.5 - 0.5 * over)
        return up, down

    heights, colors = [], []
    for j in range(size):
        height_row, color_row = [], []
        for i in range(size):
            u, v = (i + 0.5) / size, (j + 0.5) / size
            up, down = yarns(u, v)
            f = fuzz(u, v)
            height_row.append(max(up, down) + 0.15 * f)
            yarn = mix(weft, warp, smooth(-0.04, 0.04, up - down))
            shade = (0.55 + 0.45 * max(up, down)) * (0.85 + 0.3 * f)
            color_row.append(tuple(x * shade for x in yarn))
        heights.append(height_row)
        colors.append(color_row)
    return [
        write_png(folder / "weave_color.png", colors),
        write_normals(folder / "weave_normal.png", heights, 0.03),
    ]


def leaf(folder: Path) -> list[Path]:
    """A leaf that stands in a transparent map: stalk below, tip above."""
    size = 256
    spots = noise(11, 12, 3)
    rows = []
    for j in range(size):
        row = []
        for i in range(size):
            x, y = (i + 0.5) / size * 2.0 - 1.0, 1.0 - (j + 0.5) / size  # y from stalk to tip
            t = max(0.0, min(1.0, (y - 0.1) / 0.88))
            notch = 0.035 * abs(sin(16.0 * pi * t)) * sin(pi * t)
            width = 0.0
            if 0.0 < t < 1.0:
                width = 0.88 * sin(pi * t**0.75) ** 0.8 * (1.0 - 0.25 * t) - notch
            stalk = abs(x) < 0.035 and y < 0.3
            covered = abs(x) < width or stalk
            side = abs(x) / 0.88
            ribs = abs(((t - 0.55 * side) * 9.0) % 1.0 - 0.5)
            rib = 1.0 - smooth(0.03, 0.07, min(ribs * 0.35, 1.0))
            midrib = 1.0 - smooth(0.012, 0.03, abs(x))
            green = mix((0.16, 0.40, 0.13), (0.34, 0.58, 0.20), spots(i / size, j / size))
            color = mix(green, (0.62, 0.74, 0.40), max(0.45 * rib, 0.8 * midrib))
            row.append((*color, 1.0 if covered else 0.0))
        rows.append(row)
    return [write_png(folder / "leaf_color.png", rows)]


def checker(folder: Path) -> list[Path]:
    """Two by two squares."""
    light, dark, half = (0.80, 0.79, 0.77), (0.36, 0.37, 0.40), 8
    upper = [light] * half + [dark] * half
    lower = [dark] * half + [light] * half
    return [write_png(folder / "checker_color.png", [upper] * half + [lower] * half)]
