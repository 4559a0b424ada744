"""Scenes that are known to break renderers: the error of each case, by both integrators."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Optional

from ..markup import MISSING, Html, Text, element, joined, paragraph, table
from ..results import Results, show_unfinished
from ..scale import Scale

INTEGRATORS = ("path", "light-vectors")
_NUMBER = r"([-+.\w]+)%"
_LINE = re.compile(rf"^(.+?)\s+({'|'.join(INTEGRATORS)})\s+{_NUMBER}\s+{_NUMBER}(.*)$")
_COUNT = re.compile(r"^\[==========\] (\d+) tests? from .* ran")
_ENDING = re.compile(r"^\[  (PASSED|FAILED|SKIPPED ) ?\] (\d+) tests?")
_KNOWN = re.compile(r"^(.+?): (.+); error ([-+.\w]+)%, allowed ([-+.\w]+)%$")


def _share(text: str) -> Optional[float]:
    """Of percent; not a number is no figure."""
    try:
        value = float(text) / 100.0
    except ValueError:
        return None
    return value if value == value and abs(value) != float("inf") else None


def figures(results: Results, scale: Scale) -> dict:
    cases, known, counts = [], [], {}
    for _, result in results.of("hard cases"):
        for line in result.text.splitlines():
            if found := _LINE.match(line):
                name, integrator, error, allowed, rest = found.groups()
                cases.append(
                    {
                        "case": name.strip(),
                        "integrator": integrator,
                        "error": _share(error),
                        "allowed": _share(allowed),
                        "too_much": bool(rest.strip()),
                    }
                )
            elif found := _KNOWN.match(line):
                known.append({"case": found.group(1), "defect": found.group(2)})
            elif found := _COUNT.match(line):
                counts["run"] = int(found.group(1))
            elif found := _ENDING.match(line):
                counts[found.group(1).strip().lower()] = int(found.group(2))
    names = {entry["case"] for entry in known}
    for case in cases:
        case["known"] = case["too_much"] and case["case"] in names
    return {
        "filter": scale.hard_cases,
        "tests": counts,
        "cases": cases,
        "known_defects": known,
        "unfinished": results.unfinished("hard cases"),
    }


def _percent(share: Optional[float]) -> str:
    return MISSING if share is None else f"{100.0 * share:.4f}%"


def show(content: dict, folder: Path) -> Html:
    rows: dict[str, dict[str, dict]] = {}
    for case in content["cases"]:
        rows.setdefault(case["case"], {})[case["integrator"]] = case
    lines = []
    for name, by_integrator in rows.items():
        cells: list[Text] = [name]
        for integrator in INTEGRATORS:
            case = by_integrator.get(integrator)
            error = _percent(case["error"] if case else None)
            words = " known defect" if case and case["known"] else " too much"
            cells.append(element("b", error, words) if case and case["too_much"] else error)
            cells.append(_percent(case["allowed"] if case else None))
        lines.append(cells)
    headers = ["case"]
    for integrator in INTEGRATORS:
        headers += [f"{integrator}: error", "allowed"]
    counts = ", ".join(f"{count} {name}" for name, count in content["tests"].items())
    parts = [show_unfinished(content["unfinished"]), paragraph(f"Tests: {counts or MISSING}.")]
    if content["filter"] != "*":
        parts.append(paragraph("A quick report runs some of the cases only."))
    for defect in content["known_defects"]:
        parts.append(paragraph(f"Known: {defect['case']}: {defect['defect']}"))
    return joined([*parts, table(headers, lines)])
