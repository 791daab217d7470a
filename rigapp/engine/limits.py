"""The rules of a test: two levels on a quantity of the revolution, with hysteresis and delay."""

from __future__ import annotations

import difflib
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.recipe import Action, LimitRule, LimitsSection
from rigapp.engine.columns import prediction_columns, revolution_columns
from rigapp.engine.messages import Severity

_NOT_LIMITED = {"revolution", "time", "host_time"}

_MEASURED = tuple(column.name for column in revolution_columns())

QUANTITIES = tuple(
    name
    for name in dict.fromkeys((*_MEASURED, *(column.name for column in prediction_columns())))
    if name not in _NOT_LIMITED
)
"""What a rule can be about: the statistics of a revolution, and the twin's residuals and wear.

A name that both have (``force_max``) means what was measured.
"""

BOUNDS = ("critical_above", "critical_below", "warning_above", "warning_below")


def check_rules(rules: Iterable[LimitRule]) -> None:
    """Raise UnusableInput when a rule names no quantity, has no level, or contradicts itself."""
    for number, rule in enumerate(rules, start=1):
        where = f"limits.rule {number} ({rule.quantity})"
        if rule.quantity not in QUANTITIES:
            near = difflib.get_close_matches(rule.quantity, QUANTITIES, n=1, cutoff=0.0)
            raise UnusableInput(f"{where}: there is no such quantity; did you mean {near[0]}?")
        bounds = {name: getattr(rule, name) for name in BOUNDS}
        if all(value is None for value in bounds.values()):
            raise UnusableInput(f"{where}: no level is given; give one of {', '.join(BOUNDS)}")
        for name, value in bounds.items():
            if value is not None and not math.isfinite(value):
                raise UnusableInput(f"{where}: {name} = {value} is not a finite number")
        if not (math.isfinite(rule.hysteresis) and rule.hysteresis >= 0):
            raise UnusableInput(f"{where}: hysteresis = {rule.hysteresis} must be 0 or more")
        _check_order(where, "above", rule.warning_above, rule.critical_above, 1)
        _check_order(where, "below", rule.warning_below, rule.critical_below, -1)
        lows = [v for v in (rule.warning_below, rule.critical_below) if v is not None]
        highs = [v for v in (rule.warning_above, rule.critical_above) if v is not None]
        if lows and highs and max(lows) >= min(highs):
            raise UnusableInput(
                f"{where}: no value lies above {max(lows):g} and below {min(highs):g}"
            )


def _check_order(
    where: str, side: str, warning: float | None, critical: float | None, sign: int
) -> None:
    if warning is not None and critical is not None and sign * (critical - warning) <= 0:
        raise UnusableInput(
            f"{where}: critical_{side} = {critical:g} must lie beyond warning_{side} = {warning:g}"
        )


@dataclass(frozen=True, slots=True)
class Verdict:
    """Say that a level was passed (``active``) or that the value came back."""

    quantity: str
    severity: Severity
    above: bool
    value: float
    limit: float
    active: bool
    action: Action


@dataclass(slots=True)
class _Watch:
    """One level of one rule."""

    quantity: str
    severity: Severity
    above: bool
    limit: float
    hysteresis: float
    delay: int
    action: Action
    beyond: int = 0
    active: bool = False

    def look(self, value: float) -> bool | None:
        """Return True when the level is passed for good, False when the value came back."""
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
    found: list[_Watch] = []
    for rule in rules:
        for name in BOUNDS:
            limit = getattr(rule, name)
            if limit is None:
                continue
            critical = name.startswith("critical")
            found.append(
                _Watch(
                    quantity=rule.quantity,
                    severity=Severity.CRITICAL if critical else Severity.WARNING,
                    above=name.endswith("above"),
                    limit=limit,
                    hysteresis=rule.hysteresis,
                    delay=rule.delay_revolutions,
                    action=rule.action_critical if critical else rule.action_warning,
                )
            )
    return found


class RuleMonitor:
    """Judge every revolution by the rules; one thread calls it."""

    def __init__(self, rules: Iterable[LimitRule]) -> None:
        rules = tuple(rules)
        check_rules(rules)
        self.rules = rules
        self._watches = _watches(rules)

    def replace(self, rules: Iterable[LimitRule]) -> None:
        """Judge by other rules from the next revolution on; raise UnusableInput.

        What a level has seen so far stays with it.
        """
        rules = tuple(rules)
        check_rules(rules)
        former = {(w.quantity, w.severity, w.above): w for w in self._watches}
        watches = _watches(rules)
        for watch in watches:
            before = former.get((watch.quantity, watch.severity, watch.above))
            if before is not None:
                watch.beyond, watch.active = before.beyond, before.active
        self.rules, self._watches = rules, watches

    def judge(self, values: Mapping[str, float]) -> list[Verdict]:
        """Return what changed with these values; quantities that are missing or NaN are skipped."""
        found: list[Verdict] = []
        for watch in self._watches:
            value = values.get(watch.quantity)
            if value is None or math.isnan(value):
                continue
            change = watch.look(value)
            if change is not None:
                found.append(
                    Verdict(
                        watch.quantity,
                        watch.severity,
                        watch.above,
                        value,
                        watch.limit,
                        change,
                        watch.action,
                    )
                )
        return found

    def active(self) -> list[tuple[str, Severity, bool]]:
        """Return the levels that are passed at present."""
        return [(w.quantity, w.severity, w.above) for w in self._watches if w.active]

    def worst_margin(self, values: Mapping[str, float]) -> tuple[float, str]:
        """Return the smallest distance to a level in percent of the level, and its name."""
        worst, name = math.inf, ""
        for watch in self._watches:
            value = values.get(watch.quantity)
            if value is None or math.isnan(value):
                continue
            sign = 1 if watch.above else -1
            margin = 100.0 * sign * (watch.limit - value) / max(abs(watch.limit), 1e-9)
            if margin < worst:
                side = "above" if watch.above else "below"
                worst, name = margin, f"{watch.quantity} {watch.severity.value} {side}"
        return worst, name


def changed_limits(
    limits: LimitsSection, name: str, value: float
) -> tuple[float | None, LimitsSection]:
    """Return the former value and the limits with one changed; raise UnusableInput."""
    if not math.isfinite(value):
        raise UnusableInput(f"limit {name} = {value} is not a finite number")
    plain = ("overload_N", "overspeed_rpm", "stale_data_s")
    if name in plain:
        if value <= 0:
            raise UnusableInput(f"limit {name} = {value:g} must be positive")
        return getattr(limits, name), msgspec.structs.replace(limits, **{name: value})
    quantity, _, level = name.partition(".")
    for place, rule in enumerate(limits.rule):
        if rule.quantity == quantity and getattr(rule, level, None) is not None:
            before = getattr(rule, level)
            if not isinstance(before, float | int) or isinstance(before, bool):
                break
            changed = msgspec.structs.replace(rule, **{level: value})
            rules = (*limits.rule[:place], changed, *limits.rule[place + 1 :])
            return float(before), msgspec.structs.replace(limits, rule=rules)
    known = [
        f"{rule.quantity}.{level}"
        for rule in limits.rule
        for level in ("warning_above", "critical_above", "warning_below", "critical_below")
        if getattr(rule, level) is not None
    ]
    raise UnusableInput(f"there is no limit {name!r}; there are: {', '.join((*plain, *known))}")
