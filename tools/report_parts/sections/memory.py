"""Memory: the largest resident size of every run, and what its cache holds."""

from __future__ import annotations

from pathlib import Path

from ..markup import Html, joined, number, paragraph, size, table, whole
from ..results import Results, figure, ratio
from ..scale import Scale

# Where the kinds of runs tell of their cache.
CACHES = {"walk": (), "still": ("cache",)}


def figures(results: Results, scale: Scale) -> dict:
    rows = []
    for step in results.steps:
        result = results[step]
        if result.seconds is None or step.kind == "comparison":
            continue
        row = {"run": step.name, "peak_bytes": result.peak_bytes}
        if step.kind in CACHES:
            place = CACHES[step.kind]
            # A walk tells them as `cache_bytes` beside the rest, a still in a group of their own.
            names = ("bytes", "records") if place else ("cache_bytes", "records")
            row["cache_bytes"] = figure(result.output, *place, names[0])
            row["records"] = figure(result.output, *place, names[1])
        rows.append(row)
    return {"rows": rows}


def show(content: dict, folder: Path) -> Html:
    rows = []
    for row in content["rows"]:
        cache, records = row.get("cache_bytes"), row.get("records")
        each = number(ratio(cache, records))
        rows.append([row["run"], size(row["peak_bytes"]), size(cache), whole(records), each])
    headers = ["run", "largest resident size", "cache", "records", "bytes a record"]
    note = "The size is that of the whole process, with the references that it rendered; where "
    note += "none is told, it is less than the report's own, some 25 MiB."
    return joined([paragraph(note), table(headers, rows)])
