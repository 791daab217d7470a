"""Format a rig as fragments of HTML, the same for every open page.

A fragment is the inside of one element; the page inserts it unchanged. Words come from engines and
files, so the templates escape every one of them; only ``plots`` makes elements.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined

from rigapp.page.plots import Plot
from rigapp.page.view import RigView
from rigapp.presentation.numbers import grouped
from rigapp.presentation.times import dated, duration
from rigapp.presentation.tokens import DARK, LIGHT, Theme
from rigapp.schema.details import details_of, sentence_of
from rigapp.schema.wire import json_bytes

RESTART_SHOWN_S = 600.0
"""Time during which the page shows that the engine was restarted."""
PARTS = ("head", "force", "trends", "log")
"""The fragments of a rig, in their order."""


@cache
def _templates() -> Environment:
    result = Environment(
        loader=PackageLoader("rigapp.page", "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    result.filters["clock"] = lambda at: dated("%d %b %H:%M:%S", time.localtime(at))
    result.filters["grouped"] = grouped
    result.filters["sentence"] = sentence_of
    result.filters["details"] = details_of
    result.filters["duration"] = duration
    return result


def head(view: RigView, now: float) -> str:
    """Return state, tiles and limits of a rig; now: UTC seconds since 1970."""
    fresh_start = view.restarts > 0 and now - view.restarted_at < RESTART_SHOWN_S
    return _templates().get_template("head.html").render(view=view, fresh_start=fresh_start)


def log(view: RigView) -> str:
    """Return the active alarms and the last notes."""
    return _templates().get_template("log.html").render(view=view)


def pictures(plots: Sequence[Plot | None]) -> str:
    """Return plots with their titles and legends; None: without data yet."""
    return _templates().get_template("plots.html").render(plots=[plot for plot in plots if plot])


def page(rigs: Mapping[str, Mapping[str, str]], boot: str) -> str:
    """Return the whole page: by rig the fragments as they are now; boot: of this server."""
    return _templates().get_template("page.html").render(rigs=rigs, boot=boot, parts=PARTS)


def style(sheet: str) -> str:
    """Return the style sheet with the colours of the window, light and dark."""
    light, dark = _variables(LIGHT), _variables(DARK)
    return (
        f":root{{color-scheme:light;{light}}}\n"
        f"@media (prefers-color-scheme:dark){{:root{{color-scheme:dark;{dark}}}}}\n"
        f":root[data-theme=light]{{color-scheme:light;{light}}}\n"
        f":root[data-theme=dark]{{color-scheme:dark;{dark}}}\n{sheet}"
    )


def _variables(theme: Theme) -> str:
    colours: dict[str, Any] = {
        name: value for name in theme.__slots__ if isinstance(value := getattr(theme, name), str)
    }
    colours |= {f"curve-{role}": colour for role, colour in theme.curves.items()}
    del colours["name"]
    return "".join(f"--{name.replace('_', '-')}:{value};" for name, value in colours.items())


def frame(event: str, data: Any) -> bytes:
    """Return one server-sent event."""
    return b"event: %s\ndata: %s\n\n" % (event.encode(), json_bytes(data))
