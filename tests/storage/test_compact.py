"""The compressed copy is the same test, and nothing on the way to it can cost the original."""

from __future__ import annotations

import signal
import stat
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
import pytest
from patience import PATIENCE_S
from storage_samples import METADATA, PLAN, check, ended, new_test, write

from rigapp.config.errors import UnusableInput
from rigapp.storage import (
    StorageFailed,
    compact_test,
    create_test,
    open_test,
    reopen_test,
    settle_in_background,
)
from rigapp.storage.upkeep import compact as compact_module


@pytest.mark.sampled
@pytest.mark.parametrize("revolutions", [0, 1, 9, 150])
def test_compressed_file_is_the_same_test(quick_folder: Path, revolutions: int) -> None:
    path = ended(quick_folder, revolutions)
    with open_test(path) as reader:
        before = (reader.summary(), reader.metadata(), reader.configuration(), reader.calibration())
        events = reader.events()
    size = path.stat().st_size
    assert compact_test(path)
    with open_test(path) as reader:
        assert reader.compressed
        after = (reader.summary(), reader.metadata(), reader.configuration(), reader.calibration())
        assert after == before
        assert reader.events() == events
        assert reader.first_altered_event() is None
        assert check(reader) == revolutions
        assert reader.column("revolution").size == revolutions
    assert path.stat().st_size < size / 4
    assert stat.S_IMODE(path.stat().st_mode) == 0o444
    assert not compact_test(path)
    assert {one.name for one in quick_folder.iterdir()} - {"test.h5.seal.json"} == {"test.h5"}


def test_finished_columns_are_trimmed_portable_and_keep_their_scales(quick_folder: Path) -> None:
    path = ended(quick_folder)
    compact_test(path)
    with h5py.File(path) as file:
        force = file["/entry/revolutions/force_max"]
        assert force.shape == (150,)
        assert (force.compression, force.shuffle) == ("gzip", True)
        assert force.attrs["units"] == "N"
        assert force.dims[0][0].name == "/entry/revolutions/revolution"
        assert file["/entry/prediction/curve_force"].dims[1][0].name == "/entry/prediction/angle"
        assert file.attrs["default"] == "entry"
        first, count = file["/entry/cycles/first"][-1], file["/entry/cycles/count"][-1]
        assert file["/entry/cycles/force"].shape == (first + count,)


@pytest.mark.sampled
@pytest.mark.parametrize("revolutions", [0, 150])
def test_xarray_opens_the_finished_file(quick_folder: Path, revolutions: int) -> None:
    import xarray

    path = ended(quick_folder, revolutions)
    compact_test(path)
    with xarray.open_dataset(path, group="/entry/revolutions", engine="h5netcdf") as data:
        assert data.force_max.sizes == {"revolution": revolutions}
    with xarray.open_dataset(path, group="/entry/cycles", engine="h5netcdf") as data:
        assert data.sizes["revolution"] == revolutions // 10
        assert data.force.dims == ("sample",)
    with xarray.open_dataset(path, group="/entry/prediction", engine="h5netcdf") as data:
        assert data.curve_force.sizes == {"curve_revolution": revolutions // 10, "angle": 360}


def test_running_and_interrupted_tests_are_not_compressed(quick_folder: Path) -> None:
    with new_test(quick_folder) as writer:
        write(writer, 1, 3)
        with pytest.raises(UnusableInput, match="the test is running"):
            compact_test(writer.path)
    with pytest.raises(UnusableInput, match="the test is interrupted"):
        compact_test(quick_folder / "test.h5")


def test_a_writer_that_has_not_closed_keeps_its_file(quick_folder: Path) -> None:
    with new_test(quick_folder) as writer:
        writer.finish("stopped", "operator", "stop button")
        with pytest.raises(UnusableInput, match="another process is writing"):
            compact_test(writer.path)


def test_a_copy_that_reads_back_differently_is_thrown_away(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = ended(quick_folder)
    honest = compact_module.write_duplicate

    def flip_a_bit(source: Path, target: Path, sizes: dict[str, int]) -> None:
        honest(source, target, sizes)
        with h5py.File(target, "r+") as file:
            file["/entry/cycles/force"][17] += 1.0

    monkeypatch.setattr(compact_module, "write_duplicate", flip_a_bit)
    with pytest.raises(StorageFailed, match="differs at /entry/cycles/force"):
        compact_test(path)
    with open_test(path) as reader:
        assert not reader.compressed
        assert check(reader) == 150
    assert {one.name for one in quick_folder.iterdir()} - {"test.h5.seal.json"} == {"test.h5"}


def test_too_little_room_for_the_copy_leaves_the_original(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = ended(quick_folder)
    monkeypatch.setattr("rigapp.storage.filesystem.folder.SPACE_MARGIN", 1 << 60)
    with pytest.raises(UnusableInput, match="MB are missing"):
        compact_test(path)
    with open_test(path) as reader:
        assert check(reader) == 150


STEPS = ("write_duplicate", "_sync_file", "first_difference", "FILES.sync_folder")
KILLED_AT = """
import os, signal, sys
from rigapp.storage.upkeep import compact
*owners, name = sys.argv[2].split(".")
owner = getattr(compact, owners[0]) if owners else compact
honest = getattr(owner, name)
def die(*arguments):
    if sys.argv[3] == "after": honest(*arguments)
    os.kill(os.getpid(), signal.SIGKILL)
setattr(owner, name, die)
compact.compact_test(sys.argv[1])
"""


@pytest.mark.sampled
@pytest.mark.parametrize("moment", [pytest.param("before", marks=pytest.mark.long), "after"])
@pytest.mark.parametrize("step", STEPS)
def test_killed_on_the_way_the_file_is_whole(quick_folder: Path, step: str, moment: str) -> None:
    path = ended(quick_folder)
    done = subprocess.run([sys.executable, "-c", KILLED_AT, path, step, moment], timeout=PATIENCE_S)
    assert done.returncode == -signal.SIGKILL
    with open_test(path) as reader:
        assert check(reader) == 150
        assert reader.summary()["status"] == "complete"
    compact_test(path)
    with open_test(path) as reader:
        assert reader.compressed
        assert check(reader) == 150
    assert {one.name for one in quick_folder.iterdir()} - {"test.h5.seal.json"} == {"test.h5"}


@pytest.mark.long
def test_background_process_does_it_while_a_reader_has_the_file_open(quick_folder: Path) -> None:
    path = ended(quick_folder)
    with open_test(path) as old:
        process = settle_in_background(path)
        assert process.wait(timeout=PATIENCE_S) == 0
        process.close()
        assert check(old) == 150
    with open_test(path) as reader:
        assert reader.compressed
        assert check(reader) == 150


def test_compressed_stopped_test_is_not_resumed(quick_folder: Path) -> None:
    path = ended(quick_folder, status="stopped")
    compact_test(path)
    with pytest.raises(UnusableInput, match="compressed; begin a new test"):
        reopen_test(path)
    with open_test(path) as reader:
        np.testing.assert_array_equal(reader.column("revolution", 148), [149, 150])


def test_settings_that_are_not_known_are_no_difference(quick_folder: Path) -> None:
    about = replace(METADATA, calibration={"cell": {"constant_N": float("nan"), "lines": ["a"]}})
    path = quick_folder / "test.h5"
    with create_test(path, PLAN, about) as writer:
        write(writer, 1, 20)
        writer.finish("stopped", "operator", "done")
    assert compact_test(path)
    with open_test(path) as reader:
        assert np.isnan(reader.calibration()["cell"]["constant_N"])
        assert reader.calibration()["cell"]["lines"] == ["a"]
