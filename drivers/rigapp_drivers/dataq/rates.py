"""Scan rates: 60 MHz / (srate * dec * deca), from checked combinations only; pure.

Wrong combinations were reported to hang an instrument until its power was cycled. A DI-4108 with 8
channels hung at srate 375 and ran at 3000, so every entry of the scan list gets 375 ticks. dec is
the smallest sufficient value of a short list, and deca is 1 except for rates below 2 Hz.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from operator import attrgetter
from typing import Final

from rigapp.texts import SentenceError, joined, say
from rigapp_drivers.dataq.protocol import MASTER_CLOCK_HZ

SMALLEST_SRATE: Final = 375  # of the published range
LARGEST_SRATE: Final = 65535
TICKS_PER_ENTRY: Final = 375
ENCODER_SRATE: Final = 3000
_FACTORS: Final = (
    *(1, 2, 4, 5, 8, 10, 16, 20, 25, 32, 40, 50, 64, 80, 100, 125, 128, 160, 200, 250),
    *(256, 320, 400, 500, 512),
)
DECIMATIONS: Final = (*((dec, 1) for dec in _FACTORS), (500, 10), (500, 100))
"""Pairs of dec (1 to 512) and deca (1 to 40000), in ascending order of their product."""

_ROUNDING: Final = 1e-12  # relative rounding error of a quotient that is a whole number of ticks
_EXACT: Final = 1e-5  # 10 ppm, less than the error of the device's quartz


class NoSuchRate(SentenceError, ValueError):
    """A rate is not available; the sentence names the nearest ones that are."""


@dataclass(frozen=True, slots=True)
class Rate:
    """One checked combination."""

    srate: int
    dec: int
    deca: int

    @property
    def sample_rate_Hz(self) -> float:
        """Return scans per second."""
        return MASTER_CLOCK_HZ / (self.srate * self.dec * self.deca)


def checked(rate: Rate, entries: int) -> bool:
    """Return whether a combination is allowed for a scan list of ``entries`` words."""
    smallest = max(SMALLEST_SRATE, TICKS_PER_ENTRY * entries)
    return (rate.dec, rate.deca) in DECIMATIONS and smallest <= rate.srate <= LARGEST_SRATE


def nearest_rates(sample_rate_Hz: float, entries: int) -> list[Rate]:
    """Return the nearest rates not above and above a requested rate, as far as they exist."""
    smallest = max(SMALLEST_SRATE, TICKS_PER_ENTRY * entries)
    below, above = [], []
    for dec, deca in DECIMATIONS:
        ticks = MASTER_CLOCK_HZ / (sample_rate_Hz * dec * deca)
        below.append(Rate(max(smallest, math.ceil(ticks * (1.0 - _ROUNDING))), dec, deca))
        above.append(Rate(min(LARGEST_SRATE, math.floor(ticks * (1.0 + _ROUNDING))), dec, deca))
    below, above = ([rate for rate in some if checked(rate, entries)] for some in (below, above))
    # For equal rates, max and min return the first, which has the smallest decimation.
    speed = attrgetter("sample_rate_Hz")
    return [best(some, key=speed) for best, some in ((max, below), (min, above)) if some]


def rate_for(sample_rate_Hz: float, entries: int) -> Rate:
    """Return the combination for a rate, exact to 10 ppm; raise NoSuchRate.

    entries: words of the scan list.
    """
    if not (math.isfinite(sample_rate_Hz) and sample_rate_Hz > 0.0):
        raise NoSuchRate("sample_rate_Hz = {:g} is not a rate; give a number > 0.", sample_rate_Hz)
    near = nearest_rates(sample_rate_Hz, entries)
    best = min(near, key=lambda rate: abs(rate.sample_rate_Hz - sample_rate_Hz))
    if abs(best.sample_rate_Hz - sample_rate_Hz) <= _EXACT * sample_rate_Hz:
        return best
    possible = joined(
        say(" or "), (f"{rate:.9g}" for rate in sorted({r.sample_rate_Hz for r in near}))
    )
    raise NoSuchRate(
        "sample_rate_Hz = {:.9g} is not possible with {} entries in the scan list; the"
        " nearest possible: {}.",
        sample_rate_Hz,
        entries,
        possible,
    )


def encoder_rate(entries: int) -> Rate:
    """Return the combination for the encoder clock: no decimation, a base rate known to work."""
    return Rate(max(ENCODER_SRATE, TICKS_PER_ENTRY * entries), 1, 1)
