"""The paper's query experiment: the time of a look-up with more points, directions, and both."""

from __future__ import annotations

from pathlib import Path
from typing import Optional

from .. import paper
from ..markup import Html, joined, number, paragraph, row_of, seconds, table, whole
from ..plots import Level, Line, plot
from ..results import Results, entries, figure, get, show_unfinished
from ..scale import Scale

FIGURES = (
    "points",
    "directions",
    "records",
    "query_median_seconds",
    "query_95th_percentile_seconds",
    "records_found",
    "insertion_seconds",
    "balance_seconds",
    "bytes_per_record",
)
# Of each series: what grows.
ABSCISSAS = {"points": "points", "directions": "directions", "both": "records"}


def figures(results: Results, scale: Scale) -> dict:
    rows = []
    for step, result in results.of("query"):
        series = get(result.output, "series")
        for name in series if isinstance(series, dict) else {}:
            for case in entries(series, name):
                rows.append(
                    {
                        "packet": int(step.tags["at a time"].split()[0]),
                        # A step of one case has its series among its tags.
                        "series": step.tags.get("series", name),
                        **{word: figure(case, word) for word in FIGURES},
                    }
                )
    return {
        "paper": {
            "query_seconds": list(paper.QUERY_SECONDS),
            "points": paper.QUERY_POINTS,
            "directions": paper.QUERY_DIRECTIONS,
        },
        "rows": rows,
        "unfinished": results.unfinished("query"),
    }


def slowest(content: dict) -> Optional[float]:
    times = [row["query_median_seconds"] for row in content["rows"]]
    return max((time for time in times if time is not None), default=None)


def _plots(content: dict) -> Html:
    packets = sorted({row["packet"] for row in content["rows"]})
    fastest, slow = content["paper"]["query_seconds"]
    name = f"the paper: {1e3 * fastest:g} to {1e3 * slow:g} ms"
    levels = [Level(name, 1e6 * fastest), Level("", 1e6 * slow)]
    drawn = []
    for series, abscissa in ABSCISSAS.items():
        lines = []
        for color, packet in enumerate(packets):
            points = [
                (row[abscissa], 1e6 * row["query_median_seconds"])
                for row in content["rows"]
                if row["packet"] == packet and row["series"] == series
                if row[abscissa] is not None and row["query_median_seconds"] is not None
            ]
            name = "one by one" if packet == 1 else f"{packet} at a time"
            lines.append(Line(name, points, color))
        what = "points and directions" if series == "both" else series
        drawn.append(plot(f"More {what}", abscissa, "µs a query", lines, levels))
    return row_of(drawn)


def show(content: dict, folder: Path) -> Html:
    fastest, slow = content["paper"]["query_seconds"]
    points, directions = content["paper"]["points"], content["paper"]["directions"]
    of_paper = f"up to {points:,}", f"up to {directions:,}"
    rows = [["the paper", "", *of_paper, "", f"{1e3 * fastest:g} to {1e3 * slow:g} ms"]]
    rows[0] += [""] * 5
    for row in content["rows"]:
        rows.append(
            [
                row["series"],
                str(row["packet"]),
                whole(row["points"]),
                whole(row["directions"]),
                whole(row["records"]),
                seconds(row["query_median_seconds"]),
                seconds(row["query_95th_percentile_seconds"]),
                number(row["records_found"]),
                seconds(row["insertion_seconds"]),
                seconds(row["balance_seconds"]),
                number(row["bytes_per_record"]),
            ]
        )
    headers = ["series", "at a time", "points", "directions", "records", "a query (median)", "95%"]
    headers += ["records found", "an insertion", "balancing", "bytes a record"]
    return joined(
        [
            show_unfinished(content["unfinished"]),
            paragraph("One thread looks up random places and directions."),
            _plots(content),
            table(headers, rows),
        ]
    )
