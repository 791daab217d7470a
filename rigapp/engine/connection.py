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

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace

from rigapp.config.sequence import StepPlace
from rigapp.engine.activetest import ActiveTest, Rest
from rigapp.engine.core import Core
from rigapp.engine.devices import Devices
from rigapp.engine.drive.driving import Ramp, SpindleControl
from rigapp.engine.drive.sequences import DriveStep, Seen
from rigapp.engine.judging.drivewatch import DriveWatch
from rigapp.engine.judging.guard import Guard
from rigapp.engine.judging.lateness import Lateness
from rigapp.engine.judging.watches import Watches, slow_silent
from rigapp.engine.processing import Processor
from rigapp.engine.recording.devicelog import DeviceLog
from rigapp.engine.samples.blockqueue import BlockQueue
from rigapp.engine.samples.slow import FIRST_S, SlowChannels, SlowDevice
from rigapp.engine.values.calibrate import Calibration
from rigapp.process.threads import Worker
from rigapp.schema.alarms import Cause, because
from rigapp.schema.channels import LOAD_CELL
from rigapp.schema.messages import FinishReason, RunState
from rigapp.schema.states import ACTIVE, TURNING, Ending, Trigger, transition
from rigapp_drivers.api import (
    DataOverrun,
    DeviceError,
    Identity,
    SlowRequest,
    StreamSetup,
)
from rigapp_drivers.edge import GuardedSlow

SMALLEST_QUEUE = 16384  # samples; a burst of so many may come after a pause of the host
PACED_SAMPLES = 4096
"""Simulated samples wait on the wire while so many are not processed, or as many as the device
takes in ``queue_age`` if that is more: a stop is not seen late, and no pass is idle."""

PROMPT_S = 0.02
"""Longest pause of a loop that has something to end: 7 deg of a crank at 60 rpm."""

FRESH_S = 0.5
"""A sample that is older tells nothing of what the crank does now."""

WAITS_IN_VAIN = 3
"""Reads in a row that wait for their whole time-out and get nothing: a computer that lets the
reader wait lets it read, so what is missing then is not on the wire."""

SLOWEST_PACE = 0.02
"""A simulated rig that runs slower than this has hung: nobody waits for it in proportion."""

SHORT_SILENCE_S = 2.0
"""A start waits for the end of a silence that has not lasted so long, and refuses a longer one."""

ASLEEP_S = 0.5
"""The drive's thread looks more often; after a longer pause the whole program may have slept."""


class Connection:
    """Open devices with their threads.

    supervise: makes the supervising thread's look at this connection.
    """

    def __init__(
        self,
        core: Core,
        devices: Devices,
        setup: StreamSetup,
        calibration: Calibration,
        supervise: Callable[[Connection], Callable[[], None]],
    ) -> None:
        self.core = core
        self.devices = devices
        self.source, self.spindle = devices.source, devices.spindle
        self.setup = setup
        timing = core.timing
        rig = core.rig.record
        self._simulated = rig.simulated
        self.guard = Guard(core, self)
        self.processor = Processor(
            calibration,
            self.guard,
            lambda: core.limits.overload_N,
            real_time=not rig.simulated_samples,
        )
        self.queue = BlockQueue(max(SMALLEST_QUEUE, round(timing.queue * setup.sample_rate_Hz)))
        self._paced_samples = max(PACED_SAMPLES, round(timing.queue_age * setup.sample_rate_Hz))
        self.control = SpindleControl(
            devices.spindle,
            timing,
            self._look,
            self.pace,
            devices.drive_request.watchdog_timeout_s,
        )
        core.control = self.control
        self.counts_per_turn = devices.drive_request.counts_per_crank_revolution
        self.received_s = time.monotonic()
        self.source_errors = 0
        self.last_source_error = ""
        self._waits_in_vain = 0
        self._in_hand_ns: int | None = None
        self._overrun = False
        self._drive_polled_s = 0.0
        self.drive_watch = DriveWatch(core, self, devices.drive_request.watchdog_timeout_s)
        self.watches = Watches(core, self)
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
        self._log = DeviceLog(lambda name, text: core.event("device", name, text))
        self.supervise = Worker("supervise", supervise(self), died, silence)
        self.workers = (self.reader, self.process, self.commit, self.drive, self.supervise)

    # --- life ------------------------------------------------------------------------------------

    def start(self) -> None:
        """Start the stream and the threads; raise DeviceError."""
        if self.control.poll() is None and self.control.last_error is not None:
            raise self.control.last_error
        self.slow_channels.take_drive()
        self._log.attach()
        self.source.start()
        self.received_s = time.monotonic()
        for worker in (*self.workers, *self._askers):
            worker.start()
        deadline = time.monotonic() + FIRST_S
        for slow in self.slow_channels.devices.values():
            slow.await_first(max(0.0, deadline - time.monotonic()))

    def _ask(self, source: GuardedSlow, request: SlowRequest) -> SlowDevice:
        """Return a slow source with its thread, whose death is warned of and ends nothing."""

        def opened(identity: Identity, readback: Mapping[str, str | float | int]) -> None:
            self.devices.identities[source.name] = identity
            self.devices.readback[source.name] = readback

        def died(worker: Worker, error: BaseException) -> None:
            self.core.act_on(slow_silent(source, 0.0, f"it failed ‹{error!r}›"))

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
        silence = self._silence(stale_data_s)
        cut_off = self.processor.saturated.intersection(self.core.table.names_of(LOAD_CELL))
        if silence or not cut_off:
            return silence
        return f"{' and '.join(sorted(cut_off))} at the end of the range"

    def _silence(self, stale_data_s: float) -> str:
        age = self.age_s(self.received_s)
        if age >= stale_data_s:
            return f"no samples came for {age:.1f} s"
        if self.age_s(self.control.answered_s) >= self.control.prompt_s:
            return "the drive does not answer"
        return ""

    def wait_out_silence(self, stale_data_s: float) -> None:
        """Wait while samples or the drive are silent, unless for more than SHORT_SILENCE_S."""
        while self._silence(stale_data_s):
            heard_s = min(self.received_s, self.control.answered_s)
            if time.monotonic() - heard_s > SHORT_SILENCE_S:
                return
            self.supervise.pause(0.01)

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
            self.source.stop()
        except DeviceError as error:
            self.last_source_error = error.sentence
        self.devices.close()
        for slow in self.slow_channels.devices.values():
            slow.close()
        self._log.detach()
        return tuple(hanging)

    # --- read ------------------------------------------------------------------------------------

    def _read(self) -> None:
        if self.backed_up:
            self.queue.wait_below(self._paced_samples, self.core.timing.read)
            return
        try:
            block = self.source.read(self.core.timing.read)
        except DataOverrun as error:
            self._note(error)
            cause = because("device_overrun", device=error.device, sentence=error.sentence)
            self.core.act_on(cause)
            return
        except DeviceError as error:
            self._note(error)
            if not self.reader.halting:
                self.core.act_on(lost_device(error))
            self.reader.halt()
            return
        if block is None:
            self._waits_in_vain += 1
            return
        self._waits_in_vain = 0
        self.received_s = time.monotonic()
        if not self.queue.put(block):
            self._overrun = True
            refused = self.queue.refused_blocks
            self.core.act_on(because("overrun", device=block.device, blocks=refused))

    def _note(self, error: DeviceError) -> None:
        self.source_errors += 1
        self.last_source_error = error.sentence

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
            self.commit.pause(min(PROMPT_S, core.timing.commit))
            core.place()
            self.commit.beat()
        core.commit()

    # --- drive -----------------------------------------------------------------------------------

    def _drive(self) -> None:
        core, control, timing = self.core, self.control, self.core.timing
        now = time.monotonic()
        busy = control.busy
        due = not control.quiet and now - self._drive_polled_s >= (
            min(PROMPT_S, timing.poll) if busy else timing.poll
        )
        stands = core.state not in TURNING
        if due and (stands or core.state is RunState.STOPPING or self.all_well()):
            self._drive_polled_s = now
            self.drive_watch.ask()
            self.slow_channels.take_drive()
        do = control.step()
        self.follow(do)
        self._watch_the_supervisor()
        self.drive.pause(timing.aim if busy else min(PROMPT_S, timing.poll))

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
            self.core.act_on(silent_thread(supervise))

    def all_well(self) -> bool:
        """Tell whether the drive's watchdog may be fed: threads well and data fresh."""
        others = (self.reader, self.process, self.commit, self.supervise)
        age = self.age_s(self.received_s)
        return all(one.well for one in others) and age < self.core.limits.stale_data_s

    def follow(self, do: DriveStep) -> None:
        """Take note of what a step of a pause or a stop has come to."""
        core, control = self.core, self.control
        stop = control.stopping
        if stop is None:
            if do is DriveStep.STANDING:
                angle = self.processor.motion.angle_deg(time.monotonic())
                where = f"at {angle:.1f} deg" if angle is not None else "at an unknown angle"
                core.fire_if(Trigger.STANDING, f"paused {where}")
            elif do is DriveStep.GIVE_UP:
                core.act_on(because("pause_failed"))
            return
        if do is DriveStep.STANDING:
            if stop.unseen:
                core.stop_unseen(self.spindle.name)
            core.stood(stop.witnesses, stop.how)
        elif do is DriveStep.POWER_OFF and stop.by_itself and core.state not in ACTIVE:
            self._turns_by_itself()
        elif do is DriveStep.NO_EFFECT:
            core.stop_without_effect(self.spindle.name)
        elif do is DriveStep.GIVE_UP:
            core.will_not_stop(
                f"The stop was commanded, the power was cut, and still the spindle is not seen to "
                f"stand (asked: {stop.witnesses})."
            )

    def _turns_by_itself(self) -> None:
        """Tell of a crank that turns without a command; one without power is turned by hand."""
        status, rpm = self.control.status, self.processor.motion.speed_rpm()
        if status is not None and status.enabled:
            drive = self.spindle.name
            self.core.act_on(because("turns_by_itself", drive=drive, speed_rpm=rpm))

    def begin_test(self) -> None:
        """Let the revolutions from the next index on belong to the test."""
        self.processor.begin_test()

    def pause(self, reason: str) -> bool:
        """Begin to pause at the safe angle, when the state allows it; tell whether it does.

        A rest between two steps becomes a pause: the test goes on when somebody says so.
        """
        core, test = self.core, self.core.test
        if test is None:
            return False
        if test.resting is not None:
            test.resting = None
            core.told_again(f"the rest has become a pause: {reason}")
            return True
        if not core.fire_if(Trigger.PAUSE, reason):
            return False
        self.control.pause_at(test.document.record.run.pause_angle_deg)
        return True

    def go_on_to(self, stage: StepPlace) -> None:
        """Begin the next step of the test: rest before it, or go to its speed.

        In a pause of the operator the speed is taken up when he goes on, and the pause is the rest.
        """
        core, test = self.core, self.core.test
        if test is None:
            return
        ended, test.stage = test.stage, stage
        test.changes += 1
        words = f"{stage.words}: {stage.speed_rpm:g} rpm to revolution {stage.last}"
        if test.logs_steps:
            if core.state is RunState.STARTING:
                text = f"{ended.words} was over before its {ended.speed_rpm:g} rpm were reached"
                core.event("step", "engine", text, level="warning")
            core.event("step", "engine", words, before=ended.words, after=stage.words)
        if ended.rest_s and test.resting is not None:
            test.resting.duration_s += ended.rest_s  # it was over while the crank slowed down
            test.resting.step = ended.step
        elif ended.rest_s and self.pause(f"{ended.words} is done: a rest of {ended.rest_s:g} s"):
            test.resting = Rest(ended.rest_s, ended.step)
        elif stage.speed_rpm != ended.speed_rpm:
            highest = max(stage.speed_rpm, ended.speed_rpm)
            test.deadline_s = self.ramp_deadline_s(highest, test.ramp_rpm_per_s)
            if core.fire_if(Trigger.STEP, words):
                self.control.change(Ramp(test.target_rpm, test.ramp_rpm_per_s))

    def ramp_deadline_s(self, rpm: float, rpm_per_s: float) -> float:
        """Return the host time at which a speed must be reached or left that is commanded now."""
        ramp_s = 2.0 * self.slow() * rpm / rpm_per_s
        return time.monotonic() + self.core.timing.start_margin + ramp_s

    def resume(self, test: ActiveTest) -> None:
        """Go on after a pause with the speed of the step; raise Refused, DeviceError.

        The drive's refusal ends the test.
        """
        transition(self.core.state, Trigger.RESUME)
        test.resting = None
        test.deadline_s = self.ramp_deadline_s(test.target_rpm, test.ramp_rpm_per_s)
        self.core.fire(Trigger.RESUME)
        with self.turning():
            self.control.resume(Ramp(test.target_rpm, test.ramp_rpm_per_s))

    @contextmanager
    def turning(self) -> Iterator[None]:
        """End the test when the drive refuses to turn, and raise its DeviceError."""
        try:
            yield
        except DeviceError as error:
            self.core.trip(Ending(FinishReason.DEVICE, str(error)))
            raise

    # --- what the crank encoder shows -------------------------------------------------------------

    @property
    def swinging(self) -> bool:
        """Tell whether the crank may turn as it likes: its power is off, or was asked to be.

        The spring can swing it faster than it ran. That follows from the stop, and is no alarm.
        """
        test, control = self.core.test, self.control
        if control.power_cut:
            return True
        if test is None or self.core.state is not RunState.STOPPING:
            return False
        return test.off or not control.answering

    @property
    def coasting(self) -> bool:
        """Tell whether the crank turns without power in a stop: the spring drives it."""
        return (
            self.core.state is RunState.STOPPING
            and self.control.power_cut
            and not self.processor.motion.standing(self.core.timing.standing)
        )

    @property
    def backed_up(self) -> bool:
        """Tell whether the reader leaves samples on the wire until those before are processed.

        Only simulated samples wait so: their time waits on the wire with them, which makes
        ``--speed max`` as fast as the engine. A real device would lose them.
        """
        simulated = self.core.rig.record.simulated_samples
        return simulated and self.queue.samples >= self._paced_samples

    def queue_age_s(self) -> float:
        """Return the age of the oldest samples that are not processed yet, 0 when none wait."""
        waiting = (self._in_hand_ns, self.queue.oldest_ns)
        oldest = min((one for one in waiting if one is not None), default=None)
        return 0.0 if oldest is None else max(0.0, self.age_s(oldest * 1e-9))

    def silence_s(self) -> float:
        """Return for how long samples are outstanding, in the time in which stale data are judged.

        That of the rig: a simulated one may be faster than the host's clock, and the drive's count
        tells its time, once the reader has waited in vain often enough that none can be on the way.
        """
        age_s = self.age_s(self.received_s)
        if not self.core.rig.record.simulated_samples or self._waits_in_vain < WAITS_IN_VAIN:
            return age_s
        return max(age_s, self.guard.gaps.outstanding_s())

    def data_age_s(self) -> float:
        """Return the seconds since the last samples came."""
        return time.monotonic() - self.received_s

    def age_s(self, since_s: float) -> float:
        """Return how long ago a host time was, as a silence is judged.

        A simulated rig runs on this computer: a time for which it did not let the engine run is
        not held against it. A real rig, or one of which a part is real, is judged by the clock.
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
            and now - newest.host_s < max(FRESH_S, 2 * self.core.timing.standing)
            and self.process.well
            and not self.core.alarms.is_active("encoder_lost")
        )
        if newest is None or not fresh:
            seen = Seen(now, drive_rpm, None, None, drive_s=self.control.answered_s)
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
        return Seen(
            now_s=now,
            drive_rpm=drive_rpm,
            encoder_rpm=rpm,
            encoder_stands=motion.standing(self.core.timing.standing),
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
        if not self.core.rig.record.simulated_samples:
            return 1.0
        return max(SLOWEST_PACE, self.processor.motion.pace())

    # --- death -----------------------------------------------------------------------------------

    def _died(self, worker: Worker, error: BaseException) -> None:
        """Bring the rig into a safe state: a thread has died."""
        self.core.act_on(because("thread", worker.name, sentence=f"failed ‹{error!r}›"))
        if self.core.state in ACTIVE and worker is self.drive:
            self.control.stop_now(off=True)


def lost_device(error: DeviceError) -> Cause:
    """Return the alarm of a device that is gone."""
    return because("device_lost", error.device, port=error.port, sentence=error.sentence)


def silent_thread(worker: Worker) -> Cause:
    """Return the alarm of a thread that hangs."""
    sentence = f"gave no sign of life for {worker.silent_for():.1f} s"
    return because("thread", worker.name, sentence=sentence)
