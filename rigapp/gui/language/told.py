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

from rigapp.gui.language.words import (
    Text,
    language_changes,
    speaks_english,
    told_templates,
    tr,
)
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


UNITS: Final[tuple[Text, ...]] = (
    "revolutions",
    "revolutions/s",
    "revolutions/h",
    "standard deviations",
    "days",
    "a share of 1",
)
"""Units that are words."""


def templates() -> list[Text]:
    """Return what the engine tells by its tables, with braces where it puts values."""
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
    """Return a sentence of the engine in the language of the window, as it is where unknown.

    What is not known as a whole is looked for in its parts.
    """
    return sentence if speaks_english() else _retold(sentence, language_changes())


EDGES: Final = " .;:,\n"
"""What may stand about a sentence, or about a part of it."""
AND: Final[Text] = " and "
SEPARATORS: Final = ("\n", "; ", ". ", ": ", ", ", AND)
REMEMBERED = 1024
"""Sentences of which the window keeps how they are said: it shows the same ones again and again."""


@lru_cache(REMEMBERED)
def _retold(sentence: str, changes: int) -> str:
    said = tr(sentence)
    core = sentence.strip(EDGES)
    if said != sentence or not core:
        return said
    before, _, after = sentence.partition(core)
    return before + _said(core, changes) + after


def _said(core: str, changes: int) -> str:
    """Return what stands between the edges of a sentence: known, made of a template, or parts."""
    for known, capital in ((core, False), (core[0].lower() + core[1:], True)):
        said = tr(known)
        if said != known:
            return _capital(said) if capital else said
    for template, pattern in _patterns(changes):
        found = pattern.fullmatch(core)
        if found is not None:
            values = {name: _part(one, changes) for name, one in found.groupdict().items()}
            said = _filled(tr(template).strip(EDGES), values)
            return _capital(said) if core[0].isupper() else said
    for separator in SEPARATORS:
        parts = core.split(separator)
        known_parts = [_phrase(one, changes) for one in parts] if len(parts) > 1 else parts
        if known_parts != parts:
            return tr(separator).join(known_parts)
    named = VALUED.fullmatch(core)
    return f"{tr(named[1])} {_part(named[2], changes)}" if named is not None else core


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _phrase(part: str, changes: int) -> str:
    """Return a part in the language of the window; one word alone may be somebody's name."""
    return _retold(part, changes) if " " in part.strip() else part


def _part(value: str, changes: int) -> str:
    """Return a value that stood in a template."""
    return _phrase(value, changes) if " " in value.strip() else tr(value)


NUMBER: Final = r"[-−+]?[\d.,\u2009]+(?:e[-+]?\d+)?|nan|inf"
SHORT: Final = r"(?:(?! and |[;:\n]).){1,60}?"
"""A value where little else tells the template: a few words."""
VALUED: Final = re.compile(r"([^\d]+?) ([-−+]?\d.*)")
"""A name with its value."""
FEW_WORDS = 3
WORD: Final = re.compile(r"[^\W\d_]{2,}")


@lru_cache(1)
def _patterns(changes: int) -> list[tuple[str, re.Pattern[str]]]:
    """Return the templates with values, those of the most words first."""
    found = []
    for template in told_templates():
        core = template.strip(EDGES)
        said = "".join(part for part, *_ in Formatter().parse(core))
        words = len(WORD.findall(said))
        if words:
            found.append((len(said), template, re.compile(_expression(core, words), re.DOTALL)))
    return [(template, pattern) for _, template, pattern in sorted(found, key=lambda one: -one[0])]


def _expression(core: str, words: int) -> str:
    """Return the regular expression of a template; its first letter may be a capital one."""
    made: list[str] = []
    for part, name, spec in _parts(core):
        literal = re.escape(part)
        if part and not made:
            literal = f"(?i:{re.escape(part[0])}){re.escape(part[1:])}"
        made.append(literal)
        if not name:
            continue
        value = SHORT if words < FEW_WORDS else ".+?"
        if spec and spec[-1] in "gfde,":
            value = NUMBER
        elif len(made) > 1 and not part:
            value = r"(?:(?:[;,]| \().*)?"  # what is added where there is more to say
        elif len(made) > 1 and part[-1].isalpha():
            value = ".*?"  # an ending
        made.append(f"(?P<{name}>{value})")
    return "".join(made)


def _filled(template: str, values: dict[str, str]) -> str:
    return "".join(part + values.get(name, "") for part, name, _ in _parts(template))


def _parts(template: str) -> Iterator[tuple[str, str, str]]:
    """Yield each literal part, the name of the value after it, numbered where it has none, and how.

    The last part has no value after it.
    """
    number = 0
    for part, name, spec, _ in Formatter().parse(template):
        if name is None:
            yield part, "", ""
            continue
        yield part, f"at_{name or number}" if not name or name.isdigit() else name, spec or ""
        number += name == ""
