"""The tables of `rigapp model wear` and `rigapp model pressure`, and what they refuse."""

from __future__ import annotations

import csv
import io
import itertools
import re
import sys
from pathlib import Path

import numpy as np
import pytest

from rigapp.cli import main
from rigapp.commands import progress as model_progress
from rigapp.commands.model.wear import write_pressure, write_wear
from rigapp.config.errors import UnusableInput

PARAMETERS = """\
schema = 1
[mechanism]
crank_radius_mm = 76.2
crank_mass_kg = 0.4045
crank_inertia_kg_m2 = 204e-6
follower_length_mm = 203.2
follower_mass_kg = 0.8175
follower_inertia_kg_m2 = 5500e-6
slider_mass_kg = 5.54871
[spring]
stiffness_N_per_m = 525.0
free_position_mm = 317.4952
[joint]
pin_radius_mm = 9.5
bushing_radius_mm = 10.0
bushing_outer_radius_mm = 20.0
bushing_width_mm = 13.1
[bushing]
youngs_modulus_MPa = 500.0
poissons_ratio = 0.38
density_g_per_cm3 = 2.2
wear_coefficient_mm3_per_Nm = 5.05e-4
[pin]
youngs_modulus_MPa = 206000.0
poissons_ratio = 0.29
"""


@pytest.fixture
def source(tmp_path: Path) -> Path:
    """Return a parameter file."""
    path = tmp_path / "parameters.toml"
    path.write_text(PARAMETERS)
    return path


def read(path: Path) -> tuple[list[str], np.ndarray]:
    """Return a table's header and its numbers."""
    with path.open(newline="") as file:
        rows = list(csv.reader(file))
    return rows[0], np.array(rows[1:], dtype=float)


def test_wear_has_the_promised_columns_and_ends_with_the_life(
    source, tmp_path, capsys, wear_reference
) -> None:
    table, profile = tmp_path / "wear.csv", tmp_path / "profile.csv"
    assert write_wear(source, 30.0, 21377, "continuous", 110.0, 1e-3, table, profile) == 0
    header, rows = read(table)
    assert header == [
        "cycles",
        "max_depth_mm",
        "worn_area_mm2",
        "worn_mass_g",
        "peak_pressure_MPa",
        "mean_force_N",
        "estimated_error_mm",
        "worn_area_error_mm2",
        "worn_mass_error_g",
    ]
    assert rows[0, :4].tolist() == [0.0, 0.0, 0.0, 0.0]
    assert np.all(rows[1:, 7] > 0.0)
    assert rows[-1, 7] < 1e-3 * rows[-1, 2]
    assert rows[:, 8] == pytest.approx(rows[:, 7] * 13.1 * 2.2e-3)
    last = rows[-1]
    assert last[0] == 21377
    assert last[1:3] == pytest.approx(wear_reference[-1, 1:3], rel=1e-3)
    assert last[3] == pytest.approx(last[2] * 13.1 * 2.2e-3)
    assert last[5] == pytest.approx(110.0)
    assert abs(last[1] - wear_reference[-1, 1]) <= last[6] <= 1e-3 * last[1]
    header, rows = read(profile)
    assert header == ["angle_deg", "depth_mm"]
    assert rows[[0, -1], 0].tolist() == [-180.0, 180.0]
    assert rows[np.argmax(rows[:, 1]), 0] == pytest.approx(0.0, abs=1e-9)
    assert rows[:, 1].max() == pytest.approx(last[1], rel=1e-6)
    printed = capsys.readouterr()
    assert "after 21377 cycles 0.4624" in printed.out
    assert printed.err == ""


@pytest.fixture
def wear(source, tmp_path, monkeypatch):
    """Return the command with some more options: its exit status."""

    def call(*options: str) -> int:
        to = ["--to", str(tmp_path / "wear.csv")]
        monkeypatch.setattr(
            sys, "argv", ["rigapp", "model", "wear", str(source), "--rpm", "30", *to, *options]
        )
        with pytest.raises(SystemExit) as ended:
            main()
        assert isinstance(ended.value.code, int)
        return ended.value.code

    return call


def test_explicit_steps_and_bed_of_springs_on_the_command_line(wear, tmp_path, capsys) -> None:
    table = tmp_path / "wear.csv"
    life = ("--cycles", "1000", "--tolerance", "1e-2", "--force-N", "110")
    found = {}
    for name, options in {
        "implicit": (),
        "half": ("--method", "explicit"),
        "five": ("--method", "explicit", "--extrapolation", "5"),
        "winkler": ("--contact", "winkler"),
    }.items():
        assert wear(*life, *options) == 0
        printed = capsys.readouterr()
        found[name] = (*read(table), printed.out, printed.err)
    implicit = found["implicit"]
    for name, (header, rows, _, _) in found.items():
        assert header == implicit[0]
        assert np.all(rows[1:, 6:] > 0.0), name
        assert rows[-1, 0] == 1000
    for name, sentence in {
        "half": "steps of at most 12.62 cycles, 50% of the stability limit of 25.23 cycles",
        "five": "steps of at most 5 cycles, 20% of the stability limit of 25.23 cycles",
    }.items():
        _, rows, out, err = found[name]
        assert sentence in out
        assert err == ""
        last, other = rows[-1], implicit[1][-1]
        assert abs(last[1] - other[1]) <= last[6] + other[6]
    assert "Explicit" not in implicit[2]
    assert found["winkler"][1][0, 4] == pytest.approx(0.74 * implicit[1][0, 4], rel=0.02)
    assert "26% below" in found["winkler"][3]
    # What steps of so many cycles miss of the tolerance is said like any other miss.
    early = ("--cycles", "30", "--tolerance", "5e-3", "--force-N", "110", "--method", "explicit")
    assert wear(*early) == 1
    assert "most of it is by the time steps: take shorter explicit" in capsys.readouterr().err
    assert wear(*early, "--extrapolation", "1") == 0


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (
            ("--method", "explicit", "--extrapolation", "22"),
            "--extrapolation 22: explicit extrapolation is stable up to 21.03 cycles on this mesh"
            " of 108 sectors; give fewer, or use implicit steps.",
        ),
        (("--extrapolation", "5"), "--extrapolation has no meaning for --method implicit"),
        (("--method", "explicit", "--extrapolation", "0"), "--extrapolation 0: give a finite"),
        (("--method", "explicit", "--extrapolation", "nan"), "--extrapolation nan: give a finite"),
        (("--method", "runge"), "--method runge: choose one of implicit, explicit."),
        (("--contact", "rigid"), "--contact rigid: choose one of finite-element, winkler."),
        (
            ("--contact", "winkler", "--method", "explicit", "--extrapolation", "1000"),
            "stable up to 708.9 cycles",
        ),
    ],
)
def test_unusable_schemes_are_refused(wear, tmp_path, capsys, options, sentence: str) -> None:
    assert wear("--cycles", "300", "--tolerance", "1e-2", "--force-N", "110", *options) == 2
    printed = capsys.readouterr()
    assert sentence in printed.err
    assert printed.out == ""
    assert not list(tmp_path.glob("*.csv"))


def test_mechanisms_forces_and_their_warning(source, tmp_path, capsys) -> None:
    table = tmp_path / "wear.csv"
    write_wear(source, 30.0, 300, "perfect", None, 2e-2, table, None)
    _, rows = read(table)
    assert rows[0, 5] == pytest.approx(59.4, abs=0.5)
    assert capsys.readouterr().err == ""
    text = PARAMETERS.replace("stiffness_N_per_m = 525.0", "stiffness_N_per_m = 0.0")
    source.write_text(text)
    write_wear(source, 30.0, 300, "continuous", None, 5e-2, table, None)
    assert "Continuous contact does not hold" in capsys.readouterr().err


def test_a_missed_tolerance_is_exit_status_1(source, tmp_path, capsys) -> None:
    table = tmp_path / "wear.csv"
    # The finest mesh of the steps' arc does not reach so far.
    assert write_wear(source, 30.0, 30, "perfect", 110.0, 1e-5, table, None) == 1
    _, rows = read(table)
    assert rows[-1, 0] == 30
    printed = capsys.readouterr().err
    assert re.search(r"error of the depth, [\d.e-]+ of it, exceeds the tolerance of 1e-05", printed)


def test_a_time_limit_leaves_what_was_reached(source, tmp_path, capsys, monkeypatch) -> None:
    table = tmp_path / "wear.csv"
    # Each look at the clock finds a second gone.
    clock = itertools.count()
    monkeypatch.setattr(model_progress, "monotonic", lambda: float(next(clock)))
    assert write_wear(source, 30.0, 21377, "perfect", 110.0, 1e-3, table, None, 5.0) == 1
    _, rows = read(table)
    assert 1 < len(rows) < 7
    printed = capsys.readouterr()
    assert "Time ran out after" in printed.err
    other = tmp_path / "none.csv"
    assert write_wear(source, 30.0, 21377, "perfect", 110.0, 1e-3, other, None, 0.5) == 1
    assert "--time-limit-s 0.5: over before the first row" in capsys.readouterr().err
    assert not other.exists()
    with pytest.raises(UnusableInput, match="--time-limit-s 0: give a finite time above 0"):
        write_wear(source, 30.0, 100, "perfect", 110.0, 1e-2, table, None, 0.0)


def test_a_terminal_sees_a_bar_and_a_pipe_does_not(monkeypatch, capsys) -> None:
    with model_progress.watched("wear", None) as tell:
        tell(0.5)
    assert capsys.readouterr().err == ""
    screen = io.StringIO()
    monkeypatch.setattr(screen, "isatty", lambda: True)
    monkeypatch.setattr(sys, "stderr", screen)
    with model_progress.watched("wear", None) as tell:
        tell(0.5)
    assert "wear" in screen.getvalue()
    assert "50%" in screen.getvalue()


def test_pressure_has_the_promised_columns_and_prints_the_pin(
    source, tmp_path, capsys, pressure_reference
) -> None:
    table = tmp_path / "pressure.csv"
    assert write_pressure(source, 110.0, table) == 0
    header, rows = read(table)
    assert header == ["angle_deg", "pressure_MPa"]
    assert rows[[0, -1], 0].tolist() == [-180.0, 180.0]
    found = np.interp(pressure_reference[:18, 0], rows[:, 0], rows[:, 1])
    assert found == pytest.approx(pressure_reference[:18, 1], rel=1e-2)
    assert "pin displacement 0.5193" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"rpm": 0.0}, "--rpm 0"),
        ({"rpm": float("nan")}, "--rpm nan"),
        ({"cycles": 0}, "--cycles 0: give at least 1"),
        ({"joint": "welded"}, "--joint welded: choose one of perfect"),
        ({"force_N": 0.0}, "--force-N 0: give a finite force"),
        ({"force_N": 1e6}, "--force-N 1e.06: .*wall|--force-N 1e.06: .*balance"),
        ({"tolerance": 0.0}, "--tolerance 0: give 1e-05 to 0.1"),
        ({"target": Path("wear.txt")}, "--to wear.txt: give a name"),
        ({"target": Path("nowhere/wear.csv")}, "folder does not exist"),
        ({"force_N": 110.0, "cycles": 10**9}, "wear depth is .* worn through; give fewer cycles"),
    ],
)
def test_unusable_wear_input_is_named(source, tmp_path, changes, words: str) -> None:
    options = {
        "params_path": source,
        "rpm": 30.0,
        "cycles": 100,
        "joint": "perfect",
        "force_N": None,
        "tolerance": 1e-2,
        "target": tmp_path / "wear.csv",
        "profile": None,
    }
    with pytest.raises(UnusableInput, match=words):
        write_wear(**(options | changes))
    assert not list(tmp_path.glob("*.csv"))
    assert not list(tmp_path.glob(".*.part*"))


def test_profile_must_be_another_file(source, tmp_path) -> None:
    table = tmp_path / "wear.csv"
    with pytest.raises(UnusableInput, match="that is the --to file"):
        write_wear(source, 30.0, 100, "perfect", 110.0, 1e-2, table, table)


@pytest.mark.parametrize(
    ("force", "words"),
    [
        (0.0, "--force-N 0: give a finite force above 0"),
        (-5.0, "--force-N -5"),
        (1e6, "parameters.toml: --force-N 1e.06: the pin would sink .* through the wall"),
    ],
)
def test_unusable_pressure_input_is_named(source, tmp_path, force: float, words: str) -> None:
    with pytest.raises(UnusableInput, match=words):
        write_pressure(source, force, tmp_path / "pressure.csv")
    assert not (tmp_path / "pressure.csv").exists()
