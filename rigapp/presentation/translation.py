"""Say a text in the language of the window. It knows no Qt, so that everybody may use it.

A text stands in English where it is said. ``Text`` in a signature, field or table tells that who
takes it passes it through ``tr``; the catalogues are gathered by that (``collect``).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

Text = str
"""An English text that is translated when it is shown."""


class _Spoken:
    """The language of this process; English until ``speak``.

    told: templates of what others say, which are known again by ``told``. changes: how often
    another language was chosen; what is kept of one is of no use in the next.
    """

    def __init__(self) -> None:
        self.translations: Mapping[str, str] | None = None
        self.told: tuple[str, ...] = ()
        self.changes = 0


_SPOKEN = _Spoken()


def speak(translations: Mapping[str, str] | None, told: Sequence[str] = ()) -> None:
    """Say all texts as a table of them says from now on; None: in English, as they stand."""
    _SPOKEN.translations, _SPOKEN.told = translations, tuple(told)
    _SPOKEN.changes += 1


def speaks_english() -> bool:
    """Tell whether texts are said as they stand."""
    return _SPOKEN.translations is None


def told_templates() -> tuple[str, ...]:
    """Return what the engine says, with braces where it puts values."""
    return _SPOKEN.told


def language_changes() -> int:
    """Return how often a language was chosen in this process."""
    return _SPOKEN.changes


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
