"""Translate texts into the language of the process, without Qt.

Texts are English in the source. ``Text`` in a signature, field or table means that the receiver
passes it through ``tr``; the catalogues are gathered by these annotations (``collect``).
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
    """Translate all texts by a table from now on; None: leave them in English.

    code: of the language, by ISO 639.
    """
    _SPOKEN.translations = translations
    _SPOKEN.language = code or ENGLISH


@contextmanager
def speaking(translations: Mapping[str, str] | None, code: str) -> Iterator[None]:
    """Translate texts by a table until the block ends, then as before."""
    before = _SPOKEN.translations, _SPOKEN.language
    speak(translations, code)
    try:
        yield
    finally:
        speak(*before)


def language() -> str:
    """Return the code of the language in use."""
    return _SPOKEN.language


def speaks_english() -> bool:
    """Return whether texts stay in English."""
    return _SPOKEN.translations is None


def marked(text: Text) -> Text:
    """Return a text unchanged; it gets into the catalogue, and is translated where it is shown."""
    return text


def tr(text: Text, *values: object, **named: object) -> str:
    """Return a text in the language of the window, with values in the place of its braces.

    A text that is not in the catalogue (a name, a number, a translated text) is returned unchanged.
    """
    translated = text if _SPOKEN.translations is None else _SPOKEN.translations.get(text, text)
    return translated.format(*values, **named) if values or named else translated


EDGES: Final = " .;:,\n"
"""Characters around a sentence, which the catalogue omits."""
PLURAL: Final = "s"
"""An ending without meaning in another language."""


_ERROR_NUMBER: Final = re.compile(r"\[Errno -?\d+\] ")


def translate(text: str) -> str:
    """Return a text in the language of the window, without its details and error numbers.

    Only a sentence is translated: texts of people and older programs are returned unchanged.
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
    """Return the translation of a template, or the template where there is none.

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
