"""The limits of a test as sentences: one level of a rule each, and the rules that they make.

A rule of the file has up to four levels on one quantity; a sentence for each says the action, the
quantity, the level and the delay.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import msgspec

from rigapp.config.recipe import LimitRule, LimitsSection
from rigapp.config.rules import ALWAYS, BOUNDS, quantities, rule_faults
from rigapp.presentation.numbers import unit_text
from rigapp.presentation.translation import Text, speaks_english, tr, translate
from rigapp.schema.channels import BASE, ChannelTable
from rigapp.texts import capitalised, sentence_of_error
from rigapp.viewer.channels import SIZE, title_of, words

DEFAULT_ACTIONS: Final = {"warning": "warn", "critical": "stop"}

ACTIONS: Final[dict[tuple[str, str], Text]] = {
    ("warning", "warn"): "Warn",
    ("critical", "pause"): "Pause",
    ("critical", "stop"): "Stop",
    ("critical", "drive_off"): "Switch the drive off",
}
"""The actions to choose from, with the severity of their alarms."""

OTHER_ACTIONS: Final[dict[tuple[str, str], Text]] = {
    ("critical", "warn"): "Warn, critical",
    ("warning", "pause"): "Pause, warning",
    ("warning", "stop"): "Stop, warning",
    ("warning", "drive_off"): "Drive off, warning",
    ("warning", "none"): "Do nothing",
    ("critical", "none"): "Do nothing, critical",
}
"""Further actions that a file may have; shown where it does."""

_STATISTICS: Final[dict[str, Text]] = {
    "angle_of_max": "angle of the maximum of {}",
    "max": "maximum {}",
    "min": "minimum {}",
    "rms": "RMS of {}",
    "mean": "mean {}",
}

_OTHERS: Final[dict[str, Text]] = {
    "speed": "mean speed",
    "residual_rms": "measured \u2212 model",
    "residual_1_rms": "measured \u2212 model along crank",
    "residual_2_rms": "measured \u2212 model across crank",
    "measured_wear_depth": "wear depth",
    "measured_wear_depth_uncertainty": "uncertainty of the wear depth",
    "wear_depth": "wear depth of the model",
    "driven_wear_depth": "wear depth of the model by the measured force",
}
"""Explanations beyond the words."""


@dataclass(frozen=True, slots=True)
class LimitLevel:
    """One level of a rule.

    origin: number of the rule that it belongs to. severity: "warning" or "critical". side: "above"
    or "below". value: None where none is set yet. hysteresis: how far back it ends. steps: of
    the test, in which it is evaluated; none: all of them.
    """

    origin: int
    quantity: str = f"{SIZE}_max"
    severity: str = "warning"
    side: str = "above"
    value: Any = None
    action: str = "warn"
    revolutions: Any = 1
    hysteresis: Any = 0.0
    steps: tuple[int, ...] = ()

    @property
    def bound(self) -> str:
        """Return the key of the level."""
        return f"{self.severity}_{self.side}"

    def condition(self, table: ChannelTable) -> str:
        """Return action and quantity, without the value: Warn when maximum |F| is above."""
        action = tr({**ACTIONS, **OTHER_ACTIONS}[self.severity, self.action])
        quantity = quantity_text(self.quantity, table)
        if self.side == "below":
            return tr("{} when {} is below", action, quantity)
        return tr("{} when {} is above", action, quantity)

    def sentence(self, table: ChannelTable) -> str:
        """Return the sentence: Warn when maximum |F| is above 95 N in 3 revolutions."""
        several = self.revolutions != 1
        times = tr("{} revolutions", self.revolutions) if several else tr("1 revolution")
        value = f"{_shown(self.value)} {unit_of_quantity(self.quantity, table)}".rstrip()
        back = tr(", ends {} inside", _shown(self.hysteresis)) if self.hysteresis else ""
        within = tr(", in step {}", listed(self.steps)) if self.steps else ""
        return tr("{} {} in {}", self.condition(table), value, times) + back + within


def listed(steps: Sequence[int]) -> str:
    """Return the numbers of steps as words."""
    return ", ".join(map(str, steps))


def _shown(value: Any) -> str:
    return f"{value:.10g}" if isinstance(value, int | float) else str(value)


def quantity_text(column: str, table: ChannelTable = BASE) -> str:
    """Return the quantity of a limit, in words."""
    if column in _OTHERS:
        return tr(_OTHERS[column])
    for ending, text in _STATISTICS.items():
        name = column.removesuffix(f"_{ending}")
        if name == column:
            continue
        channel = next((channel for channel in table.channels if channel.name == name), None)
        title = title_of(channel) if channel is not None else tr(words(name))
        if speaks_english() and not title.startswith("|"):
            title = title[:1].lower() + title[1:]
        return tr(text, title)
    return tr(words(column))


def margin_words(name: str) -> str:
    """Return the name of a limit in words: its quantity, severity and side."""
    quantity, _, rest = name.partition(" ")
    return " ".join((quantity_text(quantity), *map(tr, rest.split())))


def quantity_choices(table: ChannelTable) -> list[tuple[str, str]]:
    """Return words and column of the quantities of limits, the force first."""
    known = [*dict.fromkeys((*table.units, *quantities(table)))]
    offered = [name for name in known if name in quantities(table)]
    offered.sort(key=lambda name: not name.startswith(f"{SIZE}_m") and name != f"{SIZE}_rms")
    return [(quantity_text(name, table), name) for name in offered]


def unit_of_quantity(column: str, table: ChannelTable) -> str:
    """Return the unit of a quantity as the window writes it."""
    return unit_text(quantities(table).get(column, ""))


def levels_of(rules: Sequence[Mapping[str, Any]]) -> list[LimitLevel]:
    """Return the levels of the rules of a file; a rule without one gives one without value."""
    return [level for origin, rule in enumerate(rules) for level in _of_rule(origin, rule)]


def _of_rule(origin: int, rule: Mapping[str, Any]) -> Iterator[LimitLevel]:
    bounds = [bound for bound in reversed(BOUNDS) if bound in rule] or ["warning_above"]
    for bound in bounds:
        severity, _, side = bound.partition("_")
        action = rule.get(f"action_{severity}", DEFAULT_ACTIONS[severity])
        yield LimitLevel(
            origin,
            str(rule.get("quantity", "")),
            severity,
            side,
            rule.get(bound),
            str(action) if (severity, action) in {**ACTIONS, **OTHER_ACTIONS} else "warn",
            rule.get("delay_revolutions", 1),
            rule.get("hysteresis", 0.0),
            tuple(rule.get("steps", ())),
        )


def rules_of(
    levels: Sequence[LimitLevel], original: Sequence[Mapping[str, Any]]
) -> tuple[list[dict[str, Any]], list[list[int]]]:
    """Return the rules of levels, and the indices of each one's levels.

    original: the rules of the file, whose keys stay as written where they mean the same. A level
    that no longer fits its rule becomes a rule of its own, at the end.
    """
    rules: list[dict[str, Any]] = []
    places: list[list[int]] = []
    firsts = {level.origin: at for at, level in reversed(list(enumerate(levels)))}
    order = sorted(
        range(len(levels)), key=lambda at: (at not in firsts.values(), levels[at].origin)
    )
    for at in order:
        level = levels[at]
        fitting = (number for number, indices in enumerate(places) if _fits(levels, indices, level))
        number = next(fitting, None)
        if number is None:
            number = len(rules)
            own = at == firsts[level.origin] and 0 <= level.origin < len(original)
            rules.append(_begun(level, original[level.origin] if own else {}))
            places.append([])
        places[number].append(at)
        _write(rules[number], level)
    return rules, places


def _fits(levels: Sequence[LimitLevel], indices: Sequence[int], level: LimitLevel) -> bool:
    """Return whether a level can be one of a rule that has some already."""
    others = [levels[at] for at in indices]
    first = others[0]
    same = (first.origin, first.quantity, first.revolutions, first.hysteresis, first.steps)
    wanted = (level.origin, level.quantity, level.revolutions, level.hysteresis, level.steps)
    return same == wanted and not any(
        other.bound == level.bound
        or (other.severity == level.severity and other.action != level.action)
        for other in others
    )


def _begun(level: LimitLevel, original: Mapping[str, Any]) -> dict[str, Any]:
    """Return a rule without levels, the rest of it as the file has it."""
    left_out = {*BOUNDS} | {
        f"action_{name}" for name in DEFAULT_ACTIONS if any(b.startswith(name) for b in original)
    }
    rule = {"quantity": level.quantity, **{k: v for k, v in original.items() if k not in left_out}}
    rule["quantity"] = level.quantity
    if level.hysteresis != original.get("hysteresis", 0.0):
        rule["hysteresis"] = level.hysteresis
    if level.revolutions != original.get("delay_revolutions", 1):
        rule["delay_revolutions"] = level.revolutions
    if level.steps != tuple(original.get("steps", ())):
        rule["steps"] = list(level.steps)
    for severity, default in DEFAULT_ACTIONS.items():
        key = f"action_{severity}"
        if key in left_out and original.get(key) == default:
            rule[key] = default
    return rule


def _write(rule: dict[str, Any], level: LimitLevel) -> None:
    if level.value is not None:
        rule[level.bound] = level.value
    key = f"action_{level.severity}"
    if level.action != rule.get(key, DEFAULT_ACTIONS[level.severity]):
        rule[key] = level.action


def faults_of(rule: Mapping[str, Any], table: ChannelTable | None) -> list[str]:
    """Return the faults of a rule, as sentences under its limit."""
    try:
        record = msgspec.convert(rule, LimitRule)
    except msgspec.ValidationError as error:
        return [translate(sentence_of_error(error))]
    return [_plain(fault) for fault in rule_faults(record, table)]


def _plain(fault: str) -> str:
    """Return a fault of a rule without the keys of the file."""
    if fault.startswith("no level"):
        return tr("Type the value of the limit.")
    text = re.sub(r"\b(critical|warning)_(above|below)( = )?", "", translate(fault)).strip()
    text = text.replace("delay_revolutions", "revolutions")
    return f"{capitalised(text)}."


def never_comes(level: LimitLevel, limits: LimitsSection | None) -> str:
    """Return why a level cannot be reached, as the drive is off before; empty if it can."""
    if limits is None or level.side == "below" or not isinstance(level.value, int | float):
        return ""
    for name, limit in ALWAYS.items():
        most = getattr(limits, name)
        if level.quantity in limit.columns and level.value >= most:
            return tr(
                (
                    "{value} is never reached: the drive switches off at {most}. Type a value"
                    " below that."
                ),
                value=f"{level.value:g} {limit.unit}",
                most=f"{most:g} {limit.unit}",
            )
    return ""
