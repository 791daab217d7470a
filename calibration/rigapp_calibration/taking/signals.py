"""Live readings: the signals of the last seconds, and whether the present step can be taken."""

from __future__ import annotations

import enum
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rigapp.texts import say
from rigapp_calibration.arrays import Array

WINDOW_S = 3.0
"""Length of an evaluated window: a weight that swings at 0.7 Hz shows two periods."""
LISTEN_S = WINDOW_S + 1.0
"""Requested duration; longer than needed because a mean may arrive late."""
WHOLE_S = 0.9 * WINDOW_S - 0.1
"""Length of a complete window: its ends are means of 50 ms, and one may be missing."""
FEWEST_SAMPLES = 20
"""Means of 50 ms over a second: spread and slope are then known within some 15 %."""


class SignalState(enum.StrEnum):
    """State of a window of signals; user interfaces choose a shape for it."""

    WAITING = "waiting"
    MOVING = "moving"
    STEADY = "steady"
    WRONG = "wrong"


Judgement = tuple[SignalState, str]
"""State and reason, in words for the operator."""


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class SignalWindow:
    """The signals of the last seconds. time (n,) s of the device; signal (n, 2) signal units.

    stands: the crank is stationary. noise_share: 1 / sqrt(samples in each mean).
    """

    time: Array
    signal: Array
    stands: bool
    noise_share: float

    @property
    def newest(self) -> float:
        """Return the device time of the newest mean, NaN when there is none."""
        return float(self.time[-1]) if len(self.time) else math.nan


@dataclass(frozen=True, slots=True)
class Steadiness:
    """Whether a window is steady, or why not; its mean (2,) and spread."""

    steady: bool
    reason: str
    mean: Array
    spread: float


@dataclass(frozen=True, slots=True, eq=False)
class Readiness:
    """Whether the step under way can be taken now, and why not in words for the operator.

    felt: value by the calibration in use, SI. left: of the waiting time, s.
    """

    state: SignalState
    words: str
    steadiness: Steadiness
    felt: float
    left: float

    @property
    def ready(self) -> bool:
        """Return whether the step can be taken."""
        return self.state is SignalState.STEADY


def judge(
    time: ArrayLike, signal: ArrayLike, spread_limit: float, slope_limit: float
) -> Steadiness:
    """Evaluate the steadiness of signals (n, 2) at times (s).

    spread_limit: largest standard deviation about a straight line; slope_limit: largest change a
    second; both in signal units. A swinging weight fails by its spread, a creeping or still moving
    one by its slope.
    """
    t = np.asarray(time, dtype=np.float64)
    values = np.asarray(signal, dtype=np.float64)
    if len(t) < FEWEST_SAMPLES or t[-1] <= t[0]:
        return Steadiness(False, say("waiting for samples"), np.full(2, np.nan), np.inf)
    mean = values.mean(axis=0)
    centred = t - t.mean()
    slopes = centred @ (values - mean) / float(centred @ centred)
    rest = values - mean - centred[:, None] * slopes
    spread = float(rest.std(axis=0, ddof=2).max())
    slope_noise = spread / np.sqrt(float(centred @ centred))
    reason = "steady"
    if not np.isfinite(values).all():
        reason = say("the signal is not a number")
    elif spread > spread_limit:
        reason = say("swinging: wait until the weight is still")
    elif np.abs(slopes).max() > slope_limit + 3.0 * slope_noise:
        reason = say("still changing")
    return Steadiness(reason == "steady", reason, mean, spread)


def assess(
    window: SignalWindow,
    *,
    since: float,
    wait: float,
    spread: float,
    slope: float,
    first: Judgement | None,
    set_up: Callable[[Steadiness], Judgement | None],
    felt: Callable[[Array], float],
    unsteady: str = "",
) -> Readiness:
    """Evaluate a window for a step.

    since: device time (s) of the last change; only later signals count. wait: seconds after it.
    spread, slope: limits of steady signals, signal units and signal units per second. first:
    objection that takes precedence over any signal. set_up: judgement of a step without reading,
    None for one with. felt: value of a mean (2,) by the calibration in use. unsteady: words for
    unsteady signals instead of those of their motion.
    """
    fresh = window.time > since
    time, signal = window.time[fresh], window.signal[fresh]
    found = judge(time, signal, spread, slope)
    elapsed = window.newest - since
    left = max(0.0, wait - elapsed) if math.isfinite(elapsed) else 0.0

    def judged() -> Judgement:
        if not len(window.time):
            return SignalState.WAITING, say("waiting for samples")
        if first is not None:
            return first
        if len(time) < 2:
            return SignalState.WAITING, "listening"
        if (nothing_read := set_up(found)) is not None:
            return nothing_read
        if time[-1] - time[0] < WHOLE_S:
            return SignalState.WAITING, "listening"
        if not found.steady:
            numbers = bool(np.isfinite(found.mean).all())
            return SignalState.MOVING, unsteady if numbers and unsteady else found.reason
        if left > 0.0:
            return SignalState.WAITING, say(
                "steady; {} s of the waiting time are left", math.ceil(left)
            )
        return SignalState.STEADY, "steady"

    return Readiness(*judged(), found, felt(found.mean), left)
