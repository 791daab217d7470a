"""The limits of a test as lines of a plot that shows some of its columns."""

from __future__ import annotations

from collections.abc import Collection

from rigapp.gui.data.margins import newest, watched
from rigapp.gui.data.news import News
from rigapp.gui.plots.marks import LimitLine


def limit_lines(
    news: News, columns: Collection[str], shown: float | None = None
) -> tuple[LimitLine, ...]:
    """Return the limits of columns as lines of a plot.

    shown: the value that they are judged by, that of the newest revolution unless told.
    """
    found = []
    for one in watched(news):
        if one.column in columns:
            margin = one.margin(newest(news, one.column) * one.scale if shown is None else shown)
            found.append(LimitLine(one.limit, one.words, one.below, margin.passed))
    return tuple(found)
