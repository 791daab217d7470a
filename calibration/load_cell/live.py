"""Live readings: a window of signals, its judgement, and what it means for the step under way."""

from __future__ import annotations

import enum
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from calibration.load_cell.plans import Step, StepKind
from calibration.load_cell.two_axis import forces
from calibration.taking.stability import Steadiness, judge

WINDOW_S = 3.0
ANGLE_TOLERANCE = math.radians(5.0)
Array = NDArray[np.float64]


class Verdict(enum.StrEnum):
    """How a window looks: a word, for which a face chooses a shape."""

    WAITING = "waiting"
    MOVING = "moving"
    STEADY = "steady"


@dataclass(frozen=True, slots=True, eq=False)
class Window:
    """The signals of the last seconds. time (n,) s of the device; signal (n, 2) signal units.

    angle: of the pin (rad) from the encoder, None while its index has not been passed. noise_share:
    1 / sqrt(samples in each mean). matrix (2, 2), zero (2,), quadratic (2, 3) or
    None: the calibration in use.
    """

    time: Array
    signal: Array
    angle: float | None
    stands: bool
    noise_share: float
    matrix: Array
    zero: Array
    quadratic: Array | None = None

    @property
    def newest(self) -> float:
        """Return the device time of the newest mean, NaN when there is none."""
        return float(self.time[-1]) if len(self.time) else math.nan

    def force(self, signal: Array) -> Array:
        """Return the force on the pin (2,) that the calibration in use makes of a signal (2,)."""
        return forces(signal, self.matrix, self.zero, self.quadratic)[0]


@dataclass(frozen=True, slots=True, eq=False)
class Readiness:
    """Whether the step under way can be taken now, and why not in words for the operator."""

    verdict: Verdict
    words: str
    steadiness: Steadiness
    felt: float
    left: float

    @property
    def ready(self) -> bool:
        """Tell whether the step can be taken."""
        return self.verdict is Verdict.STEADY


def assess(window: Window, step: Step, resolution: float, since: float, wait: float) -> Readiness:
    """Judge a window for a step.

    resolution: of the cell, N. since: device time (s) of the last change; only what came after it
    counts. wait: seconds that must pass after it. A quarter of the resolution may be spread and a
    twentieth of it a second slope.
    """
    fresh = window.time > since
    time, signal = window.time[fresh], window.signal[fresh]
    per_newton = 1.0 / max(float(np.sqrt(abs(np.linalg.det(window.matrix)))), 1e-12)
    spread = resolution * (0.25 + 0.6 * window.noise_share) * per_newton
    found = judge(time, signal, spread, resolution / 20.0 * per_newton)
    felt = float(np.hypot(*window.force(found.mean)))
    elapsed = window.newest - since
    left = max(0.0, wait - elapsed) if math.isfinite(elapsed) else 0.0
    verdict, words = _words(window, step, found, left, time)
    return Readiness(verdict, words, found, felt, left)


def _words(
    window: Window, step: Step, found: Steadiness, left: float, time: Array
) -> tuple[Verdict, str]:
    if not len(window.time):
        return Verdict.WAITING, "waiting for samples"
    if window.angle is None:
        return (
            Verdict.WAITING,
            "the angle is not known yet: turn the crank by hand once past the encoder's index",
        )
    if not window.stands:
        return Verdict.MOVING, "the crank turns"
    if len(time) < 2:
        return Verdict.WAITING, "listening"
    if step.kind is StepKind.ANGLE_REFERENCE:
        return Verdict.STEADY, "the crank stands"
    off = float(np.angle(np.exp(1j * (window.angle - step.angle))))
    if abs(off) > ANGLE_TOLERANCE:
        return (
            Verdict.WAITING,
            f"the encoder shows {math.degrees(window.angle):.1f} degrees;"
            f" turn the pin to {math.degrees(step.angle):.0f} degrees",
        )
    if step.kind is StepKind.TURN:
        return Verdict.STEADY, f"the pin stands at {math.degrees(window.angle):.1f} degrees"
    if time[-1] - time[0] < 0.9 * WINDOW_S - 0.1:
        return Verdict.WAITING, "listening"
    if not found.steady:
        return Verdict.MOVING, found.reason
    if left > 0.0:
        return Verdict.WAITING, f"steady; {math.ceil(left)} s of the waiting time are left"
    return Verdict.STEADY, "steady"
