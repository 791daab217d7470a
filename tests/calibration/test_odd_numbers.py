"""Odd numbers in a table of readings: a refusal, never a warning of the mathematics below."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from rigapp.commands.calibrate import calibrate_table
from rigapp.config.errors import UnusableInput
from tests.calibration.simulated_cell import Cell, take
from tests.calibration.test_commands import SETTINGS, as_csv

UNREADABLE = ("1e308", "-1e308", "abc", "")
ODD = (*UNREADABLE, "nan", "inf", "-inf", "1e400", "1e-300", "1e11", "0", "-5")


@pytest.mark.sampled(every=7)
@pytest.mark.parametrize("column", range(2, 6))
@pytest.mark.parametrize("number", ODD)
@pytest.mark.parametrize("rows", [slice(5, 6), slice(1, None, 2), slice(1, None)])
def test_an_odd_number_is_refused_in_words(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], column: int, number: str, rows: slice
) -> None:
    lines = [line.split(",") for line in as_csv(_readings()).splitlines()]
    for line in lines[rows]:
        line[column] = number
    (tmp_path / "readings.csv").write_text("\n".join(",".join(line) for line in lines))
    (tmp_path / "settings.toml").write_text(SETTINGS)
    files = (tmp_path / "readings.csv", tmp_path / "settings.toml", tmp_path / "record.json")
    if number in UNREADABLE:
        with pytest.raises(UnusableInput, match=r"readings\.csv: line"):
            calibrate_table("load cell", *files, as_json=True)
        return
    status = calibrate_table("load cell", *files, as_json=True)
    result = json.loads(capsys.readouterr().out)
    assert (status == 0) is result["accepted"] is files[2].exists()
    assert result["accepted"] or result["problems"]


def _readings():  # type: ignore[no-untyped-def]
    return take(Cell(), np.random.default_rng(4), angles=4)
