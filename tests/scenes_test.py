"""The shipped scenes are what the generator makes, are sound glTF, and their spheres are spheres."""

from __future__ import annotations

import json
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from math import sqrt
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
SCENES = TOP / "scenes"
GENERATOR = TOP / "tools" / "make_scenes.py"
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
FORMATS = {5123: ("H", 2), 5125: ("I", 4), 5126: ("f", 4)}


def generate(*options: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-B", str(GENERATOR), *options], capture_output=True, text=True
    )


def png_content(data: bytes) -> bytes:
    """Header and unpacked pixels: how well a zlib packs is its own affair."""
    position, header, packed = 8, b"", b""
    while position < len(data):
        (size,) = struct.unpack_from(">I", data, position)
        kind, body = data[position + 4 : position + 8], data[position + 8 : position + 8 + size]
        header += body if kind == b"IHDR" else b""
        packed += body if kind == b"IDAT" else b""
        position += size + 12
    return header + zlib.decompress(packed)


class GltfFile:
    """A .gltf with its buffers."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.content = json.loads(path.read_text(encoding="utf-8"))
        self.buffers = [(path.parent / b["uri"]).read_bytes() for b in self.content["buffers"]]

    def rows(self, accessor_index: int) -> list[tuple]:
        accessor = self.content["accessors"][accessor_index]
        view = self.content["bufferViews"][accessor["bufferView"]]
        letter, size = FORMATS[accessor["componentType"]]
        count = COMPONENTS[accessor["type"]]
        first = view["byteOffset"]
        data = self.buffers[view["buffer"]][first : first + count * size * accessor["count"]]
        return list(struct.iter_unpack(f"<{count}{letter}", data))

    def primitives(self) -> list[dict]:
        return [p for mesh in self.content["meshes"] for p in mesh["primitives"]]


class GeneratorTest(unittest.TestCase):
    def test_makes_the_committed_files(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            run = generate("--output", name)
            self.assertEqual(run.returncode, 0, run.stderr)
            made = {path.relative_to(folder) for path in folder.rglob("*") if path.is_file()}
            kept = {
                path.relative_to(SCENES)
                for path in SCENES.rglob("*")
                if path.is_file()
                and path.suffix != ".pov"  # written by hand
                and path.relative_to(SCENES).parts[0] != "pictures"
            }
            self.assertEqual(made, kept)
            for path in sorted(made):
                with self.subTest(path=str(path)):
                    new, old = (folder / path).read_bytes(), (SCENES / path).read_bytes()
                    if path.suffix == ".png":
                        new, old = png_content(new), png_content(old)
                    self.assertTrue(new == old, f"run tools/make_scenes.py: {path} differs")

    def test_flake_depths(self) -> None:
        for depth, spheres in ((0, 1), (1, 10), (2, 91), (5, 66430)):
            with self.subTest(depth=depth), tempfile.TemporaryDirectory() as name:
                generate("--output", name, "--depth", str(depth), "sphere_flake")
                self.assertEqual(count_balls(GltfFile(Path(name) / "sphere_flake.gltf")), spheres)

    def test_refuses_a_depth_that_fills_the_disk(self) -> None:
        run = generate("--depth", "30")
        self.assertEqual(run.returncode, 2)
        self.assertIn("--depth must lie between", run.stderr)

    def test_refuses_a_scene_that_it_does_not_know(self) -> None:
        run = generate("cornell")
        self.assertEqual(run.returncode, 2)
        self.assertIn("cornell_box_1", run.stderr)


def count_balls(file: GltfFile) -> int:
    nodes = file.content["nodes"]
    single = sum(node["name"] == "ball" for node in nodes)
    for node in nodes:
        instancing = node.get("extensions", {}).get("EXT_mesh_gpu_instancing")
        if instancing:
            return file.content["accessors"][instancing["attributes"]["TRANSLATION"]]["count"]
    return single


class ShippedSceneTest(unittest.TestCase):
    def setUp(self) -> None:
        self.files = [GltfFile(path) for path in sorted(SCENES.glob("*.gltf"))]
        self.assertEqual(len(self.files), 5)

    def test_accessors_lie_in_their_buffers(self) -> None:
        for file in self.files:
            for index, accessor in enumerate(file.content["accessors"]):
                with self.subTest(file=file.path.name, accessor=index):
                    rows = file.rows(index)
                    self.assertEqual(len(rows), accessor["count"])
                    if "min" in accessor:
                        columns = list(zip(*rows))
                        for bound, of in (("min", min), ("max", max)):
                            for told, column in zip(accessor[bound], columns):
                                self.assertAlmostEqual(told, of(column), delta=1e-6)

    def test_triangles_use_vertices_that_exist(self) -> None:
        for file in self.files:
            for primitive in file.primitives():
                count = len(file.rows(primitive["attributes"]["POSITION"]))
                for accessor in primitive["attributes"].values():
                    self.assertEqual(len(file.rows(accessor)), count)
                self.assertLess(max(row[0] for row in file.rows(primitive["indices"])), count)

    def test_normals_are_unit_and_point_to_the_front(self) -> None:
        for file in self.files:
            for primitive in file.primitives():
                points = file.rows(primitive["attributes"]["POSITION"])
                normals = file.rows(primitive["attributes"]["NORMAL"])
                for normal in normals:
                    self.assertAlmostEqual(sum(x * x for x in normal), 1.0, delta=1e-5)
                indices = [row[0] for row in file.rows(primitive["indices"])]
                for corners in zip(indices[::3], indices[1::3], indices[2::3]):
                    a, b, c = (points[i] for i in corners)
                    u, v = ([q - p for p, q in zip(a, end)] for end in (b, c))
                    face = (
                        u[1] * v[2] - u[2] * v[1],
                        u[2] * v[0] - u[0] * v[2],
                        u[0] * v[1] - u[1] * v[0],
                    )
                    mean = [sum(normals[i][k] for i in corners) for k in range(3)]
                    self.assertGreater(sum(x * y for x, y in zip(face, mean)), 0.0, file.path.name)

    def test_exact_spheres_have_their_vertices_on_the_sphere(self) -> None:
        found = 0
        for file in self.files:
            for primitive in file.primitives():
                sphere = primitive.get("extras", {}).get("sphere")
                if sphere is None:
                    continue
                found += 1
                for point in file.rows(primitive["attributes"]["POSITION"]):
                    distance = sqrt(sum(x * x for x in point))
                    self.assertAlmostEqual(distance, sphere["radius"], delta=1e-6)
        self.assertGreaterEqual(found, 10)

    def test_pictures_are_there(self) -> None:
        for file in self.files:
            for image in file.content.get("images", []):
                self.assertTrue((file.path.parent / image["uri"]).is_file(), image["uri"])

    def test_flake_is_the_published_one(self) -> None:
        file = GltfFile(SCENES / "sphere_flake.gltf")
        balls = [node for node in file.content["nodes"] if node["name"] == "ball"]
        self.assertEqual(len(balls), 820)
        # The first spheres of balls_s3.nff, which has z up.
        published = (
            (0.0, 0.0, 0.0, 0.5),
            (0.272166, 0.272166, 0.544331, 0.166667),
            (0.420314, 0.420314, 0.618405, 0.0555556),
            (0.470715, 0.470715, 0.598245, 0.0185185),
        )
        for node, (x, y, z, radius) in zip(balls, published):
            for got, wanted in zip((*node["translation"], node["scale"][0]), (x, z, -y, radius)):
                self.assertAlmostEqual(got, wanted, delta=1e-6)

    def test_folder_is_small(self) -> None:
        size = sum(path.stat().st_size for path in SCENES.rglob("*") if path.is_file())
        self.assertLess(size, 8_000_000)


if __name__ == "__main__":
    unittest.main()
