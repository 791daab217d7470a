"""Write numbers and their units."""

from __future__ import annotations

import math
from typing import Final

from rigapp.presentation.translation import Text, tr

THIN: Final = "\u202f"
"""Separator of groups of three digits: a thin space without line break."""
UNKNOWN: Final = "–"
"""Shown for an unknown value."""

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
    """Return a unit as it is written, empty for a plain number."""
    for plain, nice in _UNITS:
        unit = unit.replace(plain, nice)
    return "" if unit == "1" else tr(unit)


def grouped(number: int) -> str:
    """Return a whole number with thin spaces between groups of three digits."""
    return f"{number:,}".replace(",", THIN)


def true_minus(text: str) -> str:
    """Return a written number with a true minus, which is as wide as the plus."""
    return text.replace("-", "\u2212")


def axis_number(value: float, step: float) -> str:
    """Return a number at an axis whose numbers are ``step`` apart, with a true minus."""
    decimals = max(0, -math.floor(math.log10(step) + 1e-9))
    text = f"{value:,.{decimals}f}".replace(",", THIN)
    return true_minus(text) if value <= -step / 2.0 else text.lstrip("-")


def with_uncertainty(value: float, uncertainty: float, unit: str) -> str:
    """Return a value with its unit; with a known expanded uncertainty, value ± U.

    U has two significant digits (JCGM 100, 7.2.6) and the value as many decimals; else one decimal.
    """
    if not math.isfinite(value):
        return UNKNOWN
    if not (math.isfinite(uncertainty) and uncertainty > 0.0):
        return f"{value:.1f} {unit}"
    decimals = _decimals(uncertainty, 2)
    return f"{value:.{decimals}f} ± {uncertainty:.{decimals}f} {unit}"


def _decimals(value: float, digits: int) -> int:
    """Return the decimals that a positive value needs for ``digits`` significant digits."""
    # The exponent of the rounded value: 0.0996 with two digits is 0.10, one place less.
    return max(0, digits - 1 - int(f"{value:.{digits - 1}e}".partition("e")[2]))


COEFFICIENT_UNIT: Final = "10⁻⁶ mm³/(N m)"
"""Of every wear coefficient that is shown: one power of ten, so that any two can be compared."""
COEFFICIENT_SCALE: Final = 1e6
"""From mm³/(N m), as in files, to that unit."""


def coefficient_number(coefficient: float) -> str:
    """Return a wear coefficient (mm³/(N m)) in COEFFICIENT_UNIT with three significant digits."""
    if not (math.isfinite(coefficient) and coefficient > 0.0):
        return UNKNOWN
    scaled = COEFFICIENT_SCALE * coefficient
    return f"{scaled:.{_decimals(scaled, 3)}f}"


def coefficient_text(median: float, low: float, high: float) -> tuple[str, str]:
    """Return a wear coefficient (mm³/(N m)) with its unit, and its 95 % limits in the same unit."""
    limits = tr("{} to {} (95 %)", coefficient_number(low), coefficient_number(high))
    return f"{coefficient_number(median)} · {COEFFICIENT_UNIT}", limits


def bytes_text(size: float) -> str:
    """Return a size of a file or a disk in decimal units."""
    if size >= 1e9:
        return f"{size / 1e9:.3g} GB"
    return f"{size / 1e6:.3g} MB" if size >= 1e5 else f"{size / 1e3:.3g} kB"
