"""Writes glTF 2.0: a .gltf that a person can read, and its .bin beside it."""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Sequence

FLOAT, UNSIGNED_SHORT, UNSIGNED_INT = 5126, 5123, 5125
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
DIGITS = 9  # that a single-precision number needs to come back the same


@dataclass
class Geometry:
    """Indexed triangles, counter-clockwise from the front. Spheres also say their exact radius."""

    positions: list[tuple[float, float, float]]
    normals: list[tuple[float, float, float]]
    triangles: list[tuple[int, int, int]]
    uvs: list[tuple[float, float]] = field(default_factory=list)
    sphere_radius: float | None = None


def rounded(value: Any) -> Any:
    """Numbers as the file shows them: nine digits, and no negative zero."""
    if isinstance(value, float):
        return float(f"{value:.{DIGITS}g}") + 0.0
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(item) for item in value]
    return value


class Document:
    """A scene under construction. Each add_ method returns the index of what it added."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.content: dict[str, list[Any]] = {}
        self.root_nodes: list[int] = []
        self.root_extensions: dict[str, Any] = {}
        self.extensions: set[str] = set()
        self.required: set[str] = set()
        self.binary = bytearray()

    def _append(self, kind: str, item: dict[str, Any]) -> int:
        for extension in item.get("extensions", {}):
            self.extensions.add(extension)
        self.content.setdefault(kind, []).append(item)
        return len(self.content[kind]) - 1

    def _add_view(self, data: bytes, target: int | None) -> int:
        self.binary.extend(b"\0" * (-len(self.binary) % 4))
        view: dict[str, Any] = {
            "buffer": 0,
            "byteOffset": len(self.binary),
            "byteLength": len(data),
        }
        if target is not None:
            view["target"] = target
        self.binary.extend(data)
        return self._append("bufferViews", view)

    def add_floats(
        self, rows: Sequence[Sequence[float]], bounds: bool = False, target: int | None = None
    ) -> int:
        """An accessor of float rows; bounds writes min and max, which positions must have."""
        size = len(rows[0])
        data = struct.pack(f"<{size * len(rows)}f", *(x for row in rows for x in row))
        accessor: dict[str, Any] = {
            "bufferView": self._add_view(data, target),
            "componentType": FLOAT,
            "count": len(rows),
            "type": TYPES[size],
        }
        if bounds:
            stored = list(struct.iter_unpack(f"<{size}f", data))
            accessor["min"] = [min(column) for column in zip(*stored)]
            accessor["max"] = [max(column) for column in zip(*stored)]
        return self._append("accessors", accessor)

    def _add_indices(self, triangles: list[tuple[int, int, int]], vertex_count: int) -> int:
        small = vertex_count < 65535  # the largest value of a type would restart a strip
        flat = [index for triangle in triangles for index in triangle]
        data = struct.pack(f"<{len(flat)}{'H' if small else 'I'}", *flat)
        return self._append(
            "accessors",
            {
                "bufferView": self._add_view(data, ELEMENT_ARRAY_BUFFER),
                "componentType": UNSIGNED_SHORT if small else UNSIGNED_INT,
                "count": len(flat),
                "type": "SCALAR",
            },
        )

    def add_mesh(self, name: str, geometry: Geometry, material: int) -> int:
        """A mesh of one primitive; a sphere says in its extras that it is one exactly."""
        attributes = {
            "POSITION": self.add_floats(geometry.positions, bounds=True, target=ARRAY_BUFFER),
            "NORMAL": self.add_floats(geometry.normals, target=ARRAY_BUFFER),
        }
        if geometry.uvs:
            attributes["TEXCOORD_0"] = self.add_floats(geometry.uvs, target=ARRAY_BUFFER)
        primitive: dict[str, Any] = {
            "attributes": attributes,
            "indices": self._add_indices(geometry.triangles, len(geometry.positions)),
            "material": material,
        }
        if geometry.sphere_radius is not None:
            primitive["extras"] = {"sphere": {"radius": geometry.sphere_radius}}
        return self._append("meshes", {"name": name, "primitives": [primitive]})

    def share_mesh(self, name: str, mesh: int, material: int) -> int:
        """The same geometry with another material."""
        primitive = dict(self.content["meshes"][mesh]["primitives"][0], material=material)
        return self._append("meshes", {"name": name, "primitives": [primitive]})

    def add_material(self, name: str, **properties: Any) -> int:
        """A material; the properties of pbrMetallicRoughness may stand among the others."""
        pbr_names = (
            "baseColorFactor",
            "baseColorTexture",
            "metallicFactor",
            "roughnessFactor",
            "metallicRoughnessTexture",
        )
        pbr = {key: properties.pop(key) for key in pbr_names if key in properties}
        if len(pbr.get("baseColorFactor", ())) == 3:
            pbr["baseColorFactor"] = [*pbr["baseColorFactor"], 1.0]
        pbr.setdefault("metallicFactor", 0.0)
        return self._append(
            "materials", {"name": name, "pbrMetallicRoughness": pbr, **properties}
        )

    def add_matte(self, name: str, color: Sequence[float], **properties: Any) -> int:
        """A Lambertian material: without its extension a dielectric keeps 4% of reflection."""
        return self.add_material(
            name,
            baseColorFactor=list(color),
            extensions={"KHR_materials_specular": {"specularFactor": 0.0}},
            **properties,
        )

    def add_light_material(self, name: str, color: Sequence[float], strength: float) -> int:
        """A black surface that emits color × strength (cd/m²) in front."""
        return self.add_material(
            name,
            baseColorFactor=[0.0, 0.0, 0.0],
            emissiveFactor=list(color),
            extensions={
                "KHR_materials_emissive_strength": {"emissiveStrength": strength},
                "KHR_materials_specular": {"specularFactor": 0.0},
            },
        )

    def add_texture(self, uri: str, nearest: bool = False) -> int:
        """A repeating texture of the picture at uri, relative to the scene file."""
        sampler = {
            "magFilter": 9728 if nearest else 9729,
            "minFilter": 9728 if nearest else 9987,
            "wrapS": 10497,
            "wrapT": 10497,
        }
        samplers = self.content.setdefault("samplers", [])
        if sampler not in samplers:
            samplers.append(sampler)
        image = self._append("images", {"uri": uri})
        return self._append("textures", {"sampler": samplers.index(sampler), "source": image})

    def texture(self, index: int, repeat: Sequence[float] | None = None, **properties: Any) -> dict:
        """A reference to a texture; repeat is how often it fits into the unit square."""
        info: dict[str, Any] = {"index": index, **properties}
        if repeat is not None:
            info["extensions"] = {"KHR_texture_transform": {"scale": list(repeat)}}
            self.extensions.add("KHR_texture_transform")
        return info

    def add_node(self, name: str, root: bool = True, **properties: Any) -> int:
        """A node, at the top of the scene unless root is False."""
        node = self._append("nodes", {"name": name, **properties})
        if root:
            self.root_nodes.append(node)
        return node

    def add_camera(self, yfov: float, aspect: float, **properties: Any) -> int:
        """A camera node; yfov is the full vertical angle in radians."""
        perspective = {"yfov": yfov, "aspectRatio": aspect, "znear": 0.01, "zfar": 1000.0}
        camera = self._append(
            "cameras", {"name": "Camera", "type": "perspective", "perspective": perspective}
        )
        return self.add_node("Camera", camera=camera, **properties)

    def add_punctual_light(self, light: dict[str, Any]) -> dict[str, Any]:
        """Adds a light and returns the extensions of the node that carries it."""
        lights = self.root_extensions.setdefault("KHR_lights_punctual", {"lights": []})["lights"]
        lights.append(light)
        return {"KHR_lights_punctual": {"light": len(lights) - 1}}

    def write(self, folder: Path) -> list[Path]:
        """Writes NAME.gltf and NAME.bin into folder and returns their paths."""
        head: dict[str, Any] = {
            "asset": {"version": "2.0", "generator": "lumivec tools/make_scenes.py"},
            "scene": 0,
            "scenes": [{"name": self.name, "nodes": self.root_nodes}],
            **self.content,
            "buffers": [{"uri": f"{self.name}.bin", "byteLength": len(self.binary)}],
        }
        if self.root_extensions:
            head["extensions"] = self.root_extensions
        used = sorted(self.extensions | set(self.root_extensions))
        if used:
            head["extensionsUsed"] = used
        if self.required:
            head["extensionsRequired"] = sorted(self.required)
        binary, text = folder / f"{self.name}.bin", folder / f"{self.name}.gltf"
        binary.write_bytes(self.binary)
        text.write_text(as_text(rounded(head)), encoding="utf-8")
        return [text, binary]


def as_text(document: dict[str, Any]) -> str:
    """JSON with one line for each element of each top-level array."""
    lines = []
    for key, value in document.items():
        if isinstance(value, list) and value and isinstance(value[0], dict):
            rows = ",\n".join("    " + json.dumps(item) for item in value)
            lines.append(f'  "{key}": [\n{rows}\n  ]')
        else:
            lines.append(f'  "{key}": {json.dumps(value)}')
    return "{\n" + ",\n".join(lines) + "\n}\n"
