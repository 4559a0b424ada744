#!/usr/bin/env python3
"""Makes the shipped scenes: glTF, textures and sky. The same call writes the same files."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Callable

from scene_makers import cornell_box, environment, materials, sphere_flake

DEEPEST_FLAKE = 7  # 5,380,840 spheres, 130 MB


def arguments(makers: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "scene", nargs="*", help=f"which scenes to make, out of {', '.join(makers)}; all by default"
    )
    parser.add_argument(
        "--output",
        type=Path,
        default=Path(__file__).resolve().parent.parent / "scenes",
        metavar="FOLDER",
        help="where to write, made if it is not there (default: scenes/ of this checkout)",
    )
    parser.add_argument(
        "--depth",
        type=int,
        default=sphere_flake.DEFAULT_DEPTH,
        metavar="N",
        help="generations of the sphere flake: 1 makes 10 spheres, 2 makes 91, 3 (default) 820, "
        f"and so on up to {DEEPEST_FLAKE}; above {sphere_flake.DEEPEST_NODES} they are written as "
        "instances (EXT_mesh_gpu_instancing)",
    )
    chosen = parser.parse_args()
    if not 0 <= chosen.depth <= DEEPEST_FLAKE:
        parser.error(f"--depth must lie between 0 and {DEEPEST_FLAKE}, not be {chosen.depth}")
    for name in chosen.scene:
        if name not in makers:
            parser.error(f"there is no scene {name!r}; there are {', '.join(makers)}")
    return chosen


def main() -> int:
    depth = sphere_flake.DEFAULT_DEPTH
    makers: dict[str, Callable[[Path], list[Path]]] = {
        "cornell_box_1": cornell_box.make_diffuse,
        "cornell_box_2": cornell_box.make_glossy,
        "sphere_flake": lambda folder: sphere_flake.make(folder, depth),
        "materials": materials.make,
        "environment": environment.make,
    }
    chosen = arguments(list(makers))
    depth = chosen.depth
    try:
        chosen.output.mkdir(parents=True, exist_ok=True)
        for name in chosen.scene or makers:
            for path in makers[name](chosen.output):
                print(path)
    except OSError as error:
        print(f"make_scenes.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
