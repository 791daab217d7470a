"""Parse numbers as users type them."""

from __future__ import annotations

_SPACES = dict.fromkeys(map(ord, " \u2009\u00a0\u202f"))
_MINUS = "\u2212"


def number(text: str) -> float:
    """Return the number in a text, with decimal comma or point.

    Raises ValueError for other texts, also with both: either mark may then group digits.
    """
    plain = text.translate(_SPACES).replace(_MINUS, "-")
    if plain.count(",") == 1 and "." not in plain:
        plain = plain.replace(",", ".")
    return float(plain)


def whole(text: str) -> int:
    """Return the integer in a text; raises ValueError for other texts."""
    return int(text.translate(_SPACES).replace(_MINUS, "-"))
