"""Sections of the page, in its order. Each makes its figures from results, and HTML from those
figures alone: what the page shows is in the JSON."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Callable

from ..markup import Html
from ..results import Results
from ..scale import Scale
from . import errors, hard_cases, memory, query, rays, runs
from . import stills, summary, table_1, validity, walks


@dataclass(frozen=True)
class Section:
    anchor: str
    heading: str
    figures: Callable[[Results, Scale], dict]
    show: Callable[[dict, Path], Html]  # of the figures; the folder holds the pictures


SECTIONS = (
    Section("summary", "Summary", summary.figures, summary.show),
    Section("errors", "Error against time", errors.figures, errors.show),
    Section("table-1", "The paper's Table 1, and ours", table_1.figures, table_1.show),
    Section("query", "The query experiment", query.figures, query.show),
    Section("walks", "Frames of the walks", walks.figures, walks.show),
    Section("hard-cases", "Hard cases", hard_cases.figures, hard_cases.show),
    Section("validity", "What the reuse criteria are worth", validity.figures, validity.show),
    Section("rays", "Rays a second", rays.figures, rays.show),
    Section("memory", "Memory", memory.figures, memory.show),
    Section("pictures", "Pictures", stills.figures, stills.show),
    Section("runs", "Runs and commands", runs.figures, runs.show),
)
