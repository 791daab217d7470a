"""The example settings and readings make records, as the first line of each says."""

from __future__ import annotations

import shlex
from pathlib import Path

import pytest
from commandline import program, rigapp

from rigapp_calibration.records import unseal

FOLDER = Path(__file__).parents[2] / "examples" / "calibration"
SETTINGS = sorted(path for path in FOLDER.glob("*.toml") if path.with_suffix(".csv").exists())


@pytest.mark.sampled
@pytest.mark.parametrize("settings", SETTINGS, ids=lambda path: path.stem)
def test_the_command_in_the_first_line_makes_a_record(settings: Path, tmp_path: Path) -> None:
    _, _, *arguments = shlex.split(settings.read_text("utf-8").splitlines()[0])
    for name in ("--settings", "--readings"):
        place = arguments.index(name) + 1
        arguments[place] = str(FOLDER / arguments[place])
    done = (program if settings.stem == "load_cell" else rigapp)(*arguments, folder=tmp_path)
    assert done.returncode == 0, done.stderr
    record = unseal((tmp_path / arguments[arguments.index("--to") + 1]).read_bytes())
    assert record.content["result"]["accepted"]


def test_every_table_of_readings_has_its_settings() -> None:
    # A run-out map has no table: its readings are slow rolls (``test_probe_roll``).
    assert {path.stem for path in FOLDER.glob("*.toml")} - {"run_out"} == {
        path.stem for path in FOLDER.glob("*.csv")
    }
