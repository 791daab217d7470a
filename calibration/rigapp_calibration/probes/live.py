"""Live readings of the probes: is the voltage steady, does the target stand before the probe?"""

from __future__ import annotations

import math
from dataclasses import dataclass

from rigapp_calibration.arrays import Array
from rigapp_calibration.taking.procedure import Step, StepKind
from rigapp_calibration.taking.signals import (
    Judgement,
    Readiness,
    SignalState,
    SignalWindow,
    Steadiness,
    assess,
)

SPREAD_OF_RANGE = 0.002
"""Part of the probe's range that a steady voltage may spread, beside the noise of its samples:
a tenth of the smallest fault that the checks name (a hundredth of the span)."""
SLOPE_OF_RANGE = 2e-4
"""Part of the range by which a steady voltage may change in a second: less than the checks tell in
the time that a run takes."""
NEAR_ZERO = 0.25
"""Part of the range: a target that is set up so near to 0 V leaves room for the run either way."""


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class ProbeWindow(SignalWindow):
    """The voltages of the last seconds.

    sensitivity (2,) m/V, offset (2,) V: the calibration in use. range_volts: of the inputs.
    """

    sensitivity: Array
    offset: Array
    range_volts: float = 10.0


def assess_probe(window: ProbeWindow, step: Step, since: float, wait: float) -> Readiness:
    """Judge a window for a step; ``felt`` is the position (m) that the calibration in use shows.

    since, wait: see ``assess``.
    """
    probe = int(step.set_up or 1) - 1
    return assess(
        window,
        since=since,
        wait=wait,
        spread=window.range_volts * SPREAD_OF_RANGE * (0.25 + window.noise_share),
        slope=window.range_volts * SLOPE_OF_RANGE,
        first=None if window.stands else (SignalState.MOVING, "the crank turns; it must stand"),
        set_up=lambda found: _mounted(window, step, found),
        felt=lambda mean: float(window.sensitivity[probe] * (mean[probe] - window.offset[probe])),
        unsteady="still moving",
    )


def _mounted(window: ProbeWindow, step: Step, found: Steadiness) -> Judgement | None:
    if step.kind is not StepKind.SET_UP:
        return None
    probe = int(step.set_up or 1)
    shown = float(found.mean[probe - 1])
    if math.isnan(shown):
        return SignalState.WAITING, "listening"
    words = f"probe {probe} shows {shown:+.2f} V"
    if abs(shown) > NEAR_ZERO * window.range_volts:
        return SignalState.WAITING, f"{words}; move it or the target until it shows about 0 V"
    return SignalState.STEADY, words
