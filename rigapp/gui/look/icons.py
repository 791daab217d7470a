"""Icons by meaning, from one set (Phosphor), drawn in a colour of the theme."""

from __future__ import annotations

import enum
from functools import cache
from pathlib import Path

import qtawesome
from PySide6.QtGui import QIcon
from qtawesome.iconic_font import IconicFont


class Icon(enum.StrEnum):
    """Name an icon by its meaning; the value is its name in the set."""

    WATCH = "ph.activity"
    PREPARE = "ph.clipboard-text"
    RIG = "ph.gear-six"
    RESULTS = "ph.folder-open"
    SETTINGS = "ph.sliders-horizontal"
    HELP = "ph.question"
    CONNECT = "ph.link"
    START = "ph.play"
    PAUSE = "ph.pause"
    STOP = "ph.stop-fill"
    NOTE = "ph.note-pencil"
    CALIBRATE = "ph.scales"
    FILE = "ph.file-text"
    TRY = "ph.flask"
    WARNING = "ph.warning-fill"
    CRITICAL = "ph.warning-octagon-fill"
    FINE = "ph.check"
    COMPLETE = "ph.check-circle-fill"
    ENDED = "ph.square"
    TRIPPED = "ph.diamond-fill"
    UNREADABLE = "ph.file-x"
    COMPARE = "ph.chart-line"
    SPECIMEN = "ph.cube"
    NEXT = "ph.arrow-right"
    NOW = "ph.arrow-circle-right-fill"
    LATER = "ph.circle"
    AGAIN = "ph.arrow-counter-clockwise"


def icon(meaning: Icon, colour: str, disabled: str | None = None) -> QIcon:
    """Return an icon in a colour, and in another one while its button is disabled."""
    result: QIcon = _phosphor().icon(
        meaning.value, color=colour, color_disabled=disabled or colour, scale_factor=1.0
    )
    return result


@cache
def _phosphor() -> IconicFont:
    """Load only the set in use; the package's own function loads all twelve."""
    fonts = Path(qtawesome.__file__).parent / "fonts"
    font, names = (next(fonts.glob(f"phosphor-*.{ending}")).name for ending in ("ttf", "json"))
    return IconicFont(("ph", font, names))
