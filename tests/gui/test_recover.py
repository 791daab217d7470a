"""The way out of a fault by the window: what the panel shows, and the whole way by real clicks."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import Qt

from rigapp.gui.window.recover import KEY, RecoverPanel
from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import DARK, LIGHT
from rigapp.schema.messages import Alarm, Ends, Recovery, Remedy, Reply, RunState, Severity
from rigapp.schema.states import ENDED
from rigapp.storage import open_test

EXAMPLES = Path(__file__).parents[2] / "examples"
NEVER_OVER = 5000

LOST = Alarm(
    key="device_lost:daq",
    severity=Severity.CRITICAL,
    title="daq lost",
    cause="daq on COM3: the port is gone",
    consequence="The test was ended and the spindle stopped.",
    action="Check cable and power, then reconnect.",
    raised_at=1.8e9,
    revolution=12,
    first_out=True,
    ends=Ends.CONNECTION,
)
CONNECT = Recovery(
    Remedy.CONNECT, "connect", LOST.action,
    (Remedy.CAUSE, Remedy.CONNECT, Remedy.ACKNOWLEDGE, Remedy.RESET, Remedy.RESUME), LOST.key,
)  # fmt: skip
RESUME = Recovery(Remedy.RESUME, "resume_file", "Resume the test in a.h5.", (Remedy.RESUME,))


def test_the_panel_marks_the_next_step_and_asks_for_it(
    qtbot: Any, qapp: Any, make_status: Any
) -> None:
    panel = RecoverPanel(LIGHT)
    qtbot.addWidget(panel)
    asked: list[tuple[str, dict[str, Any]]] = []
    panel.wanted.connect(lambda verb, arguments: asked.append((verb, arguments)))
    panel.take_status(make_status())
    assert panel.isHidden()
    panel.take_status(make_status(state=RunState.FAULT, alarms=(LOST,), recovery=CONNECT))
    assert not panel.isHidden()
    marks = {step: label.text()[0] for step, label in panel.steps.items()}
    assert marks == {
        Remedy.CAUSE: "○", Remedy.CONNECT: "▶", Remedy.ACKNOWLEDGE: "○", Remedy.RESET: "○",
        Remedy.RESUME: "○",
    }  # fmt: skip
    assert panel.cause.text() == LOST.cause
    assert panel.next.text() == LOST.action
    panel.button.click()
    panel.button.click()  # once is enough
    assert asked == [("connect", {})]
    panel.dress(DARK)
    panel.take_status(make_status(state=RunState.READY, file="a.h5", recovery=RESUME))
    assert {
        label.text()[0] for step, label in panel.steps.items() if step is not Remedy.RESUME
    } == {"✔"}
    assert panel.other.isVisibleTo(panel)
    panel.button.click()
    assert asked[1:] == [("resume_file", {"file": "a.h5"})]
    panel.answered()
    assert panel.button.isEnabled()  # it was refused: once more
    panel.take_status(make_status())
    assert panel.isHidden()


def test_the_button_stays_under_the_mouse_while_the_next_step_is_done(
    window: MainWindow, engine: Any, attach: Callable[[], None], qtbot: Any
) -> None:
    window.resize(1366, 640)
    window.tabs.show_page("devices")
    engine.say(state=RunState.FAULT, alarms=(LOST,), recovery=CONNECT)
    attach()
    panel, bar = window.recover, window.side.verticalScrollBar()
    qtbot.waitUntil(lambda: bar.maximum() > 0, timeout=PATIENCE_MS)
    place = panel.button.mapTo(window, panel.button.rect().topLeft())
    qtbot.mouseClick(panel.button, Qt.MouseButton.LeftButton)
    assert not panel.button.isEnabled()
    qtbot.waitUntil(lambda: "connect" in engine.verbs, timeout=PATIENCE_MS)
    acknowledge = Recovery(Remedy.ACKNOWLEDGE, "acknowledge", "Acknowledge it.", (), LOST.key)
    engine.say(state=RunState.READY, alarms=(LOST,), recovery=acknowledge)
    attach()
    assert panel.button.isEnabled()
    assert panel.button.hasFocus()
    assert bar.value() == 0
    assert panel.button.mapTo(window, panel.button.rect().topLeft()) == place


@pytest.mark.long
def test_start_is_closed_with_the_next_step_as_its_reason(
    window: MainWindow, engine: Any, attach: Callable[[], None], qtbot: Any
) -> None:
    reset = Recovery(
        Remedy.RESET, "reset", "Reset: nothing moves.", (Remedy.RESET, Remedy.RESUME), "x"
    )
    engine.say(state=RunState.READY, alarms=(LOST,), recovery=reset)
    attach()
    start = window.controls.buttons["start"]
    assert not start.isEnabled()
    assert "Reset: nothing moves." in start.toolTip()
    assert window.tabs.panels["alarms"].reset.isEnabled()  # in every state, while an alarm waits
    engine.reply = Reply(ok=True)
    window.recover.button.click()
    qtbot.waitUntil(lambda: engine.verbs == ["reset"], timeout=PATIENCE_MS)
    engine.say(state=RunState.READY, recovery=RESUME)
    attach()
    assert start.isEnabled()


@pytest.mark.long
@pytest.mark.timeout(300)
def test_a_pulled_cable_is_recovered_from_by_the_panel_and_the_test_completed(
    operate: Any, tmp_path: Path
) -> None:
    text = (EXAMPLES / "quick.toml").read_text(encoding="utf-8")
    text = text.replace("revolutions = 500", f"revolutions = {NEVER_OVER}", 1)
    test = tmp_path / "test.toml"
    test.write_text(text.replace("[prediction]", "[prediction]\nenabled = false", 1), "utf-8")
    with operate(EXAMPLES / "simulated.toml", test) as hands:
        host, window = hands.host, hands.window
        hands.start_test()
        pull_cable(hands)
        hands.sees_state(RunState.FAULT)
        hands.see(lambda: window.recover.isVisible())
        assert "daq" in window.recover.cause.text()
        file = hands.status.test.file
        hands.sees_step(Remedy.CONNECT)
        hands.press(Qt.Key.Key_F10)  # the cable is still out
        hands.see(lambda: "refused" in window.controls.answer.text())
        hands.sees_step(Remedy.CONNECT)
        hands.click(window.tabs.panels["faults"].end)
        hands.see(lambda: "clear fault: done" in window.controls.answer.text())
        hands.click(window.recover.button)
        hands.sees_step(Remedy.ACKNOWLEDGE)
        assert hands.status.engine.state is RunState.READY
        hands.press(Qt.Key.Key_F10)
        hands.sees_step(Remedy.RESET)
        hands.click(window.recover.button)
        hands.sees_step(Remedy.RESUME)
        before = hands.status.test.revolution
        hands.click(window.recover.button)
        hands.sees_state(RunState.RUNNING)
        assert not window.recover.isVisible()
        assert hands.status.test.file == file
        hands.see(lambda: hands.status.test.committed > before + 5)
        host.engine.extend(hands.status.test.revolution + 40)
        host.engine.wait(ENDED, 60.0)
        hands.sees_state(RunState.STOPPED)
        assert not window.recover.isVisible()
    with open_test(Path(file)) as recorded:
        assert recorded.summary()["status"] == "complete"
        assert recorded.summary()["gaps"] >= 1
        numbers = recorded.rows()["revolution"]
    assert len(numbers) > before + 5
    assert np.all(np.diff(numbers) > 0)
    assert [path.name for path in tmp_path.glob("*.h5")] == [Path(file).name]


def pull_cable(hands: Any) -> None:
    """Choose the fault in its tab and cause it."""
    faults, tabs = hands.window.tabs.panels["faults"], hands.window.tabs
    tabs.show_page("faults")
    faults.search.setText("daq cable pull")
    hands.see(lambda: faults.list.rowCount() == 1)
    faults.duration.clear()
    hands.click(faults.cause)


def test_the_panels_key_is_no_other_one() -> None:
    from rigapp.gui.window.command import KEY as COMMAND_KEY
    from rigapp.gui.window.controls import BUTTONS

    assert KEY not in {COMMAND_KEY, *(one.key for one in BUTTONS), "F1", "F3", "F8", "F9"}
