"""Write dates and lengths of time."""

from __future__ import annotations

import math
import time
from typing import Final

from rigapp.presentation.numbers import UNKNOWN
from rigapp.presentation.translation import tr

MOMENT: Final = "%a %d %b, %H:%M"
"""How a moment of these weeks is written, for ``dated``."""


def dated(pattern: str, moment: time.struct_time) -> str:
    """Return a moment by a pattern of ``strftime``, names of day and month in our language."""
    for name in ("%a", "%b"):
        if name in pattern:
            pattern = pattern.replace(name, tr(time.strftime(name, moment)))
    return time.strftime(pattern, moment)


def duration(seconds: float, *, exact: bool = False) -> str:
    """Return a length of time in the two largest units that matter.

    exact: with parts of a second below 100 s, with seconds below 1 h; a display that counts down
    has whole seconds, and minutes from 10 min on.
    """
    if not math.isfinite(seconds):
        return UNKNOWN
    if exact and abs(seconds) < 99.95:
        return f"{seconds:.2f} s" if abs(seconds) < 9.995 else f"{seconds:.1f} s"
    minutes, rest = divmod(round(seconds) if exact else int(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    days, hours = divmod(hours, 24)
    if days:
        return f"{days} d {hours} h"
    if hours:
        return f"{hours} h {minutes} min"
    if minutes:
        return f"{minutes} min" if minutes >= 10 and not exact else f"{minutes} min {rest} s"
    return f"{rest} s"
