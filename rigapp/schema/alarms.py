"""The alarms that the engine can raise; ``alarms.toml`` defines each of them.

A cause is raised by its key, with the values in its text:
``make_alarm("overload", force_N=..., limit_N=...)``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import msgspec

from rigapp.schema.messages import Ends, FinishReason, Severity
from rigapp.texts import Sentence, say


class Kind(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Common data of all alarms of a kind; the head of ``alarms.toml`` explains the fields."""

    severity: Severity
    title: str
    sentence: str
    consequence: str
    action: str
    ends: Ends = Ends.SEEN
    stop: FinishReason | None = None
    off: bool = False
    keeps_cycles: bool = True
    value: str = ""
    whole_revolution: bool = False
    quantity: str = ""

    @property
    def latched(self) -> bool:
        """Return whether its alarms stay on the list until they are reset."""
        return self.severity is Severity.CRITICAL


@dataclass(frozen=True, slots=True)
class Cause:
    """One alarm as it is raised: its kind, key, title and the sentence that names the culprit.

    value: measured value, for kinds that state one.
    """

    kind: Kind
    key: str
    title: str
    sentence: str
    value: float | None = None


KINDS: Mapping[str, Kind] = msgspec.toml.decode(
    Path(__file__).with_suffix(".toml").read_bytes(), type=dict[str, Kind]
)
"""All kinds by key. The rules of a test file make further kinds, ``rule:...``."""

UNBELIEVED = ("wear_jumped", "wear_fell", "wear_negative")
"""Alarms after which the measured wear depth of a test is no longer valid; their value is the last
valid one, um."""

RULE_ACTIONS: Mapping[str, tuple[str, FinishReason | None]] = {
    "none": (say("No action taken."), None),
    "warn": (say("The test continues."), None),
    "pause": (say("The test pauses at the safe angle."), None),
    "stop": (say("The test was stopped."), FinishReason.LIMIT),
    "drive_off": (say("The drive was switched off."), FinishReason.LIMIT),
}
"""Action of a rule -> its consequence, and the reason with which it ends the test."""


LOOK_AT_TREND = say(
    "Check the trend of this quantity. Acknowledge, or change the limit with a reason."
)


def make_alarm(kind: str, what: str = "", /, **values: object) -> Cause:
    """Return an alarm of a kind; what: which of its alarms, values: for its text."""
    shared = KINDS[kind]
    named = {"0": what, **values}
    title, sentence = (Sentence.of(template, named) for template in (shared.title, shared.sentence))
    value = values.get(shared.value)
    measured = float(value) if isinstance(value, float | int) else None
    return Cause(shared, key_of(kind, what), title, sentence, measured)


def recorded_text(text: str, key: str) -> str:
    """Return a text of a recorded alarm with its structure, if the kind of its key has it.

    Files hold the English text only; a text with values stays as it was written.
    """
    kind, what = kind_of(key), key.rpartition(":")[2]
    fixed = (kind.title, kind.consequence, kind.action) if kind is not None else ()
    led_to = [consequence for consequence, _ in RULE_ACTIONS.values()]
    rule = key.split(":")[1] if key.startswith("rule:") else what
    known = [
        *(Sentence.of(text, {"0": what}) for text in fixed if "{" not in text.replace("{}", "")),
        *led_to,
        say("{} above limit", rule),
        say("{} below limit", rule),
        LOOK_AT_TREND,
    ]
    return next((sentence for sentence in known if sentence == text), text)


def kind_of(key: str) -> Kind | None:
    """Return the kind of an alarm by its key; None for a rule's."""
    while key and key not in KINDS:
        key = key.rpartition(":")[0]
    return KINDS.get(key)


def quantity_of(key: str) -> str:
    """Return the column or channel concerned by the alarm of a key, empty for none."""
    head, _, rest = key.partition(":")
    if head == "rule":
        return rest.partition(":")[0]
    kind = kind_of(key)
    return kind.quantity.format(rest) if kind is not None else ""


def key_of(kind: str, what: str = "") -> str:
    """Return the key of the alarm of a kind about a subject."""
    return f"{kind}:{what}" if what else kind


def exceeded(
    quantity: str, severity: Severity, value: float, limit: float, above: bool, action: str
) -> Cause:
    """Return the alarm of a level of a rule that is exceeded."""
    side = "above" if above else "below"
    judged = quantity, value, severity, limit
    consequence, stop = RULE_ACTIONS[action]
    kind = Kind(
        severity,
        title=say("{} above limit", quantity) if above else say("{} below limit", quantity),
        sentence=say("{} is {:.6g}, above the {} limit {:.6g}.", *judged)
        if above
        else say("{} is {:.6g}, below the {} limit {:.6g}.", *judged),
        consequence=consequence,
        action=LOOK_AT_TREND,
        ends=Ends.TEST,
        stop=stop,
        off=action == "drive_off",
        whole_revolution=True,
    )
    return Cause(kind, rule_key(quantity, severity.value, side), kind.title, kind.sentence)


def without_value(
    quantity: str, severity: Severity, age_s: float, limit: float, above: bool, action: str
) -> Cause:
    """Return the alarm of a level of a rule whose quantity has had no value for too long."""
    consequence, stop = RULE_ACTIONS[action]
    kind = Kind(
        severity,
        title=say("{} without a value", quantity),
        sentence=say(
            "{} has had no value for {:.0f} s; its limit {:.6g} is not monitored.",
            quantity,
            age_s,
            limit,
        ),
        consequence=consequence,
        action=say("Check the device of this channel and its cable, then start or resume."),
        ends=Ends.TEST,
        stop=stop,
        off=action == "drive_off",
        whole_revolution=True,
    )
    side = "above" if above else "below"
    key = rule_key(quantity, severity.value, f"{side}:missing")
    return Cause(kind, key, kind.title, kind.sentence)


def rule_key(quantity: str, severity: str, side: str) -> str:
    """Return the key of the alarm of a level of a rule; side: "above" or "below"."""
    return f"rule:{quantity}:{severity}:{side}"
