"""Run-out map under way: slow rolls of the spindle, then the map from them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from rigapp.calibrating.journal import Journal
from rigapp.calibrating.records import keep_record, refuse_existing
from rigapp.calibrating.records_in_use import with_records
from rigapp.calibrating.run_out import GRID_DEG, map_of
from rigapp.calibrating.session import NO_CURVES, Outcome, ResidualsSoFar, Rig
from rigapp.calibrating.spindle import SLOWEST_RPM, SpindleRun, SpindleRuns, speeds_of
from rigapp.calibrating.training import NO_PRACTICE, Training
from rigapp.config.calibration_settings import RunOutFile
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, read_rig, read_test
from rigapp.config.recipe import (
    CyclesSection,
    LimitsSection,
    MetadataSection,
    PredictionSection,
    RunSection,
    TestFile,
)
from rigapp.config.rig import RigFile
from rigapp.texts import say
from rigapp_calibration.taking.procedure import ProcedureError
from rigapp_calibration.turning.run_out import FASTEST

ROLL_RAMP = 2
"""Revolutions beyond those requested: the first ones contain the ramp."""
REVOLUTIONS = {"routine": 12, "full": 30}
"""Plan -> revolutions at each speed: from 10 on the spread of a roll is known; more average it."""
FASTEST_RPM = round(FASTEST * 30.0 / math.pi, 6)
ORDERS = 8
"""Fourier orders of a usual map: a pin's eccentricity, ovality and lobes."""


def roll_test(
    rig: RigFile, base: TestFile, rpm: float, revolutions: int, operator: str
) -> TestFile:
    """Return the test of a slow roll: every cycle stored, no prediction, narrow limits.

    base: the test whose mechanism and limits are used.
    """
    return TestFile(
        schema=1,
        title=say("Slow roll at {:g} rpm for the run-out map", rpm),
        run=RunSection(
            revolutions=revolutions + ROLL_RAMP,
            speed_rpm=rpm,
            acceleration_rpm_per_s=max(1.0, rpm),
        ),
        model=base.model,
        metadata=MetadataSection(operator=operator, notes=say("slow roll of the pin")),
        cycles=CyclesSection(schedule="every", every_revolutions=1),
        limits=LimitsSection(
            overload_N=min(base.limits.overload_N, 0.95 * rig.load_cell.full_scale_N),
            overspeed_rpm=3.0 * rpm + 10.0,
            stale_data_s=base.limits.stale_data_s,
        ),
        prediction=PredictionSection(enabled=False),
    )


@dataclass(frozen=True, slots=True)
class RollPlan:
    """A plan of rolls: speeds (rpm), revolutions at each, orders of the map."""

    speeds: tuple[float, ...]
    revolutions: int
    orders: int = ORDERS

    @property
    def seconds(self) -> float:
        """Return the time for which the spindle turns."""
        return sum(60.0 * (self.revolutions + ROLL_RAMP) / rpm for rpm in self.speeds)


def roll_plan(rpm: str, revolutions: int, orders: int) -> RollPlan:
    """Return the plan of the operator's choices; raise UnusableInput naming the wrong one."""
    if revolutions < 1:
        raise UnusableInput("--revolutions: give at least 1; 12 are recommended.")
    speeds = speeds_of("--rpm", rpm, SLOWEST_RPM, FASTEST_RPM, 1)
    return RollPlan(tuple(speeds), revolutions, orders)


def rolls_of(
    rig: Document[RigFile], base: TestFile, plan: RollPlan, stem: Path, operator: str
) -> SpindleRuns:
    """Return the rolls of a plan, their files beside ``stem``; raise UnusableInput."""
    if "run_out" in with_records(rig).blocking:
        raise UnusableInput(
            "{}: the map in use has expired, and an expired record forbids a start:"
            " take run_out out of [probes] for the roll.",
            rig.path,
        )
    runs = [
        SpindleRun(
            rpm,
            roll_test(rig.record, base, rpm, plan.revolutions, operator),
            stem.with_name(f"{stem.name}.roll-{rpm:g}rpm"),
        )
        for rpm in plan.speeds
    ]
    return SpindleRuns(runs, say("slow roll"))


def save_map(
    files: Sequence[Path], orders: int, source: Mapping[str, Any], settings: RunOutFile, to: Path
) -> Outcome:
    """Make a map of rolls and store its record if it is accepted.

    source: the rig and whether it is simulated, as far as known.
    """
    outcome, readings, facts = map_of(files, orders)
    if outcome.accepted:
        taken = {**source, "files": facts, "orders": orders}
        keep_record(to, outcome.kind, readings, settings, outcome.result, taken)
    return outcome


class RollSession:
    """A run-out map under way, for a user interface that has the engine's status.

    The journal holds the plan; the rolls are test files beside it.
    """

    practice: ClassVar[Training] = NO_PRACTICE
    refused: ClassVar[str] = say(
        "Nothing is saved. The rolls are kept. Begin a new map when the cause is removed."
    )

    def __init__(
        self,
        file: RunOutFile,
        rig: Rig,
        journal: Path,
        plan: RollPlan | None,
        *,
        keep_waiting_times: bool = True,
    ) -> None:
        """Begin, or resume from the journal; raise UnusableInput."""
        if rig.file is None or rig.test is None:
            raise UnusableInput(
                "a roll needs a rig file and a test file, whose mechanism gives the elastic"
                " motion: name the test file."
            )
        self.settings_file, self.rig = file, rig
        self.journal = Journal(journal)
        try:
            self.plan = self._open(plan)
            base = read_test(rig.test).record
            stem = journal.with_suffix("")
            self.runs = rolls_of(read_rig(rig.file), base, self.plan, stem, rig.operator)
        except UnusableInput:
            self.close()
            raise
        self._outcome: Outcome | None = None

    def _open(self, plan: RollPlan | None) -> RollPlan:
        events = self.journal.read()
        if events:
            try:
                stored = events[0]["plan"]
                return RollPlan(tuple(stored["speeds"]), stored["revolutions"], stored["orders"])
            except (KeyError, TypeError) as error:
                raise UnusableInput(
                    "{}: it holds no rolls ‹{}›.", self.journal.path, error
                ) from error
        if plan is None:
            raise UnusableInput("there are no rolls to continue; begin a map.")
        self.journal.append({"event": "begin", "rig": self.rig.name, "plan": asdict(plan)})
        return plan

    def judge(self) -> Outcome:
        """Make the map; nothing is saved. Raises ProcedureError before the end."""
        if not self.runs.done:
            raise ProcedureError("rolls are missing")
        self._outcome = map_of(self.runs.files, self.plan.orders)[0]
        return self._outcome

    def save(self, outcome: Outcome, to: Path) -> Outcome:
        """Seal an accepted map in a record; raise UnusableInput."""
        refuse_existing(to)
        self.runs.compress()
        source = {"rig": self.rig.name, "simulated": self.rig.simulated}
        save_map(self.runs.files, self.plan.orders, source, self.settings_file, to)
        return replace(outcome, saved=to)

    def residuals(self) -> ResidualsSoFar:
        """Return the map that was made, um over degrees of the crank, for a plot."""
        result = {} if self._outcome is None else self._outcome.result
        if "map_um" not in result:
            return ResidualsSoFar(NO_CURVES, (0.0, 360.0), 1.0, "")
        angle = np.arange(0.0, 360.0, GRID_DEG)
        first, second = (np.array(values) for values in result["map_um"])
        reach = 1.2 * float(max(np.abs(first).max(), np.abs(second).max(), 0.1))
        words = say("Circle: probe 1, triangle: probe 2.")
        return ResidualsSoFar(((angle, first), (angle, second)), (0.0, 360.0), reach, words)

    def close(self) -> None:
        """Close the journal; it can be resumed. One without a roll is deleted."""
        if not list(self.journal.path.parent.glob(f"{self.journal.path.stem}.roll-*")):
            self.journal.path.unlink(missing_ok=True)
        self.journal.close()
