"""Cycles on a uniform grid of crank angles: true where there are samples, silent where not."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from storage_samples import METADATA
from typer.testing import CliRunner

from rigapp.cli.program import app
from rigapp.config.errors import UnusableInput
from rigapp.storage import FilePlan, create_test, export_test, on_grid, open_test

Array = NDArray[np.float64]


def wave(angle_deg: Array, harmonics: int = 5, seed: int = 1) -> Array:
    """Return a periodic curve of a few harmonics."""
    rng = np.random.default_rng(seed)
    order = np.arange(1, harmonics + 1)[:, None]
    strength, phase = rng.normal(size=(2, harmonics, 1))
    return (strength / order * np.cos(np.radians(order * angle_deg) + phase)).sum(axis=0)


def uneven(samples: int, seed: int = 2) -> Array:
    """Return growing angles of an uneven motion, over one turn from somewhere on."""
    steps = 1.0 + 0.5 * np.random.default_rng(seed).random(samples)
    return 77.0 + np.cumsum(steps) / steps.sum() * 360.0


@pytest.mark.parametrize("method", ["linear", "band-limited"])
@pytest.mark.parametrize("points", [72, 360, 361])
def test_a_smooth_curve_is_itself(method: str, points: int) -> None:
    angle = uneven(1800)
    grid = np.arange(points) * 360.0 / points
    found = on_grid(angle, wave(angle), points, method)  # type: ignore[arg-type]
    np.testing.assert_allclose(found, wave(grid), atol=2e-3)


@settings(max_examples=60, deadline=None)
@given(
    samples=st.integers(2, 400),
    points=st.integers(2, 500),
    seed=st.integers(0, 2**31),
    turns=st.integers(-2, 2),
)
def test_linear_never_leaves_the_samples_range(
    samples: int, points: int, seed: int, turns: int
) -> None:
    rng = np.random.default_rng(seed)
    angle, values = rng.uniform(0.0, 360.0, samples), rng.normal(size=samples)
    found = on_grid(angle + 360.0 * turns, values, points)
    inside = found[np.isfinite(found)]
    assert np.all(inside <= values.max() + 1e-12)
    assert np.all(inside >= values.min() - 1e-12)


def test_samples_on_the_grid_come_back_exactly() -> None:
    grid = np.arange(360.0)
    values = np.random.default_rng(3).normal(size=(2, 360))
    shuffled = np.random.default_rng(4).permutation(360)
    np.testing.assert_array_equal(on_grid(grid[shuffled], values[:, shuffled], 360), values)
    np.testing.assert_allclose(on_grid(grid + 720.0, values, 360), values, atol=1e-12)


def test_band_limited_averages_what_the_grid_cannot_carry() -> None:
    """A fast vibration looks like a slow wave on a coarse grid; averaged, it is gone."""
    angle = np.arange(3600) / 10.0
    slow, fast = wave(angle), np.cos(np.radians(71 * angle))
    grid = np.arange(72) * 5.0
    linear = on_grid(angle, slow + fast, 72) - wave(grid)
    limited = on_grid(angle, slow + fast, 72, "band-limited") - wave(grid)
    assert np.abs(linear).max() > 0.9
    assert np.abs(limited).max() < 0.02


def test_a_stand_counts_once() -> None:
    angle = np.concatenate((np.arange(360.0)[:100], np.full(500, 99.0), np.arange(360.0)[100:]))
    values = np.where(angle == 99.0, 7.0, 1.0)
    values[100:600:2], values[101:600:2] = 6.0, 8.0
    values[99] = 7.0
    assert on_grid(angle, values, 360)[99] == pytest.approx(7.0)


def test_nothing_is_made_up_over_a_gap() -> None:
    angle = np.arange(900) * 0.4
    kept = (angle < 100.0) | (angle > 130.0)
    values = wave(angle)
    found = on_grid(angle[kept], values[kept], 360)
    hole = np.isnan(found)
    np.testing.assert_array_equal(np.flatnonzero(hole), np.arange(100, 131))
    np.testing.assert_allclose(found[~hole], wave(np.arange(360.0))[~hole], atol=1e-2)
    with pytest.raises(ValueError, match="no samples for 30"):
        on_grid(angle[kept], values[kept], 360, "band-limited")


@pytest.mark.parametrize(
    ("angle", "points", "method", "words"),
    [
        ([1.0, 2.0], 1, "linear", "2 points"),
        ([5.0, 5.0], 10, "linear", "two angles"),
        ([1.0, 2.0], 10, "cubic", "cubic"),
    ],
)
def test_what_cannot_be(angle: list[float], points: int, method: str, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        on_grid(angle, angle, points, method)  # type: ignore[arg-type]


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """A file with two cycles of different length, their forces a known curve."""
    plan = FilePlan(revolutions=20, cycles=4, samples_per_cycle=1000, prediction=False)
    target = tmp_path / "test.h5"
    with create_test(target, plan, METADATA) as writer:
        for revolution, samples in ((3, 900), (7, 940)):
            angle = np.mod(uneven(samples), 360.0)
            columns = {one.name: np.zeros(samples) for one in plan.cycle_columns}
            columns |= {"angle": angle, "force_1": 3.0 * wave(angle), "force_2": 4.0 * wave(angle)}
            writer.append_cycle(revolution, columns)
    return target


def test_a_stored_cycle_on_a_grid(path: Path) -> None:
    with open_test(path) as reader:
        even = reader.cycle(0).resampled(points=180)
        assert even.revolution == 3
        assert list(even.columns) == ["angle", "force_1", "force_2", "force", "probe_1", "probe_2"]
        wanted = wave(np.arange(180) * 2.0)
        np.testing.assert_allclose(even.columns["force_1"], 3.0 * wanted, atol=5e-3)
        np.testing.assert_allclose(even.columns["force"], 5.0 * np.abs(wanted), atol=1e-2)
        difference = even.columns["force_2"] - reader.cycle(1).resampled(180).columns["force_2"]
        assert np.abs(difference).max() < 1e-2


@pytest.mark.sampled
@pytest.mark.parametrize("ending", [".csv", ".parquet"])
def test_export_on_a_grid(path: Path, tmp_path: Path, ending: str) -> None:
    target = tmp_path / f"even{ending}"
    done = CliRunner().invoke(
        app, ["export", str(path), "--to", str(target), "--cycles", "--points", "72"]
    )
    assert done.exit_code == 0, done.output
    assert "144 rows" in done.output
    if ending == ".csv":
        with target.open(newline="") as file:
            table = list(csv.DictReader(file))
        assert list(table[0]) == [
            "revolution", "angle_deg", "force_1_N", "force_2_N", "force_N", "probe_1_um",
            "probe_2_um",
        ]  # fmt: skip
        assert [row["revolution"] for row in table] == ["3"] * 72 + ["7"] * 72
        assert float(table[73]["angle_deg"]) == 5.0


def test_points_need_cycles(path: Path, tmp_path: Path) -> None:
    for options in ({"points": 100}, {"cycles": True, "points": 1}):
        with pytest.raises(UnusableInput, match="--points"):
            export_test(path, tmp_path / "no.csv", **options)  # type: ignore[arg-type]
    assert not (tmp_path / "no.csv").exists()
