"""The page of a trip: the seconds around it, what tripped, how soon the crank was at rest."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from patience import PATIENCE_MS

from rigapp.gui.panels import trip as module
from rigapp.gui.panels.results import show_trip
from rigapp.gui.panels.trip import NO_TRIP, NOT_KEPT, TripPage
from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import LIGHT
from rigapp.schema.channels import BASE, Channel, ChannelTable, Kind
from rigapp.storage import LargestForce, Trip, TripCapture, TripPiece
from rigapp.viewer.tasks import TaskWorker

CURRENT = Channel("motor_current", "A", "current of the motor", Kind.SLOW)


def piece(start: float, stop: float, *, before: bool = False) -> TripPiece:
    """Return a stretch of samples in which the force rises to 300 N at time 0."""
    time_s = np.linspace(start, stop, 50)
    force = np.interp(time_s, [-1.0, 0.0, 1.0], [80.0, 300.0, 20.0])
    values = {"force": force, "force_1": force, "force_2": 0.0 * force, "probe_1": 500.0 + force,
              "probe_2": 0.0 * force, "speed": np.full(50, 60.0)}  # fmt: skip
    return TripPiece(time_s, values, before)


def capture(**changed: Any) -> TripCapture:
    """Return what a file says of an overload in revolution 12."""
    trip = Trip(12, None, None, LargestForce(301.5, 12, 187.0), trigger_N=300.0)
    given: dict[str, Any] = {
        "trip": trip,
        "pieces": (piece(-2.0, -1.0, before=True), piece(-1.0, 1.0)),
        "currents": {"motor_current": (np.array([-1.0]), np.array([1.9]))},
        "sentence": "The joint force reached 301.5 N; the limit is 300 N.",
        "happened": 1795831251.968,
        "stood_s": 1.05,
        "turned_s": 0.8,
        "table": ChannelTable((*BASE.channels, CURRENT)),
    }
    return TripCapture(**{**given, **changed})


@pytest.fixture
def page(qtbot: Any, light_application: Any, monkeypatch: pytest.MonkeyPatch) -> TripPage:
    worker = TaskWorker("test-trip")
    made = TripPage(LIGHT, worker)
    qtbot.addWidget(made)
    made.show()
    return made


def load(page: TripPage, qtbot: Any, monkeypatch: pytest.MonkeyPatch, found: object) -> None:
    """Show a test of which the file says ``found``."""
    monkeypatch.setattr(module, "load_capture", lambda path: found)
    page.show_test(Path("a.h5"))

    def read() -> bool:
        page._worker.deliver()
        return "Reading" not in page.sentence.text()

    qtbot.waitUntil(read, timeout=PATIENCE_MS)


def test_it_draws_every_channel_with_the_trip_at_time_0(
    page: TripPage, qtbot: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    load(page, qtbot, monkeypatch, capture())
    force, pin, speed = page.plots
    assert page.sentence.text().startswith("The joint force reached 301.5 N")
    assert [one.text for one in force.plot.marks.names] == ["along", "across", "|F|"]
    (spot,) = force.plot.marks.spots
    assert (spot.x, spot.y) == (0.0, 300.0)
    assert "300.0 N" in spot.text
    for one in (force, pin, speed, page.current):
        assert not one.isHidden()
        low, high = one.plot.viewRange()[0]
        assert low <= -2.0 < 1.0 <= high
    assert [one.text for one in page.current.plot.marks.names] == ["Motor current"]
    drawn = [trace.y for trace, _ in pin.plot.drawn()]
    assert max(abs(float(np.nanmean(one))) for one in drawn) < 1e-9, "less its mean"


def test_it_says_how_soon_the_crank_was_at_rest_and_what_is_unknown(
    page: TripPage, qtbot: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    load(page, qtbot, monkeypatch, capture())
    facts = dict(page.table.texts())
    assert facts["Largest force"] == "301.5 N at 187°"
    assert facts["Last movement"].startswith("0.80 s after the trip")
    assert facts["Confirmed at rest"].startswith("1.05 s after the alarm")
    assert facts["Alarm logged"].endswith("51.968")
    load(page, qtbot, monkeypatch, capture(happened=math.nan, stood_s=math.nan, currents={}))
    facts = dict(page.table.texts())
    assert facts["Alarm logged"] == facts["Drive off"] == "–"
    assert page.current.isHidden()


def test_a_test_that_did_not_trip_says_so(
    page: TripPage, qtbot: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert page.sentence.text() == NO_TRIP
    load(page, qtbot, monkeypatch, None)
    assert page.sentence.text() == NOT_KEPT
    assert page.plots[0].isHidden() or not page.plots[0].isVisible()


def test_results_lead_to_the_trip(
    window: MainWindow, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(module, "load_capture", lambda path: capture())
    show_trip(window.tabs.settings._host, str(tmp_path / "a.h5"))
    page = window.tabs.panels["trip"]
    assert isinstance(page, TripPage)
    assert page.path == tmp_path / "a.h5"
    assert page.isVisible()
