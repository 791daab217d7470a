"""Write numbers and their units."""

from __future__ import annotations

import math
from typing import Final

from rigapp.presentation.translation import Text, tr

THIN: Final = "\u202f"
"""Between groups of three digits: a thin space at which no line is broken."""
UNKNOWN: Final = "–"
"""In place of a value that is not known."""

_UNITS: Final[tuple[tuple[str, Text], ...]] = (
    ("um per 1000 revolutions", "µm per 1000 rev"),
    ("standard deviations", "standard deviations"),
    ("revolutions", "rev"),
    ("degC", "°C"),
    ("^2", "²"),
    ("^3", "³"),
    ("um", "µm"),
)
"""How units are written."""


def unit_text(unit: str) -> str:
    """Return a unit as it is written, nothing for a plain number."""
    for plain, nice in _UNITS:
        unit = unit.replace(plain, nice)
    return "" if unit == "1" else tr(unit)


def grouped(number: int) -> str:
    """Return a whole number with thin spaces between groups of three digits."""
    return f"{number:,}".replace(",", THIN)


def axis_number(value: float, step: float) -> str:
    """Return a number at an axis whose numbers are ``step`` apart, with a true minus."""
    decimals = max(0, -math.floor(math.log10(step) + 1e-9))
    text = f"{value:,.{decimals}f}".replace(",", THIN)
    return text.replace("-", "\u2212") if value <= -step / 2.0 else text.lstrip("-")


def capitalised(text: str) -> str:
    """Return a text with a capital first letter, the rest as it is."""
    return text[:1].upper() + text[1:]
