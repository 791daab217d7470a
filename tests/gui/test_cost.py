"""What has not changed is not worked on again, and what is drawn for less is drawn the same."""

from __future__ import annotations

import gc
import subprocess
import sys
import weakref
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from patience import PATIENCE_MS
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from rigapp.gui.panels.results import ResultsPump
from rigapp.gui.plots.curves import ShadedBand, Trace, clear
from rigapp.gui.results.results_index import ResultsIndex
from rigapp.gui.window import places
from rigapp.gui.window.app import collect_between_events
from rigapp.gui.window.places import PageBar, PageName, RailPlace
from rigapp.process.memory import begin_to_load, collect_when_due, end_of_loading
from rigapp.viewer import pyramid as levels
from rigapp.viewer.comparison import CURVES, binned, stacked
from rigapp.viewer.pyramid import Pyramid, thinned
from rigapp.viewer.series import PredictedCycle
from rigapp.viewer.tasks import TaskWorker

ANGLE = np.linspace(0.0, 360.0, 1000, endpoint=False)


def three_curves() -> np.ndarray:
    """Return three curves (3, 1000) with noise."""
    random = np.random.default_rng(4)
    return np.cos(np.radians(ANGLE)) + random.normal(0.0, 0.1, (3, len(ANGLE)))


@pytest.mark.parametrize("buckets", [2000, 400, 333, 300, 7, 1])
def test_curves_thinned_together_are_those_thinned_alone_and_keep_every_extreme(
    buckets: int,
) -> None:
    curves = three_curves()
    at, together = thinned(ANGLE, curves, buckets)
    for curve, thin in zip(curves, together, strict=True):
        alone_at, alone = thinned(ANGLE, curve, buckets)
        np.testing.assert_array_equal(at, alone_at)
        np.testing.assert_array_equal(thin, alone)
        assert (thin.min(), thin.max()) == (curve.min(), curve.max())


def test_bins_of_curves_hold_the_means_of_their_angles() -> None:
    curves = three_curves()
    middles, means = binned(ANGLE, curves, 2.0)
    assert means.shape == (3, len(middles))
    for middle, mean in zip(middles, means.T, strict=True):
        inside = np.floor(ANGLE / 2.0) == np.floor(middle / 2.0)
        np.testing.assert_allclose(mean, curves[:, inside].mean(axis=1))


@given(arrays(np.float64, 24, elements=st.floats(-720.0, 720.0)))
def test_a_predicted_curve_goes_round_at_any_angle(angles: np.ndarray) -> None:
    grid = np.arange(0.0, 360.0, 3.0)
    values = np.cos(np.radians(grid)).astype(np.float32)
    predicted = PredictedCycle(1, grid, dict.fromkeys(CURVES, values))
    expected = np.interp(angles, grid, values, period=360.0)
    np.testing.assert_allclose(predicted.at(angles, CURVES[0]), expected, atol=1e-9)


def test_curves_are_stacked_in_their_own_order() -> None:
    curves = {name: np.full(2, float(at)) for at, name in enumerate(CURVES)}
    assert stacked(dict(reversed(curves.items())))[:, 0].tolist() == [0.0, 1.0, 2.0]


def test_a_new_row_renews_only_the_levels_that_are_looked_at(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    series = Pyramid()
    series.extend(np.arange(100_000, dtype=np.float32))
    series.settle()
    series.extend(np.array([-1.0], dtype=np.float32))
    written: list[int] = []
    write = levels.GrowingArray.write

    def counted(self: Any, start: int, values: np.ndarray) -> None:
        written.append(start)
        write(self, start, values)

    monkeypatch.setattr(levels.GrowingArray, "write", counted)
    series.envelope(99_000, 100_001, 200)
    assert len(written) == 0, "eight rows a bucket: the rows themselves"
    series.envelope(0, 100_001, 1000)
    assert len(written) == 2, "128 rows a bucket: minimum and maximum of one level"


def test_levels_looked_at_late_know_every_row_written_meanwhile() -> None:
    series = Pyramid(capacity=16)
    for number in range(40):
        series.extend(np.full(137, float(number), dtype=np.float32))
        series.envelope(0, len(series), (4000, 100, 5)[number % 3])
        if number == 20:
            series.write(100, np.full(3, -9.0))
    fresh = Pyramid()
    fresh.extend(series.values)
    for buckets in (2000, 150, 9):
        seen, wanted = (one.envelope(0, len(series), buckets) for one in (series, fresh))
        np.testing.assert_array_equal(seen.low, wanted.low)
        np.testing.assert_array_equal(seen.high, wanted.high)


def test_clearing_what_is_empty_paints_nothing() -> None:
    told: list[str] = []
    curve, band = Trace(lambda: told.append("curve")), ShadedBand(lambda: told.append("band"))
    clear(curve, band)
    assert told == []
    one = np.arange(3.0)
    curve.setData(one, one)
    band.setData(one, one, one + 1.0)
    clear(curve, band)
    assert told == ["curve", "band"] * 2
    assert len(curve.x) == len(band.low) == 0


def test_pages_that_stay_are_not_laid_out_again(
    qtbot: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    bar = PageBar(())
    qtbot.addWidget(bar)
    laid_out: list[int] = []
    monkeypatch.setattr(places, "follow_in_tab_order", lambda *parts: laid_out.append(len(parts)))
    pages = [PageName(0, "Overview", "Ctrl+1"), PageName(1, "Cycle", "Ctrl+2")]
    for _ in range(3):
        bar.show_pages(RailPlace.WATCH, pages, 0)
    assert len(laid_out) == 1
    bar.show_pages(RailPlace.WATCH, pages, 1)
    assert len(laid_out) == 2
    assert bar.buttons[1].isChecked()


def test_a_shelf_that_reads_nothing_is_looked_at_seldom(qtbot: Any, tmp_path: Path) -> None:
    worker, parent = TaskWorker("test-shelf"), QWidget()
    qtbot.addWidget(parent)
    shelf = ResultsIndex(tmp_path, worker)
    pump = ResultsPump(shelf, lambda: None, parent)
    soon = pump.interval()
    pump.pump()
    seldom = pump.interval()
    assert seldom > soon
    shelf.look()
    pump.pump()
    assert pump.interval() == soon
    shelf.close()
    worker.close()


def test_what_a_start_has_made_is_not_searched_for_garbage() -> None:
    before = gc.get_freeze_count()
    try:
        begin_to_load()
        assert not gc.isenabled()
        made: list[list[int]] = [[] for _ in range(1000)]
        end_of_loading()
        assert gc.isenabled()
        assert gc.get_freeze_count() >= before + len(made)
    finally:
        gc.unfreeze()
        gc.enable()


class Cycle:
    """Garbage that only a collection finds."""

    def __init__(self) -> None:
        self.itself = self


def test_garbage_is_collected_between_events_only(qapp: QApplication, qtbot: QtBot) -> None:
    thresholds = gc.get_threshold()
    timer = collect_between_events(qapp)
    try:
        assert gc.get_threshold()[0] == 0, "a collection within a call of Qt can wait for itself"
        collected = weakref.ref(Cycle())
        made = [[n] for n in range(100_000)]
        assert collected() is not None
        assert made
        timer.start(1)
        qtbot.waitUntil(lambda: collected() is None, timeout=PATIENCE_MS)
        begin_to_load()
        loading = weakref.ref(Cycle())
        made = [[n] for n in range(100_000)]
        for _ in range(20):
            collect_when_due()
        assert loading() is not None
    finally:
        timer.stop()
        gc.enable()
        gc.set_threshold(*thresholds)


def test_the_window_and_the_room_that_a_test_needs_load_no_kernels() -> None:
    """Half a second would be lost where the page that prepares a test is opened first."""
    code = (
        "import sys, rigapp.gui.window.window, rigapp.service.preflight,"
        " rigapp.engine.recording.fileplan;"
        "print(*{'numba', 'scipy', 'llvmlite'} & set(sys.modules))"
    )
    found = subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE, check=True)
    assert not found.stdout.strip()
