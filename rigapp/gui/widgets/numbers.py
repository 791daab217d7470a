"""Read numbers as people type them."""

from __future__ import annotations

_SPACES = dict.fromkeys(map(ord, " \u2009\u00a0\u202f"))
_MINUS = "\u2212"


def number(text: str) -> float:
    """Return the number that a text means; decimal comma and point are both read.

    Raises ValueError where it is none: a comma beside a point may be either sort of mark.
    """
    plain = text.translate(_SPACES).replace(_MINUS, "-")
    if plain.count(",") == 1 and "." not in plain:
        plain = plain.replace(",", ".")
    return float(plain)


def whole(text: str) -> int:
    """Return the whole number that a text means; raise ValueError where it is none."""
    return int(text.translate(_SPACES).replace(_MINUS, "-"))
