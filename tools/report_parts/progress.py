"""Says on stderr, line by line, which step runs and about how long all still takes."""

from __future__ import annotations

import sys
import threading
import time
from typing import Optional, Sequence

from .steps import Result, Step

# Estimates are of one machine; another is taken to be at most so many times faster or slower.
MOST_FACTOR = 8.0
BEAT_SECONDS = 300.0  # between lines while one step runs


def duration(seconds: float) -> str:
    if seconds < 90.0:
        return f"{max(1, round(seconds))} s"
    if seconds < 90.0 * 60.0:
        return f"{round(seconds / 60.0)} min"
    return f"{seconds / 3600.0:.1f} h"


class Progress:
    """A context: what it says while a step runs comes from a thread, which ends with it."""

    def __init__(self, steps: Sequence[Step], kept: int, beat: float = BEAT_SECONDS) -> None:
        self.total = len(steps)
        self.number = 0
        self.left = sum(step.estimate for step in steps)
        self.estimated = self.measured = 0.0
        self.beat = beat
        self.running: Optional[Step] = None
        self.started = 0.0
        self.over = threading.Event()
        if kept:
            say(f"{kept} of {kept + self.total} steps are kept from before")

    def __enter__(self) -> Progress:
        threading.Thread(target=self._say_at_times, daemon=True).start()
        return self

    def __exit__(self, *error: object) -> None:
        self.over.set()

    def _say_at_times(self) -> None:
        while not self.over.wait(self.beat):
            step, taken = self.running, time.monotonic() - self.started
            if step and taken >= self.beat:
                say(f"{self._place(step)}, for {duration(taken)} so far; {self._left(taken)}")

    def _place(self, step: Step) -> str:
        return f"{self.number}/{self.total} {step.name}"

    def _left(self, taken: float) -> str:
        """A step that takes longer than estimated is taken to end soon."""
        factor = self.measured / self.estimated if self.estimated > 0.0 else 1.0
        factor = min(max(factor, 1.0 / MOST_FACTOR), MOST_FACTOR)
        this = self.running.estimate if self.running else 0.0
        left = (self.left - this) * factor + max(0.0, this * factor - taken)
        return f"about {duration(left)} left"

    def begin(self, step: Step) -> None:
        self.number += 1
        self.running, self.started = step, time.monotonic()
        say(f"{self._place(step)}; {self._left(0.0)}")

    def end(self, step: Step, result: Result) -> None:
        self.running = None
        self.left -= step.estimate
        if result.status == "failed":
            say(f"{step.name}: failed: {result.message}")
        elif result.seconds is not None:
            self.estimated += step.estimate
            self.measured += result.seconds


def say(line: str) -> None:
    print(f"report: {line}", file=sys.stderr, flush=True)
