"""Who has control: two windows on one engine, judged by the engine's own rules."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import Qt

from rigapp.gui.widgets.build import GuardedButton
from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import DARK, LIGHT
from rigapp.schema.messages import Reply, Request, RunState, Snapshot
from rigapp.schema.states import Refused
from rigapp.service.requests import ControlLock
from rigapp.viewer.connection import EngineConnection
from rigapp.viewer.showntest import ShownTest


class SharedEngine:
    """One engine with the service's own rules of command; every viewer gets every snapshot."""

    def __init__(self, snapshot: Callable[..., Snapshot]) -> None:
        self._snapshot = snapshot
        self.log: list[str] = []
        self.done: list[tuple[str, str]] = []
        self.command = ControlLock(
            lambda text, who, before, after: self.log.append(f"{who}: {text}")
        )
        self.state = RunState.RUNNING

    def snapshot(self) -> Snapshot:
        return self._snapshot(
            count=0, curves=False, file="", state=self.state, in_command=self.command.holder
        )

    def handle(self, request: Request) -> Reply:
        verbs = {
            "take_command": lambda asked: self.command.take(asked, **asked.arguments),
            "release_command": self.command.release,
            "present": self.command.present,
        }
        try:
            self.command.check(request)
            if request.verb in verbs:
                return Reply(ok=True, result=verbs[request.verb](request))
        except Refused as error:
            return Reply(ok=False, sentence=str(error))
        self.done.append((request.client, request.verb))
        return Reply(ok=True)


class Viewer:
    """A client of the shared engine."""

    def __init__(self, engine: SharedEngine, name: str, identity: str) -> None:
        self._engine, self._name, self._identity = engine, name, identity

    def poll(self) -> Snapshot | None:
        return self._engine.snapshot()

    def request(
        self, verb: str, arguments: dict[str, Any] | None = None, timeout_s: float = 5.0
    ) -> Reply:
        request = Request(verb, arguments or {}, operator=self._name, client=self._identity)
        return self._engine.handle(request)

    def close(self) -> None:
        pass


@pytest.fixture
def engine(make_snapshot: Callable[..., Snapshot]) -> SharedEngine:
    return SharedEngine(make_snapshot)


@pytest.fixture
def windows(
    engine: SharedEngine, qtbot: Any, light_application: Any, tmp_path: Path, no_history: Any
) -> Iterator[tuple[MainWindow, MainWindow]]:
    """Return the windows of two viewers who bear the same name."""
    made = []
    for identity in ("first", "second"):
        client = Viewer(engine, "Ann", identity)
        window = MainWindow(
            EngineConnection(lambda client=client: client),  # type: ignore[misc]
            ShownTest(no_history),
            LIGHT,
            tests=[Path("examples/quick.toml")],
            results_folder=tmp_path,
        )
        qtbot.addWidget(window)
        window.resize(1400, 900)
        window.show()
        made.append(window)
    yield made[0], made[1]
    for window in made:
        window.close()


def ticked(qtbot: Any, *windows: MainWindow) -> Callable[[Callable[[], bool]], None]:
    """Return a function that ticks windows until a condition holds."""

    def until(condition: Callable[[], bool]) -> None:
        def look() -> bool:
            for window in windows:
                window.tick()
            return condition()

        qtbot.waitUntil(look, timeout=PATIENCE_MS)

    return until


def test_command_is_taken_seen_by_the_other_and_given_back(
    windows: tuple[MainWindow, MainWindow], engine: SharedEngine, qtbot: Any
) -> None:
    one, other = windows
    until = ticked(qtbot, one, other)
    until(lambda: one.header.state.value.whole == "Running")
    assert "Nobody" in one.controls.command_line.text.text()
    assert one.controls.buttons["pause"].isEnabled()
    with qtbot.waitActive(one, timeout=PATIENCE_MS):
        one.activateWindow()
    qtbot.keyClick(one, Qt.Key.Key_F2)
    until(lambda: "You have control" in one.controls.command_line.text.text())
    until(lambda: "Ann has control" in other.controls.command_line.text.text())
    assert not one.viewer_bar.isVisible()
    assert other.viewer_bar.isVisible()
    assert "VIEWING ONLY" in other.viewer_bar.text.text()
    until(lambda: other.windowTitle().startswith("Viewing only"))
    assert one.controls.buttons["pause"].isEnabled()
    one.controls.command_line.button.click()
    until(lambda: engine.command.holder == "")
    until(lambda: not other.viewer_bar.isVisible())
    assert other.controls.buttons["pause"].isEnabled()


def test_a_viewer_can_only_stop_and_acknowledge_and_reads_why(
    windows: tuple[MainWindow, MainWindow], engine: SharedEngine, qtbot: Any
) -> None:
    one, other = windows
    until = ticked(qtbot, one, other)
    until(lambda: one.header.state.value.whole == "Running")
    one.controls.command_line.act()
    until(lambda: other.viewer_bar.isVisible())
    other.tabs.make_all(at_once=True)  # what is made later is forbidden too
    guarded = other.findChildren(GuardedButton)
    names = {button.objectName() for button in guarded}
    assert {"start", "pause", "resume", "connect", "add_note", "zero", "reconnect"} <= names
    assert {"limit_change", "reset", "shelve", "fault_cause"} <= names
    assert {"result_resume", "end_on"} <= names
    for button in guarded:
        assert not button.isEnabled(), button.objectName()
        assert "Ann has control" in button.toolTip(), button.objectName()
        assert "Ann has control" in button.accessibleDescription(), button.objectName()
    stop = other.controls.buttons["stop"]
    assert stop.isEnabled()
    stop.click()
    until(lambda: ("second", "stop") in engine.done)


@pytest.mark.long
def test_taking_over_names_who_loses_command_and_begins_with_the_harmless_answer(
    windows: tuple[MainWindow, MainWindow], engine: SharedEngine, qtbot: Any
) -> None:
    one, other = windows
    until = ticked(qtbot, one, other)
    until(lambda: one.header.state.value.whole == "Running")
    one.controls.command_line.act()
    until(lambda: other.viewer_bar.isVisible())
    with qtbot.waitActive(other, timeout=PATIENCE_MS):
        other.activateWindow()
    qtbot.keyClick(other, Qt.Key.Key_F2)
    bar = other.viewer_bar
    assert "Ann can then only look" in bar.text.text()
    assert other.focusWidget() is bar.cancel
    qtbot.keyClick(bar.cancel, Qt.Key.Key_Escape)
    assert not bar.confirm.isVisible()
    assert engine.log == ["Ann: took control"]
    bar.dress(DARK)
    qtbot.keyClick(other, Qt.Key.Key_F2)
    bar.confirm.click()
    until(lambda: "You have control" in other.controls.command_line.text.text())
    until(lambda: one.viewer_bar.isVisible())
    assert engine.log[-1] == "Ann: took control by force from Ann"


def test_a_window_that_closes_gives_command_back(
    windows: tuple[MainWindow, MainWindow], engine: SharedEngine, qtbot: Any
) -> None:
    one, _ = windows
    until = ticked(qtbot, one)
    until(lambda: one.header.state.value.whole == "Running")
    one.controls.command_line.act()
    until(lambda: "You have control" in one.controls.command_line.text.text())
    one.close()
    assert engine.command.holder == ""


def test_a_button_that_does_not_apply_says_why(
    windows: tuple[MainWindow, MainWindow], engine: SharedEngine, qtbot: Any
) -> None:
    one, _ = windows
    engine.state = RunState.READY
    ticked(qtbot, one)(lambda: one.header.state.value.whole == "Ready")
    tip = one.controls.buttons["pause"].toolTip()
    assert "Not now: the state is ready; it must be running or starting" in tip
    assert "(F5)" in one.controls.buttons["start"].toolTip()
