"""Tables for spreadsheets: decimal commas, separators, and a workbook that a person can read."""

from __future__ import annotations

import csv
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
import openpyxl
import pytest
from snapshots import write_recorded

from rigapp.config.errors import UnusableInput
from rigapp.storage import Dialect, export_columns, export_test, open_test


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("export") / "test.h5"
    write_recorded(path)
    return path


def table_of(path: Path, **ways: Any) -> list[list[str]]:
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.reader(file, **ways))


@pytest.mark.sampled(every=5)
@pytest.mark.parametrize("separator", [";", "\t"])
@pytest.mark.parametrize("decimal", [",", "."])
@pytest.mark.parametrize("cycles", [False, True])
def test_numbers_are_the_same_however_they_are_written(
    recorded: Path, tmp_path: Path, separator: str, decimal: str, cycles: bool
) -> None:
    export_test(recorded, tmp_path / "plain.csv", cycles)
    export_test(recorded, tmp_path / "other.csv", cycles, dialect=Dialect(separator, decimal))
    names, *plain = table_of(tmp_path / "plain.csv")
    same_names, *other = table_of(tmp_path / "other.csv", delimiter=separator)
    assert names == same_names
    assert plain == [[one.replace(decimal, ".") for one in row] for row in other]


@pytest.mark.parametrize(
    ("separator", "decimal", "words"),
    [
        (",", ",", "add --separator"),
        (";", "x", "--decimal 'x'"),
        ("", ".", "--separator ''"),
        (".", ",", "--separator '.'"),
        ("\n", ".", "--separator"),
    ],
)
def test_a_dialect_that_cannot_be_read_again_is_refused(
    separator: str, decimal: str, words: str
) -> None:
    with pytest.raises(UnusableInput) as refused:
        Dialect(separator, decimal)
    assert words in str(refused.value)


@pytest.mark.parametrize("name", ["a.xlsx", "a.parquet"])
def test_a_dialect_is_of_csv_files_alone(recorded: Path, tmp_path: Path, name: str) -> None:
    with pytest.raises(UnusableInput, match=r"are of \.csv files"):
        export_test(recorded, tmp_path / name, dialect=Dialect(";", ","))
    assert list(tmp_path.iterdir()) == []


def test_a_workbook_holds_data_units_settings_and_times(recorded: Path, tmp_path: Path) -> None:
    rows = export_test(recorded, tmp_path / "a.xlsx")
    book = openpyxl.load_workbook(tmp_path / "a.xlsx", read_only=True)
    assert book.sheetnames == ["Data", "Units", "Settings"]
    names, *data = book["Data"].iter_rows(values_only=True)
    assert len(data) == rows
    columns = {name: [row[place] for row in data] for place, name in enumerate(names)}
    with open_test(recorded) as test:
        for name, (source, _, _) in export_columns(test, cycles=False).items():
            told = np.array([np.nan if one is None else one for one in columns[name]], float)
            np.testing.assert_allclose(told, test.column(source).astype(float), rtol=1e-15)
        host = test.column("host_time")
        lines = [line for text in test.configuration().values() for line in str(text).splitlines()]
    for stored, utc, local in zip(
        host, columns["date_time_UTC"], columns["date_time_local"], strict=True
    ):
        moment = datetime.fromtimestamp(float(stored), UTC)
        assert abs((utc - moment.replace(tzinfo=None)).total_seconds()) < 1e-3
        assert abs((local - moment.astimezone().replace(tzinfo=None)).total_seconds()) < 1e-3
    units = {row[0]: row[1] for row in book["Units"].iter_rows(values_only=True)}
    assert units["force_max_N"] == "N"
    told_lines = {row[1] for row in book["Settings"].iter_rows(values_only=True)}
    assert {line for line in lines if line.strip()} <= told_lines


def test_no_cell_of_a_workbook_acts(recorded: Path, tmp_path: Path) -> None:
    export_test(recorded, tmp_path / "a.xlsx")
    book = openpyxl.load_workbook(tmp_path / "a.xlsx")
    cells = [cell for sheet in book for row in sheet.iter_rows() for cell in row]
    assert not [cell for cell in cells if cell.data_type == "f" or cell.hyperlink]


def test_more_rows_than_a_sheet_holds_are_refused(
    recorded: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rigapp.storage.reading.export.MOST_EXCEL_ROWS", 299)
    with pytest.raises(UnusableInput, match="300 rows, and a sheet of Excel holds 299"):
        export_test(recorded, tmp_path / "a.xlsx")
    assert list(tmp_path.iterdir()) == []
