"""What other programs read of the rows that a running or killed test has not written yet."""

from __future__ import annotations

import os
import shutil
import threading
from pathlib import Path

import h5py
import numpy as np
import pytest
import xarray
from patience import PATIENCE_S
from storage_samples import METADATA, PLAN, check, ended, new_test, row, write

from rigapp.storage import FilePlan, create_test, open_test, reopen_test
from rigapp.storage.structure.layout import AHEAD, streams_of
from rigapp.storage.writing import writer as writer_module
from rigapp.storage.writing.create import lengths_of

LONG = FilePlan(revolutions=60_000, cycles=40, samples_per_cycle=50, events=256, checksums=True)
FORCE = PLAN.revolution_columns.index(
    next(one for one in PLAN.revolution_columns if one.name == "force_max")
)


def killed(folder: Path, revolutions: int = 150, plan: FilePlan = LONG) -> Path:
    """Return the file of a test whose writer was killed after its last commit."""
    with new_test(folder, plan) as writer:
        write(writer, 1, revolutions)
        writer.commit()
        shutil.copy(writer.path, folder / "killed.h5")
    return folder / "killed.h5"


def mean_force(revolutions: int) -> float:
    return float(np.mean([row(one)[FORCE] for one in range(1, revolutions + 1)]))


@pytest.mark.sampled
@pytest.mark.parametrize("engine", ["h5netcdf", "netcdf4"])
def test_means_of_a_killed_test_are_those_of_its_rows(quick_folder: Path, engine: str) -> None:
    path = killed(quick_folder)
    rows = xarray.open_dataset(path, group="/entry/revolutions", engine=engine)
    assert float(rows.force_max.mean()) == pytest.approx(mean_force(150))
    assert int(rows.force_max.count()) == 150
    cycles = xarray.open_dataset(path, group="/entry/cycles", engine=engine)
    with open_test(path) as reader:
        samples = np.concatenate([one.columns["force"] for one in reader.cycles()])
    assert float(cycles.force.mean()) == pytest.approx(float(samples.mean()))
    model = xarray.open_dataset(path, group="/entry/prediction", engine=engine)
    assert int(model.force_max.count()) == 150
    assert int(model.curve_force.count()) == 15 * LONG.prediction_points


def test_plain_hdf5_finds_no_number_that_nobody_measured(quick_folder: Path) -> None:
    with h5py.File(killed(quick_folder)) as file:
        force = file["/entry/revolutions/force_max"]
        assert 150 < len(force) <= 150 + AHEAD["revolutions"]
        assert np.isnan(force[150:]).all()
        assert len(file["/entry/cycles/revolution"]) == 15
        assert (file["/entry/cycles/force"][:] != 0.0).all()


def test_an_ended_test_shows_its_rows_and_no_more(quick_folder: Path) -> None:
    path = ended(quick_folder, 60)
    with h5py.File(path) as file:
        assert len(file["/entry/revolutions/force_max"]) == 60
        assert len(file["/entry/prediction/curve_force"]) == 6
        assert len(file["/entry/events/time"]) == file["/entry/events/committed"][()]
        force = file["/entry/revolutions/force_max"][:]
        assert force.mean() == pytest.approx(mean_force(60))


def test_rows_that_come_while_another_thread_commits_stay(quick_folder: Path) -> None:
    done = threading.Event()
    with new_test(quick_folder, LONG) as writer:

        def commit() -> None:
            while not done.is_set():
                writer.commit()

        committer = threading.Thread(target=commit)
        committer.start()
        try:
            write(writer, 1, 6_000, every=1000)
        finally:
            done.set()
            committer.join(PATIENCE_S)
        writer.commit()
        with open_test(writer.path) as reader:
            assert check(reader, every=1000) == 6_000


def test_a_reader_that_stays_open_reads_what_comes_later(quick_folder: Path) -> None:
    with new_test(quick_folder, LONG) as writer:
        write(writer, 1, 10)
        writer.commit()
        with open_test(writer.path) as reader:
            assert check(reader) == 10
            write(writer, 11, 6000, every=500)
            writer.commit()
            assert reader.column("revolution")[-1] == 6000
            assert [one.revolution for one in reader.cycles()][-1] == 6000


def test_a_resumed_test_goes_on_behind_its_rows(quick_folder: Path) -> None:
    path = killed(quick_folder)
    with reopen_test(path) as writer:
        write(writer, 151, 5000)
        writer.finish("stopped", "operator", "enough")
    with h5py.File(path) as file:
        assert len(file["/entry/revolutions/force_max"]) == 5000
    with open_test(path) as reader:
        assert check(reader) == 5000


def test_a_file_that_shows_all_its_rows_goes_on(quick_folder: Path) -> None:
    """So are files of versions before."""
    path = killed(quick_folder)
    path.chmod(0o644)
    with h5py.File(path) as file:
        longest = {
            name: file[one.path(one.fields[0].name)].maxshape[0]
            for name, one in streams_of(LONG).items()
        }
    places = lengths_of(path, streams_of(LONG))
    fd = os.open(path, os.O_WRONLY)
    for name, lengths in places.items():
        for place in lengths:
            os.pwrite(fd, longest[name].to_bytes(8, "little"), place)
    os.close(fd)
    with reopen_test(path) as writer:
        write(writer, 151, 160)
        writer.commit()
        with open_test(path) as reader:
            assert check(reader) == 160
        with h5py.File(path) as file:
            assert len(file["/entry/revolutions/force_max"]) < longest["revolutions"]


def test_where_lengths_are_not_found_all_rows_are_shown(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(writer_module, "lengths_of", lambda path, streams: {})
    with create_test(quick_folder / "test.h5", LONG, METADATA) as writer:
        write(writer, 1, 30)
        writer.finish("stopped", "operator", "enough")
    with open_test(quick_folder / "test.h5") as reader:
        assert check(reader) == 30
    with h5py.File(quick_folder / "test.h5") as file:
        assert len(file["/entry/revolutions/force_max"]) > LONG.revolutions
