"""What plots show beside their curves, and what their axes follow."""

from __future__ import annotations

import itertools
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QFont, QImage, QPainter
from snapshots import ALARM, REVOLUTION_NAMES, make_snapshot, make_status

from rigapp.config.loading import parse_test
from rigapp.gui.plots.marks import (
    CurveName,
    LimitLine,
    PlotFrame,
    Spot,
    name_room,
    paint_names,
    paint_next_limits,
    paint_spots,
    small_font,
    spread,
)
from rigapp.gui.plots.overlay import OverlayPanel
from rigapp.gui.plots.palette import LinePen
from rigapp.gui.plots.trend import TrendPanel
from rigapp.gui.plots.trendview import TrendView
from rigapp.presentation.numbers import axis_number
from rigapp.presentation.tokens import DARK, LIGHT
from rigapp.schema.alarms import rule_key
from rigapp.schema.loglines import AlarmChange, alarm_line
from rigapp.schema.messages import Event, Flag, Severity
from rigapp.storage import LargestForce
from rigapp.viewer.lines import EVERYTHING, Drawn, Flagged, banded, drawn, newest_good
from rigapp.viewer.moments import moments
from rigapp.viewer.news import News
from rigapp.viewer.ranges import round_places
from rigapp.viewer.recording import TripCycles
from rigapp.viewer.series import LiveData, measured_cycle
from rigapp.viewer.shown import Level

QUICK = (Path(__file__).parents[2] / "examples" / "quick.toml").read_text(encoding="utf-8")
RULES = (
    '\n[[limits.rule]]\nquantity = "force_max"\nwarning_above = 98.0\n'
    '\n[[limits.rule]]\nquantity = "force_min"\nwarning_below = 20.0\n'
)
RECIPE = parse_test(QUICK + RULES, "x")
LOG = (
    Event(1.8e9, 40, "note", "Ann", "oil added"),
    alarm_line(1.8e9, 90, "x", ALARM, AlarmChange("raised", "Force is high")),
    alarm_line(1.8e9, 90, "x", ALARM, AlarmChange("acknowledged", "Force is high")),
    Event(1.8e9, 95, "command", "Ann", "pause"),
)


def tripped(count: int = 200, flags: Flag = Flag.SENSOR_FAULT) -> LiveData:
    """Return a test whose revolution 150 is far off, and flagged."""
    plain = make_snapshot(1, count)
    rows = np.frombuffer(plain.rows).reshape(count, -1).copy()
    rows[149, REVOLUTION_NAMES.index("force_max")] = 391.0
    rows[149, REVOLUTION_NAMES.index("quality")] = int(flags)
    data = LiveData()
    data.take(msgspec.structs.replace(plain, rows=rows.tobytes()))
    return data


def largest(data: LiveData, buckets: int) -> Drawn:
    """Return what is drawn of the largest force."""
    flagged = Flagged(data.rows, EVERYTHING, buckets)
    return drawn(data.rows, "force_max", flagged, EVERYTHING, buckets)


@pytest.mark.parametrize("buckets", [1000, 50])
def test_a_flagged_revolution_does_not_range_the_axis(buckets: int) -> None:
    data = tripped()
    line = largest(data, buckets)
    assert line.high < 100.0
    assert line.above is not None
    assert line.above[1] == 391.0
    assert line.above[0] == pytest.approx(150.0, abs=len(data.rows) / buckets)
    assert line.y.max() == 391.0, "it is drawn all the same"
    unflagged = tripped(flags=Flag.GOOD)
    assert largest(unflagged, buckets).high == 391.0


def test_a_table_with_fewer_rows_finds_the_flag_within_its_buckets() -> None:
    flagged = Flagged(tripped().rows, EVERYTHING, 1000)
    starts = np.array([1.0, 140.0, 148.0, 160.0])  # the third reaches up to revolution 159
    assert list(flagged.at(starts)) == [False, False, True, False]
    assert list(flagged.at(starts[:3])) == [False, False, True], "the last one up to the end"


def test_the_newest_good_revolution_is_the_one_before_a_fault() -> None:
    assert newest_good(tripped(150).rows, tripped(150).rows) == 148
    assert newest_good(tripped(150, Flag.GOOD).rows, tripped(150, Flag.GOOD).rows) == 149
    assert newest_good(tripped().rows, tripped().rows) == 199


def test_where_every_revolution_is_flagged_all_of_them_range_the_axis() -> None:
    data = tripped()
    quality = np.full(len(data.rows), int(Flag.TIME_JUMP))
    data.rows.series("quality").write(0, quality)
    assert largest(data, 1000).high == 391.0


def test_a_band_holds_every_value_with_its_uncertainty() -> None:
    table = tripped().predictions
    at, low, high = banded(table, "force_max", "force_uncertainty", EVERYTHING, 16)
    values, half = (table.series(name).values for name in ("force_max", "force_uncertainty"))
    for place, revolution in enumerate(table.revolutions):
        bucket = int(np.searchsorted(at, revolution, side="right")) - 1
        assert low[bucket] <= values[place] - half[place] + 1e-4
        assert high[bucket] >= values[place] + half[place] - 1e-4


@given(st.lists(st.floats(-50.0, 150.0), min_size=1, max_size=8))
def test_names_stand_apart_in_the_order_of_their_curves(wanted: list[float]) -> None:
    found = spread(wanted, 12.0, 0.0, 100.0)
    assert all(-1e-6 <= one <= 100.0 + 1e-6 for one in found)
    placed = sorted(found)
    assert all(b - a >= 12.0 - 1e-6 for a, b in itertools.pairwise(placed))
    order = sorted(range(len(wanted)), key=lambda one: wanted[one])
    assert [found[one] for one in order] == placed


class Written:
    """A painter that remembers the lines of text, and how high each stands."""

    def __init__(self) -> None:
        self.lines: list[tuple[float, str]] = []

    def drawText(self, place: QPointF, text: str) -> None:
        self.lines.append((place.y(), text))

    def setFont(self, font: QFont) -> None:
        pass

    def setPen(self, pen: Any) -> None:
        pass


@pytest.mark.parametrize(("height", "most"), [(20.0, 1), (50.0, 4), (300.0, 4)])
def test_names_that_have_no_room_are_left_out_the_last_ones_first(
    qapp: Any, height: float, most: int
) -> None:
    texts = ("maximum", "RMS", "minimum", "model")
    names = [CurveName(text, LinePen("text"), 50.0) for text in texts]
    frame = PlotFrame(QRectF(0.0, 0.0, 200.0, height), (0.0, 1.0), (0.0, 100.0))
    painter: Any = Written()
    paint_names(painter, frame, names, LIGHT)
    assert {text for _, text in painter.lines} == set(texts[: len(painter.lines)])
    assert len(painter.lines) <= most
    capitals = small_font(strong=True)[1].capHeight()
    places = sorted(y for y, _ in painter.lines)
    assert all(b - a > capitals for a, b in itertools.pairwise(places))


@pytest.mark.parametrize("at", [0.05, 0.5, 0.95])
def test_the_next_limit_is_written_where_no_peak_stands(qapp: Any, at: float) -> None:
    frame = PlotFrame(QRectF(0.0, 0.0, 300.0, 120.0), (0.0, 1.0), (0.0, 100.0))
    taken: list[QRectF] = []
    picture = QImage(400, 200, QImage.Format.Format_RGB32)
    painter = QPainter(picture)
    paint_spots(painter, frame, [Spot(at, 98.0, "87.1 N at 193°", LinePen("text"))], LIGHT, taken)
    assert len(taken) == 2
    limit = LimitLine(380.0, "drive off above 380 N")
    paint_next_limits(painter, frame, [limit], LIGHT, taken)
    painter.end()
    *peak, words = taken
    assert len(peak) == 2
    assert not any(words.intersects(one) for one in peak)


@given(st.floats(-1e6, 1e6), st.floats(1e-3, 1e6))
def test_an_axis_has_at_least_three_round_ticks_within_it(low: float, span: float) -> None:
    step, places = round_places(low, low + span, 4)
    assert 3 <= len(places) <= 11
    assert all(low - 1e-6 * step <= one <= low + span + 1e-6 * step for one in places)


def test_numbers_at_an_axis_are_grouped_with_a_true_minus() -> None:
    texts = [axis_number(*one) for one in ((-1500.0, 500.0), (0.25, 0.05), (-0.0, 1.0))]
    assert texts == ["−1\u202f500", "0.25", "0"]


def test_notes_and_raised_alarms_stand_at_the_trends() -> None:
    found = moments(LOG)
    assert [(one.revolution, one.words, one.severity) for one in found] == [
        (40, "oil added", None),
        (90, "Force is high", Severity.WARNING),
    ]


def test_trends_show_limits_moments_and_the_value_that_is_off_the_axis(qtbot: Any) -> None:
    panel = TrendPanel("x", LIGHT)
    qtbot.addWidget(panel)
    panel.show_news(News(data=tripped(), recipe=RECIPE, events=LOG))
    marks = panel.plot.marks
    words = [one.words for one in marks.limits]
    assert words == ["drive off above 380 N", "warn above 98 N", "warn below 20 N"]
    assert not any(one.level for one in marks.limits), "without an alarm"
    assert [one.words for one in marks.moments] == ["oil added", "Force is high"]
    assert [one.text for one in marks.spots] == ["391 N"]
    assert panel.plot.viewRange()[1][1] <= 120.0
    assert "model ± U" in [one.text for one in marks.names]
    for theme in (DARK, LIGHT):
        panel.dress(theme)
        panel.resize(460, 300)
        assert not panel.grab().isNull()


def test_trends_of_a_page_move_and_point_together_and_start_afresh(qtbot: Any) -> None:
    view = TrendView()
    panels = [
        TrendPanel(name, LIGHT, what, view=view) for name, what in (("a", "force"), ("b", "wear"))
    ]
    news = News(data=tripped())
    for panel in panels:
        qtbot.addWidget(panel)
        panel.show_news(news)
    for panel in panels:
        assert view.room.width >= name_room(panel.plot.marks.names) > 0, "no name is cut"
    view.move(20.0, 60.0)
    panels[0].view.point_at(33.4)
    for panel in panels:
        panel.show_news(news)
        assert panel.plot.viewRange()[0] == [20.0, 60.0]
        assert panel.plot.cursor_line.value() == 33.0
        assert panel.words.startswith("At cycle 33: ")
        assert not any(one.isChecked() for one in panel.modes.values())
    for panel in panels:
        panel.show_news(News(data=tripped(20 * 10)))
        assert panel.plot.viewRange()[0][0] == 1.0
        assert not panel.plot.cursor_line.isVisible()


def test_after_a_trip_its_revolution_stands_over_the_last_good_one(
    qtbot: Any, make_status: Any
) -> None:
    overlay = OverlayPanel("x", LIGHT)
    qtbot.addWidget(overlay)
    data = LiveData()
    data.take(make_snapshot(182, 1))  # the last one that somebody looked at
    overlay.show_news(News(data=data, status=make_status()))
    good, part = (
        measured_cycle(msgspec.structs.replace(make_snapshot(1, 1).cycle, revolution=number))
        for number in (963, 964)
    )
    peak = LargestForce(1039.44, 964, 20.0, lower_bound=True, complete=False)
    trip = TripCycles(964, part, good, peak)
    overlay.show_news(News(data=data, status=make_status(), trip=trip))
    assert overlay.title.whole == "N, cycle 964, tripped, model 182"
    assert "last good 963" in [one.text for one in overlay.plot.marks.names]
    (spot,) = overlay.plot.marks.spots
    assert (spot.y, spot.text.partition(" at ")[0]) == (1039.44, "≥ 1039.4 N")
    older = replace(trip, revolution=965, before=measured_cycle(make_snapshot(960, 1).cycle))
    overlay.show_news(News(data=data, status=make_status(), trip=older))
    assert "last saved 960" in [one.text for one in overlay.plot.marks.names]
    data.take(make_snapshot(1, 1))
    overlay.show_news(News(data=data, status=make_status()))
    assert not any(one.text.startswith("last") for one in overlay.plot.marks.names)


def test_the_force_is_shown_with_its_limits_and_over_a_frozen_revolution(qtbot: Any) -> None:
    overlay = OverlayPanel("x", LIGHT)
    qtbot.addWidget(overlay)
    overlay.freeze.click()
    assert not overlay.freeze.isChecked(), "there is nothing to freeze"
    data = LiveData()
    data.take(make_snapshot(1, 9))
    overlay.show_news(News(data=data, recipe=RECIPE))
    assert not any(one.level for one in overlay.plot.marks.limits), "colour comes from alarms alone"
    key = rule_key("force_max", "warning", "above")
    warned = make_status(alarms=(msgspec.structs.replace(ALARM, key=key),))
    overlay.show_news(News(warned, data, RECIPE))
    limits = {one.words: one.level for one in overlay.plot.marks.limits}
    assert limits == {"drive off above 380 N": Level.NORMAL, "warn above 98 N": Level.WARNING}
    overlay.freeze.click()
    data.take(make_snapshot(10, 1))
    overlay.show_news(News(data=data, recipe=RECIPE))
    texts = [one.text for one in overlay.plot.marks.names]
    assert texts == ["|F|", "along", "across", "model ± 0.94 N", "frozen 9"]
    assert len(overlay._behind["frozen"]["force"].x) > 100
    overlay.show_news(News(data=LiveData()))
    assert not overlay.freeze.isChecked()
    assert overlay.plot.marks.names == ()
