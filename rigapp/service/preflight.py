"""What must be right before a test starts: one list for `rigapp check` and for the window.

``preflight`` is a pure function of what was looked at; looking is up to its callers.
"""

from __future__ import annotations

import enum
import os
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from rigapp.calibrating.records_in_use import RigRecords
from rigapp.config.channels import channel_table
from rigapp.config.recipe import TestFile
from rigapp.config.rig import RigFile
from rigapp.config.sequence import Sequence
from rigapp.engine.judging.criteria import described
from rigapp.engine.judging.reach import FEWEST_SAMPLES, load_cell_reach_N
from rigapp.presentation.numbers import grouped
from rigapp.presentation.states import calibration_text
from rigapp.schema.channels import BASE, ChannelTable
from rigapp.schema.messages import DeviceView, RunState, Severity, Status

FEW_SAMPLES = 60
"""With fewer samples a revolution, extremes are missed."""

STALE_S = 2.0  # devices send ten times a second or more
NEAR_THE_END = 0.95
"""Share of an input's range beyond which a signal counts as at its end."""


class Checked(enum.StrEnum):
    """Tell whether a check lets a test start."""

    GOOD = "good"
    ATTENTION = "attention"
    BLOCKS = "blocks"


GOOD, ATTENTION, BLOCKS = Checked


@dataclass(frozen=True, slots=True)
class Check:
    """One line of the list: what, how it stands, what to do."""

    what: str
    verdict: Checked
    finding: str
    action: str = ""


@dataclass(frozen=True, slots=True)
class DiskFacts:
    """How much room a test needs and has; problem: one sentence when it cannot be found out."""

    folder: Path
    needed_bytes: int
    free_bytes: int
    problem: str = ""


def disk_facts(
    test: TestFile, sample_rate_Hz: float, folder: Path, table: ChannelTable = BASE
) -> DiskFacts:
    """Return the room that a test of these channels needs in a folder; reads the disk."""
    from rigapp.engine.recording.fileplan import file_plan
    from rigapp.storage import reserved_bytes, streams_of

    needed = reserved_bytes(streams_of(file_plan(test, sample_rate_Hz, table=table)).values())
    try:
        if not os.access(folder, os.W_OK | os.X_OK):
            return DiskFacts(folder, needed, 0, f"{folder} does not exist or cannot be written to")
        free = shutil.disk_usage(folder).free
    except OSError as error:
        return DiskFacts(
            folder,
            needed,
            0,
            f"{folder}: cannot be used ({error.strerror}) ‹{error}›",
        )
    return DiskFacts(folder, needed, free)


def preflight(
    test: TestFile | None,
    records: RigRecords | None,
    disk: DiskFacts | None,
    status: Status | None,
) -> list[Check]:
    """Return every check, in the order in which an operator would go through them.

    test: None while it is not usable. records: the rig with its calibration records, None where the
    rig file is not known here. disk: None while it is not looked at yet. status: the engine's, None
    when it cannot be reached.
    """
    rig = records.rig.record if records is not None else None
    found = [*_of_test(test, rig), *_of_disk(disk)]
    if records is not None:
        found += _of_records(records)
    if status is None:
        found.append(Check("Engine", BLOCKS, "not reachable", "Wait, or start rigapp again"))
        return found
    found += [*_of_engine(status), *_of_drive(status), *_of_channels(status, rig)]
    if test is not None:
        found += _of_rate(test, status)
    if records is None:
        found += _of_calibrations(status)
    return found


def blocked(checks: list[Check]) -> bool:
    """Tell whether any check forbids a start."""
    return any(check.verdict is BLOCKS for check in checks)


def _of_test(test: TestFile | None, rig: RigFile | None) -> Iterator[Check]:
    if test is None:
        yield Check("Test", BLOCKS, "not usable yet", "See the sentence above the form")
        return
    run, sequence = test.run, Sequence(test.run)
    hours = sequence.seconds(1, run.revolutions) / 3600.0
    count = grouped(run.revolutions)
    low, high = sequence.slowest_rpm, sequence.fastest_rpm
    text = f"{count} revolutions at {high:g} rpm, {hours:.3g} h"
    if low < high:
        text = f"{count} revolutions at {low:g} to {high:g} rpm, {hours:.3g} h"
    yield Check("Test", GOOD, text)
    yield from _of_steps(sequence, run.revolutions)
    yield from _of_ends(test)
    if rig is not None:
        yield from _of_rig_limits(test, rig)
    yield from _of_rules(test)
    for name in ("operator", "specimen"):
        if not getattr(test.metadata, name):
            yield Check(
                name.capitalize(),
                ATTENTION,
                "not named",
                f"Write metadata.{name}, so that the file tells",
            )


def _of_steps(sequence: Sequence, planned: int) -> Iterator[Check]:
    if not sequence.count:
        return
    once = sequence.length
    text = f"{sequence.count} steps, {once} revolutions"
    if planned < once:
        action = f"The test ends in step {sequence.at(planned).step}; raise run.revolutions"
        yield Check("Sequence", ATTENTION, f"{text}, {planned} are planned", action)
    elif planned > once:
        yield Check("Sequence", GOOD, f"{text}, then again from step {sequence.again}")
    else:
        yield Check("Sequence", GOOD, text)


def _of_ends(test: TestFile) -> Iterator[Check]:
    criteria = described(test.stop)
    if criteria:
        yield Check("Ends early", GOOD, "at the first of: " + ", ".join(criteria))


def _of_rig_limits(test: TestFile, rig: RigFile) -> Iterator[Check]:
    sequence, fastest = Sequence(test.run), rig.spindle.maximum_speed_rpm
    speed = sequence.fastest_rpm
    if speed > fastest:
        text = f"{speed:g} rpm, the rig allows {fastest:g} rpm"
        yield Check("Speed", BLOCKS, text, f"Lower the speed: {sequence.fastest_key}")
    else:
        yield Check("Speed", GOOD, f"{speed:g} rpm of {fastest:g} rpm that the rig allows")
    overload, full = test.limits.overload_N, rig.load_cell.full_scale_N
    text = f"drive off above {overload:g} N, full scale of the cell {full:g} N"
    (a, b), (c, d) = rig.load_cell.matrix_N_per_mV_per_V
    if a * d == b * c:
        action = "Calibrate the cell, or correct load_cell.matrix_N_per_mV_per_V"
        yield Check("Load cell", BLOCKS, "its matrix cannot be inverted", action)
    elif overload > load_cell_reach_N(rig):
        text = f"{overload:g} N can never be seen: the inputs are full before"
        yield Check("Overload", BLOCKS, text, "Lower limits.overload_N")
    elif overload > full:
        action = "Lower limits.overload_N to what the cell may carry"
        yield Check("Overload", ATTENTION, text, action)
    else:
        yield Check("Overload", GOOD, text)


def _of_rules(test: TestFile) -> Iterator[Check]:
    rules = len(test.limits.rule)
    yield Check(
        "Limits",
        GOOD if rules else ATTENTION,
        f"{rules} of this test, beside overload, overspeed and stale data",
        "" if rules else "Add a limit that tells when the joint has changed",
    )


def _of_disk(disk: DiskFacts | None) -> Iterator[Check]:
    if disk is None:
        return
    if disk.problem:
        yield Check("Disk", BLOCKS, disk.problem, "Choose a folder that can be written to")
        return
    from rigapp.storage import SPACE_MARGIN

    text = f"{disk.needed_bytes / 1e6:.0f} MB needed, {disk.free_bytes / 1e9:.1f} GB free"
    missing = disk.needed_bytes + SPACE_MARGIN - disk.free_bytes
    yield Check(
        "Disk",
        BLOCKS if missing > 0 else GOOD,
        f"{text} in {disk.folder}",
        f"Free {missing / 1e6:.0f} MB or keep fewer whole cycles" if missing > 0 else "",
    )


def _of_records(records: RigRecords) -> Iterator[Check]:
    """Judge the calibration of each part: by a record, or by the rig file alone."""
    for name, why in records.blocking.items():
        action = "Calibrate, or give a reason in calibration_override of the rig file"
        yield Check(f"Calibration of {_words(name)}", BLOCKS, why, action)
    for name, text in records.remarks.items():
        if name not in records.blocking:
            yield Check(f"Calibration of {_words(name)}", ATTENTION, text)
    known = {*records.blocking, *records.remarks}
    for name in records.texts:
        if name not in known:
            yield Check(f"Calibration of {_words(name)}", GOOD, "a record that is valid")
    recorded = {*known, *records.texts}
    for name, section in (("load_cell", "load_cell"), ("probes", "probe")):
        if not any(one.startswith(section) for one in recorded):
            yield Check(
                f"Calibration of {_words(name)}",
                ATTENTION,
                "no record: the numbers of the rig file count",
                "Calibrate for a known uncertainty",
            )


def _words(section: str) -> str:
    return section.replace("_", " ")


def _of_engine(status: Status) -> Iterator[Check]:
    state = status.state
    if state in (RunState.READY, RunState.STOPPED):
        yield Check("State", GOOD, state.value)
    elif state is RunState.CALIBRATING:
        action = "Close that calibration, or end it: rigapp calibrate release"
        yield Check("State", BLOCKS, f"calibrating: {calibration_text(status)}", action)
    elif state is RunState.IDLE:
        yield Check("State", ATTENTION, "not connected", "Connect (F4); Start does it too")
    else:
        yield Check("State", BLOCKS, state.value, "Wait until no test is under way")
    for device in status.devices:
        yield _of_device(device)
    critical = [a for a in status.alarms if a.severity is Severity.CRITICAL]
    others = [a for a in status.alarms if a.severity is not Severity.CRITICAL]
    if critical:
        yield Check("Alarms", BLOCKS, critical[0].title, critical[0].action)
    elif others:
        yield Check("Alarms", ATTENTION, others[0].title, others[0].action)
    else:
        yield Check("Alarms", GOOD, "none")


def _of_device(device: DeviceView) -> Check:
    what = f"Device {device.name}"
    if device.connected:
        who = "; ".join(text for text in (device.identity or device.driver, device.wiring) if text)
        verdict = ATTENTION if device.advice else GOOD
        return Check(what, verdict, who, device.advice)
    port, why = device.port, device.last_error.rstrip(". ") or "not connected"
    if not device.needed:
        action = f"Check cable and power of {port}, or go on without its channels"
        return Check(what, ATTENTION, why, action)
    return Check(what, BLOCKS, why, f"Check cable and power of {port}, reconnect")


def _of_drive(status: Status) -> Iterator[Check]:
    drive = status.drive
    if drive is None:
        return
    if drive.emergency_stop:
        yield Check("Emergency stop", BLOCKS, "pressed", "Release it at the rig")
    else:
        yield Check("Emergency stop", GOOD, "not pressed")
    if drive.faults:
        yield Check("Drive", BLOCKS, ", ".join(drive.faults), "Reset the drive")
    elif drive.warnings:
        yield Check("Drive", ATTENTION, ", ".join(drive.warnings), "See the drive's manual")
    else:
        # A drive need not tell every one of them.
        supply = f"{drive.supply_V:.1f} V" if drive.supply_V is not None else ""
        heat = f"{drive.temperature_C:.0f} °C" if drive.temperature_C is not None else ""
        text = ", ".join(filter(None, (supply, heat)))
        yield Check("Drive", GOOD, text or "no fault")


def _of_channels(status: Status, rig: RigFile | None) -> Iterator[Check]:
    if not status.channels:
        return
    if status.data_age_s is None or status.data_age_s > STALE_S:
        yield Check("Samples", BLOCKS, "none are coming", "Check the device, reconnect")
    else:
        yield Check("Samples", GOOD, f"{status.data_age_s:.1f} s old")
    table = channel_table(rig) if rig is not None else BASE
    ranges = {one.name: one for one in table.sampled}
    for channel in status.channels:
        known = ranges.get(channel.name)
        if known is not None and abs(channel.raw) > NEAR_THE_END * known.signal_range:
            yield Check(
                f"Channel {channel.name}",
                BLOCKS if known.instrument else ATTENTION,
                f"{channel.raw:.3g} {channel.raw_unit} is at the end of the range",
                "Check sensor and wiring, or adjust the probe",
            )
    shown = {channel.name for channel in status.channels}
    for silent in (one for one in table.slow if one.name not in shown):
        yield Check(
            f"Channel {silent.name}",
            ATTENTION,
            f"no value from {silent.device}",
            "Check the device that tells it, or go on without",
        )


def _of_rate(test: TestFile, status: Status) -> Iterator[Check]:
    rate = max((device.sample_rate_Hz for device in status.devices), default=0.0)
    if rate <= 0.0:
        return
    samples = rate * 60.0 / Sequence(test.run).fastest_rpm
    text = f"{samples:.0f} samples a revolution at {rate:g} Hz"
    if samples < FEWEST_SAMPLES:
        yield Check("Sample rate", BLOCKS, text, "Raise the sample rate")
    elif samples < FEW_SAMPLES:
        text += "; extremes will be missed"
        yield Check("Sample rate", ATTENTION, text, "Raise the sample rate")
    else:
        yield Check("Sample rate", GOOD, text)


def _of_calibrations(status: Status) -> Iterator[Check]:
    plain = [c.name for c in status.channels if c.calibration == "rig file"]
    if plain:
        yield Check(
            "Calibration",
            ATTENTION,
            f"no record for {', '.join(plain)}: the numbers of the rig file count",
            "Calibrate for a known uncertainty",
        )
    elif status.channels:
        yield Check("Calibration", GOOD, "a record for each channel")
