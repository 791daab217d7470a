"""What must be right before a test starts, as its files, the disk and the engine say.

``preflight`` is a pure function of what was looked at; looking is up to its callers.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from rigapp.checks.check import ATTENTION, BLOCKS, GOOD, Check
from rigapp.checks.fit import fit_checks, sampling_check
from rigapp.config.channels import channel_table
from rigapp.config.loading import RigRecords
from rigapp.config.recipe import TestFile
from rigapp.config.rig import RigFile
from rigapp.config.rules import described
from rigapp.config.sequence import Sequence
from rigapp.presentation.numbers import grouped
from rigapp.presentation.states import calibration_text
from rigapp.schema.channels import BASE
from rigapp.schema.messages import DeviceView, RunState, Severity, Status
from rigapp.texts import Sentence, joined, say

STALE_S = 2.0  # devices send ten times a second or more
NEAR_THE_END = 0.95
"""Share of an input's range beyond which a signal counts as at its end."""


@dataclass(frozen=True, slots=True)
class DiskFacts:
    """How much room a test needs and has; problem: one sentence when it cannot be found out."""

    folder: Path
    needed_bytes: int
    free_bytes: int
    problem: str = ""


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
    result = [*_of_test(test, rig), *disk_checks(disk)]
    if records is not None:
        result += record_checks(records)
    if status is None:
        result.append(
            Check(say("Engine"), BLOCKS, say("not reachable"), say("Wait, or start rigapp again"))
        )
        return result
    result += [*_of_engine(status), *drive_checks(status), *_of_channels(status, rig)]
    if test is not None:
        result += _of_rate(test, status)
    if records is None:
        result += _of_calibrations(status)
    return result


def _of_test(test: TestFile | None, rig: RigFile | None) -> Iterator[Check]:
    if test is None:
        yield Check(
            say("Test"), BLOCKS, say("not usable yet"), say("See the sentence above the form")
        )
        return
    run, sequence = test.run, Sequence(test.run)
    hours = sequence.seconds(1, run.revolutions) / 3600.0
    count = grouped(run.revolutions)
    low, high = sequence.slowest_rpm, sequence.fastest_rpm
    text = say("{} revolutions at {:g} rpm, {:.3g} h", count, high, hours)
    if low < high:
        text = say("{} revolutions at {:g} to {:g} rpm, {:.3g} h", count, low, high, hours)
    yield Check(say("Test"), GOOD, text)
    yield from _of_steps(sequence, run.revolutions)
    yield from _of_ends(test)
    if rig is not None:
        yield from fit_checks(test, rig)
    yield from _of_rules(test)
    for title, name in ((say("Operator"), "operator"), (say("Specimen"), "specimen")):
        if not getattr(test.metadata, name):
            yield Check(
                title,
                ATTENTION,
                say("not named"),
                say("Write metadata.{}, so that the file states it", name),
            )


def _of_steps(sequence: Sequence, planned: int) -> Iterator[Check]:
    if not sequence.count:
        return
    once = sequence.length
    text = say("{} steps, {} revolutions", sequence.count, once)
    if planned < once:
        action = say("The test ends in step {}; raise run.revolutions", sequence.at(planned).step)
        yield Check(say("Sequence"), ATTENTION, say("{}, {} are planned", text, planned), action)
    elif planned > once:
        yield Check(say("Sequence"), GOOD, say("{}, then again from step {}", text, sequence.again))
    else:
        yield Check(say("Sequence"), GOOD, text)


def _of_ends(test: TestFile) -> Iterator[Check]:
    criteria = described(test.stop)
    if criteria:
        yield Check(say("Ends early"), GOOD, say("at the first of: ") + joined(", ", criteria))


def _of_rules(test: TestFile) -> Iterator[Check]:
    rules = len(test.limits.rule)
    yield Check(
        say("Limits"),
        GOOD if rules else ATTENTION,
        say("{} of this test, in addition to overload, overspeed and stale data", rules),
        "" if rules else say("Add a limit that warns when the joint changes"),
    )


def disk_checks(disk: DiskFacts | None) -> Iterator[Check]:
    """Check the disk space for the file; no result before it was measured."""
    if disk is None:
        return
    if disk.problem:
        yield Check(
            say("Disk"), BLOCKS, disk.problem, say("Choose a folder that can be written to")
        )
        return
    from rigapp.storage import SPACE_MARGIN

    text = say(
        "{:.0f} MB needed, {:.1f} GB free",
        disk.needed_bytes / 1000000.0,
        disk.free_bytes / 1000000000.0,
    )
    missing = disk.needed_bytes + SPACE_MARGIN - disk.free_bytes
    yield Check(
        say("Disk"),
        BLOCKS if missing > 0 else GOOD,
        say("{} in {}", text, disk.folder),
        say("Free {:.0f} MB or store fewer cycles", missing / 1000000.0) if missing > 0 else "",
    )


def record_checks(records: RigRecords) -> Iterator[Check]:
    """Check the calibration of each part: by a record, or by the rig file alone."""
    for name, why in records.blocking.items():
        yield Check(say("Calibration of {}", _words(name)), BLOCKS, why, record_advice(name))
    for name, text in records.remarks.items():
        if name not in records.blocking:
            yield Check(say("Calibration of {}", _words(name)), ATTENTION, text)
    known = {*records.blocking, *records.remarks}
    for name in records.texts:
        if name not in known:
            yield Check(say("Calibration of {}", _words(name)), GOOD, say("a record that is valid"))
    recorded = {*known, *records.texts}
    for name, section in (("load_cell", "load_cell"), ("probes", "probe")):
        if not any(section_name.startswith(section) for section_name in recorded):
            yield Check(
                say("Calibration of {}", _words(name)),
                ATTENTION,
                say("no record: the numbers of the rig file count"),
                say("Calibrate for a known uncertainty"),
            )


def record_advice(name: str) -> Sentence:
    """Return what to do where a record forbids a start. name: the label of the record."""
    key = "run_out_override" if name == "run_out" else "calibration_override"
    return say("Calibrate again, or give a reason in {} of the rig file", key)


def _words(section: str) -> Sentence:
    """Return the name of a section as a sentence: the catalogues have it."""
    return Sentence(section.replace("_", " "))


def _of_engine(status: Status) -> Iterator[Check]:
    state = status.engine.state
    if state in (RunState.READY, RunState.STOPPED):
        yield Check(say("State"), GOOD, say("{}", state))
    elif state is RunState.CALIBRATING:
        action = say("Close that calibration, or end it: rigapp calibrate release")
        yield Check(say("State"), BLOCKS, say("calibrating: {}", calibration_text(status)), action)
    elif state is RunState.IDLE:
        yield Check(
            say("State"), ATTENTION, say("not connected"), say("Connect (F4); Start does it too")
        )
    else:
        yield Check(say("State"), BLOCKS, say("{}", state), say("Wait until no test is running"))
    for device in status.rig.devices:
        yield _of_device(device)
    critical = [a for a in status.alarms if a.severity is Severity.CRITICAL]
    others = [a for a in status.alarms if a.severity is not Severity.CRITICAL]
    if critical:
        yield Check(say("Alarms"), BLOCKS, critical[0].title, critical[0].action)
    elif others:
        yield Check(say("Alarms"), ATTENTION, others[0].title, others[0].action)
    else:
        yield Check(say("Alarms"), GOOD, say("none"))


def _of_device(device: DeviceView) -> Check:
    what = say("Device {}", device.name)
    if device.connected:
        who = joined(
            "; ", (text for text in (device.identity or device.driver, device.wiring) if text)
        )
        verdict = ATTENTION if device.advice else GOOD
        return Check(what, verdict, who, device.advice)
    port, why = device.port, device.last_error.rstrip(". ") or say("not connected")
    if not device.needed:
        action = say("Check cable and power of {}, or continue without its channels", port)
        return Check(what, ATTENTION, why, action)
    return Check(what, BLOCKS, why, say("Check cable and power of {}, reconnect", port))


def drive_checks(status: Status) -> Iterator[Check]:
    """Check emergency stop, faults and warnings of the drive; no result while unknown."""
    drive = status.rig.drive
    if drive is None:
        return
    if drive.emergency_stop:
        yield Check(say("Emergency stop"), BLOCKS, say("pressed"), say("Release it at the rig"))
    else:
        yield Check(say("Emergency stop"), GOOD, say("not pressed"))
    if drive.faults:
        yield Check(say("Drive"), BLOCKS, joined(", ", drive.faults), say("Reset the drive"))
    elif drive.warnings:
        yield Check(
            say("Drive"), ATTENTION, joined(", ", drive.warnings), say("See the drive's manual")
        )
    else:
        # A drive need not tell every one of them.
        supply = f"{drive.supply_V:.1f} V" if drive.supply_V is not None else ""
        heat = f"{drive.temperature_C:.0f} °C" if drive.temperature_C is not None else ""
        text = joined(", ", filter(None, (supply, heat)))
        yield Check(say("Drive"), GOOD, text or say("no fault"))


def _of_channels(status: Status, rig: RigFile | None) -> Iterator[Check]:
    if not status.rig.channels:
        return
    if status.rig.data_age_s is None or status.rig.data_age_s > STALE_S:
        yield Check(
            say("Samples"), BLOCKS, say("none received"), say("Check the device, reconnect")
        )
    else:
        yield Check(say("Samples"), GOOD, say("{:.1f} s old", status.rig.data_age_s))
    table = channel_table(rig) if rig is not None else BASE
    ranges = {channel.name: channel for channel in table.sampled}
    for channel in status.rig.channels:
        known = ranges.get(channel.name)
        # Without the rig file no range is known (0): its end cannot be near.
        if known and 0.0 < NEAR_THE_END * known.signal_range < abs(channel.raw):
            yield Check(
                say("Channel {}", channel.name),
                BLOCKS if known.instrument else ATTENTION,
                say("{:.3g} {} is at the end of the range", channel.raw, channel.raw_unit),
                say("Check sensor and wiring, or adjust the probe"),
            )
    shown = {channel.name for channel in status.rig.channels}
    for silent in (channel for channel in table.slow if channel.name not in shown):
        yield Check(
            say("Channel {}", silent.name),
            ATTENTION,
            say("no value from {}", silent.device),
            say("Check the device that sends it, or continue without it"),
        )


def _of_rate(test: TestFile, status: Status) -> Iterator[Check]:
    rate = max((device.sample_rate_Hz for device in status.rig.devices), default=0.0)
    if rate <= 0.0:
        return
    sequence = Sequence(test.run)
    yield sampling_check(rate * 60.0 / sequence.fastest_rpm, rate, sequence)


def _of_calibrations(status: Status) -> Iterator[Check]:
    plain = [c.name for c in status.rig.channels if c.calibration == "rig file"]
    if plain:
        yield Check(
            say("Calibration"),
            ATTENTION,
            say("no record for {}: the numbers of the rig file count", joined(", ", plain)),
            say("Calibrate for a known uncertainty"),
        )
    elif status.rig.channels:
        yield Check(say("Calibration"), GOOD, say("a record for each channel"))
