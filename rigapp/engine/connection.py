"""The threads between the devices and the file, from connect to disconnect.

=============  ===================================================================================
thread         does
=============  ===================================================================================
``read NAME``  blocks on one data source and queues its Blocks; never calculates
``process``    overload, assemble, calibrate, reduce, limits, store, publish
``commit``     makes the file safe about once a second, and finishes it
``drive``      polls the drive and so feeds its watchdog, while all others are well; stops it
``supervise``  looks at all of them, at the age of the data and at the time a stop takes
=============  ===================================================================================
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping

from drivers.api import (
    Block,
    DataOverrun,
    DeviceError,
    DeviceLost,
    DriveStatus,
    Identity,
    SlowRequest,
    SlowSource,
    StreamSetup,
)
from rigapp.engine.core import Core
from rigapp.engine.devices import Devices
from rigapp.engine.drive.driving import SpindleControl
from rigapp.engine.drive.sequences import Do, Seen
from rigapp.engine.judging import causes
from rigapp.engine.judging.guard import Guard
from rigapp.engine.judging.lateness import Lateness
from rigapp.engine.processing import Processor
from rigapp.engine.recording.devicelog import DeviceLog
from rigapp.engine.samples.slow import SlowChannels, SlowDevice
from rigapp.engine.supervisor import Supervisor
from rigapp.engine.threads import BlockQueue, Worker
from rigapp.engine.values.calibrate import Calibration
from rigapp.schema.messages import FinishReason, RevolutionMeasured, RunState
from rigapp.schema.states import ACTIVE, TURNING, Ending, Trigger

SMALLEST_QUEUE = 16384

ASLEEP_S = 0.5
"""The drive's thread looks more often; after a longer pause the whole program may have slept."""

SILENT_SHARE = 0.6
"""A drive that has not answered for this share of its watchdog's time ends the test: before the
watchdog does, so that the log names the cause and not what follows from it."""

SILENT_SHARE_SIMULATED = 2.0
"""The same for a simulated drive: a loaded computer delays its answers, and its own watchdog, which
counts only the time for which it could run, stops the spindle in any case."""


class Connection:
    """Open devices with their threads."""

    def __init__(
        self,
        core: Core,
        devices: Devices,
        setup: StreamSetup,
        calibration: Calibration,
        on_measured: Callable[[RevolutionMeasured], None] | None,
    ) -> None:
        self.core = core
        self.devices = devices
        self.setup = setup
        timing = core.timing
        self._simulated = simulated = core.rig.record.simulation is not None
        self.guard = Guard(core, self, on_measured)
        self.processor = Processor(
            calibration, self.guard, lambda: core.limits.overload_N, real_time=not simulated
        )
        held = timing.queue if not simulated else 1.0
        self.queue = BlockQueue(
            max(SMALLEST_QUEUE, round(held * setup.sample_rate_Hz)), wait=simulated
        )
        self.control = SpindleControl(
            devices.spindle,
            timing,
            self._look,
            self.slow,
            devices.drive_request.watchdog_timeout_s,
        )
        core.control = self.control
        self.received_s = time.monotonic()
        self.source_errors = 0
        self.last_source_error = ""
        self._pending: Block | None = None
        self._in_hand_ns: int | None = None
        self._overrun = False
        self._turning_blind_since: float | None = None
        self._drive_polled_s = 0.0
        self._judging = threading.Lock()
        self._unsupervised = False
        self._looked_s = self._awake_since = time.monotonic()
        self.lateness = Lateness(time.monotonic(), 0.0)
        silence, died, age = timing.silence, self._died, self.age_s
        self.reader = Worker(f"read {devices.source.name}", self._read, died, silence, age)
        self.process = Worker("process", self._process, died, silence, age)
        self.commit = Worker("commit", self._commit, died, timing.silence_commit, age)
        self.drive = Worker("drive", self._drive, died, silence, age)
        self.slow_channels = SlowChannels(
            core.table.slow,
            [self._ask(source, request) for source, request in devices.slow],
            devices.spindle.name,
            lambda: self.control.status,
            self.age_s,
        )
        self.supervisor = Supervisor(core, self)
        self._log = DeviceLog(lambda name, text: core.event("device", name, text))
        self.supervise = Worker("supervise", self.supervisor.step, self._died, silence)
        self.workers = (self.reader, self.process, self.commit, self.drive, self.supervise)

    # --- life ------------------------------------------------------------------------------------

    def start(self) -> None:
        """Start the stream and the threads; raise DeviceError."""
        if self.control.poll() is None and self.control.last_error is not None:
            raise self.control.last_error
        self._log.attach()
        self.devices.source.start()
        self.received_s = time.monotonic()
        for worker in (*self.workers, *self._askers):
            worker.start()

    def _ask(self, source: SlowSource, request: SlowRequest) -> SlowDevice:
        """Return a slow source with its thread, whose death is warned of and ends nothing."""

        def opened(identity: Identity, readback: Mapping[str, str | float | int]) -> None:
            self.devices.identities[source.name] = identity
            self.devices.readback[source.name] = readback

        def died(worker: Worker, error: BaseException) -> None:
            sentence = f"{type(error).__name__}: {error}"
            self.core.warn(causes.slow_silent(source.name, source.port, 0.0, sentence))

        return SlowDevice(source, request, opened, died, self.core.timing.silence)

    @property
    def _askers(self) -> tuple[Worker, ...]:
        return tuple(one.worker for one in self.slow_channels.devices.values())

    @property
    def sound(self) -> bool:
        """Tell whether every thread lives."""
        return not any(worker.ended for worker in self.workers)

    def not_yet(self, stale_data_s: float) -> str:
        """Return what a start has to wait for, in words; empty when nothing."""
        age = self.age_s(self.received_s)
        if age >= stale_data_s:
            return f"no samples came for {age:.1f} s"
        if self.age_s(self.control.answered_s) >= self.control.prompt_s:
            return "the drive does not answer"
        cut_off = self.processor.saturated & {"force_1", "force_2"}
        return f"{' and '.join(sorted(cut_off))} at the end of the range" if cut_off else ""

    def close(self, timeout_s: float = 5.0) -> tuple[str, ...]:
        """Stop the motor, end the threads, release the devices; return threads that hang."""
        self.control.stop_now(off=True)
        everyone = (*self.workers, *self._askers)
        for worker in reversed(everyone):
            worker.halt()
        deadline = time.monotonic() + timeout_s
        hanging = [
            worker.name
            for worker in everyone
            if not worker.join(max(0.0, deadline - time.monotonic()))
        ]
        try:
            self.devices.source.stop()
        except DeviceError as error:
            self.last_source_error = error.sentence
        self.devices.close()
        for slow in self.slow_channels.devices.values():
            slow.close()
        self._log.detach()
        return tuple(hanging)

    # --- read ------------------------------------------------------------------------------------

    def _read(self) -> None:
        block = self._pending
        if block is None:
            try:
                block = self.devices.source.read(self.core.timing.read)
            except DataOverrun as error:
                self._note(error)
                self.core.warn(causes.device_overrun(error.device, error.sentence))
                return
            except DeviceError as error:
                self._note(error)
                self._lost_device(error)
                self.reader.halt()
                return
            if block is None:
                return
            self.received_s = time.monotonic()
        if self.queue.put(block, 0.1):
            self._pending = None
        elif self.core.rig.record.simulation is not None:
            self._pending = block
        else:
            self._overrun = True
            self.core.warn(causes.overrun(block.device, self.queue.refused_blocks))

    def _note(self, error: DeviceError) -> None:
        self.source_errors += 1
        self.last_source_error = error.sentence

    def _lost_device(self, error: DeviceError) -> None:
        if self.reader.halting:
            return
        cause = causes.device_lost(error.device, error.port, error.sentence)
        sentence = f"{error.device} on {error.port}: {error.sentence}"
        self.core.trip(Ending(FinishReason.DEVICE, sentence), cause)

    # --- process ---------------------------------------------------------------------------------

    def _process(self) -> None:
        block = self.queue.get(0.1)
        if block is None:
            return
        self._in_hand_ns = block.host_time_ns
        self.processor.handle(block)
        self._in_hand_ns = None
        if self._overrun and self.queue.samples == 0:
            self._overrun = False
            self.core.alarms.clear("overrun")

    # --- commit ----------------------------------------------------------------------------------

    def _commit(self) -> None:
        core = self.core
        deadline = time.monotonic() + core.timing.commit
        while time.monotonic() < deadline and not self.commit.halting:
            if core.finish_due:
                core.finish()
                return
            self.commit.pause(min(0.02, core.timing.commit))
            core.place()
            self.commit.beat()
        core.commit()

    # --- drive -----------------------------------------------------------------------------------

    def _drive(self) -> None:
        core, control, timing = self.core, self.control, self.core.timing
        now = time.monotonic()
        busy = control.busy
        due = not control.quiet and now - self._drive_polled_s >= (
            min(0.02, timing.poll) if busy else timing.poll
        )
        stands = core.state not in TURNING
        if due and (stands or core.state is RunState.STOPPING or self.all_well()):
            self._drive_polled_s = now
            self._watch_drive()
        do = control.step()
        self.follow(do)
        self._watch_the_supervisor()
        self.drive.pause(timing.aim if busy else min(0.02, timing.poll))

    def _watch_the_supervisor(self) -> None:
        """End the test when the thread that looks at all others hangs: nobody else would tell.

        A time for which this thread did not run either is not held against it.
        """
        supervise, now = self.supervise, time.monotonic()
        if now - self._looked_s > ASLEEP_S:
            self._awake_since = now
        self._looked_s = now
        silent_s = min(supervise.silent_for(), now - self._awake_since)
        hangs = silent_s > supervise.silence_s
        if not hangs or supervise.halting or supervise.error is not None:
            self._unsupervised = False
        elif not self._unsupervised:
            self._unsupervised = True
            sentence = f"no sign of life for {supervise.silent_for():.1f} s"
            text = f"The engine's thread {supervise.name!r} gives {sentence}."
            cause = causes.thread_dead(supervise.name, sentence)
            self.core.trip(Ending(FinishReason.INTERNAL, text), cause)

    def all_well(self) -> bool:
        """Tell whether the drive's watchdog may be fed: threads well and data fresh."""
        others = (self.reader, self.process, self.commit, self.supervise)
        age = self.age_s(self.received_s)
        return all(one.well for one in others) and age < self.core.limits.stale_data_s

    def _watch_drive(self) -> None:
        core, control = self.core, self.control
        spindle = self.devices.spindle
        with self._judging:
            status = control.poll()
            if status is not None:
                self._judge_drive(status)
                return
        error = control.last_error
        silent = self.age_s(control.answered_s)
        watchdog_s = self.devices.drive_request.watchdog_timeout_s
        simulated = core.rig.record.simulation is not None
        share = SILENT_SHARE_SIMULATED if simulated else SILENT_SHARE
        if isinstance(error, DeviceLost) or silent > share * watchdog_s:
            sentence = error.sentence if error is not None else "it does not answer"
            cause = causes.drive_silent(spindle.name, spindle.port, sentence)
            text = f"{spindle.name} on {spindle.port}: {sentence}"
            core.trip(Ending(FinishReason.DEVICE, text), cause)

    def look_at_drive(self) -> None:
        """Judge what the drive has said last, before anybody waits for the drive's thread."""
        with self._judging:
            if self.control.status is not None:
                self._judge_drive(self.control.status)

    def reset_drive(self) -> None:
        """Acknowledge the drive's own faults, and judge what it says then; raise DeviceError."""
        with self._judging:
            self.control.reset_fault()
            if self.control.status is not None:
                self._judge_drive(self.control.status)

    def _judge_drive(self, status: DriveStatus) -> None:
        core, spindle = self.core, self.devices.spindle
        core.alarms.clear("drive_silent")
        rpm = status.speed_rev_per_s * 60.0
        if status.emergency_stop:
            cause = causes.emergency_stop(spindle.name)
            core.trip(Ending(FinishReason.DEVICE, cause.cause, off=True), cause)
        else:
            core.alarms.clear("emergency_stop")
        if status.faults:
            cause = causes.drive_fault(spindle.name, ", ".join(status.faults))
            core.trip(Ending(FinishReason.DEVICE, cause.cause, off=True), cause)
        elif not status.emergency_stop:
            core.alarms.clear("drive_fault")
        if status.warnings:
            core.warn(causes.drive_warning(spindle.name, ", ".join(status.warnings)))
        else:
            core.alarms.clear("drive_warning")
        limit = core.limits.overspeed_rpm
        if core.state in TURNING and abs(rpm) > limit and not self.swinging:
            cause = causes.overspeed(rpm, limit, "drive")
            core.trip(Ending(FinishReason.LIMIT, cause.cause, off=True), cause)
        self._watch_encoder(rpm)

    def _watch_encoder(self, rpm: float) -> None:
        core, session = self.core, self.core.session
        blind = (
            session is not None
            and core.state in (RunState.STARTING, RunState.RUNNING)
            and abs(rpm) > max(1.0, 0.05 * session.target_rpm)
            and self.processor.motion.standing(core.timing.standing)
        )
        now = time.monotonic()
        if not blind:
            self._turning_blind_since = None
            core.alarms.clear("encoder_lost")
        elif self._turning_blind_since is None:
            self._turning_blind_since = now
        elif now - self._turning_blind_since > 2 * core.timing.standing:
            cause = causes.encoder_lost(rpm)
            core.trip(Ending(FinishReason.DEVICE, cause.cause, off=True), cause)

    def follow(self, do: Do) -> None:
        """Do what a stop or a pause asks for next."""
        core, control = self.core, self.control
        stop = control.stopping
        if stop is None:
            if do is Do.STANDING:
                angle = self.processor.motion.angle_deg(time.monotonic())
                where = f"at {angle:.1f} deg" if angle is not None else "at an unknown angle"
                core.fire_if(Trigger.STANDING, f"paused {where}")
            elif do is Do.GIVE_UP:
                cause = causes.pause_failed("The spindle did not come to rest for the pause.")
                core.trip(Ending(FinishReason.DEVICE, cause.cause), cause)
            return
        if do is Do.STANDING:
            core.stood(stop.witnesses, stop.how)
        elif do is Do.GIVE_UP:
            core.will_not_stop(
                f"The stop was commanded, the power was cut, and still the spindle is not seen to "
                f"stand (asked: {stop.witnesses})."
            )

    def begin_test(self) -> None:
        """Let the revolutions from the next index on belong to the test."""
        self.processor.begin_test()

    def pause(self, reason: str) -> None:
        """Begin to pause at the safe angle, when the state allows it."""
        session = self.core.session
        if session is not None and self.core.fire_if(Trigger.PAUSE, reason):
            self.control.pause_at(session.test.record.run.pause_angle_deg)

    # --- what the crank encoder shows -------------------------------------------------------------

    @property
    def swinging(self) -> bool:
        """Tell whether the crank may turn as it likes: its power is off, or was asked to be.

        The spring can swing it faster than it ran. That follows from the stop, and is no alarm.
        """
        session, control = self.core.session, self.control
        if control.power_cut:
            return True
        if session is None or self.core.state is not RunState.STOPPING:
            return False
        return session.off or not control.answering

    @property
    def backed_up(self) -> bool:
        """Tell whether the reader waits for the processing thread, which is then the culprit."""
        return self._pending is not None

    def queue_age_s(self) -> float:
        """Return the age of the oldest samples that are not processed yet, 0 when none wait."""
        waiting = (self._in_hand_ns, self.queue.oldest_ns)
        oldest = min((one for one in waiting if one is not None), default=None)
        return 0.0 if oldest is None else max(0.0, (time.monotonic_ns() - oldest) * 1e-9)

    def data_age_s(self) -> float:
        """Return the seconds since the last samples came."""
        return time.monotonic() - self.received_s

    def age_s(self, since_s: float) -> float:
        """Return how long ago a host time was, as a silence is judged.

        Simulated devices run on this computer: a time for which it did not let the engine run is
        not held against them. A real rig is judged by the clock alone.
        """
        now = time.monotonic()
        late = self.lateness.since(since_s, now) if self._simulated else 0.0
        return now - since_s - late

    def stands(self) -> bool:
        """Tell whether the crank stands; waits for enough data to tell."""
        window = self.core.timing.standing
        deadline = time.monotonic() + 4.0 * window * self.slow() + 0.5
        while not self.processor.motion.standing(window):
            if time.monotonic() > deadline:
                return False
            self.supervise.pause(0.01)
        return True

    def _look(self, drive_rpm: float | None) -> Seen:
        now = time.monotonic()
        motion = self.processor.motion
        newest = motion.newest()
        fresh = (
            newest is not None
            and now - newest.host_s < max(0.5, 2 * self.core.timing.standing)
            and self.process.well
        )
        if newest is None or not fresh:
            return Seen(now, drive_rpm, None, None, drive_s=self.control.answered_s)
        rpm = motion.speed_rpm()
        return Seen(
            now_s=now,
            drive_rpm=drive_rpm,
            encoder_rpm=rpm,
            encoder_stands=motion.standing(self.core.timing.standing),
            angle_deg=motion.angle_deg(now),
            deg_per_s=rpm * 6.0 * motion.pace(),
            drive_s=self.control.answered_s,
            encoder_s=newest.host_s,
        )

    def slow(self) -> float:
        """Return how many times slower than real time the rig runs, 1 for a real one."""
        if self.core.rig.record.simulation is None:
            return 1.0
        return 1.0 / min(1.0, max(0.02, self.processor.motion.pace()))

    # --- death -----------------------------------------------------------------------------------

    def _died(self, worker: Worker, error: BaseException) -> None:
        """Bring the rig into a safe state: a thread has died."""
        sentence = f"{type(error).__name__}: {error}"
        cause = causes.thread_dead(worker.name, sentence)
        text = f"The engine's thread {worker.name!r} died ({sentence})."
        self.core.trip(Ending(FinishReason.INTERNAL, text), cause)
        if self.core.state in ACTIVE and worker is self.drive:
            self.control.stop_now(off=True)
