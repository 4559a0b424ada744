"""HTML: text is escaped, what is HTML already is of type Html; the page needs no other file."""

from __future__ import annotations

import base64
import html
from pathlib import Path
from typing import Iterable, Optional, Sequence, Union

MISSING = "—"


class Html(str):
    """Text that is HTML; it is not escaped again."""


Text = Union[str, Html]


def escaped(text: Text) -> Html:
    return text if isinstance(text, Html) else Html(html.escape(text))


def element(tag: str, *content: Text, **attributes: str) -> Html:
    """`class_` makes `class`, `stroke_width` makes `stroke-width`."""
    words = "".join(
        f' {name.rstrip("_").replace("_", "-")}="{html.escape(value)}"'
        for name, value in attributes.items()
    )
    inner = "".join(escaped(part) for part in content)
    return Html(f"<{tag}{words}>{inner}</{tag}>" if content else f"<{tag}{words}/>")


def joined(parts: Iterable[Text]) -> Html:
    return Html("\n".join(escaped(part) for part in parts))


def paragraph(*content: Text) -> Html:
    return element("p", *content)


def table(
    headers: Sequence[Text], rows: Iterable[Sequence[Text]], caption: Text = "", words: int = 1
) -> Html:
    """The first `words` columns hold words, the others figures."""
    lines = []
    if headers:
        lines.append(element("tr", *(element("th", header, scope="col") for header in headers)))
    for row in rows:
        cells = (
            element("td", cell, **({} if i < words else {"class_": "figure"}))
            for i, cell in enumerate(row)
        )
        lines.append(element("tr", *cells))
    body = joined([*([element("caption", caption)] if caption else []), *lines])
    return element("div", element("table", body), class_="wide")


def picture(path: Path, caption: Text, alt: str) -> Html:
    """The file itself, within the page."""
    try:
        data = base64.b64encode(path.read_bytes()).decode("ascii")
    except OSError:
        return element("figure", element("p", MISSING), element("figcaption", caption))
    kind = "jpeg" if path.suffix == ".jpg" else "png"
    image = element("img", src=f"data:image/{kind};base64,{data}", alt=alt)
    return element("figure", image, element("figcaption", caption))


def row_of(figures: Iterable[Html]) -> Html:
    return element("div", joined(figures), class_="row")


def number(value: Optional[float], digits: int = 3) -> str:
    """With so many digits that count."""
    if value is None:
        return MISSING
    if value == 0.0:
        return "0"
    if abs(value) >= 10.0 ** (digits - 1):
        return f"{value:,.0f}"
    if abs(value) < 1e-3:
        return f"{value:.{digits - 1}e}"
    text = f"{value:.{digits}g}"
    return text if "e" not in text else f"{value:.{digits}f}"


def whole(value: Optional[float]) -> str:
    return MISSING if value is None else f"{value:,.0f}"


def percent(share: Optional[float]) -> str:
    return MISSING if share is None else f"{100.0 * share:.0f}%"


def seconds(value: Optional[float]) -> str:
    if value is None:
        return MISSING
    for unit, name in ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs")):
        if abs(value) >= unit or name == "µs":
            return f"{number(value / unit)} {name}"
    return MISSING


def size(count: Optional[float]) -> str:
    if count is None:
        return MISSING
    for unit, name in ((2.0**30, "GiB"), (2.0**20, "MiB"), (2.0**10, "KiB")):
        if count >= unit:
            return f"{number(count / unit)} {name}"
    return f"{count:.0f} B"


STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; color: #1b1b1b; background: #fff; margin: 2em auto;
  max-width: 1180px; padding: 0 1em; }
h1 { font-size: 1.7em; } h2 { margin-top: 2.2em; border-bottom: 1px solid #ccc; }
h3 { margin-bottom: .3em; }
nav a { margin-right: 1em; }
table { border-collapse: collapse; margin: .6em 0; font-size: .92em; }
caption { text-align: left; font-weight: 600; padding: .3em 0; }
th { text-align: left; vertical-align: bottom; border-bottom: 2px solid #888; }
th, td { padding: .2em .8em .2em 0; }
td { border-bottom: 1px solid #e4e4e4; vertical-align: top; }
td.figure { font-variant-numeric: tabular-nums; white-space: nowrap; }
.wide { overflow-x: auto; }
.row { display: flex; flex-wrap: wrap; gap: 1em; align-items: flex-start; }
figure { margin: 0; max-width: 280px; } figure img { width: 100%; }
figcaption { font-size: .85em; }
.failed { background: #fdeaea; border-left: 4px solid #c22; padding: .5em .8em; margin: .6em 0; }
.note { color: #555; font-size: .92em; }
code { font-size: .85em; overflow-wrap: anywhere; }
svg { max-width: 100%; height: auto; }
svg text { font: 11px system-ui, sans-serif; fill: #333; } svg .title { font-weight: 600; }
"""


def page(title: str, sections: Sequence[tuple[str, str, Html]]) -> str:
    """Of sections: anchor, heading, content."""
    links = [element("a", heading, href=f"#{anchor}") for anchor, heading, _ in sections]
    parts = [element("h1", title), element("nav", joined(links))]
    for anchor, heading, content in sections:
        parts.append(element("section", element("h2", heading), content, id=anchor))
    head = joined(
        [
            Html('<meta charset="utf-8"/>'),
            Html('<meta name="viewport" content="width=device-width, initial-scale=1"/>'),
            element("title", title),
            element("style", Html(STYLE)),
        ]
    )
    body = element("html", element("head", head), element("body", joined(parts)), lang="en")
    return f"<!DOCTYPE html>\n{body}\n"
