"""A new record against the one in use: a change beyond U is said before the new one is used."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from commandline import rigapp

from rigapp_calibration.load_cell.as_found import changes, outputs
from rigapp_calibration.records import EVALUATION
from tests.calibration.pinned import FOLDER
from tests.calibration.simulated_cell import Cell, take
from tests.calibration.test_commands import as_csv
from tests.calibration.test_worksheet import SETTINGS


def calibrated(folder: Path, name: str, cell: Cell, seed: int, *more: str) -> str:
    """Calibrate a cell by the command line; return what it printed."""
    readings = folder / f"{name}.csv"
    readings.write_text(as_csv(take(cell, np.random.default_rng(seed), angles=8)))
    (folder / "settings.toml").write_text(SETTINGS)
    done = rigapp(
        "calibrate", "load-cell", "--readings", readings, "--settings", folder / "settings.toml",
        "--to", folder / f"{name}.json", *more,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_a_cell_that_stayed_as_it_was_is_within_u(tmp_path: Path) -> None:
    calibrated(tmp_path, "old", Cell(), 1)
    said = calibrated(tmp_path, "new", Cell(), 2, "--former", str(tmp_path / "old.json"))
    assert "As found, the record" in said
    assert "MORE than allowed" not in said
    kept = json.loads((tmp_path / "new.json").read_text())["as_found"]
    assert kept["record"] == json.loads((tmp_path / "old.json").read_text())["number"]
    assert not any(one["beyond"] for one in kept["changes"])
    verified = rigapp("calibrate", "verify", tmp_path / "new.json")
    assert verified.returncode == 0, verified.stderr


def test_a_gain_that_changed_by_two_percent_is_beyond_u(tmp_path: Path) -> None:
    calibrated(tmp_path, "old", Cell(), 1)
    weaker = replace(Cell(), sensitivity=0.98 * Cell().sensitivity)
    said = calibrated(tmp_path, "new", weaker, 2, "--former", str(tmp_path / "old.json"))
    assert "MORE than allowed" in said
    assert "find out what changed" in said
    (force, across, zero) = json.loads((tmp_path / "new.json").read_text())["as_found"]["changes"]
    # What was in use until now tells 2 % of 400 N too little.
    assert force["value"] == pytest.approx(-8.0, abs=2.0)
    assert force["beyond"]
    assert not across["beyond"]
    assert not zero["beyond"]


def test_records_of_a_folder_are_a_trend(tmp_path: Path) -> None:
    calibrated(tmp_path, "a", Cell(), 1)
    assert rigapp("calibrate", "trend", tmp_path).returncode == 0
    weaker = replace(Cell(), sensitivity=0.98 * Cell().sensitivity)
    calibrated(tmp_path, "b", weaker, 2)
    (tmp_path / "journal.json").write_text("{}\n")
    shown = rigapp("calibrate", "trend", tmp_path, "--json")
    (told,) = json.loads(shown.stdout)
    assert [bool(one["changes"]) for one in told["records"]] == [False, True]
    drawn = tmp_path / "trend.html"
    done = rigapp("calibrate", "trend", tmp_path, "--to", drawn)
    assert done.returncode == 1
    assert "force at full scale" in done.stdout
    page = drawn.read_text("utf-8")
    assert page.count("data:image/svg+xml") == 2  # a vector chart of each bridge
    assert "Output of bridge 1 at full scale" in page
    assert "MORE than allowed" in page
    assert rigapp("calibrate", "trend", tmp_path / "none").returncode == 2


def test_cells_of_other_full_scales_and_probes_without_u_are_not_compared() -> None:
    cell = {"full_scale_N": 400.0, "matrix_N_per_unit": [[200.0, 0.0], [0.0, 200.0]]}
    assert changes("load cell", cell, {**cell, "full_scale_N": 5.0}) == ()
    probe = {"sensitivity_um_per_V": 100.0}
    assert changes("probe", probe, probe) == ()


def test_a_trend_shows_the_u_of_the_calibration_itself() -> None:
    result = json.loads((FOLDER / str(EVALUATION) / "load_cell.json").read_text())["result"]
    one, two = outputs("load cell", result)
    matrix = np.linalg.inv(np.array(result["matrix_N_per_unit"]))
    assert [one.value, two.value] == pytest.approx(np.abs(np.diag(matrix)) * 400.0, rel=1e-9)
    last = result["of_calibration"]["uncertainty_by_load"][-1]
    share = last["magnitude_mean_of_many_N"] / last["load_N"]
    assert one.expanded == pytest.approx(share * one.value)
    pair = json.loads((FOLDER / str(EVALUATION) / "probes.json").read_text())["result"]
    assert [output.unit for output in outputs("probe pair", pair)] == ["um/V", "um/V"]
    assert outputs("channel", {}) == ()


def test_a_probe_is_compared_by_its_sensitivity() -> None:
    before = {"sensitivity_um_per_V": 100.0, "sensitivity_relative_standard_uncertainty": 1e-3}
    after = {**before, "sensitivity_um_per_V": 102.0}
    (one,) = changes("probe", before, after)
    assert one.beyond
    assert one.value == pytest.approx(-1.96, abs=0.01)
    assert one.allowed == pytest.approx(0.283, abs=0.001)
    pair = {"probes": [before, before]}
    assert [one.beyond for one in changes("probe pair", pair, {"probes": [before, after]})] == [
        False,
        True,
    ]
