"""All runs: the exact command, how it ended, and what it took."""

from __future__ import annotations

from pathlib import Path

from ..markup import Html, element, joined, paragraph, seconds, size, table
from ..results import Results
from ..scale import Scale


def figures(results: Results, scale: Scale) -> dict:
    runs = []
    for step in results.steps:
        result = results[step]
        runs.append(
            {
                "run": step.name,
                "command": step.command,
                "key": step.key,
                "status": result.status,
                "message": result.message,
                "when": result.when,
                "kept_from_before": result.was_kept,
                "seconds": result.seconds,
                "core_seconds": result.core_seconds,
                "peak_bytes": result.peak_bytes,
            }
        )
    return {"runs": runs}


def show(content: dict, folder: Path) -> Html:
    rows = []
    for run in content["runs"]:
        status = element("b", run["status"]) if run["status"] != "ok" else run["status"]
        words = [element("code", run["command"])]
        if run["message"]:
            words.append(element("div", run["message"], class_="failed"))
        rows.append(
            [
                element("div", element("b", run["run"]), *words),
                run["when"],
                status,
                seconds(run["seconds"]),
                seconds(run["core_seconds"]),
                size(run["peak_bytes"]),
            ]
        )
    headers = ["run and command", "when", "ended", "time", "core time", "largest resident size"]
    note = "Each ran in a folder of its own, where it writes figures.json and its pictures."
    return joined([paragraph(note), table(headers, rows, words=3)])
