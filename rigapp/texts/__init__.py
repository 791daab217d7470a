"""Texts that keep their structure: a template with values, from their origin to the screen.

A ``Sentence`` is its English text, so files, logs and terminals use it as any string. Another
language takes the translation of its template from a catalogue and fills in the values
(``rigapp.presentation.translation``). Errors of drivers, model and calibration are sentences, too:
this module imports nothing of rigapp. Other packages import this one.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from enum import Enum
from itertools import count
from string import Formatter

Value = str | int | float
"""Value of a placeholder: a number, a name that is never translated, or another sentence."""


class Sentence(str):
    """An English text with its template and the values in it.

    A template without values is the text itself, braces included.
    """

    __slots__ = ("template", "values")
    template: str
    values: dict[str, Value]

    def __new__(cls, template: str = "", *values: object, **named: object) -> Sentence:
        """Fill a template: its braces have values in their order, or names."""
        if isinstance(template, Sentence) and not values:
            return template
        return cls.of(template, {**dict(zip(map(str, count()), values, strict=False)), **named})

    @classmethod
    def of(cls, template: str, values: dict[str, object]) -> Sentence:
        """Fill a template with values by their names; those without one have numbers."""
        named = {name for _, name, _ in braces(template) if name} if values else set()
        kept = {name: _stored(value) for name, value in values.items() if name in named}
        text = filled(template, kept) if values else template
        sentence = super().__new__(cls, text)
        sentence.template, sentence.values = template, kept
        return sentence

    def __reduce__(self) -> tuple[object, ...]:
        """Return its constructor and arguments, for copies and other processes."""
        return Sentence.of, (self.template, self.values)

    def __add__(self, other: str, /) -> Sentence:
        """Return it with another text behind it; each keeps its structure."""
        return Sentence("{}{}", self, other)

    def lower(self) -> Sentence:
        """Return it in small letters, its structure kept where its values allow."""
        return self._ended(self.template.lower(), super().lower())

    def strip(self, chars: str | None = None, /) -> Sentence:
        """Return it without characters at its ends, its structure kept where its value allows."""
        return self._ended(self.template.strip(chars), super().strip(chars))

    def rstrip(self, chars: str | None = None, /) -> Sentence:
        """Return it without characters at its end, its structure kept where its value allows."""
        return self._ended(self.template.rstrip(chars), super().rstrip(chars))

    def removesuffix(self, suffix: str, /) -> Sentence:
        """Return it without an ending, its structure kept where its value allows."""
        return self._ended(self.template.removesuffix(suffix), super().removesuffix(suffix))

    def _ended(self, template: str, text: str) -> Sentence:
        ended = Sentence.of(template, {**self.values})
        return ended if ended == text else as_written(text)


class SentenceError(Exception):
    """An error with a sentence, raised with a template and its values."""

    def __init__(self, template: str = "", *values: object) -> None:
        super().__init__(Sentence(template, *values))


def say(template: str, *values: object, **named: object) -> Sentence:
    """Return the sentence of a template; the catalogues are gathered from these calls.

    values: numbers, names, sentences, and errors, of which their sentence is taken.
    """
    return Sentence(template, *values, **named)


def as_written(text: str) -> Sentence:
    """Return a text as a sentence; one without structure is shown unchanged, never translated.

    For texts of people and older programs.
    """
    return text if isinstance(text, Sentence) else Sentence("{}", text)


def sentence_of_error(error: BaseException) -> str:
    """Return the text of an error, with its structure where it has one."""
    sentence = error.args[0] if len(error.args) == 1 else None
    return sentence if isinstance(sentence, Sentence) and sentence == str(error) else str(error)


def capitalised(text: str) -> str:
    """Return a text with a capital first letter, its structure kept; a channel's name stays."""
    if not isinstance(text, Sentence):
        return text if "_" in text.partition(" ")[0] else text[:1].upper() + text[1:]
    literal, name, _ = next(braces(text.template), ("", "", ""))
    if literal or not name:
        return Sentence.of(text.template[:1].upper() + text.template[1:], {**text.values})
    first = text.values[name]
    begin = capitalised(first) if isinstance(first, str) else first
    return Sentence.of(text.template, {**text.values, name: begin})


def joined(separator: str, texts: Iterable[str]) -> Sentence:
    """Return texts joined by a separator, which is a sentence where it has words."""
    parts: list[str] = []
    for text in texts:
        parts += [separator, text] if parts else [text]
    return Sentence("{}" * len(parts), *parts)


def _stored(value: object) -> Value:
    """Return a value as a sentence keeps it."""
    if isinstance(value, Sentence):
        return value
    if isinstance(value, Enum) and not isinstance(value, int):
        return Sentence(str(value))
    if isinstance(value, BaseException):
        return sentence_of_error(value)
    if isinstance(value, bool) or not isinstance(value, int | float):
        item = getattr(value, "item", None)
        return _stored(item()) if callable(item) else str(value)  # numbers of numpy have item
    return float(value) if isinstance(value, float) else int(value)


def filled(template: str, values: dict[str, Value]) -> str:
    """Return a template with its values."""
    return "".join(
        literal + (format(values[name], spec) if name else "")
        for literal, name, spec in braces(template)
    )


def braces(template: str) -> Iterator[tuple[str, str, str]]:
    """Yield each literal of a template, the name of the value after it, and its format.

    Values without a name are numbered. The last literal may have no value after it.
    """
    number = 0
    for literal, name, spec, _ in Formatter().parse(template):
        yield literal, str(number) if name == "" else name or "", spec or ""
        number += name == ""
