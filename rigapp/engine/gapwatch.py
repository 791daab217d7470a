"""Find samples that went missing without a number, say how long they are, and act on it.

Three witnesses, as none sees every gap:

- The encoder: its count jumps, and is right at the next index all the same. It shows any gap but
  one of whole turns, not how many turns, and at once: late samples show no jump.
- The host's clock: device time falls behind it. Only in real time, beyond the jitter of blocks.
- The drive's own count: the encoder's turns fall behind it. At any speed of a simulated rig.

After a jump the other two are looked at for ``SHORT_S`` and tell the length; without one (whole
turns, a crank that stands) the lag has to stay for a ``WINDOW_S``: a late reader shows one, too.
"""

from __future__ import annotations

import math

from rigapp.engine.activetest import ActiveTest
from rigapp.engine.connectedrig import ConnectedRig
from rigapp.engine.core import Core
from rigapp.engine.samples.assembler import Revolution
from rigapp.schema.alarms import make_alarm
from rigapp.schema.messages import Flag, RunState
from rigapp.schema.states import ACTIVE
from rigapp.texts import say
from rigapp_drivers.api import SampleClock

WINDOW_S = 2.0  # the least delay of so long is free of the jitter of single blocks
SHORT_S = 0.3
"""After a jump of the count, which late samples do not show, so much is enough: three answers of
the drive, or fifteen blocks. The first level is taken so, too: one too high hides a gap for a
window, and invents none."""

LATE_S = 0.2
"""More is no jitter of a host: time was lost."""

JUMP_LATE_S = 0.1
"""The same where the count has jumped as well."""

SLIP = 0.15
"""Of the turns in a window: slip, or a wrong gear ratio, is less (``judging.checks.AGREE``)."""

HALF_TURN = 0.5
"""The encoder counts within a turn: only whole turns are missing from its count."""

ANSWER_S = 0.03
"""How old an answer of the drive, or a block, may be beyond the others, s of the host."""

MOST_MISSING = 1e5
"""Turns; more is the drive's counter that wraps or was set."""

SLOWEST = 0.1
"""Share of the set speed below which the drive's own speed is too small to divide by."""


class LagWatch:
    """Notice a lag that has grown for good.

    A late reader delays a block, but the blocks after it come early: the smallest lag within a
    window is free of it. A lag that stays is lost data. level: the smallest lag of the last window.
    """

    def __init__(self) -> None:
        self.restart()

    def restart(self) -> None:
        """Forget the past; what comes next is the level."""
        self.level = math.nan
        self.look_again()

    def look_again(self) -> None:
        """Begin a short window with the next lag."""
        self._smallest = math.inf
        self._window_end = math.nan
        self._window_s = SHORT_S

    def add(self, lag: float, host_s: float) -> float:
        """Take a lag; return by how much it has grown at the end of a window, else NaN."""
        if math.isnan(self._window_end):
            self._window_end = host_s + self._window_s
        self._smallest = min(self._smallest, lag)
        if host_s < self._window_end:
            return math.nan
        level, self.level = self.level, self._smallest
        self._smallest = math.inf
        self._window_s = WINDOW_S
        self._window_end = host_s + WINDOW_S
        return self.level - level


class GapWatch:
    """Find gaps; called in the processing thread, but for ``outstanding_s``."""

    def __init__(self, core: Core, rig: ConnectedRig) -> None:
        self._core = core
        self._rig = rig
        self._time, self._turns = LagWatch(), LagWatch()
        self._compared_ns = 0
        self._skips = 0
        self._jumped_s: float | None = None
        self._skipped: float | None = None

    def begin(self) -> None:
        """Begin with a test: the drive may have counted anything before."""
        self._turns.restart()
        self._jumped_s = self._skipped = None

    def look(self) -> None:
        """Look at the newest block."""
        newest, motion = self._rig.processor.motion.newest(), self._rig.processor.assembler.motion
        if newest is None:
            return
        if motion.skips != self._skips:
            self._skips = motion.skips
            self._jumped_s = newest.host_s
            self._time.look_again()
            self._turns.look_again()
        test = self._core.test
        if self._look_at_time(newest.host_s, newest.sample):
            return
        # A crank that swings after a stop may slip; a jump of its count is a gap all the same.
        swings = self._rig.swinging and self._jumped_s is None
        if test is not None and self._core.state in ACTIVE and not swings:
            if self._look_at_turns(test):
                return
            self._look_at_jump(test, newest.host_s)

    def known(self, seconds: float) -> bool:
        """Take a gap of which the device says how long it was; return whether it ends the test.

        The device may know less than the encoder: the host's clock tells it, which a simulated rig
        is faster than.
        """
        test, assembler = self._core.test, self._rig.processor.assembler
        self._accept()
        if test is None or self._core.state not in ACTIVE:
            return False
        turned = abs(assembler.motion.turned_in_gap) / assembler.encoder.counts_per_revolution
        seconds = max(seconds, turned / self._rev_per_s(test))
        return self._ends(seconds)

    def revolution(self, revolution: Revolution) -> None:
        """Take a revolution of the test: its end shows whether a jump was one of the encoder's."""
        flags = Flag.LOST_SAMPLES | Flag.GAP_BEFORE | Flag.TIME_JUMP
        if revolution.skipped_counts and not revolution.flags & flags:
            turn = self._rig.processor.assembler.encoder.counts_per_revolution
            self._skipped = (revolution.skipped_counts / turn) % 1.0
        elif revolution.flags & Flag.COUNT_MISMATCH:
            self._jumped_s = None

    def outstanding_s(self) -> float:
        """Return for how long samples are outstanding, s of the rig, as far as the drive shows.

        They may be late or lost: the drive has turned since the newest ones.
        """
        test, status = self._core.test, self._rig.control.status
        newest, level = self._rig.processor.motion.turns(), self._turns.level
        if test is None or status is None or newest is None or self._core.state not in ACTIVE:
            return 0.0
        turns = status.position_count / self._rig.counts_per_turn - newest[0] - level
        return turns / self._rev_per_s(test) if 0.0 < turns < MOST_MISSING else 0.0

    # --- witnesses -------------------------------------------------------------------------------

    def _look_at_time(self, host_s: float, sample: int) -> bool:
        """Compare host and device time, of a rig in real time whose device keeps time."""
        calibration = self._rig.processor.calibration
        by_encoder = calibration.counter.clock is SampleClock.ENCODER
        if self._core.rig.record.simulated_samples or by_encoder:
            return False
        grown = self._time.add(host_s - sample / calibration.sample_rate_Hz, host_s)
        least_s = LATE_S if self._jumped_s is None else JUMP_LATE_S
        if not grown > least_s:
            return False
        self._turns.restart()
        self._found(grown)
        return True

    def _look_at_turns(self, test: ActiveTest) -> bool:
        """Compare the turns of drive and encoder."""
        status, motion = self._rig.control.status, self._rig.processor.motion
        if status is None or status.host_time_ns == self._compared_ns:
            return False
        host_s = status.host_time_ns * 1e-9
        turns = motion.turns_at(host_s)
        if turns is None or (self._jumped_s is not None and host_s < self._jumped_s):
            return False
        self._compared_ns = status.host_time_ns
        grown = self._turns.add(status.position_count / self._rig.counts_per_turn - turns, host_s)
        blur_s = SLIP * WINDOW_S if self._jumped_s is None else ANSWER_S
        least = max(HALF_TURN, blur_s * test.target_rpm / 60.0 * motion.pace())
        if not least < grown < MOST_MISSING:
            return False
        if self._skipped is not None:  # the encoder tells the part of a turn
            grown = self._skipped + max(0, round(grown - self._skipped))
        self._time.restart()
        self._found(grown / self._rev_per_s(test))
        return True

    def _look_at_jump(self, test: ActiveTest, host_s: float) -> None:
        """Report a gap that the encoder alone has seen, when the others had their time."""
        skipped, jumped_s = self._skipped, self._jumped_s
        if skipped is not None and jumped_s is not None and host_s - jumped_s >= 2.0 * SHORT_S:
            self._found(skipped / self._rev_per_s(test))

    # --- what follows ----------------------------------------------------------------------------

    def _accept(self) -> None:
        """Take the lags that come next as they are: the gap is known."""
        self._time.restart()
        self._turns.restart()
        self._jumped_s = self._skipped = None

    def _found(self, seconds: float) -> None:
        """Record a gap; power off when it is as long as stale data."""
        run, device = self._core, self._rig.source.name
        self._jumped_s = self._skipped = None
        self._rig.processor.assembler.flag_time_jump()
        if run.test is not None and run.state in ACTIVE:
            run.gap(
                say(
                    "{} sent no samples for {:.2f} s, and their number is not known",
                    device,
                    seconds,
                )
            )
            if self._ends(seconds):
                return
        run.warn(make_alarm("time_jump", device=device, seconds=seconds))

    def _ends(self, seconds: float) -> bool:
        """End the test where a gap is too long; a stop that is under way has its own reason."""
        run, limit_s = self._core, self._core.limits.stale_data_s
        if seconds <= limit_s or run.state is RunState.STOPPING:
            return False
        device = self._rig.source.name
        run.act_on(make_alarm("samples_missing", device=device, seconds=seconds, limit_s=limit_s))
        return True

    def _rev_per_s(self, test: ActiveTest) -> float:
        """Return how fast the drive turns, rev/s."""
        status = self._rig.control.status
        speed = abs(status.speed_rev_per_s) if status is not None else 0.0
        return max(speed, SLOWEST * test.target_rpm / 60.0)
