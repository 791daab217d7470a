"""A record is of one cell, read by one line: another one needs a reason to be used."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rigapp.calibrating.load_cell_result import fit_load_cell
from rigapp.calibrating.records import keep_record
from rigapp.calibrating.records_in_use import with_records
from rigapp.calibrating.wiring import wiring_of
from rigapp.config.calibration_settings import CellSection, LoadCellFile, PlaceSection
from rigapp.config.loading import Document, parse_rig, read_rig
from rigapp_calibration.load_cell.readings import LOAD_CELL_COLUMNS
from rigapp_calibration.records import seal
from rigapp_calibration.taking.readings import read_table
from tests.calibration.simulated_cell import Cell, take
from tests.calibration.test_commands import as_csv

RIG = Path(__file__).parents[2] / "examples" / "simulated.toml"
CELL = CellSection(name="pin load cell", serial_number="LC-17")
GIVEN = LoadCellFile(schema=1, cell=CELL, place=PlaceSection(gravity_m_s2=9.8123))

Change = Callable[[dict[str, Any]], object]


@pytest.fixture(scope="module")
def content(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """Return what a record holds whose readings were taken live on the example's rig."""
    text = as_csv(take(Cell(), np.random.default_rng(4), angles=8))
    outcome = fit_load_cell(read_table(text, LOAD_CELL_COLUMNS), GIVEN, "here")
    path = tmp_path_factory.mktemp("sealed") / "record.json"
    rig = read_rig(RIG).record
    taken = {"rig": rig.name, "simulated": True, "wiring": wiring_of(rig)}
    keep_record(path, outcome.kind, text, GIVEN, outcome.result, taken)
    whole = json.loads(path.read_bytes())
    return {key: whole[key] for key in whole if key not in ("digest", "number", "schema")}


def blocking(folder: Path, content: dict[str, Any], *swaps: tuple[str, str], why: str = "") -> str:
    """Return why the record forbids a start on the example's rig with some lines exchanged."""
    (folder / "cell.json").write_bytes(seal(content))
    text = RIG.read_text("utf-8")
    for old, new in (
        ("[probes]\n", f'calibration = "cell.json"\ncalibration_override = "{why}"\n[probes]\n'),
        *swaps,
    ):
        assert old in text
        text = text.replace(old, new, 1)
    rig = Document(folder / "rig.toml", text, parse_rig(text, "rig.toml"))
    return with_records(rig).blocking.get("load_cell", "")


def test_the_same_cell_on_the_same_line_may_be_used(
    tmp_path: Path, content: dict[str, Any]
) -> None:
    named = ("full_scale_N = 400.0", 'full_scale_N = 400.0\nserial_number = "LC-17"')
    assert blocking(tmp_path, content) == ""
    assert blocking(tmp_path, content, named) == ""


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("full_scale_N = 400.0", 'full_scale_N = 400.0\nserial_number = "LC-18"', "'LC-17'"),
        ("range_mV_per_V = 3.5", "range_mV_per_V = 2.0", "range_mV_per_V = 3.5"),
        ("sample_rate_Hz = 960.0", "sample_rate_Hz = 1200.0", "settings.sample_rate_Hz = 960"),
        ("sample_rate_Hz = 960.0", 'sample_rate_Hz = 960.0\nanalog_filter = "28 Hz"', "28 Hz"),
        (
            'input_1 = "analog_1"\ninput_2 = "analog_2"',
            'input_1 = "analog_2"\ninput_2 = "analog_1"',
            "input_1 = analog_1, the rig file says analog_2",
        ),
        ('port = "simulated"', 'port = "simulated"\nserial_number = "99"', "serial_number"),
    ],
)
def test_another_cell_or_line_blocks_unless_there_is_a_reason(
    tmp_path: Path, content: dict[str, Any], old: str, new: str, words: str
) -> None:
    assert words in blocking(tmp_path, content, (old, new))
    assert blocking(tmp_path, content, (old, new), why="looked at") == ""


def test_a_record_that_names_no_cell_blocks_where_the_rig_names_one(
    tmp_path: Path, content: dict[str, Any]
) -> None:
    named = ("full_scale_N = 400.0", 'full_scale_N = 400.0\nserial_number = "LC-17"')
    cell = {**content["settings"]["cell"], "serial_number": ""}
    unnamed = {**content, "settings": {**content["settings"], "cell": cell}}
    assert "does not say of which load cell" in blocking(tmp_path, unnamed, named)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda one: one.pop("readings_csv"), "holds no readings"),
        (lambda one: one.update(readings_csv="new form"), "This version cannot fit"),
        (lambda one: one.update(evaluation=99), "made by evaluation 99"),
        (lambda one: one.update(evaluation="newest"), "made by evaluation 'newest'"),
        (lambda one: one.update(evaluation=-1), "made by evaluation -1"),
        (lambda one: one["result"]["matrix_N_per_unit"][0].__setitem__(0, 222.0), "not follow"),
    ],
)
def test_what_does_not_follow_from_readings_blocks(
    tmp_path: Path, content: dict[str, Any], change: Change, words: str
) -> None:
    altered = json.loads(json.dumps(content))
    change(altered)
    assert words in blocking(tmp_path, altered)
    assert blocking(tmp_path, altered, why="of the maker") == ""
