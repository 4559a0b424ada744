"""The paper's Table 1 beside ours, at equal time and at equal error."""

from __future__ import annotations

from pathlib import Path
from typing import Optional

from .. import paper
from ..markup import Html, element, joined, number, paragraph, percent, row_of, seconds, table
from ..plan import WALK_MODES
from ..plots import Level, Line, plot
from ..results import Reach, Results, entries, figure, ratio, show_unfinished, time_to_reach
from ..scale import Scale
from .walk_runs import find_run, scenes_of, walk_runs

# Below so many times the reference's own noise, a difference of errors says little.
LEAST_OVER_NOISE = 2.0


def _paper_row(scene: str, mode: str) -> dict:
    first, following = paper.TABLE_1.get(scene, {}).get(mode, (None, None))
    return {"name": paper.MODES.get(mode), "first_seconds": first, "following_seconds": following}


def _row(run: Optional[dict], scene: str, mode: str, pixels: int) -> dict:
    of_paper = _paper_row(scene, mode)
    if run is None:
        return {"mode": mode, "paper": of_paper}
    return {
        "mode": mode,
        "paper": of_paper,
        "first_seconds": run["first_seconds"],
        "median_seconds": run["seconds"]["median"],
        "median_relmse": run["median_relmse"],
        "median_flip": run["median_flip"],
        "traced_share": ratio(run["median_traced"], pixels),
        "seconds_per_traced": ratio(run["seconds"]["median"], run["median_traced"]),
    }


def _reach_json(reach: Reach, own: Optional[float]) -> dict:
    """With the share of the time that `own` saves."""
    share = ratio(own, reach.seconds)
    gain = 1.0 - share if share is not None else None
    return {"seconds": reach.seconds, "mark": reach.mark, "gain": gain}


def _reach_by_samples(run: Optional[dict], noise: float, target: float) -> Reach:
    """Of path tracing, whose relMSE falls as 1 / time."""
    if run is None or run["median_relmse"] is None or not run["seconds"]["median"] or target <= 0.0:
        return Reach(None)
    error = run["median_relmse"] - noise
    if error <= target:
        return Reach(run["seconds"]["median"], "<")
    return Reach(run["seconds"]["median"] * error / target, "~")


def _series(runs: list[dict], scene: str, mode: str, measure: str) -> list[tuple[float, float]]:
    return [
        (run["seconds"]["median"], run[measure])
        for run in runs
        if run["scene"] == scene and run["mode"] == mode
        if run["seconds"]["median"] and run[measure] is not None
    ]


def _reference_noise(results: Results, scene: str, scale: Scale) -> Optional[float]:
    """relMSE of the walk's reference frames: that of the still's reference, by their samples."""
    for _, result in results.of("error against time", scene=scene):
        for entry in entries(result.output, "scenes"):
            noise = figure(entry, "reference", "noise", "sum", "relmse")
            samples = figure(entry, "reference", "samples")
            if noise is not None and samples:
                return noise * samples / scale.walk_reference_samples
    return None


def _equal_error(
    runs: list[dict], scene: str, frame_time: float, known_noise: Optional[float]
) -> dict:
    """What the others need to reach the error of rc+lv with that frame time."""
    path = find_run(runs, scene, "path", frame_time)
    ours = find_run(runs, scene, "rc+lv", frame_time)
    if ours is None or ours["median_relmse"] is None:
        return {}
    own = ours["seconds"]["median"]
    noise = known_noise or 0.0
    target = max(0.0, ours["median_relmse"] - noise)
    curve = [(t, max(0.0, e - noise)) for t, e in _series(runs, scene, "rc", "median_relmse")]
    by_flip = Reach(None)
    if ours["median_flip"] is not None:
        by_flip = time_to_reach(_series(runs, scene, "rc", "median_flip"), ours["median_flip"])
    return {
        "frame_time_ms": frame_time,
        "rc_lv_seconds": own,
        "rc_lv_relmse": ours["median_relmse"],
        "rc_lv_flip": ours["median_flip"],
        "reference_noise": known_noise,
        "noisy": ours["median_relmse"] < LEAST_OVER_NOISE * noise,
        "path": _reach_json(_reach_by_samples(path, noise, target), own),
        "rc": _reach_json(time_to_reach(curve, target), own),
        "rc_by_flip": _reach_json(by_flip, own),
    }


def _equal_time(runs: list[dict], scene: str, scale: Scale) -> dict:
    rc = find_run(runs, scene, "rc", scale.frame_time)
    ours = find_run(runs, scene, "rc+lv", scale.frame_time)
    if rc is None or ours is None:
        return {}
    of_a_pixel = [ratio(run["seconds"]["median"], run["median_traced"]) for run in (rc, ours)]
    saved = ratio(of_a_pixel[1], of_a_pixel[0])
    return {
        "relmse_rc_over_rc_lv": ratio(rc["median_relmse"], ours["median_relmse"]),
        "flip_rc_over_rc_lv": ratio(rc["median_flip"], ours["median_flip"]),
        "gain_a_traced_pixel": 1.0 - saved if saved is not None else None,
    }


def figures(results: Results, scale: Scale) -> dict:
    runs = walk_runs(results)
    scenes = []
    for scene in scenes_of(results):
        noise = _reference_noise(results, scene, scale)
        equal = [_equal_error(runs, scene, time, noise) for time in scale.frame_times]
        rows = []
        for mode in WALK_MODES:
            run = find_run(runs, scene, mode, scale.frame_time)
            rows.append(_row(run, scene, mode, scale.width * scale.height))
        curves = {}
        for mode in WALK_MODES:
            mine = [r for r in runs if r["scene"] == scene and r["mode"] == mode]
            curves[mode] = [
                {
                    "frame_time_ms": run["frame_time_ms"],
                    "median_seconds": run["seconds"]["median"],
                    "median_relmse": run["median_relmse"],
                    "median_flip": run["median_flip"],
                }
                for run in mine
            ]
        scenes.append(
            {
                "scene": scene,
                "rows": rows,
                "paper_gain": paper.GAINS.get(scene),
                "equal_time": _equal_time(runs, scene, scale),
                "equal_error": equal[scale.frame_times.index(scale.frame_time)],
                "equal_error_by_frame_time": [entry for entry in equal if entry],
                "curves": curves,
            }
        )
    return {
        "frame_time_ms": scale.frame_time,
        "frames": scale.frames,
        "size": f"{scale.width}x{scale.height}",
        "paper": {"machine": paper.MACHINE, "size": paper.SIZE, "traced_share": paper.TRACED_SHARE},
        "scenes": scenes,
        "unfinished": results.unfinished("walk"),
    }


def reach_text(reach: Optional[dict]) -> str:
    return reach["mark"] + seconds(reach["seconds"]) if reach else seconds(None)


def gain_text(reach: Optional[dict]) -> str:
    """More than so much time saved, where the other needs more than so much."""
    return reach["mark"] + percent(reach["gain"]) if reach else percent(None)


def _beside(content: dict) -> Html:
    rows = []
    for scene in content["scenes"]:
        for row in scene["rows"]:
            rows.append(
                [
                    scene["scene"],
                    row["mode"],
                    row["paper"]["name"] or "",
                    seconds(row["paper"]["first_seconds"]),
                    seconds(row["paper"]["following_seconds"]),
                    seconds(row.get("first_seconds")),
                    seconds(row.get("median_seconds")),
                    percent(row.get("traced_share")),
                    seconds(row.get("seconds_per_traced")),
                    number(row.get("median_relmse")),
                    number(row.get("median_flip")),
                ]
            )
    headers = ["scene", "mode", "in the paper", "paper: first", "following", "ours: first"]
    headers += ["following (median)", "pixels traced", "a traced pixel", "relMSE", "FLIP mean"]
    caption = "Time a frame; ours for rc and rc+lv with a frame time of "
    caption += f"{content['frame_time_ms']:g} ms"
    return table(headers, rows, caption, words=3)


def _gains(content: dict) -> Html:
    rows = []
    for scene in content["scenes"]:
        equal, error = scene["equal_time"], scene["equal_error"]
        rows.append(
            [
                scene["scene"],
                percent(scene["paper_gain"]),
                gain_text(error.get("rc")) + (" (noisy)" if error.get("noisy") else ""),
                gain_text(error.get("rc_by_flip")),
                percent(equal.get("gain_a_traced_pixel")),
                number(equal.get("relmse_rc_over_rc_lv")),
                number(equal.get("flip_rc_over_rc_lv")),
            ]
        )
    headers = ["scene", "paper's gain", "ours at equal relMSE", "ours at equal FLIP"]
    headers += ["a traced pixel", "relMSE of rc / rc+lv", "FLIP of rc / rc+lv"]
    return table(headers, rows, "Time that light vectors save over rc; errors at equal frame time")


def _needed(content: dict) -> Html:
    rows = []
    for scene in content["scenes"]:
        for error in scene["equal_error_by_frame_time"]:
            rows.append(
                [
                    scene["scene"],
                    f"{error['frame_time_ms']:g} ms",
                    number(error["rc_lv_relmse"]) + (" (noisy)" if error["noisy"] else ""),
                    number(error["reference_noise"]),
                    number(error["rc_lv_flip"]),
                    seconds(error["rc_lv_seconds"]),
                    reach_text(error["rc"]),
                    reach_text(error["rc_by_flip"]),
                    reach_text(error["path"]),
                ]
            )
    headers = ["scene", "frame time asked", "relMSE of rc+lv", "reference's noise", "FLIP of rc+lv"]
    headers += ["rc+lv", "rc", "rc, by FLIP", "path"]
    caption = "Frame time that is needed to reach the error of rc+lv"
    return table(headers, rows, caption, words=2)


def _curves(content: dict) -> Html:
    drawn = []
    for scene in content["scenes"]:
        for measure, name in (("median_relmse", "relMSE"), ("median_flip", "FLIP mean")):
            lines = []
            for color, mode in enumerate(WALK_MODES):
                points = [
                    (1e3 * p["median_seconds"], p[measure])
                    for p in scene["curves"][mode]
                    if p["median_seconds"]
                ]
                lines.append(Line(mode, points, color))
            noise = scene["equal_error"].get("reference_noise")
            levels = [Level("reference's noise", noise)] if noise and name == "relMSE" else []
            title = f"{scene['scene']}, {name}"
            x_name, even = "frame time (median), ms", name == "FLIP mean"
            drawn.append(plot(title, x_name, name, lines, levels, y_logarithmic=not even))
    return row_of(drawn)


def show(content: dict, folder: Path) -> Html:
    of_paper = content["paper"]
    return joined(
        [
            show_unfinished(content["unfinished"]),
            paragraph(
                f"The paper: {of_paper['size']}, {of_paper['machine']}; its render cache traced "
                f"{percent(of_paper['traced_share'])} of the pixels anew in each frame, and its "
                f"gains are of the time of following images over the render cache alone. Ours: "
                f"{content['size']}, {content['frames']} frames. Here the time of a frame is set "
                "and the error is what comes out, so that times compare only at equal error."
            ),
            _beside(content),
            _gains(content),
            paragraph(
                "A traced pixel: the frame's time by the pixels that it traces anew; in the paper "
                "both methods traced the same share. Errors are compared with the reference's "
                "noise taken off, which is estimated from that of the reference above by its "
                f"samples; noisy: the error is less than {LEAST_OVER_NOISE:g} times that noise. "
                "> : not reached in the longest frame time tried. < : reached in the shortest. ~ : "
                "of path, by error falling as 1/time.",
            ),
            _needed(content),
            element("h3", "Error against frame time"),
            _curves(content),
        ]
    )
