"""Worn profiles and the twin's checkpoints in the file: appended, resumed, compressed, absent."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
from storage_samples import PLAN, check, new_test, write

import rigapp
from rigapp.schema.columns import PROFILE_ANGLES_DEG, PROFILE_CURVES, profile_columns
from rigapp.storage import FilePlan, TestWriter, compact_test, open_test, profile_rows, reopen_test
from rigapp.storage.structure.layout import CHECKPOINT_BYTES

ANGLES = len(PROFILE_ANGLES_DEG)
WITH: FilePlan = replace(PLAN, profiles=profile_rows(PLAN.revolutions))


def append(writer: TestWriter, revolution: int) -> bool:
    values = revolution + np.arange(len(profile_columns()), dtype=np.float64)
    return writer.append_profile(values, depths(revolution))


def depths(revolution: int) -> dict[str, np.ndarray]:
    curves = {
        name: np.linspace(0.0, revolution + place, ANGLES, dtype=np.float32)
        for place, name in enumerate(PROFILE_CURVES)
    }
    curves["measured"][:100] = np.nan
    return curves


def test_profiles_come_back_as_arrays_and_as_a_dataset(tmp_path: Path) -> None:
    with new_test(tmp_path, WITH) as writer:
        write(writer, 1, 30)
        assert append(writer, 3)
        assert append(writer, 7)
        writer.commit()
        with open_test(writer.path) as reader:
            found, data = reader.profiles(), rigapp.open(writer.path).profiles
            check(reader)
    assert found["revolution"].tolist() == [3, 7]
    for place, revolution in enumerate((3, 7)):
        for name, curve in depths(revolution).items():
            np.testing.assert_array_equal(found[name][place], curve)
    assert data["measured"].dims == ("revolution", "angle")
    assert data["measured"].attrs["units"] == "mm"
    assert float(data["predicted"].sel(revolution=7, angle=180)) == 8.0
    with h5py.File(writer.path) as file:
        group = file["/entry/prediction"]
        assert group["profile_measured"].dims[1][0].name == "/entry/prediction/profile_angle"
        assert int(group["committed_profiles"][()]) == 2


def test_profiles_and_checkpoint_survive_compression(tmp_path: Path) -> None:
    with new_test(tmp_path, WITH) as writer:
        write(writer, 1, 20)
        append(writer, 10)
        writer.keep_checkpoint(19, b"nineteen")
        writer.finish("complete", "complete", "done")
    before = writer.path.stat().st_ino
    compact_test(writer.path)
    assert writer.path.stat().st_ino != before
    with open_test(writer.path) as reader:
        assert reader.profiles()["revolution"].tolist() == [10]
        assert reader.checkpoint() == b"nineteen"


def test_a_resumed_test_keeps_the_newest_checkpoint_of_two(tmp_path: Path) -> None:
    writer = new_test(tmp_path, WITH)
    for end, state in ((5, b"five"), (10, b"ten"), (15, b"fifteen")):
        write(writer, end - 4, end)
        append(writer, end)
        writer.keep_checkpoint(end, state)
        writer.commit()
    writer.close()
    with open_test(writer.path) as reader:
        assert reader.checkpoint() == b"fifteen"
    again = reopen_test(writer.path)
    assert append(again, 16)
    write(again, 16, 20)
    again.keep_checkpoint(20, b"twenty")
    again.commit()
    again.close()
    with open_test(writer.path) as reader:
        assert reader.profiles()["revolution"].tolist() == [5, 10, 15, 16]
        assert reader.checkpoint() == b"twenty"
    spoil(writer.path, "twenty")
    with open_test(writer.path) as reader:
        assert reader.checkpoint() == b"fifteen"


def spoil(path: Path, state: str) -> None:
    """Tear the slot that holds a state, as a power cut in the middle of a write would."""
    data = path.read_bytes()
    assert data.count(state.encode()) == 1
    path.chmod(0o644)
    path.write_bytes(data.replace(state.encode(), b"x" * len(state)))


def test_a_checkpoint_of_revolutions_that_are_not_safe_is_not_used(tmp_path: Path) -> None:
    writer = new_test(tmp_path, WITH)
    write(writer, 1, 10)
    writer.keep_checkpoint(12, b"too far")
    writer.commit()
    writer.close()
    with open_test(writer.path) as reader:
        assert reader.checkpoint() == b""


def test_a_checkpoint_too_large_is_left_out(tmp_path: Path) -> None:
    with new_test(tmp_path, WITH) as writer:
        write(writer, 1, 3)
        writer.keep_checkpoint(3, bytes(CHECKPOINT_BYTES + 1))
        writer.commit()
        with open_test(writer.path) as reader:
            assert reader.checkpoint() == b""


def test_a_file_without_profiles_says_so_by_empty_arrays(tmp_path: Path) -> None:
    with new_test(tmp_path) as writer:
        write(writer, 1, 3)
        assert not append(writer, 2)
        writer.keep_checkpoint(2, b"two")
        writer.commit()
        with open_test(writer.path) as reader:
            assert reader.profiles()["measured"].shape == (0, ANGLES)
            assert reader.checkpoint() == b""
