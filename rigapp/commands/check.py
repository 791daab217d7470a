"""`rigapp check`: would this test start on this rig? A table, and what blocks."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from drivers.api import DeviceError
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, read_rig, read_test
from rigapp.config.recipe import TestFile
from rigapp.config.rig import RigFile
from rigapp.engine.calibrate import Calibration, calibration_of
from rigapp.engine.criteria import described
from rigapp.engine.devices import make_devices
from rigapp.engine.fileplan import file_plan
from rigapp.engine.limits import check_rules
from rigapp.service.records import with_records
from rigapp.service.simulated import SimulatedDevices, parse_speed
from rigapp.simulation.handle import SimulationFailed
from rigapp.storage.layout import reserved_bytes, streams_of

FEWEST_SAMPLES = 60
ROOM_FACTOR = 1.1


@dataclass(frozen=True, slots=True)
class Item:
    """One line of the pre-flight check."""

    subject: str
    text: str
    good: bool = True
    blocks: bool = True


def check_rig(rig_path: Path, test_path: Path) -> int:
    """Print the pre-flight table; status 1 when anything blocks a start."""
    from rich.console import Console
    from rich.table import Table

    records = with_records(read_rig(rig_path))
    test = read_test(test_path)
    items = [Item("Calibration", text, False) for text in records.blocking.values()]
    items += [Item("Calibration", f"{name}: {text}") for name, text in records.remarks.items()]
    items += preflight(records.rig, test, Path.cwd())
    table = Table(show_header=False, box=None, pad_edge=False)
    for item in items:
        mark = "ok" if item.good else ("BLOCKS" if item.blocks else "note")
        table.add_row(mark, item.subject, item.text)
    Console(soft_wrap=True).print(table)
    return 1 if any(item.blocks and not item.good for item in items) else 0


def preflight(rig: Document[RigFile], test: Document[TestFile], folder: Path) -> Iterator[Item]:
    """Yield what was checked, devices included: they are opened, configured and released."""
    yield from _limits(rig.record, test.record)
    yield from _calibration(rig.record)
    calibration: list[Calibration] = []
    yield from _devices(rig, test.record, calibration)
    rate = calibration[0].sample_rate_Hz if calibration else _configured_rate(rig.record)
    if rate:
        yield from _samples(test.record, rate)
        yield from _disk(test.record, rate, folder)


def _limits(rig: RigFile, test: TestFile) -> Iterator[Item]:
    run, limits = test.run, test.limits
    if run.speed_rpm > rig.spindle.maximum_speed_rpm:
        yield Item(
            "Speed",
            f"{run.speed_rpm:g} rpm is above the rig's maximum of"
            f" {rig.spindle.maximum_speed_rpm:g} rpm",
            False,
        )
    else:
        hours = run.revolutions / run.speed_rpm / 60.0
        yield Item(
            "Speed", f"{run.speed_rpm:g} rpm, {run.revolutions} revolutions in {hours:.2f} h"
        )
    full = rig.load_cell.full_scale_N
    yield Item(
        "Overload",
        f"{limits.overload_N:g} N of {full:g} N full scale",
        limits.overload_N <= full,
    )
    ends = [f"{run.revolutions} revolutions", *described(test.stop)]
    yield Item("Ends", "at the first of: " + ", ".join(ends) if len(ends) > 1 else ends[0])
    try:
        check_rules(limits.rule)
    except UnusableInput as error:
        yield Item("Limits", str(error), False)
    else:
        yield Item("Limits", f"{len(limits.rule)} rules of the test, and the built-in ones")


def _calibration(rig: RigFile) -> Iterator[Item]:
    determinant = (
        rig.load_cell.matrix_N_per_mV_per_V[0][0] * rig.load_cell.matrix_N_per_mV_per_V[1][1]
        - rig.load_cell.matrix_N_per_mV_per_V[0][1] * rig.load_cell.matrix_N_per_mV_per_V[1][0]
    )
    if not math.isfinite(determinant) or determinant == 0.0:
        yield Item("Load cell", "its matrix cannot be used; calibrate it", False)
    else:
        yield Item("Load cell", rig.load_cell.calibration or "linear, from the rig file")
    usable = all(math.isfinite(value) and value != 0.0 for value in rig.probes.sensitivity_um_per_V)
    text = rig.probes.calibration_name or "linear, from the rig file"
    yield Item("Probes", text if usable else "a sensitivity of 0 cannot be used", usable)


def _devices(rig: Document[RigFile], test: TestFile, found: list[Calibration]) -> Iterator[Item]:
    simulated = SimulatedDevices(rig, parse_speed(None, rig))
    try:
        devices = make_devices(rig.record, simulated.ports(test.model))
        try:
            setup = devices.open()
            found.append(calibration_of(rig.record, setup))
            for name, box in devices.identities.items():
                text = f"{box.maker} {box.model}, firmware {box.firmware}"
                yield Item(f"Device {name}", f"{text}, serial {box.serial_number or 'not told'}")
        finally:
            devices.close()
    except DeviceError as error:
        yield Item(f"Device {error.device}", f"{error.port}: {error.sentence}", False)
    except (UnusableInput, SimulationFailed) as error:
        yield Item("Devices", str(error), False)
    finally:
        simulated.close()


def _configured_rate(rig: RigFile) -> float:
    rate = rig.devices[rig.encoder.device].settings.get("sample_rate_Hz", 0.0)
    return float(rate) if isinstance(rate, int | float) else 0.0


def _samples(test: TestFile, rate: float) -> Iterator[Item]:
    samples = rate * 60.0 / test.run.speed_rpm
    yield Item(
        "Samples",
        f"{samples:.0f} a revolution at {rate:g} Hz"
        + ("" if samples >= FEWEST_SAMPLES else "; extremes will be missed, raise the rate"),
        samples >= FEWEST_SAMPLES,
        blocks=False,
    )


def _disk(test: TestFile, rate: float, folder: Path) -> Iterator[Item]:
    plan = file_plan(test, rate)
    needed = reserved_bytes(streams_of(plan).values()) * ROOM_FACTOR / 1e6
    disk = os.statvfs(folder)
    free = disk.f_bavail * disk.f_frsize / 1e6
    text = f"{needed:.0f} MB needed, {free:.0f} MB free in {folder}"
    if free < needed:
        text += f"; {needed - free:.0f} MB are missing"
    yield Item("Disk", text, free >= needed)
