"""The limits of a test as lines of a plot that shows some of its columns."""

from __future__ import annotations

from collections.abc import Collection

from rigapp.gui.plots.marks import LimitLine
from rigapp.viewer.margins import watched
from rigapp.viewer.news import News
from rigapp.viewer.shown import level_of_limit


def alarm_token(news: News) -> tuple[tuple[str, str], ...]:
    """Return what the colours of limits depend on: a plot is drawn anew when it changes."""
    alarms = news.status.alarms if news.status is not None else ()
    return tuple((one.key, one.state) for one in alarms)


def limit_lines(news: News, columns: Collection[str]) -> tuple[LimitLine, ...]:
    """Return the limits of columns as lines of a plot, each coloured by its alarm alone."""
    alarms = news.status.alarms if news.status is not None else ()
    return tuple(
        LimitLine(one.limit, one.words, one.below, level_of_limit(alarms, one.key))
        for one in watched(news)
        if one.column in columns
    )
