"""`rigapp check`: the table of checks before a test."""

from __future__ import annotations

import json
import re
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

import msgspec

from rigapp.calibrating.records_in_use import with_records
from rigapp.checks.check import Check, CheckVerdict, blocked
from rigapp.checks.start import preflight
from rigapp.config.channels import channel_table
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, RigRecords, read_rig, read_test
from rigapp.config.recipe import TestFile
from rigapp.config.rig import RigFile
from rigapp.config.rules import check_rules
from rigapp.engine.devices import LoadDriver, make_devices, plan_devices
from rigapp.notify.channels import inspected, ways_of
from rigapp.process.awake import kept_awake
from rigapp.schema.details import indented
from rigapp.schema.messages import Status
from rigapp.service.preflight import disk_facts
from rigapp.simulation.handle import SimulationFailed
from rigapp.texts import say
from rigapp_drivers.api import DeviceError, help_of
from rigapp_drivers.registry import load_driver

FIRST_DATA_S = 10.0  # a configured device sends data within one block
PIPE_WIDTH = 200  # without a terminal, lines are not wrapped
APT_SETTINGS = Path("/etc/apt/apt.conf.d")
_RESTARTS = re.compile(r'^\s*Unattended-Upgrade::Automatic-Reboot\s+"true"', re.MULTILINE)
MARKS = {CheckVerdict.GOOD: "ok", CheckVerdict.ATTENTION: "note", CheckVerdict.BLOCKS: "BLOCKS"}


def check_rig(rig_path: Path, test_path: Path, *, as_json: bool = False) -> int:
    """Print the pre-flight table; return 1 when a check blocks the start."""
    checks = _all_checks(rig_path, test_path)
    if as_json:
        trees = [check.tree() for check in checks]
        print(json.dumps({"blocked": blocked(checks), "checks": trees}, indent=2))
    else:
        _print_table(checks)
    return 1 if blocked(checks) else 0


def _all_checks(rig_path: Path, test_path: Path) -> list[Check]:
    records = with_records(read_rig(rig_path))
    plan_devices(records.rig.record, str(rig_path))
    test = read_test(test_path).record
    channels = channel_table(records.rig.record)
    check_rules(test.limits.rule, channels, f"{test_path}: ")
    status, result = look(records, test)
    rate = _rate(status) or _configured_rate(records.rig.record)
    disk = disk_facts(test, rate, Path.cwd(), channels) if rate else None
    checks = preflight(test, records, disk, status)
    if status is None:
        checks = [check for check in checks if check.name != "Engine"]
    computer = () if records.rig.record.simulated_samples else computer_checks()
    return [*checks, *result, *message_checks(records.rig), *computer]


def _print_table(checks: Sequence[Check]) -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table(show_header=False, box=None, pad_edge=False)
    for check in checks:
        text = f"{check.sentence}. {check.advice}" if check.advice else check.sentence
        text = indented(text)
        table.add_row(MARKS[check.verdict], check.name, text)
    Console(width=None if sys.stdout.isatty() else PIPE_WIDTH).print(table)


def message_checks(rig: Document[RigFile]) -> list[Check]:
    """Check the configured notification channels without sending messages."""
    ways = ways_of(rig)
    if not ways:
        return []
    wrong = [Check("Messages", CheckVerdict.BLOCKS, sentence) for sentence in inspected(ways)]
    names = ", ".join([*(way.name for way in ways.ways), *(["ping"] if ways.ping else [])])
    return wrong or [
        Check("Messages", CheckVerdict.GOOD, f"set up by {names}; try: rigapp notify --test")
    ]


def computer_checks(settings: Path = APT_SETTINGS) -> Iterator[Check]:
    """Check whether the computer may sleep, or be restarted by updates, while a test runs."""
    kept = kept_awake()
    if not kept:
        yield Check(
            say("Sleep"),
            CheckVerdict.ATTENTION,
            say("nothing keeps this computer awake while a test runs"),
            say("Switch sleep and the lid's switch off in its settings"),
        )
    elif "lid" in kept:
        yield Check(
            say("Sleep"), CheckVerdict.GOOD, say("held off while a test runs, lid included")
        )
    else:
        yield Check(
            say("Sleep"),
            CheckVerdict.GOOD,
            say("held off while a test runs, but not the lid's switch"),
            say("Leave the lid of a laptop open"),
        )
    try:
        texts = [path.read_text("utf-8") for path in sorted(settings.glob("*"))]
    except (OSError, UnicodeDecodeError):
        return
    if any(_RESTARTS.search(text) for text in texts):
        yield Check(
            say("Updates"),
            CheckVerdict.ATTENTION,
            say("may restart this computer by themselves"),
            say("Switch Unattended-Upgrade::Automatic-Reboot off"),
        )


def look(records: RigRecords, test: TestFile) -> tuple[Status | None, list[Check]]:
    """Return the status of the rig with further checks, or a check with the reason for no status.

    The status is that of the rig's running engine; without one, the devices are opened, their test
    value is read, and they are released.
    """
    from rigapp.service.client import Client, EngineUnreachable
    from rigapp.service.launch import find_engine

    entry = find_engine(records.rig.path)
    rig = records.rig.record
    needed = (rig.encoder.device, rig.spindle.device)  # a test can run without a slow source
    try:
        if entry is None:
            return _look_alone(records, test)
        client = Client(entry, look=False)
        try:
            return Status.of_tree(client.request("status").result).shown(), []
        finally:
            client.close()
    except DeviceError as error:
        return None, [
            Check(
                f"Device {fault.device}",
                CheckVerdict.BLOCKS if fault.device in needed else CheckVerdict.ATTENTION,
                f"{fault.port}: {fault.sentence.rstrip('.')}",
                say("See troubleshooting.md#{}", help_of(fault)),
            )
            for fault in error.each
        ]
    except (UnusableInput, SimulationFailed, EngineUnreachable) as error:
        return None, [Check("Devices", CheckVerdict.BLOCKS, str(error))]


def _look_alone(records: RigRecords, test: TestFile) -> tuple[Status, list[Check]]:
    from rigapp.engine.engine import Engine
    from rigapp.service.calibration import stored_calibration
    from rigapp.service.simulated import SimulatedDevices, parse_speed

    simulated = SimulatedDevices(records.rig, parse_speed(None, records.rig))
    try:
        ports = simulated.ports(test.model)
        checks = list(self_check(records.rig.record, ports, folder=records.rig.path.parent))
        engine = Engine(records.rig, ports=ports, records=records.texts)
        try:
            engine.connect()
            deadline = time.monotonic() + FIRST_DATA_S
            while not engine.status().rig.channels and time.monotonic() < deadline:
                time.sleep(0.05)
            kept = stored_calibration(records.rig.path)
            calibration = kept.shown if kept is not None else None
            status = engine.status()
            occupied = msgspec.structs.replace(status.engine, calibration=calibration)
            return msgspec.structs.replace(status, engine=occupied).shown(), checks
        finally:
            engine.shutdown()
    finally:
        simulated.close()


@runtime_checkable
class SelfChecking(Protocol):
    """A data source that can feed half of its range into its inputs, as the GSV-8 does."""

    def half_scale(self) -> Sequence[Any]:
        """Return a result for each input: name, measured, expected, unit, passed."""


def self_check(
    rig: RigFile,
    ports: Mapping[str, str],
    load: LoadDriver = load_driver,
    folder: Path = Path(),
) -> Iterator[Check]:
    """Yield the check of the data source's test value, where it has one.

    It covers the path from the amplifier to the program: scales and order of the channels. Errors
    of opening the source are passed on.
    """
    devices = make_devices(rig, ports, load, folder=folder)
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
            yield Check(what, CheckVerdict.ATTENTION, f"not possible: {error.sentence}")
            return
        wrong = [result for result in results if not result.right]
        if wrong:
            differences = ", ".join(
                f"{bad.name} {bad.measured:.4g} {bad.unit} in place of {bad.expected:.4g}"
                for bad in wrong
            )
            action = "Compare scales and order of the device's channels with the rig file"
            yield Check(what, CheckVerdict.BLOCKS, differences, action)
        else:
            names = ", ".join(result.name for result in results)
            yield Check(what, CheckVerdict.GOOD, f"half of the range arrives on {names}")
    finally:
        devices.close()


def _rate(status: Status | None) -> float:
    devices = status.rig.devices if status is not None else ()
    return max((device.sample_rate_Hz for device in devices), default=0.0)


def _configured_rate(rig: RigFile) -> float:
    rate = rig.devices[rig.encoder.device].settings.get("sample_rate_Hz", 0.0)
    return float(rate) if isinstance(rate, int | float) else 0.0
