"""The walks' figures, as the sections about them share them."""

from __future__ import annotations

from typing import Optional

from ..results import Results, entries, figure, median, percentile

FRAME_FIGURES = ("seconds", "traced", "filled", "relmse", "flip", "cache_hits", "cache_misses")
FRAME_FIGURES += ("change", "reference_change")  # of the displayed picture since the frame before
SHARES = {"median": 0.5, "95%": 0.95, "99%": 0.99, "worst": 1.0}


def _run(tags: dict, output: object, peak_bytes: Optional[int]) -> dict:
    frames = {name: [figure(f, name) for f in entries(output, "frames")] for name in FRAME_FIGURES}
    # The first frame has nothing to go by, and fills the caches.
    following = {
        name: [value for value in (values[1:] or values) if value is not None]
        for name, values in frames.items()
    }
    changes = [
        change / expected
        for change, expected in zip(frames["change"][1:], frames["reference_change"][1:])
        if change is not None and expected
    ]
    time = tags.get("frame time")
    return {
        "scene": tags["scene"],
        "mode": tags["mode"],
        "frame_time_ms": float(time.split()[0]) if time else None,
        "first_seconds": frames["seconds"][0] if frames["seconds"] else None,
        "seconds": {name: percentile(following["seconds"], p) for name, p in SHARES.items()},
        "median_relmse": median(following["relmse"]),
        "median_flip": median(following["flip"]),
        "worst_flip": percentile(following["flip"], 1.0),
        "median_traced": median(following["traced"]),
        "median_change_ratio": median(changes),
        "median_filled": median(following["filled"]),
        "records": figure(output, "records"),
        "cache_bytes": figure(output, "cache_bytes"),
        "peak_bytes": peak_bytes,
        "frames": frames,
    }


def walk_runs(results: Results) -> list[dict]:
    return [
        _run(step.tags, result.output, result.peak_bytes)
        for step, result in results.of("walk")
        if entries(result.output, "frames")
    ]


def find_run(runs: list[dict], scene: str, mode: str, frame_time: float) -> Optional[dict]:
    """Modes that trace every pixel have no frame time."""
    for run in runs:
        if run["scene"] == scene and run["mode"] == mode:
            if run["frame_time_ms"] in (None, frame_time):
                return run
    return None


def scenes_of(results: Results) -> list[str]:
    return list(dict.fromkeys(step.tags["scene"] for step, _ in results.of("walk")))
