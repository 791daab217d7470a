"""Resuming an interrupted test: differences between its file and the present rig.

``read_past`` reads the file, ``compare`` evaluates it (pure), ``remarks`` returns the log entries.
A device of another kind, another encoder, a simulated device in place of a real one, or an expired
calibration prevent resuming; another calibration, or a change of the zero or of signals at rest by
more than ``ZERO_SHARE`` of the full scale, needs a reason, which is recorded; smaller differences
are noted. Signals at rest are compared only if the crank is known to be at the same angle, since
the forces of spring and weight on the pin depend on it.
"""

from __future__ import annotations

import enum
import math
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from rigapp.checks.start import record_advice
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_rig
from rigapp.config.rig import DeviceSection, RigFile
from rigapp.engine.recording.store import calibration_record, missing_channels
from rigapp.engine.values.calibrate import Calibration
from rigapp.schema.channels import ChannelTable, Kind
from rigapp.schema.loglines import (
    LogEntry,
    RestSignals,
    SpecimenWear,
    rest_signals,
    specimen_wear,
)
from rigapp.schema.states import Refused, refuse_long
from rigapp.storage import TestReader, newest_known, open_test, plausible_until, rows_up_to
from rigapp.texts import joined, say
from rigapp.twin.measureddepth import FIRST_STEADY, NEW_REVOLUTIONS

ZERO_SHARE = 0.02
"""Change of the zero, as a share of the load cell's full scale, above which a reason is needed."""

SAME_ANGLE_DEG = 5.0
"""Tolerance of the angle: a spring of 525 N/m on a crank of 76 mm changes by 3.5 N within it."""

FITTED_DEPTHS = 50
"""Number of newest depths of the twin that are used; it may not have predicted the last rows."""

RELATIVE_TOLERANCE, ABSOLUTE_TOLERANCE = 1e-9, 1e-15
"""Relative and absolute difference of numbers in two records that is due to rounding."""

NOT_COMPARED = ("record", "tare_mV_per_V", "tare_crank_angle_deg", "frame", "sign")

VARYING_READINGS = ("status", "supply_V", "logic_V", "temperature_C")
"""Readings of a device that vary."""

Pair = tuple[float, float]


class Fit(enum.StrEnum):
    """Consequence of a comparison for resuming the test."""

    GOOD = "good"
    NOTED = "noted"
    REASON = "needs a reason"
    BLOCKS = "blocks"


class Compared(msgspec.Struct, frozen=True):
    """One comparison: subject, before, now, consequence."""

    what: str
    before: str
    now: str
    fit: Fit = Fit.GOOD
    sentence: str = ""


class Resumption(msgspec.Struct, frozen=True):
    """All findings for the operator before a test is resumed. Times: UTC seconds."""

    file: str
    title: str
    status: str
    reason: str
    revolutions: int
    last_revolution: int
    planned: int
    last_at: float
    gap_s: float
    findings: tuple[Compared, ...] = ()

    @property
    def blocked(self) -> str:
        """Return why the test cannot be resumed on this rig, empty when it can."""
        return joined(
            "; ", (finding.sentence for finding in self.findings if finding.fit is Fit.BLOCKS)
        )

    @property
    def asks_reason(self) -> str:
        """Return the findings that need a reason, empty without any."""
        return joined(
            "; ", (finding.sentence for finding in self.findings if finding.fit is Fit.REASON)
        )


@dataclass(frozen=True, slots=True, eq=False)
class Past:
    """The state of a test in its file. rest: the load cell's signals before its start, mV/V.

    worn: wear of its specimen at the last row; None when unknown.
    new_position_um: of the pin in the new bushing.
    """

    path: Path
    summary: Mapping[str, Any]
    title: str
    planned: int
    last_at: float
    calibration: Mapping[str, Any]
    rig: RigFile | None
    channels: ChannelTable
    rest: RestSignals | None
    new_position_um: Pair | None
    worn: SpecimenWear | None


def read_past(path: Path) -> Past:
    """Read the data of a file needed to resume its test; raises UnusableInput.

    A complete test and one written by another process are refused, before a device is opened.
    """
    with open_test(path) as reader:
        status = reader.summary()["status"]
        if status == "complete":
            raise UnusableInput(
                "{}: the test is complete with {} revolutions; begin a new test",
                path,
                reader.committed(),
            )
        if status == "running":
            raise UnusableInput("{}: this test is running; stop it first", path)
        rows = reader.committed()
        if reader.has_all_revolutions():
            raise UnusableInput(
                (
                    "{}: the test was {} with all its {} revolutions; no revolution is left to"
                    " do. Begin a new test"
                ),
                path,
                status,
                rows,
            )
        try:
            rig = parse_rig(reader.configuration()["rig"], say("{} (its rig)", path), recorded=True)
        except (KeyError, UnusableInput):
            rig = None
        rests = [signals for signals in map(rest_signals, reader.events()) if signals is not None]
        new = _new_position(reader)
        return Past(
            path=path,
            summary=reader.summary(),
            title=str(reader.metadata()["title"]),
            planned=reader.state("planned_revolutions"),
            last_at=float(reader.column("host_time", rows - 1)[0]) if rows else 0.0,
            calibration=reader.calibration(),
            rig=rig,
            channels=reader.plan.table,
            rest=rests[0] if rests else None,
            new_position_um=new,
            worn=wear_of(reader),
        )


def _new_position(reader: Any) -> Pair | None:
    stop = FIRST_STEADY + NEW_REVOLUTIONS
    number = reader.column("revolution", 0, stop)
    rows = (number >= FIRST_STEADY) & (number < stop)
    if rows.sum() < NEW_REVOLUTIONS:
        return None
    first, second = (reader.column(f"probe_{n}_mean", 0, stop)[rows].mean() for n in (1, 2))
    return float(first), float(second)


def wear_of(reader: TestReader) -> SpecimenWear | None:
    """Return the wear of the specimen at a test's last row: a line through the newest depths.

    If the newest depths are not plausible, the last plausible one; without any, that of the test's
    start.
    """
    worn: SpecimenWear | None = None
    for event in reader.events():
        worn = specimen_wear(event) or worn
    rows, until = reader.committed(), plausible_until(reader)
    names = ("revolution", "measured_wear_depth", "measured_wear_depth_uncertainty")
    stop = None if until is None else rows_up_to(reader, until, "prediction")
    table = newest_known(reader, names, FITTED_DEPTHS, stop)
    number, depth, uncertainty = (table[name].astype(float) for name in names)
    if not (rows and number.size):
        return worn
    last = int(reader.column("revolution", rows - 1)[0]) if until is None else until
    line = np.polyfit(number - last, 1e3 * depth, 1 if number.size > 2 else 0)
    return SpecimenWear(str(reader.path), last, float(line[-1]), 1e3 * float(uncertainty[-1]))


def compare(
    past: Past,
    rig: RigFile,
    calibration: Calibration,
    devices: Mapping[str, Mapping[str, Any]],
    rest: RestSignals | None,
    blocking: Mapping[str, str],
    now: float | None = None,
) -> Resumption:
    """Evaluate whether a test can be resumed on this rig.

    rig: present rig file, with the numbers of its records. calibration, devices, rest: of the
    connection. blocking: reasons why calibration records prevent a start.
    """
    moment = time.time() if now is None else now
    findings = [
        *_of_rig(past, rig),
        *_of_channels(past, calibration.table),
        *_of_devices(past, devices),
        *_of_calibration(past, calibration),
        *_of_zero(past, rig, calibration, rest),
        *(
            Compared("Record", "", text, Fit.BLOCKS, say("{}. {}", text, record_advice(name)))
            for name, text in blocking.items()
        ),
    ]
    summary = past.summary
    return Resumption(
        file=str(past.path),
        title=past.title,
        status=summary["status"],
        reason=summary["reason"] or "",
        revolutions=summary["revolutions"],
        last_revolution=summary["last_revolution"] or 0,
        planned=past.planned,
        last_at=past.last_at,
        gap_s=max(0.0, moment - past.last_at) if past.last_at else 0.0,
        findings=tuple(findings),
    )


def _of_rig(past: Past, rig: RigFile) -> Iterator[Compared]:
    if past.rig is None:
        text = say("the file's own rig cannot be read; the devices are not compared")
        yield Compared("Rig", say("not readable"), rig.name, Fit.NOTED, text)
        return
    same = past.rig.name == rig.name
    yield Compared("Rig", past.rig.name, rig.name, Fit.GOOD if same else Fit.NOTED)
    for role, what in (("encoder", say("Data acquisition")), ("spindle", "Drive")):
        then, device = (file.devices[getattr(file, role).device] for file in (past.rig, rig))
        yield from _of_kind(what, then, device, Fit.BLOCKS)
        if then.driver == device.driver:
            yield Compared(what, then.driver, device.driver)
        else:
            text = say(
                "the test was made with a {}, this rig has a {}: use the rig of the test",
                then.driver,
                device.driver,
            )
            yield Compared(what, then.driver, device.driver, Fit.BLOCKS, text)
    instruments = {rig.encoder.device, rig.spindle.device}
    for name, device in rig.devices.items():
        if name in past.rig.devices and name not in instruments:
            yield from _of_kind(name, past.rig.devices[name], device, Fit.REASON)


def _of_kind(
    what: str, then: DeviceSection, now: DeviceSection, otherwise: Fit
) -> Iterator[Compared]:
    """Compare whether a device is simulated, since measured and simulated values must not mix."""
    was, is_now = ("simulated" if device.simulated else "real" for device in (then, now))
    if was != is_now:
        text = say("{}: {} in the test, {} in this rig", what, was, is_now)
        yield Compared(say("Kind of device"), was, is_now, otherwise, text)


def _of_channels(past: Past, measured: ChannelTable) -> Iterator[Compared]:
    missing = missing_channels(past.channels, measured)
    if missing:
        yield Compared("Channels", "", "", Fit.BLOCKS, missing)
    for channel in measured.channels:
        if channel.name not in past.channels:
            text = say(
                "the file was made without {}; it is limited and shown, but not kept", channel.name
            )
            yield Compared(say("Channel {}", channel.name), "none", channel.unit, Fit.NOTED, text)


def _of_devices(past: Past, devices: Mapping[str, Mapping[str, Any]]) -> Iterator[Compared]:
    for name, readback in devices.items():
        then = past.calibration.get(f"device_{name}", {})
        yield from _of_identity(name, then, readback)
        changed = [
            key
            for key, value in readback.items()
            if key in then and key != _NUMBER and not _steady_equal(key, then[key], value)
        ]
        if changed:
            before, now = (
                joined(", ", (say("{} {}", key, record[key]) for key in changed))
                for record in (then, readback)
            )
            text = say("{} is set differently from before: {}", name, joined(", ", changed))
            yield Compared(say("Settings of {}", name), before, now, Fit.NOTED, text)


_NUMBER = "device_serial_number"


def _of_identity(
    name: str, then: Mapping[str, Any], readback: Mapping[str, Any]
) -> Iterator[Compared]:
    before, now = (str(record.get(_NUMBER, "")) for record in (then, readback))
    if before and now and before != now:
        text = say("{} is another device: serial number {}, before {}", name, now, before)
        yield Compared(say("Device {}", name), before, now, Fit.REASON, text)


def _steady_equal(key: str, before: Any, now: Any) -> bool:
    return any(word in key for word in VARYING_READINGS) or _equal(before, now)


def _same(before: Any, now: Any) -> bool:
    """Compare values that another version may not have written; missing ones count as zeros."""
    if before is not None and now is not None:
        return _equal(before, now)
    try:
        return not np.any(np.asarray(now if before is None else before, np.float64))
    except (TypeError, ValueError):
        return False


def _equal(before: Any, now: Any) -> bool:
    """Compare texts exactly, numbers and lists of numbers within rounding, tables by key."""
    if isinstance(now, Mapping) and isinstance(before, Mapping):
        return before.keys() == now.keys() and all(_equal(before[k], now[k]) for k in now)
    try:
        first, second = np.asarray(before, np.float64), np.asarray(now, np.float64)
    except (TypeError, ValueError):
        return str(before) == str(now)
    return first.shape == second.shape and bool(
        np.allclose(first, second, rtol=RELATIVE_TOLERANCE, atol=ABSOLUTE_TOLERANCE)
    )


def _of_calibration(past: Past, calibration: Calibration) -> Iterator[Compared]:
    present = calibration_record(calibration)
    for section, what, fit in (
        ("encoder", "Encoder", Fit.BLOCKS),
        ("load_cell", say("Calibration of the load cell"), Fit.REASON),
        ("probes", say("Calibration of the probes"), Fit.REASON),
        *(
            (f"channel_{channel.name}", say("Line of {}", channel.name), Fit.REASON)
            for channel in calibration.table.free
            if channel.kind is Kind.SAMPLED and channel.name in past.channels
        ),
    ):
        then = past.calibration.get(section, {})
        now = present[section]
        keys = [key for key in {**then, **now} if key not in NOT_COMPARED]
        changed = [key for key in keys if not _same(then.get(key), now.get(key))]
        names = [str(record.get("record", "")) for record in (then, now)]
        if section != "encoder" and names[0] != names[1]:
            changed = changed or ["record"]
        if not changed:
            name = names[1] or say("numbers of the rig file")
            yield Compared(what, name, name, Fit.GOOD, say("as before"))
            continue
        old, new = (
            str(joined(", ", (say("{} {}", key, record.get(key, "none")) for key in changed)))
            for record in (then, now)
        )
        text = say("{} is not that of the test ({})", what.lower(), joined(", ", changed))
        yield Compared(what, old, new, fit, text)
    was, is_now = (record.get("acquisition", {}) for record in (past.calibration, present))
    old, new = (str(record.get("clock", "time")) for record in (was, is_now))
    if old != new:
        text = say("the test was sampled by {}, this rig samples by {}", old, new)
        yield Compared(say("Sample clock"), old, new, Fit.BLOCKS, text)
    old, new = (f"{record.get('sample_rate_Hz', 0.0):g} Hz" for record in (was, is_now))
    if old != new:
        yield Compared(say("Sample rate"), old, new, Fit.NOTED)


def _of_zero(
    past: Past, rig: RigFile, calibration: Calibration, rest: RestSignals | None
) -> Iterator[Compared]:
    cell = past.calibration.get("load_cell", {})
    limit = ZERO_SHARE * rig.load_cell.full_scale_N

    def compared(what: str, before: Any, now: Any, words: str) -> Compared:
        shift = calibration.load_cell.matrix @ (np.asarray(now) - np.asarray(before))
        size = float(np.hypot(*shift))
        old, new = (
            joined(", ", (f"{value:.5f}" for value in signals)) + " mV/V"
            for signals in (before, now)
        )
        if size <= limit:
            return Compared(what, old, new, Fit.GOOD, say("moved by {:.1f} N", size))
        text = say(
            "{} by {:.1f} N, more than {:g} N ({:g} % of the full scale)",
            words,
            size,
            limit,
            100 * ZERO_SHARE,
        )
        return Compared(what, old, new, Fit.REASON, text)

    if "zero_mV_per_V" in cell:
        cell_now = calibration.load_cell
        tare, angle = stored_tare(past) or ((0.0, 0.0), None)
        cell_then = replace(
            cell_now, zero=np.array(cell["zero_mV_per_V"]), tare=np.array(tare), tare_angle=angle
        )
        before, now = cell_then.at_rest, cell_now.at_rest
        yield compared(
            say("Zero of the load cell"), before, now, say("the zero of the load cell differs")
        )
    if rest is None or past.rest is None:
        text = say("the crank moves, or no samples arrive while it is stationary")
        text = text if rest is None else say("the file does not state them")
        yield Compared(say("Load cell at rest"), "", "", Fit.NOTED, say("not compared: {}", text))
        return
    where = [signals.crank_angle_deg for signals in (past.rest, rest)]
    if _same_angle(*where):
        words = say("with the crank at rest the load cell shows a force that differs")
        yield compared(say("Load cell at rest"), past.rest.pair, rest.pair, words)
        return
    old, new = (
        say("crank angle not known") if angle is None else say("crank at {:.0f} deg", angle)
        for angle in where
    )
    text = say(
        "not compared: it is not known that the crank is at the same angle, and the spring"
        " force depends on it"
    )
    yield Compared(say("Load cell at rest"), old, new, Fit.NOTED, text)


def _same_angle(before: float | None, now: float | None) -> bool:
    if before is None or now is None:
        return False
    return abs((now - before + 180.0) % 360.0 - 180.0) <= SAME_ANGLE_DEG


def stored_tare(past: Past) -> tuple[Pair, float | None] | None:
    """Return the tare of the test and its crank angle (rad), None without a tare."""
    cell = past.calibration.get("load_cell", {})
    tare, degrees = cell.get("tare_mV_per_V"), cell.get("tare_crank_angle_deg")
    if tare is None or not any(tare):
        return None
    return (float(tare[0]), float(tare[1])), None if degrees is None else math.radians(degrees)


def remarks(resumption: Resumption, operator: str, reason: str) -> list[LogEntry]:
    """Return the log entries.

    Raises Refused when the test cannot be resumed, or needs a reason and has none.
    """
    if resumption.blocked:
        raise Refused("{} cannot continue here: {}", resumption.file, resumption.blocked)
    why = reason.strip()
    refuse_long("reason", why)
    if resumption.asks_reason and not why:
        raise Refused(
            "Resuming {} needs a reason because {}. Fix it, or enter a reason (it is logged)",
            resumption.file,
            resumption.asks_reason,
        )
    who = operator or "operator"
    text = say(
        "resuming after {}; the test was {}{}",
        interval(resumption.gap_s),
        resumption.status,
        ": " + resumption.reason if resumption.reason else "",
    )
    lines = [LogEntry("resumed", text, who)]
    for finding in resumption.findings:
        if finding.fit in (Fit.NOTED, Fit.REASON):
            sentence = finding.sentence or say("{} differs", finding.what)
            if finding.fit is Fit.REASON:
                sentence = say("{}, accepted: {}", sentence, why)
            lines.append(LogEntry("resumed", sentence, who, finding.before, finding.now))
    return lines


def interval(seconds: float) -> str:
    """Return a duration as text in one unit."""
    for unit, size in (("days", 86400.0), ("h", 3600.0), ("min", 60.0)):
        if seconds >= 2 * size:
            return say("{:.1f} {}", seconds / size, unit)
    return f"{seconds:.0f} s"
