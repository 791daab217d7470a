"""The line to the engine: attach, silence, loss, attach again, requests."""

from __future__ import annotations

import socket
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import QCoreApplication
from PySide6.QtWidgets import QWidget

from rigapp.gui.window.rhythm import IDLE, IN_TEST, Pulse
from rigapp.gui.window.watchdog import Watchdog
from rigapp.schema.messages import Reply, RunState
from rigapp.viewer.connection import (
    FIRST_SNAPSHOT_S,
    LOST_AFTER_S,
    SILENT_AFTER_S,
    ConnectionState,
    EngineConnection,
)


class Clock:
    """A clock that a test moves."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def connection(engine: Any, clock: Clock) -> Iterator[EngineConnection]:
    connection = EngineConnection(engine.client, clock)
    yield connection
    connection.close()


@pytest.fixture
def pump_until(
    connection: EngineConnection, clock: Clock, qtbot: Any
) -> Callable[[Callable[[], bool]], None]:
    def until(condition: Callable[[], bool]) -> None:
        def step() -> bool:
            clock.now += 0.05
            connection.pump()
            return condition()

        qtbot.waitUntil(step, timeout=PATIENCE_MS)

    return until


def test_attached_means_that_the_engine_has_spoken(
    connection: EngineConnection, engine: Any, pump_until: Any
) -> None:
    assert connection.state is ConnectionState.ATTACHING
    assert connection.data_age_s() is None
    pump_until(lambda: engine.clients == 1)
    assert connection.state is ConnectionState.ATTACHING
    engine.say(count=3)
    pump_until(lambda: connection.state is ConnectionState.ATTACHED)
    assert connection.status is not None


def test_silence_shows_and_data_age_grows(
    connection: EngineConnection, engine: Any, clock: Clock, pump_until: Any
) -> None:
    engine.say(count=3)
    pump_until(lambda: connection.state is ConnectionState.ATTACHED)
    before = connection.data_age_s()
    assert before is not None
    clock.now += SILENT_AFTER_S + 0.1
    connection.pump()
    assert connection.state is ConnectionState.SILENT
    age = connection.data_age_s()
    assert age is not None
    assert age >= before + SILENT_AFTER_S
    engine.say(first=4, count=1)
    connection.pump()
    assert connection.state is ConnectionState.ATTACHED


def test_a_lost_engine_is_attached_again(
    connection: EngineConnection, engine: Any, clock: Clock, pump_until: Any
) -> None:
    engine.say(count=3)
    pump_until(lambda: connection.state is ConnectionState.ATTACHED)
    clock.now += LOST_AFTER_S + 0.1
    connection.pump()
    assert connection.state is ConnectionState.LOST
    engine.refuses_clients = True
    pump_until(lambda: "no engine is running" in connection.reason)
    assert connection.state is ConnectionState.LOST
    engine.refuses_clients = False
    engine.say(first=4, count=1)
    pump_until(lambda: connection.state is ConnectionState.ATTACHED)
    assert engine.clients == 2


def test_a_broken_connection_is_loss_at_once(
    connection: EngineConnection, engine: Any, pump_until: Any
) -> None:
    engine.say(count=3)
    pump_until(lambda: connection.state is ConnectionState.ATTACHED)
    engine.dead = True
    connection.pump()
    assert connection.state is ConnectionState.LOST
    assert "closed the connection" in connection.reason


def test_a_client_that_never_speaks_is_given_up(
    connection: EngineConnection, engine: Any, clock: Clock, pump_until: Any
) -> None:
    pump_until(lambda: engine.clients == 1)
    clock.now += FIRST_SNAPSHOT_S + 1.0
    connection.pump()
    pump_until(lambda: engine.clients == 2)


def test_a_request_is_answered_through_pump(
    connection: EngineConnection, engine: Any, pump_until: Any
) -> None:
    pump_until(lambda: engine.clients == 1)
    engine.reply = Reply(ok=False, sentence="No test is running.")
    replies: list[Reply] = []
    pump_until(lambda: connection._client is not None)
    connection.request("resume", {}, replies.append)
    assert replies == []
    pump_until(lambda: bool(replies))
    assert replies[0].sentence == "No test is running."


def test_without_an_engine_a_request_is_refused_in_words(
    connection: EngineConnection, engine: Any
) -> None:
    replies: list[Reply] = []
    connection.request("stop", {"reason": "x"}, replies.append)
    assert not replies[0].ok
    assert "not reachable" in replies[0].sentence


def test_stop_does_not_wait_behind_a_slow_request(
    connection: EngineConnection, engine: Any, pump_until: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    pump_until(lambda: connection._client is not None)
    client = connection._client
    assert client is not None
    plain = client.request

    def slow(verb: str, arguments: dict[str, Any] | None = None, timeout_s: float = 5.0) -> Reply:
        if verb == "connect":
            engine.answering.wait(5.0)
            return Reply(ok=True)
        engine.answering.set()
        return plain(verb, arguments, timeout_s)

    engine.answering.clear()
    monkeypatch.setattr(client, "request", slow)
    replies: list[str] = []
    connection.request("connect", {}, lambda _: replies.append("connect"))
    connection.request("stop", {"reason": "x"}, lambda _: replies.append("stop"))
    pump_until(lambda: len(replies) == 2)
    assert engine.verbs == ["stop"]


def test_requests_are_refused_when_too_many_wait(
    connection: EngineConnection, engine: Any, pump_until: Any
) -> None:
    pump_until(lambda: connection._client is not None)
    engine.answering.clear()
    replies: list[Reply] = []
    for _ in range(30):
        connection.request("note", {"text": "x"}, replies.append)
    refused = [reply for reply in replies if "Too many" in reply.sentence]
    assert 10 <= len(refused) <= 14
    engine.answering.set()
    pump_until(lambda: len(replies) == 30)


def test_a_lost_client_is_closed_only_when_no_request_uses_it(
    connection: EngineConnection, engine: Any, clock: Clock, pump_until: Any
) -> None:
    engine.say(count=3)
    pump_until(lambda: connection.state is ConnectionState.ATTACHED)
    client: Any = connection._client
    engine.answering.clear()
    replies: list[Reply] = []
    connection.request("note", {"text": "x"}, replies.append)
    clock.now += LOST_AFTER_S + 0.1
    connection.pump()
    pump_until(lambda: engine.clients == 2)
    assert not client.closed
    engine.answering.set()
    pump_until(lambda: client.closed)
    assert len(replies) == 1


def test_the_window_looks_often_during_a_test_and_seldom_without_one(
    window: Any, engine: Any, attach: Any
) -> None:
    for state, rhythm in ((RunState.RUNNING, IN_TEST), (RunState.READY, IDLE)):
        engine.say(count=3, state=state)
        attach()
        assert window.pulse.rhythm == rhythm
        assert window.pulse.look.interval() == rhythm.look_ms


def test_news_of_a_running_test_is_taken_when_it_comes(qtbot: Any) -> None:
    here, there = socket.socketpair()
    other, other_there = socket.socketpair()
    taken: list[bytes] = []
    window = QWidget()
    qtbot.addWidget(window)
    with here, there, other, other_there:
        pulse = Pulse(lambda: taken.append(pulse_source.recv(10)), lambda: None, Watchdog(), window)
        pulse_source = here
        pulse.listen(here.fileno())
        there.send(b"1")
        qtbot.waitUntil(lambda: taken == [b"1"], timeout=PATIENCE_MS)

        pulse.keep(IDLE)  # the timer, which is not started here, would take it
        there.send(b"2")
        QCoreApplication.processEvents()
        assert taken == [b"1"]
        pulse.keep(IN_TEST)
        qtbot.waitUntil(lambda: taken == [b"1", b"2"], timeout=PATIENCE_MS)

        pulse_source = other  # another engine
        pulse.listen(other.fileno())
        there.send(b"3")
        other_there.send(b"4")
        qtbot.waitUntil(lambda: taken == [b"1", b"2", b"4"], timeout=PATIENCE_MS)
        pulse.stop()
        other_there.send(b"5")
        QCoreApplication.processEvents()
        assert len(taken) == 3
