"""The allowed range of a number in a file, at its field: ``Annotated[float, within(0.1, 3000.0)]``.

It is checked by ``config.ranges``, not while a file is read: the values of a recorded test are not
checked again when it is shown.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Final

import msgspec

from rigapp.texts import Sentence, say


@dataclass(frozen=True, slots=True)
class Range:
    """The range of a number, both ends included.

    size: the absolute value is checked. integer: integers only. unit: if the key does not name it.
    """

    low: float
    high: float
    size: bool = False
    integer: bool = False
    unit: str = ""

    def holds(self, value: float) -> bool:
        """Return whether a finite number lies within."""
        return self.low <= (abs(value) if self.size else value) <= self.high

    def words(self, unit: str) -> str:
        """Return the range as part of a sentence."""
        range_ = say("{:.9g} to {:.9g}", self.low, self.high)
        range_ = say("{} {}", range_, Sentence(unit)) if unit else range_
        return range_ + say(", of either sign") if self.size else range_

    def counted(self) -> Range:
        """Return the range restricted to integers."""
        return replace(self, integer=True)


ANY: Final = Range(-math.inf, math.inf)


def within(low: float, high: float, *, size: bool = False, unit: str = "") -> msgspec.Meta:
    """Return the annotation of a number's range; see ``Range``."""
    return msgspec.Meta(extra={"range": Range(low, high, size, unit=unit)})


MOST: Final = 100_000_000
COUNT: Final = within(1, MOST)
IN_A_ROW: Final = within(1, 1_000_000)
LEVEL: Final = within(-math.inf, math.inf)
FACTOR: Final = within(0.01, 100.0)
TURN_DEG: Final = within(-360.0, 360.0)
FORCE_N: Final = within(1.0, 10_000.0)
MASS_KG: Final = within(0.0, 1000.0)
INERTIA_KG_M2: Final = within(0.0, 10.0)
LATENCY_MS: Final = within(0.0, 100.0)
MODULUS_MPA: Final = within(0.1, 2e6)
PRESSURE_MPA: Final = within(0.0, 1e5)
SPEED_M_PER_S: Final = within(0.0, 1000.0)
PRESSURE_VELOCITY: Final = within(0.0, 1e5)
POISSON: Final = within(0.0, 0.499)
