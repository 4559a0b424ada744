"""The report in one table, and what is missing from it."""

from __future__ import annotations

from pathlib import Path

from ..markup import MISSING, Html, element, joined, number, paragraph, percent, seconds, table
from ..results import Results, figure, show_unfinished
from ..scale import Scale
from . import errors, hard_cases, query, table_1

METHODS = ("light-vectors-paper", "light-vectors-hessian")


def figures(results: Results, scale: Scale) -> dict:
    scenes: dict[str, dict] = {}
    for scene in errors.figures(results, scale)["scenes"]:
        entry = scenes.setdefault(scene["scene"], {})
        entry["target"] = scene["target"]
        entry["to_target"] = {
            name: errors.find_method(scene["methods"], name) for name in ("path", *METHODS)
        }
    for scene in table_1.figures(results, scale)["scenes"]:
        entry = scenes.setdefault(scene["scene"], {})
        entry["paper_gain"] = scene["paper_gain"]
        entry["gain"] = scene["equal_error"].get("rc")
        entry["noisy"] = scene["equal_error"].get("noisy")
        entry["rc_lv"] = scene["rows"][-1]
    cases = hard_cases.figures(results, scale)["cases"]
    too_much = [case for case in cases if case["too_much"]]
    return {
        "scale": scale.name,
        "scenes": scenes,
        "slowest_query_seconds": query.slowest(query.figures(results, scale)),
        "hard_cases": len(cases),
        "hard_cases_with_too_much_error": len(too_much),
        "of_those_known": sum(case["known"] for case in too_much),
        "unfinished": results.unfinished(*dict.fromkeys(step.kind for step in results.steps)),
    }


def _faster(scene: dict, method: str, layer: str) -> str:
    costs = scene.get("to_target")
    return errors.ratio_text(costs["path"][layer], costs[method][layer]) if costs else MISSING


def show(content: dict, folder: Path) -> Html:
    rows = []
    for name, scene in content["scenes"].items():
        costs = [_faster(scene, method, layer) for layer in errors.TARGETED for method in METHODS]
        gain = table_1.gain_text(scene.get("gain")) + (" (noisy)" if scene.get("noisy") else "")
        rows.append(
            [
                name,
                *costs,
                percent(scene.get("paper_gain")),
                gain,
                seconds(figure(scene, "rc_lv", "median_seconds")),
                number(figure(scene, "rc_lv", "median_flip")),
            ]
        )
    headers = ["scene", "sum: criteria of the paper", "ours", "indirect: of the paper", "ours"]
    headers += ["gain in the paper", "ours", "rc+lv: a frame", "FLIP"]
    caption = "How many times less core time than path tracing takes to the target error, by the "
    caption += "criteria of the paper and by ours; and the time that rc+lv saves over rc in walks, "
    caption += "at equal error"
    parts = [show_unfinished(content["unfinished"])]
    if content["scale"] == "quick":
        text = "A quick report: pictures are small, times short and references noisy. It shows "
        text += "that all runs; figures to go by need the full one."
        parts.append(element("p", text, class_="note"))
    parts.append(table(headers, rows, caption))
    too_much = content["hard_cases_with_too_much_error"]
    parts.append(
        paragraph(
            f"Slowest median look-up: {seconds(content['slowest_query_seconds'])} (the paper: 10 "
            f"to 15 ms). Hard cases with too much error: {too_much} "
            f"of {content['hard_cases']}; known defects among them: {content['of_those_known']}."
        )
    )
    return joined(parts)
