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
from rigapp.gui.data.connection import EngineConnection
from rigapp.gui.data.pyramid import Pyramid
from rigapp.gui.data.recording import load_history
from rigapp.gui.data.showntest import ShownTest
from rigapp.gui.look.tokens import LIGHT
from rigapp.gui.widgets.guarded import GuardedButton
from rigapp.gui.window.places import RailPlace
from rigapp.gui.window.window import MainWindow
from rigapp.replay.alarms import RecordedAlarms
from rigapp.replay.client import ReplayClient
from rigapp.schema.alarms import because, exceeded
from rigapp.schema.loglines import AlarmChange, alarm_line
from rigapp.schema.messages import Alarm, Event, Flag, RunState, Severity
from rigapp.storage.reading.oldlog import translated

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
            ours = data.rows.series(name)
            np.testing.assert_array_equal(ours.values, known.values[:place])
            if place:
                low = ours.envelope(0, place, 8).low
                assert np.nanmin(low) == np.nanmin(known.values[:place])
        if place >= 10:
            assert data.cycle is not None
            assert data.cycle.revolution == place // 10 * 10
        window.draw_now()


def test_the_bar_follows_and_leads_the_replay(
    player: tuple[MainWindow, ReplayClient], qtbot: Any
) -> None:
    window, _ = player
    bar = window.replay_bar
    assert bar.isVisible()
    assert not window.controls.isVisible()
    assert window.tabs.places() == {RailPlace.WATCH, RailPlace.RESULTS}
    assert not window.rail.buttons[RailPlace.RIG].isVisible()
    assert window.body.colour == LIGHT.highlight
    assert all(not one.isEnabled() for one in window.findChildren(GuardedButton))
    assert (bar.place.value(), bar.revolution.value()) == (1000, 300)
    bar.place.setFocus()
    qtbot.keyClick(bar.place, Qt.Key.Key_PageDown)
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


def test_a_long_leap_comes_in_steps(
    recorded: Path, monkeypatch: pytest.MonkeyPatch, qtbot: Any
) -> None:
    monkeypatch.setattr("rigapp.replay.client.MOST_ROWS", 100)
    client = ReplayClient(recorded, speed=0.0)
    try:
        client.request("seek", {"revolution": 300})
        sizes: list[int] = []

        def all_here() -> bool:
            snapshot = client.poll()
            if snapshot is not None and snapshot.rows:
                sizes.append(snapshot.status.committed)
            return bool(sizes) and sizes[-1] == 300

        qtbot.waitUntil(all_here, timeout=PATIENCE_MS)
        assert all(size % 100 == 0 for size in sizes)
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
        trip = because("overload", force_N=400.0, limit_N=380.0)
        steps: list[Callable[[], object]] = [
            lambda: book.raise_alarm(rule, now[0]),
            lambda: book.acknowledge(rule.key, "Ann"),
            lambda: book.clear(rule.key),
            lambda: book.raise_alarm(
                because("lost_samples", sentence="3 samples of daq were lost in all."), now[0]
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
    player: tuple[MainWindow, ReplayClient],
) -> None:
    window, _ = player
    assert window.header.tiles["force"].detail.whole == "drive off above 380 N, 75 % left"
    assert window._connection.status is not None
    assert window._connection.status.state is RunState.STOPPED


@pytest.mark.parametrize("kept", [0, 1, 15, 16, 17, 255, 256, 257, 4095, 4097, 9999])
def test_a_truncated_pyramid_is_like_a_fresh_one(kept: int) -> None:
    random = np.random.default_rng(kept)
    values = random.normal(size=10_000).astype(np.float32)
    pyramid, fresh = Pyramid(64), Pyramid(64)
    pyramid.extend(values)
    pyramid.settle()
    pyramid.truncate(kept)
    more = random.normal(size=777).astype(np.float32) * 3.0
    for whole in (np.empty(0, np.float32), more):
        pyramid.extend(whole)
        fresh = Pyramid(64)
        fresh.extend(np.concatenate([values[:kept], whole]))
        for buckets in (7, 100, 5000):
            ours = pyramid.envelope(0, len(pyramid), buckets)
            theirs = fresh.envelope(0, len(fresh), buckets)
            np.testing.assert_array_equal(ours.low, theirs.low)
            np.testing.assert_array_equal(ours.high, theirs.high)
