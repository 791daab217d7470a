"""Status of the engine."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import PurePath
from typing import Any, Final

from rigapp.engine.activetest import ActiveTest
from rigapp.engine.connection import Connection
from rigapp.engine.core import Core
from rigapp.engine.devices import Devices
from rigapp.engine.judging.limits import least_margin, margin_to
from rigapp.engine.values.calibrate import Calibration
from rigapp.schema.channels import LOAD_CELL, PROBES, Channel, Kind
from rigapp.schema.columns import by_name, prediction_columns
from rigapp.schema.messages import (
    Alarm,
    ChannelView,
    DeviceView,
    DriveView,
    Ends,
    EngineStatus,
    HowEnded,
    Recovery,
    Remedy,
    RigStatus,
    RunState,
    Severity,
    Status,
    TestStatus,
    as_array,
)
from rigapp.schema.results import how_ended
from rigapp.schema.states import ACTIVE
from rigapp.texts import say
from rigapp_calibration.load_cell.force_uncertainty import stated_uncertainty
from rigapp_drivers.api import DeviceError, help_of
from rigapp_drivers.edge import Guarded

# Recovery from a fault: the next step, determined from the state and the alarms only.
#
# The order is fixed: remove the cause, connect, acknowledge, reset, resume. Steps that are not
# needed are omitted. Window, ``rigapp status`` and command line show this result.

WAITING: Final = {
    RunState.CONNECTING: say("Wait: the devices are being connected."),
    RunState.STOPPING: say("Wait: the spindle is stopping and the file is being finished."),
    RunState.PAUSING: say("Wait: the crank comes to rest at the pause angle."),
}
"""Transient states, and their texts."""

AT_REST: Final = frozenset({RunState.IDLE, RunState.READY, RunState.STOPPED, RunState.FAULT})
"""States without an open test or a transition."""


@dataclass(frozen=True, slots=True)
class Situation:
    """Inputs for the next step of a recovery.

    reason: text of the state. connected: the devices are open and their threads run. unfinished:
    file of the last test if it has revolutions left, else empty. not_yet: text of the condition
    that prevents a start, or empty.
    """

    state: RunState
    reason: str
    connected: bool
    alarms: Sequence[Alarm]
    unfinished: str = ""
    not_yet: str = ""

    def critical(self, *ends: Ends) -> list[Alarm]:
        """Return the active critical alarms with one of these ends, or without ``ends`` all."""
        listed = [alarm for alarm in self.alarms if alarm.severity is Severity.CRITICAL]
        return [a for a in listed if a.active and a.ends in ends] if ends else listed


def recovery(now: Situation) -> Recovery:
    """Return the next step in a situation, and the remaining steps."""
    if now.state in WAITING:
        return Recovery(sentence=WAITING[now.state])
    if now.state is RunState.PAUSED:
        return Recovery(Remedy.RESUME, "resume", say("Resume the paused test."), (Remedy.RESUME,))
    if now.state not in AT_REST:
        return Recovery()
    lost = now.critical(Ends.CONNECTION)
    seen = now.critical(Ends.SEEN, Ends.STAND)
    drive = now.critical(Ends.DRIVE)
    listed = now.critical()
    fresh = [alarm for alarm in listed if not alarm.acknowledged]
    needed = {
        Remedy.CAUSE: bool(lost or seen or drive),
        Remedy.CONNECT: bool(lost) or not now.connected,
        Remedy.ACKNOWLEDGE: bool(fresh),
        Remedy.RESET: bool(listed) or now.state is RunState.FAULT,
        Remedy.RESUME: True,
    }
    left = tuple(step for step, is_needed in needed.items() if is_needed)
    # No waiting for causes that only a new connection or the drive's reset ends.
    watched = bool(seen) and not needed[Remedy.CONNECT]
    step = next(remedy for remedy in left if remedy is not Remedy.CAUSE or watched)
    if step is Remedy.RESUME and now.not_yet:
        return Recovery(sentence=say("Wait: {}.", now.not_yet), left=left)
    alarms = {
        Remedy.CAUSE: seen,
        Remedy.CONNECT: lost,
        Remedy.ACKNOWLEDGE: fresh,
        Remedy.RESET: drive or sorted(listed, key=lambda alarm: not alarm.first_out),
    }.get(step, [])
    return Recovery(
        step=step,
        verb=_verb(step, now),
        sentence=_sentence(step, alarms, now),
        left=left,
        cause=alarms[0].key if alarms else "",
    )


def _verb(step: Remedy, now: Situation) -> str:
    if step is Remedy.CAUSE:
        return ""
    if step is Remedy.RESUME:
        return "resume_file" if now.unfinished else "start"
    return step.value


def _sentence(step: Remedy, alarms: Sequence[Alarm], now: Situation) -> str:
    if step is Remedy.RESUME:
        if now.unfinished:
            name = PurePath(now.unfinished).name
            return say("Resume the test in {}, or start another one.", name)
        return say("Start a test.")
    if step is Remedy.ACKNOWLEDGE:
        more = say(" and {} more", len(alarms) - 1) if len(alarms) > 1 else ""
        return say('Acknowledge "{}"{}: confirm that you have seen it.', alarms[0].title, more)
    if alarms and alarms[0].active and alarms[0].ends is not Ends.TEST:
        return alarms[0].action
    if step is Remedy.CONNECT:
        return say("Remove the cause, then connect the devices.") if now.reason else say("Connect.")
    return say("Reset to clear the fault. Nothing will move.")


RIG_FILE = say("rig file")
"""Shown without a calibration record."""

RIG_LINE = say("by its line in the rig file")
"""Shown for a free channel without a record."""


def build_status(
    core: Core,
    connection: Connection | None,
    operator: str,
    opening: Devices | None = None,
    error: DeviceError | None = None,
) -> Status:
    """Return the status; opening: devices being connected, or not connected because of error."""
    active, rig = core.test, core.rig.record
    live = connection.rig if connection is not None else None
    return Status(
        EngineStatus(
            core.state, core.reason, os.getpid(), host_time=time.time(), operator=operator
        ),
        _test(core, connection, active) if active is not None else None,
        RigStatus(
            rig.name,
            rig.simulated,
            speed_rpm=live.processor.motion.speed_rpm() if live is not None else None,
            data_age_s=live.data_age_s() if live is not None else None,
            coasting=live is not None and live.coasting,
            drive=_drive(connection),
            devices=_devices(connection) if opening is None else _being_opened(opening, error),
            channels=_channels(core, connection),
        ),
        core.alarms.alarms(),
        next_step(core, connection),
    )


def _test(core: Core, connection: Connection | None, active: ActiveTest) -> TestStatus:
    now, run, prediction = time.monotonic(), active.run, active.prediction
    margin, margin_name = _margin(core, connection, active)
    left, criterion = _criterion(core, active)
    predicted, predicted_at = dict[str, float](), 0.0
    if prediction is not None:
        predicted = by_name(prediction_columns(), as_array(prediction.values, "<f8"))
        predicted_at = active.prediction_at
    return TestStatus(
        title=active.document.record.title,
        file=str(active.path),
        revolution=core.revolution,
        planned=run.planned,
        committed=max(0, active.committed),
        first_revolution=run.first,
        target_rpm=active.target_rpm,
        started_at=active.started_at,
        expected_end_at=_expected_end(core, connection, active),
        revolution_age_s=now - active.revolution_at if active.revolution_at is not None else None,
        worst_margin_percent=margin,
        worst_margin=margin_name,
        criterion_percent=left,
        criterion=criterion,
        twin_revolution=prediction.revolution if prediction is not None else 0,
        twin_age_s=now - predicted_at if prediction is not None else None,
        residual_rms_N=predicted.get("residual_rms"),
        # A rest belongs to the step before it.
        step=active.resting.step if active.resting is not None else active.stage.step,
        steps=active.sequence.count,
        resting=active.resting is not None,
        rest_left_s=_rest_left_s(connection, active),
        outcome=_outcome(active),
    )


def _rest_left_s(connection: Connection | None, active: ActiveTest) -> float:
    """Return the host time until a test resumes after a rest, s; 0 without a rest."""
    if connection is None or (rest := active.resting) is None:
        return 0.0
    pace = connection.rig.pace()
    return rest.left_s(pace) / pace


def _outcome(active: ActiveTest) -> HowEnded | None:
    ended = active.outcome
    return how_ended(ended.status, ended.reason) if ended is not None else None


def _criterion(core: Core, active: ActiveTest) -> tuple[float | None, str]:
    """Return the least remaining fraction of a stop criterion, in percent, and its name."""
    if core.state not in ACTIVE:
        return None, ""
    run = active.run
    last = (100.0 * (run.planned - run.number) / run.planned, say("the last revolution"))
    return min(last, run.stops.nearest())


def next_step(core: Core, connection: Connection | None) -> Recovery:
    """Return the next step back to a running test."""
    active = core.test
    outcome = active.outcome if active is not None else None
    left = active is not None and active.run.number < active.run.planned
    if core.state is RunState.PAUSED and active is not None and active.resting is not None:
        return Recovery(sentence=say("Wait: the test resumes by itself after the rest."))
    resumable = outcome is not None and outcome.revolutions > 0 and outcome.status != "complete"
    return recovery(
        Situation(
            state=core.state,
            reason=core.reason,
            connected=connection is not None and connection.sound,
            alarms=core.alarms.alarms(),
            unfinished=outcome.file if outcome is not None and resumable and left else "",
            not_yet=connection.rig.not_yet(core.limits.stale_data_s)
            if connection is not None
            else "",
        )
    )


def _margin(
    core: Core, connection: Connection | None, active: ActiveTest
) -> tuple[float | None, str]:
    """Return the least margin to a limit in percent, and its name; of presently active limits.

    Limits of revolutions are active at the set speed, that of stale data during a test.
    """
    if connection is None or core.state not in ACTIVE:
        return None, ""
    limits, evaluated = active.limits, active.run.evaluated
    margin = margin_to(limits.stale_data_s, connection.rig.data_age_s(), say("stale data"))
    if core.state is RunState.RUNNING and evaluated is not None:
        values = evaluated.named
        step = active.run.step(evaluated.number)
        margin = min(margin, least_margin(active.run.monitor, limits, values, step))
    return margin if math.isfinite(margin[0]) else (None, "")


def _expected_end(core: Core, connection: Connection | None, active: ActiveTest) -> float:
    if connection is None or core.state not in ACTIVE:
        return 0.0
    pace = connection.rig.pace()
    rest_s = active.resting.left_s(pace) if active.resting is not None else 0.0
    return time.time() + (_seconds_left(active) + rest_s) / pace


def _seconds_left(active: ActiveTest) -> float:
    """Return the test's time to its last revolution or planned hours, without a present rest."""
    run, stop = active.run, active.document.record.stop
    now_s = run.newest.named["time"] if run.newest is not None else run.time_offset_s
    left = [active.sequence.seconds(run.number + 1, run.planned)]
    if stop.elapsed_time_h is not None:
        left.append(3600.0 * stop.elapsed_time_h - now_s)
    if stop.running_time_h is not None:
        left.append(3600.0 * (stop.running_time_h - run.stops.running_h))
    return float(max(0.0, min(left)))


def _drive(connection: Connection | None) -> DriveView | None:
    status = connection.rig.control.status if connection is not None else None
    if status is None:
        return None
    return DriveView(
        speed_rpm=status.speed_rev_per_s * 60.0,
        setpoint_rpm=status.setpoint_rev_per_s * 60.0,
        current_A=status.current_A,
        supply_V=status.supply_V,
        temperature_C=status.temperature_C,
        enabled=status.enabled,
        emergency_stop=status.emergency_stop,
        faults=status.faults,
        warnings=status.warnings,
        age_s=1e-9 * (time.monotonic_ns() - status.host_time_ns),
    )


def _devices(connection: Connection | None) -> tuple[DeviceView, ...]:
    if connection is None:
        return ()
    source, control = connection.devices.source, connection.rig.control
    sampling = DeviceView(
        **_named(connection.devices, source, connection.last_source_error),
        connected=not connection.reader.ended,
        sample_rate_Hz=connection.rig.setup.sample_rate_Hz,
        lost_samples=connection.rig.processor.assembler.lost_samples,
        errors=connection.source_errors,
    )
    drive = DeviceView(
        **_named(connection.devices, connection.devices.spindle, control.last_error),
        connected=control.answering,
        errors=control.errors,
    )
    slow = (
        DeviceView(
            **_named(connection.devices, device.source, device.last_error),
            connected=device.answering,
            errors=device.errors,
            needed=False,
        )
        for device in connection.rig.slow_channels.devices.values()
    )
    return (sampling, drive, *slow)


def _being_opened(devices: Devices, error: DeviceError | None) -> tuple[DeviceView, ...]:
    """Return the devices in the order of opening, ready ones as connected.

    error: of the connection; all devices are closed then.
    """
    needed = (devices.source, devices.spindle)
    if error is None:
        return tuple(
            DeviceView(**_named(devices, device), connected=device.name in devices.readback)
            for device in needed
        )
    errors = {fault.device: fault for fault in error.each}
    all_devices: list[Guarded] = [*needed, *(slow for slow, _ in devices.slow)]
    return tuple(
        DeviceView(**_named(devices, d, errors.get(d.name)), connected=False, needed=d in needed)
        for d in all_devices
    )


def _named(devices: Devices, device: Guarded, error: DeviceError | None = None) -> dict[str, Any]:
    """Return the fields common to all devices; error: the last of this device."""
    identity = devices.identities.get(device.name)
    words = ("maker", "model", "firmware", "serial_number")
    return {
        "name": device.name,
        "driver": devices.drivers[device.name],
        "port": device.port,
        "identity": " ".join(getattr(identity, word) for word in words).strip() if identity else "",
        "counters": dict(device.counters()),
        "wiring": str(devices.readback.get(device.name, {}).get("wiring", "")),
        "advice": str(devices.readback.get(device.name, {}).get("advice", "")),
        "last_error": error.sentence if error is not None else "",
        "help": help_of(error) if error is not None else "",
    }


def _channels(core: Core, connection: Connection | None) -> tuple[ChannelView, ...]:
    live = connection.rig.processor.live if connection is not None else None
    if connection is None or live is None:
        return ()
    calibration = connection.rig.processor.calibration
    records = {
        LOAD_CELL: calibration.load_cell.record or RIG_FILE,
        PROBES: calibration.probes.record or RIG_FILE,
        **{name: line.record or RIG_LINE for name, line in calibration.scalars.items()},
    }
    units = {wire.channel.name: wire.unit for wire in calibration.wires}
    views = []
    for channel in calibration.table.curves:
        value = live.values[channel.name]
        views.append(
            ChannelView(
                channel.name,
                live.signals.get(channel.name, value),
                units.get(channel.name, channel.unit),
                value,
                channel.unit,
                records[channel.instrument or channel.name]
                if channel.kind is Kind.SAMPLED
                else say("from force_1 and force_2"),
                _uncertainty(core, calibration, channel, live.values["force"]),
            )
        )
    for channel in calibration.table.slow:
        value, age_s = connection.rig.slow_channels.at(channel, time.monotonic())
        words = say("reported by {}", channel.device)
        views.append(
            ChannelView(
                channel.name, value, channel.signal_unit, value, channel.unit, words, age_s=age_s
            )
        )
    angle = connection.rig.processor.motion.angle_deg(live.host_s)
    shown = angle if angle is not None else math.nan
    views.append(ChannelView("crank_angle", live.count, "count", shown, "deg", "encoder"))
    # Channels without a value are omitted, as older viewers expect a number.
    return tuple(view for view in views if math.isfinite(view.value) and math.isfinite(view.raw))


def _uncertainty(
    core: Core, calibration: Calibration, channel: Channel, force: float
) -> float | None:
    """Return the expanded uncertainty of a channel's value, None unless stated."""
    if channel.instrument == LOAD_CELL:
        return uncertainty_of_force(core, force)
    if channel.instrument != PROBES:
        return calibration.scalars[channel.name].uncertainty
    stated = calibration.probes.uncertainty_um
    return None if stated is None else stated[core.table.names_of(PROBES).index(channel.name)]


def uncertainty_of_force(core: Core, force: float) -> float | None:
    """Return U of a force or its component, N, without noise; None unless stated.

    force: magnitude of the total force.
    """
    result = stated_uncertainty("", core.rig.record.load_cell.uncertainty_N)
    return None if result is None else float(result.at(force))
