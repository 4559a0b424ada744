"""Time and error frame by frame along the walks."""

from __future__ import annotations

from pathlib import Path

from ..markup import Html, element, joined, number, paragraph, row_of, seconds, table, whole
from ..plan import IMAGE_SPACE_MODES, WALK_MODES
from ..plots import Line, plot
from ..results import Results, show_unfinished
from ..scale import Scale
from .walk_runs import SHARES, find_run, scenes_of, walk_runs


def figures(results: Results, scale: Scale) -> dict:
    return {
        "frame_time_ms": scale.frame_time,
        "orbit_degrees": scale.orbit,
        "scenes": scenes_of(results),
        "runs": walk_runs(results),
        "unfinished": results.unfinished("walk"),
    }


def _plots(content: dict, scene: str) -> Html:
    drawn = []
    for name, y_name, factor in (
        ("seconds", "frame time, ms", 1e3),
        ("relmse", "relMSE", 1.0),
        ("flip", "FLIP mean", 1.0),
    ):
        lines = []
        for color, mode in enumerate(WALK_MODES + IMAGE_SPACE_MODES):
            run = find_run(content["runs"], scene, mode, content["frame_time_ms"])
            values = run["frames"][name] if run else []
            points = [(i, y * factor) for i, y in enumerate(values) if y is not None]
            lines.append(Line(mode, points, color))
        logarithmic = name != "flip"
        title = f"{scene}, {y_name}"
        drawn.append(plot(title, "frame", y_name, lines, (), False, logarithmic))
    return row_of(drawn)


def _percentiles(content: dict, scene: str) -> Html:
    rows = []
    for run in content["runs"]:
        if run["scene"] != scene:
            continue
        limit = run["frame_time_ms"]
        rows.append(
            [
                run["mode"],
                f"{limit:g} ms" if limit is not None else "every pixel",
                seconds(run["first_seconds"]),
                *(seconds(run["seconds"][name]) for name in SHARES),
                whole(run["median_traced"]),
                whole(run["median_filled"]),
                number(run["median_relmse"]),
                number(run["median_flip"]),
                number(run["worst_flip"]),
                number(run["median_change_ratio"]),
            ]
        )
    headers = ["mode", "frame time asked", "first", *SHARES, "traced", "filled"]
    headers += ["relMSE (median)", "FLIP (median)", "FLIP (worst)", "change"]
    return table(headers, rows, "All frames but the first", words=2)


def show(content: dict, folder: Path) -> Html:
    parts = [
        show_unfinished(content["unfinished"]),
        paragraph(
            f"The eye goes {content['orbit_degrees']:g} degrees around what it looks at. Drawn are "
            f"rc and rc+lv with a frame time of {content['frame_time_ms']:g} ms; path and lv trace "
            "every pixel of every frame. In image space: the points that earlier frames saw are moved "
            "to where they are seen now, instead of surfaces being seen afresh. Filled: pixels without a sample near. Change: that of the "
            "picture from frame to frame, by that of the reference; above 1, it flickers."
        ),
    ]
    for scene in content["scenes"]:
        parts += [element("h3", scene), _plots(content, scene), _percentiles(content, scene)]
    return joined(parts)
