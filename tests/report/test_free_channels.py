"""Channels that a rig file adds are in report and export by the table of the file alone."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from report_samples import RPM, STARTED, metadata
from reportpage import Page, read

from rigapp.commands.files import write_report
from rigapp.schema.channels import BASE, Channel, ChannelTable, Kind
from rigapp.storage import FilePlan, create_test, export_test

REVOLUTIONS = 40
WARM = Channel("bushing_temperature", "degC", "bushing temperature")
STROKES = tuple(Channel(f"stroke_{n}", "mm", f"stroke {n}") for n in range(1, 5))
ROOM = Channel("room", "degC", "room, temperature of hall", Kind.SLOW)
TABLE = ChannelTable((*BASE.channels, WARM, *STROKES, ROOM))


@pytest.fixture(scope="module")
def file(quick_folder: Path) -> Path:
    """Return a test with five free channels and a slow one, whose first value is missing."""
    plan = FilePlan(
        REVOLUTIONS,
        cycles=3,
        samples_per_cycle=36,
        prediction=False,
        channels=TABLE.channels,
        revolution_columns=TABLE.revolution_columns,
        cycle_columns=TABLE.cycle_columns,
    )
    path = quick_folder / "free.h5"
    with create_test(path, plan, metadata()) as writer:
        for revolution in range(1, REVOLUTIONS + 1):
            values = dict.fromkeys(TABLE.names, 1.0)
            values |= {
                "revolution": revolution,
                "time": revolution * 60.0 / RPM,
                "host_time": STARTED + revolution * 60.0 / RPM,
                "speed": RPM,
                "quality": 0.0,
                "bushing_temperature_max": 30.0 + revolution / 10.0,
                "bushing_temperature_min": 29.0,
                "bushing_temperature_rms": 29.5,
                "room": 21.0 + (revolution == 7) if revolution > 1 else np.nan,
                "room_age": 2.5 if revolution == 20 else 0.5,
            }
            if revolution in (1, 20, 40):
                angle = np.arange(36) * 10.0
                cycle = {one.name: np.cos(np.radians(angle)) for one in TABLE.cycle_columns}
                cycle |= {"angle": angle, "time": revolution + angle / 360.0}
                cycle["bushing_temperature"] = 30.0 + angle / 360.0
                writer.append_cycle(revolution, cycle)
            writer.append_row([values[name] for name in TABLE.names])
        writer.finish("complete", "complete", "done")
    return path


@pytest.fixture(scope="module")
def page(file: Path, quick_folder: Path) -> Page:
    """Return its report."""
    target = quick_folder / "free.html"
    assert write_report(file, target) == 0
    assert write_report(file, quick_folder / "free.pdf") == 0
    return read(target.read_bytes())


@pytest.mark.long
def test_the_report_has_free_channels_in_its_tables(page: Page) -> None:
    rows = {row[0]: row[1:] for row in page.rows("Extremes and RMS of every channel")}
    warm = rows["bushing temperature"]
    assert warm == ["°C", "34.0", "40", "29.0", "1", "29.5", "29.5", "29.5"]
    assert rows["stroke 4"][0] == "mm"
    assert rows["room, temperature of hall"][:5] == ["°C", "22.0", "7", "21.0", "2"]
    assert "Oldest value at the end of a revolution: room 2.50 s." in page.text


@pytest.mark.long
def test_the_report_draws_them_against_revolution_and_over_a_cycle(page: Page) -> None:
    words = " ".join(one["alt"] for one in page.images)
    assert "bushing temperature between 29.0 and 34.0 °C." in words
    assert "room, temperature of hall between 21.0 and 22.0 °C." in words
    assert "Revolution 20: bushing temperature between 30.0 and 31.0 °C." in words
    assert "Revolution 20: stroke 4 between -1.0000 and 1.0000 mm." in words


def test_no_report_code_names_them() -> None:
    folder = Path(__file__).parents[2] / "rigapp" / "report" / "testreport"
    text = "".join(one.read_text(encoding="utf-8") for one in folder.glob("*.py"))
    assert "temperature" not in text


def test_the_export_has_them_with_their_units(file: Path, quick_folder: Path) -> None:
    rows, cycles, even = (quick_folder / f"free-{one}.csv" for one in ("rows", "cycles", "even"))
    assert export_test(file, rows) == REVOLUTIONS
    head = rows.read_text(encoding="utf-8").partition("\n")[0].split(",")
    assert {"bushing_temperature_max_degC", "stroke_2_rms_mm", "room_degC", "room_age_s"} <= {*head}
    assert export_test(file, cycles, cycles=True) == 3 * 36
    head = cycles.read_text(encoding="utf-8").partition("\n")[0].split(",")
    assert {"bushing_temperature_degC", "raw_bushing_temperature_V"} <= {*head}
    assert export_test(file, even, cycles=True, points=18) == 3 * 18
    table = np.genfromtxt(even, delimiter=",", names=True)
    assert "time_s" not in table.dtype.names
    np.testing.assert_allclose(
        table["bushing_temperature_degC"][:18], 30.0 + np.arange(18) / 18.0, atol=1e-6
    )
