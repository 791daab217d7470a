"""The window on a scripted engine: what it shows, what its buttons ask for."""

from __future__ import annotations

import gc
import itertools
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import msgspec
import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractSpinBox,
    QComboBox,
    QLabel,
    QLineEdit,
    QTableWidget,
    QWidget,
)

from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import DARK, LIGHT
from rigapp.schema.messages import Alarm, Reply, RunState

Attach = Callable[[], None]


def wait_for_verb(window: MainWindow, engine: Any, qtbot: Any, verb: str) -> dict[str, Any]:
    def asked() -> bool:
        window.tick()
        return verb in engine.verbs

    qtbot.waitUntil(asked, timeout=PATIENCE_MS)
    return dict(engine.requests)[verb]


def test_the_header_tells_state_cycle_end_age_margin_agreement(
    window: MainWindow, engine: Any, attach: Attach, alarm: Alarm
) -> None:
    engine.say(count=1233, alarms=(alarm,))
    attach()
    header = window.header
    assert header.state.value.whole == "Running"
    assert header.tiles["cycle"].value.whole.replace("\u202f", "") == "1234 of 21377"
    assert "in 11 h" in header.tiles["cycle"].detail.whole
    assert window.side.live.values["age"].value.whole.endswith(" s")
    assert header.tiles["force"].value.whole.endswith(" N")
    # Without its test file no limit of the force is known; that of another quantity says nothing.
    assert header.tiles["force"].detail.whole == "not evaluated yet"
    assert header.margin.value() == 0
    assert " ± 1.1 µm" in header.tiles["wear"].value.whole
    assert header.tiles["agreement"].value.whole == "±1.7 N"
    assert header.tiles["alarms"].value.whole == "1 new"
    assert window.rail.kind.text() == "SIMULATED"
    assert window.controls.test.whole == "The paper's wear test"


def test_one_key_does_it(window: MainWindow, engine: Any, attach: Attach, qtbot: Any) -> None:
    with qtbot.waitActive(window, timeout=PATIENCE_MS):
        window.activateWindow()
    for number, (key, verb, state) in enumerate(
        [
            (Qt.Key.Key_F4, "connect", RunState.IDLE),
            (Qt.Key.Key_F6, "pause", RunState.RUNNING),
            (Qt.Key.Key_F5, "resume", RunState.PAUSED),
            (Qt.Key.Key_F12, "stop", RunState.PAUSED),
        ]
    ):
        engine.say(first=number + 1, count=1, state=state)
        attach()
        qtbot.keyClick(window, key)
        arguments = wait_for_verb(window, engine, qtbot, verb)
        if verb in ("pause", "stop"):
            assert arguments["reason"] == "", "nobody has typed one"


def test_the_reason_typed_before_goes_with_the_stop(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any
) -> None:
    engine.say(count=3)
    attach()
    qtbot.keyClicks(window.controls.text, "squeal from the joint")
    window.controls.buttons["stop"].click()
    arguments = wait_for_verb(window, engine, qtbot, "stop")
    assert arguments == {"reason": "squeal from the joint"}
    assert window.controls.text.text() == ""


def test_the_reason_can_be_given_after_the_stop(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any
) -> None:
    engine.say(count=3)
    attach()
    window.controls.buttons["stop"].click()
    wait_for_verb(window, engine, qtbot, "stop")
    qtbot.keyClicks(window.controls.text, "smoke")
    qtbot.keyClick(window.controls.text, Qt.Key.Key_Return)
    arguments = wait_for_verb(window, engine, qtbot, "note")
    assert arguments["text"] == "Reason why the test was stopped: smoke"


def test_the_reason_for_going_on_with_a_file_goes_along(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any
) -> None:
    engine.say(count=0, curves=False, state=RunState.READY, planned=0, file="")
    attach()
    window.controls.text.setText("cell was calibrated again")
    window.tabs.panels["results"].wanted.emit("resume_file", {"file": "x.h5"})
    arguments = wait_for_verb(window, engine, qtbot, "resume_file")
    assert arguments == {"file": "x.h5", "reason": "cell was calibrated again"}
    assert window.controls.text.text() == ""


def test_one_key_acknowledges_the_alarm_that_is_told_and_leads_to_where_it_is(
    window: MainWindow, engine: Any, attach: Attach, alarm: Any, qtbot: Any
) -> None:
    engine.say(count=3, alarms=(alarm,))
    attach()
    with qtbot.waitActive(window, timeout=PATIENCE_MS):
        window.activateWindow()
    window.tabs.show_page("results")
    qtbot.keyClick(window, Qt.Key.Key_F7)
    assert engine.verbs == []
    assert window.tabs.panels["alarms"].isVisible()
    qtbot.keyClick(window, Qt.Key.Key_F7)
    assert wait_for_verb(window, engine, qtbot, "acknowledge") == {"key": alarm.key}


def test_a_note_takes_one_key(window: MainWindow, engine: Any, attach: Attach, qtbot: Any) -> None:
    engine.say(count=3)
    attach()
    with qtbot.waitActive(window, timeout=PATIENCE_MS):
        window.activateWindow()
    qtbot.keyClick(window, Qt.Key.Key_F8)
    assert window.focusWidget() is window.controls.text
    qtbot.keyClicks(window.controls.text, "oil added")
    qtbot.keyClick(window.controls.text, Qt.Key.Key_Return)
    assert wait_for_verb(window, engine, qtbot, "note") == {"text": "oil added"}


def test_starting_names_test_and_file(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any
) -> None:
    engine.say(count=0, curves=False, state=RunState.READY, planned=0, file="")
    attach()
    window.controls.buttons["start"].click()
    assert window.start_bar.isVisible()
    assert window.header.isVisible()
    qtbot.keyClick(window.start_bar.test, Qt.Key.Key_Down)
    assert window.tabs.prepare.recipe.path == Path("examples/paper.toml")
    window.start_bar.revolutions.setValue(12)
    qtbot.keyClick(window.start_bar, Qt.Key.Key_Return)
    arguments = wait_for_verb(window, engine, qtbot, "start")
    assert arguments["test"].endswith("paper.toml")
    assert arguments["revolutions"] == 12
    assert "paper-" in arguments["out"]
    assert arguments["out"].endswith(".h5")
    assert not window.start_bar.isVisible()


def test_a_refusal_is_said_in_words(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any
) -> None:
    engine.say(count=3, state=RunState.PAUSED)
    attach()
    engine.reply = Reply(ok=False, sentence="The emergency stop is pressed.")
    window.controls.buttons["resume"].click()

    def said() -> bool:
        window.tick()
        return "emergency stop is pressed" in window.controls.answer.whole

    qtbot.waitUntil(said, timeout=PATIENCE_MS)
    assert "▲" in window.controls.answer.whole


@pytest.mark.long
def test_buttons_apply_to_their_states(window: MainWindow, engine: Any, attach: Attach) -> None:
    for number, state in enumerate(RunState):
        engine.say(first=number + 1, count=1, state=state)
        attach()
        enabled = {verb for verb, button in window.controls.buttons.items() if button.isEnabled()}
        assert ("pause" in enabled) == (state in {RunState.STARTING, RunState.RUNNING}), state
        assert ("resume" in enabled) == (state is RunState.PAUSED), state
        standing = state in {RunState.IDLE, RunState.READY, RunState.STOPPED}
        assert ("start" in enabled) == standing, state
        assert "stop" in enabled, state


def test_a_dead_engine_is_said_and_attached_again(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any
) -> None:
    engine.say(count=5)
    attach()
    engine.dead = True
    window.tick()
    assert window.header.state.value.whole == "No engine"
    assert window.controls.buttons["stop"].isEnabled()
    engine.dead = False
    engine.say(first=6, count=2)
    attach()
    assert window.header.state.value.whole == "Running"
    assert len(window._test.data.rows) == 7


def test_alarms_show_cause_consequence_action_and_are_acknowledged(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any, alarm: Alarm
) -> None:
    engine.say(count=5, alarms=(alarm,))
    attach()
    card = window.side.alarms.cards.cards[0]
    assert card.isVisible()
    texts = [card.title.text(), *(label.text() for label in card.texts.values())]
    assert texts == [alarm.title, alarm.cause, alarm.consequence, alarm.action]
    window.side.alarms.acknowledge.click()
    assert wait_for_verb(window, engine, qtbot, "acknowledge") == {"key": alarm.key}


def test_shelving_needs_a_reason(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any, alarm: Alarm
) -> None:
    engine.say(count=5, alarms=(alarm,))
    attach()
    window.tabs.setCurrentIndex(3)
    panel = window.tabs.panels["alarms"]
    assert not panel.shelve.isEnabled()
    qtbot.keyClicks(panel.reason, "sensor is being changed")
    panel.shelve.click()
    arguments = wait_for_verb(window, engine, qtbot, "shelve")
    assert arguments == {"key": alarm.key, "reason": "sensor is being changed", "minutes": 15}


def test_an_acknowledged_alarm_stays_listed_after_a_critical_one(
    window: MainWindow, engine: Any, attach: Attach, alarm: Alarm
) -> None:
    done = msgspec.structs.replace(alarm, key="old", acknowledged=True, state="acknowledged")
    engine.say(count=5, alarms=(done, alarm))
    attach()
    assert [alarm.key for alarm in window.tabs.panels["alarms"].cards.alarms] == [alarm.key, "old"]


def test_only_what_can_be_seen_is_drawn(window: MainWindow, engine: Any, attach: Attach) -> None:
    engine.say(count=5)
    attach()
    assert window.tabs.panels["overview"].shown is not None
    assert window.tabs.panels["cycle"].overlay.shown is None
    window.tabs.setCurrentIndex(1)
    assert window.tabs.panels["cycle"].overlay.shown is not None


def test_the_residual_is_measured_minus_model(
    window: MainWindow, engine: Any, attach: Attach
) -> None:
    engine.say(count=5)
    attach()
    shown = window.tabs.panels["overview"].shown
    assert shown is not None
    assert shown.residual is not None
    residual = shown.residual["force"]
    middle = slice(len(residual) // 2 - 50, len(residual) // 2 + 50)
    assert residual[middle].mean() == pytest.approx(1.0, abs=0.4)
    assert shown.measured["force"][middle].mean() == pytest.approx(97.0, abs=0.4)
    drawn = window.tabs.panels["overview"]._raw_residual.y
    assert drawn.max() == residual.max()
    assert drawn.min() == residual.min()
    angle, means = (
        window.tabs.panels["overview"]._residual["force"].x,
        window.tabs.panels["overview"]._residual["force"].y,
    )
    assert means[abs(angle - 180.0) < 20.0].mean() == pytest.approx(1.0, abs=0.3)


@pytest.mark.long
def test_every_visible_control_has_a_name(
    window: MainWindow, engine: Any, attach: Attach, alarm: Alarm
) -> None:
    engine.say(count=5, alarms=(alarm,))
    attach()
    window.start_bar.open()
    window.show_help()
    missing = []
    for index in range(window.tabs.count()):
        window.tabs.setCurrentIndex(index)
        kinds = (QAbstractButton, QLineEdit, QComboBox, QAbstractSpinBox, QTableWidget)
        for kind in kinds:
            for widget in window.findChildren(kind):
                inside = isinstance(widget.parent(), (QAbstractSpinBox, QComboBox))
                own = not widget.objectName().startswith("qt_") and not inside
                inner = type(widget).__name__ in ("QTableCornerButton", "ScrollRightButton")
                if widget.isVisible() and own and not inner and not spoken(widget):
                    missing.append(f"{type(widget).__name__} {widget.objectName()!r}")
    assert missing == []


def spoken(widget: QWidget) -> bool:
    """Return whether the accessibility tree has a name and the widget an id."""
    interface = QAccessible.queryAccessibleInterface(widget)
    name = interface.text(QAccessible.Text.Name) if interface is not None else ""
    anonymous = type(widget).__name__ in ("QToolButton",)
    return bool(name) and (anonymous or bool(widget.objectName()))


def test_no_access_key_is_taken_twice(
    window: MainWindow, engine: Any, attach: Attach, alarm: Alarm
) -> None:
    engine.say(count=5, alarms=(alarm,))
    attach()
    window.start_bar.open()
    for index in range(window.tabs.count()):
        window.tabs.setCurrentIndex(index)
        keys: dict[str, str] = {}
        for widget in [*window.findChildren(QAbstractButton), *window.findChildren(QLabel)]:
            if not widget.isVisible() or (isinstance(widget, QLabel) and widget.buddy() is None):
                continue
            text = widget.text().replace("&&", "")
            if "&" in text:
                key = text[text.index("&") + 1].lower()
                assert key not in keys, f"{text} and {keys[key]} share Alt+{key}"
                keys[key] = text


@pytest.mark.long
def test_thousands_of_updates_leak_neither_memory_nor_references(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any, qapp: Any
) -> None:
    engine.say(count=50)
    attach()
    snapshots = [(51 + 2 * step) for step in range(1200)]

    def run(firsts: list[int]) -> None:
        for first in firsts:
            engine.say(first=first, count=2, curves=first % 5 == 1)
            window.tick()
            qapp.processEvents()
        gc.collect()

    run(snapshots[:300])
    nones, objects, resident = sys.getrefcount(None), len(gc.get_objects()), [resident_kB()]
    for begin in range(300, len(snapshots), 300):
        run(snapshots[begin : begin + 300])
        resident.append(resident_kB())
    assert len(window._test.data.rows) == 50 + 2 * len(snapshots)
    # A leak grows in every batch; what the tests before have left may move the memory in one.
    assert min(after - before for before, after in itertools.pairwise(resident)) < 4_000
    if sys.version_info < (3, 12):  # from there on None lives for ever, and nobody counts right
        assert abs(sys.getrefcount(None) - nones) < 500
    assert len(gc.get_objects()) - objects < 2000


def resident_kB() -> int:
    """Return the resident memory of this process."""
    with open("/proc/self/status", encoding="ascii") as file:
        line = next(line for line in file if line.startswith("VmRSS"))
    return int(line.split()[1])


def test_a_start_waits_until_the_devices_are_ready(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any
) -> None:
    window.start_when_idle(Path("examples/quick.toml"))
    for state in (RunState.IDLE, RunState.CONNECTING):
        engine.say(count=0, curves=False, state=state, planned=0, file="")
        attach()
        assert "waiting" in window.controls.answer.whole
    assert engine.verbs == []
    engine.say(count=0, curves=False, state=RunState.READY, planned=0, file="")
    arguments = wait_for_verb(window, engine, qtbot, "start")
    assert arguments["test"].endswith("quick.toml")
    assert "revolutions" not in arguments


def test_an_engine_that_stays_idle_is_asked_all_the_same(
    window: MainWindow,
    engine: Any,
    attach: Attach,
    qtbot: Any,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("rigapp.gui.window.controls.IDLE_BEFORE_START_S", 0.0)
    window.start_when_idle(Path("examples/quick.toml"))
    engine.say(count=0, curves=False, state=RunState.IDLE, planned=0, file="")
    attach()
    wait_for_verb(window, engine, qtbot, "start")


def test_a_start_that_ends_in_a_fault_is_given_up(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any
) -> None:
    window.start_when_idle(Path("examples/quick.toml"))
    for state in (RunState.IDLE, RunState.FAULT):
        engine.say(count=0, curves=False, state=state, planned=0, file="")
        attach()
    assert "not started" in window.controls.answer.whole
    engine.say(count=0, curves=False, state=RunState.READY, planned=0, file="")
    attach()
    assert "start" not in engine.verbs


def test_values_that_are_not_known_yet_are_dashes(
    window: MainWindow, engine: Any, attach: Attach
) -> None:
    engine.say(
        count=0,
        curves=False,
        state=RunState.IDLE,
        planned=0,
        file="",
        data_age_s=float("inf"),
        worst_margin="",
        worst_margin_percent=1e9,
        residual_rms_N=float("nan"),
        twin_revolution=0,
        twin_age_s=float("inf"),
        expected_end_at=0.0,
        drive=None,
        devices=(),
        channels=(),
    )
    attach()
    header = window.header
    for tile in (
        header.tiles["cycle"],
        header.tiles["force"],
        header.tiles["wear"],
        header.tiles["agreement"],
        window.side.live.values["age"],
    ):
        assert tile.value.whole == "–"


@pytest.mark.long
def test_light_and_dark_are_both_complete(
    window: MainWindow, engine: Any, attach: Attach, alarm: Alarm, qtbot: Any
) -> None:
    engine.say(count=5, alarms=(alarm,))
    attach()
    with qtbot.waitActive(window, timeout=PATIENCE_MS):
        window.activateWindow()
    for theme, background in (("dark", DARK.base), ("light", LIGHT.base)):
        qtbot.keyClick(window, Qt.Key.Key_F9)
        assert window.theme.name == theme
        qtbot.waitUntil(lambda: not window.dressing.isActive(), timeout=PATIENCE_MS)
        picture = window.tabs.panels["overview"].plot.grab().toImage()
        corner = picture.pixelColor(picture.width() - 3, 3).name()
        assert corner == background


@pytest.mark.sampled
@pytest.mark.parametrize("tab", [0, 1])
def test_another_test_begins_with_empty_plots(
    window: MainWindow, engine: Any, attach: Attach, tab: int
) -> None:
    window.tabs.setCurrentIndex(tab)
    engine.say(count=5)
    attach()
    engine.say(count=0, curves=False, state=RunState.READY, planned=0, file="", test="")
    attach()
    overlay = window.tabs.panels["overview"] if tab == 0 else window.tabs.panels["cycle"].overlay
    assert overlay.shown is None
    assert len(overlay._measured["force"].x) == 0
    assert overlay.plot.instead.startswith("No revolution measured yet")
    if tab == 1:
        item = window.tabs.panels["cycle"].values.item(0, 0)
        assert item is not None
        assert item.text() == "–"
