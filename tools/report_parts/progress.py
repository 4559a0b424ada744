"""Says on stderr, line by line, which step runs and about how long all still takes."""

from __future__ import annotations

import sys
from typing import Sequence

from .steps import Result, Step

# Estimates are of one machine; another is taken to be at most so many times faster or slower.
MOST_FACTOR = 8.0


def duration(seconds: float) -> str:
    if seconds < 90.0:
        return f"{max(1, round(seconds))} s"
    if seconds < 90.0 * 60.0:
        return f"{round(seconds / 60.0)} min"
    return f"{seconds / 3600.0:.1f} h"


class Progress:
    def __init__(self, steps: Sequence[Step], kept: int) -> None:
        self.total = len(steps)
        self.number = 0
        self.left = sum(step.estimate for step in steps)
        self.estimated = self.measured = 0.0
        if kept:
            say(f"{kept} of {kept + self.total} steps are kept from before")

    def begin(self, step: Step) -> None:
        self.number += 1
        factor = self.measured / self.estimated if self.estimated > 0.0 else 1.0
        factor = min(max(factor, 1.0 / MOST_FACTOR), MOST_FACTOR)
        say(f"{self.number}/{self.total} {step.name}; about {duration(self.left * factor)} left")

    def end(self, step: Step, result: Result) -> None:
        self.left -= step.estimate
        if result.status == "failed":
            say(f"{step.name}: failed: {result.message}")
        elif result.seconds is not None:
            self.estimated += step.estimate
            self.measured += result.seconds


def say(line: str) -> None:
    print(f"report: {line}", file=sys.stderr, flush=True)
