"""Results by what they measure, and figures that may be missing."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, isfinite, log
from typing import Any, Iterator, Optional, Sequence

from .markup import Html, element, joined
from .steps import Result, Step


class Results:
    def __init__(self, steps: Sequence[Step]) -> None:
        self.steps = list(steps)
        self._results = {step.key: Result() for step in steps}

    def __getitem__(self, step: Step) -> Result:
        return self._results[step.key]

    def __setitem__(self, step: Step, result: Result) -> None:
        self._results[step.key] = result

    def of(self, kind: str, **tags: str) -> Iterator[tuple[Step, Result]]:
        """`frame_time` is the tag `frame time`."""
        wanted = {name.replace("_", " "): value for name, value in tags.items()}
        for step in self.steps:
            if step.kind == kind and all(step.tags.get(n) == v for n, v in wanted.items()):
                yield step, self[step]

    def named(self, name: str) -> Optional[Result]:
        return next((self[step] for step in self.steps if step.name == name), None)

    def unfinished(self, *kinds: str) -> list[dict]:
        """Of the kinds: what failed or was not run, and why."""
        return [
            {"step": step.name, "status": self[step].status, "message": self[step].message}
            for step in self.steps
            if step.kind in kinds and self[step].status != "ok"
        ]


def show_unfinished(unfinished: Sequence[dict]) -> Html:
    lines = []
    for entry in unfinished:
        words = entry["status"] + (f": {entry['message']}" if entry["message"] else "")
        lines.append(element("div", element("b", entry["step"]), f" — {words}", class_="failed"))
    return joined(lines)


def get(content: Any, *path: Any) -> Any:
    """Of nested JSON, or nothing where it is not so deep or of another shape."""
    for word in path:
        if isinstance(content, dict):
            content = content.get(word)
        elif isinstance(content, list) and isinstance(word, int) and word < len(content):
            content = content[word]
        else:
            return None
    return content


def figure(content: Any, *path: Any) -> Optional[float]:
    value = get(content, *path)
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not isfinite(value):
        return None
    return value


def entries(content: Any, *path: Any) -> list[dict]:
    value = get(content, *path)
    return [entry for entry in value if isinstance(entry, dict)] if isinstance(value, list) else []


def percentile(values: Sequence[float], share: float) -> Optional[float]:
    """The value that the share of all does not exceed; no value is made up."""
    ordered = sorted(values)
    return ordered[int(share * (len(ordered) - 1))] if ordered else None


def median(values: Sequence[float]) -> Optional[float]:
    return percentile(values, 0.5)


def ratio(a: Optional[float], b: Optional[float]) -> Optional[float]:
    return a / b if a is not None and b else None


@dataclass(frozen=True)
class Reach:
    """The time that it takes to bring an error down to a target."""

    seconds: Optional[float]
    mark: str = ""  # `<`: at most that; `>`: more than that; `~`: extrapolated


def time_to_reach(points: Sequence[tuple[float, float]], target: float) -> Reach:
    """Of (seconds, error): between the last one above the target and the next, both logarithmic."""
    ordered = sorted(points)
    above = [i for i, (_, error) in enumerate(ordered) if error > target]
    if not ordered or target <= 0.0:
        return Reach(None)
    if not above:
        return Reach(ordered[0][0], "<")
    last = above[-1]
    if last == len(ordered) - 1:
        return Reach(ordered[last][0], ">")
    (t0, e0), (t1, e1) = ordered[last], ordered[last + 1]
    least = 1e-3 * target  # an error of 0 has no logarithm
    share = log(e0 / target) / log(e0 / max(e1, least))
    return Reach(t0 * exp(share * log(t1 / t0)))
