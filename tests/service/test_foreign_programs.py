"""The file of a real test opens whole in programs that know netCDF, CF and NeXus, at any moment."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

import h5py
import netCDF4
import numpy as np
import pytest
import xarray
from stories import NEVER_OVER, RIG, Running, recipe

from rigapp.schema.loglines import alarm_change, rest_signals
from rigapp.schema.messages import Flag
from rigapp.storage import compact_test, open_test, reopen_test
from rigapp.storage.structure.hdf import is_bare

RULE = '\n[[limits.rule]]\nquantity = "force_max"\nwarning_above = 1.0\n'
ENGINES = ("h5netcdf", "netcdf4")
pytestmark = pytest.mark.long  # one whole rig; what a file holds is tested without one

FORMS = (pytest.param("interrupted", marks=pytest.mark.long), "stopped", "compact")
"""Of one test: as a kill leaves it, ended, and made smaller afterwards."""


@pytest.fixture(scope="module")
def tests(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Return the file of one real test by its form; while it ran it was looked at too."""
    folder = tmp_path_factory.mktemp("foreign")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("RIGAPP_RUNTIME_DIR", str(folder / "run"))
        plan = recipe(folder, NEVER_OVER, twin=True, every=20)
        plan.write_text(plan.read_text(encoding="utf-8") + RULE, encoding="utf-8")
        path = folder / "interrupted.h5"
        test = Running("run", plan, "--rig", RIG, "--out", path)
        try:
            test.wait_for(lambda: path.exists() and worn(path), "the twin kept its state")
            assert_opens(path)
            test.kill()
        finally:
            test.close()
    stopped, compact = folder / "stopped.h5", folder / "compact.h5"
    for copy in (stopped, compact):
        subprocess.run(["cp", "--sparse=always", path, copy], check=True)
        with reopen_test(copy) as writer:
            writer.finish("stopped", "operator", "stopped by the operator")
    compact_test(compact)
    return {"interrupted": path, "stopped": stopped, "compact": compact}


def worn(path: Path) -> bool:
    """Tell whether a file has cycles, curves, a profile, alarms and a checkpoint."""
    with open_test(path) as reader:
        streams = ("revolutions", "cycles", "curves", "profiles", "events")
        return all(reader.committed(name) for name in streams) and bool(reader.checkpoint())


def groups_of(path: Path) -> list[str]:
    """Return all groups of a file."""
    found = ["/"]

    def note(name: str, item: Any) -> None:
        if isinstance(item, h5py.Group):
            found.append(f"/{name}")

    with h5py.File(path, "r") as file:
        file.visititems(note)
    return found


def assert_opens(path: Path) -> None:
    """Open every group and the whole tree by each engine, and look at each variable."""
    groups = groups_of(path)
    assert {"/entry/prediction", "/entry/events", "/entry/instrument/load_cell"} <= set(groups)
    for engine in ENGINES:
        for group in groups:
            with xarray.open_dataset(path, group=group, engine=engine) as data:
                data.isel({name: slice(0, 3) for name in data.dims}).load()
        with xarray.open_datatree(path, engine=engine) as tree:
            assert tree["entry/prediction/checkpoint_state"].dims == (
                "checkpoint",
                "checkpoint_byte",
            )
    with netCDF4.Dataset(path) as root:
        assert "force_max" in root["/entry/revolutions"].variables


@pytest.mark.parametrize("form", FORMS)
def test_every_group_opens_by_both_engines(tests: dict[str, Path], form: str) -> None:
    assert_opens(tests[form])


@pytest.mark.parametrize("form", FORMS)
def test_values_times_and_flags_are_those_of_the_reader(tests: dict[str, Path], form: str) -> None:
    path = tests[form]
    with open_test(path) as reader:
        force, times = reader.column("force_max"), reader.column("host_time")
        quality, curves = reader.column("quality"), reader.committed("curves")
    for engine in ENGINES:
        with xarray.open_dataset(path, group="/entry/revolutions", engine=engine) as data:
            safe = data.isel(revolution=slice(int(data.committed)))
            np.testing.assert_array_equal(safe.force_max, force)
            ours = safe.host_time.values.astype("datetime64[us]").astype(np.int64) * 1e-6
            np.testing.assert_allclose(ours, times, atol=2e-6, rtol=0)
            masks, names = quality_words(safe.quality)
            assert dict(zip(names, masks, strict=True)) == {f.name.lower(): f for f in Flag}
            assert masks.dtype == safe.quality.dtype
            assert safe.quality.values.tolist() == quality.tolist()
            assert safe.force_1_max.attrs["detector"] == "/entry/instrument/load_cell"
        with xarray.open_dataset(path, group="/entry/prediction", engine=engine) as data:
            kept = data.curve_force.isel(curve_revolution=slice(curves))
            assert kept.sizes == {"curve_revolution": curves, "angle": 360}
            assert np.isfinite(kept).all()
            assert "detector" not in data.force_max.attrs


def quality_words(quality: xarray.DataArray) -> tuple[np.ndarray[Any, Any], list[str]]:
    """Return masks and names of the flags of a variable."""
    return quality.attrs["flag_masks"], quality.attrs["flag_meanings"].split()


@pytest.mark.parametrize("form", FORMS)
def test_every_number_says_what_it_is(tests: dict[str, Path], form: str) -> None:
    bare: list[str] = []

    def look(name: str, item: Any) -> None:
        if not isinstance(item, h5py.Dataset) or item.dtype.kind not in "iuf" or is_bare(item):
            return
        if not (item.attrs.get("long_name") and item.attrs.get("units")):
            bare.append(name)

    with h5py.File(tests[form], "r") as file:
        file.visititems(look)
        assert bare == []
        assert file["/entry/calibration/load_cell/zero_mV_per_V"].attrs["long_name"] == "zero"
        for name in ("load_cell", "probes", "encoder"):
            detector = file[f"/entry/instrument/{name}"]
            assert detector.attrs["NX_class"] == "NXdetector"
            assert detector["calibration"].asstr()[()] in file
        assert file["/entry/instrument/load_cell/full_scale_N"].attrs["units"] == "N"
        doubt = file[file["/entry/revolutions/force_1_mean"].attrs["uncertainty"]]
        # This rig states no uncertainty; the noise of its samples (0.7 N, steps of 2 N) is seen.
        assert np.isnan(doubt["constant_N"][()])
        assert 0.55 < doubt["noise_N"][()] < 2.0


def test_a_file_knows_its_name(tests: dict[str, Path]) -> None:
    with h5py.File(tests["interrupted"], "r") as file:
        assert file.attrs["file_name"] == "interrupted.h5"
    with h5py.File(tests["compact"], "r") as file:
        assert file.attrs["rigapp_form"] == "compressed"
        assert file.attrs["file_name"] == "compact.h5"


def test_the_log_of_a_real_test_is_read_without_its_sentences(tests: dict[str, Path]) -> None:
    with open_test(tests["compact"]) as reader:
        events = reader.events()
        assert reader.first_altered_event() is None
        assert set(reader.calibration()["load_cell"]).isdisjoint({"row_2", "element_2"})
    raised = [one for one in events if one.key == "rule:force_max:warning:above"]
    change = alarm_change(raised[0])
    assert change is not None
    assert (change.what, raised[0].level) == ("raised", "warning")
    assert change.consequence == "The test continues."
    assert any(rest_signals(one) is not None for one in events)
    with h5py.File(tests["compact"], "r") as file:
        texts = file["/entry/events/data"].asstr()[:]
    whole = [json.loads(text) for text in texts if text.startswith("{") and text.endswith("}")]
    assert whole
