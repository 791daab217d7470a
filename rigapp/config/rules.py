"""The rules of ``[[limits.rule]]``: quantities and contradictions."""

from __future__ import annotations

import difflib
import functools
import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Final, NamedTuple

from rigapp.config.errors import UnusableInput
from rigapp.config.ranges import LEVELS, OTHER_LEVEL, RANGES, refusal, unit_of
from rigapp.config.recipe import LimitRule, StopSection
from rigapp.schema.channels import BASE, ChannelTable
from rigapp.schema.columns import prediction_columns
from rigapp.schema.criteria import CRITERIA
from rigapp.texts import joined, say

NAME = re.compile(r"[a-z][a-z0-9_]*")
"""Pattern of a channel's name, and so of its columns."""

_NOT_LIMITED = {"revolution", "time", "host_time"}


@functools.cache
def quantities(table: ChannelTable) -> dict[str, str]:
    """Return the quantities for rules, with units: statistics of a revolution, the twin's wear.

    A common name (``force_max``) means the measured quantity.
    """
    columns = (*prediction_columns(), *table.revolution_columns)
    return {column.name: column.unit for column in columns if column.name not in _NOT_LIMITED}


BOUNDS = ("critical_above", "critical_below", "warning_above", "warning_below")


def check_rules(
    rules: Iterable[LimitRule], table: ChannelTable | None = None, where: str = ""
) -> None:
    """Raise UnusableInput when a rule has an unknown quantity, no level, or contradictory levels.

    table: of the rig; without it a name may be that of a free channel and is not checked. where:
    start of the sentence.
    """
    for number, rule in enumerate(rules, start=1):
        for fault in rule_faults(rule, table):
            raise UnusableInput("{}limits.rule {} ({}): {}", where, number, rule.quantity, fault)


def level_refusal(
    quantity: str, level: str, value: object, table: ChannelTable | None = None
) -> str:
    """Return the fault of a rule's level for a quantity; empty when it is valid."""
    unit = quantities(table or BASE).get(quantity, "")
    allowed = LEVELS.get(unit, OTHER_LEVEL)
    return refusal(level, value, allowed, "" if unit == "1" else unit)


class AlwaysLimit(NamedTuple):
    """A limit of every test, above which the drive is powered off.

    alarm: key of its alarm. columns: columns of a row in which it can be reached, the extreme
    first; none if it is not a value of a revolution.
    """

    sentence: str
    title: str
    unit: str
    alarm: str
    columns: tuple[str, ...] = ()


ALWAYS: Final[Mapping[str, AlwaysLimit]] = {
    "overload_N": AlwaysLimit(
        say("Switch the drive off when any |F| sample is above"),
        say("|F|, any sample"),
        "N",
        "overload",
        ("force_max", "force_rms", "force_mean", "force_min"),
    ),
    "overspeed_rpm": AlwaysLimit(
        say("Switch the drive off when the speed is above"),
        say("Speed"),
        "rpm",
        "overspeed",
        ("speed_max", "speed", "speed_min", "speed_rms"),
    ),
    "stale_data_s": AlwaysLimit(
        say("Switch the drive off when the newest data are older than"),
        say("Age of the data"),
        "s",
        "stale_data",
    ),
}
"""Limits of every test besides the rules, by their key in ``[limits]``."""


def limit_refusal(name: str, value: object, table: ChannelTable | None = None) -> str:
    """Return the fault of the value of a limit or level of that name; empty when valid."""
    if name in ALWAYS:
        return refusal(f"limits.{name}", value)
    quantity, _, level = name.partition(".")
    wrong = level_refusal(quantity, level, value, table)
    return say("{}.{}", quantity, wrong) if wrong else ""


def rule_faults(rule: LimitRule, table: ChannelTable | None) -> Iterator[str]:
    """Yield the faults of a rule; table as in ``check_rules``."""
    known = quantities(table or BASE)
    if rule.quantity not in known and (
        table is not None or rule.quantity in BASE.names or not NAME.fullmatch(rule.quantity)
    ):
        near = difflib.get_close_matches(rule.quantity, known, n=1, cutoff=0.0)
        yield say("there is no such quantity; did you mean {}?", near[0])
    bounds = {name: value for name in BOUNDS if (value := getattr(rule, name)) is not None}
    if not bounds:
        yield say("no level is given; give one of {}", joined(", ", BOUNDS))
    for name, value in bounds.items():
        yield from filter(None, [level_refusal(rule.quantity, name, value, table)])
    for name in ("hysteresis", "delay_revolutions"):
        value, allowed = getattr(rule, name), RANGES[f"limits.rule.{name}"]
        yield from filter(None, [refusal(name, value, allowed)])
    yield from _disorder("above", rule.warning_above, rule.critical_above, 1)
    yield from _disorder("below", rule.warning_below, rule.critical_below, -1)
    lows = [v for v in (rule.warning_below, rule.critical_below) if v is not None]
    highs = [v for v in (rule.warning_above, rule.critical_above) if v is not None]
    if lows and highs and max(lows) >= min(highs):
        yield say("no value lies above {:g} and below {:g}", max(lows), min(highs))
    critical = [name for name in bounds if name.startswith("critical")]
    if critical and rule.action_critical == "none":
        yield say(
            (
                "action_critical = 'none' would have no effect at {} = {:g}; choose warn, pause,"
                " stop or drive_off, or give a warning level instead"
            ),
            critical[0],
            bounds[critical[0]],
        )


def _disorder(side: str, warning: float | None, critical: float | None, sign: int) -> Iterator[str]:
    if warning is not None and critical is not None and sign * (critical - warning) <= 0:
        yield say(
            "critical_{} = {:g} must lie beyond warning_{} = {:g}", side, critical, side, warning
        )


def levels(stop: StopSection) -> dict[str, float]:
    """Return the levels of the set criteria, by key, in the order of the table."""
    result = {key: getattr(stop, key) for key in CRITERIA}
    return {key: level for key, level in result.items() if level is not None}


def described(stop: StopSection) -> list[str]:
    """Return the set criteria as texts, for a check or a report."""
    return [
        say("{} {:g} {}", CRITERIA[key].title, level, unit_of("stop." + key))
        for key, level in levels(stop).items()
    ]
