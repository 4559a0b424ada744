"""Curves as SVG, with logarithmic or even axes."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, floor, log10
from typing import Callable, Optional, Sequence

from .markup import Html, element, joined, number, paragraph

# Told apart by those who do not see all colours (Okabe and Ito), and by shape in print.
COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")
DASHES = ("", "7 3", "2 3", "9 3 2 3", "4 2", "12 3")

WIDTH, HEIGHT = 400, 300
LEFT, RIGHT, TOP, BOTTOM = 58, 12, 26, 40
LEGEND_LINE = 16
LABEL_ROOM = 24  # above a level, if its name is to stand there

# Of a triangle and of a lozenge: the third and the fourth marker.
CORNERS = {2: ((0, -4), (4, 3), (-4, 3)), 3: ((0, -4.5), (4.5, 0), (0, 4.5), (-4.5, 0))}

# Of ticks on a logarithmic axis: the first that give so many.
MANTISSAS = ((1.0,), (1.0, 2.0, 5.0), (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0))
LEAST_TICKS = 3


@dataclass(frozen=True)
class Line:
    name: str
    points: Sequence[tuple[float, Optional[float]]]
    color: int = 0
    hollow: Sequence[bool] = ()  # points that say less than they seem to


@dataclass(frozen=True)
class Level:
    """A straight line across, with its name beside it."""

    name: str
    value: float


@dataclass(frozen=True)
class Axis:
    name: str
    logarithmic: bool
    first: float
    last: float

    def share(self, value: float) -> float:
        if self.logarithmic:
            return log10(value / self.first) / log10(self.last / self.first)
        return (value - self.first) / (self.last - self.first)

    def ticks(self) -> list[float]:
        if not self.logarithmic:
            step = _even_step(self.last - self.first)
            start = ceil(self.first / step - 1e-9)
            count = floor((self.last - self.first) / step + 1e-9) + 1
            values = [(start + i) * step for i in range(count)]
            return [value for value in values if value <= self.last * (1.0 + 1e-9)]
        low, high = floor(log10(self.first)), ceil(log10(self.last))
        every = 1 + (high - low) // 8
        ticks: list[float] = []
        for mantissas in MANTISSAS:
            values = [m * 10.0**e for e in range(low, high + 1, every) for m in mantissas]
            ticks = [v for v in values if self.first * 0.999 <= v <= self.last * 1.001]
            if len(ticks) >= LEAST_TICKS:
                break
        return ticks


def _even_step(span: float) -> float:
    power = 10.0 ** floor(log10(span / 5.0))
    return next(power * m for m in (1.0, 2.0, 5.0, 10.0) if power * m >= span / 5.0 * 0.999)


def _tick(value: float) -> str:
    return f"{value:,.0f}" if abs(value) >= 1000.0 else f"{value:g}"


def _axis(name: str, logarithmic: bool, values: Sequence[float]) -> Axis:
    low, high = min(values), max(values)
    if logarithmic:
        room = 1.15 if high > low else 2.0
        return Axis(name, True, low / room, high * room)
    if low >= 0.0 and low < 0.5 * high:
        low = 0.0
    if high <= low:
        return Axis(name, False, low, low + 1.0)
    room = 0.06 * (high - low)
    return Axis(name, False, low - room if low > 0.0 else low, high + room)


def _marker(x: float, y: float, index: int, hollow: bool, title: str) -> Html:
    color = COLORS[index % len(COLORS)]
    paint = {"fill": "#fff" if hollow else color, "stroke": color, "stroke_width": "1.5"}
    label = element("title", title)
    if index % 4 == 1:
        box = {"x": f"{x - 3:.1f}", "y": f"{y - 3:.1f}", "width": "6", "height": "6"}
        return element("rect", label, **box, **paint)
    if index % 4 >= 2:
        places = " ".join(f"{x + dx:.1f},{y + dy:.1f}" for dx, dy in CORNERS[index % 4])
        return element("polygon", label, points=places, **paint)
    return element("circle", label, cx=f"{x:.1f}", cy=f"{y:.1f}", r="3.2", **paint)


def _straight(x1: float, y1: float, x2: float, y2: float, **paint: str) -> Html:
    places = {"x1": f"{x1:.1f}", "y1": f"{y1:.1f}", "x2": f"{x2:.1f}", "y2": f"{y2:.1f}"}
    return element("line", **places, **paint)


def _text(x: float, y: float, text: str, anchor: str = "start", **more: str) -> Html:
    return element("text", text, x=f"{x:.1f}", y=f"{y:.1f}", text_anchor=anchor, **more)


def _frame(x_axis: Axis, y_axis: Axis, at: Callable[[float, float], tuple[float, float]]) -> list:
    right, bottom = WIDTH - RIGHT, HEIGHT - BOTTOM
    parts = []
    for value in x_axis.ticks():
        x, _ = at(value, y_axis.first)
        parts.append(_straight(x, TOP, x, bottom, stroke="#e8e8e8"))
        parts.append(_text(x, bottom + 14, _tick(value), "middle"))
    for value in y_axis.ticks():
        _, y = at(x_axis.first, value)
        parts.append(_straight(LEFT, y, right, y, stroke="#e8e8e8"))
        parts.append(_text(LEFT - 5, y + 4, _tick(value), "end"))
    box = {"x": str(LEFT), "y": str(TOP), "width": str(right - LEFT), "height": str(bottom - TOP)}
    parts.append(element("rect", **box, fill="none", stroke="#888"))
    parts.append(_text((LEFT + right) / 2, HEIGHT - 8, x_axis.name, "middle"))
    middle = (TOP + bottom) / 2
    turn = f"rotate(-90 12 {middle:.1f})"
    parts.append(_text(12, middle, y_axis.name, "middle", transform=turn))
    return parts


def plot(
    title: str,
    x_name: str,
    y_name: str,
    lines: Sequence[Line],
    levels: Sequence[Level] = (),
    x_logarithmic: bool = True,
    y_logarithmic: bool = True,
) -> Html:
    """Points without a place on the axes are left out: those missing, or 0 on a logarithmic one."""

    def drawn(x: float, y: Optional[float]) -> bool:
        return y is not None and (x > 0 or not x_logarithmic) and (y > 0 or not y_logarithmic)

    shown = [[i for i, p in enumerate(line.points) if drawn(*p)] for line in lines]
    places = [line.points[i] for line, indices in zip(lines, shown) for i in indices]
    levels = [level for level in levels if drawn(1.0, level.value)]
    if not places:
        return paragraph(f"{title}: nothing to draw.")
    x_axis = _axis(x_name, x_logarithmic, [x for x, _ in places])
    y_values = [y for _, y in places if y is not None] + [level.value for level in levels]
    y_axis = _axis(y_name, y_logarithmic, y_values)
    bottom = HEIGHT - BOTTOM

    def at(x: float, y: float) -> tuple[float, float]:
        return (
            LEFT + x_axis.share(x) * (WIDTH - LEFT - RIGHT),
            bottom - y_axis.share(y) * (bottom - TOP),
        )

    parts = [_text(LEFT, 16, title, class_="title"), *_frame(x_axis, y_axis, at)]
    for i, level in enumerate(levels):
        _, y = at(x_axis.first, level.value)
        parts.append(_straight(LEFT, y, WIDTH - RIGHT, y, stroke="#777", stroke_dasharray="3 3"))
        # On either side in turn: levels may lie close together.
        x, anchor = (WIDTH - RIGHT - 4, "end") if i % 2 == 0 else (LEFT + 4, "start")
        parts.append(_text(x, y - 4 if y > TOP + LABEL_ROOM else y + 12, level.name, anchor))
    row = 0
    for line, indices in zip(lines, shown):
        color = COLORS[line.color % len(COLORS)]
        dash = {"stroke_dasharray": DASHES[line.color % len(DASHES)]} if line.color else {}
        spots = [at(x, y) for x, y in (line.points[i] for i in indices) if y is not None]
        if not spots:
            continue
        if len(spots) > 1:
            path = " ".join(f"{x:.1f},{y:.1f}" for x, y in spots)
            stroke = {"stroke": color, "stroke_width": "1.6", "fill": "none"}
            parts.append(element("polyline", points=path, **stroke, **dash))
        if len(spots) <= 24:
            for i, (x, y) in zip(indices, spots):
                hollow = i < len(line.hollow) and line.hollow[i]
                told = f"{line.name}: {number(line.points[i][0])}, {number(line.points[i][1])}"
                parts.append(_marker(x, y, line.color, hollow, told))
        y = HEIGHT + 10 + LEGEND_LINE * row
        row += 1
        parts.append(_straight(LEFT, y - 4, LEFT + 28, y - 4, stroke=color, **dash))
        parts.append(_marker(LEFT + 14, y - 4, line.color, False, line.name))
        parts.append(_text(LEFT + 36, y, line.name))
    height = HEIGHT + LEGEND_LINE * row + 4
    box = {"viewBox": f"0 0 {WIDTH} {height}", "width": str(WIDTH), "height": str(height)}
    return element("svg", joined(parts), role="img", **box)
