"""Naming a record in a rig file keeps its comments, keeps a copy, and refuses what is unusable."""

from __future__ import annotations

from pathlib import Path

import pytest

from rigapp.calibrating.records_in_use import name_record
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp_calibration.records import seal

RIG = Path(__file__).parents[2] / "examples" / "simulated.toml"
CELL = {
    "kind": "load cell",
    "calibrated_at": "2026-01-01T00:00:00Z",
    "due_at": "2027-01-01T00:00:00Z",
    "settings": {"cell": {"signal_unit": "mV/V"}},
    "result": {
        "matrix_N_per_unit": [[201.0, 1.0], [-2.0, 199.0]],
        "zero": [0.01, -0.02],
        "uncertainty_line_N": {"constant_N": 2.5, "per_N": 0.001},
    },
}


@pytest.fixture
def rig(tmp_path: Path) -> Path:
    (tmp_path / "records").mkdir()
    (tmp_path / "records" / "cell.json").write_bytes(seal(CELL))
    path = tmp_path / "rig.toml"
    path.write_text(RIG.read_text())
    return path


def test_only_the_name_is_written_and_the_old_file_kept(rig: Path) -> None:
    before = rig.read_text()
    copy = name_record(rig, rig.parent / "records" / "cell.json")
    assert copy.read_text() == before
    old, new = before.splitlines(), rig.read_text().splitlines()
    assert set(old) <= set(new)
    assert [line for line in new if line not in old] == ['calibration = "records/cell.json"']
    assert read_rig(rig).record.load_cell.calibration == "records/cell.json"


def test_a_second_record_takes_the_place_and_the_override_goes(rig: Path) -> None:
    text = rig.read_text().replace(
        "full_scale_N = 400.0",
        'full_scale_N = 400.0\ncalibration = "old.json" # of May\ncalibration_override = "late"',
    )
    rig.write_text(text)
    first = name_record(rig, rig.parent / "records" / "cell.json")
    second = name_record(rig, rig.parent / "records" / "cell.json")
    assert first != second
    cell = read_rig(rig).record.load_cell
    assert (cell.calibration, cell.calibration_override) == ("records/cell.json", "")
    assert "# of May" in rig.read_text()


def test_an_unusable_record_changes_nothing(rig: Path) -> None:
    before = rig.read_text()
    (rig.parent / "probe.json").write_bytes(seal({**CELL, "kind": "probe"}))
    for record, words in (("probe.json", "record of a probe"), ("none.json", "cannot be read")):
        with pytest.raises(UnusableInput, match=words):
            name_record(rig, rig.parent / record)
    assert rig.read_text() == before
    assert [path.name for path in rig.parent.glob("rig*")] == ["rig.toml"]
