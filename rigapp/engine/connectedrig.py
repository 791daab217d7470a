"""The connected devices of a rig and their latest readings."""

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

SMALLEST_QUEUE = 16384  # samples; a possible burst after a pause of the host
PACED_SAMPLES = 4096
"""Unprocessed samples from which simulated ones wait on the wire; those of ``queue_age`` if more.
Low enough to detect a stop in time, high enough that no pass is idle."""

FRESH_S = 0.5
"""Age up to which a sample shows the crank's present motion."""

SLOWEST_PACE = 0.02
"""Least pace of a simulated rig to which time-outs are scaled; a slower rig hangs."""

SHORT_SILENCE_S = 2.0
"""Silence up to which a start waits for its end; after a longer one it is refused."""


class ConnectedRig:
    """Open devices, queued samples and processed samples.

    The threads of a ``Connection`` write to it; any thread may read it. received_s: host time of
    the latest samples; in_hand_ns: that of the block in processing, else None. is_processing:
    whether the processing thread runs; unprocessed samples are no evidence of the motion.
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
            devices.spindle, timing, self._standstill_evidence, self.pace, drive.watchdog_timeout_s
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
        """Return a slow source with its thread; a failure of it only raises a warning."""

        def opened(identity: Identity, readback: Mapping[str, str | float | int]) -> None:
            self.devices.identities[source.name] = identity
            self.devices.readback[source.name] = {**identity_record(identity), **readback}

        def died(worker: Worker, error: BaseException) -> None:
            self._core.act_on(slow_silent(source, 0.0, say("it failed ‹{}›", repr(error))))

        return SlowDevice(source, request, opened, died, self._core.timing.silence)

    # --- readiness -------------------------------------------------------------------------------

    def not_yet(self, stale_data_s: float) -> str:
        """Return the condition that prevents a start, as a phrase, or an empty text."""
        silence = self._silence(stale_data_s)
        at_range_end = self.processor.saturated.intersection(self._core.table.names_of(LOAD_CELL))
        if silence or not at_range_end:
            return silence
        return say("{} at the end of the range", joined(say(" and "), sorted(at_range_end)))

    def _silence(self, stale_data_s: float) -> str:
        age = self.age_s(self.received_s)
        if age >= stale_data_s:
            return say("no samples received for {:.1f} s", age)
        if self.age_s(self.control.answered_s) >= self.control.prompt_s:
            return say("the drive does not answer")
        return ""

    def wait_out_silence(self, stale_data_s: float) -> None:
        """Wait while samples or replies of the drive are missing, up to SHORT_SILENCE_S."""
        while self._silence(stale_data_s):
            last_reply_s = min(self.received_s, self.control.answered_s)
            if time.monotonic() - last_reply_s > SHORT_SILENCE_S:
                return
            self.closing.wait(0.01)

    def ramp_deadline_s(self, rpm: float, rpm_per_s: float) -> float:
        """Return the host time by which a change to a speed or from it must end."""
        ramp_s = 2.0 * self.slow() * rpm / rpm_per_s
        return time.monotonic() + self._core.timing.start_margin + ramp_s

    # --- ages ------------------------------------------------------------------------------------

    @property
    def backed_up(self) -> bool:
        """Return whether the reader leaves samples on the wire until earlier ones are processed.

        For simulated samples only, whose time stops with them: this makes ``--speed max`` as fast
        as the engine. A real device would lose them.
        """
        simulated = self._core.rig.record.simulated_samples
        return simulated and self.queue.samples >= self.paced_samples

    def queue_age_s(self) -> float:
        """Return the age of the oldest unprocessed samples, 0 without any."""
        waiting = (self.in_hand_ns, self.queue.oldest_ns)
        oldest = min((age for age in waiting if age is not None), default=None)
        return 0.0 if oldest is None else max(0.0, self.age_s(oldest * 1e-9))

    def data_age_s(self) -> float:
        """Return the time since the last samples were received, s."""
        return time.monotonic() - self.received_s

    def age_s(self, since_s: float) -> float:
        """Return the age of a host time for time-outs.

        A simulated rig runs on this computer: time in which the computer did not run the engine is
        excluded. With a real device the clock is used.
        """
        now = time.monotonic()
        late = self.lateness.since(since_s, now) if self._simulated else 0.0
        return now - since_s - late

    # --- the crank -------------------------------------------------------------------------------

    @property
    def swinging(self) -> bool:
        """Return whether the crank may turn freely: its power is off, or was commanded off.

        The spring can drive it faster than before. That is a consequence of the stop, not an alarm.
        """
        test, control = self._core.test, self.control
        if control.power_cut:
            return True
        if test is None or self._core.state is not RunState.STOPPING:
            return False
        return test.off or not control.answering

    @property
    def coasting(self) -> bool:
        """Return whether the crank turns without power during a stop, driven by the spring."""
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

    def _standstill_evidence(self, drive_rpm: float | None) -> StandstillEvidence:
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
            evidence = StandstillEvidence(
                now, drive_rpm, None, None, drive_s=self.control.answered_s
            )
            status = self.control.status
            if drive_rpm is None or status is None:
                return evidence
            drive_turns, drive_turns_s = (
                status.position_count / self.counts_per_turn,
                status.host_time_ns * 1e-9,
            )
            return replace(evidence, turns=drive_turns, turns_s=drive_turns_s)
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
        """Return the ratio of real time to the rig's time, at least 1; 1 for a real rig."""
        return 1.0 / min(1.0, self.pace())

    def pace(self) -> float:
        """Return the rig's seconds per second of the host; 1 for a real rig."""
        if not self._core.rig.record.simulated_samples:
            return 1.0
        return max(SLOWEST_PACE, self.processor.motion.pace())


def slow_silent(source: SlowSource, age_s: float, error: str) -> Cause:
    """Return the alarm of a slow device without readings; error: its last error, if any."""
    why = f" ({error.rstrip('.')})" if error else ""
    return make_alarm("slow_silent", source.name, port=source.port, age_s=age_s, why=why)
