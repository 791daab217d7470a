"""Judge what the samples show and act on it, in the processing thread."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rigapp.engine.core import Core, Session
from rigapp.engine.judging import causes
from rigapp.engine.judging.criteria import Met
from rigapp.engine.judging.limits import Verdict
from rigapp.engine.judging.speeds import SpeedComparison
from rigapp.engine.judging.testrun import Row
from rigapp.engine.recording.recorder import cycle_message, measured_history
from rigapp.engine.samples.assembler import Revolution
from rigapp.schema.channels import LOAD_CELL
from rigapp.schema.columns import by_name, prediction_columns
from rigapp.schema.messages import FinishReason, Flag, RevolutionMeasured, RunState
from rigapp.schema.states import ACTIVE, TURNING, Ending, Trigger

if TYPE_CHECKING:
    from rigapp.engine.connection import Connection

Array = NDArray[np.float64]

AT_SPEED = 0.05
"""The set speed is reached within this share of it."""

PAUSE_RPM = 3.0
"""A crank that is held in a pause may not turn faster than this."""

MISSED_INDEX_LIMIT = 2
"""Revolutions in a row without an index that end the test."""

INDEX_SEARCH_REVOLUTIONS = 2.5

SENSE_TURN = 0.125
QUARTER_TURN = 0.25
"""Between these turns of the encoder since the start its sense is compared with the drive's; later
only while the drive has not answered since."""

BACKWARDS_RPM = -1.0
"""A drive that reports less than this turns backwards."""

CALM_REVOLUTIONS = 20

CALMING = {
    "count_mismatch": Flag.COUNT_MISMATCH,
    "lost_samples": Flag.LOST_SAMPLES | Flag.GAP_BEFORE,
    "device_overrun": Flag.LOST_SAMPLES | Flag.GAP_BEFORE,
    "time_jump": Flag.TIME_JUMP,
}
"""Warnings that go by themselves, and the flags that keep them."""

UNTRUE = Flag.PAUSED | Flag.PARTIAL | Flag.TIME_JUMP
"""Revolutions with one of these flags are no food for the prediction."""


class Guard:
    """The engine's judgement; see ``processing.Judge``."""

    def __init__(
        self,
        core: Core,
        connection: Connection,
        on_measured: Callable[[RevolutionMeasured], None] | None,
    ) -> None:
        self._core = core
        self._connection = connection
        self._on_measured = on_measured
        self._missed = 0
        self._start_count: int | None = None
        self._turning_s = 0.0
        self._speeds = SpeedComparison()
        self._turned_before = 0.0
        self._calm = False
        self._sound: dict[str, int] = {}
        self._blind: set[str] = set()

    # --- every block -----------------------------------------------------------------------------

    def begun(self, sample: int) -> None:
        """Start the test's time."""
        session = self._core.session
        self._start_count = self._connection.processor.assembler.motion.travel[1]
        self._speeds.begin()
        self._missed = 0
        self._blind = set()
        if session is not None:
            session.run.begin(sample)
            session.recorder.begin(sample)

    def overload(self, force_N: float) -> None:
        """Take the power off: a sample is above the overload limit, or not a number."""
        core = self._core
        self._calm = False
        if math.isnan(force_N):
            cause = causes.invalid_signal()
            ending = Ending(FinishReason.DEVICE, cause.cause, off=True)
        else:
            cause = causes.overload(force_N, core.limits.overload_N)
            ending = Ending(FinishReason.LIMIT, cause.cause, off=True)
        if core.state in ACTIVE:
            core.trip(ending, cause)
        elif ending.fault:  # the limit is the test's: without one, weights may hang on the cell
            core.warn(cause)

    def cut_off(self, inputs: frozenset[str]) -> bool:
        """Take the power off in a test: a saturated input shows a force above the limit."""
        if self._core.state not in ACTIVE:
            return False
        self._saturated(inputs)
        return True

    def saturated(self, inputs: frozenset[str]) -> None:
        """Raise the alarms of these inputs, and let those of all others return."""
        for name in self._connection.processor.calibration.names:
            if name not in inputs:
                for critical in (True, False):
                    self._core.alarms.clear(causes.saturated_key(name, critical=critical))
        self._saturated(inputs)

    def _saturated(self, inputs: frozenset[str]) -> None:
        core = self._core
        device = self._connection.devices.source.name
        for wire in self._connection.processor.calibration.wires:
            name = wire.channel.name
            if name not in inputs or core.alarms.is_active(
                causes.saturated_key(name, critical=True)
            ):
                continue
            span = f"{wire.channel.signal_range:g} {wire.unit}"
            critical = wire.channel.instrument == LOAD_CELL and core.state in ACTIVE
            cause = causes.saturated(name, wire.channel.input, device, span, critical=critical)
            if critical:
                core.trip(Ending(FinishReason.DEVICE, cause.cause, off=True), cause)
            else:
                core.warn(cause)

    def calm(self) -> None:
        """Take note that the force of a whole block is within the limit."""
        self._calm = True

    def motion(self, speed_rpm: float) -> None:
        """Look for overspeed, for a missing index, and for the set speed."""
        core = self._core
        state = core.state
        if self._calm and state not in ACTIVE:
            self._calm = False
            core.alarms.clear("invalid_signal")
        limit = core.limits.overspeed_rpm
        if abs(speed_rpm) > limit and state in TURNING and not self._connection.swinging:
            cause = causes.overspeed(speed_rpm, limit, "crank encoder")
            core.trip(Ending(FinishReason.LIMIT, cause.cause, off=True), cause)
        session = core.session
        turned = self._connection.processor.assembler.motion.turned_without_index
        if state is RunState.PAUSED and abs(speed_rpm) > PAUSE_RPM:
            cause = causes.moved_in_pause(speed_rpm)
            core.trip(Ending(FinishReason.DEVICE, cause.cause, off=True), cause)
            return
        if session is None or state not in (RunState.STARTING, RunState.RUNNING):
            self._turned_before = turned
            if session is not None:
                session.steady_from = None
            return
        if self._start_count is not None and self._senses_differ(self._start_count):
            return
        # What was turned without an index before this start is not held against it.
        self._turned_before = min(self._turned_before, turned)
        lost = turned - self._turned_before
        if lost > INDEX_SEARCH_REVOLUTIONS:
            self._no_index(lost)
            return
        if state is RunState.STARTING:
            session.steady_from = None
            if abs(speed_rpm - session.target_rpm) <= AT_SPEED * session.target_rpm:
                core.fire_if(Trigger.AT_SPEED, only=(RunState.STARTING,))
            return
        if session.steady_from is None:
            session.steady_from = self._connection.processor.assembler.ordinal + 1
        self._compare_speeds(speed_rpm, session.target_rpm)

    def _compare_speeds(self, speed_rpm: float, target_rpm: float) -> None:
        control = self._connection.control
        if control.status is None:
            return
        drive_rpm = control.status.speed_rev_per_s * 60.0
        if self._speeds.differs(control.answered_s, speed_rpm, drive_rpm, target_rpm):
            cause = causes.speeds_differ(speed_rpm, drive_rpm)
            self._core.trip(Ending(FinishReason.DEVICE, cause.cause), cause)

    def _senses_differ(self, start_count: int) -> bool:
        """End a test in whose first quarter turn encoder or drive show the crank going backwards.

        Tests turn forwards only; a pause may swing the crank later, so nothing is compared then.
        """
        core, control = self._core, self._connection.control
        assembler = self._connection.processor.assembler
        counts = assembler.motion.travel[1] - start_count
        turned = counts / assembler.encoder.counts_per_revolution
        if abs(turned) < SENSE_TURN:
            self._turning_s = time.monotonic()
            return False
        status = control.status
        answered = status is not None and control.answered_s > self._turning_s
        if not answered and turned > -QUARTER_TURN:
            return False
        drive_back = status is not None and status.speed_rev_per_s * 60.0 < BACKWARDS_RPM
        if turned > 0 and not drive_back:
            if turned >= QUARTER_TURN:
                self._start_count = None
            return False
        rig = core.rig.record
        directions = rig.encoder.direction, rig.spindle.direction
        cause = causes.senses_differ(turned < 0, drive_back, directions)
        core.trip(Ending(FinishReason.DEVICE, cause.cause, off=drive_back), cause)
        return True

    def lost(self, samples: int) -> None:
        """Warn of lost samples."""
        core = self._core
        core.warn(causes.lost_samples(self._connection.devices.source.name, samples))

    def time_jump(self, seconds: float) -> None:
        """Warn of clocks that parted."""
        self._core.warn(causes.time_jump(seconds))

    # --- every revolution ------------------------------------------------------------------------

    def revolution(self, revolution: Revolution) -> None:
        """Number, reduce, judge, store and publish a revolution, in this order."""
        core = self._core
        session = core.session
        if session is None or core.state not in ACTIVE or session.stood:
            return
        steady = session.steady_from is not None and revolution.ordinal >= session.steady_from
        row = session.run.take(revolution, steady)
        if row is None:
            if session.run.complete:
                self._complete(session)
            return
        self._act(session, row)
        try:
            self._store(session, row)
        except Exception as error:
            core.storage_failed(error)
            return
        core.publisher.row(row.values, lambda: cycle_message(row.number, row.measured))
        self._tell_twin(row, session)
        if row.last:
            self._complete(session)

    def _complete(self, session: Session) -> None:
        planned, rows = session.run.planned, session.recorder.rows
        sentence = f"The planned {planned} revolutions are made and recorded."
        if rows < planned:
            sentence = f"The planned {planned} revolutions are made; {rows} of them are recorded."
        self._core.trip(Ending(FinishReason.COMPLETE, sentence))

    def _act(self, session: Session, row: Row) -> None:
        flags = row.measured.revolution.flags
        if flags & Flag.MISSED_INDEX:
            self._missed += 1
            if self._missed >= MISSED_INDEX_LIMIT:
                self._no_index(float(self._missed))
        else:
            self._missed = 0
            self._core.alarms.clear("index_missed")
        if flags & Flag.COUNT_MISMATCH:
            self._core.warn(causes.count_mismatch(row.number))
        if flags & Flag.LOST_SAMPLES:
            self.lost(self._connection.processor.assembler.lost_samples)
        for key, bad in CALMING.items():
            self._calm_down(key, not flags & bad)
        for verdict in row.verdicts:
            self.verdict(session, verdict)
        if row.met is not None:
            self._end(session, row.met)
        self._look_for_blind(session)

    def _look_for_blind(self, session: Session) -> None:
        """Tell of stop criteria that nothing is known of, and when they are seen again."""
        blind = set(session.run.stops.blind())
        for name in blind - self._blind:
            self._core.warn(causes.criterion_blind(name))
        for name in self._blind - blind:
            self._core.alarms.clear(causes.blind_key(name))
        self._blind = blind

    def _end(self, session: Session, met: Met) -> None:
        """End the test by one of its stop criteria."""
        if met.planned:
            run = session.run
            sentence = f"{met.sentence} That was revolution {run.number} of at most {run.planned}."
            self._core.trip(Ending(FinishReason.COMPLETE, sentence))
        else:
            self._core.trip(Ending(FinishReason.LIMIT, met.sentence), causes.criterion(met))

    def predicted(self, session: Session, values: Array) -> None:
        """Judge what the twin predicts by the rules of the test."""
        named = by_name(prediction_columns(), values)
        measured = self._core.table.place
        alone = {name: value for name, value in named.items() if name not in measured}
        for verdict in session.run.monitor.judge(alone):
            self.verdict(session, verdict)
        met = session.run.stops.prediction(int(named["revolution"]), named)
        if met is not None:
            self._end(session, met)

    def verdict(self, session: Session, verdict: Verdict) -> None:
        """Carry out what a rule of the test wants."""
        core = self._core
        cause = causes.rule(
            verdict.quantity,
            verdict.severity,
            verdict.value,
            verdict.limit,
            verdict.above,
            verdict.action,
        )
        if not verdict.active:
            core.alarms.clear(cause.key)
            return
        if verdict.action == "none":
            level = cause.severity.value
            core.event("limit", "limits", cause.cause, key=cause.key, level=level)
        elif verdict.action == "warn":
            core.warn(cause)
        elif verdict.action == "pause":
            core.warn(cause)
            self._connection.pause(cause.cause)
        else:
            off = verdict.action == "drive_off"
            core.trip(Ending(FinishReason.LIMIT, cause.cause, off=off), cause)

    def _calm_down(self, key: str, sound: bool) -> None:
        """Clear a warning after enough sound revolutions; at once it would flood the log."""
        self._sound[key] = self._sound.get(key, 0) + 1 if sound else 0
        if self._sound[key] == CALM_REVOLUTIONS:
            self._core.alarms.clear(key)

    def _store(self, session: Session, row: Row) -> None:
        revolution = row.measured.revolution
        session.recorder.row(row.number, row.values, row.measured)
        if revolution.flags & Flag.GAP_BEFORE:
            lost = revolution.lost_samples
            self._core.gap(f"samples are missing before revolution {row.number}: {lost} lost")

    def _tell_twin(self, row: Row, session: Session) -> None:
        if self._on_measured is None or row.measured.revolution.flags & UNTRUE:
            return
        try:
            self._on_measured(measured_history(row.number, row.measured))
        except Exception as error:
            self._core.event("twin", "engine", f"the prediction was not asked: {error}")
            self._on_measured = None

    def _no_index(self, revolutions: float) -> None:
        cause = causes.index_missed(revolutions)
        self._core.trip(Ending(FinishReason.DEVICE, cause.cause), cause)
