"""The daily check judges all four elements of the matrix and the zero; page and exit code agree."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rigapp.calibrating.daily_history import append_check, entry_of, read_history, verdict_lines
from rigapp.calibrating.session import Rig
from rigapp.commands.calibrate import show_history
from rigapp_calibration.load_cell.daily import DailyCheck, daily_check
from rigapp_calibration.load_cell.readings import LoadCellReadings
from rigapp_calibration.load_cell.weights import pin_force, weight_force
from tests.calibration.simulated_cell import SETTINGS

KEPT = np.linalg.inv(np.array([[0.00500, 0.00008], [-0.00006, 0.00495]]))
ZERO = np.array([0.011, -0.007])


def checked(
    elements: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 1.0),
    zero_N: tuple[float, float] = (0.0, 0.0),
    seed: int = 1,
    angles: int = 4,
    guarded: bool = True,
) -> DailyCheck:
    """Return the check of a cell that tells ``elements`` times the force by now."""
    rng = np.random.default_rng(seed)
    mass = np.tile([0.0, 40.0, 0.0], angles)
    angle = np.repeat(2.0 * np.pi / 4.0 * np.arange(angles), 3)
    weight = weight_force(mass, SETTINGS.weights, SETTINGS.place)
    felt = pin_force(weight, angle, 0.0) @ np.reshape(elements, (2, 2)).T + zero_N
    felt += rng.normal(0.0, 0.05, felt.shape)
    signal = felt @ np.linalg.inv(KEPT).T + ZERO
    series = tuple(np.repeat([str(one + 1) for one in range(angles)], 3))
    readings = LoadCellReadings(series, np.tile([1, 2, 3], angles), mass, angle, signal)
    cell = replace(SETTINGS.cell, guarded=guarded)
    return daily_check(readings, replace(SETTINGS, cell=cell), KEPT, ZERO)


def entry(check: DailyCheck, number: int) -> dict:
    return entry_of(
        check, Rig("Rig", True, "E. Sample"), calibration={"matrix": [1]},
        uncertainty_N=(0.2, 0.001), source=f"journal-{number}",
    )  # fmt: skip


@pytest.mark.parametrize(
    ("elements", "words"),
    [
        ((1.01, 0.0, 0.0, 0.99), "% of the force along axis"),
        ((1.0, 0.01, 0.01, 1.0), "reads [+](1.0|0.9). % of the force along axis"),
        ((1.0, 0.0, -0.02, 1.0), "axis 2 reads -(2.0|1.9)"),
        ((1.0, 0.02, 0.0, 1.0), "axis 1 reads [+](2.0|1.9)"),
        ((1.02, 0.0, 0.0, 1.0), "axis 1 reads [+](2.0|1.9). % of the force along axis 1 too much"),
    ],
)
def test_changes_that_cancel_in_the_mean_are_judged(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], elements: tuple, words: str
) -> None:
    check = checked(elements)
    assert not check.passed
    assert check.elements == pytest.approx(np.reshape(elements, (2, 2)), abs=5e-4)
    assert re.search(words, check.sentence), check.sentence
    store = tmp_path / "daily-checks.jsonl"
    append_check(store, entry(check, 1))
    found = read_history(store)
    assert not found.in_control
    assert {one.code for _, one in found.findings} == {"beyond_uncertainty"}
    assert verdict_lines(found)[0] == f"The last check failed: {check.sentence}"
    assert show_history(store, None, None, as_json=False) == 1
    assert "in control" not in capsys.readouterr().out


@pytest.mark.parametrize("degrees", [-2.0, 1.0, 6.0])
def test_a_level_that_is_off_is_suspected_not_the_weight_or_the_cell(
    tmp_path: Path, degrees: float
) -> None:
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    check = checked((c, -s, s, c))
    assert not check.passed
    assert check.turned == pytest.approx(np.radians(degrees), abs=1e-3)
    append_check(tmp_path / "daily-checks.jsonl", entry(check, 1))
    found = read_history(tmp_path / "daily-checks.jsonl")
    assert not found.in_control
    words = " ".join(verdict_lines(found))
    assert f"turned by {degrees:+.2f} degrees" in words
    assert "angle reference" in words
    assert "alibrate" not in words
    assert "Check the weight" not in words


def test_a_small_change_of_two_elements_is_seen_in_their_charts(tmp_path: Path) -> None:
    store = tmp_path / "daily-checks.jsonl"
    for number in range(10):
        append_check(store, entry(checked(seed=number), number))
    assert read_history(store).in_control
    check = checked((1.002, 0.0, 0.0, 0.998))
    assert check.passed
    assert check.sensitivity == pytest.approx(1.0, abs=5e-4)
    append_check(store, entry(check, 99))
    found = read_history(store)
    assert {name for name, _ in found.findings} >= {"Gain of axis 1", "Gain of axis 2"}
    assert not found.in_control


def test_the_zero_is_judged(tmp_path: Path) -> None:
    assert checked(zero_N=(3.0, -3.5)).passed
    check = checked(zero_N=(0.5, -9.0))
    assert not check.passed
    assert "The zero of axis 2 is -" in check.sentence
    store = tmp_path / "daily-checks.jsonl"
    append_check(store, entry(check, 1))
    found = read_history(store)
    assert not found.in_control
    assert found.charts["zero_2_N"].expanded == pytest.approx(4.0)


def test_u_of_the_check_is_taken_off_what_is_allowed() -> None:
    """1.8 N of 2 N along: within by simple acceptance, open with the guard band of JCGM 106."""
    off = (1.0047, 0.0, 0.0, 1.0047)
    check = checked(off)
    along, across, zero = check.expanded
    assert 0.05 < along < 0.4
    assert 0.6 < across < 0.9  # 0.05 degrees of the angle are 0.34 N, standard
    assert 0.0 < zero < 0.3
    assert "guard band w = U (JCGM 106)" in check.rule
    assert f"passed up to {check.allowed - along:.2f} N along" in check.rule
    assert check.largest < check.allowed
    assert not check.passed
    assert "too large to decide" in check.sentence
    simple = checked(off, guarded=False)
    assert simple.passed
    assert "simple acceptance (JCGM 106)" in simple.rule
    assert not checked((1.0055, 0.0, 0.0, 1.0055), guarded=False).passed


def test_the_store_keeps_rule_and_u(tmp_path: Path) -> None:
    check, store = checked(), tmp_path / "daily-checks.jsonl"
    append_check(store, entry(check, 1))
    found = read_history(store)
    assert found.entries[-1]["decision_rule"] == check.rule
    assert found.entries[-1]["expanded_uncertainty_N"]["along"] == check.expanded[0]
    assert check.rule in verdict_lines(found)


def test_a_weight_along_one_axis_does_not_judge_the_other() -> None:
    with pytest.raises(ValueError, match="along one axis only"):
        checked(angles=1)


def test_a_failed_check_of_before_is_told_as_failed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    store = tmp_path / "daily-checks.jsonl"
    new = ("gain_", "cross_talk_1", "cross_talk_2", "zero_1", "zero_2", "zero_al", "sentence")
    old = {key: value for key, value in entry(checked((1.01, 0.0, 0.0, 0.99)), 1).items()
           if not key.startswith(new)}  # fmt: skip
    append_check(store, old)
    assert show_history(store, store.with_suffix(".html"), None, as_json=True) == 1
    told = json.loads(capsys.readouterr().out)
    assert not told["in_control"]
    assert set(told["charts"]) == {"sensitivity_ratio", "cross_talk_ratio"}
    found = read_history(store)
    assert "N off, 2.00 N are allowed" in verdict_lines(found)[0]
