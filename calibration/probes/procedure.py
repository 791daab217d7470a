"""A probe calibration in progress, as a pure state machine: events in, state out.

Micrometer steps up and down, for one probe or one after the other for both. At every reading both
probes are read: the one that must not move says whether the right one was moved, and how far the
pair is turned against the micrometer. Every event is a small mapping that the caller appends to a
journal at once; replaying the journal gives the state back. A reading can be rejected with a
reason, never erased.

::

    mount --mounted--> step --record--> next step --record--> ... --record--> done
                        ^                    |
                        +------reject--------+     (the reading's series is taken again)
"""

from __future__ import annotations

import enum
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from calibration.load_cell.procedure import ProcedureError
from calibration.probes.readings import ProbeReadings

FEWEST_POSITIONS = 5
MOST_POSITIONS = 101
MOST_RUNS = 10
SETTLE_S = 5.0
HANDLING_S = 15.0
MOUNTING_S = 300.0
OVERSHOOT = 0.5
"""Part of a step by which the micrometer is turned past a position that is come back to."""


class ProbeStepKind(enum.StrEnum):
    """What the operator does in a step."""

    MOUNT = "mount"
    READING = "reading"


@dataclass(frozen=True, slots=True)
class ProbePlan:
    """What is taken: probes (1, 2), largest position (m), positions, runs up and down."""

    probes: tuple[int, ...]
    reach: float
    positions: int = 11
    runs: int = 3


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


@dataclass(frozen=True, slots=True)
class ProbeTaken:
    """One reading as taken: which step, position (m), voltages of both probes, when (UTC s)."""

    step: int
    position: float
    signal: tuple[float, float]
    spread: float
    time: float
    rejected: str = ""


@dataclass(frozen=True, slots=True)
class ProbeProcedure:
    """The state of a probe calibration."""

    plan: ProbePlan
    steps: tuple[ProbeStep, ...]
    position: int = 0
    taken: tuple[ProbeTaken, ...] = ()
    events: tuple[Mapping[str, Any], ...] = field(default=(), repr=False)

    @property
    def done(self) -> bool:
        """Tell whether every step has been taken."""
        return self.position >= len(self.steps)

    @property
    def step(self) -> ProbeStep:
        """Return the step to do now; raise ProcedureError when all are done."""
        if self.done:
            raise ProcedureError("every step of the plan has been taken")
        return self.steps[self.position]

    @property
    def step_size(self) -> float:
        """Return the distance of two positions, m."""
        return 2.0 * self.plan.reach / (self.plan.positions - 1)

    @property
    def instruction(self) -> str:
        """Return what the operator does now, as a technician would say it."""
        if self.done:
            return "All readings are taken. Look at the result."
        step, um = self.step, 1e6
        if step.kind is ProbeStepKind.MOUNT:
            return (
                f"Put the micrometer's target before probe {step.probe}, at right angles to it, and"
                f" turn the micrometer until probe {step.probe} shows about 0 V: that is position"
                " 0. Nothing may move before the other probe."
            )
        at = f"{um * step.position:g} um"
        past = f"{um * (step.position - OVERSHOOT * self.step_size):g} um"
        if step.number == 1:
            return f"Turn the micrometer {step.probe} back to {past}, then forward to {at}."
        if step.falling:
            return (
                f"Turn the micrometer {step.probe} back past the position, to {past}, then forward"
                f" to {at}."
            )
        return f"Turn the micrometer {step.probe} forward to {at}. Do not turn past it."

    @property
    def progress(self) -> str:
        """Return where the calibration stands: step n of N, time left."""
        left = math.ceil(time_needed(self.steps[self.position :]) / 60.0)
        hours, minutes = divmod(left, 60)
        time_left = f"{hours} h {minutes} min" if hours else f"{minutes} min"
        count = len(self.steps)
        return f"step {min(self.position + 1, count)} of {count}, {time_left} left"

    @property
    def under_way(self) -> str:
        """Return the series that is begun but not complete, empty between two series."""
        if self.done or not self.step.series:
            return ""
        series = self.step.series
        begun = any(not t.rejected and self.steps[t.step].series == series for t in self.taken)
        return series if begun else ""

    # --- events ----------------------------------------------------------------------------------

    def mounted(self) -> ProbeProcedure:
        """Take note that the target stands before the probe of the step."""
        if self.step.kind is not ProbeStepKind.MOUNT:
            raise ProcedureError("now comes a reading, not mounting")
        return self._next({"event": "mounted", "probe": self.step.probe})

    def record(
        self, position: float, signal: Sequence[float], spread: float, time: float
    ) -> ProbeProcedure:
        """Take the reading of the present step at a position (m); both voltages are kept.

        Raises ProcedureError when it cannot be one.
        """
        step = self.step
        if step.kind is not ProbeStepKind.READING:
            raise ProcedureError(f"mount the micrometer before probe {step.probe} first")
        values = (float(signal[0]), float(signal[1]))
        if not np.isfinite([position, values[step.probe - 1]]).all():
            raise ProcedureError("the reading is not a number; check cable and amplifier")
        if not math.isfinite(values[2 - step.probe]):
            raise ProcedureError("the other probe's signal is not a number; check its cable")
        event = {
            "event": "record",
            "position": float(position),
            "signal": list(values),
            "spread": float(spread),
            "time": time,
            "series": step.series,
            "step": step.number,
        }
        reading = ProbeTaken(self.position, float(position), values, float(spread), time)
        return self._next(event, taken=(*self.taken, reading))

    def reject(self, index: int, reason: str) -> ProbeProcedure:
        """Reject a reading (from 0) with a reason; its whole series is taken again.

        The order within a series counts, so a single reading is never repeated out of its place.
        """
        if not 0 <= index < len(self.taken):
            raise ProcedureError(f"there is no reading {index + 1}")
        words = " ".join(reason.split())
        if not words:
            raise ProcedureError("a rejection needs a reason")
        first = self.taken[index]
        if first.rejected:
            raise ProcedureError("this reading is rejected already")
        series = self.steps[first.step].series
        if self.under_way not in (series, ""):
            raise ProcedureError(
                f"series {self.under_way} is under way; finish it first, then reject and repeat"
                f" series {series}"
            )
        taken = tuple(
            replace(one, rejected=words if one is first else f"series repeated: {words}")
            if self.steps[one.step].series == series and not one.rejected
            else one
            for one in self.taken
        )
        start = next(i for i, step in enumerate(self.steps) if step.series == series)
        if self._mounted_probe() != self.steps[start].probe:
            start = self._mount_of(self.steps[start].probe)
        event = {"event": "reject", "index": index, "reason": words}
        return replace(self, position=start, taken=taken, events=(*self.events, event))

    def _mounted_probe(self) -> int:
        """Return the probe before which the micrometer stands, 0 before the first mounting."""
        probes = [int(event["probe"]) for event in self.events if event["event"] == "mounted"]
        return probes[-1] if probes else 0

    def _mount_of(self, probe: int) -> int:
        return next(
            i
            for i, step in enumerate(self.steps)
            if step.kind is ProbeStepKind.MOUNT and step.probe == probe
        )

    def _next(self, event: Mapping[str, Any], **changes: Any) -> ProbeProcedure:
        after = replace(self, events=(*self.events, event), **changes)
        standing = {one.step for one in after.taken if not one.rejected}
        position = self.position + 1
        while position < len(self.steps) and not after._wanted(position, standing):
            position += 1
        return replace(after, position=position)

    def _wanted(self, position: int, standing: set[int]) -> bool:
        """Tell whether a step is still to be done."""
        step = self.steps[position]
        if step.kind is ProbeStepKind.READING:
            return position not in standing
        return any(
            later.probe == step.probe and later.series and index not in standing
            for index, later in enumerate(self.steps)
        )

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


def make_probe_plan(plan: ProbePlan) -> tuple[ProbeStep, ...]:
    """Return the steps of a plan; raise ProcedureError for an impossible one."""
    if plan.probes not in ((1,), (2,), (1, 2)):
        raise ProcedureError("the probes are 1, 2, or both")
    if not (math.isfinite(plan.reach) and plan.reach > 0.0):
        raise ProcedureError("the reach of the micrometer is a length above 0")
    if not FEWEST_POSITIONS <= plan.positions <= MOST_POSITIONS:
        raise ProcedureError(f"take {FEWEST_POSITIONS} to {MOST_POSITIONS} positions")
    if not 1 <= plan.runs <= MOST_RUNS:
        raise ProcedureError(f"take 1 to {MOST_RUNS} runs up and down")
    rising = [round(x, 9) for x in np.linspace(-plan.reach, plan.reach, plan.positions).tolist()]
    course = [(x, False) for x in rising] + [(x, True) for x in rising[-2::-1]]
    steps: list[ProbeStep] = []
    for probe in plan.probes:
        steps.append(ProbeStep(ProbeStepKind.MOUNT, probe))
        steps += [
            ProbeStep(ProbeStepKind.READING, probe, f"{probe}.{run}", number, x, SETTLE_S, falling)
            for run in range(1, plan.runs + 1)
            for number, (x, falling) in enumerate(course, 1)
        ]
    return tuple(steps)


def time_needed(steps: Sequence[ProbeStep]) -> float:
    """Return the seconds that the steps take a technician."""
    return sum(
        MOUNTING_S if step.kind is ProbeStepKind.MOUNT else step.wait + HANDLING_S for step in steps
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
    return ProbeProcedure(plan, make_probe_plan(plan), events=(event,))


def take_up_probes(events: Iterable[Mapping[str, Any]]) -> ProbeProcedure:
    """Return the procedure that a journal tells; raise ProcedureError where it makes no sense."""
    procedure: ProbeProcedure | None = None
    for number, event in enumerate(events, 1):
        try:
            procedure = _apply(procedure, event)
        except (KeyError, TypeError, ValueError) as error:
            raise ProcedureError(f"line {number} of the journal is not usable: {error}") from error
    if procedure is None:
        raise ProcedureError("the journal is empty")
    return procedure


def _apply(procedure: ProbeProcedure | None, event: Mapping[str, Any]) -> ProbeProcedure:
    kind = event["event"]
    if procedure is None:
        if kind != "begin" or event.get("what") != "probes":
            raise ProcedureError("a journal of probes starts with begin")
        plan = ProbePlan(tuple(event["probes"]), event["reach"], event["positions"], event["runs"])
        return begin_probes(plan)
    if kind == "mounted":
        return procedure.mounted()
    if kind == "record":
        return procedure.record(event["position"], event["signal"], event["spread"], event["time"])
    if kind == "reject":
        return procedure.reject(event["index"], event["reason"])
    raise ProcedureError(f"unknown event {kind!r}")
