"""The probe calibration as data: the micrometer set up before a probe, steps up and down.

For one probe or one after the other for both. Both probes are read each time: the one at
rest shows whether the right one was moved, and the angle of the pair against the micrometer.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict, dataclass

import numpy as np

from rigapp.texts import say
from rigapp_calibration.arrays import Array
from rigapp_calibration.probes.readings import FEWEST_POSITIONS, ProbeReadings
from rigapp_calibration.taking.procedure import (
    Event,
    Method,
    Procedure,
    ProcedureError,
    Step,
    StepKind,
)
from rigapp_calibration.taking.signals import (
    Judgement,
    Readiness,
    SignalState,
    SignalWindow,
    Steadiness,
    assess,
)

MOST_POSITIONS = 101
"""Steps of a hundredth of the range: a micrometer screw is no finer."""
MOST_RUNS = 10
"""More runs take a day, in which temperature moves the probe by more than they gain."""
SETTLE_S = 5.0
"""The target is at rest a second after the hand has left the screw; the filter takes the rest."""
HANDLING_S = 15.0
MOUNTING_S = 300.0
"""Seconds for a step, and for setting the micrometer up; for the estimate of the time left."""
OVERSHOOT = 0.5
"""Part of a step by which the micrometer overshoots a position approached from above."""


@dataclass(frozen=True, slots=True)
class ProbePlan:
    """Plan of a probe calibration: probes (1, 2), largest position (m), positions, runs."""

    probes: tuple[int, ...]
    reach: float
    positions: int = 11
    runs: int = 3

    @property
    def step_size(self) -> float:
        """Return the distance of two positions, m."""
        return 2.0 * self.reach / (self.positions - 1)

    def steps(self) -> tuple[Step, ...]:
        """Return the steps; raise ProcedureError for an impossible plan."""
        if self.probes not in ((1,), (2,), (1, 2)):
            raise ProcedureError("the probes are 1, 2, or both")
        if not (math.isfinite(self.reach) and self.reach > 0.0):
            raise ProcedureError("the reach of the micrometer is a length above 0")
        if not FEWEST_POSITIONS <= self.positions <= MOST_POSITIONS:
            raise ProcedureError("take {} to {} positions", FEWEST_POSITIONS, MOST_POSITIONS)
        if not 1 <= self.runs <= MOST_RUNS:
            raise ProcedureError("take 1 to {} runs up and down", MOST_RUNS)
        return tuple(step for probe in self.probes for step in self._steps(probe))

    def _steps(self, probe: int) -> Iterator[Step]:
        words: str = say(
            (
                "Put the micrometer's target in front of probe {}, at right angles to it, and"
                " turn the micrometer until probe {} shows about 0 V: that is position 0."
                " Nothing may move in front of the other probe."
            ),
            probe,
            probe,
        )
        yield Step(StepKind.SET_UP, words, float(probe), handling=MOUNTING_S)
        line = np.linspace(-self.reach, self.reach, self.positions)
        rising = [round(x, 9) for x in line.tolist()]
        course = [(x, False) for x in rising] + [(x, True) for x in rising[-2::-1]]
        for run in range(1, self.runs + 1):
            for number, (x, falling) in enumerate(course, 1):
                words = self._words(probe, number, x, falling=falling)
                yield Step(
                    StepKind.READING, words, float(probe), x, (), f"{probe}.{run}", number,
                    SETTLE_S, HANDLING_S, falling,
                )  # fmt: skip

    def _words(self, probe: int, number: int, position: float, *, falling: bool) -> str:
        at = say("{:g} um", 1e6 * position)
        past = say("{:g} um", 1e6 * (position - OVERSHOOT * self.step_size))
        if number == 1:
            return say("Turn the micrometer {} back to {}, then forward to {}.", probe, past, at)
        if falling:
            return say(
                "Turn the micrometer {} back past the position, to {}, then forward to {}.",
                probe,
                past,
                at,
            )
        return say("Turn the micrometer {} forward to {}. Do not turn past it.", probe, at)


# --- the journal ----------------------------------------------------------------------------------


def _plan(event: Event) -> ProbePlan:
    if event.get("what") != "probes":
        raise ProcedureError("it is not the journal of a probe calibration")
    return ProbePlan(tuple(event["probes"]), event["reach"], event["positions"], event["runs"])


MEASURING = Method(
    told=lambda plan: {"what": "probes", **asdict(plan), "probes": list(plan.probes)},
    plan=_plan,
    set_up="mounted",
    place="probe",
    value="position",
    wrongly=lambda probe, step: (
        "" if probe == step.set_up else say("probe {:g} is set up, not {:g}", probe, step.set_up)
    ),
    afresh=False,
)


def probe_readings(procedure: Procedure[ProbePlan], probe: int) -> ProbeReadings:
    """Return the valid readings of a probe, in the order taken."""
    series, step, position, _, signal = procedure.columns(of=lambda step: step.set_up == probe)
    return ProbeReadings(series, step, position, signal[:, probe - 1], signal[:, 2 - probe])


SPREAD_OF_RANGE = 0.002
"""Part of the probe's range that a steady voltage may spread, besides the noise of its samples:
a tenth of the smallest fault that the checks name (a hundredth of the span)."""
SLOPE_OF_RANGE = 2e-4
"""Part of the range by which a steady voltage may change in a second: less than the checks detect
in the time of a run."""
NEAR_ZERO = 0.25
"""Part of the range: a target set up this near to 0 V leaves room for the run in either
direction."""


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class ProbeWindow(SignalWindow):
    """The voltages of the last seconds.

    sensitivity (2,) m/V, offset (2,) V: the calibration in use. range_volts: of the inputs.
    """

    sensitivity: Array
    offset: Array
    range_volts: float = 10.0


def assess_probe(window: ProbeWindow, step: Step, since: float, wait: float) -> Readiness:
    """Evaluate a window for a step; ``felt``: position (m) by the calibration in use.

    since, wait: see ``assess``.
    """
    probe = int(step.set_up or 1) - 1
    return assess(
        window,
        since=since,
        wait=wait,
        spread=window.range_volts * SPREAD_OF_RANGE * (0.25 + window.noise_share),
        slope=window.range_volts * SLOPE_OF_RANGE,
        first=None if window.stands else (SignalState.MOVING, say("Stop the crank first")),
        set_up=lambda found: _mounted(window, step, found),
        felt=lambda mean: float(window.sensitivity[probe] * (mean[probe] - window.offset[probe])),
        unsteady=say("still moving"),
    )


def _mounted(window: ProbeWindow, step: Step, found: Steadiness) -> Judgement | None:
    if step.kind is not StepKind.SET_UP:
        return None
    probe = int(step.set_up or 1)
    shown = float(found.mean[probe - 1])
    if math.isnan(shown):
        return SignalState.WAITING, "listening"
    words = say("probe {} shows {:+.2f} V", probe, shown)
    if abs(shown) > NEAR_ZERO * window.range_volts:
        return SignalState.WAITING, say("{}; move it or the target until it shows about 0 V", words)
    return SignalState.STEADY, words
