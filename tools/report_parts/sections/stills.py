"""Pictures of equal time with their FLIP heat maps, and the last frames of the walks."""

from __future__ import annotations

from pathlib import Path
from typing import Optional

from ..markup import Html, element, joined, number, paragraph, picture, row_of, seconds
from ..plan import STILL_METHODS, WALK_MODES
from ..results import Results, figure, show_unfinished
from ..scale import Scale
from ..steps import Step

KINDS = ("still", "comparison")


def _place(step: Step, name: str) -> str:
    return str(Path("files") / step.key / name)


def _still(results: Results, scene: str, method: str) -> Optional[dict]:
    for step, result in results.of("still", scene=scene, method=method):
        if result.status == "ok":
            content = {
                "method": method,
                "picture": _place(step, "picture.jpg"),
                "seconds": figure(result.output, "seconds", "sample"),
                "samples_per_pixel": figure(result.output, "samples", "per_pixel"),
            }
            for other, comparison in results.of("comparison", scene=scene, method=method):
                if comparison.status == "ok":
                    beauty = ("layers", "beauty")
                    content["heat"] = _place(other, "heat.png")
                    content["relmse"] = figure(comparison.output, *beauty, "relmse")
                    content["flip"] = figure(comparison.output, *beauty, "flip")
            return content
    return None


def _frames(results: Results, scene: str, scale: Scale) -> list[dict]:
    frames = []
    for mode in WALK_MODES:
        for step, result in results.of("walk", scene=scene, mode=mode):
            asked = step.tags.get("frame time", f"{scale.frame_time:g} ms")
            if result.status == "ok" and asked == f"{scale.frame_time:g} ms":
                frames.append({"mode": mode, "picture": _place(step, step.leaves[0])})
    return frames


def figures(results: Results, scale: Scale) -> dict:
    names = dict.fromkeys(step.tags["scene"] for step, _ in results.of("still"))
    scenes = []
    for scene in names:
        stills = [_still(results, scene, method) for method in ("reference", *STILL_METHODS)]
        scenes.append(
            {
                "scene": scene,
                "stills": [still for still in stills if still],
                "frames": _frames(results, scene, scale),
            }
        )
    return {"scenes": scenes, "unfinished": results.unfinished(*KINDS)}


def _captioned(scene: str, still: dict, folder: Path) -> list[Html]:
    words = f"{still['method']}: {number(still['samples_per_pixel'])} samples a pixel, "
    words += seconds(still["seconds"])
    shown = [picture(folder / still["picture"], words, f"{scene} by {still['method']}")]
    if "heat" in still:
        errors = f"FLIP {number(still['flip'])}, relMSE {number(still['relmse'])}"
        alt = f"FLIP of {scene} by {still['method']}"
        shown.append(picture(folder / still["heat"], f"{still['method']}: {errors}", alt))
    return shown


def show(content: dict, folder: Path) -> Html:
    parts = [
        show_unfinished(content["unfinished"]),
        paragraph(
            "Stills of equal time, and FLIP against the reference: the brighter, the more "
            "visible is the difference. Below, the last frame of each walk."
        ),
    ]
    for scene in content["scenes"]:
        name = scene["scene"]
        parts.append(element("h3", name))
        parts += [row_of(_captioned(name, still, folder)) for still in scene["stills"]]
        frames = []
        for frame in scene["frames"]:
            alt = f"{name}, last frame by {frame['mode']}"
            frames.append(picture(folder / frame["picture"], f"walk, {frame['mode']}", alt))
        parts.append(row_of(frames))
    return joined(parts)
