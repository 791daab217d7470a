"""What other programs get: CSV and Parquet with the units in the names."""

from __future__ import annotations

import csv
import sys
from pathlib import Path

import numpy as np
import pyarrow.parquet
import pytest
from storage_samples import FULL, cycle, ended, row

from rigapp.config.errors import UnusableInput
from rigapp.storage import compact_test, export_test
from rigapp.storage.reading import export as export_module


@pytest.fixture
def recorded(quick_folder: Path) -> Path:
    """Return a test of 45 revolutions, 4 of them with their whole cycle."""
    return ended(quick_folder, 45, "stopped", FULL)


def read_csv(path: Path) -> tuple[list[str], np.ndarray]:
    """Return header and numbers of a CSV file."""
    with path.open(newline="") as file:
        lines = list(csv.reader(file))
    return lines[0], np.array(lines[1:], float)


def test_statistics_as_csv(recorded: Path) -> None:
    target = recorded.parent / "out.csv"
    assert export_test(recorded, target) == 45
    names, values = read_csv(target)
    assert names[:4] == ["revolution", "time_s", "host_time_s", "speed_rpm"]
    assert "force_max_N" in names
    assert "force_1_angle_of_max_deg" in names
    assert "probe_2_rms_um" in names
    expected = np.array([row(i, FULL) for i in range(1, 46)])
    whole = [one.dtype != "<f8" for one in FULL.revolution_columns]
    expected[:, whole] = np.trunc(expected[:, whole])
    np.testing.assert_array_equal(values, expected)


@pytest.mark.parametrize("compressed", [False, True])
def test_cycles_as_csv(recorded: Path, compressed: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(export_module, "SAMPLES_AT_A_TIME", 60)
    if compressed:
        compact_test(recorded)
    target = recorded.parent / "out.csv"
    steps: list[tuple[int, int]] = []
    number = export_test(recorded, target, cycles=True, progress=lambda *one: steps.append(one))
    names, values = read_csv(target)
    assert names[:4] == ["revolution", "angle_deg", "time_s", "force_1_N"]
    assert names[-2:] == ["raw_probe_2_V", "raw_count"]
    expected = [
        np.vstack((np.full(cycle(i, FULL).shape[1], i), cycle(i, FULL))).T for i in (10, 20, 30, 40)
    ]
    np.testing.assert_array_equal(values, np.concatenate(expected))
    assert len(steps) == 2
    assert steps[-1] == (number, number)


@pytest.mark.parametrize("cycles", [False, True])
def test_parquet_has_the_same_columns_with_units(
    recorded: Path, cycles: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(export_module, "ROWS_AT_A_TIME", 20)
    folder = recorded.parent
    export_test(recorded, folder / "out.csv", cycles)
    export_test(recorded, folder / "out.parquet", cycles)
    names, values = read_csv(folder / "out.csv")
    table = pyarrow.parquet.read_table(folder / "out.parquet")
    assert table.column_names == names
    assert table.schema.field("time_s").metadata[b"units"] == b"s"
    assert table.schema.metadata[b"operator"] == b"Ann"
    np.testing.assert_array_equal(np.column_stack(list(table.columns)), values)


def test_targets_are_never_overwritten_and_nothing_half_done_stays(
    recorded: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    target = recorded.parent / "out.csv"
    target.write_text("mine")
    with pytest.raises(UnusableInput, match=r"out\.csv: the file exists and is not overwritten"):
        export_test(recorded, target)
    assert target.read_text() == "mine"
    with pytest.raises(UnusableInput, match=r"out\.ods: the file must end in \.csv or \.parquet"):
        export_test(recorded, recorded.parent / "out.ods")
    with pytest.raises(UnusableInput, match=r"folder .* does not exist"):
        export_test(recorded, recorded.parent / "none" / "out.csv")

    def fail(*_: object) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        export_test(recorded, recorded.parent / "new.parquet", progress=fail)
    assert sorted(one.name for one in recorded.parent.iterdir()) == ["out.csv", "test.h5"]


def test_parquet_without_its_library_names_the_extra_and_csv_needs_none(
    recorded: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    monkeypatch.setitem(sys.modules, "pyarrow.parquet", None)
    with pytest.raises(UnusableInput, match=r"out\.parquet: Parquet .*rigapp\[analysis\]"):
        export_test(recorded, recorded.parent / "out.parquet")
    assert [one.name for one in recorded.parent.iterdir()] == [recorded.name]
    assert export_test(recorded, recorded.parent / "out.csv") == 45
