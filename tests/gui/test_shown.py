"""How values are shown: colour by the alarms about them alone, grey with their age when old."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import msgspec
import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import Qt
from snapshots import ALARM, make_snapshot, make_status

from rigapp.config.loading import parse_test
from rigapp.gui.plots.trend import TrendPanel
from rigapp.gui.window.headline import headline, measured
from rigapp.gui.window.window import MainWindow
from rigapp.page.view import _tiles as page_tiles
from rigapp.presentation.tokens import LIGHT
from rigapp.schema.alarms import KINDS, make_alarm, rule_key
from rigapp.schema.messages import Alarm, Recovery, Remedy, RunState, Severity
from rigapp.storage.reading.trip import LargestForce
from rigapp.viewer.connection import LOST_AFTER_S, SILENT_AFTER_S, ConnectionState
from rigapp.viewer.margins import margins, nearest_margin
from rigapp.viewer.news import News
from rigapp.viewer.recording import TripCycles
from rigapp.viewer.series import LiveData
from rigapp.viewer.shown import Level, Renewed, age_of, level_of, quantity_level

Attach = Callable[[], None]
QUICK = (Path(__file__).parents[2] / "examples" / "quick.toml").read_text(encoding="utf-8")
RULES = (
    '\n[[limits.rule]]\nquantity = "force_max"\nwarning_above = 98.0\n'
    '\n[[limits.rule]]\nquantity = "force_rms"\nwarning_above = 10.0\n'
)
RECIPE = parse_test(QUICK + RULES, "x")


def alarm(key: str, severity: Severity = Severity.WARNING, state: str = "acknowledged") -> Alarm:
    active = state in ("acknowledged", "unacknowledged")
    return msgspec.structs.replace(ALARM, key=key, severity=severity, state=state, active=active)


@pytest.mark.parametrize("state", list(RunState))
def test_a_value_is_old_after_two_seconds_in_every_state(state: RunState) -> None:
    # Of a revolution, 2 s after the next one was due: at 30 rpm and x20 after 0.1 s.
    under_way = state in (
        RunState.STARTING,
        RunState.RUNNING,
        RunState.PAUSING,
        RunState.PAUSED,
        RunState.STOPPING,
    )
    due_s = 0.1 if under_way else 0.0
    for age_s in (0.0, 1.9, 2.3, 9.2, 400.0):
        status = make_status(
            state=state, data_age_s=age_s, revolution_age_s=age_s, twin_age_s=age_s
        )
        for renewed in (Renewed.SAMPLE, Renewed.REVOLUTION, Renewed.PREDICTION):
            for silence_s in (0.0, 1.0):
                news = News(status, silence_s=silence_s, data_age_s=age_s + silence_s)
                age = age_of(news, renewed)
                least = 2.0 + (0.0 if renewed is Renewed.SAMPLE else due_s)
                assert age.old is (age_s + silence_s > least), (renewed, age_s, silence_s)
        assert not age_of(News(status, is_replay=True, data_age_s=age_s), Renewed.SAMPLE).old
    assert age_of(News(make_status(), silence_s=9.0), Renewed.STATUS).text == "9 s old"


def test_an_alarm_colours_what_it_is_about_and_nothing_else() -> None:
    hot = alarm("rule:bushing_temperature_max:critical:above", Severity.CRITICAL)
    assert quantity_level([hot], "bushing_temperature") is Level.CRITICAL
    assert level_of([hot], "force_max") is Level.NORMAL
    broken = alarm("saturated:force_1", Severity.CRITICAL, state="latched")
    assert level_of([broken], "force_max") is Level.CRITICAL, "a lost bridge is about every force"
    assert quantity_level([alarm("overspeed")], "speed") is Level.WARNING
    assert level_of([alarm("input_saturated:oil_level")], "oil_level_mean") is Level.WARNING
    for state in ("shelved", "returned"):
        assert level_of([alarm("overload", state=state)], "force_max") is Level.NORMAL
    assert KINDS["cut_off"].quantity == ""


def test_a_sensible_limit_leaves_the_tile_plain_and_one_passed_marks_it_everywhere() -> None:
    data = LiveData()
    data.take(make_snapshot(1, 9))

    def shown(*alarms: Alarm) -> tuple[int, list[int]]:
        news = News(make_status(alarms=alarms), data, RECIPE)
        head = headline(news.status, ConnectionState.ATTACHED, "", measured(news))
        assert head.force.detail.startswith("warn above 98 N, "), "of its own limits, by name"
        assert head.used == pytest.approx(data.rows.last("force_max") / 380.0)
        return head.force.level, [
            one.level for one in margins(news) if "force_max" in one.limit.column
        ]

    # Close to its limit, or another quantity beyond its own: no colour.
    assert shown() == (Level.NORMAL, [Level.NORMAL, Level.NORMAL])
    other = alarm(rule_key("force_rms", "warning", "above"))
    assert shown(other) == (Level.NORMAL, [Level.NORMAL, Level.NORMAL])
    own = alarm(rule_key("force_max", "warning", "above"))
    assert shown(own) == (Level.WARNING, [Level.WARNING, Level.WARNING])
    nearest = nearest_margin(News(make_status(), data, RECIPE), "force_max")
    assert nearest is not None
    assert nearest.limit.limit == 98.0


@pytest.mark.parametrize("by", ["alarm", "file"])
def test_after_an_overload_tile_and_margin_show_the_peak_of_the_unfinished_revolution(
    by: str,
) -> None:
    data = LiveData()
    data.take(make_snapshot(1, 9))
    overload = make_alarm("overload:beyond_range", force_N=391.04, limit_N=380.0)
    raised = msgspec.structs.replace(
        alarm("overload:beyond_range", Severity.CRITICAL, "latched"), value=overload.value
    )
    status = make_status(state=RunState.STOPPED, alarms=(raised,) if by == "alarm" else ())
    peak = LargestForce(391.04, 10, lower_bound=True, complete=False)
    trip = TripCycles(10, None, None, peak) if by == "file" else None
    news = News(status, data, RECIPE, trip=trip)
    head = headline(news.status, ConnectionState.ATTACHED, "", measured(news))
    assert head.force.value == "≥ 391.0 N of 380 N"
    row, _ = (one for one in margins(news) if one.limit.column == "force_max")
    assert (row.passed, row.used, row.text) == (True, 1.0, "≥ 391 of 380 N, drive off")
    tiles = {one.title: one.value for one in page_tiles(news)}
    assert tiles["|F| maximum"] == "≥ 391.04 N"


def test_a_dead_engine_is_said_everywhere_and_a_restart_until_a_test_runs(
    window: MainWindow, engine: Any, attach: Attach, monkeypatch: pytest.MonkeyPatch
) -> None:
    engine.say(count=9)
    attach()
    passed_s = [0.0]
    monkeypatch.setattr(window._connection, "_clock", lambda: time.monotonic() + passed_s[0])
    head, live, notice = window.header, window.side.live, window.notice
    assert notice.text.text() == "Running as planned."
    assert "ends" in head.tiles["cycle"].detail.whole
    for silence_s in (SILENT_AFTER_S + 0.1, LOST_AFTER_S + 4.0):
        engine.refuses_clients = True
        passed_s[0] += silence_s
        window.tick()
        window._show_state()
        assert "has not answered" in notice.text.text()
        assert "emergency stop" in notice.text.text()
        assert "ends" not in head.tiles["cycle"].detail.whole
        for tile in ("cycle", "force", "wear", "agreement", "alarms"):
            assert " s old" in head.tiles[tile].detail.whole or head.tiles[tile].value.whole == "–"
        for name in ("force", "rms", "speed"):
            assert live.values[name].caption.whole.endswith(" s old")
            assert LIGHT.muted in live.values[name].value.styleSheet()
    engine.refuses_clients = False
    passed_s[0] += 10.0
    engine.say(count=0, curves=False, state=RunState.READY, planned=0, file="", engine_pid=4712)
    attach()
    assert "a new one was started" in notice.text.text()
    assert notice.away.isVisible()
    engine.say(count=3, engine_pid=4712, file="paper-20270102.h5")
    attach()
    assert notice.text.text() == "Running as planned."
    assert not notice.away.isVisible()


def test_the_key_of_the_message_line_does_what_it_says(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any
) -> None:
    step = Recovery(Remedy.RESUME, "start", "Start a test.", (Remedy.RESUME,))
    engine.say(count=0, curves=False, state=RunState.READY, planned=0, file="", recovery=step)
    attach()
    with qtbot.waitActive(window, timeout=PATIENCE_MS):
        window.activateWindow()
    assert window.notice.text.text() == "Start a test. (F10)"
    assert window.recover.isHidden()
    window.controls.text.setFocus()
    qtbot.keyClick(window.controls.text, Qt.Key.Key_F10)
    assert window.start_bar.isVisible()


def test_a_trend_that_is_seen_again_shows_nothing_of_a_test_that_is_over(qtbot: Any) -> None:
    panel = TrendPanel("x", LIGHT, leads=False)
    qtbot.addWidget(panel)
    panel.resize(600, 400)
    panel.show()
    over = LiveData()
    over.take(make_snapshot(1, 480))
    panel.show_news(News(data=over))
    assert panel.plot.viewRange()[0][1] >= 480.0
    assert panel.plot.instead == ""
    panel.hide()
    del over
    panel.show()
    assert panel.plot.instead, "before it is drawn in its turn"
    present = LiveData()
    present.take(make_snapshot(1, 164))
    panel.show_news(News(data=present))
    assert panel.plot.instead == ""
    assert panel.plot.viewRange()[0][1] < 200.0
