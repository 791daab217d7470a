"""The angle reference: a level on the crank's flat, better turned end for end.

A level's own error e shows the crank level while it stands at e. Turned end for end it shows it at
- e: the mean of the two encoder angles is free of e, and half their difference is e.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

LARGEST_LEVEL_ERROR = math.radians(1.0)
"""A machinist's level is ten times better; more means another flat, or a bubble off its middle."""


class LevelError(ValueError):
    """Say why two readings cannot be of one level on one flat."""


@dataclass(frozen=True, slots=True)
class LevelReading:
    """The encoder's angle with the crank level, its standard uncertainty, the level's error; rad.

    The level's own error is known where it was turned.
    """

    angle: float
    uncertainty: float
    level_error: float | None


def single(shown: float, uncertainty: float) -> LevelReading:
    """Take one reading (rad); the uncertainty is the level's, its own error included."""
    return LevelReading(_near_zero(shown), uncertainty, None)


def reversed_level(first: float, second: float, setting: float) -> LevelReading:
    """Take two readings (rad), the level turned end for end between them.

    setting: standard uncertainty of bringing the bubble to the middle once, rad; of the mean it is
    1 / sqrt(2). Raises LevelError when the level would be off by more than a degree.
    """
    one, two = _near_zero(first), _near_zero(second)
    half = 0.5 * (one - two)
    if abs(half) > LARGEST_LEVEL_ERROR:
        raise LevelError(
            f"the two angles differ by {abs(math.degrees(2.0 * half)):.2f} degrees; was the level"
            " on the same flat both times, and the bubble in the middle?"
        )
    return LevelReading(0.5 * (one + two), setting / math.sqrt(2.0), half)


def _near_zero(angle: float) -> float:
    return math.remainder(angle, 2.0 * math.pi)
