"""A file is made whole or not at all, and never over another one."""

from __future__ import annotations

import os
import resource
import stat
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import h5py
import pytest
from patience import PATIENCE_S
from storage_samples import METADATA, PLAN, new_test, write

from rigapp.config.errors import UnusableInput
from rigapp.storage import FilePlan, TestWriter, create_test, open_test, reserved_bytes, streams_of
from rigapp.storage.filesystem.folder import SPACE_MARGIN
from rigapp.storage.writing import create as create_module
from rigapp.storage.writing.create import places_of

NOBODY = 65534


def names(folder: Path) -> list[str]:
    """Return the names in a folder, hidden ones included."""
    return sorted(one.name for one in folder.iterdir())


def test_existing_file_is_never_overwritten(quick_folder: Path) -> None:
    path = quick_folder / "test.h5"
    path.write_text("precious")
    with pytest.raises(UnusableInput, match=r"test\.h5: the file exists and is not overwritten"):
        new_test(quick_folder)
    assert path.read_text() == "precious"
    path.unlink()
    path.symlink_to(quick_folder / "nowhere")
    with pytest.raises(UnusableInput, match="exists"):
        new_test(quick_folder)


def test_file_that_appears_meanwhile_is_not_overwritten(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = quick_folder / "test.h5"
    honest = create_module.check_places

    def another_comes_first(*arguments: object) -> None:
        honest(*arguments)  # type: ignore[arg-type]
        path.write_text("precious")

    monkeypatch.setattr(create_module, "check_places", another_comes_first)
    with pytest.raises(UnusableInput, match="exists and is not overwritten"):
        new_test(quick_folder)
    assert path.read_text() == "precious"
    assert names(quick_folder) == ["test.h5"]


def test_missing_folder_is_named(quick_folder: Path) -> None:
    with pytest.raises(UnusableInput, match=r"the folder .*/none does not exist"):
        create_test(quick_folder / "none" / "test.h5", PLAN, METADATA)


def test_read_only_folder_is_named(quick_folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "access", lambda path, mode: mode & os.W_OK == 0)
    with pytest.raises(UnusableInput, match="cannot be written to"):
        new_test(quick_folder)


def test_too_little_space_is_refused_beforehand_naming_the_missing_megabytes(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    plan = FilePlan(revolutions=1000, cycles=100, samples_per_cycle=10_000)
    needed = reserved_bytes(streams_of(plan).values())
    free = os.statvfs(quick_folder)
    blocks = (needed // 2) // free.f_frsize
    values = list(free)
    values[4] = blocks
    monkeypatch.setattr(os, "statvfs", lambda _: os.statvfs_result(values))
    missing = create_module.STRUCTURE_BYTES + SPACE_MARGIN + needed
    missing -= blocks * free.f_frsize
    with pytest.raises(UnusableInput, match=rf"; {missing / 1e6:.1f} MB are missing"):
        new_test(quick_folder, plan)
    assert names(quick_folder) == []


@pytest.fixture
def files_up_to_one_megabyte() -> Iterator[None]:
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 20, before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.mark.usefixtures("files_up_to_one_megabyte")
def test_limit_of_file_size_is_refused_beforehand(quick_folder: Path) -> None:
    with pytest.raises(UnusableInput, match=r"files of 1 MB; \d+\.\d MB are missing"):
        new_test(quick_folder)
    assert names(quick_folder) == []


@pytest.mark.usefixtures("files_up_to_one_megabyte")
def test_disk_that_fills_while_the_file_is_made_leaves_nothing(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(create_module, "refuse_bad_target", lambda *_: None)
    with pytest.raises(UnusableInput, match=r"test\.h5: .*\(File too large\)"):
        new_test(quick_folder)
    assert names(quick_folder) == []


def test_reserved_room_is_really_reserved_and_the_spare_room_is_not(tmp_path: Path) -> None:
    plan = FilePlan(revolutions=20_000, cycles=100, samples_per_cycle=1000)
    with new_test(tmp_path, plan) as writer:
        info = writer.path.stat()
        needed = reserved_bytes(streams_of(plan).values())
        assert info.st_blocks * 512 >= needed
        assert info.st_blocks * 512 < needed * 1.1 + (1 << 20)
        assert info.st_size > needed * 1.5


def test_offsets_that_do_not_hold_stop_the_test_before_it_starts(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def shifted(path: Path) -> dict[str, tuple[int, int]]:
        places = places_of(path)
        offset, length = places["/entry/revolutions/force_max"]
        return {**places, "/entry/revolutions/force_max": (offset + 8, length)}

    monkeypatch.setattr(create_module, "places_of", shifted)
    with pytest.raises(UnusableInput, match="force_max row 0 is not where HDF5 reports"):
        new_test(quick_folder)
    assert names(quick_folder) == []


def test_leftovers_of_a_killed_creation_go(quick_folder: Path) -> None:
    gone = subprocess.Popen([sys.executable, "-c", ""])
    gone.wait()
    (quick_folder / f".test.h5.new-{gone.pid}").write_text("left")
    with subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE) as other:
        alive = quick_folder / f".test.h5.new-{other.pid}"
        alive.write_text("of another process")
        new_test(quick_folder).close()
        assert names(quick_folder) == [alive.name, "test.h5"]
        other.communicate(b"\n")


# ------------------------------------------------------------------ readers and intruders meanwhile


@pytest.fixture
def running(quick_folder: Path) -> Iterator[TestWriter]:
    """Return the writer of a running test with 100 safe revolutions."""
    with new_test(quick_folder) as writer:
        write(writer, 1, 100)
        writer.commit()
        yield writer


def test_file_is_write_protected_and_found_running(running: TestWriter) -> None:
    assert stat.S_IMODE(running.path.stat().st_mode) == 0o444
    code = "import sys; from rigapp.storage import open_test as o; print(o(sys.argv[1]).summary())"
    done = subprocess.run(
        [sys.executable, "-c", code, running.path],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
    )
    assert "'status': 'running'" in done.stdout, done.stderr


def test_plain_h5py_reads_it_with_its_own_locking(running: TestWriter) -> None:
    with h5py.File(running.path) as file:
        entry = file[file.attrs["default"]]
        data = entry[entry.attrs["default"]]
        safe = data["committed"][()]
        assert data[data.attrs["axes"][0]][:safe].tolist() == list(range(1, 101))
        assert data[data.attrs["signal"]].attrs["units"] == "N"
        write(running, 101, 120)
        running.commit()
    with h5py.File(running.path) as file:
        assert file["/entry/revolutions/committed"][()] == 120


@pytest.mark.parametrize("locking", [None, False, True])
def test_one_program_may_have_it_open_in_several_ways(
    running: TestWriter, locking: bool | None
) -> None:
    with h5py.File(running.path, "r", locking=locking), open_test(running.path) as reader:
        assert reader.committed() == 100
    with open_test(running.path) as reader, h5py.File(running.path, "r") as file:
        assert file["/entry/revolutions/committed"][()] == reader.committed()


def test_xarray_gets_named_dimensions(running: TestWriter) -> None:
    import xarray

    with xarray.open_dataset(running.path, group="/entry/revolutions", engine="h5netcdf") as data:
        safe = int(data.committed)
        assert data.force_max.dims == ("revolution",)
        assert data.force_max[:safe].sizes == {"revolution": 100}
    with xarray.open_dataset(running.path, group="/entry/cycles", engine="h5netcdf") as data:
        first, count = int(data["first"][3]), int(data["count"][3])
        assert data.force[first : first + count].dims == ("sample",)
        assert set(data.sizes) == {"sample", "revolution"}
    with xarray.open_dataset(running.path, group="/entry/prediction", engine="h5netcdf") as data:
        assert data.curve_force.dims == ("curve_revolution", "angle")
    with xarray.open_dataset(running.path, group="/entry/events", engine="h5netcdf") as data:
        assert data.text.dims == ("event",)


def test_h5dump_reads_it(running: TestWriter) -> None:
    try:
        done = subprocess.run(
            ["h5dump", "-H", running.path], capture_output=True, text=True, timeout=PATIENCE_S
        )
    except FileNotFoundError:
        pytest.skip("h5dump is not installed")
    assert done.returncode == 0, done.stderr
    assert 'DATASET "force_max"' in done.stdout


def test_hdf5_refuses_to_open_it_for_writing(running: TestWriter) -> None:
    code = "import h5py, sys; h5py.File(sys.argv[1], 'r+')"
    done = subprocess.run(
        [sys.executable, "-c", code, running.path],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
    )
    assert done.returncode != 0
    assert "unable to lock file" in done.stderr or "Permission denied" in done.stderr


def test_an_ordinary_user_cannot_truncate_it(running: TestWriter) -> None:
    if os.geteuid() == 0:
        running.path.parent.chmod(0o755)
        as_user = {"user": NOBODY, "group": NOBODY}
    else:
        as_user = {}
    done = subprocess.run(
        ["sh", "-c", ': > "$0"', running.path], capture_output=True, timeout=PATIENCE_S, **as_user
    )
    assert done.returncode != 0
    with open_test(running.path) as reader:
        assert reader.committed() == 100


# ------------------------------------------------------------------------- files that are not tests


def refused(path: Path) -> str:
    """Return the sentence with which a file is refused."""
    with pytest.raises(UnusableInput) as caught:
        open_test(path)
    sentence = str(caught.value)
    assert sentence.startswith(f"{path}: ")
    assert "\n" not in sentence
    return sentence


def test_files_that_cannot_be_read_are_refused_in_one_sentence(quick_folder: Path) -> None:
    path = quick_folder / "odd.h5"
    assert "no such file" in refused(path)
    assert "a folder" in refused(quick_folder)
    path.write_bytes(b"")
    assert "the file is empty" in refused(path)
    path.write_text("time,force\n1,2\n")
    assert "not an HDF5 file" in refused(path)
    path.unlink()
    h5py.File(path, "w").close()
    assert "is not a test" in refused(path)


def test_truncated_damaged_and_future_files_are_refused(quick_folder: Path) -> None:
    new_test(quick_folder).close()
    whole = (quick_folder / "test.h5").read_bytes()
    path = quick_folder / "odd.h5"
    for length in (100, 5000, len(whole) // 2, len(whole) - 1):
        path.write_bytes(whole[:length])
        assert "cut short" in refused(path) or "not an HDF5" in refused(path)
    path.write_bytes(whole)
    with h5py.File(path, "r+") as file:
        file.attrs["rigapp_schema"] = 7
    assert "has schema 7 and this version reads up to 1" in refused(path)
    path.write_bytes(whole)
    with h5py.File(path, "r+") as file:
        file["/entry/configuration/plan"][()] = "{"
    assert "damaged" in refused(path)
