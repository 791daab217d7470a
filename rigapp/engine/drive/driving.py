"""All commands to the spindle.

A stop has priority: once it is requested, no other command is sent to the drive until the next
start. The thread that requests a stop sends it; the drive thread then ensures the standstill.

Two locks: ``_deciding`` guards the sequences and is never held while the drive is called;
``_commanding`` is held during a speed command or a reset, which may take seconds. A power-off uses
no lock, so that it waits for no other command.
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
"""Turns at creep speed allowed for the approach of an angle: deceleration, one turn, one more."""

APPROACH_RPM = 4.0
"""Least speed of the approach to rest: 15 s per turn."""

REST_NEAR_DEG = 5.0
"""Distance from the angle of rest without an approach; from farther away the crank swings visibly
without power."""

BLOCKED_S = 1.0
"""Time without motion during the approach to rest after which the crank counts as blocked."""

SLOW_FROM_PACE = 20.0
"""Pace of a simulated rig above which its creep speed is reduced: its angle is read every 5 ms."""

PROMPT_S = 0.5
"""Age from which a reply is late, with any polling period."""


@dataclass(frozen=True, slots=True)
class Ramp:
    """Target speed and acceleration. from_rpm: highest previous speed."""

    rpm: float
    rpm_per_s: float
    from_rpm: float = 0.0

    @property
    def down_s(self) -> float:
        """Return the longest time to ramp down from any speed so far."""
        return max(self.rpm, self.from_rpm) / self.rpm_per_s


@dataclass(frozen=True, slots=True)
class RestApproach:
    """Approach to the angle of rest of a crank without power.

    rest_deg: None without spring and weight. limit_rpm: largest speed of the approach.
    """

    rest_deg: float | None
    limit_rpm: float


class SpindleControl:
    """Control of one spindle; ``step`` is for the drive thread, the rest is thread-safe.

    look: returns the readings for a speed of the drive. pace: the rig's seconds per second of the
    host, 1 for a real rig.
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
        self._read_evidence = look
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
        """Discard the last, completed stop and prepare for a start."""
        with self._deciding:
            self._stop = self._pause = self._rest = None
            self.approach_s = 0.0
            self._ramp, self._unsent = ramp, False

    def run(self) -> None:
        """Accelerate to the armed speed, unless a stop was requested since. Raises DeviceError."""
        self._send(self._ramp.rpm)

    def resume(self, ramp: Ramp) -> None:
        """Accelerate to a speed after a pause, unless a stop was requested."""
        with self._deciding:
            if self._ending:
                return
            self._pause = None
            self._ramp, self._unsent = ramp, False
        self._send(ramp.rpm)

    def change(self, ramp: Ramp) -> None:
        """Change the speed, unless in a pause or a stop; the drive thread sends it."""
        with self._deciding:
            if not self._ending and self._pause is None:
                before = max(self._ramp.rpm, self._ramp.from_rpm)
                self._ramp = Ramp(ramp.rpm, ramp.rpm_per_s, before)
                self._unsent = True

    def pause_at(self, angle_deg: float) -> None:
        """Start a pause at a crank angle."""
        creep_rpm = min(self._ramp.rpm, CREEP_RPM)
        limit_s = self._timing.start_margin + self._approach_time_s(creep_rpm)
        with self._deciding:
            if not self._ending:
                self._unsent = False
                self._pause = PauseSequence(
                    angle_deg, creep_rpm, self._ramp.rpm_per_s, time.monotonic(), limit_s
                )

    def stop_now(self, off: bool, approach: RestApproach | None = None) -> None:
        """Stop, or switch the power off; the command is sent when this returns.

        approach: first turn to the angle of rest; replaced by a later stop without approach. Never
        raises: the drive thread repeats a command that the drive does not accept.
        """
        evidence = self.seen() if approach is not None and not off else None
        with self._deciding:
            self._pause = self._rest = rest = None
            if approach is not None and evidence is not None and self._stop is None:
                self._rest = rest = self._approach(approach, evidence)
            if rest is None:
                self._begin_stop(off)
        if rest is not None:
            self._step_to_rest(rest)
        elif not self.quiet:  # any message would feed the drive's watchdog
            self._send_stop(DriveStep.POWER_OFF if off else DriveStep.RAMP_DOWN)

    def _begin_stop(self, off: bool) -> None:
        now = time.monotonic()
        if self._stop is None or self._stop.done:
            self._stop = StopSequence(
                off, now, self._ramp_down_s, self._timing.coast, self._watchdog_s
            )
            self._off_deg = None
        elif off:
            self._stop.cut_power(now)

    def _approach(
        self, approach: RestApproach, evidence: StandstillEvidence
    ) -> PauseSequence | None:
        """Return the sequence to the angle of rest; None if the crank is there, or has none."""
        rest_deg = approach.rest_deg if self._rest_deg is None else self._rest_deg
        if rest_deg is None or (
            evidence.is_stationary
            and evidence.angle_deg is not None
            and apart_deg(evidence.angle_deg, rest_deg) < REST_NEAR_DEG
        ):
            return None
        creep_rpm = min(max(self._ramp.rpm, APPROACH_RPM), CREEP_RPM, approach.limit_rpm)
        self.approach_s = self._timing.stop_margin + self._approach_time_s(creep_rpm)
        self._unsent = False
        return PauseSequence(
            rest_deg,
            creep_rpm / max(1.0, self._pace() / SLOW_FROM_PACE),
            self._ramp.rpm_per_s,
            time.monotonic(),
            self.approach_s,
            self._ramp_down_s,
            self._time_factor * (BLOCKED_S + creep_rpm / self._ramp.rpm_per_s),
        )

    @property
    def _ramp_down_s(self) -> float:
        """Return the longest time to ramp down, including late replies of the drive."""
        return 1.5 * self._time_factor * self._ramp.down_s + self._timing.stop_margin

    @property
    def _time_factor(self) -> float:
        """Return the ratio of real time to the rig's time, at least 1; 1 for a real rig."""
        return 1.0 / min(1.0, self._pace())

    def _approach_time_s(self, creep_rpm: float) -> float:
        """Return the longest time to approach an angle."""
        return self._time_factor * (2.0 * self._ramp.down_s + TURNS_TO_AIM * 60.0 / creep_rpm)

    @property
    def _ending(self) -> bool:
        """Return whether a stop was requested, which excludes other commands to the drive."""
        return self._stop is not None or self._rest is not None

    # --- the drive thread ------------------------------------------------------------------------

    @property
    def stopping(self) -> StopSequence | None:
        """Return the present stop sequence."""
        return self._stop

    @property
    def busy(self) -> bool:
        """Return whether a pause or a stop is in progress."""
        stop = self._stop
        under_way = stop is not None and not stop.done
        return under_way or self._pause is not None or self._rest is not None

    @property
    def quiet(self) -> bool:
        """Return whether nothing may be sent to the drive, so that its watchdog trips."""
        stop = self._stop
        return stop is not None and stop.quiet and not stop.done

    @property
    def power_cut(self) -> bool:
        """Return whether the drive accepted the power-off.

        The spring may drive a crank without power faster than before; there is no remedy, and the
        stop waits for the standstill.
        """
        stop = self._stop
        return stop is not None and stop.power_cut

    def poll(self) -> DriveStatus | None:
        """Read the drive's status, which feeds its watchdog; None without a reply."""
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
        with self._exclusive_command():
            self._spindle.reset_fault()
        self.poll()

    @property
    def ramp_unanswered(self) -> bool:
        """Return whether the drive has not accepted a controlled stop in time.

        The commanding thread and the drive thread may both wait for another command.
        """
        stop = self._stop
        return stop is not None and stop.ramp_unanswered(time.monotonic())

    @property
    def answering(self) -> bool:
        """Return whether the last reply of the drive is recent."""
        return time.monotonic() - self.answered_s < self.prompt_s

    @property
    def prompt_s(self) -> float:
        """Return the age up to which a reply is recent, s."""
        return max(PROMPT_S, 3 * self._timing.poll)

    def seen(self) -> StandstillEvidence:
        """Return the readings of drive and encoder."""
        status = self.status
        known = status is not None and self.answering
        rpm = status.speed_rev_per_s * 60.0 if status is not None and known else math.nan
        return self._read_evidence(None if math.isnan(rpm) else rpm)  # a drive may measure no speed

    def step(self) -> DriveStep:
        """Perform the next step of the pause or stop in progress, and return it."""
        rest = self._rest
        if rest is not None:
            self._step_to_rest(rest)
            return DriveStep.WAIT
        evidence = self.seen() if self._stop is not None or self._pause is not None else None
        with self._deciding:
            stop, pause = self._stop, self._pause
            do = DriveStep.WAIT
            if evidence is not None and (sequence := stop or pause) is not None:
                do = sequence.step(evidence)
        if stop is not None:
            if do in (DriveStep.RAMP_DOWN, DriveStep.POWER_OFF):
                self._send_stop(do)
            if evidence is not None:
                self._store_rest_angle(do, evidence)
            return do
        if pause is None:
            self._send_changed()
            return DriveStep.WAIT
        do = self._perform(pause, do)
        if do in (DriveStep.STANDING, DriveStep.GIVE_UP):
            with self._deciding:
                self._pause = None
        return do

    def _perform(self, sequence: PauseSequence, do: DriveStep) -> DriveStep:
        """Perform a step towards an angle; give up on a DeviceError of the drive."""
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
        """Perform a step of the approach to rest, and stop there.

        Stops immediately if drive or angle are unknown, with power off if the crank does not follow
        the command.
        """
        evidence = self.seen()
        known = evidence.drive_rpm is not None and evidence.angle_deg is not None
        with self._deciding:
            if self._rest is not rest:
                return
            do = rest.step(evidence) if known else DriveStep.GIVE_UP
        off = known and do is DriveStep.GIVE_UP
        if self._perform(rest, do) not in (DriveStep.STANDING, DriveStep.GIVE_UP):
            return
        with self._deciding:
            if self._rest is not rest:
                return
            self._rest = None
            self._begin_stop(off)
        self._send_stop(DriveStep.POWER_OFF if off else DriveStep.RAMP_DOWN)

    def _store_rest_angle(self, do: DriveStep, evidence: StandstillEvidence) -> None:
        """Store the angle of rest if the crank moved there after the power-off of a stop."""
        now_deg, off_deg = evidence.angle_deg, self._off_deg
        if now_deg is None:
            return
        if off_deg is None:
            if do is DriveStep.POWER_OFF and evidence.is_stationary:
                self._off_deg = now_deg
        elif do is DriveStep.STANDING and apart_deg(now_deg, off_deg) > REST_NEAR_DEG:
            self._rest_deg = now_deg

    def _send_stop(self, do: DriveStep) -> None:
        """Send the command of the present stop; ``step`` repeats it until the drive accepts it."""
        stop = self._stop
        if stop is None:
            return
        try:
            if do is DriveStep.POWER_OFF:
                self._power_offs += 1
                self._spindle.drive_off()
            else:
                with self._exclusive_command():
                    if stop.off:
                        return
                    self._set_speed(0.0)
        except DeviceError as error:
            self._note(error)
        else:
            with self._deciding:
                stop.commanded(do, time.monotonic())

    def _send_changed(self) -> None:
        """Send a changed speed, again at the next step if the drive does not accept it."""
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
        """Send a speed, unless a stop was requested. Raises DeviceError.

        sequence: that commands it; the approach to rest is part of a stop.
        """
        with self._exclusive_command():
            if self._stop is None and self._rest in (None, sequence):
                self._set_speed(rpm)

    def _set_speed(self, rpm: float) -> None:
        self._spindle.set_speed(rpm / 60.0, self._ramp.rpm_per_s / 60.0)

    @contextmanager
    def _exclusive_command(self) -> Iterator[None]:
        """Send one command at a time, and repeat a power-off sent meanwhile.

        It is unknown which of the two the drive executed last.
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
                    self._send_stop(DriveStep.POWER_OFF)

    def _note(self, error: DeviceError) -> None:
        self.last_error = error
        self.errors += 1


def apart_deg(first: float, second: float) -> float:
    """Return the angle between two directions, 0 to 180 deg."""
    return abs((first - second + 180.0) % 360.0 - 180.0)
