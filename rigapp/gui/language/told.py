"""Say in the language of the window what the engine has told in English, values and all.

The engine's sentences go into files and logs as they are; here they are known again by the
templates that they were made of.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache
from string import Formatter
from typing import Final

from rigapp.gui.language.words import Text, speaks_english, tr
from rigapp.schema.alarms import KINDS, RULE_ACTIONS

RECOVERY: Final[tuple[Text, ...]] = (
    "Wait: the devices are being connected.",
    "Wait: the spindle is brought to a stand and the file is finished.",
    "Wait: the crank comes to rest at the pause angle.",
    "Resume the paused test.",
    "Go on with the test in {}, or start another one.",
    "Start a test.",
    'Acknowledge "{}": say that you have seen it.',
    'Acknowledge "{}" and {} more: say that you have seen it.',
    "Remove the cause, then connect the devices.",
    "Connect.",
    "Reset: the deliberate step before another start. Nothing moves.",
)
"""What the engine tells of the next step."""

RULES: Final[tuple[Text, ...]] = (
    "{} above limit",
    "{} below limit",
    "{} is {}, above the {} limit {}.",
    "{} is {}, below the {} limit {}.",
    "Look at the trend of this quantity; acknowledge, or change the limit with reason.",
)
"""What the engine tells of a limit of the test."""

ENDINGS: Final[tuple[Text, ...]] = (
    "All revolutions are done.",
    "asked by the operator",
    "as asked",
)
"""Why a test ended or pauses, where it is no alarm."""


def templates() -> list[Text]:
    """Return everything that the engine tells, with braces where it puts values."""
    alarms = [one for kind in KINDS.values() for one in (kind.title, kind.sentence)]
    led_to = [one for kind in KINDS.values() for one in (kind.consequence, kind.action)]
    return [
        *RECOVERY,
        *ENDINGS,
        *led_to,
        *(one for one, _ in RULE_ACTIONS.values()),
        *alarms,
        *RULES,
    ]


def retold(sentence: str) -> str:
    """Return a sentence of the engine in the language of the window, as it is where unknown."""
    said = tr(sentence)
    if said != sentence or speaks_english():
        return said
    for template, pattern in _patterns():
        found = pattern.fullmatch(sentence)
        if found is not None:
            return _filled(tr(template), {name: tr(one) for name, one in found.groupdict().items()})
    return said


@lru_cache(1)
def _patterns() -> list[tuple[str, re.Pattern[str]]]:
    """Return the templates with values, those of the most words first."""
    found = []
    for template in templates():
        said = [part for part, *_ in Formatter().parse(template)]
        if "{" in template and any(char.isalpha() for char in "".join(said)):
            parts = (
                re.escape(part) + (f"(?P<{name}>.+?)" if name else "")
                for part, name in _parts(template)
            )
            found.append((sum(map(len, said)), template, re.compile("".join(parts), re.DOTALL)))
    return [(template, pattern) for _, template, pattern in sorted(found, key=lambda one: -one[0])]


def _filled(template: str, values: dict[str, str]) -> str:
    return "".join(part + values.get(name, "") for part, name in _parts(template))


def _parts(template: str) -> Iterator[tuple[str, str]]:
    """Yield each literal part and the name of the value after it; numbered where it has none."""
    number = 0
    for part, name, _, _ in Formatter().parse(template):
        if name is None:
            yield part, ""
            continue
        yield part, f"at_{name or number}" if not name or name.isdigit() else name
        number += name == ""
