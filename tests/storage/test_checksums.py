"""A flipped bit in rows, cycles, log or configuration is named; what is sound can be salvaged."""

from __future__ import annotations

import random
from pathlib import Path

import google_crc32c
import h5py
import numpy as np
import pytest
from storage_samples import METADATA, PLAN, check, cycle, ended, new_test, write

from rigapp.cli.program import main
from rigapp.config.errors import UnusableInput
from rigapp.storage import (
    FilePlan,
    StorageFailed,
    compact_test,
    create_test,
    damage_of,
    open_test,
    reopen_test,
    salvage_test,
)
from rigapp.storage.structure.checksum import row_checksums
from rigapp.storage.structure.layout import streams_of

COLUMN_GROUPS = ("revolutions", "cycles", "prediction", "events")


def data_of(path: Path) -> list[tuple[str, int, int]]:
    """Return path, offset and committed bytes of every column, as h5py alone tells."""
    found = []
    with h5py.File(path) as file:
        for group in COLUMN_GROUPS:
            committed = int(file[f"/entry/{group}/committed"][()])
            for name, item in file[f"/entry/{group}"].items():
                if name.startswith("committed") or item.id.get_offset() is None:
                    continue
                rows = committed
                if group == "cycles" and name not in ("revolution", "first", "count", "checksum"):
                    last = committed - 1
                    rows = int(
                        file["/entry/cycles/first"][last] + file["/entry/cycles/count"][last]
                    )
                if name.startswith("curve_"):
                    rows = int(file["/entry/prediction/committed_curves"][()])
                each = item.dtype.itemsize * int(np.prod(item.shape[1:]))
                if item.shape[0] >= rows > 0 and name not in ("angle", "checkpoint_state"):
                    found.append((item.name, int(item.id.get_offset()), rows * each))
    return found


def flipped(path: Path, to: Path, place: int, bit: int) -> Path:
    """Copy a file with one bit of it the other way."""
    data = bytearray(path.read_bytes())
    data[place] ^= 1 << bit
    to.write_bytes(data)
    return to


def test_the_checksum_of_a_row_is_that_of_its_stored_bytes(quick_folder: Path) -> None:
    path = ended(quick_folder, 30)
    with h5py.File(path) as file, open_test(path) as reader:
        rows = file["/entry/revolutions"]
        names = list(reader.column_units())
        columns, checksums = [rows[name][:] for name in names], rows["checksum"][:]
        for i in range(30):
            data = b"".join(column[i].tobytes() for column in columns)
            assert checksums[i] == google_crc32c.value(data)
        whole = cycle(20)
        samples = b"".join(
            values.astype(one.dtype).tobytes()
            for one, values in zip(PLAN.cycle_columns, whole, strict=True)
        )
        row = np.array([20], "<i8").tobytes() + np.array([whole.shape[1]], "<i8").tobytes()
        assert file["/entry/cycles/checksum"][1] == google_crc32c.value(samples + row)


def test_many_rows_at_once_have_the_checksums_of_each(quick_folder: Path) -> None:
    fields = streams_of(PLAN)["revolutions"].fields
    random_bytes = np.random.default_rng(1).bytes
    columns = [np.frombuffer(random_bytes(one.row_bytes * 300), one.dtype).copy() for one in fields]
    found = row_checksums(fields, columns, 300)
    for i in range(300):
        data = b"".join(column[i].tobytes() for column in columns)
        assert found[i] == google_crc32c.value(data)


def many_flips(folder: Path, number: int, seed: int) -> None:
    path, chance = ended(folder, 60), random.Random(seed)
    spots = data_of(path)
    assert damage_of(path) == []
    for _ in range(number):
        name, offset, length = chance.choice(spots)
        place, bit = offset + chance.randrange(length), chance.randrange(8)
        damaged = flipped(path, folder / "flipped.h5", place, bit)
        assert damage_of(damaged), (name, place, bit)


def test_a_flipped_bit_in_the_data_is_named(quick_folder: Path) -> None:
    many_flips(quick_folder, 6, 1)


@pytest.mark.soak
def test_ten_thousand_flipped_bits_are_named(quick_folder: Path) -> None:
    many_flips(quick_folder, 10_000, 2)


def test_a_changed_setting_or_unit_is_named(quick_folder: Path) -> None:
    path = ended(quick_folder, 30)
    path.chmod(0o644)
    with h5py.File(path, "r+") as file:
        file["/entry/configuration/parameters/mechanism/crank_radius_mm"][()] = 77.0
    assert any("configuration" in one for one in damage_of(path))
    path.unlink()
    path = ended(quick_folder, 30)
    path.chmod(0o644)
    with h5py.File(path, "r+") as file:
        file["/entry/revolutions/force_max"].attrs["units"] = "kN"
    assert any("configuration" in one for one in damage_of(path))


@pytest.mark.sampled
@pytest.mark.parametrize("what", [b'"checksums":true', b"configuration_sha256\0"])
def test_a_flipped_bit_in_what_says_that_there_are_checksums_is_named(
    quick_folder: Path, what: bytes
) -> None:
    path = ended(quick_folder, 60)
    damaged = flipped(path, quick_folder / "flipped.h5", path.read_bytes().index(what) + 1, 0)
    assert any("configuration" in one for one in damage_of(damaged))
    found = salvage_test(damaged, quick_folder / "new.h5")
    assert found.kept["revolutions"] == 60
    assert found.damage


def test_a_plan_that_cannot_be_read_is_named(quick_folder: Path) -> None:
    path = ended(quick_folder, 60)
    data = path.read_bytes()
    place = data.index(b'"prediction_points":360') + len(b'"prediction_points":')
    damaged = flipped(path, quick_folder / "flipped.h5", place, 0)
    assert any("its plan cannot be read" in one for one in damage_of(damaged))


def test_a_text_that_became_a_list_of_lists_is_not_read(quick_folder: Path) -> None:
    path = ended(quick_folder, 30)
    data, text = path.read_bytes(), b"units\0\0\0\x19\x01\x01"
    place = data.index(text) + len(text) - 2
    damaged = flipped(path, quick_folder / "flipped.h5", place, 0)
    with pytest.raises(UnusableInput, match="is a list of lists"):
        open_test(damaged)


def test_a_damaged_file_is_neither_sealed_nor_gone_on_with(quick_folder: Path) -> None:
    path = ended(quick_folder, 30, "stopped")
    place = next(offset for name, offset, _ in data_of(path) if name.endswith("/force_max"))
    damaged = flipped(path, quick_folder / "flipped.h5", place + 8, 3)
    before = damaged.read_bytes()
    with pytest.raises(StorageFailed, match="1 of 30 rows of the revolutions are damaged: 1"):
        compact_test(damaged)
    with pytest.raises(UnusableInput, match="damaged: 1"):
        reopen_test(damaged)
    assert damaged.read_bytes() == before


def test_the_compressed_copy_keeps_checksums_and_protects_its_structure(
    quick_folder: Path,
) -> None:
    path = ended(quick_folder, 60)
    compact_test(path)
    assert damage_of(path) == []
    assert path.read_bytes()[8] >= 2, "the superblock has a checksum from version 2 on"
    import netCDF4

    with netCDF4.Dataset(path) as file:
        assert len(file["/entry/revolutions"].variables["force_max"]) == 60


@pytest.mark.sampled
@pytest.mark.parametrize("share", [99, 70, 30])
def test_a_copy_that_is_cut_short_gives_all_its_rows(quick_folder: Path, share: int) -> None:
    path = ended(quick_folder, 60)
    cut, new = quick_folder / "cut.h5", quick_folder / "new.h5"
    data = path.read_bytes()
    cut.write_bytes(data[: len(data) * share // 100])
    with pytest.raises(UnusableInput, match="cut short"):
        open_test(cut)
    found = salvage_test(cut, new)
    assert found.kept["revolutions"] == 60
    assert damage_of(new) == []
    with open_test(new) as reader:
        assert check(reader) == 60
        assert reader.configuration()["test"] == METADATA.test_text


def test_salvage_leaves_out_what_is_damaged_and_nothing_else(quick_folder: Path) -> None:
    path = ended(quick_folder, 60)
    spots = {name: offset for name, offset, _ in data_of(path)}
    damaged = flipped(path, quick_folder / "a.h5", spots["/entry/revolutions/force_max"] + 80, 1)
    damaged = flipped(damaged, quick_folder / "b.h5", spots["/entry/cycles/force"] + 4 * 60, 1)
    found = salvage_test(damaged, quick_folder / "new.h5")
    assert (found.kept["revolutions"], found.lost["revolutions"]) == (59, 1)
    assert (found.kept["cycles"], found.lost["cycles"]) == (5, 1)
    with open_test(quick_folder / "new.h5") as reader:
        numbers = reader.column("revolution").tolist()
        assert numbers == [n for n in range(1, 61) if n != 11]
        for stored in reader.cycles():
            for values, wanted in zip(
                stored.columns.values(), cycle(stored.revolution), strict=True
            ):
                np.testing.assert_array_equal(values, wanted.astype(values.dtype))
        assert [one.revolution for one in reader.cycles()] == [10, 30, 40, 50, 60]


def test_a_file_of_before_says_that_it_has_no_checksums(
    quick_folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    old = FilePlan(revolutions=300, cycles=40, samples_per_cycle=50, events=256)
    with create_test(quick_folder / "test.h5", old, METADATA) as writer:
        write(writer, 1, 20)
        writer.finish("stopped", "operator", "done")
    path = quick_folder / "test.h5"
    with reopen_test(path) as writer:
        write(writer, 21, 40)
        writer.finish("stopped", "operator", "done")
    with open_test(path) as reader:
        assert check(reader) == 40
    assert asked(monkeypatch, "info", str(path), "--verify") == 0
    assert "in which rows cannot be proved" in capsys.readouterr().out
    with pytest.raises(UnusableInput, match="of an older version"):
        salvage_test(path, quick_folder / "new.h5")


def asked(monkeypatch: pytest.MonkeyPatch, *words: str) -> int:
    """Return the exit status of a command."""
    monkeypatch.setattr("sys.argv", ["rigapp", *words])
    with pytest.raises(SystemExit) as end:
        main()
    return int(end.value.code or 0)


def test_an_interrupted_file_is_closed_without_its_rig(
    quick_folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with new_test(quick_folder) as writer:
        write(writer, 1, 30)
    path = quick_folder / "test.h5"
    assert asked(monkeypatch, "close", str(path)) == 0
    assert "stopped with 30 revolutions" in capsys.readouterr().out
    with open_test(path) as reader:
        assert reader.compressed
        assert reader.stored_status() == "stopped"
        assert check(reader) == 30
    assert asked(monkeypatch, "close", str(path)) == 2
    assert asked(monkeypatch, "info", str(path), "--verify") == 0


def test_a_file_that_is_written_is_not_closed(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with new_test(quick_folder) as writer:
        write(writer, 1, 30)
        writer.commit()
        assert asked(monkeypatch, "close", str(writer.path)) == 2
