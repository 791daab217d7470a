"""Numbers as the window writes them."""

from __future__ import annotations

import math
import time
from typing import Final

from rigapp.gui.language.words import Text, tr

_UNITS: Final[tuple[tuple[str, Text], ...]] = (
    ("um per 1000 revolutions", "µm per 1000 rev"),
    ("standard deviations", "standard deviations"),
    ("revolutions", "rev"),
    ("degC", "°C"),
    ("^2", "²"),
    ("^3", "³"),
    ("um", "µm"),
)
"""How the window writes units."""


MOMENT: Final = "%a %d %b, %H:%M"
"""How a moment of these weeks is written, for ``dated``."""


def unit_text(unit: str) -> str:
    """Return a unit as the window writes it, nothing for a plain number."""
    for plain, nice in _UNITS:
        unit = unit.replace(plain, nice)
    return "" if unit == "1" else tr(unit)


def grouped(number: int) -> str:
    """Return a whole number with thin spaces between groups of three digits."""
    return f"{number:,}".replace(",", "\u2009")


def axis_number(value: float, step: float) -> str:
    """Return a number at an axis whose numbers are ``step`` apart, with a true minus."""
    decimals = max(0, -math.floor(math.log10(step) + 1e-9))
    text = f"{value:,.{decimals}f}".replace(",", "\u2009")
    return text.replace("-", "\u2212") if value <= -step / 2.0 else text.lstrip("-")


def dated(pattern: str, moment: time.struct_time) -> str:
    """Return a moment by a pattern of ``strftime``, names of day and month in our language."""
    for name in ("%a", "%b"):
        if name in pattern:
            pattern = pattern.replace(name, tr(time.strftime(name, moment)))
    return time.strftime(pattern, moment)


def duration(seconds: float) -> str:
    """Return a length of time in the two largest units that matter."""
    if not math.isfinite(seconds):
        return "–"
    minutes, rest = divmod(int(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    days, hours = divmod(hours, 24)
    if days:
        return f"{days} d {hours} h"
    if hours:
        return f"{hours} h {minutes} min"
    if minutes:
        return f"{minutes} min" if minutes >= 10 else f"{minutes} min {rest} s"
    return f"{rest} s"
