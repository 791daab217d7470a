"""Whatever is damaged in a file, a reader gets its data or one sentence with the file's name."""

from __future__ import annotations

import random
import time
from pathlib import Path

import h5py
import pytest
from patience import PATIENCE_S
from storage_samples import ended, new_test, write

from rigapp.commands.window import replay_file
from rigapp.config.errors import UnusableInput
from rigapp.replay.client import ReplayClient
from rigapp.storage import TestReader, compact_test, export_test, open_test, reopen_test

STREAMS = ("revolutions", "cycles", "samples", "prediction", "curves", "profiles", "events")


def read_all(reader: TestReader) -> None:
    """Ask for everything that a file holds."""
    reader.summary(), reader.metadata(), reader.configuration(), reader.calibration()
    reader.events(), reader.profiles(), reader.checkpoint(), reader.unfinished()
    list(reader.cycles()), reader.cycle_reasons(), reader.cycle_qualities(), list(reader.texts())
    for stream in filter(reader.has, STREAMS):
        for one in reader.variables(stream):
            reader.column(one.name, stream=stream)


def told(path: Path) -> str:
    """Return the sentence with which a damaged file is refused, or that it is read."""
    try:
        with open_test(path) as reader:
            read_all(reader)
    except UnusableInput as error:
        return str(error)
    return f"{path}: read"


@pytest.mark.parametrize("number", [8, pytest.param(40, marks=pytest.mark.long)])
def test_a_damaged_byte_anywhere_is_told_with_the_files_name(
    quick_folder: Path, number: int
) -> None:
    path = ended(quick_folder, 30)
    compact_test(path)
    whole = path.read_bytes()
    filled = [place for place in range(len(whole)) if whole[place]]
    chance, copy, sentences = random.Random(1), quick_folder / "copy.h5", []
    for place in chance.sample(filled, number):
        copy.write_bytes(whole[:place] + bytes([whole[place] ^ 0x41]) + whole[place + 1 :])
        sentences.append(told(copy))
    assert all(one.startswith(f"{copy}: ") for one in sentences)
    assert sum("is damaged" in one for one in sentences) >= number // 4


@pytest.mark.parametrize("counter", ["revolutions/committed", "cycles/committed"])
@pytest.mark.parametrize("rows", [10**6, -3])
def test_more_safe_rows_than_there_can_be_are_damage(
    quick_folder: Path, counter: str, rows: int
) -> None:
    path = ended(quick_folder, 30)
    path.chmod(0o644)
    with h5py.File(path, "r+") as file:
        file[f"/entry/{counter}"][...] = rows
    assert "is damaged" in told(path)


def test_rows_that_were_never_written_are_no_revolutions(quick_folder: Path) -> None:
    with new_test(quick_folder) as writer:
        write(writer, 1, 30)
    path = quick_folder / "test.h5"
    path.chmod(0o644)
    with h5py.File(path, "r+") as file:
        file["/entry/revolutions/committed"][...] = 46
    with open_test(path) as reader, pytest.raises(UnusableInput, match="is damaged"):
        reader.summary()


def test_an_export_of_a_damaged_file_blames_the_file_that_is_damaged(quick_folder: Path) -> None:
    path = ended(quick_folder, 30)
    compact_test(path)
    with h5py.File(path) as file:
        place = file["/entry/revolutions/force_max"].id.get_chunk_info(0).byte_offset
    spoil(path, place + 20, b"\xff\x00\xff\x00")
    with pytest.raises(UnusableInput, match=f"{path}: the file is damaged, .*/force_max"):
        export_test(path, quick_folder / "table.csv")
    assert not (quick_folder / "table.csv").exists()


def place_of(path: Path, dataset: str) -> tuple[int, int]:
    """Return where a dataset's header and its data begin in a file."""
    with h5py.File(path) as file:
        found = file[dataset].id
        return h5py.h5o.get_info(found).addr, found.get_offset()


def spoil(path: Path, place: int, with_bytes: bytes) -> None:
    """Write bytes at a place of a file."""
    path.chmod(0o644)
    with path.open("r+b") as raw:
        raw.seek(place)
        raw.write(with_bytes)


def interrupted(folder: Path) -> Path:
    """Return a test of 30 revolutions whose writer has gone."""
    with new_test(folder) as writer:
        write(writer, 1, 30)
        writer.commit()
    return folder / "test.h5"


def test_a_test_with_a_damaged_structure_is_not_resumed(quick_folder: Path) -> None:
    path = interrupted(quick_folder)
    spoil(path, place_of(path, "/entry/revolutions/force_rms")[0], b"\xff" * 16)
    before = path.read_bytes()
    with pytest.raises(UnusableInput, match=f"{path}: the file is damaged, its structure"):
        reopen_test(path)
    assert path.read_bytes() == before


def test_a_test_whose_columns_lie_over_each_other_is_not_resumed(quick_folder: Path) -> None:
    path = interrupted(quick_folder)
    header, mine = place_of(path, "/entry/revolutions/force_rms")
    _, other = place_of(path, "/entry/revolutions/force_max")
    whole = path.read_bytes()
    spoil(path, whole.index(mine.to_bytes(8, "little"), header), other.to_bytes(8, "little"))
    before = path.read_bytes()
    with pytest.raises(UnusableInput, match="lies over another dataset"):
        reopen_test(path)
    assert path.read_bytes() == before


def with_a_damaged_cycle(folder: Path) -> Path:
    """Return an ended test of 30 revolutions of whose cycles a force cannot be read."""
    path = ended(folder, 30)
    spoil(path, place_of(path, "/entry/cycles/force_1")[0], b"\xff" * 16)
    return path


def test_a_replay_goes_on_over_a_damaged_cycle_and_says_so(quick_folder: Path) -> None:
    client = ReplayClient(with_a_damaged_cycle(quick_folder), speed=1e4)
    try:
        shown, reason, deadline = 0, "", time.monotonic() + PATIENCE_S
        while shown < 30 or "is damaged" not in reason:
            assert time.monotonic() < deadline, f"{shown} rows were shown: {reason}"
            snapshot = client.poll()
            if snapshot is not None:
                shown, reason = snapshot.status.test.committed, snapshot.status.engine.reason
            time.sleep(0.01)
    finally:
        client.close()


def test_a_replay_that_begins_at_a_damaged_cycle_is_refused(quick_folder: Path) -> None:
    with pytest.raises(UnusableInput, match="is damaged, /entry/cycles/force_1"):
        ReplayClient(with_a_damaged_cycle(quick_folder), at_end=True)


def test_a_replay_of_rows_that_cannot_be_read_opens_no_window(quick_folder: Path) -> None:
    path = ended(quick_folder, 30)
    spoil(path, place_of(path, "/entry/revolutions/force_max")[0], b"\xff" * 16)
    with pytest.raises(UnusableInput, match="is damaged, /entry/revolutions/force_max"):
        replay_file(path)
