"""Monitoring of the drive's replies, the age of blocks, sensor faults and missing samples."""

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
"""Time without saturated samples after which an input is no longer saturated."""

SILENT_SHARE = 0.6
"""Time without a reply of the drive that ends the test, relative to its watchdog: earlier than the
watchdog, so that the log names the cause and not the consequence."""

TURNS_RPM, TURNS_SHARE = 1.0, 0.05
"""Reported speeds of the drive, absolute and relative to the set speed, above both of which it
turns: above its noise and the creep at the start of a ramp."""


class Watches:
    """Checks of the age of unprocessed data and of the faults reported by devices."""

    def __init__(self, core: Core, rig: ConnectedRig) -> None:
        self._core = core
        self._rig = rig
        self._reported_faults: tuple[InputFault, ...] = ()
        self._saturated: dict[str, int] = {}
        self._carried = {channel.input: channel.name for channel in core.table.sampled}

    def look(self) -> None:
        """Run all checks once."""
        self._check_queue()
        self._check_inputs()
        self._clear_unsaturated()
        self._check_slow()

    def _check_slow(self) -> None:
        """Warn of slow devices without replies, until they reply."""
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

    def _check_queue(self) -> None:
        """Switch the drive off if an overload would be detected too late."""
        run, limit_s = self._core, self._core.timing.queue_age
        age_s = self._rig.queue_age_s()
        if age_s <= limit_s:
            run.alarms.clear("queue_age")
        elif run.state in ACTIVE and not run.alarms.is_active("queue_age"):
            device = self._rig.source.name
            run.act_on(make_alarm("queue_age", device=device, age_s=age_s, limit_s=limit_s))

    def _check_inputs(self) -> None:
        source = self._rig.source
        faults = source.input_faults()
        if faults == self._reported_faults:
            return
        fresh = [fault for fault in faults if fault not in self._reported_faults]
        self._reported_faults = faults
        for fault in fresh:
            self._raise_input_alarm(source.name, source.port, fault)

    def _clear_unsaturated(self) -> None:
        """Clear the alarm of a saturated input after ``CALM_S`` without flagged samples."""
        processor = self._rig.processor
        patience = CALM_S * processor.calibration.sample_rate_Hz
        for key, reported_at in list(self._saturated.items()):
            if processor.next_sample - max(reported_at, processor.saturated_until) > patience:
                del self._saturated[key]
                self._core.alarms.clear(key)

    def _raise_input_alarm(self, device: str, port: str, fault: InputFault) -> None:
        run, saturated = self._core, fault.kind is InputFaultKind.SATURATED
        if saturated and self._shown_by_samples(fault):
            return
        named = joined(", ", (self._name(number) for number in fault.inputs))
        kind, what = f"input:{fault.kind.value}", named
        if fault.kind is InputFaultKind.SENSOR_BROKEN:
            critical = self._affects_force(fault) and run.state in ACTIVE
            kind = "input:broken" if critical else "input:suspect"
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
        if saturated:
            self._saturated[cause.key] = self._rig.processor.next_sample

    def _name(self, wanted: str) -> str:
        """Return the name of an input with its channel."""
        channel = self._carried.get(wanted)
        return say("{} ({})", wanted, channel) if channel else wanted

    def _shown_by_samples(self, fault: InputFault) -> bool:
        """Return whether the samples show the fault and its end (``checks.SaturationWatch``)."""
        return bool(fault.inputs) and set(fault.inputs) <= self._carried.keys()

    def _affects_force(self, fault: InputFault) -> bool:
        cell = self._core.rig.record.load_cell
        return not fault.inputs or bool({cell.input_1, cell.input_2} & set(fault.inputs))


class DriveWatch:
    """Checks of a drive's replies; thread-safe."""

    def __init__(self, core: Core, rig: ConnectedRig, watchdog_s: float) -> None:
        """Initialise; watchdog_s: time-out of the drive's own watchdog."""
        self._core = core
        self._rig = rig
        record = core.rig.record
        simulated = record.devices[record.spindle.device].simulated
        # On a busy computer the replies and the watchdog of a simulated drive are late alike.
        fires_s = watchdog_s / DEVICE_SHARE if simulated else watchdog_s
        self._silent_s = fires_s * SILENT_SHARE
        self._no_data_since: float | None = None
        self._lock = threading.Lock()

    def ask(self) -> None:
        """Poll the drive, which feeds its watchdog, and check the reply or its absence."""
        control, spindle = self._rig.control, self._rig.spindle
        with self._lock:
            status = control.poll()
            if status is not None:
                self._check_status(status)
                return
        error = control.last_error
        if self._core.alarms.is_active("drive_settings_lost"):
            return  # it replies, and rejects all commands until it is reconnected
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
        """Check the drive's last reply, without waiting for the drive's thread."""
        with self._lock:
            if self._rig.control.status is not None:
                self._check_status(self._rig.control.status)

    def reset(self) -> None:
        """Acknowledge the drive's own faults, and check its next reply; raise DeviceError."""
        with self._lock:
            self._rig.control.reset_fault()
            if self._rig.control.status is not None:
                self._check_status(self._rig.control.status)

    def _check_status(self, status: DriveStatus) -> None:
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
        """Switch the drive off if it turns while the encoder shows a standstill."""
        run, test, standing_s = self._core, self._core.test, self._core.timing.standing
        no_data = (
            test is not None
            and run.state in (RunState.STARTING, RunState.RUNNING)
            and abs(rpm) > max(TURNS_RPM, TURNS_SHARE * test.target_rpm)
            and self._rig.processor.motion.standing(standing_s)
        )
        now = time.monotonic()
        if not no_data:
            self._no_data_since = None
            if not self._rig.processor.motion.standing(standing_s):  # a dead one shows no stop
                run.alarms.clear("encoder_lost")
        elif self._no_data_since is None:
            self._no_data_since = now
        elif now - self._no_data_since > 2 * standing_s:
            run.act_on(make_alarm("encoder_lost", speed_rpm=rpm))


# Detection of missing samples of unknown number, their duration, and the action.
#
# Three sources, as none detects all gaps:
#
# - The encoder: its count jumps, but is correct at the next index. Detects any gap except whole
#   turns, immediately, without the number of turns; late samples cause no jump.
# - The host's clock: device time lags behind it. In real time only, beyond the jitter of blocks.
# - The drive's own count: the encoder's turns lag behind it. At any speed of a simulated rig.
#
# After a jump the other two give the length within ``SHORT_S``; without one (whole turns, a
# stationary crank) the lag must last for ``WINDOW_S``, as a late reader causes a lag, too.

WINDOW_S = 2.0  # the least lag in a window of this length is free of the jitter of single blocks
SHORT_S = 0.3
"""Window after a jump of the count, which late samples do not cause: three replies of the drive,
or fifteen blocks. Also for the first level: too high a level hides a gap for one window, but causes
no false one."""

LATE_S = 0.2
"""Lag above which samples are missing; larger than the jitter of a host."""

JUMP_LATE_S = 0.1
"""The same after a jump of the count."""

SLIP = 0.15
"""Bound of slip or a wrong gear ratio, relative to the turns (``judging.checks.AGREE``)."""

HALF_TURN = 0.5
"""Least missing turns: as the encoder counts within a turn, only whole turns can be missing."""

ANSWER_S = 0.03
"""Possible difference in the age of replies of the drive, or of blocks, s of the host."""

MOST_MISSING = 1e5
"""Turns beyond which the drive's counter has wrapped or was set."""

SLOWEST = 0.1
"""Least speed of the drive used as a divisor, relative to the set speed."""


class LagWatch:
    """Detector of a permanent increase of a lag.

    A late reader delays a block, but not the next ones, so the smallest lag within a window is free
    of it. A permanent lag is lost data. level: smallest lag of the last window.
    """

    def __init__(self) -> None:
        self.restart()

    def restart(self) -> None:
        """Discard the level; the next window sets it."""
        self.level = math.nan
        self.start_short_window()

    def start_short_window(self) -> None:
        """Start a short window with the next lag."""
        self._smallest = math.inf
        self._window_end = math.nan
        self._window_s = SHORT_S

    def add(self, lag: float, host_s: float) -> float:
        """Add a lag; return its increase at the end of a window, else NaN."""
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
    """Detector of gaps; for the processing thread, except ``outstanding_s``."""

    def __init__(self, core: Core, rig: ConnectedRig) -> None:
        self._core = core
        self._rig = rig
        self._time, self._turns = LagWatch(), LagWatch()
        self._compared_ns = 0
        self._skips = 0
        self._jumped_s: float | None = None
        self._skipped: float | None = None

    def begin(self) -> None:
        """Restart at the begin of a test, as the earlier count of the drive is arbitrary."""
        self._turns.restart()
        self._jumped_s = self._skipped = None

    def look(self) -> None:
        """Check the latest block."""
        newest, motion = self._rig.processor.motion.newest(), self._rig.processor.assembler.motion
        if newest is None:
            return
        if motion.skips != self._skips:
            self._skips = motion.skips
            self._jumped_s = newest.host_s
            self._time.start_short_window()
            self._turns.start_short_window()
        test = self._core.test
        if self._compare_time(newest.host_s, newest.sample):
            return
        # A crank that swings after a stop may slip; a jump of its count is still a gap.
        swings = self._rig.swinging and self._jumped_s is None
        if test is not None and self._core.state in ACTIVE and not swings:
            if self._compare_turns(test):
                return
            self._report_jump(test, newest.host_s)

    def known(self, seconds: float) -> bool:
        """Record a gap of a length reported by the device; return whether it ends the test.

        That may be too short, as it is by the host's clock, which a simulated rig can outrun.
        """
        test, assembler = self._core.test, self._rig.processor.assembler
        self._restart_levels()
        if test is None or self._core.state not in ACTIVE:
            return False
        turned = abs(assembler.motion.turned_in_gap) / assembler.encoder.counts_per_revolution
        seconds = max(seconds, turned / self._rev_per_s(test))
        return self._ends(seconds)

    def revolution(self, revolution: Revolution) -> None:
        """Check at the end of a revolution whether a jump was an error of the encoder."""
        flags = Flag.LOST_SAMPLES | Flag.GAP_BEFORE | Flag.TIME_JUMP
        if revolution.skipped_counts and not revolution.flags & flags:
            turn = self._rig.processor.assembler.encoder.counts_per_revolution
            self._skipped = (revolution.skipped_counts / turn) % 1.0
        elif revolution.flags & Flag.COUNT_MISMATCH:
            self._jumped_s = None

    def outstanding_s(self) -> float:
        """Return for how long samples are outstanding by the drive's count, s of the rig.

        Late or lost samples: the drive has turned since the latest ones.
        """
        test, status = self._core.test, self._rig.control.status
        newest, level = self._rig.processor.motion.turns(), self._turns.level
        if test is None or status is None or newest is None or self._core.state not in ACTIVE:
            return 0.0
        turns = status.position_count / self._rig.counts_per_turn - newest[0] - level
        return turns / self._rev_per_s(test) if 0.0 < turns < MOST_MISSING else 0.0

    # --- sources ---------------------------------------------------------------------------------

    def _compare_time(self, host_s: float, sample: int) -> bool:
        """Compare host and device time, of a rig in real time with a sample clock."""
        calibration = self._rig.processor.calibration
        by_encoder = calibration.counter.clock is SampleClock.ENCODER
        if self._core.rig.record.simulated_samples or by_encoder:
            return False
        increase = self._time.add(host_s - sample / calibration.sample_rate_Hz, host_s)
        least_s = LATE_S if self._jumped_s is None else JUMP_LATE_S
        if not increase > least_s:
            return False
        self._turns.restart()
        self._report_gap(increase)
        return True

    def _compare_turns(self, test: ActiveTest) -> bool:
        """Compare the turns of drive and encoder."""
        status, motion = self._rig.control.status, self._rig.processor.motion
        if status is None or status.host_time_ns == self._compared_ns:
            return False
        host_s = status.host_time_ns * 1e-9
        turns = motion.turns_at(host_s)
        if turns is None or (self._jumped_s is not None and host_s < self._jumped_s):
            return False
        self._compared_ns = status.host_time_ns
        increase = self._turns.add(
            status.position_count / self._rig.counts_per_turn - turns, host_s
        )
        blur_s = SLIP * WINDOW_S if self._jumped_s is None else ANSWER_S
        least = max(HALF_TURN, blur_s * test.target_rpm / 60.0 * motion.pace())
        if not least < increase < MOST_MISSING:
            return False
        if self._skipped is not None:  # the fraction of a turn is that of the encoder
            increase = self._skipped + max(0, round(increase - self._skipped))
        self._time.restart()
        self._report_gap(increase / self._rev_per_s(test))
        return True

    def _report_jump(self, test: ActiveTest, host_s: float) -> None:
        """Report a gap detected by the encoder only, after the window of the others."""
        skipped, jumped_s = self._skipped, self._jumped_s
        if skipped is not None and jumped_s is not None and host_s - jumped_s >= 2.0 * SHORT_S:
            self._report_gap(skipped / self._rev_per_s(test))

    # --- consequences ----------------------------------------------------------------------------

    def _restart_levels(self) -> None:
        """Restart the levels after a known gap."""
        self._time.restart()
        self._turns.restart()
        self._jumped_s = self._skipped = None

    def _report_gap(self, seconds: float) -> None:
        """Record a gap; switch the power off if it exceeds the limit of stale data."""
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
        """End the test if a gap is too long, except during a stop, which has its own reason."""
        run, limit_s = self._core, self._core.limits.stale_data_s
        if seconds <= limit_s or run.state is RunState.STOPPING:
            return False
        device = self._rig.source.name
        run.act_on(make_alarm("samples_missing", device=device, seconds=seconds, limit_s=limit_s))
        return True

    def _rev_per_s(self, test: ActiveTest) -> float:
        """Return the speed of the drive, rev/s."""
        status = self._rig.control.status
        speed = abs(status.speed_rev_per_s) if status is not None else 0.0
        return max(speed, SLOWEST * test.target_rpm / 60.0)
