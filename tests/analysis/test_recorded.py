"""Tests as analysts open them: what is safe, with units and dates, whole or in pieces."""

from __future__ import annotations

import importlib
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray
from report.report_samples import append, eventful, new_test

import rigapp
from rigapp.analysis.backend import RigappBackend
from rigapp.config.errors import UnusableInput
from rigapp.schema.messages import Event
from rigapp.storage import compact_test, open_test

GROUPS = ("revolutions", "cycles", "prediction", "events", "profiles")


@pytest.fixture(scope="module")
def ended(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a test that was stopped by a limit after a gap, with five whole cycles and a log."""
    return eventful(tmp_path_factory.mktemp("ended") / "eventful.h5")


@pytest.fixture(scope="module")
def compressed(ended: Path) -> Path:
    """Return its compressed form."""
    path = ended.with_name("compressed.h5")
    path.write_bytes(ended.read_bytes())
    compact_test(path)
    return path


@pytest.mark.long
@pytest.mark.sampled
@pytest.mark.parametrize("chunks", [None, 100])
@pytest.mark.parametrize("form", ["ended", "compressed"])
def test_datasets_hold_what_the_reader_reads(
    form: str, chunks: int | None, request: pytest.FixtureRequest
) -> None:
    path: Path = request.getfixturevalue(form)
    test = rigapp.open(path, chunks=chunks)
    with open_test(path) as reader:
        for name, values in reader.rows().items():
            if name != "host_time":
                np.testing.assert_array_equal(test.revolutions[name], values)
        for name, values in reader.predictions().items():
            np.testing.assert_array_equal(test.prediction[name], values)
        for cycle in reader.cycles():
            one = test.cycle(cycle.revolution)
            np.testing.assert_array_equal(one["force"], cycle.columns["force"])
            np.testing.assert_array_equal(one["angle"], cycle.columns["angle"])
        curve = reader.predicted_curve(40)
    assert curve is not None
    drawn = test.prediction["curve_force"].sel(curve_revolution=40)
    np.testing.assert_array_equal(drawn, curve["force"])
    assert drawn["angle"].attrs["units"] == "deg"
    assert (test.revolutions.chunks != {}) == (chunks is not None)


def test_columns_say_their_unit_and_moments_are_dates(ended: Path) -> None:
    test = rigapp.open(ended)
    rows = test.revolutions
    assert rows["force_max"].attrs["units"] == "N"
    assert rows["force_max"].attrs["long_name"] == "maximum force over the revolution"
    assert "flag_meanings" in rows["quality"].attrs
    assert rows["host_time"].dtype == np.dtype("datetime64[ns]")
    assert str(rows["host_time"].values[0])[:19] == "2027-01-15T08:00:01"
    assert rows["force_max"].sel(revolution=206).size == 1
    assert rows["time"].dtype == np.float64, "seconds since the beginning stay numbers"
    silent = [
        (group, name)
        for group in GROUPS
        for name, one in getattr(test, group).data_vars.items()
        if "long_name" not in one.attrs
    ]
    assert silent == []


def test_rows_are_read_in_any_order_and_step(ended: Path) -> None:
    rows = rigapp.open(ended).revolutions["force_max"]
    with open_test(ended) as reader:
        values = reader.column("force_max")
    for key in (slice(-5, None), slice(None, None, -3), slice(250, 10, -7), [3, 1, 3], 4, -1):
        np.testing.assert_array_equal(rows.isel(revolution=key), values[key])
    curves = rigapp.open(ended).prediction["curve_force_1"]
    np.testing.assert_array_equal(
        curves.isel(curve_revolution=-1, angle=slice(10, 20)), curves.values[-1, 10:20]
    )


def test_a_running_test_shows_what_is_safe_and_later_what_came(tmp_path: Path) -> None:
    with new_test(tmp_path / "t.h5") as writer:
        for revolution in range(1, 31):
            append(writer, revolution, keep=revolution == 20)
        writer.commit()
        test = rigapp.open(writer.path)
        before = test.revolutions
        assert (test.status, before.sizes["revolution"]) == ("running", 30)
        assert test.revolutions is before, "nothing has come"
        for revolution in range(31, 41):
            append(writer, revolution)
        writer.commit()
        assert test.revolutions.sizes["revolution"] == 40
        assert float(before["force_max"][-1]) == float(test.revolutions["force_max"][29])
        assert test.cycles["revolution"].values.tolist() == [20]
        assert test.even_cycles(36).sizes == {"revolution": 1, "angle": 36}
    assert test.status == "interrupted", "nobody ended it"
    assert test.revolutions.sizes["revolution"] == 40


def test_a_test_without_anything_yet_has_empty_datasets(tmp_path: Path) -> None:
    with new_test(tmp_path / "t.h5") as writer:
        writer.commit()
        test = rigapp.open(writer.path)
        rows = {"cycles": "sample", "events": "event"}
        for group in GROUPS:
            assert getattr(test, group).sizes[rows.get(group, "revolution")] == 0
        with pytest.raises(UnusableInput, match="revolution 3 no whole cycle is kept"):
            test.cycle(3)


def test_a_line_of_the_log_is_whole_however_long(tmp_path: Path) -> None:
    with new_test(tmp_path / "t.h5") as writer:
        event = Event(1.8e9, 3, "note", "Ada", "ä" * 700, key="k", data={"what": "raised"})
        writer.append_event(event)
        append(writer, 1)
        writer.commit()
        log = rigapp.open(writer.path).events
    assert log["text"].values.tolist() == ["ä" * 700]
    assert str(log["time"].values[0])[:19] == "2027-01-15T08:00:00"


def test_what_a_test_was_made_with_is_there(ended: Path) -> None:
    test = rigapp.open(ended)
    assert "PTFE, dry" in test.configuration["test"]
    assert test.calibration["load_cell"]["frame"] == "crank"
    assert test.info["specimen"] == "PTFE 1"
    assert repr(test) == f"<rigapp test 'PTFE, dry': {ended}, stopped>"


def test_even_cycles_are_the_cycles_on_even_angles(ended: Path) -> None:
    test = rigapp.open(ended)
    even = test.even_cycles(960)
    np.testing.assert_allclose(even["angle"], np.arange(960) * 0.375)
    one, other = even.sel(revolution=40), test.cycle(40)
    np.testing.assert_allclose(one["force_1"], other["force_1"], rtol=1e-6)
    np.testing.assert_allclose(
        one["force"], np.hypot(other["force_1"], other["force_2"]), rtol=1e-6
    )
    assert one["force"].attrs["units"] == "N"


@pytest.mark.long
def test_many_tests_are_one_table_and_long_datasets(ended: Path, compressed: Path) -> None:
    broken = ended.with_name("broken.h5")
    broken.write_bytes(b"no test")
    tests = rigapp.open_many(ended.parent / "*.h5")
    table = tests.table
    assert table["test"].values.tolist() == ["broken", "compressed", "eventful"]
    assert table["status"].values.tolist() == ["not readable", "stopped", "stopped"]
    assert "not an HDF5 file" in str(table["reason"].sel(test="broken").values)
    assert table["force_max"].attrs["units"] == "N"
    assert str(table["started"].sel(test="eventful").values)[:16] == "2027-01-15T08:00"
    assert np.isnat(table["started"].sel(test="broken").values)
    assert len(tests) == 2
    assert tests.status == {
        "broken": "not readable", "compressed": "stopped", "eventful": "stopped",
    }  # fmt: skip
    for group, rows in {
        **dict.fromkeys(GROUPS, "revolution"),
        "cycles": "sample",
        "events": "event",
    }.items():
        joined = getattr(tests, group)
        assert joined.sizes[rows] == 2 * getattr(tests[0], group).sizes[rows]
        assert set(np.unique(joined["test"])) <= {"compressed", "eventful"}
    largest = tests.revolutions["force_max"].groupby("test").max()
    assert largest.sizes == {"test": 2}
    with pytest.raises(UnusableInput, match="there are no such files"):
        rigapp.open_many(str(ended.parent / "*.none"))


def test_what_is_no_test_is_refused_in_a_sentence(tmp_path: Path, ended: Path) -> None:
    with pytest.raises(UnusableInput, match="there is no such file"):
        rigapp.open(tmp_path / "none.h5")
    with pytest.raises(UnusableInput, match="1 or more"):
        rigapp.open(ended, chunks=0)
    with pytest.raises(UnusableInput, match="there is no such group"):
        xarray.open_dataset(ended, engine=RigappBackend, group="rows")


def test_xarray_knows_the_engine_by_name(ended: Path) -> None:
    with xarray.open_dataset(ended, engine="rigapp", drop_variables="speed") as data:
        assert data.sizes["revolution"] == 295
        assert "speed" not in data


@pytest.mark.sampled
@pytest.mark.parametrize("name", ["force", "extrema", "overlay", "wear"])
def test_each_picture_is_one_line(ended: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MPLBACKEND", "agg")
    from matplotlib import pyplot

    figure = getattr(rigapp.open(ended).plot, name)()
    try:
        assert all(axes.get_lines() for axes in figure.axes)
        figure.canvas.draw()
    finally:
        pyplot.close(figure)
    assert not pyplot.get_fignums()


def test_what_a_file_does_not_hold_is_not_drawn(ended: Path) -> None:
    test = rigapp.open(ended)
    with pytest.raises(UnusableInput, match="does not hold a worn profile"):
        test.plot.profile()
    with pytest.raises(UnusableInput, match="revolution 41 no whole cycle"):
        test.plot.overlay(41)
    with pytest.raises(UnusableInput, match="forse: no such channel"):
        test.plot.overlay(40, channel="forse")


def test_the_door_opens_quickly_and_its_names_are_there() -> None:
    script = "import json, sys, rigapp; print(json.dumps(sorted(sys.modules)))"
    loaded = json.loads(subprocess.check_output([sys.executable, "-c", script]))
    assert not {"numpy", "xarray", "h5py", "model", "matplotlib"} & set(loaded)
    for module in (rigapp, rigapp.model, rigapp.calibration):
        assert all(hasattr(module, name) for name in module.__all__)
    assert rigapp.__version__ == importlib.metadata.version("rigapp")
    with pytest.raises(AttributeError, match="no attribute 'opne'"):
        rigapp.opne  # noqa: B018
