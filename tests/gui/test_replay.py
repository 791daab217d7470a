"""A recorded test through the same window, and its picture."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from patience import PATIENCE_MS

from rigapp.config.errors import UnusableInput
from rigapp.gui.window.headline import Level
from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import DARK
from rigapp.replay.client import ReplayClient
from rigapp.schema.messages import RunState
from rigapp.viewer.connection import EngineConnection
from rigapp.viewer.frames import ForceFrame
from rigapp.viewer.recording import load_events, load_revolution
from rigapp.viewer.showntest import ShownTest


def test_a_recorded_test_plays_from_its_first_to_its_last_row(
    recorded: Path, qtbot: Any, qapp: Any
) -> None:
    client = ReplayClient(recorded, speed=4.0)
    window = MainWindow(EngineConnection(lambda: client), ShownTest(), DARK)
    qtbot.addWidget(window)
    window.show()
    lengths: list[int] = []

    def playing() -> bool:
        window.tick()
        lengths.append(len(window._test.data.rows))
        return len(set(lengths)) > 3

    def ended() -> bool:
        playing()
        status = window._connection.status
        return status is not None and status.engine.state is RunState.STOPPED and window.settled

    qtbot.waitUntil(playing, timeout=PATIENCE_MS)
    assert lengths[-1] < 300
    assert client.request("replay", {"speed": 400.0}).ok
    qtbot.waitUntil(ended, timeout=PATIENCE_MS)
    assert lengths == sorted(lengths)
    assert lengths[-1] == 300
    data = window._test.data
    assert len(data.predictions) == 300
    assert data.cycle is not None
    assert data.cycle.revolution == 300
    assert "All revolutions are done" in window.header.state.detail.whole
    assert window.news.crank_over_follower == pytest.approx(0.375)
    box = window.tabs.panels["overview"].frame_box
    window.draw_now()
    box.setCurrentIndex(box.findData(ForceFrame.FOLLOWER))
    window.draw_now()
    assert window.tabs.panels["overview"].shown is not None
    assert abs(window.tabs.panels["overview"].shown.model["force_2"]).max() < 5e-3  # type: ignore[index]
    window.close()


def test_a_replay_pauses_and_refuses_what_needs_a_rig(recorded: Path, qtbot: Any) -> None:
    client = ReplayClient(recorded, speed=1.0)
    try:
        assert client.request("pause", {"reason": ""}).ok
        qtbot.waitUntil(lambda: _state(client) is RunState.PAUSED, timeout=PATIENCE_MS)
        refused = client.request("start", {"test": "x", "out": "y"})
        assert not refused.ok
        assert "replay" in refused.sentence
        assert client.request("resume").ok
        assert client.request("replay", {"speed": 100.0}).ok
        assert client.request("stop").ok
    finally:
        client.close()


def _state(client: ReplayClient) -> RunState | None:
    snapshot = client.poll()
    return snapshot.status.engine.state if snapshot is not None else None


def test_a_file_that_is_no_test_is_said_in_one_sentence(tmp_path: Path) -> None:
    path = tmp_path / "x.h5"
    path.write_bytes(b"not a test")
    with pytest.raises(UnusableInput, match="not an HDF5 file"):
        ReplayClient(path)


def test_the_nearest_stored_revolution_is_found(recorded: Path) -> None:
    stored = load_revolution(recorded, 123)
    assert stored.cycle.revolution == 120
    assert stored.prediction is not None
    assert stored.prediction.revolution == 120
    assert [event.text for event in load_events(recorded)] == ["oil added"]


def test_a_window_opened_late_gets_the_earlier_rows_from_the_file(
    recorded: Path, engine: Any, qtbot: Any, qapp: Any
) -> None:
    window = MainWindow(EngineConnection(engine.client), ShownTest(), DARK)
    qtbot.addWidget(window)
    window.show()
    engine.say(first=301, count=2, file=str(recorded))

    def complete() -> bool:
        window.tick()
        return len(window._test.data.rows) == 302

    qtbot.waitUntil(complete, timeout=PATIENCE_MS)
    assert list(window._test.data.rows.revolutions[[0, -1]]) == [1.0, 302.0]
    engine.say(first=320, count=2, file=str(recorded))
    qtbot.waitUntil(lambda: _after_gap(window), timeout=PATIENCE_MS)
    window.close()


def test_a_window_opened_after_the_end_shows_the_whole_test(
    recorded: Path, engine: Any, qtbot: Any, qapp: Any
) -> None:
    window = MainWindow(EngineConnection(engine.client), ShownTest(), DARK)
    qtbot.addWidget(window)
    window.show()
    engine.say(count=0, curves=False, file=str(recorded), committed=300, state=RunState.STOPPED)

    def complete() -> bool:
        window.tick()
        return len(window._test.data.rows) == 300

    qtbot.waitUntil(complete, timeout=PATIENCE_MS)
    assert window.tabs.panels["result"].isVisible()
    window.tabs.setCurrentIndex(0)
    window.draw_now()
    shown = window.tabs.panels["overview"].shown
    assert shown is not None
    assert shown.measured_revolution == shown.model_revolution == 300
    window.close()


def _after_gap(window: MainWindow) -> bool:
    window.tick()
    revolutions = window._test.data.rows.revolutions
    return window.settled and revolutions[-1] == 321.0


def test_a_history_that_cannot_be_read_is_said(
    engine: Any, qtbot: Any, qapp: Any, tmp_path: Path
) -> None:
    now = [0.0]
    window = MainWindow(EngineConnection(engine.client), ShownTest(clock=lambda: now[0]), DARK)
    qtbot.addWidget(window)
    window.show()

    def said() -> bool:
        now[0] += 0.5
        if not engine.snapshots:
            engine.say(first=301, count=2, file=str(tmp_path / "gone.h5"))
        window.tick()
        return "Earlier cycles cannot be shown" in window.controls.answer.whole

    qtbot.waitUntil(said, timeout=PATIENCE_MS)
    assert window.header.state.value.whole == "Running"
    assert window.header.state._look == (Level.NORMAL, False)
    window.close()
