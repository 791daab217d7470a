"""Rules of a test: levels of a quantity of the revolution, with hysteresis and delay."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TypeGuard

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.recipe import Action, LimitRule, LimitsSection
from rigapp.config.rules import ALWAYS, BOUNDS, check_rules, limit_refusal
from rigapp.engine.samples import slow
from rigapp.schema.alarms import Cause, exceeded, without_value
from rigapp.schema.channels import ChannelTable
from rigapp.schema.messages import Severity
from rigapp.texts import joined, say


@dataclass(frozen=True, slots=True)
class LevelPassed:
    """An exceeded level (``active``), or the return of its value."""

    cause: Cause
    active: bool
    action: Action


@dataclass(slots=True)
class _Watch:
    """One level of one rule. steps: of the test, in which it is evaluated; empty: all."""

    quantity: str
    severity: Severity
    above: bool
    limit: float
    hysteresis: float
    delay: int
    action: Action
    steps: frozenset[int] = frozenset()
    beyond: int = 0
    active: bool = False
    missing: bool = False
    since_s: float | None = None

    def known(self, value: float | None) -> TypeGuard[float]:
        """Return whether a value can be evaluated: finite, or infinite beyond the level."""
        return value is not None and (
            math.isfinite(value) or value == (math.inf if self.above else -math.inf)
        )

    def without_value_s(self, values: Mapping[str, float]) -> float | None:
        """Return the time without a value, s; None with a complete one.

        The mean of a revolution is NaN if one of its samples is.
        """
        value = values[self.quantity]
        mean = values.get(f"{self.quantity.rpartition('_')[0]}_mean", 0.0)
        if self.known(value) and math.isfinite(mean):
            self.since_s = None
            return None
        age_s = values.get(f"{self.quantity}_age")  # of a slow channel
        if age_s is not None:
            return age_s
        time_s = values.get("time", math.nan)
        self.since_s = time_s if self.since_s is None else self.since_s
        return time_s - self.since_s

    def cause(self, value: float) -> Cause:
        """Return the alarm that a value raises or clears."""
        return exceeded(self.quantity, self.severity, value, self.limit, self.above, self.action)

    def check_missing(self, age_s: float | None) -> LevelPassed | None:
        """Return a change if the value goes missing or returns.

        age_s: of a missing value; None with a value.
        """
        missing = age_s is not None and age_s >= slow.SILENT_S
        if missing == self.missing:
            return None
        self.missing = missing
        cause = without_value(
            self.quantity, self.severity, age_s or 0.0, self.limit, self.above, self.action
        )
        return LevelPassed(cause, missing, self.action)

    def applies(self, step: int) -> bool:
        """Return whether the level is evaluated in a step of the test."""
        return not self.steps or step in self.steps

    def reset(self) -> bool | None:
        """Reset at another step; return False if the level was exceeded, else None."""
        passed, self.active, self.beyond = self.active, False, 0
        return False if passed else None

    def look(self, value: float) -> bool | None:
        """Return True if the level is exceeded after the delay, False on return, else None."""
        sign = 1 if self.above else -1
        excess = sign * (value - self.limit)
        if self.active:
            if excess < -self.hysteresis or (self.hysteresis == 0 and excess <= 0):
                self.active = False
                self.beyond = 0
                return False
            return None
        if excess > 0:
            self.beyond += 1
            if self.beyond >= self.delay:
                self.active = True
                return True
        else:
            self.beyond = 0
        return None


def _watches(rules: Iterable[LimitRule]) -> list[_Watch]:
    result: list[_Watch] = []
    for rule in rules:
        for name in BOUNDS:
            limit = getattr(rule, name)
            if limit is None:
                continue
            critical = name.startswith("critical")
            result.append(
                _Watch(
                    quantity=rule.quantity,
                    severity=Severity.CRITICAL if critical else Severity.WARNING,
                    above=name.endswith("above"),
                    limit=limit,
                    hysteresis=rule.hysteresis,
                    delay=rule.delay_revolutions,
                    action=rule.action_critical if critical else rule.action_warning,
                    steps=frozenset(rule.steps),
                )
            )
    return result


class RuleMonitor:
    """Evaluation of each revolution by the rules; for one thread."""

    def __init__(self, rules: Iterable[LimitRule], table: ChannelTable | None = None) -> None:
        self._table = table
        self._watches: list[_Watch] = []
        self.replace(rules)

    def replace(self, rules: Iterable[LimitRule]) -> None:
        """Use other rules from the next revolution on; raise UnusableInput.

        Unchanged levels keep their count of revolutions.
        """
        rules = tuple(rules)
        check_rules(rules, self._table)
        previous = {(w.quantity, w.severity, w.above, w.steps): w for w in self._watches}
        watches = _watches(rules)
        for watch in watches:
            before = previous.get((watch.quantity, watch.severity, watch.above, watch.steps))
            if before is not None:
                watch.beyond, watch.active = before.beyond, before.active
                watch.missing, watch.since_s = before.missing, before.since_s
        self.rules, self._watches = rules, watches

    def judge(self, values: Mapping[str, float], step: int = 0) -> list[LevelPassed]:
        """Return the changes of levels with these values; other quantities are skipped.

        Also a change: no value, or NaN samples, for longer than the largest age of a slow value, as
        the limit is then without effect. step: of the test in which the values were measured;
        levels of other steps are reset.
        """
        result: list[LevelPassed] = []
        for watch in self._watches:
            value = values.get(watch.quantity)
            if value is None:
                continue
            # The twin's values have no time, and are not available at the beginning.
            if "time" in values and watch.applies(step):
                missing = watch.check_missing(watch.without_value_s(values))
                if missing is not None:
                    result.append(missing)
            if not watch.known(value):
                continue
            change = watch.look(value) if watch.applies(step) else watch.reset()
            if change is not None:
                result.append(LevelPassed(watch.cause(value), change, watch.action))
        return result

    def worst_margin(self, values: Mapping[str, float], step: int = 0) -> tuple[float, str]:
        """Return the smallest distance to a level in percent of the level, and its name."""
        worst, name = math.inf, ""
        for watch in self._watches:
            value = values.get(watch.quantity)
            if value is None or math.isnan(value) or not watch.applies(step):
                continue
            sign = 1 if watch.above else -1
            margin = 100.0 * sign * (watch.limit - value) / max(abs(watch.limit), 1e-9)
            if margin < worst:
                side = "above" if watch.above else "below"
                worst, name = margin, say("{} {} {}", watch.quantity, watch.severity, side)
        return worst, name


def least_margin(
    monitor: RuleMonitor, limits: LimitsSection, values: Mapping[str, float], step: int = 0
) -> tuple[float, str]:
    """Return the least margin of an evaluated revolution to any limit, in percent, and its name.

    values: the columns of its row. Infinity and an empty name without limits.
    """
    return min(
        monitor.worst_margin(values, step),
        *(
            margin_to(getattr(limits, name), abs(values[limit.columns[0]]), limit.alarm)
            for name, limit in ALWAYS.items()
            if limit.columns
        ),
        key=lambda margin: math.inf if math.isnan(margin[0]) else margin[0],
    )


def margin_to(limit: float, value: float, name: str) -> tuple[float, str]:
    """Return the margin of a value to its upper limit in percent of the limit, with its name."""
    return 100.0 * (limit - value) / limit, name


def changed_limits(
    limits: LimitsSection, name: str, value: float, table: ChannelTable | None = None
) -> tuple[float | None, LimitsSection]:
    """Return the previous value, and the limits with one changed; raise UnusableInput."""
    quantity, _, level = name.partition(".")
    indices = [
        index
        for index, rule in enumerate(limits.rule)
        if rule.quantity == quantity and level in BOUNDS and getattr(rule, level) is not None
    ]
    if name not in ALWAYS and not indices:
        known = [
            f"{rule.quantity}.{level}"
            for rule in limits.rule
            for level in BOUNDS
            if getattr(rule, level) is not None
        ]
        raise UnusableInput(
            "there is no limit {}; there are: {}", repr(name), joined(", ", (*ALWAYS, *known))
        )
    refused = limit_refusal(name, value, table)
    if refused:
        raise UnusableInput(refused)
    if name in ALWAYS:
        return getattr(limits, name), msgspec.structs.replace(limits, **{name: value})
    index = indices[0]
    rule = limits.rule[index]
    changed = msgspec.structs.replace(rule, **{level: value})
    rules = (*limits.rule[:index], changed, *limits.rule[index + 1 :])
    return getattr(rule, level), msgspec.structs.replace(limits, rule=rules)
