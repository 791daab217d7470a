"""Evaluate samples and revolutions and act on the result, in the processing thread."""

from __future__ import annotations

import math
import time

import numpy as np
from numpy.typing import NDArray

from rigapp.engine.activetest import ActiveTest
from rigapp.engine.connectedrig import ConnectedRig
from rigapp.engine.core import Core
from rigapp.engine.crankmotion import CrankMotion
from rigapp.engine.judging.checks import LATE_S, SpeedComparison, direction_mismatch
from rigapp.engine.judging.criteria import CriterionMet
from rigapp.engine.judging.depthwatch import DEPTH_COLUMNS
from rigapp.engine.judging.limits import LevelPassed
from rigapp.engine.judging.testrun import Row
from rigapp.engine.samples.assembler import Revolution
from rigapp.engine.watches import GapWatch
from rigapp.schema.alarms import key_of, make_alarm
from rigapp.schema.channels import LOAD_CELL
from rigapp.schema.columns import by_name, prediction_columns
from rigapp.schema.criteria import CRITERIA
from rigapp.schema.messages import FinishReason, Flag, RunState
from rigapp.schema.states import ACTIVE, TURNING, Ending, Trigger
from rigapp.texts import say

Array = NDArray[np.float64]

AT_SPEED = 0.05
"""Relative deviation within which the set speed is reached."""

SPEED_HELD = (RunState.STARTING, RunState.RUNNING)
"""States in which the crank turns at the set speed, or accelerates to it."""

PAUSE_RPM = 3.0
"""Largest speed of a crank that is held in a pause."""

MISSED_INDEX_LIMIT = 2
"""Consecutive revolutions without an index that end the test."""

INDEX_SEARCH_REVOLUTIONS = 2.5

DIRECTION_TURN = 0.125
QUARTER_TURN = 0.25
"""Range of the encoder's turn since the start in which its direction is compared with the drive's;
beyond it only until the first answer of the drive."""

BACKWARDS_RPM = -1.0
"""Reported speed of the drive below which it turns backwards."""

VALID_REVOLUTIONS = 20

CLEARED_AUTOMATICALLY = {
    "count_mismatch": Flag.COUNT_MISMATCH,
    "lost_samples": Flag.LOST_SAMPLES | Flag.GAP_BEFORE,
    "device_overrun": Flag.LOST_SAMPLES | Flag.GAP_BEFORE,
    "time_jump": Flag.TIME_JUMP,
}
"""Warnings that are cleared automatically, and the flags that prevent it."""


class Guard:
    """Actions on the samples of a connected rig; implements ``processing.SampleMonitor``."""

    def __init__(self, core: Core, rig: ConnectedRig, motion: CrankMotion) -> None:
        self._core = core
        self._rig = rig
        self._motion = motion
        self.gaps = GapWatch(core, rig)
        self._missed = 0
        self._start_count: int | None = None
        self._turning_s = 0.0
        self._speeds = SpeedComparison()
        self._turned_before = 0.0
        self._force_within_limit = False
        self._changed_in = 0
        self._valid_revolutions: dict[str, int] = {}
        self._without_data: set[str] = set()
        self._peak_N = 0.0

    # --- every block -----------------------------------------------------------------------------

    def begun(self, sample: int) -> None:
        """Start the test's time."""
        test = self._core.test
        assembler = self._rig.processor.assembler
        self._start_count = assembler.motion.travel[1]
        self._changed_in = assembler.ordinal
        self._speeds.begin()
        self.gaps.begin()
        self._missed = 0
        self._without_data = set()
        self._peak_N = 0.0
        if test is not None:
            test.begin(sample)

    def overload(self, force_N: float, beyond_range: bool) -> None:
        """Switch the power off: a sample is above the overload limit, or NaN."""
        run = self._core
        self._force_within_limit = False
        if math.isfinite(force_N):
            if run.state in ACTIVE:  # the limit is the test's; without one, weights may be applied
                # A coasting crank exceeds the limit repeatedly: the alarm shows the maximum.
                self._peak_N = max(self._peak_N, force_N)
                cause = make_alarm(
                    "overload:beyond_range" if beyond_range else "overload",
                    force_N=self._peak_N,
                    limit_N=run.limits.overload_N,
                )
                run.act_on(cause)
        elif run.state in ACTIVE:
            run.act_on(make_alarm("invalid_signal"))
        else:
            run.warn(make_alarm("invalid_signal"))

    def cut_off(self, inputs: frozenset[str], force_N: float, slowed: bool) -> bool:
        """Switch the power off in a test: a saturated input shows a force above the limit.

        At a constant set speed, a decelerating crank confirms the force: a broken cable does not
        slow it down.
        """
        if self._core.state not in ACTIVE:
            return False
        if slowed and self._core.state in SPEED_HELD:
            self.overload(force_N, beyond_range=True)
            return False
        self._saturated(inputs)
        return True

    def saturated(self, inputs: frozenset[str]) -> None:
        """Raise the alarms of these inputs, and clear those of all others."""
        for name in self._rig.processor.calibration.names:
            for kind in ("saturated", "input_saturated") if name not in inputs else ():
                self._core.alarms.clear(key_of(kind, name))
        self._saturated(inputs)

    def _saturated(self, inputs: frozenset[str]) -> None:
        run, device = self._core, self._rig.source.name
        for wire in self._rig.processor.calibration.wires:
            channel = wire.channel
            name = channel.name
            if name not in inputs or run.alarms.is_active(key_of("saturated", name)):
                continue
            critical = channel.instrument == LOAD_CELL and run.state in ACTIVE
            # A force beyond the range after an overload belongs to the overload.
            critical = critical and not run.alarms.is_active("overload:beyond_range")
            cause = make_alarm(
                "saturated" if critical else "input_saturated",
                name,
                wired=channel.input,
                device=device,
                span=say("{:g} {}", channel.signal_range, wire.unit),
            )
            run.act_on(cause)

    def calm(self) -> None:
        """Record the end of an overload: the force of a complete block is within the limit."""
        self._force_within_limit = True

    def motion(self, speed_rpm: float) -> None:
        """Check for overspeed, a missing index, and the set speed."""
        run, rig = self._core, self._rig
        state, test = run.state, run.test
        if self._force_within_limit and state not in ACTIVE:
            self._force_within_limit = False
            run.alarms.clear("invalid_signal")
        self.gaps.look()
        limit = run.limits.overspeed_rpm
        if abs(speed_rpm) > limit and state in TURNING and not rig.swinging:
            by = say("crank encoder")
            run.act_on(make_alarm("overspeed", by=by, speed_rpm=speed_rpm, limit_rpm=limit))
        turned = rig.processor.assembler.motion.turned_without_index
        # The window of the mean speed of a slow crank extends to before its standstill.
        if (
            state is RunState.PAUSED
            and abs(speed_rpm) > PAUSE_RPM
            and not rig.processor.motion.standing(run.timing.standing)
        ):
            run.act_on(make_alarm("moved_in_pause", speed_rpm=speed_rpm))
            return
        if test is None or state not in SPEED_HELD:
            self._turned_before = turned
            if test is not None:
                self._changes(test)
            return
        if self._start_count is not None and self._direction_differs(self._start_count):
            return
        # Turns without an index before this start do not count.
        self._turned_before = min(self._turned_before, turned)
        lost = turned - self._turned_before
        if lost > INDEX_SEARCH_REVOLUTIONS:
            run.act_on(make_alarm("index_missed", revolutions=lost))
            return
        if state is RunState.STARTING:
            if test.steady_from is not None:
                self._changes(test)
            if _at_speed(speed_rpm, test):
                run.fire_if(Trigger.AT_SPEED, only=(RunState.STARTING,))
            pace = max(1.0, rig.processor.motion.pace())
            self._compare_speeds(speed_rpm, test, pace * LATE_S * test.ramp_rpm_per_s)
            return
        if test.steady_from is None:
            test.steady_from = rig.processor.assembler.ordinal + 1
        self._compare_speeds(speed_rpm, test)

    def _changes(self, test: ActiveTest) -> None:
        """Record that the speed is changing, or was until now."""
        test.steady_from = None
        self._changed_in = self._rig.processor.assembler.ordinal

    def _compare_speeds(
        self, speed_rpm: float, test: ActiveTest, late_rpm: float | None = None
    ) -> None:
        control = self._rig.control
        if control.status is None:
            return
        drive_rpm = control.status.speed_rev_per_s * 60.0
        answered_s, target_rpm = control.answered_s, test.target_rpm
        if self._speeds.differs(answered_s, speed_rpm, drive_rpm, target_rpm, late_rpm):
            cause = make_alarm("speeds_differ", encoder_rpm=speed_rpm, drive_rpm=drive_rpm)
            self._core.act_on(cause)

    def _direction_differs(self, start_count: int) -> bool:
        """End the test if encoder or drive show a backward motion in the first quarter turn.

        Tests turn forwards only. Later the directions are not compared, as the crank may swing in a
        pause.
        """
        control, assembler = self._rig.control, self._rig.processor.assembler
        counts = assembler.motion.travel[1] - start_count
        turned = counts / assembler.encoder.counts_per_revolution
        if abs(turned) < DIRECTION_TURN:
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
        rig = self._core.rig.record
        directions = rig.encoder.direction, rig.spindle.direction
        sentence = direction_mismatch(turned < 0, drive_back, directions)
        self._core.act_on(make_alarm("senses_differ", sentence=sentence), off=drive_back)
        return True

    def lost(self, samples: int, seconds: float) -> None:
        """Warn of lost samples; switch the power off if the gap exceeds the limit of stale data."""
        if not self.gaps.known(seconds):
            self._warn_lost(samples)

    def _warn_lost(self, samples: int) -> None:
        device = self._rig.source.name
        sentence = say("{} samples of {} were lost in all.", samples, device)
        if not samples:
            sentence = say("Samples of {} were lost; how many is not known.", device)
        self._core.warn(make_alarm("lost_samples", sentence=sentence))

    # --- every revolution ------------------------------------------------------------------------

    def revolution(self, revolution: Revolution) -> None:
        """Number, reduce, evaluate, store and publish a revolution, in this order."""
        run, test = self._core, self._core.test
        if test is None or run.state not in ACTIVE or test.reached_standstill:
            return
        steady = run.state in SPEED_HELD and self._is_steady(test, revolution)
        row = test.run.take(revolution, steady)
        if row is not None:
            self._act(test, row)
            run.record(row)
        if test.run.complete:
            self._complete(test)
        elif row is not None and row.number >= test.stage.last:
            self._changes(test)
            self._changed_in = revolution.ordinal + 1
            self._motion.start_step(test.sequence.at(row.number + 1))

    def _is_steady(self, test: ActiveTest, revolution: Revolution) -> bool:
        """Return whether the speed was constant during the whole revolution.

        By the speed at its beginning, from its own samples: rows must not depend on the size of
        blocks, as the state does. A crank with a large ripple is steady one revolution after it
        reached the speed.
        """
        if test.steady_from is not None and revolution.ordinal >= test.steady_from:
            return True
        turn = self._rig.processor.assembler.encoder.counts_per_revolution
        later = revolution.ordinal > self._changed_in
        return later and _at_speed(revolution.first_speed_rpm(turn), test)

    def _complete(self, test: ActiveTest) -> None:
        planned, rows = test.run.planned, test.rows
        sentence = say("The planned {} revolutions are made and recorded.", planned)
        if rows < planned:
            sentence = say(
                "The planned {} revolutions are made; {} of them are recorded.", planned, rows
            )
        self._core.trip(Ending(FinishReason.COMPLETE, _remarked(sentence, test)))

    def _act(self, test: ActiveTest, row: Row) -> None:
        run, flags = self._core, row.measured.revolution.flags
        if flags & Flag.MISSED_INDEX:
            self._missed += 1
            if self._missed >= MISSED_INDEX_LIMIT:
                run.act_on(make_alarm("index_missed", revolutions=float(self._missed)))
        else:
            self._missed = 0
            run.alarms.clear("index_missed")
        self.gaps.revolution(row.measured.revolution)
        if flags & Flag.COUNT_MISMATCH and not _samples_missing(row.measured.revolution):
            run.warn(make_alarm("count_mismatch", revolution=row.number))
        if flags & Flag.LOST_SAMPLES:
            self._warn_lost(self._rig.processor.assembler.lost_samples)
        for key, mask in CLEARED_AUTOMATICALLY.items():
            self._clear_if_ok(key, not flags & mask)
        for verdict in row.verdicts:
            self.verdict(verdict)
        if row.met is not None:
            self._end(test, row.met)
        self._check_data(test)

    def _check_data(self, test: ActiveTest) -> None:
        """Warn of stop criteria without a value, and clear the warning when it returns."""
        no_data = set(test.run.stops.no_data())
        for name in no_data - self._without_data:
            self._core.warn(make_alarm("blind", name, name=CRITERIA[name].title))
        for name in self._without_data - no_data:
            self._core.alarms.clear(key_of("blind", name))
        self._without_data = no_data

    def _end(self, test: ActiveTest, met: CriterionMet) -> None:
        """End the test by one of its stop criteria."""
        if met.planned:
            run = test.run
            text = say(
                "{} That was revolution {} of at most {}.", met.sentence, run.number, run.planned
            )
            self._core.trip(Ending(FinishReason.COMPLETE, _remarked(text, test)))
        else:
            name, sentence = CRITERIA[met.name].title, met.sentence
            self._core.act_on(make_alarm("stop", met.name, name=name, sentence=sentence))

    def predicted(self, test: ActiveTest, values: Array) -> None:
        """Evaluate the twin's prediction by the rules of the test."""
        named = by_name(prediction_columns(), values)
        measured = self._core.table.place
        unmeasured = {name: value for name, value in named.items() if name not in measured}
        for verdict in test.run.monitor.judge(unmeasured, test.run.step(int(named["revolution"]))):
            self.verdict(verdict)
        for cause in test.run.joint.look(named):
            if isinstance(cause, str):
                self._core.alarms.clear(cause)
            else:
                self._core.warn(cause)
        number, stops, depth = int(named["revolution"]), test.run.stops, test.run.depth
        if stops.is_evaluated(number):
            for cause in depth.look(number, named):
                self._core.warn(cause)
                for name in stops.of_depth():
                    title = CRITERIA[name].title
                    self._core.warn(make_alarm("depth_not_judged", name, name=title))
        if depth.doubtful:
            named = {**named, **dict.fromkeys(DEPTH_COLUMNS, math.nan)}
        met = stops.prediction(number, named)
        if met is not None:
            self._end(test, met)

    def verdict(self, verdict: LevelPassed) -> None:
        """Perform the action of a rule of the test."""
        run, cause = self._core, verdict.cause
        if not verdict.active:
            run.alarms.clear(cause.key)
        elif verdict.action == "none":
            run.note_limit(cause)
        else:
            run.act_on(cause)
            if verdict.action == "pause":
                self._motion.pause(cause.sentence)

    def _clear_if_ok(self, key: str, sound: bool) -> None:
        """Clear a warning after enough valid revolutions; immediately, it would flood the log."""
        self._valid_revolutions[key] = self._valid_revolutions.get(key, 0) + 1 if sound else 0
        if self._valid_revolutions[key] == VALID_REVOLUTIONS:
            self._core.alarms.clear(key)


def _samples_missing(revolution: Revolution) -> bool:
    """Return whether samples are missing in or before a revolution, of known number or not."""
    known = Flag.LOST_SAMPLES | Flag.GAP_BEFORE | Flag.TIME_JUMP
    return revolution.skipped_counts != 0 or bool(revolution.flags & known)


def _remarked(sentence: str, test: ActiveTest) -> str:
    """Return why a test is complete, with a remark if its wear depth is doubtful."""
    return say("{} {}", sentence, test.run.depth.remark).rstrip()


def _at_speed(speed_rpm: float, test: ActiveTest) -> bool:
    return abs(speed_rpm - test.target_rpm) <= AT_SPEED * test.target_rpm
