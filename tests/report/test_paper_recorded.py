"""Figs 20 and 21 of the paper from a recorded test."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from report_samples import append, curves, metadata

from rigapp.config.errors import UnusableInput
from rigapp.report.paper.pages import Chapter, write_chapter
from rigapp.report.paper.recorded import recorded_chapters
from rigapp.schema.columns import PROFILE_ANGLES_DEG, profile_columns
from rigapp.schema.messages import Flag
from rigapp.storage import FilePlan, create_test

ANGLES = np.asarray(PROFILE_ANGLES_DEG, dtype=np.float64)


def depths() -> dict[str, np.ndarray]:
    """Return a worn profile that was seen in part only."""
    shape = np.maximum(1.0 - (ANGLES / 20.0) ** 2, 0.0)
    seen = np.where(np.abs(ANGLES) < 25.0, shape, np.nan)
    return {
        "measured": 0.030 * seen,
        "predicted": 0.028 * shape,
        "driven": 0.029 * shape,
        "uncertainty": np.full(ANGLES.size, 0.002),
    }


@pytest.fixture(scope="module")
def paper(quick_folder: Path) -> Path:
    """Record a test of 60 revolutions, the first a ramp, with a worn profile."""
    plan = FilePlan(60, cycles=20, samples_per_cycle=960, events=256, profiles=10)
    path = quick_folder / "paper.h5"
    parameters = {"joint": {"bushing_radius_mm": 10.0, "bushing_width_mm": 13.1}}
    with create_test(path, plan, replace(metadata("Paper"), parameters=parameters)) as writer:
        for revolution in range(1, 61):
            quality = int(Flag.RAMP) if revolution == 1 else 0
            append(writer, revolution, quality, keep=revolution % 20 == 0)
        values = dict.fromkeys((one.name for one in profile_columns()), 1.0)
        values |= {"revolution": 60, "revolutions": 4}
        writer.append_profile(list(values.values()), depths())
        writer.finish("complete", "revolutions", "All are made.")
    return path


@pytest.fixture(scope="module")
def chapters(paper: Path) -> dict[str, Chapter]:
    """Return the chapters of that test."""
    return {chapter.name: chapter for chapter in recorded_chapters(paper)}


def test_force_of_a_cycle_stands_beside_the_models(chapters: dict[str, Chapter]) -> None:
    chapter = chapters["fig20_force"]
    assert "revolution 60" in chapter.title
    table = chapter.columns
    model = curves(np.arange(360.0))
    for name in ("force_1", "force_2", "force"):
        np.testing.assert_allclose(table[f"{name}_model_N"], model[name], rtol=1e-5, atol=1e-4)
        measured = curves(np.arange(360.0), 60 / 200.0)[name]
        assert np.sqrt(np.mean((table[f"{name}_measured_N"] - measured) ** 2)) < 1.0
    assert "Root mean square of the difference" in chapter.sentences[1]


def test_extrema_leave_out_what_was_not_at_a_steady_speed(chapters: dict[str, Chapter]) -> None:
    table = chapters["fig20_extrema"].columns
    assert list(table) == ["revolution", "force_max_N", "force_rms_N", "force_min_N"]
    assert table["revolution"].tolist() == list(range(1, 61))
    assert np.isnan([table[name][0] for name in list(table)[1:]]).all()
    assert np.isfinite([table[name][1:] for name in list(table)[1:]]).all()
    assert np.all(table["force_max_N"][1:] > table["force_rms_N"][1:])


def test_long_tests_keep_every_peak(monkeypatch: pytest.MonkeyPatch, paper: Path) -> None:
    monkeypatch.setattr("rigapp.report.paper.recorded.MOST_ROWS", 7)
    found = {one.name: one for one in recorded_chapters(paper)}
    table = found["fig20_extrema"].columns
    assert len(table["revolution"]) == 7
    monkeypatch.undo()
    every = {one.name: one for one in recorded_chapters(paper)}
    whole = every["fig20_extrema"].columns
    assert np.nanmax(table["force_max_N"]) == np.nanmax(whole["force_max_N"])
    assert np.nanmin(table["force_min_N"]) == np.nanmin(whole["force_min_N"])
    assert np.isfinite(table["force_rms_N"]).all()


@pytest.mark.sampled
@pytest.mark.parametrize("steady", [0, 1, 3])
def test_a_test_that_hardly_left_its_ramp_says_so(tmp_path: Path, steady: int) -> None:
    path = tmp_path / "ramp.h5"
    plan = FilePlan(20, cycles=20, samples_per_cycle=960, events=16)
    with create_test(path, plan, metadata()) as writer:
        for revolution in range(1, 6):
            append(writer, revolution, 0 if revolution > 5 - steady else int(Flag.RAMP), keep=False)
        writer.finish("stopped", "operator", "Stopped at once.")
    chapters = {one.name: one for one in recorded_chapters(path)}
    chapter = chapters["fig20_extrema"]
    assert chapter.sentences[0].startswith("Too few revolutions are at steady speed")
    write_chapter(tmp_path, chapter)


def test_profile_is_compared_where_it_is_known(chapters: dict[str, Chapter]) -> None:
    table = chapters["fig21_recorded"].columns
    assert np.nanmax(table["depth_measured_mm"]) == pytest.approx(0.030, rel=1e-3)
    assert np.isnan(table["depth_measured_mm"]).sum() > 100
    assert "0.03 mm measured" in chapters["fig21_recorded"].sentences[0]


def test_all_can_be_drawn_and_read_again(chapters: dict[str, Chapter], tmp_path: Path) -> None:
    for chapter in chapters.values():
        (table, drawn), _ = write_chapter(tmp_path, chapter)
        assert drawn.read_bytes().startswith(b"\x89PNG")
        rows = np.loadtxt(table, delimiter=",", skiprows=1)
        assert rows.shape == (len(next(iter(chapter.columns.values()))), len(chapter.columns))


def test_files_without_data_are_named(tmp_path: Path) -> None:
    path = tmp_path / "empty.h5"
    plan = FilePlan(10, cycles=2, samples_per_cycle=10, events=16)
    with create_test(path, plan, metadata()) as writer:
        writer.finish("stopped", "operator", "Stopped at once.")
    with pytest.raises(UnusableInput, match=r"empty\.h5: it holds no complete revolution"):
        list(recorded_chapters(path))
    with pytest.raises(UnusableInput, match="nowhere"):
        list(recorded_chapters(tmp_path / "nowhere.h5"))
