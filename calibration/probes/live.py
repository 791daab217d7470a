"""Live probe readings: a window of voltages, its judgement, and what it means for the step."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from calibration.load_cell.live import WINDOW_S, Readiness, Verdict
from calibration.probes.procedure import ProbeStep, ProbeStepKind
from calibration.taking.stability import Steadiness, judge

Array = NDArray[np.float64]
SPREAD_VOLTS = 0.002
"""Part of the probe's range that a steady voltage may spread, beside the noise of its samples."""
SLOPE_VOLTS = 2e-4


@dataclass(frozen=True, slots=True, eq=False)
class ProbeWindow:
    """The voltages of the last seconds. time (n,) s of the device; signal (n, 2) V.

    noise_share: 1 / sqrt(samples in each mean). sensitivity (2,) m/V, offset (2,) V: the
    calibration in use. range_volts: of the inputs.
    """

    time: Array
    signal: Array
    stands: bool
    noise_share: float
    sensitivity: Array
    offset: Array
    range_volts: float = 10.0

    @property
    def newest(self) -> float:
        """Return the device time of the newest mean, NaN when there is none."""
        return float(self.time[-1]) if len(self.time) else math.nan


def assess_probe(window: ProbeWindow, step: ProbeStep, since: float, wait: float) -> Readiness:
    """Judge a window for a step; ``felt`` is the position (m) that the calibration in use shows.

    since: device time (s) of the last change; only what came after it counts. wait: seconds that
    must pass after it.
    """
    fresh = window.time > since
    time, signal = window.time[fresh], window.signal[fresh]
    spread = window.range_volts * SPREAD_VOLTS * (0.25 + window.noise_share)
    found = judge(time, signal, spread, window.range_volts * SLOPE_VOLTS)
    probe = step.probe - 1
    felt = float(window.sensitivity[probe] * (found.mean[probe] - window.offset[probe]))
    elapsed = window.newest - since
    left = max(0.0, wait - elapsed) if math.isfinite(elapsed) else 0.0
    verdict, words = _words(window, step, found, left, time)
    return Readiness(verdict, words, found, felt, left)


def _words(
    window: ProbeWindow, step: ProbeStep, found: Steadiness, left: float, time: Array
) -> tuple[Verdict, str]:
    if not len(window.time):
        return Verdict.WAITING, "waiting for samples"
    if not window.stands:
        return Verdict.MOVING, "the crank turns; it must stand"
    if len(time) < 2 or time[-1] - time[0] < 0.9 * WINDOW_S - 0.1:
        return Verdict.WAITING, "listening"
    if step.kind is ProbeStepKind.MOUNT:
        shown = float(found.mean[step.probe - 1])
        if abs(shown) > 0.25 * window.range_volts:
            return (
                Verdict.WAITING,
                f"probe {step.probe} shows {shown:+.2f} V; move it or the target until it shows"
                " about 0 V",
            )
        return Verdict.STEADY, f"probe {step.probe} shows {shown:+.2f} V"
    if not found.steady:
        words = "the voltage is not a number" if "number" in found.reason else "still moving"
        return Verdict.MOVING, words
    if left > 0.0:
        return Verdict.WAITING, f"steady; {math.ceil(left)} s of the waiting time are left"
    return Verdict.STEADY, "steady"
