"""Rays a second of the path tracer against bare Embree loops."""

from __future__ import annotations

from pathlib import Path

from ..markup import Html, joined, number, paragraph, table
from ..results import Results, entries, get, median, show_unfinished
from ..scale import Scale

RATES = ("camera", "scatter", "shadow", "bare", "path")
RATIOS = ("path_over_bare", "two_threads_over_one")


def figures(results: Results, scale: Scale) -> dict:
    scenes = []
    for _, result in results.of("rays"):
        for scene in entries(result.output, "scenes"):
            row: dict = {"scene": Path(str(get(scene, "scene"))).stem}
            for name in (*RATES, *RATIOS):
                values = get(scene, name)
                rounds = values if isinstance(values, list) else []
                row[name] = median([v for v in rounds if isinstance(v, (int, float))])
            scenes.append(row)
    return {"scenes": scenes, "unfinished": results.unfinished("rays")}


def show(content: dict, folder: Path) -> Html:
    rows = []
    for scene in content["scenes"]:
        rates = [scene[name] for name in RATES]
        cells = [number(rate / 1e6 if rate is not None else None) for rate in rates]
        rows.append([scene["scene"], *cells, *(number(scene[name]) for name in RATIOS)])
    headers = ["scene", "bare: camera", "scatter", "shadow", "mixture", "path tracer"]
    headers += ["path tracer / bare", "two threads / one"]
    return joined(
        [
            show_unfinished(content["unfinished"]),
            paragraph(
                "Bare loops only intersect; the mixture has the path tracer's shares of rays."
            ),
            table(headers, rows, "Million rays a second, one thread; medians of rounds"),
        ]
    )
