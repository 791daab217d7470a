"""Sequences that stop the spindle: decisions only, without I/O or clock.

A sequence is called repeatedly with the readings of drive and encoder, and returns the next step.
"""

from __future__ import annotations

import enum
import math
from dataclasses import dataclass

from rigapp.texts import say

STANDING_RPM = 1.0  # above the ripple of a drive's own encoder at standstill
RETRY_S = 0.1
"""Period of repetition of a failed or ineffective command: no drive replies faster."""
IGNORED_S = 0.4
"""Time after which a drive that has not accepted a command ignores it, or cannot reply."""
SEGMENT_S = 1.0
"""Shortest segment for the mean speed of complete turns."""
STEADY_SHARE = 0.03
"""Change of speed between segments below which the motor drives the crank: a crank that comes to
rest within the coast time of 15 s loses 1/15 of its speed in the first second."""
STEADY_AT_REST = 3
"""Consecutive steady segments that exclude turning by hand. During a stop one is enough, as nobody
turns the crank by hand then."""
CREEP_RPM = 10.0  # 60 deg/s: a cycle of the drive thread is a third of a degree
CREEPING_SHARE, CREEPING_RPM = 1.15, 0.5
"""Factor of and addition to the creep speed up to which the crank creeps: ripple and counts."""

HALF_CYCLE_S = 0.0025
"""Half of the drive's cycle during the approach (``Timing.aim``): selects the cycle nearest to the
angle."""


class DriveStep(enum.Enum):
    """Next step of a sequence."""

    WAIT = "wait"
    RAMP_DOWN = "ramp down"
    CREEP = "creep"
    POWER_OFF = "power off"
    STANDING = "standing"
    NO_EFFECT = "no effect"
    GIVE_UP = "give up"


@dataclass(frozen=True, slots=True)
class StandstillEvidence:
    """Present readings of the spindle.

    drive_rpm: by the drive, None without a reply. encoder_rpm, encoder_stands: by the crank
    encoder, None if its data are stale. drive_s, encoder_s: host time of the two.
    angle_deg: present crank angle, extrapolated. deg_per_s: its change per second of host time.
    turns: of the crank, signed, by the encoder, or by the drive if the encoder's data are stale;
    turns_s: time of these, of the same device.
    """

    now_s: float
    drive_rpm: float | None
    encoder_rpm: float | None
    encoder_stands: bool | None
    angle_deg: float | None = None
    deg_per_s: float = 0.0
    drive_s: float = math.inf
    encoder_s: float = math.inf
    turns: float | None = None
    turns_s: float = 0.0

    def later_than(self, time_s: float) -> bool:
        """Return whether the readings are newer than a host time."""
        drive = self.drive_rpm is None or self.drive_s > time_s
        return drive and (self.encoder_stands is None or self.encoder_s > time_s)

    @property
    def is_stationary(self) -> bool:
        """Return whether all readings show a standstill."""
        known = False
        if self.drive_rpm is not None:
            if abs(self.drive_rpm) >= STANDING_RPM:
                return False
            known = True
        if self.encoder_stands is not None:
            return self.encoder_stands
        return known

    @property
    def moves(self) -> bool:
        """Return whether drive or encoder show motion; insufficient data do not."""
        rpm = max(
            abs(self.drive_rpm or 0.0), 0.0 if self.encoder_stands else abs(self.encoder_rpm or 0.0)
        )
        return rpm >= STANDING_RPM

    @property
    def witnesses(self) -> str:
        """Return a text with the devices that confirm the standstill."""
        drive, encoder = self.drive_rpm is not None, self.encoder_stands is not None
        if drive and encoder:
            return say("drive and encoder")
        return (
            say("the drive only")
            if drive
            else say("the encoder only")
            if encoder
            else say("nobody")
        )


class SpeedTrend:
    """Comparison of the mean speed of consecutive segments of complete turns.

    The work of spring, weight and friction is the same in each turn, so that a crank without power
    becomes slower from turn to turn, and one driven by the motor does not.
    """

    def __init__(self) -> None:
        self._start: tuple[float, float] | None = None
        self._rev_per_s: float | None = None
        self.steady = 0

    def add(self, turns: float, time_s: float) -> None:
        """Add the latest turns; ``steady`` counts consecutive segments of constant speed."""
        if self._start is None:
            self._start = turns, time_s
            return
        turns_made, elapsed_s = turns - self._start[0], time_s - self._start[1]
        if abs(turns_made) < 1.0 or elapsed_s < SEGMENT_S:
            return
        before, now = self._rev_per_s, turns_made / elapsed_s
        constant = before is not None and abs(now - before) < STEADY_SHARE * abs(before)
        self.steady = self.steady + 1 if constant else 0
        self._start, self._rev_per_s = (turns, time_s), now


class StopSequence:
    """Stop: ramp down, confirm the standstill, switch the power off; escalate if it still turns.

    Decided by the encoder, not by the drive's acknowledgement: the power-off is repeated while the
    crank moves. If it has no effect, or is not accepted, nothing is sent for a while (``quiet``):
    any message feeds the drive's watchdog, and only the watchdog can then stop it. The same applies
    if only the drive reports a standstill, which may be wrong. The sequence continues after
    GIVE_UP, and restarts when a stationary crank begins to turn.

    off: without ramp. ramp_s, coast_s: longest time for the ramp and for coasting without power.
    watchdog_s: time-out of the drive's watchdog.
    """

    def __init__(
        self, off: bool, now_s: float, ramp_s: float, coast_s: float, watchdog_s: float = 0.5
    ) -> None:
        self._off = off
        self._trying_since = self._repeated_from = now_s
        self._quiet_s = 2.0 * watchdog_s + 0.2  # twice, for a simulated drive (``processclock``)
        self._quiet_until = self._watchdog_from = -math.inf
        self.quiet = False
        self._off_done = False
        self._ramp_done = False
        self._last_try = -1e9
        self._commanded_s = -math.inf
        self._coast_s = coast_s
        self._trend = SpeedTrend()
        self._steady_limit = 1
        self._deadline = now_s + (coast_s if off else ramp_s)
        self.done = False
        self.given_up = False
        self.by_itself = False
        self.escalated = False
        self.ignored = False
        self.unseen = False
        self.witnesses = ""

    @classmethod
    def at_rest(cls, coast_s: float, watchdog_s: float) -> StopSequence:
        """Return a completed stop, for a crank that has not turned yet."""
        stop = cls(True, 0.0, 0.0, coast_s, watchdog_s)
        stop.done = stop._off_done = True
        return stop

    @property
    def how(self) -> str:
        """Return a text on how the standstill was reached."""
        if not self._off_done:
            return say("though the drive accepted no command")
        if self.ignored:
            return say("though the power-off had no effect")
        if self.unseen:
            return say("without power, and its watchdog has had the time to stop it")
        return say("after the power had to be cut") if self.escalated else say("without power")

    @property
    def off(self) -> bool:
        """Return whether the power is to be switched off, directly or after a failed ramp."""
        return self._off

    def ramp_unanswered(self, now_s: float) -> bool:
        """Return whether the drive has not accepted a ramp down in time."""
        waited_s = now_s - self._trying_since
        return not (self._off or self._ramp_done) and waited_s > 2.0 * IGNORED_S

    @property
    def power_cut(self) -> bool:
        """Return whether the drive has accepted the power-off."""
        return self._off_done

    def commanded(self, do: DriveStep, now_s: float) -> None:
        """Record that the drive has accepted a command."""
        self._commanded_s = self._trying_since = self._last_try = now_s
        if do is DriveStep.RAMP_DOWN:
            self._ramp_done = True
        elif do is DriveStep.POWER_OFF:
            self._off_done = True

    def cut_power(self, now_s: float) -> None:
        """Change to a stop with power off."""
        if not self._off:
            self._off = True
            self._deadline = now_s + self._coast_s
            self._trying_since = self._repeated_from = now_s
            self._trend = SpeedTrend()

    def step(self, seen: StandstillEvidence) -> DriveStep:
        """Return the next step.

        STANDING is returned once per standstill, NO_EFFECT and GIVE_UP once; the stop continues.
        """
        if self.done and not self._restart_if_moving(seen):
            return DriveStep.WAIT
        is_stationary = seen.is_stationary and seen.later_than(self._commanded_s)
        if seen.turns is not None:
            self._trend.add(seen.turns, seen.turns_s)
        if not self._off:
            if is_stationary and (self._ramp_done or seen.drive_rpm is None):
                self.cut_power(seen.now_s)
            elif seen.now_s > self._deadline or self._not_accepted(self._ramp_done, seen.now_s):
                self.escalated = True
                self.cut_power(seen.now_s)
            elif not self._ramp_done or self._trend.steady:
                return self._try(DriveStep.RAMP_DOWN, seen.now_s)
            else:
                return DriveStep.WAIT
            self._last_try = -1e9
        if self._unconfirmed(is_stationary, seen):
            return DriveStep.WAIT
        if is_stationary and (self._off_done or seen.drive_rpm is None):
            self.witnesses = seen.witnesses
            self.done, self.quiet = True, False
            return DriveStep.STANDING
        if seen.now_s > self._deadline and not self.given_up:
            self.witnesses = seen.witnesses
            self.given_up = True
            return DriveStep.GIVE_UP
        return self._repeat(seen)

    def _restart_if_moving(self, seen: StandstillEvidence) -> bool:
        """Restart the sequence if a stationary crank moves; return whether it does."""
        if not seen.moves:
            return False
        self.done, self.by_itself, self.ignored, self.unseen = False, True, False, False
        self._last_try, self._trying_since, self._repeated_from = -1e9, seen.now_s, seen.now_s
        self._steady_limit, self._trend = STEADY_AT_REST, SpeedTrend()
        self._deadline = math.inf
        return True

    def _unconfirmed(self, is_stationary: bool, seen: StandstillEvidence) -> bool:
        """Wait once for the drive's watchdog if only the drive reports a standstill.

        Its own encoder may have failed, and its acknowledgement of the power-off may be wrong.
        """
        if seen.encoder_stands is not None:
            self.unseen = False
        elif is_stationary and self._off_done and not self.unseen:
            self.unseen = True
            self._wait_for_watchdog(seen.now_s)
            self._commanded_s = self._quiet_until  # only later readings are valid
            self._deadline = max(self._deadline, self._quiet_until + SEGMENT_S)
        return self.unseen and seen.now_s < self._quiet_until

    def _wait_for_watchdog(self, now_s: float) -> None:
        self.quiet = True
        self._quiet_until = self._trying_since = self._repeated_from = now_s + self._quiet_s
        self._trend = SpeedTrend()

    def _repeat(self, seen: StandstillEvidence) -> DriveStep:
        """Repeat the power-off, or wait for the drive's watchdog."""
        now_s = seen.now_s
        self.quiet = now_s < self._quiet_until
        if self.quiet:
            return DriveStep.WAIT
        # Readings from before the last command: wait for later ones.
        if seen.is_stationary and self._off_done:
            self._trying_since = now_s
            return DriveStep.WAIT
        steady = self._trend.steady >= self._steady_limit
        tried = now_s - self._repeated_from > IGNORED_S
        too_long = (steady and tried) or now_s > max(self._deadline, self._watchdog_from)
        ignored = self._off_done and too_long
        if not ignored and not self._not_accepted(False, now_s):
            return self._try(DriveStep.POWER_OFF, now_s)
        self._wait_for_watchdog(now_s)
        if not ignored:
            return DriveStep.WAIT
        self._watchdog_from = self._quiet_until + self._quiet_s
        before, self.ignored = self.ignored, True
        return DriveStep.WAIT if before else DriveStep.NO_EFFECT

    def _not_accepted(self, accepted: bool, now_s: float) -> bool:
        return not accepted and now_s - self._trying_since > IGNORED_S

    def _try(self, do: DriveStep, now_s: float) -> DriveStep:
        if now_s - self._last_try < RETRY_S:
            return DriveStep.WAIT
        self._last_try = now_s
        return do


class PauseSequence:
    """Pause: decelerate to creep speed, then stop the crank at the set angle.

    deceleration_rpm_per_s: of the drive's ramp. limit_s: longest time for the sequence. slow_s:
    longest time until creep speed. blocked_s: longest time without motion on the way.
    """

    def __init__(
        self,
        angle_deg: float,
        target_rpm: float,
        deceleration_rpm_per_s: float,
        now_s: float,
        limit_s: float,
        slow_s: float = math.inf,
        blocked_s: float = math.inf,
    ) -> None:
        self._angle = angle_deg
        self._creep = min(target_rpm, CREEP_RPM)
        self._deceleration = deceleration_rpm_per_s
        self._deadline = now_s + limit_s
        self._phase = DriveStep.CREEP
        self._before: float | None = None
        self._slow_by = now_s + slow_s
        self._blocked_s = blocked_s
        self._moved_s = now_s

    @property
    def creep_rpm(self) -> float:
        """Return the speed of the approach."""
        return self._creep

    def step(self, seen: StandstillEvidence) -> DriveStep:
        """Return the next step; the caller performs each CREEP and RAMP_DOWN once."""
        if seen.now_s > self._deadline:
            return DriveStep.GIVE_UP
        if self._phase is DriveStep.CREEP:
            self._phase = DriveStep.WAIT
            return DriveStep.CREEP
        if self._phase is DriveStep.WAIT:
            if not seen.encoder_stands:
                self._moved_s = seen.now_s
            elif seen.now_s - self._moved_s > self._blocked_s:
                return DriveStep.GIVE_UP
            if seen.encoder_rpm is None or seen.angle_deg is None:
                return DriveStep.WAIT
            if abs(seen.encoder_rpm) > CREEPING_SHARE * self._creep + CREEPING_RPM:
                return DriveStep.GIVE_UP if seen.now_s > self._slow_by else DriveStep.WAIT
            self._slow_by = math.inf
            if not self._reached(seen):
                return DriveStep.WAIT
            self._phase = DriveStep.RAMP_DOWN
            return DriveStep.RAMP_DOWN
        return DriveStep.STANDING if seen.is_stationary else DriveStep.WAIT

    def _reached(self, seen: StandstillEvidence) -> bool:
        assert seen.angle_deg is not None
        assert seen.encoder_rpm is not None
        # rpm^2 / (2 rpm/s) is in rev/min s; times 6 in degrees.
        braking = 6.0 * seen.encoder_rpm**2 / (2.0 * self._deceleration)
        sense = 1.0 if seen.encoder_rpm >= 0 else -1.0
        to_go = (sense * (self._angle - seen.angle_deg) - braking) % 360.0
        before, self._before = self._before, to_go
        passed = before is not None and to_go > before + 180.0
        return passed or to_go < abs(seen.deg_per_s) * HALF_CYCLE_S
