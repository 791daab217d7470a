"""Look at what arrives beside the samples: the drive's answers, old blocks, broken sensors."""

from __future__ import annotations

import threading
import time

from rigapp.engine.connectedrig import ConnectedRig, slow_silent
from rigapp.engine.core import Core
from rigapp.process.processclock import DEVICE_SHARE
from rigapp.schema.alarms import KINDS, key_of, make_alarm
from rigapp.schema.messages import RunState
from rigapp.schema.states import ACTIVE, TURNING
from rigapp.texts import joined, say
from rigapp_drivers.api import DeviceLost, DriveStatus, InputFault, InputFaultKind, SettingsLost

CALM_S = 0.5
"""An input that was saturated has returned when no sample has been for so long."""

SILENT_SHARE = 0.6
"""A drive that has not answered for this share of its watchdog's time ends the test: before the
watchdog does, so that the log names the cause and not what follows from it."""

TURNS_RPM, TURNS_SHARE = 1.0, 0.05
"""A drive that reports more than both, the second of the set speed, surely turns: its own noise and
the creep of a ramp's first moment stay below."""


class Watches:
    """Look at the age of unprocessed data and at what the data source says of its inputs."""

    def __init__(self, core: Core, rig: ConnectedRig) -> None:
        self._core = core
        self._rig = rig
        self._told: tuple[InputFault, ...] = ()
        self._saturated: dict[str, int] = {}
        self._carried = {one.input: one.name for one in core.table.sampled}

    def look(self) -> None:
        """Look once."""
        self._look_at_queue()
        self._look_at_inputs()
        self._look_for_return()
        self._look_at_slow()

    def _look_at_slow(self) -> None:
        """Warn of slow devices that tell nothing, until they do."""
        slow, alarms = self._rig.slow_channels, self._core.alarms
        silent = {one.source.name: age_s for one, age_s in slow.silent()}
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
        named = joined(", ", (self._name(one) for one in fault.inputs))
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
        """Return what an input carries, beside its name."""
        carried = self._carried.get(wanted)
        return say("{} ({})", wanted, carried) if carried else wanted

    def _followed(self, fault: InputFault) -> bool:
        """Tell whether the samples themselves show it, and when it ends (``saturation``)."""
        return bool(fault.inputs) and set(fault.inputs) <= self._carried.keys()

    def _concerns_force(self, fault: InputFault) -> bool:
        cell = self._core.rig.record.load_cell
        return not fault.inputs or bool({cell.input_1, cell.input_2} & set(fault.inputs))


class DriveWatch:
    """Judge a drive by its answers; one at a time, whoever asks."""

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
        """Ask the drive, which feeds its watchdog, and judge the answer or its absence."""
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
        """Judge what the drive has said last, before anybody waits for the drive's thread."""
        with self._judging:
            if self._rig.control.status is not None:
                self._judge(self._rig.control.status)

    def reset(self) -> None:
        """Acknowledge the drive's own faults, and judge what it says then; raise DeviceError."""
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
        """Switch off a drive that turns while the encoder stands."""
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
            if not self._rig.processor.motion.standing(standing_s):  # a dead one sees no stop
                run.alarms.clear("encoder_lost")
        elif self._blind_since is None:
            self._blind_since = now
        elif now - self._blind_since > 2 * standing_s:
            run.act_on(make_alarm("encoder_lost", speed_rpm=rpm))
