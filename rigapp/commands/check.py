"""`rigapp check`: would this test start on this rig? A table, and what blocks."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

import msgspec

from rigapp.calibrating.records_in_use import RigRecords, with_records
from rigapp.config.channels import channel_table
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, read_rig, read_test
from rigapp.config.recipe import TestFile
from rigapp.config.rig import RigFile
from rigapp.config.rules import check_rules
from rigapp.engine.devices import LoadDriver, make_devices, plan_devices
from rigapp.notify.ways import inspected, ways_of
from rigapp.schema.details import indented
from rigapp.schema.messages import Status
from rigapp.service.preflight import Check, Checked, blocked, disk_facts, preflight
from rigapp.simulation.handle import SimulationFailed
from rigapp_drivers.api import DeviceError
from rigapp_drivers.registry import load_driver

FIRST_DATA_S = 10.0  # a device that has been set sends within a block
PIPE_WIDTH = 200  # where no terminal tells its width, no line is broken
MARKS = {Checked.GOOD: "ok", Checked.ATTENTION: "note", Checked.BLOCKS: "BLOCKS"}


def check_rig(rig_path: Path, test_path: Path, *, as_json: bool = False) -> int:
    """Print the pre-flight table; status 1 when anything blocks a start."""
    checks = _all_checks(rig_path, test_path)
    if as_json:
        found = [asdict(check) for check in checks]
        print(json.dumps({"blocked": blocked(checks), "checks": found}, indent=2))
    else:
        _print_table(checks)
    return 1 if blocked(checks) else 0


def _all_checks(rig_path: Path, test_path: Path) -> list[Check]:
    records = with_records(read_rig(rig_path))
    plan_devices(records.rig.record, str(rig_path))
    test = read_test(test_path).record
    channels = channel_table(records.rig.record)
    check_rules(test.limits.rule, channels, f"{test_path}: ")
    status, found = look(records, test)
    rate = _rate(status) or _configured_rate(records.rig.record)
    disk = disk_facts(test, rate, Path.cwd(), channels) if rate else None
    checks = preflight(test, records, disk, status)
    if status is None:
        checks = [check for check in checks if check.what != "Engine"]
    return [*checks, *found, *message_checks(records.rig)]


def _print_table(checks: Sequence[Check]) -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table(show_header=False, box=None, pad_edge=False)
    for check in checks:
        text = f"{check.finding}. {check.action}" if check.action else check.finding
        text = indented(text)
        table.add_row(MARKS[check.verdict], check.what, text)
    Console(width=None if sys.stdout.isatty() else PIPE_WIDTH).print(table)


def message_checks(rig: Document[RigFile]) -> list[Check]:
    """Judge the ways to reach who is away, where any is set up; nothing is sent."""
    ways = ways_of(rig)
    if not ways:
        return []
    wrong = [Check("Messages", Checked.BLOCKS, sentence) for sentence in inspected(ways)]
    names = ", ".join([*(way.name for way in ways.ways), *(["ping"] if ways.ping else [])])
    return wrong or [
        Check("Messages", Checked.GOOD, f"set up by {names}; try: rigapp notify --test")
    ]


def look(records: RigRecords, test: TestFile) -> tuple[Status | None, list[Check]]:
    """Return how the rig stands, and what else was found or kept it from being looked at.

    The engine that runs for the rig is asked; without one, the devices are opened, their own test
    value is looked at, and they are released.
    """
    from rigapp.service.client import Client, EngineUnreachable
    from rigapp.service.launch import find_engine

    entry = find_engine(records.rig.path)
    try:
        if entry is None:
            return _look_alone(records, test)
        client = Client(entry, look=False)
        try:
            return msgspec.convert(client.request("status").result, Status).shown(), []
        finally:
            client.close()
    except DeviceError as error:
        found = f"{error.port}: {error.sentence.rstrip('.')}"
        return None, [Check(f"Device {error.device}", Checked.BLOCKS, found)]
    except (UnusableInput, SimulationFailed, EngineUnreachable) as error:
        return None, [Check("Devices", Checked.BLOCKS, str(error))]


def _look_alone(records: RigRecords, test: TestFile) -> tuple[Status, list[Check]]:
    from rigapp.engine.engine import Engine
    from rigapp.service.calibration import kept_calibration
    from rigapp.service.simulated import SimulatedDevices, parse_speed

    simulated = SimulatedDevices(records.rig, parse_speed(None, records.rig))
    try:
        ports = simulated.ports(test.model)
        checks = list(self_check(records.rig.record, ports))
        engine = Engine(records.rig, ports=ports, records=records.texts)
        try:
            engine.connect()
            deadline = time.monotonic() + FIRST_DATA_S
            while not engine.status().channels and time.monotonic() < deadline:
                time.sleep(0.05)
            kept = kept_calibration(records.rig.path)
            calibration = kept.shown if kept is not None else None
            status = msgspec.structs.replace(engine.status(), calibration=calibration)
            return status.shown(), checks
        finally:
            engine.shutdown()
    finally:
        simulated.close()


@runtime_checkable
class SelfChecking(Protocol):
    """A data source that can feed half of its range into its inputs, as the GSV-8 does."""

    def half_scale(self) -> Sequence[Any]:
        """Return one result an input: name, measured, expected, unit, right."""


def self_check(
    rig: RigFile, ports: Mapping[str, str], load: LoadDriver = load_driver
) -> Iterator[Check]:
    """Yield what the data source's test value shows, where it has one; raise what opening raises.

    The way from the amplifier to the program is checked: scales and order of the channels.
    """
    devices = make_devices(rig, ports, load)
    try:
        devices.open()
        source = devices.source
        driver = source.driver
        if not isinstance(driver, SelfChecking):
            return
        what = f"Test value of {source.name}"
        try:
            with source.calling("its test value was read"):
                results = driver.half_scale()
        except DeviceError as error:
            yield Check(what, Checked.ATTENTION, f"not possible: {error.sentence}")
            return
        wrong = [one for one in results if not one.right]
        if wrong:
            found = ", ".join(
                f"{one.name} {one.measured:.4g} {one.unit} in place of {one.expected:.4g}"
                for one in wrong
            )
            action = "Compare scales and order of the device's channels with the rig file"
            yield Check(what, Checked.BLOCKS, found, action)
        else:
            names = ", ".join(one.name for one in results)
            yield Check(what, Checked.GOOD, f"half of the range arrives on {names}")
    finally:
        devices.close()


def _rate(status: Status | None) -> float:
    devices = status.devices if status is not None else ()
    return max((device.sample_rate_Hz for device in devices), default=0.0)


def _configured_rate(rig: RigFile) -> float:
    rate = rig.devices[rig.encoder.device].settings.get("sample_rate_Hz", 0.0)
    return float(rate) if isinstance(rate, int | float) else 0.0
