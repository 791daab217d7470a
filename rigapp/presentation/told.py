"""Say in the language of the window what the engine has told in English, values and all.

The engine's sentences go into files and logs as they are; here they are known again by the
templates that they were made of.
"""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from string import Formatter
from typing import Final

from rigapp.presentation.foreign import LIBRARIES, SYSTEM, WORDS_INSIDE
from rigapp.presentation.numbers import capitalised
from rigapp.presentation.translation import (
    Text,
    language_changes,
    speaks_english,
    told_templates,
    tr,
)
from rigapp.schema.alarms import KINDS, RULE_ACTIONS
from rigapp.schema.details import sentence_of

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
    """Return what the engine tells by its tables, and others in words of their own.

    Braces stand where they put values.
    """
    alarms = [one for kind in KINDS.values() for one in (kind.title, sentence_of(kind.sentence))]
    led_to = [one for kind in KINDS.values() for one in (kind.consequence, kind.action)]
    return [
        *RECOVERY,
        *ENDINGS,
        *led_to,
        *(one for one, _ in RULE_ACTIONS.values()),
        *alarms,
        *RULES,
        *SYSTEM,
        *LIBRARIES,
        *WORDS_INSIDE,
    ]


def retold(sentence: str) -> str:
    """Return a sentence of the engine in the language of the window, as it is where unknown.

    What is not known as a whole is looked for in its parts. Its details are left out, and numbers
    of the operating system's errors: its words say the same, and the log has both.
    """
    sentence = ERROR_NUMBER.sub("", sentence_of(sentence))
    return sentence if speaks_english() else _retold(sentence, language_changes())


ERROR_NUMBER: Final = re.compile(r"\[Errno -?\d+\] ")


EDGES: Final = " .;:,\n"
"""What may stand about a sentence, or about a part of it."""
AND: Final[Text] = " and "
SEPARATORS: Final = ("\n", "; ", ". ", ": ", ", ", AND)
REMEMBERED = 4096
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
    whole = _whole(core, changes) or _with_known_end(core, changes)
    if whole:
        return whole
    for separator in SEPARATORS:
        parts = core.split(separator)
        known_parts = [_phrase(one, changes) for one in parts] if len(parts) > 1 else parts
        if known_parts != parts:
            return tr(separator).join(known_parts)
    named = VALUED.fullmatch(core)
    return f"{tr(named[1])} {_part(named[2], changes)}" if named is not None else core


def _whole(core: str, changes: int) -> str:
    """Return what is known as it stands or made of a template, empty where it is neither."""
    for known, capital in _spellings(core):
        said = tr(known)
        if said != known:
            return capitalised(said) if capital else said
    for template in _known_by(changes).like(core):
        values = template.values_in(core)
        if values is not None:
            told = {name: _part(one, changes) for name, one in values.items()}
            if template.glue and any(_is_unknown(one, told[name]) for name, one in values.items()):
                continue
            said = _filled(tr(template.text).strip(EDGES), told)
            return capitalised(said) if core[0].isupper() else said
    return ""


def _is_unknown(value: str, said: str) -> bool:
    """Tell whether a value is more than a name or a number with its unit, and said as it was."""
    return said == value and " " in value and MEASURED.match(value) is None


def _with_known_end(core: str, changes: int) -> str:
    """Return a sentence that stands behind the name of a file, a device or a key."""
    at = core.find(": ")
    while at > 0:
        said = _whole(core[at + 2 :], changes)
        if said:
            return f"{_phrase(core[:at], changes)}: {said}"
        at = core.find(": ", at + 2)
    return ""


def _spellings(core: str) -> Iterator[tuple[str, bool]]:
    """Yield how a text may stand in the catalogue, and whether it is said with a capital letter."""
    yield core, False
    yield core[0].lower() + core[1:], True
    yield core[0].upper() + core[1:], False


def _phrase(part: str, changes: int) -> str:
    """Return a part in the language of the window; one word alone may be somebody's name."""
    return _retold(part, changes) if " " in part.strip() else part


def _part(value: str, changes: int) -> str:
    """Return a value that stood in a template."""
    return _phrase(value, changes) if " " in value.strip() else tr(value)


VALUED: Final = re.compile(r"([^\d]+?) ([-−+]?\d.*)")
"""A name with its value."""
MEASURED: Final = re.compile(r"[-−+(]*\d|nan\b|-?inf\b")
FEW_WORDS = 3
GLUE: Final = frozenset(
    {"are", "at", "by", "for", "from", "in", "is", "of", "on", "or", "to", "was", "with", "without"}
)
"""Words that stand in every sentence: what they join must be known itself."""
WORD: Final = re.compile(r"[^\W\d_]{2,}")

ANY: Final = re.compile(r".+", re.DOTALL)
NUMBER: Final = re.compile(r"[-−+]?[\d.,\u2009\u202f]+(?:e[-+]?\d+)?%?|nan|inf")
SHORT: Final = re.compile(r"(?!.*(?: and |[;:] |\n)) ?\S+(?: \S+){0,9}")
"""A value where little else tells the template: a few words."""
ADDED: Final = re.compile(r"(?:(?:[;,]| \().*)?", re.DOTALL)
"""What is added where there is more to say."""
ENDING: Final = re.compile(r".*", re.DOTALL)
NOT_BEFORE_ENDINGS: Final = (" ", "(", "[", "=", "/")
PLURAL: Final = "s"
"""An ending that says nothing in another language."""


@dataclass(frozen=True, slots=True)
class _Slot:
    """A value of a template: its name, what it may be, and the text after it."""

    name: str
    may_be: re.Pattern[str]
    after: str


@dataclass(frozen=True, slots=True)
class _Template:
    """A sentence with values. words: those that stand in it whole, in small letters.

    glue: it has no other words than such that join others.
    """

    text: str
    rank: int
    first: str
    slots: tuple[_Slot, ...]
    words: frozenset[str]
    glue: bool

    def values_in(self, core: str) -> dict[str, str] | None:
        """Return the values by which it says a text, None where it does not.

        The first letter of the text may be a capital one.
        """
        if self.first and core[:1] != self.first[0]:
            core = core[:1].swapcase() + core[1:]
        return _values(core, len(self.first), self.slots) if core.startswith(self.first) else None


def _values(core: str, at: int, slots: tuple[_Slot, ...]) -> dict[str, str] | None:
    """Return the values of a text from a place on, each as short as the rest allows."""
    if not slots:
        return {} if at == len(core) else None
    slot, *others = slots
    end = core.find(slot.after, at) if others else len(core) - len(slot.after)
    while end >= at and core.startswith(slot.after, end):
        value = core[at:end]
        if slot.may_be.fullmatch(value) or (slot.may_be is SHORT and tr(value) != value):
            rest = _values(core, end + len(slot.after), slots[1:])
            if rest is not None:
                ending = slot.may_be is ENDING and value == PLURAL
                return {slot.name: "" if ending else value} | rest
        if not others:
            return None
        end = core.find(slot.after, end + 1)
    return None


class _Index:
    """Templates by the rarest of their words: few of a thousand are like a sentence."""

    def __init__(self, texts: Sequence[str]) -> None:
        made = [one for one in map(_made, texts) if one is not None]
        often = Counter(word for one in made for word in one.words)
        self._by_word: dict[str, list[_Template]] = defaultdict(list)
        for one in made:
            rarest = min(one.words, key=lambda word: (often[word], word), default="")
            self._by_word[rarest].append(one)

    def like(self, core: str) -> list[_Template]:
        """Return the templates all of whose words stand in a text, the longest first."""
        words = set(WORD.findall(core.lower()))
        found = [
            one
            for word in ("", *words)
            for one in self._by_word.get(word, ())
            if one.words <= words
        ]
        return sorted(found, key=lambda one: one.rank)


@lru_cache(1)
def _known_by(changes: int) -> _Index:
    return _Index(told_templates())


def _made(text: str) -> _Template | None:
    """Return a template ready for use, None where it has no words."""
    parts = list(_parts(text.strip(EDGES)))
    said = "".join(part for part, *_ in parts)
    count = len(WORD.findall(said))
    if not count:
        return None
    slots = [
        _Slot(name, _may_be(at, part, spec, count), after)
        for at, ((part, name, spec), (after, *_)) in enumerate(pairwise([*parts, ("", "", "")]))
        if name
    ]
    words = frozenset(WORD.findall("\0".join(part for part, *_ in parts).lower()))
    return _Template(
        text,
        -len(said),
        parts[0][0],
        tuple(slots),
        words - _cut(parts),
        glue=words <= GLUE and all(one.may_be is not NUMBER for one in slots),
    )


def _may_be(at: int, before: str, spec: str, words: int) -> re.Pattern[str]:
    """Return what a value may be, by what stands before it."""
    if spec and spec[-1] in "gfde,%":
        return NUMBER
    if at and not before:
        return ADDED
    if at and not before.endswith(NOT_BEFORE_ENDINGS):
        return ENDING
    return SHORT if words < FEW_WORDS and not before.endswith((": ", "; ", ". ")) else ANY


def _cut(parts: Sequence[tuple[str, str, str]]) -> set[str]:
    """Return the words at which a value begins or ends: a text may have longer ones there."""
    found: set[str] = set()
    for at, (part, name, _) in enumerate(parts):
        words = WORD.findall(part.lower())
        if words and name and part[-1].isalnum():
            found.add(words[-1])
        if words and at and part[0].isalnum():
            found.add(words[0])
    return found


def _filled(template: str, values: dict[str, str]) -> str:
    return "".join(part + values.get(name, "") for part, name, _ in _parts(template))


def _parts(template: str) -> Iterator[tuple[str, str, str]]:
    """Yield each literal part, the name of the value after it, numbered where it has none, and how.

    The last part has no value after it.
    """
    number, literal = 0, ""
    for part, name, spec, _ in Formatter().parse(template):
        literal += part
        if name is None:
            continue
        yield literal, f"at_{name or number}" if not name or name.isdigit() else name, spec or ""
        number, literal = number + (name == ""), ""
    yield literal, "", ""
