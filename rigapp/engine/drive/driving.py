"""The one place that commands the spindle.

A stop overrules everything: once it is requested, no other command reaches the drive until a new
start. The thread that requests a stop sends it itself; the drive thread then makes sure that the
spindle comes to a standstill.

Two locks: ``_deciding`` guards what is to be done and is never held while the drive is called;
``_commanding`` is held around a speed command or a reset, which may take seconds. A power-off takes
no lock: it waits for no other command.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from rigapp.engine.drive.sequences import (
    CREEP_RPM,
    DriveStep,
    PauseSequence,
    StandstillEvidence,
    StopSequence,
)
from rigapp.engine.drive.timing import Timing
from rigapp_drivers.api import DeviceError, DriveStatus
from rigapp_drivers.edge import GuardedSpindle

TURNS_TO_AIM = 3.0
"""Turns at creep speed granted for coming to an angle: one to slow down, one whole, one more."""

APPROACH_RPM = 4.0
"""A slower crank is turned at this speed to its rest: a turn of it takes 15 s."""

REST_NEAR_DEG = 5.0
"""A crank so near to its rest is left there; from farther it swings visibly without power."""

BLOCKED_S = 1.0
"""A crank that does not move for so long on the way to its rest is blocked."""

SLOW_FROM_PACE = 20.0
"""A simulated rig that is faster creeps slower by as much: its angle is read each 5 ms."""

PROMPT_S = 0.5
"""An answer that is older is late, however often the drive is polled."""


@dataclass(frozen=True, slots=True)
class Ramp:
    """A speed and its rate of change. from_rpm: the highest of the speeds before it."""

    rpm: float
    rpm_per_s: float
    from_rpm: float = 0.0

    @property
    def down_s(self) -> float:
        """Return how long it takes at most to ramp down from wherever it is."""
        return max(self.rpm, self.from_rpm) / self.rpm_per_s


@dataclass(frozen=True, slots=True)
class RestApproach:
    """Where a crank without power comes to rest, None where nothing drives it, and how to go there.

    limit_rpm: the crank must not turn faster on the way.
    """

    rest_deg: float | None
    limit_rpm: float


class SpindleControl:
    """Command one spindle; ``step`` belongs to the drive thread, the rest to any thread.

    look: returns the encoder's readings. pace: the rig's seconds in one of this computer, 1 for
    a real one.
    """

    def __init__(
        self,
        spindle: GuardedSpindle,
        timing: Timing,
        look: Callable[[float | None], StandstillEvidence],
        pace: Callable[[], float],
        watchdog_s: float,
    ) -> None:
        self._spindle = spindle
        self._timing = timing
        self._look = look
        self._pace = pace
        self._watchdog_s = watchdog_s
        self._deciding = threading.Lock()
        self._commanding = threading.Lock()
        self._power_offs = 0
        self._stop: StopSequence | None = StopSequence.at_rest(timing.coast, watchdog_s)
        self._pause: PauseSequence | None = None
        self._rest: PauseSequence | None = None
        self._rest_deg: float | None = None
        self._off_deg: float | None = None
        self.approach_s = 0.0
        self._ramp = Ramp(0.0, 60.0)
        self._unsent = False
        self.status: DriveStatus | None = None
        self.answered_s = 0.0
        self.last_error: DeviceError | None = None
        self.errors = 0

    # --- commands --------------------------------------------------------------------------------

    def arm(self, ramp: Ramp) -> None:
        """Forget the last stop, which is through, and prepare for a start."""
        with self._deciding:
            self._stop = self._pause = self._rest = None
            self.approach_s = 0.0
            self._ramp, self._unsent = ramp, False

    def run(self) -> None:
        """Turn at the armed speed, unless a stop came since. Raises DeviceError."""
        self._send(self._ramp.rpm)

    def resume(self, ramp: Ramp) -> None:
        """Turn at the test's speed again after a pause, unless a stop came first."""
        with self._deciding:
            if self._ending:
                return
            self._pause = None
            self._ramp, self._unsent = ramp, False
        self._send(ramp.rpm)

    def change(self, ramp: Ramp) -> None:
        """Go to another speed, unless a pause or a stop came first; the drive thread sends it."""
        with self._deciding:
            if not self._ending and self._pause is None:
                before = max(self._ramp.rpm, self._ramp.from_rpm)
                self._ramp = Ramp(ramp.rpm, ramp.rpm_per_s, before)
                self._unsent = True

    def pause_at(self, angle_deg: float) -> None:
        """Begin to pause at a crank angle."""
        creep_rpm = min(self._ramp.rpm, CREEP_RPM)
        limit_s = self._timing.start_margin + self._aiming_s(creep_rpm)
        with self._deciding:
            if not self._ending:
                self._unsent = False
                self._pause = PauseSequence(
                    angle_deg, creep_rpm, self._ramp.rpm_per_s, time.monotonic(), limit_s
                )

    def stop_now(self, off: bool, approach: RestApproach | None = None) -> None:
        """Stop, or take the power off; the command is on its way when this returns.

        approach: turn on to where the crank rests without power, and stop there. A stop without it
        takes its place. Never raises: a command that the drive does not accept is repeated by the
        drive thread.
        """
        seen = self.seen() if approach is not None and not off else None
        with self._deciding:
            self._pause = self._rest = rest = None
            if approach is not None and seen is not None and self._stop is None:
                self._rest = rest = self._approach(approach, seen)
            if rest is None:
                self._begin_stop(off)
        if rest is not None:
            self._step_to_rest(rest)
        elif not self.quiet:  # what the drive receives would feed its watchdog
            self._carry_out(DriveStep.POWER_OFF if off else DriveStep.RAMP_DOWN)

    def _begin_stop(self, off: bool) -> None:
        now = time.monotonic()
        if self._stop is None or self._stop.done:
            self._stop = StopSequence(
                off, now, self._ramp_down_s, self._timing.coast, self._watchdog_s
            )
            self._off_deg = None
        elif off:
            self._stop.cut_power(now)

    def _approach(self, approach: RestApproach, seen: StandstillEvidence) -> PauseSequence | None:
        """Return how the crank gets to its rest; None where it is there, or has none."""
        rest_deg = approach.rest_deg if self._rest_deg is None else self._rest_deg
        if rest_deg is None or (
            seen.is_stationary
            and seen.angle_deg is not None
            and apart_deg(seen.angle_deg, rest_deg) < REST_NEAR_DEG
        ):
            return None
        creep_rpm = min(max(self._ramp.rpm, APPROACH_RPM), CREEP_RPM, approach.limit_rpm)
        self.approach_s = self._timing.stop_margin + self._aiming_s(creep_rpm)
        self._unsent = False
        return PauseSequence(
            rest_deg,
            creep_rpm / max(1.0, self._pace() / SLOW_FROM_PACE),
            self._ramp.rpm_per_s,
            time.monotonic(),
            self.approach_s,
            self._ramp_down_s,
            self._slow * (BLOCKED_S + creep_rpm / self._ramp.rpm_per_s),
        )

    @property
    def _ramp_down_s(self) -> float:
        """Return how long it takes at most to slow down, late answers of the drive included."""
        return 1.5 * self._slow * self._ramp.down_s + self._timing.stop_margin

    @property
    def _slow(self) -> float:
        """Return how many times slower than real time the rig runs, 1 for a real one."""
        return 1.0 / min(1.0, self._pace())

    def _aiming_s(self, creep_rpm: float) -> float:
        """Return how long it takes at most to come to an angle."""
        return self._slow * (2.0 * self._ramp.down_s + TURNS_TO_AIM * 60.0 / creep_rpm)

    @property
    def _ending(self) -> bool:
        """Return whether a stop was requested: no other command may reach the drive then."""
        return self._stop is not None or self._rest is not None

    # --- the drive thread ------------------------------------------------------------------------

    @property
    def stopping(self) -> StopSequence | None:
        """Return the stop under way."""
        return self._stop

    @property
    def busy(self) -> bool:
        """Return whether a pause or a stop is under way."""
        stop = self._stop
        under_way = stop is not None and not stop.done
        return under_way or self._pause is not None or self._rest is not None

    @property
    def quiet(self) -> bool:
        """Return whether nothing may be sent to the drive, so that its watchdog acts."""
        stop = self._stop
        return stop is not None and stop.quiet and not stop.done

    @property
    def power_cut(self) -> bool:
        """Return whether the drive took the command to cut the power.

        A crank without power may swing under the spring, faster than it ran: nothing can be done
        about it, and the stop waits for the standstill.
        """
        stop = self._stop
        return stop is not None and stop.power_cut

    def poll(self) -> DriveStatus | None:
        """Read the drive's status, which feeds its watchdog; None when it did not answer."""
        try:
            status = self._spindle.status()
        except DeviceError as error:
            self._note(error)
            return None
        self.status = status
        self.answered_s = time.monotonic()
        return status

    def reset_fault(self) -> None:
        """Acknowledge the drive's faults; the motor stays off. Raises DeviceError."""
        with self._one_command():
            self._spindle.reset_fault()
        self.poll()

    @property
    def ramp_unanswered(self) -> bool:
        """Return whether the drive has not accepted a controlled stop for too long.

        The thread that commanded it may wait behind another command, and the drive thread too.
        """
        stop = self._stop
        return stop is not None and stop.ramp_unanswered(time.monotonic())

    @property
    def answering(self) -> bool:
        """Return whether the drive answered lately."""
        return time.monotonic() - self.answered_s < self.prompt_s

    @property
    def prompt_s(self) -> float:
        """Return the age up to which an answer counts as a late one."""
        return max(PROMPT_S, 3 * self._timing.poll)

    def seen(self) -> StandstillEvidence:
        """Return the readings of drive and encoder."""
        status = self.status
        known = status is not None and self.answering
        rpm = status.speed_rev_per_s * 60.0 if status is not None and known else math.nan
        return self._look(None if math.isnan(rpm) else rpm)  # a drive may measure no speed

    def step(self) -> DriveStep:
        """Take the pause or stop under way one step further, and return what was done."""
        rest = self._rest
        if rest is not None:
            self._step_to_rest(rest)
            return DriveStep.WAIT
        seen = self.seen() if self._stop is not None or self._pause is not None else None
        with self._deciding:
            stop, pause = self._stop, self._pause
            do = DriveStep.WAIT
            if seen is not None and (sequence := stop or pause) is not None:
                do = sequence.step(seen)
        if stop is not None:
            if do in (DriveStep.RAMP_DOWN, DriveStep.POWER_OFF):
                self._carry_out(do)
            if seen is not None:
                self._learn_rest(do, seen)
            return do
        if pause is None:
            self._send_changed()
            return DriveStep.WAIT
        do = self._aim(pause, do)
        if do in (DriveStep.STANDING, DriveStep.GIVE_UP):
            with self._deciding:
                self._pause = None
        return do

    def _aim(self, sequence: PauseSequence, do: DriveStep) -> DriveStep:
        """Carry out a step towards an angle; give up where the drive refuses."""
        try:
            if do is DriveStep.CREEP:
                self._send(sequence.creep_rpm, sequence)
            elif do is DriveStep.RAMP_DOWN:
                self._send(0.0, sequence)
        except DeviceError as error:
            self._note(error)
            return DriveStep.GIVE_UP
        return do

    def _step_to_rest(self, rest: PauseSequence) -> None:
        """Turn on towards the rest, and stop there.

        Stop at once where drive or angle are not known, without power where the crank does not do
        what was commanded.
        """
        seen = self.seen()
        known = seen.drive_rpm is not None and seen.angle_deg is not None
        with self._deciding:
            if self._rest is not rest:
                return
            do = rest.step(seen) if known else DriveStep.GIVE_UP
        off = known and do is DriveStep.GIVE_UP
        if self._aim(rest, do) not in (DriveStep.STANDING, DriveStep.GIVE_UP):
            return
        with self._deciding:
            if self._rest is not rest:
                return
            self._rest = None
            self._begin_stop(off)
        self._carry_out(DriveStep.POWER_OFF if off else DriveStep.RAMP_DOWN)

    def _learn_rest(self, do: DriveStep, seen: StandstillEvidence) -> None:
        """Remember where the crank came to rest when it left the angle of a regular stop."""
        now_deg, off_deg = seen.angle_deg, self._off_deg
        if now_deg is None:
            return
        if off_deg is None:
            if do is DriveStep.POWER_OFF and seen.is_stationary:
                self._off_deg = now_deg
        elif do is DriveStep.STANDING and apart_deg(now_deg, off_deg) > REST_NEAR_DEG:
            self._rest_deg = now_deg

    def _carry_out(self, do: DriveStep) -> None:
        """Command the stop under way; repeat it until the drive accepts it."""
        stop = self._stop
        if stop is None:
            return
        try:
            if do is DriveStep.POWER_OFF:
                self._power_offs += 1
                self._spindle.drive_off()
            else:
                with self._one_command():
                    if stop.off:
                        return
                    self._set_speed(0.0)
        except DeviceError as error:
            self._note(error)
        else:
            with self._deciding:
                stop.commanded(do, time.monotonic())

    def _send_changed(self) -> None:
        """Send a changed speed; repeat it until the drive accepts it."""
        with self._deciding:
            if not self._unsent or self._ending:
                return
            self._unsent = False
        try:
            self._send(self._ramp.rpm)
        except DeviceError as error:
            self._note(error)
            self._unsent = True

    def _send(self, rpm: float, sequence: PauseSequence | None = None) -> None:
        """Command a speed, unless a stop came first. Raises DeviceError.

        sequence: which commands it; that of the rest is the beginning of a stop.
        """
        with self._one_command():
            if self._stop is None and self._rest in (None, sequence):
                self._set_speed(rpm)

    def _set_speed(self, rpm: float) -> None:
        self._spindle.set_speed(rpm / 60.0, self._ramp.rpm_per_s / 60.0)

    @contextmanager
    def _one_command(self) -> Iterator[None]:
        """Send the drive one command at a time, and repeat a power-off requested meanwhile.

        It is not known which of the two the drive executed last.
        """
        with self._commanding:
            before = self._power_offs
            try:
                yield
            except DeviceError as error:
                if self._power_offs == before:
                    raise
                self._note(error)
            finally:
                if self._power_offs != before and not self.quiet:
                    self._carry_out(DriveStep.POWER_OFF)

    def _note(self, error: DeviceError) -> None:
        self.last_error = error
        self.errors += 1


def apart_deg(first: float, second: float) -> float:
    """Return the angle between two directions, 0 to 180 deg."""
    return abs((first - second + 180.0) % 360.0 - 180.0)
