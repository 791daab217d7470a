"""Say a text in the language of the window. It knows no Qt, so that everybody may use it.

A text stands in English where it is said. ``Text`` in a signature, field or table tells that who
takes it passes it through ``tr``; the catalogues are gathered by that (``collect``).
"""

from __future__ import annotations

from collections.abc import Mapping

Text = str
"""An English text that is translated when it is shown."""


class _Spoken:
    """The language of this process; English until ``speak``."""

    def __init__(self) -> None:
        self.translations: Mapping[str, str] | None = None


_SPOKEN = _Spoken()


def speak(translations: Mapping[str, str] | None) -> None:
    """Say all texts as a table of them says from now on; None: in English, as they stand."""
    _SPOKEN.translations = translations


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
