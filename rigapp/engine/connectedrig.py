"""The devices of a rig while they are connected, and their newest readings."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import replace

from rigapp.engine.core import Core
from rigapp.engine.devices import Devices
from rigapp.engine.drive.driving import SpindleControl
from rigapp.engine.drive.sequences import StandstillEvidence
from rigapp.engine.identifying import identity_record
from rigapp.engine.processing import Processor
from rigapp.engine.samples.buffers import BlockQueue
from rigapp.engine.samples.slow import SlowChannels, SlowDevice
from rigapp.engine.values.calibrate import Calibration
from rigapp.process.processclock import Lateness
from rigapp.process.threads import Worker
from rigapp.schema.alarms import Cause, make_alarm
from rigapp.schema.channels import LOAD_CELL
from rigapp.schema.messages import RunState
from rigapp.texts import joined, say
from rigapp_drivers.api import Identity, SlowRequest, SlowSource, StreamSetup
from rigapp_drivers.edge import GuardedSlow

SMALLEST_QUEUE = 16384  # samples; the largest burst after a pause of the host
PACED_SAMPLES = 4096
"""Unprocessed samples from which a simulated device pauses, or the samples of ``queue_age`` if that
is more: a stop is not seen late, and no pass is idle."""

FRESH_S = 0.5
"""An older sample does not show the crank's present motion."""

SLOWEST_PACE = 0.02
"""A simulated rig that runs slower than this has hung: time-outs are not stretched any more."""

SHORT_SILENCE_S = 2.0
"""A start waits for the end of a silence that has not lasted so long, and refuses a longer one."""


class ConnectedRig:
    """The open devices, the samples that wait and those that are processed.

    The threads of a ``Connection`` feed it; any thread may read it. received_s: host time of the
    newest samples; in_hand_ns: that of the block being processed, None between two. is_processing:
    whether the thread that processes them runs; samples that it has not processed prove nothing.
    """

    def __init__(
        self,
        core: Core,
        devices: Devices,
        setup: StreamSetup,
        calibration: Calibration,
        is_processing: Callable[[], bool],
    ) -> None:
        self._core = core
        self._is_processing = is_processing
        self.devices, self.setup = devices, setup
        self.source, self.spindle = devices.source, devices.spindle
        timing, rig, drive = core.timing, core.rig.record, devices.drive_request
        self._simulated = rig.simulated
        self.processor = Processor(
            calibration, lambda: core.limits.overload_N, real_time=not rig.simulated_samples
        )
        self.queue = BlockQueue(max(SMALLEST_QUEUE, round(timing.queue * setup.sample_rate_Hz)))
        self.paced_samples = max(PACED_SAMPLES, round(timing.queue_age * setup.sample_rate_Hz))
        self.control = SpindleControl(
            devices.spindle, timing, self._look, self.pace, drive.watchdog_timeout_s
        )
        self.counts_per_turn = drive.counts_per_crank_revolution
        self.received_s = time.monotonic()
        self.in_hand_ns: int | None = None
        self.lateness = Lateness(time.monotonic(), 0.0)
        self.closing = threading.Event()
        self.slow_channels = SlowChannels(
            core.table.slow,
            [self._open_slow(source, request) for source, request in devices.slow],
            devices.spindle.name,
            lambda: self.control.status,
            self.age_s,
        )

    def _open_slow(self, source: GuardedSlow, request: SlowRequest) -> SlowDevice:
        """Return a slow source with its thread, whose failure raises a warning only."""

        def opened(identity: Identity, readback: Mapping[str, str | float | int]) -> None:
            self.devices.identities[source.name] = identity
            self.devices.readback[source.name] = {**identity_record(identity), **readback}

        def died(worker: Worker, error: BaseException) -> None:
            self._core.act_on(slow_silent(source, 0.0, say("it failed ‹{}›", repr(error))))

        return SlowDevice(source, request, opened, died, self._core.timing.silence)

    # --- what a start waits for ------------------------------------------------------------------

    def not_yet(self, stale_data_s: float) -> str:
        """Return what a start waits for, as a phrase; empty for nothing."""
        silence = self._silence(stale_data_s)
        cut_off = self.processor.saturated.intersection(self._core.table.names_of(LOAD_CELL))
        if silence or not cut_off:
            return silence
        return say("{} at the end of the range", joined(say(" and "), sorted(cut_off)))

    def _silence(self, stale_data_s: float) -> str:
        age = self.age_s(self.received_s)
        if age >= stale_data_s:
            return say("no samples received for {:.1f} s", age)
        if self.age_s(self.control.answered_s) >= self.control.prompt_s:
            return say("the drive does not answer")
        return ""

    def wait_out_silence(self, stale_data_s: float) -> None:
        """Wait while samples or the drive are silent, unless for more than SHORT_SILENCE_S."""
        while self._silence(stale_data_s):
            heard_s = min(self.received_s, self.control.answered_s)
            if time.monotonic() - heard_s > SHORT_SILENCE_S:
                return
            self.closing.wait(0.01)

    def ramp_deadline_s(self, rpm: float, rpm_per_s: float) -> float:
        """Return the host time by which a speed commanded now must be reached or left."""
        ramp_s = 2.0 * self.slow() * rpm / rpm_per_s
        return time.monotonic() + self._core.timing.start_margin + ramp_s

    # --- ages ------------------------------------------------------------------------------------

    @property
    def backed_up(self) -> bool:
        """Return whether the reader leaves samples on the wire until those before are processed.

        Only simulated samples wait so: their time waits on the wire with them, which makes
        ``--speed max`` as fast as the engine. A real device would lose them.
        """
        simulated = self._core.rig.record.simulated_samples
        return simulated and self.queue.samples >= self.paced_samples

    def queue_age_s(self) -> float:
        """Return the age of the oldest samples that are not processed yet, 0 when none wait."""
        waiting = (self.in_hand_ns, self.queue.oldest_ns)
        oldest = min((age for age in waiting if age is not None), default=None)
        return 0.0 if oldest is None else max(0.0, self.age_s(oldest * 1e-9))

    def data_age_s(self) -> float:
        """Return the seconds since the last samples came."""
        return time.monotonic() - self.received_s

    def age_s(self, since_s: float) -> float:
        """Return the age of a host time, to judge a silence by.

        A simulated rig runs on this computer: time in which the computer did not run the engine is
        not counted. A rig with a real device is judged by the clock.
        """
        now = time.monotonic()
        late = self.lateness.since(since_s, now) if self._simulated else 0.0
        return now - since_s - late

    # --- the crank -------------------------------------------------------------------------------

    @property
    def swinging(self) -> bool:
        """Return whether the crank may turn freely: its power is off, or was commanded off.

        The spring can swing it faster than it ran. That follows from the stop, and is no alarm.
        """
        test, control = self._core.test, self.control
        if control.power_cut:
            return True
        if test is None or self._core.state is not RunState.STOPPING:
            return False
        return test.off or not control.answering

    @property
    def coasting(self) -> bool:
        """Return whether the crank turns without power in a stop: the spring drives it."""
        return (
            self._core.state is RunState.STOPPING
            and self.control.power_cut
            and not self.processor.motion.standing(self._core.timing.standing)
        )

    def is_stationary(self) -> bool:
        """Return whether the crank is stationary; waits for enough data."""
        window = self._core.timing.standing
        deadline = time.monotonic() + 4.0 * window * self.slow() + 0.5
        while not self.processor.motion.standing(window):
            if time.monotonic() > deadline:
                return False
            self.closing.wait(0.01)
        return True

    def _look(self, drive_rpm: float | None) -> StandstillEvidence:
        now = time.monotonic()
        motion = self.processor.motion
        newest = motion.newest()
        fresh = (
            newest is not None
            and now - newest.host_s < max(FRESH_S, 2 * self._core.timing.standing)
            and self._is_processing()
            and not self._core.alarms.is_active("encoder_lost")
        )
        if newest is None or not fresh:
            seen = StandstillEvidence(now, drive_rpm, None, None, drive_s=self.control.answered_s)
            status = self.control.status
            if drive_rpm is None or status is None:
                return seen
            turned, time_s = (
                status.position_count / self.counts_per_turn,
                status.host_time_ns * 1e-9,
            )
            return replace(seen, turns=turned, turns_s=time_s)
        rpm = motion.speed_rpm()
        turns, turns_s = motion.turns() or (None, 0.0)
        return StandstillEvidence(
            now_s=now,
            drive_rpm=drive_rpm,
            encoder_rpm=rpm,
            encoder_stands=motion.standing(self._core.timing.standing),
            angle_deg=motion.angle_deg(now),
            deg_per_s=rpm * 6.0 * motion.pace(),
            drive_s=self.control.answered_s,
            encoder_s=newest.host_s,
            turns=turns,
            turns_s=turns_s,
        )

    def slow(self) -> float:
        """Return how many times slower than real time the rig runs, 1 for a real one."""
        return 1.0 / min(1.0, self.pace())

    def pace(self) -> float:
        """Return the seconds of the rig in a second of this computer, 1 for a real one."""
        if not self._core.rig.record.simulated_samples:
            return 1.0
        return max(SLOWEST_PACE, self.processor.motion.pace())


def slow_silent(source: SlowSource, age_s: float, error: str) -> Cause:
    """Return the alarm of a slow device without readings; error: its last one, if any."""
    why = f" ({error.rstrip('.')})" if error else ""
    return make_alarm("slow_silent", source.name, port=source.port, age_s=age_s, why=why)
