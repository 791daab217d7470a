"""A replay goes to any revolution, forwards and back, and shows alarms and margins as they were."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import Qt

from rigapp.config.loading import parse_test
from rigapp.engine.judging.alarms import AlarmBook
from rigapp.gui.widgets.build import GuardedButton
from rigapp.gui.window.places import RailPlace
from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import LIGHT
from rigapp.replay.client import RecordedAlarms, ReplayClient
from rigapp.schema.alarms import exceeded, make_alarm
from rigapp.schema.loglines import AlarmChange, alarm_line
from rigapp.schema.messages import Alarm, Event, Flag, RunState, Severity
from rigapp.schema.rownumbers import RowNumbers
from rigapp.storage.structure.events import translated
from rigapp.viewer.connection import EngineConnection
from rigapp.viewer.pyramid import Pyramid
from rigapp.viewer.recording import load_history
from rigapp.viewer.showntest import ShownTest

EXAMPLES = Path(__file__).parents[2] / "examples"
RULE = '\n[[limits.rule]]\nquantity = "force_max"\nwarning_above = 150.0\ncritical_above = 200.0\n'


@pytest.fixture
def player(recorded: Path, qtbot: Any, qapp: Any) -> Iterator[tuple[MainWindow, ReplayClient]]:
    """Return a window that shows the end of a replay."""
    client = ReplayClient(recorded, at_end=True)
    window = MainWindow(EngineConnection(lambda: client), ShownTest(), LIGHT)
    qtbot.addWidget(window)
    window.resize(1300, 850)
    window.show()
    reach(window, qtbot, 300)
    yield window, client
    window.close()


def reach(window: MainWindow, qtbot: Any, rows: int) -> None:
    """Tick until exactly so many rows are shown."""

    def there() -> bool:
        window.tick()
        return len(window._test.data.rows) == rows and window.settled

    qtbot.waitUntil(there, timeout=PATIENCE_MS)


@pytest.mark.long
def test_a_leap_back_shows_what_was_there_and_a_leap_forward_all_between(
    player: tuple[MainWindow, ReplayClient], recorded: Path, qtbot: Any
) -> None:
    window, client = player
    whole = load_history(recorded).data
    for place in (120, 37, 250, 1, 300, 0, 299):
        assert client.request("seek", {"revolution": place}).ok
        reach(window, qtbot, place)
        data = window._test.data
        assert client.request("status").result["revolution"] == place
        np.testing.assert_array_equal(data.rows.revolutions, np.arange(1.0, place + 1.0))
        assert len(data.predictions) == place
        for name in ("force_max", "probe_1_mean"):
            known = whole.rows.series(name)
            data.rows.series(name)
            reach(window, qtbot, place)  # what is looked at for the first time is read then
            ours = data.rows.series(name)
            np.testing.assert_array_equal(ours.values, known.values[:place])
            if place:
                low = ours.envelope(0, place, 8).low
                assert np.nanmin(low) == np.nanmin(known.values[:place])
        if place >= 10:
            assert data.cycle is not None
            assert data.cycle.revolution == place // 10 * 10
        window.draw_now()


@pytest.mark.long
def test_the_bar_follows_and_leads_the_replay(
    player: tuple[MainWindow, ReplayClient], qtbot: Any
) -> None:
    window, _ = player
    bar = window.replay_bar
    assert bar.isVisible()
    assert not window.controls.isVisible()
    assert window.tabs.places() == {RailPlace.WATCH, RailPlace.RESULTS, RailPlace.SETTINGS}
    assert not window.rail.buttons[RailPlace.RIG].isVisible()
    assert window.body.colour == LIGHT.highlight
    assert all(not one.isEnabled() for one in window.findChildren(GuardedButton))
    assert (bar.slider.value(), bar.revolution.value()) == (1000, 300)
    bar.slider.setFocus()
    qtbot.keyClick(bar.slider, Qt.Key.Key_PageDown)
    reach(window, qtbot, 270)
    assert bar.revolution.value() == 270
    assert window.header.state.value.whole == "REPLAY"
    assert window.header.state.detail.whole.startswith("Paused")
    bar.revolution.setFocus()
    bar.revolution.selectAll()
    qtbot.keyClicks(bar.revolution, "42")
    qtbot.keyClick(bar.revolution, Qt.Key.Key_Return)
    reach(window, qtbot, 42)
    bar.play.click()
    bar.speed.setCurrentIndex(bar.speed.count() - 1)
    reach(window, qtbot, 300)


def test_a_leap_sends_no_rows_and_says_how_many_there_are(recorded: Path, qtbot: Any) -> None:
    client = ReplayClient(recorded, speed=0.0)
    try:
        client.request("seek", {"revolution": 300})
        seen: list[int | None] = []

        def all_here() -> bool:
            snapshot = client.poll()
            if snapshot is not None:
                assert not snapshot.rows
                seen.append(snapshot.recorded)
            return bool(seen) and seen[-1] == 300

        qtbot.waitUntil(all_here, timeout=PATIENCE_MS)
        assert set(seen) <= {0, 300}, "no step between"
    finally:
        client.close()


def logged(story: Callable[[AlarmBook, list[int]], None]) -> list[Event]:
    """Return the log of what happens to an alarm book, as the engine writes it."""
    events: list[Event] = []
    now = [0]

    def changed(alarm: Alarm, change: AlarmChange, who: str) -> None:
        events.append(alarm_line(float(now[0]), now[0], who, alarm, change))

    story(AlarmBook(lambda: float(now[0]), changed), now)
    return events


def as_older_files_have_them(events: list[Event]) -> list[Event]:
    """Return what the reader makes of the same log without key, level and data."""
    plain = [msgspec.structs.replace(one, key="", level="information", data={}) for one in events]
    return translated(plain)


@pytest.mark.parametrize("form", [list, as_older_files_have_them])
def test_alarms_are_as_the_engine_listed_them(
    form: Callable[[list[Event]], list[Event]],
) -> None:
    snapshots: dict[int, tuple[Alarm, ...]] = {}

    def story(book: AlarmBook, now: list[int]) -> None:
        rule = exceeded("force_max", Severity.WARNING, 160.0, 150.0, True, "warn")
        trip = make_alarm("overload", force_N=400.0, limit_N=380.0)
        steps: list[Callable[[], object]] = [
            lambda: book.raise_alarm(rule, now[0]),
            lambda: book.acknowledge(rule.key, "Ann"),
            lambda: book.clear(rule.key),
            lambda: book.raise_alarm(
                make_alarm("lost_samples", sentence="3 samples of daq were lost in all."), now[0]
            ),
            lambda: book.shelve("lost_samples", "known", 3600.0, "Ann"),
            lambda: book.raise_alarm(trip, now[0]),
            lambda: book.clear(trip.key),
            lambda: book.acknowledge(trip.key, "Ann"),
            lambda: book.reset("Ann"),
        ]
        for number, step in enumerate(steps, 1):
            now[0] = 10 * number
            step()
            snapshots[now[0]] = book.alarms()

    recorded = RecordedAlarms(form(logged(story)), None)
    for revolution in (*sorted(snapshots), *sorted(snapshots, reverse=True)):
        found = {alarm.key: alarm for alarm in recorded.alarms(revolution + 5)}
        expected = {alarm.key: alarm for alarm in snapshots[revolution]}
        assert set(found) == set(expected), revolution
        for key, alarm in expected.items():
            if form is not list and key.startswith("rule:"):
                words = {one: getattr(found[key], one) for one in ("consequence", "action")}
                alarm = msgspec.structs.replace(alarm, **words)
            if form is not list:  # their words alone have the value
                alarm = msgspec.structs.replace(alarm, value=None)
            assert found[key] == alarm, (revolution, key)
    assert recorded.alarms(3) == ()


def test_margins_follow_the_limits_in_force() -> None:
    text = (EXAMPLES / "quick.toml").read_text(encoding="utf-8")
    limits = parse_test(text + RULE, "x").limits
    text = "limit force_max.warning_above changed"
    (changed,) = translated([Event(1.0, 50, "limit_changed", "Ann", text, "150", "100")])
    recorded = RecordedAlarms([changed], limits)
    values = {"force_max": 120.0, "speed_max": 60.0}
    margin, name = recorded.margin(49, values)
    assert margin == pytest.approx(20.0)
    assert name == "force_max warning above"
    margin, name = recorded.margin(50, values)
    assert margin == pytest.approx(-20.0)
    assert name == "force_max warning above"
    margin, name = recorded.margin(0, {"force_max": 1.0, "speed_max": 88.0})
    assert (round(margin, 3), name) == (round(100.0 * 2.0 / 90.0, 3), "overspeed")
    assert np.isnan(RecordedAlarms([], None).margin(1, values)[0])
    in_a_ramp = {**values, "quality": float(Flag.RAMP)}
    assert np.isnan(recorded.margin(50, in_a_ramp)[0])


def test_the_window_shows_margin_of_a_recorded_test(
    player: tuple[MainWindow, ReplayClient], qtbot: Any
) -> None:
    window, _ = player
    detail = window.header.tiles["force"].detail

    def told() -> bool:  # the status of the replay may come a tick after its rows
        window.tick()
        return detail.whole == "drive off above 380 N, 75 % left"

    qtbot.waitUntil(told, timeout=PATIENCE_MS)
    assert window._connection.status is not None
    assert window._connection.status.engine.state is RunState.STOPPED


@pytest.mark.parametrize("shown", [0, 1, 15, 16, 17, 255, 256, 257, 4095, 4097, 9999])
def test_a_series_that_is_shown_in_part_is_like_a_shorter_one(shown: int) -> None:
    values = np.random.default_rng(shown).normal(size=10_000).astype(np.float32)
    ours, theirs = Pyramid(64, kept=64), Pyramid(64)
    ours.extend(values)
    ours.fetch = lambda start, stop: values[start:stop]
    theirs.extend(values[:shown])
    ours.limit = shown
    np.testing.assert_array_equal(ours.values, theirs.values)
    for start, stop in ((0, shown), (shown // 3, shown), (shown // 3, shown // 2), (0, 10_000)):
        for buckets in (7, 100, 5000):
            mine, wanted = (one.envelope(start, stop, buckets) for one in (ours, theirs))
            np.testing.assert_array_equal(mine.first, wanted.first)
            np.testing.assert_array_equal(mine.low, wanted.low)
            np.testing.assert_array_equal(mine.high, wanted.high)


def test_a_series_without_its_file_stays_small_and_keeps_every_extreme() -> None:
    values = np.random.default_rng(3).normal(size=400_000).astype(np.float32)
    series, whole = Pyramid(16, kept=1024), Pyramid()
    for first in range(0, len(values), 777):
        series.extend(values[first : first + 777])
    whole.extend(values)
    held = sum(one._data.nbytes for one in (series._base, *series._low, *series._high))
    assert held < 0.1 * values.nbytes
    for buckets in (5, 60, 300):
        ours, theirs = (one.envelope(0, len(values), buckets) for one in (series, whole))
        np.testing.assert_array_equal(ours.low, theirs.low)
        np.testing.assert_array_equal(ours.high, theirs.high)
    newest = slice(len(values) - 1000, len(values))
    np.testing.assert_array_equal(series.rows(newest.start, newest.stop), values[newest])
    old = series.envelope(1000, 3000, 500)
    for first, low, high in zip(old.first, old.low, old.high, strict=True):
        rows = values[first : first + 256]
        assert (low, high) == (rows.min(), rows.max())


@pytest.mark.parametrize("gaps", [(), (5,), (1, 2, 3, 700)])
def test_row_numbers_read_as_the_array_that_they_stand_for(gaps: tuple[int, ...]) -> None:
    steps = np.ones(1000)
    steps[list(gaps)] = 7.0
    array = 3.0 + np.cumsum(steps)
    numbers = RowNumbers()
    for first in range(0, 1000, 130):
        numbers.extend(array[first : first + 130])
    np.testing.assert_array_equal(numbers, array)
    np.testing.assert_array_equal(numbers[[0, -1, 400]], array[[0, -1, 400]])
    np.testing.assert_array_equal(numbers[3:990:7], array[3:990:7])
    assert (numbers[-1], len(numbers)) == (array[-1], 1000)
    for limit in (1000, 701, 4, 0):
        numbers.limit = limit
        for value in (-np.inf, 0.0, 4.0, 4.5, 9.0, 10.0, 11.0, 500.0, 710.5, 1e9, np.inf):
            for side in ("left", "right"):
                found = np.searchsorted(array[:limit], value, side)  # type: ignore[call-overload]
                assert numbers.searchsorted(value, side) == found
    with pytest.raises(IndexError):
        numbers[0]
