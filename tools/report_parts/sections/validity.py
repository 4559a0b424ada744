"""What each part of the reuse criteria is worth."""

from __future__ import annotations

from pathlib import Path

from ..markup import Html, element, joined, number, paragraph, row_of, table, whole
from ..results import Results, entries, figure, get, show_unfinished
from ..scale import Scale

FIGURES = (
    "records",
    "gather_paths",
    "core_seconds",
    "samples_per_pixel",
    "rmse",
    "rmse_over_all_parts",
    "relmse",
    "relmse_over_all_parts",
)
KINDS = {"equal_records": "At equal records", "equal_time": "At equal time"}


def _variant(content: dict) -> dict:
    return {
        "variant": str(get(content, "variant")),
        "not_available": get(content, "not_available"),
        "below_noise": bool(get(content, "below_noise")),
        **{name: figure(content, name) for name in FIGURES},
    }


def figures(results: Results, scale: Scale) -> dict:
    scenes = [
        {
            "scene": step.tags["scene"],
            "reference_noise": figure(result.output, "noise", "relmse"),
            **{kind: [_variant(v) for v in entries(result.output, kind)] for kind in KINDS},
        }
        for step, result in results.of("validity")
        if result.output
    ]
    return {"scenes": scenes, "unfinished": results.unfinished("validity")}


def _table(variants: list[dict], caption: str) -> Html:
    rows = []
    for v in variants:
        name = v["variant"] + (f" ({v['not_available']})" if v["not_available"] else "")
        mark = "*" if v["below_noise"] else ""
        rows.append(
            [
                name,
                whole(v["records"]),
                whole(v["gather_paths"]),
                number(v["core_seconds"]),
                number(v["samples_per_pixel"]),
                number(v["rmse"]) + mark,
                number(v["rmse_over_all_parts"]),
                number(v["relmse"]) + mark,
                number(v["relmse_over_all_parts"]),
            ]
        )
    headers = ["variant", "records", "paths", "core s", "samples"]
    headers += ["RMSE", "ratio", "relMSE", "ratio"]
    return table(headers, rows, caption)


def show(content: dict, folder: Path) -> Html:
    parts = [
        show_unfinished(content["unfinished"]),
        paragraph(
            "Error of the indirect light without one part of the criteria. Ratios are to the error "
            "with all parts: above 1, the part is worth having. * : below the reference's noise."
        ),
    ]
    for scene in content["scenes"]:
        noise = number(scene["reference_noise"])
        parts.append(element("h3", f"{scene['scene']} (noise of the reference: relMSE {noise})"))
        parts.append(row_of(_table(scene[kind], caption) for kind, caption in KINDS.items()))
    return joined(parts)
