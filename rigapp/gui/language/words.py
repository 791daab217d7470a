"""Say a text in the language of the window. It knows no Qt, so that everybody may use it.

A text stands in English where it is said. ``Text`` in a signature, field or table tells that who
takes it passes it through ``tr``; the catalogues are gathered by that (``collect``).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

Text = str
"""An English text that is translated when it is shown."""

Translate = Callable[[str], str]

MOST_KEPT = 4096
"""Translations that are kept at hand: several times the texts of the window."""


class _Spoken:
    """The language of this process; English until ``speak``."""

    def __init__(self) -> None:
        self.translate: Translate | None = None


_SPOKEN = _Spoken()


def speak(translate: Translate | None) -> None:
    """Say all texts by a function from now on; None: in English, as they stand.

    translate: returns the translation of an English text, an empty one where it has none.
    """
    _SPOKEN.translate = lru_cache(MOST_KEPT)(translate) if translate is not None else None


def speaks_english() -> bool:
    """Tell whether texts are said as they stand."""
    return _SPOKEN.translate is None


def marked(text: Text) -> Text:
    """Return a text as it stands: the catalogue has it, and whoever shows it translates it."""
    return text


def tr(text: Text, *values: object, **named: object) -> str:
    """Return a text in the language of the window, with values in the place of its braces.

    A text that the catalogue does not have (a name, a number, what is translated already) is
    returned as it is.
    """
    said = _SPOKEN.translate(text) or text if text and _SPOKEN.translate is not None else text
    return said.format(*values, **named) if values or named else said
