"""How near the newest revolution came to each limit of the test, as plain values."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rigapp.config.recipe import LimitRule, TestFile
from rigapp.gui.data.channels import SIZE, words
from rigapp.gui.data.news import News
from rigapp.gui.data.texts import unit_text
from rigapp.schema.loglines import newest_limits

DRIVE_OFF = "drive off"


@dataclass(frozen=True, slots=True)
class Margin:
    """A quantity beside its limit.

    below: the limit is passed downwards. action: what happens then.
    """

    title: str
    value: float
    limit: float
    unit: str
    action: str
    below: bool = False

    @property
    def passed(self) -> bool:
        """Tell whether the limit is passed."""
        return self.value < self.limit if self.below else self.value > self.limit

    @property
    def used(self) -> float:
        """Return how much of the way to the limit is used, 0 .. 1; 1 at the limit and beyond."""
        if self.passed:
            return 1.0
        near, far = (self.limit, self.value) if self.below else (self.value, self.limit)
        return min(1.0, max(0.0, near / far)) if far > 0.0 else 0.0

    @property
    def text(self) -> str:
        """Return value, limit and what happens, e.g. ``87.1 of 95 N, warn``."""
        side = "at least" if self.below else "of"
        unit = f" {self.unit}" if self.unit else ""
        return f"{self.value:.4g} {side} {self.limit:.4g}{unit}, {self.action}"


def margins(news: News) -> list[Margin]:
    """Return the limits that the newest revolution can be judged by, in the order of the test."""
    test = news.recipe
    if test is None:
        return []
    changed = newest_limits(news.events)
    found = [one for rule in test.limits.rule for one in _of_rule(rule, news, changed)]
    return [one for one in (*_always(test, news, changed), *found) if math.isfinite(one.value)]


def overload_limit(news: News) -> float:
    """Return the force (N) at which the drive is switched off, NaN where no test is known."""
    test = news.recipe
    return math.nan if test is None else _overload(test, newest_limits(news.events))


def _overload(test: TestFile, changed: Mapping[str, float]) -> float:
    return changed.get("overload_N", test.limits.overload_N)


def _always(test: TestFile, news: News, changed: Mapping[str, float]) -> Iterator[Margin]:
    limits = test.limits
    overload = _overload(test, changed)
    yield Margin("|F|, any sample", _newest(news, f"{SIZE}_max"), overload, "N", DRIVE_OFF)
    overspeed = changed.get("overspeed_rpm", limits.overspeed_rpm)
    yield Margin("Speed", _newest(news, "speed_max"), overspeed, "rpm", DRIVE_OFF)
    if test.stop.wear_depth_um is not None:
        depth = 1e3 * _newest(news, "measured_wear_depth")
        yield Margin("Wear depth", depth, test.stop.wear_depth_um, "µm", "complete")


def _of_rule(rule: LimitRule, news: News, changed: Mapping[str, float]) -> Iterator[Margin]:
    """Return the next level above and the next below."""
    value = _newest(news, rule.quantity)
    unit = unit_text(news.data.channels.units.get(rule.quantity, "1"))
    for side in ("above", "below"):
        levels = {
            level: changed.get(f"{rule.quantity}.{level}_{side}", getattr(rule, f"{level}_{side}"))
            for level in ("warning", "critical")
        }
        for level, limit in levels.items():
            if limit is None:
                continue
            action = str(getattr(rule, f"action_{level}")).replace("_", " ")
            title = words(rule.quantity).capitalize()
            one = Margin(title, value, limit, unit, action, side == "below")
            if level == "critical" or levels["critical"] is None or not one.passed:
                yield one
                break


def _newest(news: News, column: str) -> float:
    for table in (news.data.rows, news.data.predictions):
        if column in table.names:
            return table.last(column)
    return math.nan
