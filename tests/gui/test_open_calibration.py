"""Two windows at a rig that a calibration occupies, as people use them."""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from commandline import rigapp
from PySide6.QtCore import Qt

from rigapp.gui.panel import Act
from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import LIGHT
from rigapp.schema.messages import RunState
from rigapp.service.client import Client
from rigapp.service.launch import find_engine
from rigapp.viewer.connection import EngineConnection
from rigapp.viewer.showntest import ShownTest
from tests.gui.calibration_app import hang_weights

EXAMPLES = Path(__file__).parents[2] / "examples"
APP = Path(__file__).with_name("calibration_app.py")


@pytest.fixture
def files(tmp_path: Path) -> tuple[Path, Path]:
    """Return a rig file of its own, and a test that starts quickly."""
    rig, test = tmp_path / "rig.toml", tmp_path / "t.toml"
    rig.write_text((EXAMPLES / "simulated.toml").read_text("utf-8"), "utf-8")
    text = (EXAMPLES / "quick.toml").read_text("utf-8")
    text = text.replace("acceleration_rpm_per_s = 60.0", "acceleration_rpm_per_s = 240.0")
    test.write_text(text, "utf-8")
    return rig, test


@pytest.fixture
def beside(operate: Any, qtbot: Any, files: tuple[Path, Path], tmp_path: Path) -> Iterator[Any]:
    """Return the maker of a second window beside that of an operator."""
    rig, test = files
    made: list[MainWindow] = []

    def factory() -> Client:
        entry = find_engine(rig)
        assert entry is not None
        return Client(entry, "Bo")

    def opened(first: Any) -> Any:
        window = MainWindow(
            EngineConnection(factory), ShownTest(), LIGHT,
            rig=rig, tests=[test], results_folder=tmp_path,
        )  # fmt: skip
        qtbot.addWidget(window)
        window.show()
        window.start()
        made.append(window)
        return type(first)(window, first.host, qtbot)

    yield opened
    for window in made:
        window._discard = True
        window._leave()


def press(one: Any, key: Qt.Key) -> None:
    """Press a key in the window that is in front."""
    one.window.raise_()
    one.window.activateWindow()
    one.see(one.window.isActiveWindow)
    one.press(key)


def turns(one: Any) -> None:
    """Start the test by F5 and wait for its first revolutions: the crank is free."""
    one.sees_state(RunState.READY, RunState.STOPPED)
    press(one, Qt.Key.Key_F5)
    one.click(one.window.start_bar.go)
    one.sees_state(RunState.RUNNING)
    one.see(lambda: one.status.test.committed >= 3)
    one.click(one.window.controls.buttons["stop"])
    one.sees_state(RunState.STOPPED)


def refuses(one: Any) -> None:
    """Try whatever turns the spindle; the window says who calibrates what, and nothing turns."""
    window, answer = one.window, one.window.controls.answer
    one.sees_state(RunState.CALIBRATING)
    for key in (Qt.Key.Key_F5, Qt.Key.Key_F10):
        window.controls.show_answer("", good=True)
        press(one, key)
        one.see(lambda: "load cell, by " in answer.text() and "Nothing starts" in answer.text())
    assert window.start_bar.isHidden()
    assert not window.controls.buttons["start"].isEnabled()
    window.start_bar.open()
    assert not window.start_bar.go.isEnabled()
    assert "load cell, by " in window.start_bar.message.text()
    window.start_bar.hide()
    page = window.tabs.panels["start"]
    one.see(lambda: not page.ways[Act.TRY].button.isEnabled() or not page.isVisible())
    assert window.controls.buttons["stop"].isEnabled()
    one.click(one.window.controls.buttons["stop"])
    one.see(lambda: "nothing to stop" in answer.text())
    assert one.host.engine.state in (RunState.READY, RunState.STOPPED)


@pytest.mark.long
@pytest.mark.timeout(600)
def test_an_open_guide_keeps_the_rig_still_in_both_windows(
    operate: Any, beside: Callable[[Any], Any], files: tuple[Path, Path]
) -> None:
    rig, test = files
    with operate(rig, test) as first:
        second = beside(first)
        first.host.connect()
        turns(first)  # from here on the rig has the mechanism of the test, and keeps its hands
        hang_weights(first.window)
        for one in (first, second):
            refuses(one)
        assert "load cell, by E. Sample" in second.window.notice.text.text()
        assert first.window.notice.end.isHidden()
        assert second.window.notice.end.isVisible()
        assert first.status.recovery.verb == ""
        assert first.host.engine.state is RunState.STOPPED
        press(second, Qt.Key.Key_F3)
        assert second.window.guide.wizard is None
        # It is closed in the middle, with a weight on the pin: the hands of the training go too.
        first.window.guide.wizard.reject()
        turns(second)
        assert second.window.notice.end.isHidden()
        hang_weights(first.window)
        second.sees_state(RunState.CALIBRATING)
        # A window that is closed as it should be frees the rig as well.
        first.window._leave()
        turns(second)


@pytest.mark.long
@pytest.mark.timeout(600)
@pytest.mark.parametrize(
    "way", ["window", *(pytest.param(one, marks=pytest.mark.long) for one in ("command", "verb"))]
)
def test_a_killed_window_leaves_it_until_somebody_ends_it(
    operate: Any, files: tuple[Path, Path], tmp_path: Path, way: str
) -> None:
    rig, test = files
    with operate(rig, test) as one:
        one.host.connect()
        turns(one)  # from here on the rig has the mechanism of the test, and keeps its hands
        command = [sys.executable, str(APP), str(rig), str(tmp_path)]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as other:
            assert other.stdout is not None
            assert other.stdout.readline().strip() == "weights hang"
            other.send_signal(signal.SIGKILL)
        refuses(one)
        notice, asked = one.window.notice, one.window.guide.end_bar
        one.click(notice.end)
        assert "load cell, by Ada" in asked.text.text()
        assert "Check the pin" in asked.text.text()
        assert asked.keep.hasFocus() or not one.window.isActiveWindow()
        one.click(asked.keep)
        assert asked.isHidden()
        refuses(one)
        if way == "window":
            one.click(notice.end)
            one.click(asked.confirm)
        elif way == "command":
            one.click(notice.end)
            done = rigapp("calibrate", "release", "--rig", rig, "--yes")
            assert done.returncode == 0, done.stderr
            one.see(asked.isHidden)
        else:
            assert one.window._connection._client.request("calibration_release").ok
        turns(one)
