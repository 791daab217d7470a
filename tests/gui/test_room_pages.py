"""Room for every word on every page: at each scale and size of the screen, in all languages."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import msgspec
import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import QCoreApplication
from PySide6.QtWidgets import QWidget
from snapshots import ALARM, make_status, write_recorded
from study.studies import finished

from rigapp.config.loading import parse_test
from rigapp.gui.language import speak_language
from rigapp.gui.look.dress import style_sheet
from rigapp.gui.testfile.sequence import STEPS
from rigapp.gui.window.help import HelpWindow
from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import DARK, LIGHT, THEMES
from rigapp.presentation.translation import ENGLISH
from rigapp.schema.alarms import make_alarm
from rigapp.schema.messages import (
    Alarm,
    ChannelView,
    DriveView,
    Recovery,
    Remedy,
    RunState,
    Severity,
)
from rigapp.schema.queue import ItemState, QueuedTest
from rigapp.viewer.connection import CommandHolder, EngineConnection
from rigapp.viewer.recording import StoredTest
from rigapp.viewer.series import LiveData
from rigapp.viewer.showntest import ShownTest
from tests.gui.roominess import LONGEST_FIRST, SCALES, SIZES, badly_placed, cut_texts

EXAMPLES = Path(__file__).parents[2] / "examples"
ROOMS = tuple(
    (f"{scale:g} {size[0]}", int(size[0] / scale), int(size[1] / scale))
    for scale, size in product(SCALES, SIZES)
)
"""A scale leaves so many fewer pixels to the window."""
RULES = """
[[limits.rule]]
quantity = "force_max"
warning_above = 95.0
critical_above = 110.0
action_critical = "stop"
delay_revolutions = 3
hysteresis = 2.0

[[limits.rule]]
quantity = "measured_wear_depth"
critical_above = 0.05
action_critical = "drive_off"
"""
"""Limits of a test, of which one knows all fields."""


@dataclass(frozen=True)
class Desk:
    """A furnished window, and what brings news to it."""

    window: MainWindow
    engine: Any
    attach: Callable[[], None]
    qtbot: Any
    folder: Path

    def tell(self, **changes: Any) -> None:
        """Let the engine tell of a new cycle and whatever else has changed."""
        first = self.window.news.status.test.revolution if self.window.news.status else 1
        count = 400 if first == 1 else 1
        self.engine.say(first=first, count=count, **changes)
        self.attach()

    def see(self, condition: Callable[[], object]) -> None:
        """Wait until something is seen."""

        def seen() -> bool:
            self.window.tick()
            return bool(condition())

        self.qtbot.waitUntil(seen, timeout=PATIENCE_MS)

    def panel(self, name: str) -> Any:
        """Return a panel."""
        return self.window.tabs.panels[name]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder of recorded tests and a study."""
    made = tmp_path_factory.mktemp("results")
    for name in ("quick-20270101-080000", "quick-20270102-080000"):
        write_recorded(made / f"{name}.h5")
    finished(made / "contact", problems={5: "the pin is too large"})
    text = (EXAMPLES / "steps.toml").read_text("utf-8") + RULES
    (made / "steps.toml").write_text(text, "utf-8")
    return made


@pytest.fixture(params=LONGEST_FIRST)
def desk(
    request: pytest.FixtureRequest,
    engine: Any,
    qtbot: Any,
    light_application: Any,
    folder: Path,
) -> Iterator[Desk]:
    """Return a window in a language, with a test that runs, has limits, and has run before."""
    speak_language(light_application, request.param)
    recipe = parse_test((folder / "steps.toml").read_text("utf-8"), folder / "steps.toml")
    window = MainWindow(
        EngineConnection(engine.client),
        ShownTest(lambda path, planned: StoredTest(LiveData(planned), recipe)),
        LIGHT,
        rig=EXAMPLES / "simulated.toml",
        tests=[folder / "steps.toml", EXAMPLES / "paper.toml"],
        results_folder=folder,
    )
    qtbot.addWidget(window)
    window.show()

    def attach() -> None:
        def taken() -> bool:
            window.tick()
            return engine.clients > 0 and not engine.snapshots

        qtbot.waitUntil(taken, timeout=PATIENCE_MS)
        window.draw_now()

    made = Desk(window, engine, attach, qtbot, folder)
    made.tell(file=str(folder / "quick-20270101-080000.h5"), **furnished())
    yield made
    window.close()
    speak_language(light_application, ENGLISH)


def furnished() -> dict[str, Any]:
    """Return a status with long words: many channels, devices with warnings, a queue."""
    status = make_status()
    daq, drive = status.rig.devices
    counters = {"bytes_received": 123_456_789, "crc_errors": 2, "retries": 0}
    advice = "The cell's cable is longer than the amplifier was adjusted for"
    error = "/dev/pts/3 does not answer within 0.5 s; check its cable and its power"
    return {
        "devices": (
            msgspec.structs.replace(daq, lost_samples=1200, advice=advice, counters=counters),
            msgspec.structs.replace(drive, connected=False, last_error=error),
        ),
        "channels": (
            *status.rig.channels,
            ChannelView("bushing_temperature", 0.41, "V", 41.0, "degC", "rig file", 0.5),
            ChannelView("motor_current", 1.4, "A", 1.4, "A", "rig file", None, 12.0),
        ),
        "drive": DriveView(
            30.02, 30.0, 1.4, 48.0, 31.5, True, False, (), ("Temperature warning, channel 1",)
        ),
        "queue": tuple(
            QueuedTest(
                number, f"/t/a-long-name-{number}.toml", "/r", state, f"/r/{number}.h5", said
            )
            for number, state, said in (
                (3, ItemState.DONE, "The planned 30 revolutions are made and recorded."),
                (4, ItemState.RUNNING, ""),
                (5, ItemState.WAITING, ""),
            )
        ),
        "queue_works": True,
    }


def alarms() -> tuple[Alarm, ...]:
    """Return a first-out trip, a warning, and one that was acknowledged."""
    cause = make_alarm("overload", force_N=391.04, limit_N=380.0)
    trip = Alarm(
        cause.key,
        Severity.CRITICAL,
        cause.title,
        cause.sentence,
        cause.kind.consequence,
        cause.kind.action,
        1.8e9,
        21_200,
        first_out=True,
    )
    return trip, ALARM, msgspec.structs.replace(ALARM, key="other", acknowledged=True)


def tripped() -> dict[str, Any]:
    """Return what changes with a trip."""
    step = 'Acknowledge "Overload": confirm that you have seen it.'
    left = (Remedy.ACKNOWLEDGE, Remedy.RESET, Remedy.RESUME)
    told = Recovery(Remedy.ACKNOWLEDGE, "acknowledge", step, left)
    reason = alarms()[0].cause
    return {"state": RunState.FAULT, "reason": reason, "alarms": alarms(), "recovery": told}


def settle() -> None:
    """Let everything be laid out: what takes its place may ask others for theirs."""
    for _ in range(4):
        QCoreApplication.processEvents()


def look(desk: Desk, what: str, top: QWidget | None = None) -> set[str]:
    """Return what is wrong with what is seen, in each room."""
    found: set[str] = set()
    for room, width, height in ROOMS:
        desk.window.resize(width, height)
        desk.window.draw_now()
        settle()
        assert (desk.window.width(), desk.window.height()) == (width, height)
        shown = top or desk.window.centralWidget()
        found |= {f"{what} {room}: {one}" for one in (*cut_texts(shown), *badly_placed(shown))}
    return found


def test_the_themes_differ_in_colours_alone() -> None:
    """So what has room in the light one has it in the dark one; the shell is tried in both."""
    light, dark = (re.sub("#[0-9a-f]{6,8}", "#", style_sheet(one)) for one in THEMES.values())
    assert light == dark


@pytest.mark.long
def test_a_new_theme_leaves_every_widget_its_place(desk: Desk) -> None:
    """The sheets of single widgets change colours alone too."""

    def sheets() -> dict[str, str]:
        """Return the sheets of the named widgets without their colours."""
        every = desk.window.findChildren(QWidget)
        return {
            one.objectName(): re.sub("#[0-9a-f]{6,8}", "#", one.styleSheet())
            for one in every
            if one.objectName()
        }

    window = desk.window
    desk.tell(**tripped())
    assert desk.panel("faults")  # the last page: all are made, in whatever order tests run
    window.dress(LIGHT)  # the first time all of them are written
    before = sheets()
    desk.window.dress(DARK)
    desk.see(lambda: sheets() == before)
    desk.window.dress(LIGHT)


@pytest.mark.long
def test_watching(desk: Desk) -> None:
    window, found = desk.window, set()
    window.tabs.show_page("log")
    desk.see(lambda: desk.panel("log").table.rowCount())
    for page in ("overview", "cycle", "trends", "limits", "log", "wear"):
        window.tabs.show_page(page)
        found |= look(desk, page)
    assert sorted(found) == []


@pytest.mark.long
def test_a_trip_and_the_way_out_of_it(desk: Desk) -> None:
    window, found = desk.window, set()
    desk.tell(**tripped())
    window.tabs.show_page("log")
    found |= look(desk, "recovering")
    for page in ("overview", "limits"):
        window.tabs.show_page(page)
        window.page_bar.chosen.emit(window.tabs.currentIndex())
        found |= look(desk, page)
    assert sorted(found) == []


@pytest.mark.long
def test_before_a_test_and_after_it(desk: Desk) -> None:
    window, found = desk.window, set()
    desk.tell(state=RunState.STOPPED, file=str(desk.folder / "quick-20270101-080000.h5"))
    window.tabs.show_page("result")
    desk.see(lambda: desk.panel("result").card.result is not None)
    found |= look(desk, "result")
    desk.engine.say(first=1, count=0, state=RunState.CONNECTING, file="", test="", curves=False)
    desk.attach()
    window.tabs.show_page("start")
    desk.see(lambda: desk.panel("start").table.rows.rows)
    found |= look(desk, "start")
    window.tabs.show_page("overview")
    found |= look(desk, "before overview")
    desk.engine.say(first=1, count=0, state=RunState.READY, file="", test="", curves=False)
    desk.attach()
    window.controls.buttons["start"].click()
    found |= look(desk, "start bar")
    assert sorted(found) == []


@pytest.mark.long
def test_preparing(desk: Desk) -> None:
    window, found = desk.window, set()
    window.tabs.show_page("prepare")
    recipe = desk.panel("prepare").recipe
    desk.see(lambda: desk.panel("prepare")._records)
    recipe.rules.begin()
    recipe.unfold.setChecked(True)
    for step in range(len(STEPS) + 1):
        recipe.show_step(step)
        found |= look(desk, f"step {step + 1}")
    for editor in ("run.revolutions", "run.speed_rpm", "limits.overload_N", "stop.force_N"):
        recipe.form.edit(editor, "many")
    recipe.form._changed()
    recipe.show_step(3)
    found |= look(desk, "wrong 4")
    recipe.unsaved_bar.ask(recipe.unsaved(), "opening another file", lambda: None)
    found |= look(desk, "unsaved")
    recipe.unsaved_bar.put_away()
    window.tabs.show_page("queue")
    found |= look(desk, "queue")
    assert sorted(found) == []


@pytest.mark.long
def test_the_rig(desk: Desk) -> None:
    window, found = desk.window, set()
    window.tabs.show_page("devices")
    desk.tell(**furnished())
    for card in desk.panel("devices").cards.values():
        card.more.click()
    found |= look(desk, "devices")
    window.tabs.show_page("faults")
    desk.see(lambda: desk.panel("faults").shown)
    found |= look(desk, "faults")
    assert sorted(found) == []


@pytest.mark.long
def test_results_and_studies(desk: Desk) -> None:
    window, found = desk.window, set()
    window.tabs.show_page("results")
    results = desk.panel("results")
    desk.see(lambda: len(results.table.rows.rows) == 2 and results.table.rows.rows[1][1])
    found |= look(desk, "results")
    results.table.selectAll()
    results.buttons["compare"].click()
    results.table.selectRow(0)
    found |= look(desk, "comparison")
    window.tabs.show_page("studies")
    desk.see(lambda: desk.panel("studies").list.rowCount() == 1)
    found |= look(desk, "studies")
    assert sorted(found) == []


@pytest.mark.long
def test_bars_and_help(desk: Desk) -> None:
    window, found = desk.window, set()
    window.tabs.show_page("log")
    window.close_bar.ask()
    found |= look(desk, "closing")
    window.close_bar.hide()
    window.viewer_bar.show_holder(CommandHolder.OTHER, "E. Sample on measuring-room-2")
    window.viewer_bar.ask()
    found |= look(desk, "viewer", window.messages)
    window.viewer_bar.show_holder(CommandHolder.NOBODY, "")
    window.notice.take_status(make_status(engine_pid=1))
    window.notice.take_status(make_status(engine_pid=2, state=RunState.READY))
    found |= look(desk, "restart", window.messages)
    window._frame_replay(replay=True)
    window.replay_bar.show_status(make_status(), 21377)
    found |= look(desk, "replay", window.replay_bar)
    window._frame_replay(replay=False)
    window.show_help()
    helped = window.findChild(HelpWindow)
    for _, width, height in ROOMS:
        helped.resize(width, height)
        settle()
        found |= {f"help {width}: {one}" for one in (*cut_texts(helped), *badly_placed(helped))}
        assert helped.browser.document().idealWidth() <= helped.browser.viewport().width()
    assert sorted(found) == []
