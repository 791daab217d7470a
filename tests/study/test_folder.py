"""A study's folder is read back as it was written, by a reader without Dask and xarray."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray
from study.studies import finished

from rigapp.study.folder import IDENTITY, NOT_COMPUTED, ROWS, TABLE, StudyResults, studies_in
from rigapp.study.sensitivity import INDICES

JOINTS = """schema = 1
kind = "forces"
parameters = "parameters.toml"
[run]
rpm = 30.0
points = 36
[vary]
"run.joint" = ["perfect", "continuous"]
"run.rpm" = [30.0, 60.0, 90.0]
"""
POWER_STUDY = """schema = 1
kind = "simulate"
parameters = "parameters.toml"
[run]
rpm = 30.0
revolutions = 4000
[vary]
"run.coefficient_factor" = [1.0, 2.0]
[design]
repeats = 3
"""


def only(folder: Path) -> StudyResults:
    (found,) = studies_in(folder)
    return found


def test_a_table_comes_back_as_xarray_reads_it(tmp_path: Path) -> None:
    study = only(finished(tmp_path / "contact", problems={5: "the pin is too large"}))
    with xarray.open_dataset(study.folder / TABLE, engine="h5netcdf") as table:
        for one in (*study.parameters, *study.results):
            np.testing.assert_array_equal(one.values, table[one.name].values)
            assert one.unit == table[one.name].attrs["units"]
        for at, name in enumerate(table["result"].values):
            for index in INDICES:
                known = table[f"sensitivity_{index}"].values[at]
                np.testing.assert_array_equal(getattr(study.sensitivities[name], index), known)
        assert [one.name for one in study.parameters] == list(table["parameter"].values)
    assert (study.kind, len(study.problems), study.waiting) == ("pressure", 64, 0)
    assert study.failed == ((5, "the pin is too large"),)
    assert np.isnan(study.results[0].values[5])


def test_texts_that_were_varied_have_places(tmp_path: Path) -> None:
    study = only(finished(tmp_path / "joints", JOINTS))
    joint, rpm = sorted(study.parameters, key=lambda one: one.name)
    assert joint.texts == ("continuous", "perfect")
    assert sorted(joint.values) == [0.0] * 3 + [1.0] * 3
    assert (rpm.texts, sorted(set(rpm.values))) == ((), [30.0, 60.0, 90.0])
    assert not study.sensitivities


@pytest.mark.long
def test_virtual_tests_bring_their_power(tmp_path: Path) -> None:
    study = only(finished(tmp_path / "power", POWER_STUDY))
    assert {(one.factor, one.tests) for one in study.power} == {(1.0, 3), (2.0, 3)}
    assert {one.share for one in study.power} == {0.5, 0.8, 0.9, 0.95}


def test_a_study_under_way_and_a_damaged_one_say_so(tmp_path: Path) -> None:
    done = finished(tmp_path / "done")
    for age, name in enumerate(("damaged", "going", "begun")):
        folder = tmp_path / name
        folder.mkdir()
        (folder / IDENTITY).write_bytes((done / IDENTITY).read_bytes())
        os.utime(folder / IDENTITY, (1e9 + age, 1e9 + age))
    (tmp_path / "damaged" / TABLE).write_bytes(b"no table")
    (tmp_path / "going" / ROWS).write_bytes(b"{}")
    (tmp_path / "no-study").mkdir()
    found = {one.folder.name: one for one in studies_in(tmp_path)}
    assert found.keys() == {"done", "damaged", "going", "begun"}
    assert "is not the table of a study" in found["damaged"].reason
    assert str(tmp_path / "damaged" / TABLE) in found["damaged"].reason
    for name in ("going", "begun"):
        assert "no table yet" in found[name].reason
    assert list(found)[-1] == "begun"


def test_points_to_come_are_counted() -> None:
    study = StudyResults(Path("x"), 0.0, problems=("", NOT_COMPUTED, "too small", NOT_COMPUTED))
    assert (study.waiting, study.failed) == (2, ((2, "too small"),))


def test_reading_a_folder_needs_neither_dask_nor_xarray() -> None:
    code = (
        "import sys; sys.modules.update(dict.fromkeys(['distributed', 'xarray', 'matplotlib']));"
        "import rigapp.study.folder"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)


@pytest.mark.parametrize("text", ["", "x"])
def test_no_such_folder_is_an_error_of_the_system(tmp_path: Path, text: str) -> None:
    with pytest.raises(OSError, match="missing"):
        studies_in(tmp_path / f"missing{text}")
