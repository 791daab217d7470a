"""Say a text in the language of the window. It knows no Qt, so that everybody may use it.

A text stands in English where it is said. ``Text`` in a signature, field or table tells that who
takes it passes it through ``tr``; the catalogues are gathered by that (``collect``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Final

from rigapp.schema.details import sentence_of
from rigapp.texts import Sentence, Value, braces

Text = str
"""An English text that is translated when it is shown."""


class _Spoken:
    """The language of this process: its texts by the English ones, None for English."""

    translations: Mapping[str, str] | None = None
    language = "en"


_SPOKEN = _Spoken()


ENGLISH: Final = "en"


def speak(translations: Mapping[str, str] | None, code: str = "") -> None:
    """Say all texts as a table of them says from now on; None: in English, as they stand.

    code: of the language, by ISO 639.
    """
    _SPOKEN.translations = translations
    _SPOKEN.language = code or ENGLISH


@contextmanager
def speaking(translations: Mapping[str, str] | None, code: str) -> Iterator[None]:
    """Say texts as a table of them says until the block ends, then as before."""
    before = _SPOKEN.translations, _SPOKEN.language
    speak(translations, code)
    try:
        yield
    finally:
        speak(*before)


def language() -> str:
    """Return the code of the language that is spoken."""
    return _SPOKEN.language


def speaks_english() -> bool:
    """Tell whether texts are said as they stand."""
    return _SPOKEN.translations is None


def marked(text: Text) -> Text:
    """Return a text as it stands: the catalogue has it, and whoever shows it translates it."""
    return text


def tr(text: Text, *values: object, **named: object) -> str:
    """Return a text in the language of the window, with values in the place of its braces.

    A text that the catalogue does not have (a name, a number, what is translated already) is
    returned as it is.
    """
    said = text if _SPOKEN.translations is None else _SPOKEN.translations.get(text, text)
    return said.format(*values, **named) if values or named else said


EDGES: Final = " .;:,\n"
"""What may stand about a sentence; the catalogue has it without."""
PLURAL: Final = "s"
"""An ending that says nothing in another language."""


_ERROR_NUMBER: Final = re.compile(r"\[Errno -?\d+\] ")


def translate(text: str) -> str:
    """Return a text in the language of the window, without its details and numbers of errors.

    Only a sentence is translated: what people and older programs wrote is shown as it is.
    """
    bare = sentence_of(text)
    if isinstance(bare, Sentence) and _SPOKEN.translations is not None:
        bare = _translated(bare, _SPOKEN.translations)
    return _ERROR_NUMBER.sub("", bare)


def _translated(sentence: Sentence, catalogue: Mapping[str, str]) -> str:
    template = _template(sentence.template, catalogue)
    if not sentence.values:
        return template
    values = {
        name: _value(sentence.values[name], spec, literal, catalogue)
        for literal, name, spec in braces(sentence.template)
        if name
    }
    return "".join(
        literal + (values.get(name, "") if name else "") for literal, name, _ in braces(template)
    )


def _template(template: str, catalogue: Mapping[str, str]) -> str:
    """Return a template as the catalogue has it, where not, as it stands.

    The catalogue may have it without its edges, or with another first letter, as within a sentence.
    """
    if template in catalogue:
        return catalogue[template]
    core = template.strip(EDGES)
    before, _, after = template.partition(core) if core else (template, "", "")
    other = catalogue.get(core[:1].swapcase() + core[1:], core)
    known = catalogue.get(core) or (other[:1].upper() + other[1:] if core[:1].isupper() else other)
    return before + known + after


def _value(value: Value, spec: str, before: str, catalogue: Mapping[str, str]) -> str:
    if isinstance(value, Sentence):
        return _translated(value, catalogue)
    if value == PLURAL and before[-1:].isalpha():
        return ""
    return format(value, spec)
