"""Monitor what arrives: the drive's answers, old blocks, broken sensors, missing samples."""

from __future__ import annotations

import math
import threading
import time

from rigapp.engine.activetest import ActiveTest
from rigapp.engine.connectedrig import ConnectedRig, slow_silent
from rigapp.engine.core import Core
from rigapp.engine.samples.assembler import Revolution
from rigapp.process.processclock import DEVICE_SHARE
from rigapp.schema.alarms import KINDS, key_of, make_alarm
from rigapp.schema.messages import Flag, RunState
from rigapp.schema.states import ACTIVE, TURNING
from rigapp.texts import joined, say
from rigapp_drivers.api import (
    DeviceLost,
    DriveStatus,
    InputFault,
    InputFaultKind,
    SampleClock,
    SettingsLost,
)

CALM_S = 0.5
"""An input is no longer saturated when no sample has been for so long."""

SILENT_SHARE = 0.6
"""A drive that has not answered for this share of its watchdog's time ends the test: before the
watchdog does, so that the log names the cause and not the consequence."""

TURNS_RPM, TURNS_SHARE = 1.0, 0.05
"""A drive that reports more than both, the second of the set speed, surely turns: its own noise and
the creep of a ramp's first moment stay below."""


class Watches:
    """Check the age of unprocessed data and the faults that the data source reports."""

    def __init__(self, core: Core, rig: ConnectedRig) -> None:
        self._core = core
        self._rig = rig
        self._told: tuple[InputFault, ...] = ()
        self._saturated: dict[str, int] = {}
        self._carried = {channel.input: channel.name for channel in core.table.sampled}

    def look(self) -> None:
        """Check once."""
        self._look_at_queue()
        self._look_at_inputs()
        self._look_for_return()
        self._look_at_slow()

    def _look_at_slow(self) -> None:
        """Warn of slow devices that are silent, until they answer."""
        slow, alarms = self._rig.slow_channels, self._core.alarms
        silent = {quiet.source.name: age_s for quiet, age_s in slow.silent()}
        for name, device in slow.devices.items():
            key = key_of("slow_silent", name)
            if name not in silent:
                if not device.worker.error:
                    alarms.clear(key)
            elif not alarms.is_active(key):
                why = device.last_error.sentence if device.last_error is not None else ""
                self._core.act_on(slow_silent(device.source, silent[name], why))

    def _look_at_queue(self) -> None:
        """Switch the drive off when an overload would be seen too late."""
        run, limit_s = self._core, self._core.timing.queue_age
        age_s = self._rig.queue_age_s()
        if age_s <= limit_s:
            run.alarms.clear("queue_age")
        elif run.state in ACTIVE and not run.alarms.is_active("queue_age"):
            device = self._rig.source.name
            run.act_on(make_alarm("queue_age", device=device, age_s=age_s, limit_s=limit_s))

    def _look_at_inputs(self) -> None:
        source = self._rig.source
        faults = source.input_faults()
        if faults == self._told:
            return
        fresh = [fault for fault in faults if fault not in self._told]
        self._told = faults
        for fault in fresh:
            self._tell(source.name, source.port, fault)

    def _look_for_return(self) -> None:
        """End the alarm of a saturated input when no sample has been flagged for a while."""
        processor = self._rig.processor
        patience = CALM_S * processor.calibration.sample_rate_Hz
        for key, told_at in list(self._saturated.items()):
            if processor.next_sample - max(told_at, processor.saturated_until) > patience:
                del self._saturated[key]
                self._core.alarms.clear(key)

    def _tell(self, device: str, port: str, fault: InputFault) -> None:
        run, full = self._core, fault.kind is InputFaultKind.SATURATED
        if full and self._followed(fault):
            return
        named = joined(", ", (self._name(number) for number in fault.inputs))
        kind, what = f"input:{fault.kind.value}", named
        if fault.kind is InputFaultKind.SENSOR_BROKEN:
            concerned = self._concerns_force(fault) and run.state in ACTIVE
            kind = "input:broken" if concerned else "input:suspect"
            if fault.host_time_ns == 0:
                kind = "input:before"
        elif kind not in KINDS:
            kind, what = "input", say("{}:{}", fault.kind.value, named)
        cause = make_alarm(
            kind,
            what,
            kind=fault.kind.value,
            device=device,
            port=port,
            words=fault.words + (f" ({named})" if named else ""),
        )
        run.act_on(cause)
        if full:
            self._saturated[cause.key] = self._rig.processor.next_sample

    def _name(self, wanted: str) -> str:
        """Return the name of an input with its channel."""
        carried = self._carried.get(wanted)
        return say("{} ({})", wanted, carried) if carried else wanted

    def _followed(self, fault: InputFault) -> bool:
        """Return whether the samples themselves show it, and when it ends (``saturation``)."""
        return bool(fault.inputs) and set(fault.inputs) <= self._carried.keys()

    def _concerns_force(self, fault: InputFault) -> bool:
        cell = self._core.rig.record.load_cell
        return not fault.inputs or bool({cell.input_1, cell.input_2} & set(fault.inputs))


class DriveWatch:
    """Monitor a drive by its answers; calls from several threads run one at a time."""

    def __init__(self, core: Core, rig: ConnectedRig, watchdog_s: float) -> None:
        """Begin; watchdog_s: time-out of the drive's own watchdog."""
        self._core = core
        self._rig = rig
        record = core.rig.record
        simulated = record.devices[record.spindle.device].simulated
        # On a busy computer a simulated drive answers late, and its watchdog is late with it.
        fires_s = watchdog_s / DEVICE_SHARE if simulated else watchdog_s
        self._silent_s = fires_s * SILENT_SHARE
        self._blind_since: float | None = None
        self._judging = threading.Lock()

    def ask(self) -> None:
        """Poll the drive, which feeds its watchdog, and judge the answer or its absence."""
        control, spindle = self._rig.control, self._rig.spindle
        with self._judging:
            status = control.poll()
            if status is not None:
                self._judge(status)
                return
        error = control.last_error
        if self._core.alarms.is_active("drive_settings_lost"):
            return  # it answers, and refuses all until it is connected again
        if not isinstance(error, DeviceLost) and (
            self._rig.age_s(control.answered_s) <= self._silent_s
        ):
            return
        sentence = error.sentence if error is not None else say("it does not answer")
        name, port = spindle.name, spindle.port
        lost = isinstance(error, SettingsLost)
        self._core.act_on(
            make_alarm(
                "drive_settings_lost" if lost else "drive_silent",
                drive=name,
                port=port,
                sentence=sentence,
            )
        )

    def look(self) -> None:
        """Evaluate the drive's last answer, before another thread waits for the drive's thread."""
        with self._judging:
            if self._rig.control.status is not None:
                self._judge(self._rig.control.status)

    def reset(self) -> None:
        """Acknowledge the drive's own faults, and judge its next answer; raise DeviceError."""
        with self._judging:
            self._rig.control.reset_fault()
            if self._rig.control.status is not None:
                self._judge(self._rig.control.status)

    def _judge(self, status: DriveStatus) -> None:
        run, drive = self._core, self._rig.spindle.name
        rpm, limit_rpm = status.speed_rev_per_s * 60.0, run.limits.overspeed_rpm
        run.alarms.clear("drive_silent")
        if status.emergency_stop:
            run.act_on(make_alarm("emergency_stop", drive=drive))
        else:
            run.alarms.clear("emergency_stop")
        if status.faults:
            run.act_on(make_alarm("drive_fault", drive=drive, faults=joined(", ", status.faults)))
        elif not status.emergency_stop:
            run.alarms.clear("drive_fault")
        if status.warnings:
            run.act_on(
                make_alarm("drive_warning", drive=drive, warnings=joined(", ", status.warnings))
            )
        else:
            run.alarms.clear("drive_warning")
        if run.state in TURNING and abs(rpm) > limit_rpm and not self._rig.swinging:
            run.act_on(make_alarm("overspeed", by="drive", speed_rpm=rpm, limit_rpm=limit_rpm))
        self._compare_with_encoder(rpm)

    def _compare_with_encoder(self, rpm: float) -> None:
        """Switch off a drive that turns while the encoder shows a standstill."""
        run, test, standing_s = self._core, self._core.test, self._core.timing.standing
        no_data = (
            test is not None
            and run.state in (RunState.STARTING, RunState.RUNNING)
            and abs(rpm) > max(TURNS_RPM, TURNS_SHARE * test.target_rpm)
            and self._rig.processor.motion.standing(standing_s)
        )
        now = time.monotonic()
        if not no_data:
            self._blind_since = None
            if not self._rig.processor.motion.standing(standing_s):  # a dead one shows no stop
                run.alarms.clear("encoder_lost")
        elif self._blind_since is None:
            self._blind_since = now
        elif now - self._blind_since > 2 * standing_s:
            run.act_on(make_alarm("encoder_lost", speed_rpm=rpm))


# Find samples that went missing without a number, determine their duration, and act on it.
#
# Three sources, as none shows every gap:
#
# - The encoder: its count jumps, and is right at the next index all the same. It shows any gap but
#   one of whole turns, not how many turns, and at once: late samples show no jump.
# - The host's clock: device time falls behind it. Only in real time, beyond the jitter of blocks.
# - The drive's own count: the encoder's turns fall behind it. At any speed of a simulated rig.
#
# After a jump the other two give the length within ``SHORT_S``; without one (whole
# turns, a stationary crank) the lag has to stay for a ``WINDOW_S``: a late reader shows one, too.

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
        """Take a gap whose length the device reports; return whether it ends the test.

        The device may miss part of it: it takes the host's clock, which a simulated rig outruns.
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

    # --- sources ---------------------------------------------------------------------------------

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
        if self._skipped is not None:  # the encoder gives the part of a turn
            grown = self._skipped + max(0, round(grown - self._skipped))
        self._time.restart()
        self._found(grown / self._rev_per_s(test))
        return True

    def _look_at_jump(self, test: ActiveTest, host_s: float) -> None:
        """Report a gap that the encoder alone has seen, when the others had their time."""
        skipped, jumped_s = self._skipped, self._jumped_s
        if skipped is not None and jumped_s is not None and host_s - jumped_s >= 2.0 * SHORT_S:
            self._found(skipped / self._rev_per_s(test))

    # --- consequences ----------------------------------------------------------------------------

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
