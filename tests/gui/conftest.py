"""A scripted engine for the window: no process, no file, every snapshot made by hand."""

from __future__ import annotations

import os

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("QT_LOGGING_RULES", "qt.qpa.*=false")

import gc
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec
import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import QCoreApplication, QEvent, Qt
from PySide6.QtWidgets import QComboBox, QWidget
from snapshots import (
    ALARM,
    make_snapshot,
    make_status,
    write_recorded,
)

from rigapp.config.loading import read_rig
from rigapp.gui.look.dress import apply_theme
from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import LIGHT
from rigapp.process.memory import collect_when_due, stop_automatic_collection
from rigapp.schema.messages import (
    Alarm,
    Remedy,
    Reply,
    RunState,
    Snapshot,
    Status,
)
from rigapp.service.client import Client
from rigapp.service.host import EngineHost
from rigapp.service.launch import find_engine
from rigapp.viewer import knownwear
from rigapp.viewer.connection import EngineConnection
from rigapp.viewer.recording import StoredTest
from rigapp.viewer.series import LiveData
from rigapp.viewer.showntest import ShownTest


@pytest.fixture(autouse=True)
def _collected_between_tests() -> Iterator[None]:
    """Collect garbage after a test only, as the window does between events."""
    thresholds = gc.get_threshold()
    stop_automatic_collection()
    yield
    gc.set_threshold(*thresholds)
    collect_when_due()


class ScriptedEngine:
    """Answer requests as told and hand out the snapshots that a test puts in."""

    def __init__(self) -> None:
        self.snapshots: list[Snapshot] = []
        self.requests: list[tuple[str, dict[str, Any]]] = []
        self.reply = Reply(ok=True)
        self.dead = False
        self.keeps_talking = False
        self.refuses_clients = False
        self.clients = 0
        self.answering = threading.Event()
        self.answering.set()

    def client(self) -> ScriptedClient:
        """Make a client, as the window's factory."""
        if self.refuses_clients:
            raise ConnectionError("no engine is running")
        self.clients += 1
        return ScriptedClient(self)

    def say(self, **arguments: Any) -> None:
        """Send one snapshot."""
        self.snapshots.append(make_snapshot(**arguments))

    @property
    def verbs(self) -> list[str]:
        """Return the verbs asked for so far."""
        return [verb for verb, _ in self.requests]


class ScriptedClient:
    """One connection to the scripted engine."""

    def __init__(self, engine: ScriptedEngine) -> None:
        self._engine = engine
        self.operator = ""
        self.closed = False
        self._last: Snapshot | None = None

    def poll(self) -> Snapshot | None:
        """Return the next snapshot, or the last once more if the engine keeps talking.

        Fails when the engine is dead.
        """
        if self._engine.dead:
            raise ConnectionError("the engine closed the connection")
        if self._engine.snapshots:
            self._last = self._engine.snapshots.pop(0)
            return self._last
        return self._last if self._engine.keeps_talking else None

    def request(
        self, verb: str, arguments: dict[str, Any] | None = None, timeout_s: float = 5.0
    ) -> Reply:
        """Note the request and answer as told."""
        if not self._engine.answering.wait(timeout_s):
            raise TimeoutError(f"no answer to {verb} within {timeout_s:g} s")
        self._engine.requests.append((verb, dict(arguments or {})))
        return self._engine.reply

    def close(self) -> None:
        """Note that the window let go."""
        self.closed = True


@pytest.fixture
def engine() -> ScriptedEngine:
    """Return a scripted engine."""
    return ScriptedEngine()


@pytest.fixture(name="make_status")
def make_status_fixture() -> Callable[..., Status]:
    """Return the maker of statuses."""
    return make_status


@pytest.fixture(name="make_snapshot")
def make_snapshot_fixture() -> Callable[..., Snapshot]:
    """Return the maker of snapshots."""
    return make_snapshot


@pytest.fixture
def alarm() -> Alarm:
    """Return a warning that nobody has acknowledged."""
    return ALARM


@pytest.fixture
def no_history() -> Callable[[Path, int], StoredTest]:
    """Return a loader that finds an empty file."""
    return lambda path, planned: StoredTest(LiveData(planned), None)


@pytest.fixture(scope="session")
def light_application(qapp: Any) -> Any:
    """Return the application in its light dress."""
    apply_theme(qapp, LIGHT)
    return qapp


@pytest.fixture(autouse=True)
def _destroyed_at_once() -> Iterator[None]:
    """Destroy the widgets of the test before the next one, as an application would."""
    yield
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete.value)


@pytest.fixture(autouse=True)
def _wear_is_not_computed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Start no ``rigapp identify`` beside each window: it takes seconds, and nobody looks."""

    def refused(arguments: list[str]) -> str:
        raise OSError(f"{arguments[0]}: not computed here")

    monkeypatch.setattr(knownwear.known_wear, "__defaults__", (refused,))


@pytest.fixture
def window(
    engine: ScriptedEngine, qtbot: Any, light_application: Any, tmp_path: Path, no_history: Any
) -> Iterator[MainWindow]:
    """Return the window on a scripted engine; the test ticks it by hand."""
    window = MainWindow(
        EngineConnection(engine.client),
        ShownTest(no_history),
        LIGHT,
        tests=[Path("examples/quick.toml"), Path("examples/paper.toml")],
        results_folder=tmp_path,
    )
    qtbot.addWidget(window)
    window.resize(1400, 900)
    window.show()
    yield window
    window.close()


@pytest.fixture
def attach(window: MainWindow, engine: ScriptedEngine, qtbot: Any) -> Callable[[], None]:
    """Return a function that ticks until the window has taken every snapshot."""

    def ticks() -> None:
        def taken() -> bool:
            window.tick()
            return engine.clients > 0 and not engine.snapshots

        qtbot.waitUntil(taken, timeout=PATIENCE_MS)
        window.draw_now()

    return ticks


@pytest.fixture
def recorded(tmp_path: Path) -> Path:
    """Return a finished test file of 300 revolutions, every tenth whole cycle kept."""
    path = tmp_path / "quick-20270101-080000.h5"
    write_recorded(path)
    return path


class Operator:
    """Hands and eyes at the window of a real engine in this process."""

    def __init__(self, window: MainWindow, host: EngineHost, qtbot: Any) -> None:
        self.window, self.host, self._qtbot = window, host, qtbot

    def see(self, condition: Callable[[], object]) -> None:
        """Wait until something is seen; fail with what is there in its place."""
        try:
            self._qtbot.waitUntil(lambda: bool(condition()), timeout=PATIENCE_MS)
        except self._qtbot.TimeoutError as error:
            answer, told = self.window.controls.answer.text(), self.status
            now = (told.engine, told.recovery, told.alarms) if told else ()
            raise AssertionError(f"{error}; answer {answer!r}, told {now}") from error

    def sees_state(self, *states: RunState) -> None:
        """Wait until the engine tells one of some states."""
        self.see(lambda: self.status is not None and self.status.engine.state in states)

    def sees_step(self, step: Remedy) -> None:
        """Wait until a remedy is the next one."""
        panel = self.window.recover
        self.see(lambda: panel.steps[step].text().startswith("▶") and panel.button.isEnabled())

    @property
    def status(self) -> Any:
        """Return what the engine told last."""
        return self.window._connection.status

    def click(self, widget: QWidget) -> None:
        """Click a widget as soon as it can be clicked."""
        self.see(lambda: widget.isVisible() and widget.isEnabled())
        self._qtbot.mouseClick(widget, Qt.MouseButton.LeftButton)

    def choose(self, box: QComboBox, text: str) -> None:
        """Choose an item of a box as soon as it is offered."""
        self.see(lambda: box.findText(text) >= 0)
        box.setCurrentIndex(box.findText(text))

    def press(self, key: Qt.Key) -> None:
        """Press a key in the window."""
        self.window.activateWindow()
        self._qtbot.keyClick(self.window, key)

    def start_test(self) -> None:
        """Connect, start the test that is offered, and wait for its first revolutions."""
        self.host.connect()
        self.sees_state(RunState.READY)
        self.press(Qt.Key.Key_F5)
        self.click(self.window.start_bar.go)
        self.see(lambda: self.status.test is not None and self.status.test.committed >= 5)


@pytest.fixture
def operate(
    qtbot: Any, light_application: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Callable[[Path, Path], Any]:
    """Return a context that opens the window on a real engine, for a rig file and a test file."""
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))

    @contextmanager
    def opened(rig: Path, test: Path) -> Iterator[Operator]:
        def factory() -> Client:
            entry = find_engine(rig)
            assert entry is not None
            return Client(entry, "E. Sample")

        document = read_rig(rig)
        # Nothing here is about the watchdog: window and engines share one interpreter, and a busy
        # computer may be late by more than 0.5 s.
        spindle = msgspec.structs.replace(document.record.spindle, watchdog_timeout_s=20.0)
        record = msgspec.structs.replace(document.record, spindle=spindle)
        host = EngineHost(replace(document, record=record), 20.0)
        window = MainWindow(
            EngineConnection(factory),
            ShownTest(),
            LIGHT,
            rig=rig,
            tests=[test],
            results_folder=tmp_path,
        )
        qtbot.addWidget(window)
        window.show()
        window.start()
        try:
            yield Operator(window, host, qtbot)
        finally:
            window._discard = True
            window._leave()
            host.close()

    return opened
