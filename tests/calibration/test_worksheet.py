"""The worksheet: the plan on paper, typed in afterwards, becomes a record."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from commandline import rigapp

SETTINGS = """
schema = 1
[cell]
name = "pin load cell"
[place]
gravity_m_s2 = 9.8123
[angle]
offset_deg = 0.0
"""
MATRIX = np.array([[198.0, 3.0], [-2.0, 203.0]])


def filled(sheet: str) -> str:
    """Return the sheet with what a cell of a known matrix shows at the angles of its words."""
    noise, lines, angle = np.random.default_rng(5), [], 0.0
    for line in sheet.splitlines():
        if "turn the pin to" in line:
            angle = float(line.rpartition(" to ")[2].split()[0])
        if line[:1] == "#" or line.startswith("series"):
            lines.append(line)
            continue
        series, step, mass, _, _, _, hung = line.split(",")
        weight = float(mass) * 9.8123 * (1.0 - 1.2 / 8000.0)
        at = np.radians(angle)
        force = -weight * np.array([np.sin(at), np.cos(at)])
        one, two = np.linalg.solve(MATRIX, force) + noise.normal(0.0, 0.0005, 2)
        lines.append(f"{series},{step},{mass},{angle},{one:.6f},{two:.6f},{hung}")
    return "\n".join(lines) + "\n"


def test_a_worksheet_that_is_typed_in_becomes_a_record(tmp_path: Path) -> None:
    settings, sheet = tmp_path / "settings.toml", tmp_path / "sheet.csv"
    settings.write_text(SETTINGS)
    done = rigapp("calibrate", "worksheet", "--settings", settings, "--to", sheet)
    assert done.returncode == 0, done.stderr
    asked = ("calibrate", "load-cell", "--settings", settings, "--readings", sheet)
    empty = rigapp(*asked, "--to", tmp_path / "none.json")
    assert empty.returncode != 0
    assert "empty field (pin_angle_deg, signal_1, signal_2)" in empty.stderr
    sheet.write_text(filled(sheet.read_text()))
    found = rigapp(*asked, "--to", tmp_path / "record.json", "--json")
    assert found.returncode == 0, found.stderr
    result = json.loads(found.stdout)
    assert np.allclose(result["matrix_N_per_unit"], MATRIX, atol=0.5)
    assert result["creep"]["hung_s"] == [30.0, 300.0]


@pytest.mark.parametrize("ending", ["pdf", "html"])
def test_a_worksheet_has_every_step_and_is_not_overwritten(tmp_path: Path, ending: str) -> None:
    settings, sheet = tmp_path / "settings.toml", tmp_path / f"sheet.{ending}"
    settings.write_text(SETTINGS)
    asked = ("calibrate", "worksheet", "--settings", settings, "--to", sheet)
    assert rigapp(*asked).returncode == 0
    if ending == "html":
        text = sheet.read_text()
        assert text.count("turn the pin to") == 10
        assert "Hang 5 kg" in text
    assert rigapp(*asked).returncode != 0


def test_pieces_that_make_too_few_loads_are_refused_before_the_first_step(tmp_path: Path) -> None:
    settings = tmp_path / "settings.toml"
    settings.write_text(SETTINGS)
    asked = ("calibrate", "worksheet", "--settings", settings, "--to", tmp_path / "sheet.pdf")
    done = rigapp(*asked, "--weights", "20x2")
    assert done.returncode != 0
    assert "2 load(s)" in done.stderr
    assert "3 are needed" in done.stderr
