"""Error of each term against time, and the time to a target."""

from __future__ import annotations

from pathlib import Path

from ..markup import MISSING, Html, element, joined, number, paragraph, row_of, size, table, whole
from ..plots import Level, Line, plot
from ..results import Results, entries, figure, get, show_unfinished
from ..scale import Scale

LAYERS = ("sum", "emitted", "specular", "direct", "indirect", "caustic")
TARGETED = ("sum", "indirect")  # whose time to the target bench_error tells
COST_MARKS = {"at most": "<", "extrapolated": "~"}


def _render(content: dict) -> dict:
    names = ("wall_seconds", "core_seconds", "samples_per_pixel", "records", "cache_bytes")
    errors = {}
    for layer in LAYERS:
        errors[layer] = {
            "relmse": figure(content, "errors", layer, "relmse"),
            "rmse": figure(content, "errors", layer, "rmse"),
            "below_noise": bool(get(content, "errors", layer, "below_noise")),
        }
    return {**{name: figure(content, name) for name in names}, "errors": errors}


def _cost(content: dict, layer: str) -> dict:
    return {
        "kind": get(content, "to_target", layer, "kind"),
        "core_seconds": figure(content, "to_target", layer, "core_seconds"),
        "path_over_this": figure(content, "to_target", layer, "path_over_this"),
    }


def figures(results: Results, scale: Scale) -> dict:
    scenes = []
    for step, result in results.of("error against time"):
        for scene in entries(result.output, "scenes"):
            methods = [
                {
                    "method": str(get(method, "method")),
                    "not_available": get(method, "not_available"),
                    "renders": [_render(render) for render in entries(method, "renders")],
                    "to_target": {layer: _cost(method, layer) for layer in TARGETED},
                }
                for method in entries(scene, "methods")
            ]
            noise = ("reference", "noise")
            scenes.append(
                {
                    "scene": step.tags["scene"],
                    "target": figure(scene, "target"),
                    "reference_samples": figure(scene, "reference", "samples"),
                    "reference_noise": {
                        layer: figure(scene, *noise, layer, "relmse") for layer in LAYERS
                    },
                    "methods": methods,
                }
            )
    return {"scenes": scenes, "unfinished": results.unfinished("error against time")}


def cost_text(cost: dict) -> str:
    if cost["core_seconds"] is None:
        return MISSING
    return COST_MARKS.get(cost["kind"], "") + number(cost["core_seconds"])


def ratio_text(path: dict, own: dict) -> str:
    """Of the path tracer's cost to one's own, with the marks that the two bring with them."""
    kinds = [path["kind"], own["kind"]]
    if own["path_over_this"] is None or kinds == ["at most", "at most"]:
        return MISSING
    mark = ">" if kinds[1] == "at most" else ""
    mark += "<" if kinds[0] == "at most" else ""
    mark += "~" if "extrapolated" in kinds else ""
    return mark + number(own["path_over_this"])


def find_method(methods: list[dict], name: str) -> dict:
    nothing = {layer: _cost({}, layer) for layer in TARGETED}
    found = (method["to_target"] for method in methods if method["method"] == name)
    return next(found, nothing)


def _plots(scene: dict) -> Html:
    drawn = []
    for layer in LAYERS:
        lines = []
        for color, method in enumerate(scene["methods"]):
            renders = [r for r in method["renders"] if r["core_seconds"]]
            points = [(r["core_seconds"], r["errors"][layer]["relmse"]) for r in renders]
            hollow = [r["errors"][layer]["below_noise"] for r in renders]
            lines.append(Line(method["method"], points, color, hollow))
        if not any(y for line in lines for _, y in line.points):
            continue  # the scene has none of this light
        levels = []
        if layer in TARGETED and scene["target"] is not None:
            levels.append(Level("target", scene["target"]))
        if scene["reference_noise"][layer]:
            levels.append(Level("reference's noise", scene["reference_noise"][layer]))
        title = f"{scene['scene']}, {'sum of all terms' if layer == 'sum' else layer}"
        drawn.append(plot(title, "core-seconds", "relMSE", lines, levels))
    return row_of(drawn)


def _targets(scene: dict) -> Html:
    rows = []
    path = find_method(scene["methods"], "path")
    for method in scene["methods"]:
        is_path = method["method"] == "path"
        cells = [method["method"] + (" (not available)" if method["not_available"] else "")]
        for layer in TARGETED:
            cost = method["to_target"][layer]
            cells += [cost_text(cost), "1" if is_path else ratio_text(path[layer], cost)]
        last = method["renders"][-1] if method["renders"] else {}
        cells += [number(last.get("samples_per_pixel")), whole(last.get("records"))]
        rows.append([*cells, size(last.get("cache_bytes"))])
    headers = ["method", "sum", "path / this", "indirect", "path / this"]
    headers += ["samples a pixel at last", "records", "cache"]
    return table(headers, rows, f"Core-seconds to a relMSE of {number(scene['target'], 2)}")


def _renders(scene: dict) -> Html:
    rows = []
    for method in scene["methods"]:
        for render in method["renders"]:
            cells = [method["method"], number(render["core_seconds"])]
            cells.append(number(render["samples_per_pixel"]))
            for layer in LAYERS:
                error = render["errors"][layer]
                cells.append(number(error["relmse"]) + ("*" if error["below_noise"] else ""))
            rows.append(cells)
    noise = [number(scene["reference_noise"][layer]) for layer in LAYERS]
    rows.append(["reference's noise", "", number(scene["reference_samples"]), *noise])
    shown = table(["method", "core s", "samples", *LAYERS], rows, "relMSE of every render")
    return element("details", element("summary", "All figures"), shown)


def show(content: dict, folder: Path) -> Html:
    parts = [
        show_unfinished(content["unfinished"]),
        paragraph(
            "Each point is a render that started anew and stopped after its time; its error is "
            "against a path-traced reference, whose own noise is taken off. Hollow points, and "
            "figures with *, lie below that noise. < is a cost that is at most so much, ~ one that "
            "is extrapolated by 1/time from the last render."
        ),
    ]
    for scene in content["scenes"]:
        parts.append(element("h3", scene["scene"]))
        parts += [_plots(scene), _targets(scene), _renders(scene)]
    return joined(parts)
