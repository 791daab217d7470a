"""Every benchmark still runs: each is carried out once, with small sizes."""

from __future__ import annotations

import json
import os
import runpy
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from patience import PATIENCE_S

from benchmarks.__main__ import RATIOS, fallen
from benchmarks.budgets import BUDGETS

FOLDER = Path(__file__).parents[2] / "benchmarks"
OF_A_RIG = {"gui", "length", "page", "screen", "service", "study", "trip", "start"}
"""Benchmarks that start processes of their own, or a window: minutes, so they are soak tests."""
BENCHMARKS = {path.stem.removeprefix("bench_"): path for path in FOLDER.glob("bench_*.py")}
SMALL = {"RIGAPP_BENCH_SMALL": "1"}


def collected(path: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in path.read_text("utf-8").splitlines()]


@pytest.mark.sampled
@pytest.mark.parametrize("name", sorted(BENCHMARKS.keys() - OF_A_RIG))
def test_a_benchmark_runs(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    figures = tmp_path / "figures"
    monkeypatch.setenv("RIGAPP_BENCH_SMALL", "1")
    monkeypatch.setenv("RIGAPP_BENCH_FIGURES", str(figures))
    monkeypatch.setattr(sys, "argv", [name])
    monkeypatch.setattr(sys, "path", [str(FOLDER), *sys.path])
    monkeypatch.setattr(os, "sched_setaffinity", lambda pid, cores: None, raising=False)
    monkeypatch.delitem(sys.modules, "budgets", raising=False)
    runpy.run_path(str(BENCHMARKS[name]), run_name="__main__")
    assert any("value" in one for one in collected(figures))


@pytest.mark.soak
@pytest.mark.parametrize("name", sorted(OF_A_RIG))
def test_a_benchmark_of_a_whole_rig_runs(name: str, tmp_path: Path) -> None:
    figures = tmp_path / "figures"
    done = subprocess.run(
        [sys.executable, BENCHMARKS[name]],
        env={**os.environ, **SMALL, "RIGAPP_BENCH_FIGURES": str(figures)},
        capture_output=True,
        text=True,
        timeout=10 * PATIENCE_S,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert collected(figures)


@pytest.mark.parametrize(
    ("name", "stored", "now", "told"),
    [
        ("contact_peer", 12_000.0, 8_100.0, False),
        ("contact_peer", 12_000.0, 7_900.0, True),
        ("contact_peer", 12_000.0, 20_000.0, False),
        ("help", 4.0, 5.9, False),  # times the bare interpreter: less is better
        ("help", 4.0, 6.1, True),
        ("closed_form", 0.0, 1.0, False),  # nothing stored yet
    ],
)
def test_a_ratio_that_falls_by_more_than_a_third_is_told(
    name: str, stored: float, now: float, told: bool
) -> None:
    row = {"name": name, "what": name, "peer": "peer", "ratio": now}
    without = {"name": "trip", "what": "trip", "peer": "", "ratio": None}
    found = fallen([row, without, {"skipped": "x", "why": "y"}], {name: stored} if stored else {})
    assert len(found) == told
    assert not told or (name in found[0] and "stored" in found[0])


def test_stored_ratios_are_of_figures_that_have_a_budget() -> None:
    stored = json.loads(RATIOS.read_text("utf-8"))
    assert stored
    assert stored.keys() <= BUDGETS.keys()


def test_the_last_table_names_what_was_missed_and_what_was_skipped(tmp_path: Path) -> None:
    table = tmp_path / "table.json"
    done = subprocess.run(
        [sys.executable, "-m", "benchmarks", "gsv8", "--json", table],
        cwd=FOLDER.parent,
        env={**os.environ, **SMALL},
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    (row,) = json.loads(table.read_text("utf-8"))
    assert row["what"] == "parse GSV-8 float32 frames"
    assert row["kept"] == (row["value"] >= row["limit"])
    assert ("kept" if row["kept"] else "MISSED") in done.stdout.splitlines()[-1]
