"""Monitor threads, data and stops; replace the safety functions of a failed thread."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from functools import partial

from rigapp.engine.connection import Connection, silent_thread
from rigapp.engine.core import SLOW_DISK_S, Core
from rigapp.engine.resting import begin_rest, end_rest
from rigapp.process.threads import OVERSLEPT_S
from rigapp.schema.alarms import make_alarm
from rigapp.schema.messages import Ends, RunState
from rigapp.schema.states import ACTIVE
from rigapp.texts import say

ANCHOR_S = 60.0  # in this time the drift of two clocks is milliseconds
FILE_S = 1.0  # interval of the check of the file's path
SPEED_LOST = 0.3  # of the target; larger than any ripple or effect of load
SPEED_LOST_S = 1.0  # longer than a transient load
CLOCK_JUMP_S = 1.0  # over ANCHOR_S; a time server slews smaller deviations

WAKING_S = 0.2
"""Time for the other threads after the process did not run, before they are checked."""

RETRY_S = 0.01

DID_NOT_RUN = "the engine did not run for {lost:.1f} s; this computer was suspended or overloaded"


class Supervisor:
    """Checks of the supervising thread; ``step`` runs each once."""

    def __init__(self, core: Core, connection: Connection) -> None:
        self._core = core
        self._connection = connection
        self._helpers: dict[str, threading.Thread] = {}
        self._silent: set[str] = set()
        self._anchored_s = self._file_seen_s = self._awake_s = time.monotonic()
        self._slow_since: float | None = None
        self._waited_s = 0.0

    def step(self) -> None:
        """Check everything once."""
        self._connection.rig.lateness.tick(time.monotonic(), time.thread_time(), self._waited_s)
        self._waited_s = 0.0
        for check in (
            self._check_threads,
            self._check_data,
            self._connection.watches.look,
            self._check_start,
            self._check_rest,
            self._check_stop,
            self._check_clock,
            self._check_disk,
            self._check_file,
            self._core.alarms.look,
        ):
            self._detect_suspension()
            check()
        self._pause(self._core.timing.supervise)
        self._detect_suspension()

    def _pause(self, seconds: float) -> None:
        self._connection.supervise.pause(seconds)
        self._waited_s += seconds

    def _detect_suspension(self) -> None:
        """Report a time in which the process did not run, and exclude it from the time-outs.

        The process may be suspended anywhere. A check that only waited while the others ran is not
        counted: the pause of another thread must have been too long as well.
        """
        connection, before_s, now = self._connection, self._awake_s, time.monotonic()
        self._awake_s = now
        if now - before_s < OVERSLEPT_S:
            return
        for worker in connection.workers:
            worker.beat()
        lost, until_s = self._overslept(before_s), now + WAKING_S
        while not lost and time.monotonic() < until_s:
            self._pause(RETRY_S)
            lost = self._overslept(before_s)
        if lost:
            self._core.event("suspended", "engine", DID_NOT_RUN.format(lost=lost))
        self._pause(max(0.0, until_s - time.monotonic()))
        self._awake_s = time.monotonic()

    def _overslept(self, since_s: float) -> float:
        return max(worker.overslept(since_s) for worker in self._connection.workers)

    def _check_threads(self) -> None:
        for worker in self._connection.workers:
            if worker.well or worker.halting or worker.name in self._silent:
                continue
            self._silent.add(worker.name)
            if worker.error is not None:
                continue  # the failing thread has reported itself
            self._run_helper(
                f"trip {worker.name}", partial(self._core.act_on, silent_thread(worker))
            )

    def _check_data(self) -> None:
        core, connection = self._core, self._connection
        age = connection.silence_s()
        if age <= core.limits.stale_data_s:
            core.alarms.clear("stale_data")
            return
        if (
            connection.reader.ended
            or connection.rig.backed_up
            or core.alarms.is_active("stale_data")
        ):
            return
        name, port = connection.source.name, connection.source.port
        core.act_on(make_alarm("stale_data", device=name, port=port, age_s=age))

    def _check_start(self) -> None:
        core, test = self._core, self._core.test
        if test is None or core.state is not RunState.STARTING:
            self._check_speed()
            return
        self._slow_since = None
        if time.monotonic() > test.deadline_s:
            rpm = self._connection.rig.processor.motion.speed_rpm()
            core.act_on(make_alarm("start_failed", speed_rpm=rpm, target_rpm=test.target_rpm))

    def _check_speed(self) -> None:
        core, test, connection = self._core, self._core.test, self._connection
        rpm = connection.rig.processor.motion.speed_rpm(0.2)
        if (
            test is None
            or core.state is not RunState.RUNNING
            or abs(rpm - test.target_rpm) <= SPEED_LOST * test.target_rpm
        ):
            self._slow_since = None
            return
        now = time.monotonic()
        if self._slow_since is None:
            self._slow_since = now
        elif not connection.control.answering:
            return  # the missing replies are the cause, and are reported by ``DriveWatch``
        elif now - self._slow_since > SPEED_LOST_S * connection.rig.slow():
            core.act_on(make_alarm("speed_lost", speed_rpm=rpm, target_rpm=test.target_rpm))

    def _check_rest(self) -> None:
        """Begin the rest between two steps at standstill, and resume the test at its end."""
        core, test = self._core, self._core.test
        rest = test.resting if test is not None else None
        if test is None or rest is None or core.state is not RunState.PAUSED:
            return
        if rest.since_s is None:
            rest.since_s = time.monotonic()
            self._run_helper("rest", partial(begin_rest, core, self._connection.rig, test, rest))
        elif rest.left_s(self._connection.rig.pace()) == 0.0:
            self._run_helper("rest", partial(end_rest, core, self._connection, test, rest))

    def _check_stop(self) -> None:
        core, connection, timing = self._core, self._connection, self._core.timing
        test = core.test
        if core.state not in ACTIVE:
            alarms = core.alarms.alarms()
            waiting = any(alarm.active and alarm.ends is Ends.STAND for alarm in alarms)
            evidence = connection.rig.control.seen() if waiting else None
            if evidence is not None and evidence.is_stationary and evidence.encoder_stands:
                core.alarms.clear_ended_by(Ends.STAND)
            return
        if test is None or core.state is not RunState.STOPPING:
            return
        if not connection.drive.well and not test.reached_standstill:
            self._run_helper("stop", self._stop_in_place_of_the_drive_thread)
        elif connection.rig.control.ramp_unanswered:
            self._run_helper("power off", partial(connection.rig.control.stop_now, True))
        steps = test.sequence
        ramp = 1.5 * steps.fastest_rpm / steps.lowest_acceleration_rpm_per_s * connection.rig.slow()
        longest = ramp + timing.stop_margin + timing.coast + 4 * timing.make_safe
        longest += connection.rig.control.approach_s
        if not test.reached_standstill and time.monotonic() - test.stopping_since > longest:
            core.will_not_stop(say("The stop was commanded, but the drive did not answer."))
        if core.finish_due and not connection.commit.well:
            self._run_helper("finish", core.finish)

    def _stop_in_place_of_the_drive_thread(self) -> None:
        """Switch the power off and monitor the spindle to standstill; runs in a helper thread.

        Ends when the drive's thread runs again: two polling threads would both feed the watchdog.
        """
        connection = self._connection
        connection.rig.control.stop_now(off=True)
        while not (connection.drive.well or connection.supervise.halting):
            if not connection.rig.control.quiet:
                connection.rig.control.poll()
            connection.motion.follow(connection.rig.control.step())
            test = self._core.test
            if test is None or test.reached_standstill:
                return
            connection.supervise.pause(0.02)

    def _check_disk(self) -> None:
        """Report a slow commit while it lasts."""
        core, since = self._core, self._core.committing_since
        duration_s = time.monotonic() - since if since else 0.0
        if duration_s > SLOW_DISK_S and not core.alarms.is_active("disk_slow"):
            core.disk_slow(duration_s)

    def _check_file(self) -> None:
        """Check the path of the file, which may take long in a network folder."""
        now = time.monotonic()
        if now - self._file_seen_s >= FILE_S:
            self._file_seen_s = now
            self._run_helper("file", self._core.restore_file)

    def _check_clock(self) -> None:
        now, jump = time.monotonic(), self._core.clock_jump()
        jumped = abs(jump) > CLOCK_JUMP_S
        if now - self._anchored_s < ANCHOR_S and not jumped:
            return
        self._anchored_s = now
        self._core.anchor_time()
        if jumped:
            self._core.event(
                "clock", "engine", say("this computer's UTC clock jumped by {:.1f} s", jump)
            )

    def _run_helper(self, name: str, work: Callable[[], object]) -> None:
        """Run work that may block in a helper thread, one at a time for each name."""
        present = self._helpers.get(name)
        if present is not None and present.is_alive():
            return
        helper = threading.Thread(target=work, name=f"rigapp {name}", daemon=True)
        self._helpers[name] = helper
        helper.start()
