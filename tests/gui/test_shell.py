"""The shell of the window: places, what never moves, and what it says in words."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from pathlib import Path
from typing import Any

import msgspec
import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import QRect, Qt
from PySide6.QtWidgets import QAbstractButton, QDialog, QWidget

from rigapp.config.loading import read_test
from rigapp.config.recipe import LimitRule
from rigapp.gui.look.dress import style_sheet
from rigapp.gui.window.headline import headline, measured
from rigapp.gui.window.places import RailPlace
from rigapp.gui.window.tabs import TABS
from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import DARK, LIGHT, THEMES, Theme
from rigapp.schema.loglines import LIMIT_CHANGED, LimitChange
from rigapp.schema.messages import (
    Alarm,
    Event,
    Recovery,
    Remedy,
    Reply,
    RunState,
    Severity,
    Status,
)
from rigapp.viewer.connection import ConnectionState
from rigapp.viewer.margins import Margin, WatchedLimit, margins
from rigapp.viewer.news import News

Attach = Callable[[], None]
EXAMPLES = Path(__file__).parents[2] / "examples"


def test_each_place_is_reached_by_its_key_and_shows_the_page_seen_last(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any
) -> None:
    engine.say(count=3)
    attach()
    with qtbot.waitActive(window, timeout=PATIENCE_MS):
        window.activateWindow()
    window.tabs.setCurrentIndex(2)
    for key, place in zip(
        (Qt.Key.Key_2, Qt.Key.Key_3, Qt.Key.Key_4, Qt.Key.Key_5, Qt.Key.Key_1),
        (*RailPlace, *RailPlace)[1:6],
        strict=True,
    ):
        qtbot.keyClick(window, key, Qt.KeyboardModifier.AltModifier)
        assert window.tabs.place is place
        assert window.rail.buttons[place].isChecked()
        shown = {page.title for page in window.tabs.pages()}
        assert {one.text() for one in window.page_bar.buttons.values()} == shown
    assert window.tabs.currentIndex() == 2
    assert window.page_bar.buttons[2].isChecked()
    window.page_bar.buttons[0].click()
    assert window.tabs.currentIndex() == 0


def test_the_focus_of_the_rail_goes_to_the_place_that_is_shown(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any
) -> None:
    engine.say(count=3)
    attach()
    with qtbot.waitActive(window, timeout=PATIENCE_MS):
        window.activateWindow()
    window.rail.buttons[RailPlace.WATCH].setFocus()
    qtbot.keyClick(window, Qt.Key.Key_4, Qt.KeyboardModifier.AltModifier)
    assert window.focusWidget() is window.rail.buttons[RailPlace.RESULTS]
    window.controls.text.setFocus()
    qtbot.keyClick(window, Qt.Key.Key_1, Qt.KeyboardModifier.AltModifier)
    assert window.focusWidget() is window.controls.text


def test_every_tab_stands_in_a_place_and_calibration_under_rig(
    window: MainWindow, engine: Any, attach: Attach
) -> None:
    engine.say(count=3)
    attach()
    assert {tab.place for tab in TABS} == set(RailPlace)
    assert not window.calibrate_button.isVisible()
    window.rail.buttons[RailPlace.RIG].click()
    assert window.calibrate_button.isVisible()


def test_a_calibration_stands_in_the_window_and_is_left_and_come_back_to(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any
) -> None:
    engine.reply = Reply(ok=True, result={"key": "of this session", "since": 1.0})
    engine.say(count=0, curves=False, state=RunState.READY, file="")
    attach()
    with qtbot.waitActive(window, timeout=PATIENCE_MS):
        window.activateWindow()
    qtbot.keyClick(window, Qt.Key.Key_F3)
    assert window.stage.guiding
    assert window.tabs.place is RailPlace.RIG
    qtbot.keyClick(window.focusWidget(), Qt.Key.Key_Space)

    def opened() -> bool:
        window.tick()
        return window.guide.wizard is not None

    qtbot.waitUntil(opened, timeout=PATIENCE_MS)
    engine.reply = Reply(ok=False, sentence="There are no signals.")
    wizard = window.guide.wizard
    assert wizard is not None
    qtbot.waitUntil(wizard.isVisible, timeout=PATIENCE_MS)
    stop = window.controls.buttons["stop"]
    assert stop.isVisible()
    assert "&" not in stop.text(), "the letters are the wizard's"
    assert not any(one.isWindow() for one in window.findChildren(QDialog) if one.isVisible())
    qtbot.keyClick(window, Qt.Key.Key_3, Qt.KeyboardModifier.AltModifier)
    assert not window.stage.guiding
    assert "&" in stop.text()
    window.dress(DARK)
    qtbot.keyClick(window, Qt.Key.Key_F3)
    assert window.stage.guiding
    assert wizard.isVisible()
    qtbot.keyClick(window, Qt.Key.Key_2, Qt.KeyboardModifier.ControlModifier)
    assert not window.stage.guiding, "the keys of pages work behind a guide, too"
    assert window.tabs.place is RailPlace.WATCH
    qtbot.keyClick(window, Qt.Key.Key_F3)
    window.rail.buttons[RailPlace.WATCH].click()
    assert not wizard.isVisible()
    qtbot.keyClick(window, Qt.Key.Key_F3)
    qtbot.keyClick(wizard, Qt.Key.Key_Escape)
    assert not window.stage.guiding
    assert window.guide.wizard is None
    window.dress(LIGHT)


SITUATIONS = (
    (RunState.RUNNING, "", Recovery()),
    (RunState.PAUSED, "asked by the operator", Recovery()),
    (
        RunState.FAULT,
        "Overload: 391 N at 223 deg, the limit is 380 N; the drive is off, the spindle stands.",
        Recovery(
            Remedy.ACKNOWLEDGE,
            "acknowledge",
            "Acknowledge the alarms.",
            (Remedy.ACKNOWLEDGE, Remedy.RESET, Remedy.RESUME),
        ),
    ),
    (RunState.STOPPED, "All revolutions are done.", Recovery()),
)


@pytest.mark.long
@pytest.mark.parametrize("size", [(1366, 768), (1440, 900)])
def test_nothing_moves_because_of_a_state(
    window: MainWindow, engine: Any, attach: Attach, alarm: Alarm, qapp: Any, size: tuple[int, int]
) -> None:
    window.resize(*size)
    critical = msgspec.structs.replace(alarm, key="overload", severity=Severity.CRITICAL)
    places: list[dict[str, QRect]] = []
    for number, (state, reason, recovery) in enumerate(SITUATIONS, 1):
        alarms = (critical, alarm) if state is RunState.FAULT else ()
        engine.say(
            first=number, count=1, state=state, reason=reason, recovery=recovery, alarms=alarms
        )
        attach()
        qapp.processEvents()
        fixed = {
            "header": window.header,
            "messages": window.messages,
            "pages": window.tabs,
            "side": window.side,
            "bar": window.controls,
            **window.header.tiles,
            **{place.value: one for place, one in window.rail.buttons.items()},
            **{verb: window.controls.buttons[verb] for verb in ("connect", "pause", "stop")},
            "note": window.controls.note,
        }
        places.append({name: _place(one, window) for name, one in fixed.items()})
    assert all(one == places[0] for one in places)
    assert not any(rect.right() > size[0] for rect in places[0].values())


def _place(widget: QWidget, window: MainWindow) -> QRect:
    return QRect(widget.mapTo(window, widget.rect().topLeft()), widget.size())


REFUSAL = (
    "/srv/laboratory/results/ptfe-bushing-20261124-193535.h5: the file needs 84 MB and 0 MB are"
    " free; free some, or write to another folder."
)


def test_the_reason_of_a_refusal_is_read_whole_and_moves_nothing(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any
) -> None:
    window.resize(1366, 728)
    engine.say(state=RunState.READY)
    attach()
    line, answer = window.messages, window.controls.answer
    height = line.height()
    window.controls.show_answer(f"19:37:22  start refused: {REFUSAL}", good=False)
    qtbot.waitUntil(lambda: REFUSAL in answer.text(), timeout=PATIENCE_MS)
    assert line.height() == height
    assert answer.height() >= answer.heightForWidth(answer.width())
    window.controls.show_answer(f"{REFUSAL} " * 9, good=False)
    assert answer.text().endswith("…")
    assert answer.toolTip().count(REFUSAL) == 9


def test_the_way_out_takes_the_place_of_the_limits_and_gives_it_back(
    window: MainWindow, engine: Any, attach: Attach
) -> None:
    engine.say(count=3)
    attach()
    assert window.side.limits.isVisible()
    state, reason, recovery = SITUATIONS[2]
    engine.say(first=4, count=1, state=state, reason=reason, recovery=recovery)
    attach()
    assert window.recover.isVisible()
    assert not window.side.limits.isVisible()
    assert reason in window.notice.text.text()
    assert recovery.sentence in window.notice.text.text()
    engine.say(first=5, count=1)
    attach()
    assert window.side.limits.isVisible()
    assert window.notice.text.text() == "Running as planned."


def test_start_and_resume_share_a_place_and_stop_is_apart_and_always_there(
    window: MainWindow, engine: Any, attach: Attach
) -> None:
    for number, state in enumerate((RunState.READY, RunState.PAUSED), 1):
        engine.say(first=number, count=1, state=state)
        attach()
        shown = {v for v in ("start", "resume") if window.controls.buttons[v].isVisible()}
        assert shown == {"resume" if state is RunState.PAUSED else "start"}
    stop, others = window.controls.buttons["stop"], window.controls.findChildren(QAbstractButton)
    assert stop.property("rank") == "dangerous"
    assert all(stop.height() > one.height() for one in others if one is not stop)
    window.start_bar.open()
    assert not window.start_bar.geometry().intersects(
        QRect(stop.mapTo(window, stop.rect().topLeft()), stop.size())
    )


def test_a_paused_test_has_no_end_time(window: MainWindow, engine: Any, attach: Attach) -> None:
    engine.say(count=3, state=RunState.PAUSED)
    attach()
    assert window.header.tiles["cycle"].detail.whole.endswith("the end waits")


def test_margins_tell_value_limit_and_what_happens(
    window: MainWindow, engine: Any, attach: Attach, make_status: Callable[..., Status]
) -> None:
    engine.say(count=3)
    attach()
    test = read_test(EXAMPLES / "quick.toml").record
    rules = (
        LimitRule("force_max", warning_above=90.0, critical_above=120.0),
        LimitRule("force_min", warning_below=20.0),
        LimitRule("nothing_of_this_test", warning_above=1.0),
    )
    test = msgspec.structs.replace(
        test, limits=msgspec.structs.replace(test.limits, overload_N=190.0, rule=rules)
    )
    data = window.news.data
    found = {one.limit.title: one for one in margins(News(data=data, recipe=test))}
    assert set(found) >= {"|F|, any sample", "Speed", "Maximum |F|", "Minimum |F|"}
    assert found["|F|, any sample"].used == pytest.approx(data.rows.last("force_max") / 190.0)
    # Beyond the warning, the level that comes next is the one to watch.
    assert found["Maximum |F|"].limit.limit == 120.0
    assert found["Maximum |F|"].text.endswith(" of 120 N, stop")
    low = found["Minimum |F|"]
    assert low.limit.below
    assert low.used == pytest.approx(20.0 / data.rows.last("force_min"))
    change = msgspec.to_builtins(LimitChange(190.0, 300.0))
    line = Event(1.0, 3, LIMIT_CHANGED, "Ann", "", key="overload_N", data=change)
    shown = {one.limit.title: one for one in margins(News(data=data, recipe=test, events=[line]))}
    assert shown["|F|, any sample"].limit.limit == 300.0
    now = measured(News(data=data, recipe=test, events=[line]))
    # The nearest of its own limits, by its name.
    share = data.rows.last("force_max") / 120.0
    assert now.nearest is not None
    assert now.nearest.left == f"stop above 120 N, {100 * (1 - share):.0f} % left"
    assert now.overload_N == 300.0
    told = headline(make_status(), ConnectionState.ATTACHED, "", now)
    assert told.force.value.endswith(" N of 300 N")
    assert told.used == pytest.approx(data.rows.last("force_max") / 300.0)


def test_a_limit_that_is_passed_is_marked_in_words_and_full() -> None:
    above = WatchedLimit("x", "x_max", 4.0, "N", "warn")
    below = dataclasses.replace(above, below=True)
    for margin in (Margin(above, 5.0), Margin(below, 3.0)):
        assert margin.passed
        assert margin.used == 1.0
    assert Margin(above, 3.0).text == "3 of 4 N, warn"
    assert Margin(above, 3.0).left == "warn above 4 N, 25 % left"
    assert Margin(above, 5.0).left == "warn above 4 N, passed"
    assert Margin(below, 5.0).text == "5 at least 4 N, warn"


@pytest.mark.parametrize("theme", THEMES.values(), ids=list(THEMES))
def test_the_sheet_uses_the_tokens_of_its_theme_alone(theme: Theme) -> None:
    sheet = style_sheet(theme)
    other = DARK if theme is LIGHT else LIGHT
    assert theme.highlight in sheet
    assert "$" not in sheet
    assert other.highlight not in sheet
