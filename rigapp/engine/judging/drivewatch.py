"""Judge what the drive says, and that it says something; called wherever the drive is asked."""

from __future__ import annotations

import threading
import time

from rigapp.engine.judging.machine import JudgedRig, JudgedRun
from rigapp.process.owntime import DEVICE_SHARE
from rigapp.schema.alarms import because
from rigapp.schema.messages import RunState
from rigapp.schema.states import TURNING
from rigapp_drivers.api import DeviceLost, DriveStatus, SettingsLost

SILENT_SHARE = 0.6
"""A drive that has not answered for this share of its watchdog's time ends the test: before the
watchdog does, so that the log names the cause and not what follows from it."""

TURNS_RPM, TURNS_SHARE = 1.0, 0.05
"""A drive that reports more than both, the second of the set speed, surely turns: its own noise and
the creep of a ramp's first moment stay below."""


class DriveWatch:
    """Judge a drive by its answers; one at a time, whoever asks."""

    def __init__(self, run: JudgedRun, rig: JudgedRig, watchdog_s: float) -> None:
        """Begin; watchdog_s: time-out of the drive's own watchdog."""
        self._run = run
        self._rig = rig
        record = run.rig.record
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
        if self._run.alarms.is_active("drive_settings_lost"):
            return  # it answers, and refuses all until it is connected again
        if not isinstance(error, DeviceLost) and (
            self._rig.age_s(control.answered_s) <= self._silent_s
        ):
            return
        sentence = error.sentence if error is not None else "it does not answer"
        name, port = spindle.name, spindle.port
        lost = isinstance(error, SettingsLost)
        self._run.act_on(
            because(
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
        run, drive = self._run, self._rig.spindle.name
        rpm, limit_rpm = status.speed_rev_per_s * 60.0, run.limits.overspeed_rpm
        run.alarms.clear("drive_silent")
        if status.emergency_stop:
            run.act_on(because("emergency_stop", drive=drive))
        else:
            run.alarms.clear("emergency_stop")
        if status.faults:
            run.act_on(because("drive_fault", drive=drive, faults=", ".join(status.faults)))
        elif not status.emergency_stop:
            run.alarms.clear("drive_fault")
        if status.warnings:
            run.act_on(because("drive_warning", drive=drive, warnings=", ".join(status.warnings)))
        else:
            run.alarms.clear("drive_warning")
        if run.state in TURNING and abs(rpm) > limit_rpm and not self._rig.swinging:
            run.act_on(because("overspeed", by="drive", speed_rpm=rpm, limit_rpm=limit_rpm))
        self._compare_with_encoder(rpm)

    def _compare_with_encoder(self, rpm: float) -> None:
        """Switch off a drive that turns while the encoder stands."""
        run, test, standing_s = self._run, self._run.test, self._run.timing.standing
        blind = (
            test is not None
            and run.state in (RunState.STARTING, RunState.RUNNING)
            and abs(rpm) > max(TURNS_RPM, TURNS_SHARE * test.target_rpm)
            and self._rig.processor.motion.standing(standing_s)
        )
        now = time.monotonic()
        if not blind:
            self._blind_since = None
            if not self._rig.processor.motion.standing(standing_s):  # a dead one sees no stop
                run.alarms.clear("encoder_lost")
        elif self._blind_since is None:
            self._blind_since = now
        elif now - self._blind_since > 2 * standing_s:
            run.act_on(because("encoder_lost", speed_rpm=rpm))
