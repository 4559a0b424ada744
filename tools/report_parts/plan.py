"""Which programs are run, with which options, in which order."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Iterable, Optional, Sequence
from urllib.parse import unquote

from .machine import processor_model, processors
from .scale import Scale
from .steps import STDOUT, ReportError, Step, fingerprint, step_key

WALK_MODES = ("path", "lv", "rc", "rc+lv")
REUSING_MODES = ("rc", "rc+lv")
# These with the paper's cache in image space instead of the shading cache, at one frame time.
IMAGE_SPACE = " in image space"
IMAGE_SPACE_MODES = tuple(mode + IMAGE_SPACE for mode in REUSING_MODES)
STILL_METHODS = {
    "path": ("--integrator", "path"),
    "light-vectors-paper": ("--integrator", "light-vectors", "--validity", "paper"),
    "light-vectors-hessian": ("--integrator", "light-vectors", "--validity", "hessian"),
}
REFERENCE_SEED = 20030  # not that of the pictures it judges
SHIPPED_SCENES = ("cornell_box_1", "cornell_box_2", "sphere_flake")

# Path-traced samples a second of one thread, for estimates of time only.
SAMPLE_RATES = {"sphere_flake": 60e3}
SAMPLE_RATE = 200e3


@dataclass(frozen=True)
class SceneFile:
    name: str
    path: Path
    fingerprint: str  # of the file and of what it refers to


def find_scene(name: str, shipped: Path) -> SceneFile:
    path = Path(name) if Path(name).is_file() else shipped / f"{name}.gltf"
    if not path.is_file():
        known = ", ".join(sorted(file.stem for file in shipped.glob("*.gltf")))
        raise ReportError(f"--scene {name}: is no file, and no shipped scene; those are {known}")
    path = path.resolve()
    parts = [fingerprint(path)]
    if path.suffix == ".gltf":
        try:
            content = json.loads(path.read_text(encoding="utf-8"))
        except ValueError as error:
            raise ReportError(f"{path}: is no glTF: {error}") from error
        for entry in [*content.get("buffers", []), *content.get("images", [])]:
            uri = entry.get("uri", "data:")
            if not uri.startswith("data:"):
                parts.append(fingerprint(path.parent / unquote(uri)))
    return SceneFile(path.stem, path, hashlib.sha256("".join(parts).encode()).hexdigest()[:16])


# Parts that can be asked for alone, by the kinds of their steps.
PARTS = {
    "errors": ("error against time",),
    "walks": ("walk",),
    "queries": ("query",),
    "hard-cases": ("hard cases",),
    "validity": ("validity",),
    "rays": ("rays",),
    "stills": ("still", "comparison"),
}


class Plan:
    def __init__(
        self,
        build: Path,
        folder: Path,
        scale: Scale,
        scenes: Sequence[SceneFile],
        threads: int,
        parts: Sequence[str] = (),  # none: all
    ) -> None:
        self.build, self.folder, self.scale = build, folder, scale
        self.scenes, self.threads = scenes, threads
        self.size = f"{scale.width}x{scale.height}"
        self.lumivec = build / "viewer" / "lumivec"
        self.steps: list[Step] = []
        for scene in scenes:
            self._errors(scene)
        for scene in scenes:
            self._walks(scene)
        self._queries()
        self._hard_cases()
        for scene in scenes[: scale.validity_scenes]:
            self._validity(scene)
        self._rays()
        for scene in scenes:
            self._stills(scene)
        kinds = {kind for part in parts or PARTS for kind in PARTS[part]}
        self.steps = [step for step in self.steps if step.kind in kinds]

    def _add(
        self,
        kind: str,
        tags: dict[str, str],
        program: Path,
        arguments: Iterable[str],
        estimate: float,
        scene: Optional[SceneFile] = None,
        output: Optional[str] = "figures.json",
        leaves: tuple[str, ...] = (),
        needs: tuple[Step, ...] = (),
    ) -> Step:
        words = tuple(arguments)
        # Figures of another machine are not ours.
        about = [processor_model(), str(processors()), scene.fingerprint if scene else ""]
        key = step_key(self.folder, program, words, about)
        place = self.folder / "files" / key
        names = tuple(step.name for step in needs)
        step = Step(kind, tags, program, words, key, place, output, leaves, names, estimate)
        self.steps.append(step)
        return step

    def _bench(self, name: str) -> Path:
        return self.build / "tools" / f"bench_{name}"

    def _thread_options(self) -> tuple[str, ...]:
        return ("--threads", str(self.threads))

    def _sampling_seconds(self, scene: Optional[SceneFile], samples: float) -> float:
        """Of path tracing so many samples a pixel."""
        rate = SAMPLE_RATES.get(scene.name, SAMPLE_RATE) if scene else SAMPLE_RATE
        pixels = self.scale.width * self.scale.height
        return pixels * samples / (rate * (self.threads or processors()))

    def _errors(self, scene: SceneFile) -> None:
        scale = self.scale
        seconds = 3.0 * scale.first_seconds * (2.0 ** (scale.doublings + 1) - 1.0)
        self._add(
            "error against time",
            {"scene": scene.name},
            self._bench("error"),
            [
                *("--scene", str(scene.path), "--size", self.size),
                *("--first", f"{scale.first_seconds:g}", "--doublings", str(scale.doublings)),
                *("--reference-samples", str(scale.reference_samples)),
                *("--references", str(self.folder / "references" / "stills")),
                *self._thread_options(),
                *("--json", "figures.json"),
            ],
            seconds + self._sampling_seconds(scene, scale.reference_samples),
            scene,
        )

    def _walks(self, scene: SceneFile) -> None:
        scale = self.scale
        name = f"{scene.name}_{self.size}_{scale.frames}_{scale.orbit:g}"
        name += f"_{scale.walk_reference_samples}_{scene.fingerprint}"
        options = [
            *("--path", f"orbit:{scale.orbit:g}", "--frames", str(scale.frames)),
            *("--size", self.size, *self._thread_options()),
            *("--reference", str(self.folder / "references" / "walks" / name)),
            *("--reference-spp", str(scale.walk_reference_samples)),
            *("--stats", "figures.json", "--output", "frames", "--quiet"),
        ]
        # The first walk renders the reference frames.
        references = self._sampling_seconds(scene, scale.frames * scale.walk_reference_samples)
        comparing = scale.frames * scale.width * scale.height * 5e-6
        for mode in WALK_MODES + IMAGE_SPACE_MODES:
            reusing = mode not in ("path", "lv")
            frame_times = scale.frame_times if reusing else (0.0,)
            if mode in IMAGE_SPACE_MODES:
                frame_times = (scale.frame_time,)
            for frame_time in frame_times:
                tags = {"scene": scene.name, "mode": mode}
                if reusing:
                    tags["frame time"] = f"{frame_time:g} ms"
                frame = frame_time * 1e-3 if reusing else self._sampling_seconds(scene, 1.0)
                self._add(
                    "walk",
                    tags,
                    self.lumivec,
                    [
                        *("walk", str(scene.path), "--mode", mode.removesuffix(IMAGE_SPACE)),
                        *(("--reuse", "image") if mode in IMAGE_SPACE_MODES else ()),
                        *(("--frame-time", f"{frame_time:g}") if reusing else ()),
                        *options,
                    ],
                    1.0 + scale.frames * frame + comparing + references,
                    scene,
                    leaves=(f"frames/frame_{scale.frames - 1:05d}.png",),
                )
                references = 0.0

    def _queries(self) -> None:
        # As the renderer shades, several at a time, and one by one, as the paper does.
        for packet in ("16", "1"):
            options = ["--queries", str(self.scale.queries), "--packet", packet]
            options += ["--json", "figures.json"]
            if not self.scale.query_cases:
                tags = {"at a time": f"{packet} at a time"}
                self._add("query", tags, self._bench("query"), options, 90.0)
            for series, points, directions in self.scale.query_cases:
                tags = {"at a time": f"{packet} at a time", "series": series}
                tags["case"] = f"{points:,} points and {directions:,} directions"
                case = ["--case", str(points), str(directions), *options]
                estimate = 0.2 + 1e-6 * points * directions
                self._add("query", tags, self._bench("query"), case, estimate)

    def _hard_cases(self) -> None:
        self._add(
            "hard cases",
            {},
            self.build / "tests" / "hard_cases_test",
            [f"--gtest_filter={self.scale.hard_cases}"],
            240.0 if self.scale.hard_cases == "*" else 15.0,
            output=None,
        )

    def _validity(self, scene: SceneFile) -> None:
        scale = self.scale
        size = scale.validity_size
        self._add(
            "validity",
            {"scene": scene.name},
            self._bench("validity"),
            [
                *("--scene", str(scene.path), "--size", f"{size}x{size}"),
                *("--records", str(scale.validity_records)),
                *("--samples", str(scale.validity_samples)),
                *("--time", f"{scale.validity_seconds:g}"),
                *("--reference-samples", str(scale.reference_samples)),
                *("--references", str(self.folder / "references" / "stills")),
                *self._thread_options(),
                *("--json", "figures.json"),
            ],
            7.0 * scale.validity_seconds + scale.validity_records * 0.04,
            scene,
        )

    def _rays(self) -> None:
        scale = self.scale
        options = ["--size", str(scale.rays_size), "--spp", str(scale.rays_samples)]
        options += ["--rounds", str(scale.rays_rounds), "--json", "figures.json"]
        if scale.rays_own_scenes:
            self._add("rays", {}, self._bench("rays"), options, 120.0)
            return
        for scene in self.scenes:
            words = [str(scene.path), *options]
            self._add("rays", {"scene": scene.name}, self._bench("rays"), words, 2.0, scene)

    def _stills(self, scene: SceneFile) -> None:
        def still(method: str, options: Iterable[str], estimate: float) -> Step:
            return self._add(
                "still",
                {"scene": scene.name, "method": method},
                self.lumivec,
                [
                    *("render", str(scene.path), "--size", self.size, *options),
                    *self._thread_options(),
                    *("-o", "picture.exr", "-o", "picture.jpg"),
                    *("--stats", "figures.json", "--quiet"),
                ],
                estimate,
                scene,
                leaves=("picture.exr", "picture.jpg"),
            )

        samples = self.scale.picture_reference_samples
        reference = still(
            "reference",
            ["--integrator", "path", "--spp", str(samples), "--seed", str(REFERENCE_SEED)],
            1.0 + self._sampling_seconds(scene, samples),
        )
        for method, options in STILL_METHODS.items():
            seconds = self.scale.picture_seconds
            picture = still(method, [*options, "--time", f"{seconds:g}"], 1.0 + seconds)
            files = [str(step.place / "picture.exr") for step in (picture, reference)]
            self._add(
                "comparison",
                {"scene": scene.name, "method": method},
                self.lumivec,
                ["compare", *files, "--json", "--heatmap", "heat.png"],
                1.0,
                scene,
                output=STDOUT,
                leaves=("heat.png",),
                needs=(picture, reference),
            )
