"""A probe calibration in progress: the micrometer set up before a probe, steps up and down.

For one probe or one after the other for both. At every reading both probes are read: the one that
must not move says whether the right one was moved, and how far the pair is turned against the
micrometer.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Self

import numpy as np

from calibration.probes.readings import FEWEST_POSITIONS, ProbeReadings
from calibration.taking.procedure import (
    Event,
    Procedure,
    ProcedureError,
    Signals,
    TakenReading,
    both_signals,
    replay,
)

MOST_POSITIONS = 101
"""Steps of a hundredth of the range: a micrometer screw is no finer."""
MOST_RUNS = 10
"""More than these take a day; the temperature moves the probe more than they tell."""
SETTLE_S = 5.0
"""The target stands still a second after the hand has left the screw; the filter takes the rest."""
HANDLING_S = 15.0
MOUNTING_S = 300.0
"""Seconds that a technician needs for a step, and to set the micrometer up; for the time left."""
OVERSHOOT = 0.5
"""Part of a step by which the micrometer is turned past a position that is come back to."""


class ProbeStepKind(enum.StrEnum):
    """What the operator does in a step."""

    MOUNT = "mount"
    READING = "reading"


@dataclass(frozen=True, slots=True)
class ProbeStep:
    """One step: which probe is moved, its series and number, the position (m), waiting time (s)."""

    kind: ProbeStepKind
    probe: int
    series: str = ""
    number: int = 0
    position: float = 0.0
    wait: float = 0.0
    falling: bool = False

    @property
    def set_up(self) -> float | None:
        """Return the probe before which the micrometer stands."""
        return float(self.probe)

    @property
    def effort(self) -> float:
        """Return the seconds that the step takes a technician."""
        return MOUNTING_S if self.kind is ProbeStepKind.MOUNT else self.wait + HANDLING_S


@dataclass(frozen=True, slots=True)
class ProbePlan:
    """What is taken: probes (1, 2), largest position (m), positions, runs up and down."""

    probes: tuple[int, ...]
    reach: float
    positions: int = 11
    runs: int = 3

    @property
    def step_size(self) -> float:
        """Return the distance of two positions, m."""
        return 2.0 * self.reach / (self.positions - 1)

    def steps(self) -> tuple[ProbeStep, ...]:
        """Return the steps; raise ProcedureError for an impossible plan."""
        if self.probes not in ((1,), (2,), (1, 2)):
            raise ProcedureError("the probes are 1, 2, or both")
        if not (math.isfinite(self.reach) and self.reach > 0.0):
            raise ProcedureError("the reach of the micrometer is a length above 0")
        if not FEWEST_POSITIONS <= self.positions <= MOST_POSITIONS:
            raise ProcedureError(f"take {FEWEST_POSITIONS} to {MOST_POSITIONS} positions")
        if not 1 <= self.runs <= MOST_RUNS:
            raise ProcedureError(f"take 1 to {MOST_RUNS} runs up and down")
        line = np.linspace(-self.reach, self.reach, self.positions)
        rising = [round(x, 9) for x in line.tolist()]
        course = [(x, False) for x in rising] + [(x, True) for x in rising[-2::-1]]
        kind = ProbeStepKind.READING
        steps: list[ProbeStep] = []
        for probe in self.probes:
            steps.append(ProbeStep(ProbeStepKind.MOUNT, probe))
            steps += [
                ProbeStep(kind, probe, f"{probe}.{run}", number, x, SETTLE_S, falling)
                for run in range(1, self.runs + 1)
                for number, (x, falling) in enumerate(course, 1)
            ]
        return tuple(steps)


@dataclass(frozen=True, slots=True, kw_only=True)
class MicrometerReading(TakenReading):
    """A reading at a position of the micrometer (m): the voltages of both probes."""

    position: float


@dataclass(frozen=True, slots=True, kw_only=True)
class ProbeProcedure(Procedure[ProbeStep, MicrometerReading]):
    """The state of a probe calibration."""

    plan: ProbePlan

    def instruct(self) -> str:
        """Return what the operator does at the present step."""
        step, um = self.step, 1e6
        if step.kind is ProbeStepKind.MOUNT:
            return (
                f"Put the micrometer's target before probe {step.probe}, at right angles to it, and"
                f" turn the micrometer until probe {step.probe} shows about 0 V: that is position"
                " 0. Nothing may move before the other probe."
            )
        at = f"{um * step.position:g} um"
        past = f"{um * (step.position - OVERSHOOT * self.plan.step_size):g} um"
        if step.number == 1:
            return f"Turn the micrometer {step.probe} back to {past}, then forward to {at}."
        if step.falling:
            return (
                f"Turn the micrometer {step.probe} back past the position, to {past}, then forward"
                f" to {at}."
            )
        return f"Turn the micrometer {step.probe} forward to {at}. Do not turn past it."

    # --- events ----------------------------------------------------------------------------------

    def mounted(self) -> Self:
        """Take note that the target stands before the probe of the step."""
        if self.step.kind is not ProbeStepKind.MOUNT:
            raise ProcedureError("now comes a reading, not mounting")
        return self.go_on({"event": "mounted", "probe": self.step.probe})

    def record(self, position: float, signal: Signals, spread: float, time: float) -> Self:
        """Take the reading of the present step at a position (m); both voltages are kept.

        Raises ProcedureError when it cannot be one.
        """
        step = self.step
        if step.kind is not ProbeStepKind.READING:
            raise ProcedureError(f"mount the micrometer before probe {step.probe} first")
        if math.isfinite(signal[step.probe - 1]) and not math.isfinite(signal[2 - step.probe]):
            raise ProcedureError("the other probe's signal is not a number; check its cable")
        values = both_signals(signal, position)
        reading = MicrometerReading(
            step=self.position,
            position=float(position),
            signal=values,
            spread=float(spread),
            time=time,
        )
        return self.keep(reading, position=reading.position)

    def stands_for(self, step: ProbeStep) -> bool:
        """Tell whether the micrometer stands before the probe of a step."""
        mounted = [int(event["probe"]) for event in self.events if event["event"] == "mounted"]
        return mounted[-1:] == [step.probe]

    # --- results ---------------------------------------------------------------------------------

    def readings(self, probe: int) -> ProbeReadings:
        """Return the readings of a probe that stand, in the order taken."""
        kept = [
            one for one in self.taken if not one.rejected and self.steps[one.step].probe == probe
        ]
        steps = [self.steps[one.step] for one in kept]
        return ProbeReadings(
            series=tuple(step.series for step in steps),
            step=np.array([step.number for step in steps], dtype=np.int64),
            position=np.array([one.position for one in kept], dtype=np.float64),
            signal=np.array([one.signal[probe - 1] for one in kept], dtype=np.float64),
            other=np.array([one.signal[2 - probe] for one in kept], dtype=np.float64),
        )


def begin_probes(plan: ProbePlan) -> ProbeProcedure:
    """Begin a probe calibration."""
    event = {
        "event": "begin",
        "what": "probes",
        "probes": list(plan.probes),
        "reach": plan.reach,
        "positions": plan.positions,
        "runs": plan.runs,
    }
    return ProbeProcedure(plan=plan, steps=plan.steps(), events=(event,))


def take_up_probes(events: Iterable[Event]) -> ProbeProcedure:
    """Return the procedure that a journal tells; raise ProcedureError where it makes no sense."""
    return replay(
        events,
        _begun,
        {
            "mounted": lambda p, e: p.mounted(),
            "record": lambda p, e: p.record(e["position"], e["signal"], e["spread"], e["time"]),
        },
    )


def _begun(event: Event) -> ProbeProcedure:
    if event.get("what") != "probes":
        raise ProcedureError("it is not the journal of a probe calibration")
    return begin_probes(
        ProbePlan(tuple(event["probes"]), event["reach"], event["positions"], event["runs"])
    )
