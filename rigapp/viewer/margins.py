"""The margins of the newest revolution to each limit of the test, as plain values."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Final

from rigapp.config.recipe import LimitRule
from rigapp.config.rules import ALWAYS
from rigapp.presentation.numbers import unit_text
from rigapp.presentation.translation import Text, tr
from rigapp.schema.alarms import rule_key
from rigapp.schema.channels import ChannelTable
from rigapp.schema.loglines import newest_limits
from rigapp.texts import capitalised
from rigapp.viewer.levels import quantity_text
from rigapp.viewer.news import News
from rigapp.viewer.quantities import LARGEST, UM_PER_MM
from rigapp.viewer.shown import Level, level_of

DRIVE_OFF: Final[Text] = "drive off"
DEPTH = "measured_wear_depth"
COMPLETE: Final[Text] = "complete"
ACTIONS: Final[dict[str, Text]] = {
    "warn": "warn",
    "pause": "pause",
    "stop": "stop",
    "drive_off": DRIVE_OFF,
    "none": "do nothing",
}
"""The actions of a rule, in the words of a limit."""


OVERLOADS: Final = {"overload": "", "overload:beyond_range": "≥ "}
"""Alarms of a force, and the sign before its value."""


@dataclass(frozen=True, slots=True)
class WatchedLimit:
    """A limit of a column of rows or predictions, in ``unit``, which is ``scale`` of the column's.

    below: it is passed downwards. action: when it is passed. key: of its alarm, none where it ends
    a test as planned.
    """

    title: Text
    column: str
    limit: float
    unit: str
    action: Text
    below: bool = False
    scale: float = 1.0
    key: str = ""

    @property
    def words(self) -> str:
        """Return action and level, e.g. ``warn above 95 N``."""
        limit, action = f"{self.limit:.4g} {self.unit}".rstrip(), tr(self.action)
        if self.below:
            return tr("{} below {}", action, limit)
        planned = self.action == COMPLETE
        return tr("{} at {}", action, limit) if planned else tr("{} above {}", action, limit)


@dataclass(frozen=True, slots=True)
class Margin:
    """A quantity and its limit, in the unit of the limit; level: by the alarms about the quantity.

    sign: before the value.
    """

    limit: WatchedLimit
    value: float
    level: Level = Level.NORMAL
    sign: str = ""

    @property
    def passed(self) -> bool:
        """Return whether the limit is passed."""
        limit = self.limit
        return self.value < limit.limit if limit.below else self.value > limit.limit

    @property
    def used(self) -> float:
        """Return the used share of the limit, 0 .. 1; 1 at the limit and beyond."""
        if self.passed:
            return 1.0
        limit = self.limit
        near, far = (limit.limit, self.value) if limit.below else (self.value, limit.limit)
        return min(1.0, max(0.0, near / far)) if far > 0.0 else 0.0

    @property
    def text(self) -> str:
        """Return value, limit and action, e.g. ``87.1 of 95 N, warn``."""
        limit, action = f"{self.limit.limit:.4g} {self.limit.unit}".rstrip(), tr(self.limit.action)
        text = tr("{} at least {}, {}") if self.limit.below else tr("{} of {}, {}")
        return text.format(f"{self.sign}{self.value:.4g}", limit, action)

    @property
    def left(self) -> str:
        """Return the limit in words and the rest to it, e.g. ``warn above 95 N, 8 % left``.

        It is the free part of the bar, so that words and bar agree.
        """
        if self.passed:
            return tr("{}, passed", self.limit.words)
        return tr("{}, {:.0f} % left", self.limit.words, 100.0 * (1.0 - self.used))

    @property
    def short(self) -> str:
        """Return the same in few words."""
        limit = f"{self.limit.limit:.4g} {self.limit.unit}".rstrip()
        return tr("{:.0f} % to {}", 100.0 * (1.0 - self.used), limit)


def margins(news: News) -> list[Margin]:
    """Return the limits that apply to the newest revolution, in the order of the test.

    The largest |F| is that of a trip where it is larger: its revolution is unfinished.
    Of two levels on one side the next one is returned: the critical one when the other is passed.
    """
    result: dict[tuple[str, bool], Margin] = {}
    alarms = news.status.alarms if news.status is not None else ()
    for limit in watched(news):
        largest = limit.column == LARGEST
        value, sign = newest_force(news) if largest else (newest(news, limit.column), "")
        value *= limit.scale
        key = (limit.title, limit.below)
        if math.isfinite(value) and (key not in result or result[key].passed):
            result[key] = Margin(limit, value, level_of(alarms, limit.column), sign)
    return list(result.values())


def nearest_margin(news: News, column: str) -> Margin | None:
    """Return the limit of a column that is nearest to its newest value, None without one."""
    own = (margin for margin in margins(news) if margin.limit.column == column)
    return max(own, key=lambda margin: margin.used, default=None)


def watched(news: News) -> list[WatchedLimit]:
    """Return every present limit of the test, warnings before critical ones."""
    test = news.recipe
    if test is None:
        return []
    changed = newest_limits(news.events)
    limits = test.limits
    result = [
        WatchedLimit(
            limit.title,
            limit.columns[0],
            changed.get(name, getattr(limits, name)),
            limit.unit,
            DRIVE_OFF,
            key=limit.alarm,
        )
        for name, limit in ALWAYS.items()
        if limit.columns
    ]
    if test.stop.wear_depth_um is not None:
        depth = test.stop.wear_depth_um
        result.append(WatchedLimit("Wear depth", DEPTH, depth, "µm", COMPLETE, scale=UM_PER_MM))
    for rule in limits.rule:
        result += _of_rule(rule, news.data.channels, changed)
    return result


def newest_force(news: News) -> tuple[float, str]:
    """Return the largest |F| of the newest revolution, or of the trip, and the sign before it.

    The alarm comes at once, the revolution of the trip when the file is finished.
    """
    result = [(news.data.rows.last(LARGEST), "")]
    alarms = news.status.alarms if news.status is not None else ()
    result += [
        (alarm.value, OVERLOADS[alarm.key])
        for alarm in alarms
        if alarm.value is not None and alarm.key in OVERLOADS
    ]
    if news.trip is not None and news.trip.peak is not None:
        result.append((news.trip.peak.value_N, news.trip.peak.sign))
    return max((force for force in result if math.isfinite(force[0])), default=(math.nan, ""))


def overload_limit(news: News) -> float:
    """Return the force (N) at which the drive is switched off, NaN where no test is known."""
    test = news.recipe
    return (
        math.nan
        if test is None
        else newest_limits(news.events).get("overload_N", test.limits.overload_N)
    )


def _of_rule(
    rule: LimitRule, table: ChannelTable, changed: Mapping[str, float]
) -> Iterator[WatchedLimit]:
    title, unit = quantity_text(rule.quantity, table), table.units.get(rule.quantity, "1")
    title, unit = capitalised(title), unit_text(unit)
    for side in ("above", "below"):
        for level in ("warning", "critical"):
            name = f"{level}_{side}"
            limit = changed.get(f"{rule.quantity}.{name}", getattr(rule, name))
            if limit is not None:
                action = ACTIONS[str(getattr(rule, f"action_{level}"))]
                yield WatchedLimit(
                    title, rule.quantity, limit, unit, action, side == "below",
                    key=rule_key(rule.quantity, level, side),
                )  # fmt: skip


def newest(news: News, column: str) -> float:
    """Return the newest value of a column of rows or predictions, NaN where there is none."""
    for table in (news.data.rows, news.data.predictions):
        if column in table.names:
            return table.last(column)
    return math.nan
