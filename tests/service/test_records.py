"""Calibration records in use: their numbers replace the rig file's; expired ones block a start."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest

from rigapp.calibrating.records_in_use import with_records
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
        "quadratic_unit_per_N2": None,
        "uncertainty_line_N": {"constant_N": 2.5, "per_N": 0.001},
    },
}
IN_TIME = 1780000000.0
TOO_LATE = 1800000000.0


def rig_with(folder: Path, content: dict, line: str = 'calibration = "cell.json"'):
    (folder / "cell.json").write_bytes(seal(content))
    text = RIG.read_text()
    head, tail = text.split("[probes]")
    path = folder / "rig.toml"
    path.write_text(f"{head}{line}\n[probes]{tail}")
    return read_rig(path)


def test_numbers_of_the_record_are_used(tmp_path: Path) -> None:
    found = with_records(rig_with(tmp_path, CELL), IN_TIME)
    cell = found.rig.record.load_cell
    assert cell.matrix_N_per_mV_per_V == ((201.0, 1.0), (-2.0, 199.0))
    assert cell.zero_mV_per_V == (0.01, -0.02)
    assert cell.uncertainty_N == (2.5, 0.001)
    # These numbers have no readings behind them: a reason is wanted before they may be used.
    assert "holds no readings" in found.blocking["load_cell"]
    assert found.texts["load_cell"] == (tmp_path / "cell.json").read_text()


def test_expired_record_blocks_unless_overridden_with_a_reason(tmp_path: Path) -> None:
    late = with_records(rig_with(tmp_path, CELL), TOO_LATE)
    assert "expired on 2027-01-01" in late.blocking["load_cell"]
    line = 'calibration = "cell.json"\ncalibration_override = "weights are away"'
    used = with_records(rig_with(tmp_path, CELL, line), TOO_LATE)
    assert not used.blocking
    assert "weights are away" in used.remarks["load_cell"]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"taken": {"rig": "Other rig", "simulated": True}}, "taken on the rig 'Other rig'"),
        ({"taken": {"rig": "Simulated slider-crank", "simulated": False}}, "taken on a real rig"),
        ({"settings": {"cell": {"signal_unit": "mV/V", "full_scale_N": 200.0}}}, "of 200 N"),
    ],
)
def test_foreign_record_blocks_unless_overridden_with_a_reason(
    tmp_path: Path, changes: dict, words: str
) -> None:
    content = {**CELL, **changes}
    assert words in with_records(rig_with(tmp_path, content), IN_TIME).blocking["load_cell"]
    line = 'calibration = "cell.json"\ncalibration_override = "cell was moved here"'
    used = with_records(rig_with(tmp_path, content, line), IN_TIME)
    assert not used.blocking
    assert words in used.remarks["load_cell"]
    assert "cell was moved here" in used.remarks["load_cell"]


def test_foreign_and_spoilt_records_are_refused(tmp_path: Path) -> None:
    with pytest.raises(UnusableInput, match="record of a probe"):
        with_records(rig_with(tmp_path, {**CELL, "kind": "probe"}), IN_TIME)
    rig = rig_with(tmp_path, CELL)
    data = (tmp_path / "cell.json").read_bytes()
    (tmp_path / "cell.json").write_bytes(data.replace(b"201.0", b"202.0"))
    with pytest.raises(UnusableInput, match="changed"):
        with_records(rig, IN_TIME)
    (tmp_path / "cell.json").unlink()
    with pytest.raises(UnusableInput, match="cannot be read"):
        with_records(rig, IN_TIME)


def test_record_in_another_unit_is_refused(tmp_path: Path) -> None:
    content = {**CELL, "settings": {"cell": {"signal_unit": "V"}}}
    with pytest.raises(UnusableInput, match="N per V"):
        with_records(rig_with(tmp_path, content), IN_TIME)


def test_rig_without_records_is_left_alone() -> None:
    rig = read_rig(RIG)
    found = with_records(rig)
    assert msgspec.structs.asdict(found.rig.record.load_cell) == msgspec.structs.asdict(
        rig.record.load_cell
    )
    assert found.texts == {}


def test_uncertainty_of_the_record_is_shown_beside_the_live_force(tmp_path: Path) -> None:
    from rigapp.engine.core import Core
    from rigapp.engine.drive.timing import Timing
    from rigapp.engine.views import uncertainty_of_force

    found = with_records(rig_with(tmp_path, CELL), IN_TIME)
    assert uncertainty_of_force(Core(found.rig, Timing(), None), -100.0) == pytest.approx(2.6)
    assert uncertainty_of_force(Core(read_rig(RIG), Timing(), None), 100.0) is None
