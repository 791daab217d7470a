"""The service: replies, time-outs, busy, versions, snapshots merged for a slow viewer."""

from __future__ import annotations

import select
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from patience import PATIENCE_S
from snapshots import make_status

from rigapp.engine.publish import Publisher
from rigapp.process.stale_files import process_alive
from rigapp.schema.channels import BASE
from rigapp.schema.messages import (
    PROTOCOL_VERSION,
    EngineStatus,
    Reply,
    Request,
    RigStatus,
    RunState,
    Snapshot,
    Status,
    TestStatus,
    as_array,
)
from rigapp.schema.verbs import Priority
from rigapp.schema.wire import decode
from rigapp.service.client import Client, EngineUnreachable
from rigapp.service.registry import (
    EngineEntry,
    announce,
    running_engines,
    withdraw,
)
from rigapp.service.server import EARLY_PERIOD_S, UNDER_WAY, Server, Wake, _RateLimit


def status(revolution: int = 0) -> Status:
    return Status.of_flat(
        {
            "state": RunState.IDLE,
            "reason": "",
            "rig": "rig",
            "test": "",
            "file": "",
            "revolution": revolution,
            "planned": 0,
            "committed": 0,
            "first_revolution": 1,
            "target_rpm": 0.0,
            "speed_rpm": 0.0,
            "started_at": 0.0,
            "expected_end_at": 0.0,
            "data_age_s": 0.0,
            "host_time": 0.0,
            "simulated": True,
            "simulated_speed": 1.0,
            "worst_margin_percent": 100.0,
            "worst_margin": "",
            "twin_revolution": 0,
            "twin_age_s": 0.0,
            "residual_rms_N": 0.0,
        }
    )


PENDING = UNDER_WAY[Priority.WORK]
COLUMNS = len(BASE.revolution_columns)


class Rows:
    """A source of snapshots that carries one row each."""

    def __init__(self) -> None:
        self.count = 0

    def __call__(self) -> Snapshot:
        row = np.full(COLUMNS, float(self.count))
        snapshot = Snapshot(
            status=status(self.count), first_row=self.count, rows=row.tobytes(), predictions=b""
        )
        self.count += 1
        return snapshot


class Handler:
    """Answer "wait" when released, everything else at once."""

    def __init__(self) -> None:
        self.release = threading.Event()

    def __call__(self, request: Request) -> Reply:
        if request.verb == "wait":
            self.release.wait(PATIENCE_S)
        if request.verb == "break":
            raise ValueError("a handler's own mistake")
        return Reply(ok=True, result={"verb": request.verb, **request.arguments})


@pytest.fixture
def handler() -> Iterator[Handler]:
    handler = Handler()
    yield handler
    handler.release.set()


@pytest.fixture
def server(tmp_path: Path, handler: Handler) -> Iterator[Server]:
    server = Server(handler, Rows(), f"ipc://{tmp_path}/c", f"ipc://{tmp_path}/s")
    server.start()
    yield server
    handler.release.set()
    server.close()
    assert not server.alive
    assert server.failure is None


@pytest.fixture
def client(server: Server) -> Iterator[Client]:
    client = Client(EngineEntry(1, server.commands, server.stream, "rig.toml", 0.0))
    yield client
    client.close()


def until(condition: object, seconds: float = PATIENCE_S) -> None:
    deadline = time.monotonic() + seconds
    while not condition():  # type: ignore[operator]
        assert time.monotonic() < deadline, "the condition did not come true in time"
        time.sleep(0.005)


def test_the_status_of_an_engine_of_before_is_understood(tmp_path: Path, handler: Handler) -> None:
    """Protocol 3 had all fields of a status beside each other."""
    shown = Status.of_flat(status(7).flat() | {"file": "t.h5", "in_command": "Ada"})
    old = {"status": shown.tree(), "first_row": 0, "rows": b"", "predictions": b""}
    source: Any = lambda: old  # noqa: E731
    server = Server(handler, source, f"ipc://{tmp_path}/c", f"ipc://{tmp_path}/s")
    server.start()
    client = Client(EngineEntry(1, server.commands, server.stream, "rig.toml", 0.0, version=3))
    try:
        seen: list[Status] = []
        until(lambda: seen.extend(one.status for one in [client.poll()] if one) or seen)
        assert seen[0] == shown
        assert "version 4" in client.request("status").sentence
    finally:
        client.close()
        server.close()


@pytest.mark.parametrize("changes", [{}, {"test": "Long"}, {"drive": None, "alarms": ()}])
def test_a_status_is_the_same_after_its_flat_form(changes: dict[str, Any]) -> None:
    shown = make_status(**changes)
    assert Status.of_flat(shown.flat()) == Status.of_tree(shown.tree()) == shown
    idle = Status(EngineStatus(RunState.IDLE))
    assert Status.of_tree(idle.tree()) == idle
    assert idle.test is None
    parts = (EngineStatus, TestStatus, RigStatus)
    names = [name for part in parts for name in part.__struct_fields__]
    assert len(idle.flat()) == len(names) + 2, "two parts have a name of the answer alike"


def test_request_is_answered_with_its_arguments(client: Client) -> None:
    reply = client.request("note", {"text": "oiled"})
    assert reply.ok
    assert reply.result == {"verb": "note", "text": "oiled"}


def test_slow_request_does_not_delay_another(client: Client, handler: Handler) -> None:
    slow = threading.Thread(target=client.request, args=("wait", {}, PATIENCE_S))
    slow.start()
    assert client.request("stop").ok
    handler.release.set()
    slow.join(PATIENCE_S)
    assert not slow.is_alive()


def test_too_many_requests_are_told_busy(client: Client, handler: Handler) -> None:
    replies: list[Reply] = []
    threads = [
        threading.Thread(target=lambda: replies.append(client.request("wait", {}, PATIENCE_S)))
        for _ in range(PENDING + 3)
    ]
    for thread in threads:
        thread.start()
    until(lambda: len(replies) >= 3)
    handler.release.set()
    for thread in threads:
        thread.join(PATIENCE_S)
    assert sum("busy" in reply.sentence for reply in replies) == 3
    assert sum(reply.ok for reply in replies) == PENDING


def test_mistake_of_a_handler_is_a_sentence(client: Client) -> None:
    reply = client.request("break")
    assert not reply.ok
    assert "a handler's own mistake" in reply.sentence


def test_other_version_is_refused(client: Client, monkeypatch: pytest.MonkeyPatch) -> None:
    request = Request(verb="status", version=PROTOCOL_VERSION + 1)
    monkeypatch.setattr("rigapp.service.client.Request", lambda **_: request)
    reply = client.request("status")
    assert not reply.ok
    assert "version" in reply.sentence


def test_absent_engine_is_named_with_the_time_waited(tmp_path: Path) -> None:
    client = Client(EngineEntry(4711, f"ipc://{tmp_path}/n", f"ipc://{tmp_path}/m", "r", 0.0))
    with pytest.raises(EngineUnreachable, match="4711"):
        client.request("status", timeout_s=0.2)
    client.close()


def test_rows_of_several_snapshots_come_in_one_piece(client: Client) -> None:
    until(lambda: client.poll() is not None)
    rows: list[float] = []
    first: list[int] = []

    def enough() -> bool:
        snapshot = client.poll()
        if snapshot is not None:
            values = as_array(snapshot.rows, "<f8")[::COLUMNS]
            first.append(snapshot.first_row)
            assert values[0] == snapshot.first_row
            rows.extend(values)
        return len(rows) > 8

    until(enough)
    assert np.all(np.diff(rows) == 1.0)


@given(st.lists(st.tuples(st.booleans(), st.integers(0, 3), st.booleans()), max_size=40))
def test_rows_are_never_joined_over_a_gap(parts: list[tuple[bool, int, bool]]) -> None:
    """Snapshots of 0 to 3 rows, some of them lost on the way, some of another file."""
    place, file, sent = 0, 0, []
    for lost, count, other in parts:
        if other:
            place, file = 0, file + 1
        rows = np.repeat(np.arange(place, place + count, dtype=float), COLUMNS)
        shown = Status.of_flat(status(place).flat() | {"file": str(file)})
        if not lost:
            sent.append(Snapshot(shown, place, rows.tobytes(), predictions=b""))
        place += count
    client = object.__new__(Client)
    client._closed, client._held = False, None
    waiting = list(sent)
    client._receive = lambda: waiting.pop(0) if waiting else None  # type: ignore[method-assign]
    seen: list[tuple[str, float]] = []
    while (snapshot := client.poll()) is not None:
        values = as_array(snapshot.rows, "<f8")[::COLUMNS]
        assert np.array_equal(values, snapshot.first_row + np.arange(len(values)))
        seen += [(snapshot.status.test.file, value) for value in values]
    assert seen == [
        (one.status.test.file, value)
        for one in sent
        for value in as_array(one.rows, "<f8")[::COLUMNS]
    ]


def test_source_that_fails_is_told_once_and_commands_go_on(tmp_path: Path) -> None:
    told: list[str] = []

    def broken() -> Snapshot:
        raise ValueError("a mistake of the source")

    server = Server(
        Handler(), broken, f"ipc://{tmp_path}/c", f"ipc://{tmp_path}/s", on_failure=told.append
    )
    server.start()
    client = Client(EngineEntry(1, server.commands, server.stream, "rig.toml", 0.0))
    try:
        until(lambda: told)
        assert client.request("stop").ok
        assert client.request("stop").ok
        assert told == [
            "No snapshot could be made for windows ‹ValueError('a mistake of the source')›."
        ]
    finally:
        client.close()
        server.close()


def test_a_revolution_and_its_prediction_are_sent_at_once_but_not_every_one_of_a_fast_rig() -> None:
    haste = _RateLimit(EARLY_PERIOD_S)
    moments = (0.0, 0.015, 0.03, 0.099, 0.101, 0.102, 0.116, 1.0)
    assert [haste.allowed(one) for one in moments] == [
        True, True, False, False, True, False, True, True
    ]  # fmt: skip


def test_news_and_replies_do_not_wait_for_the_next_period(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rigapp.service.server.PUBLISH_PERIOD_S", 3600.0)
    monkeypatch.setattr("rigapp.service.server.MEMORY_PERIOD_S", 3600.0)
    subscription = Publisher({"x": "N"}).subscribe()

    def handler(request: Request) -> Reply:
        time.sleep(0.05)  # the serving thread waits for its sockets meanwhile
        return Reply(ok=True)

    server = Server(
        handler,
        lambda: subscription.take(lambda: status(1)),
        f"ipc://{tmp_path}/c",
        f"ipc://{tmp_path}/s",
        waits=lambda: subscription.waits,
    )
    subscription.on_news = server.wake
    server.start()
    client = Client(EngineEntry(1, server.commands, server.stream, "rig.toml", 0.0))
    try:
        until(lambda: client.poll() is None and server.watched)
        assert client.request("stop", timeout_s=PATIENCE_S).ok
        for index in range(3):
            subscription.add_row(np.array([float(index)]), index, lambda: None)
            assert select.select([client.handle], [], [], PATIENCE_S)[0], "nothing was sent"
            got: list[Snapshot] = []
            until(lambda got=got: got.extend(one for one in [client.poll()] if one) or got)
            assert got[0].first_row == index
            until(lambda: not subscription.waits)
            time.sleep(EARLY_PERIOD_S)
    finally:
        client.close()
        server.close()


def test_a_wake_up_is_not_lost_and_does_not_block_when_nobody_waits() -> None:
    wake = Wake()
    for _ in range(100_000):
        wake.set()
    assert select.select([wake], [], [], 0.0)[0]
    wake.clear()
    assert not select.select([wake], [], [], 0.0)[0]
    wake.set()
    assert select.select([wake], [], [], 0.0)[0]
    wake.close()
    wake.set()


def test_first_and_last_viewer_are_told(tmp_path: Path) -> None:
    seen: list[bool] = []
    server = Server(
        Handler(), Rows(), f"ipc://{tmp_path}/c", f"ipc://{tmp_path}/s", on_viewers=seen.append
    )
    server.start()
    try:
        clients = [
            Client(EngineEntry(1, server.commands, server.stream, "rig.toml", 0.0))
            for _ in range(2)
        ]
        until(lambda: all(client.poll() is not None for client in clients))
        for client in clients:
            client.close()
        until(lambda: not server.watched)
        assert seen == [True, False]
    finally:
        server.close()


def test_unreadable_request_is_answered(server: Server) -> None:
    import zmq

    context = zmq.Context()
    socket = context.socket(zmq.REQ)
    socket.setsockopt(zmq.LINGER, 0)
    socket.connect(server.commands)
    socket.send(b"\xc1 garbage")
    assert socket.poll(5000)
    assert not decode(socket.recv(), Reply).ok
    context.destroy(linger=0)


def test_registry_lists_the_living_and_forgets_the_dead(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import os
    import subprocess

    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path))
    ended = subprocess.Popen(["true"])
    ended.wait()
    announce(EngineEntry(os.getpid(), "ipc://a", "ipc://b", "here.toml", 1.0))
    announce(EngineEntry(ended.pid, "ipc://c", "ipc://d", "gone.toml", 2.0))
    assert [entry.rig for entry in running_engines()] == ["here.toml"]
    assert not (tmp_path / f"engine-{ended.pid}.json").exists()
    withdraw(os.getpid())
    assert running_engines() == []
    assert process_alive(os.getpid())


def test_server_knows_whether_anyone_looks(server: Server) -> None:
    assert not server.watched
    viewer = Client(EngineEntry(1, server.commands, server.stream, "rig.toml", 0.0))
    until(lambda: viewer.poll() is not None)
    assert server.watched
    viewer.close()
    until(lambda: not server.watched)
