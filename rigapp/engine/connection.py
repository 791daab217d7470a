"""The threads between the devices and the file, from connect to disconnect.

=============  ===================================================================================
thread         does
=============  ===================================================================================
``read NAME``  reads one data source and queues its Blocks, without any computation
``process``    overload, assemble, calibrate, reduce, limits, store, publish
``commit``     commits the file about once a second, and finishes it
``drive``      polls the drive, which feeds its watchdog, while all others are well; stops it
``supervise``  monitors all of them, the age of the data and the duration of a stop
=============  ===================================================================================
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable

from rigapp.engine.connectedrig import ConnectedRig
from rigapp.engine.core import Core
from rigapp.engine.crankmotion import CrankMotion
from rigapp.engine.devices import Devices
from rigapp.engine.guard import Guard
from rigapp.engine.samples.slow import FIRST_S
from rigapp.engine.values.calibrate import Calibration
from rigapp.engine.watches import DriveWatch, Watches
from rigapp.process.threads import Worker
from rigapp.schema.alarms import Cause, make_alarm
from rigapp.schema.messages import RunState
from rigapp.schema.states import ACTIVE, TURNING
from rigapp.texts import say
from rigapp_drivers.api import (
    DataOverrun,
    DeviceError,
    StreamSetup,
)

PROMPT_S = 0.02
"""Longest pause of a loop that ends something: 7 deg of a crank at 60 rpm."""

WAITS_IN_VAIN = 3
"""Consecutive reads with a time-out after which samples are missing, and not just late on the wire:
the reader did run."""

ASLEEP_S = 0.5
"""Longest pause of the drive's thread that does not indicate a suspended program."""

AGAIN_AFTER_S = 60.0  # the same warning at most once a minute
KEPT = 64  # different warnings that are not repeated


class DeviceLog(logging.Handler):
    """Forward warnings of the package ``drivers``, equal texts at most once a minute.

    forward: called with the driver's name and the text.
    """

    def __init__(self, forward: Callable[[str, str], object]) -> None:
        super().__init__(logging.WARNING)
        self._forward = forward
        self._last_sent: dict[str, float] = {}

    def attach(self) -> None:
        """Add the handler to the drivers' logger."""
        logging.getLogger("rigapp_drivers").addHandler(self)

    def detach(self) -> None:
        """Remove the handler from the drivers' logger."""
        logging.getLogger("rigapp_drivers").removeHandler(self)

    def emit(self, record: logging.LogRecord) -> None:
        """Forward a warning."""
        try:
            text = record.getMessage()
            now = time.monotonic()
            if now - self._last_sent.get(text, -AGAIN_AFTER_S) < AGAIN_AFTER_S:
                return
            if len(self._last_sent) >= KEPT:
                self._last_sent.clear()
            self._last_sent[text] = now
            self._forward(record.name, text)
        except Exception:
            self.handleError(record)


class Connection:
    """Threads of a connected rig.

    supervise: returns the check of this connection that the supervising thread repeats.
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
        self.devices, self.source = devices, devices.source
        timing = core.timing
        self.rig = rig = ConnectedRig(core, devices, setup, calibration, lambda: self.process.well)
        self.motion = CrankMotion(core, rig)
        self.guard = Guard(core, rig, self.motion)
        rig.processor.monitor = self.guard
        self.control = core.control = rig.control
        self.source_errors = 0
        self.last_source_error: DeviceError | None = None
        self._waits_in_vain = 0
        self._overrun = False
        self._drive_polled_s = 0.0
        self.drive_watch = DriveWatch(core, rig, devices.drive_request.watchdog_timeout_s)
        self.watches = Watches(core, rig)
        self._unsupervised = False
        self._checked_s = self._awake_since = time.monotonic()
        silence, died, age = timing.silence, self._died, rig.age_s
        self.reader = Worker(f"read {devices.source.name}", self._read, died, silence, age)
        self.process = Worker("process", self._process, died, silence, age)
        self.commit = Worker("commit", self._commit, died, timing.silence_commit, age)
        self.drive = Worker("drive", self._drive, died, silence, age)
        self._log = DeviceLog(lambda name, text: core.event("device", name, text))
        self.supervise = Worker("supervise", supervise(self), died, silence)
        self.workers = (self.reader, self.process, self.commit, self.drive, self.supervise)

    # --- start and close -------------------------------------------------------------------------

    def start(self) -> None:
        """Start the stream and the threads; raise DeviceError."""
        if self.control.poll() is None and self.control.last_error is not None:
            raise self.control.last_error
        self.rig.slow_channels.take_drive()
        self._log.attach()
        self.source.start()
        self.rig.received_s = time.monotonic()
        for worker in (*self.workers, *self._slow_workers):
            worker.start()
        deadline = time.monotonic() + FIRST_S
        for slow in self.rig.slow_channels.devices.values():
            slow.await_first(max(0.0, deadline - time.monotonic()))

    @property
    def _slow_workers(self) -> tuple[Worker, ...]:
        return tuple(device.worker for device in self.rig.slow_channels.devices.values())

    @property
    def sound(self) -> bool:
        """Return whether every thread is alive."""
        return not any(worker.ended for worker in self.workers)

    def close(self, timeout_s: float = 5.0) -> tuple[str, ...]:
        """Stop the motor, end the threads, release the devices; return names of hung threads."""
        self.control.stop_now(off=True)
        self.rig.closing.set()
        all_workers = (*self.workers, *self._slow_workers)
        for worker in reversed(all_workers):
            worker.halt()
        deadline = time.monotonic() + timeout_s
        hanging = [
            worker.name
            for worker in all_workers
            if not worker.join(max(0.0, deadline - time.monotonic()))
        ]
        try:
            self.source.stop()
        except DeviceError as error:
            self.last_source_error = error
        self.devices.close()
        for slow in self.rig.slow_channels.devices.values():
            slow.close()
        self._log.detach()
        return tuple(hanging)

    # --- read ------------------------------------------------------------------------------------

    def _read(self) -> None:
        if self.rig.backed_up:
            self.rig.queue.wait_below(self.rig.paced_samples, self.core.timing.read)
            return
        try:
            block = self.source.read(self.core.timing.read)
        except DataOverrun as error:
            self._note(error)
            cause = make_alarm("device_overrun", device=error.device, sentence=error.sentence)
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
        self.rig.received_s = time.monotonic()
        if not self.rig.queue.put(block):
            self._overrun = True
            refused = self.rig.queue.refused_blocks
            self.core.act_on(make_alarm("overrun", device=block.device, blocks=refused))

    def _note(self, error: DeviceError) -> None:
        self.source_errors += 1
        self.last_source_error = error

    # --- process ---------------------------------------------------------------------------------

    def _process(self) -> None:
        rig = self.rig
        block = rig.queue.get(0.1)
        if block is None:
            return
        rig.in_hand_ns = block.host_time_ns
        rig.processor.handle(block)
        rig.in_hand_ns = None
        if self._overrun and rig.queue.samples == 0:
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
        stationary = core.state not in TURNING
        if due and (stationary or core.state is RunState.STOPPING or self.all_well()):
            self._drive_polled_s = now
            self.drive_watch.ask()
            self.rig.slow_channels.take_drive()
        do = control.step()
        self.motion.follow(do)
        self._watch_the_supervisor()
        self.drive.pause(timing.aim if busy else min(PROMPT_S, timing.poll))

    def _watch_the_supervisor(self) -> None:
        """End the test if the supervising thread hangs, which no other thread reports.

        Time in which this thread did not run either is excluded.
        """
        supervise, now = self.supervise, time.monotonic()
        if now - self._checked_s > ASLEEP_S:
            self._awake_since = now
        self._checked_s = now
        silent_s = min(supervise.silent_for(), now - self._awake_since)
        hangs = silent_s > supervise.silence_s
        if not hangs or supervise.halting or supervise.error is not None:
            self._unsupervised = False
        elif not self._unsupervised:
            self._unsupervised = True
            self.core.act_on(silent_thread(supervise))

    def all_well(self) -> bool:
        """Return whether the drive's watchdog may be fed: all threads run and data are fresh."""
        others = (self.reader, self.process, self.commit, self.supervise)
        age = self.rig.age_s(self.rig.received_s)
        return all(thread.well for thread in others) and age < self.core.limits.stale_data_s

    def silence_s(self) -> float:
        """Return for how long samples are missing, in the time base of stale data.

        For a simulated rig, which may be faster than the host's clock, the drive's count gives the
        time, after WAITS_IN_VAIN reads without samples.
        """
        age_s = self.rig.age_s(self.rig.received_s)
        if not self.core.rig.record.simulated_samples or self._waits_in_vain < WAITS_IN_VAIN:
            return age_s
        return max(age_s, self.guard.gaps.outstanding_s())

    # --- failure ---------------------------------------------------------------------------------

    def _died(self, worker: Worker, error: BaseException) -> None:
        """Bring the rig to a safe state after a failure of a thread."""
        self.core.act_on(
            make_alarm("thread", worker.name, sentence=say("failed ‹{}›", repr(error)))
        )
        if self.core.state in ACTIVE and worker is self.drive:
            self.control.stop_now(off=True)


def lost_device(error: DeviceError) -> Cause:
    """Return the alarm of a lost device."""
    return make_alarm("device_lost", error.device, port=error.port, sentence=error.sentence)


def silent_thread(worker: Worker) -> Cause:
    """Return the alarm of a hung thread."""
    sentence = say("sent no heartbeat for {:.1f} s", worker.silent_for())
    return make_alarm("thread", worker.name, sentence=sentence)
