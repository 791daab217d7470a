"""Requests that no viewer of ours sends: whatever comes, it is answered and Stop works after it."""

from __future__ import annotations

import itertools
import math
import os
import random
import socket
import threading
import time
from collections.abc import Iterator
from contextlib import closing, suppress
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import msgspec
import psutil
import pytest
import zmq
from patience import PATIENCE_S
from stories import NEVER_OVER, RIG, recipe, until

from rigapp.config.loading import read_rig
from rigapp.schema.messages import NOTE_CHARACTERS, Event, Reply, Request, RunState
from rigapp.schema.states import ACTIVE, ENDED
from rigapp.schema.verbs import VERBS, Priority
from rigapp.schema.wire import decode
from rigapp.service.bounds import MESSAGE_BYTES
from rigapp.service.client import Client, EngineUnreachable
from rigapp.service.host import EngineHost
from rigapp.service.registry import running_engines
from rigapp.service.server import LOOKS, Connections

BATCH = 40
SAFETY_VERBS = {name for name, verb in VERBS.items() if verb.lane is Priority.SAFETY}
GROWTH_BYTES = 100_000_000
NOT_SENT = frozenset({"shutdown", "inject_fault", "hand"})
"""Verbs that may end the engine or break the simulated rig, as they should."""


@pytest.fixture
def host(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[EngineHost]:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    monkeypatch.setattr("rigapp.service.server.GROWTH_BYTES", GROWTH_BYTES)
    host = EngineHost(read_rig(RIG), 1.0)
    yield host
    host.close()


@pytest.fixture
def client(host: EngineHost) -> Iterator[Client]:
    client = Client(running_engines()[-1], "Ada", look=False)
    yield client
    client.close()


class Stranger:
    """A viewer that sends bytes of its own making."""

    def __init__(self, client: Client) -> None:
        self._context = zmq.Context()
        self._socket = self._context.socket(zmq.DEALER)
        self._socket.setsockopt(zmq.LINGER, 0)
        self._socket.connect(client.entry.commands)

    def send(self, *bodies: bytes) -> list[Reply]:
        """Send messages and return the reply to each, in the order in which they come."""
        for body in bodies:
            self._socket.send_multipart([b"", body])
        return [self._receive() for _ in bodies]

    def _receive(self) -> Reply:
        assert self._socket.poll(60_000), "a message was not answered"
        return decode(self._socket.recv_multipart()[-1], Reply)

    def __enter__(self) -> Stranger:
        return self

    def __exit__(self, *_: object) -> None:
        self._context.destroy(linger=0)


def packed(verb: str, **arguments: Any) -> bytes:
    return msgspec.msgpack.encode(Request(verb, arguments, "Ada", client="c"))


HEAD = b"\x82\xa4verb\xa4note\xa9arguments\x81\xa4text"
BAD = {
    "text that is not UTF-8": b"\x81\xa4verb\xa4\xff\xfe\xff\xfe",
    "key that is not UTF-8": b"\x81\xa4\xff\xfe\xff\xfe\xc0",
    "2,000 deep": HEAD + b"\x91" * 2000 + b"\xc0",
    "60,000 deep": HEAD + b"\x91" * 60_000 + b"\xc0",
    "as deep as can be decoded": HEAD + b"\x91" * 900 + b"\xc0",
    "array of 4 billion": HEAD + b"\xdd\xff\xff\xff\xff",
    "map of 4 billion": HEAD + b"\xdf\xff\xff\xff\xff",
    "time out of range": HEAD + b"\xc7\x0c\xff" + b"\xff" * 12,
    "unknown extension": HEAD + b"\xd4\x2a\x00",
    "key that cannot be one": b"\x82\xa4verb\xa4note\xa9arguments\x81\x91\xc0\xc0",
    "not a map": b"\x93\x01\x02\x03",
    "nothing": b"",
    "number for a text": HEAD + b"\x07",
    "verb without end": b"\x81\xa4verb\xda\xea\x60" + b"v" * 60_000,
}


@pytest.mark.parametrize("body", BAD.values(), ids=BAD.keys())
def test_what_cannot_be_read_is_answered_and_survived(
    host: EngineHost, client: Client, body: bytes
) -> None:
    with Stranger(client) as stranger:
        (reply,) = stranger.send(body)
    assert not reply.ok
    assert reply.sentence.endswith(".")
    assert len(reply.sentence) < 3000
    assert "not possible while idle" in client.request("stop").sentence
    assert host._server.failure is None


def test_verbs_of_the_table_are_those_of_the_engine(host: EngineHost) -> None:
    assert set(host.handle.__self__._verbs) == set(VERBS)
    assert {"stop", "drive_off", "acknowledge", "reset"} == SAFETY_VERBS


def test_starts_that_hang_on_a_pipe_keep_nothing_that_makes_safe_waiting(
    host: EngineHost, client: Client, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rigapp.config.reading.PATIENCE_S", 300.0)
    pipe = tmp_path / "test.toml"
    os.mkfifo(pipe)
    replies: list[Reply] = []
    arguments = {"test": str(pipe), "out": str(tmp_path / "out.h5")}
    threads = [
        threading.Thread(
            target=lambda: replies.append(client.request("start", arguments, 120.0)), daemon=True
        )
        for _ in range(18)
    ]
    for thread in threads:
        thread.start()
    until(lambda: len(replies) == 2, "the requests beyond sixteen are told busy")
    assert all("busy" in reply.sentence for reply in replies)
    for verb in SAFETY_VERBS:
        assert "busy" not in client.request(verb, timeout_s=30.0).sentence
    assert client.request("status").ok
    assert len(replies) == 2
    until(lambda: end_pipe(pipe) and len(replies) == 18, "the pipe has ended and all are answered")


def end_pipe(pipe: Path) -> bool:
    """Write nothing into a pipe, so that whoever reads it has read all of it."""
    with suppress(OSError):  # nobody reads it any more
        os.close(os.open(pipe, os.O_WRONLY | os.O_NONBLOCK))
    return True


def test_a_pipe_into_which_nobody_writes_is_refused_in_time(
    client: Client, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rigapp.config.reading.PATIENCE_S", 0.1)
    pipe = tmp_path / "test.toml"
    os.mkfifo(pipe)
    out = str(tmp_path / "out.h5")
    reply = client.request("start", {"test": str(pipe), "out": out}, 60.0)
    assert "test.toml: is a pipe without data" in reply.sentence
    for device, words in (("/dev/zero", "is a device"), (str(tmp_path), "cannot be read")):
        reply = client.request("start", {"test": device, "out": out}, 60.0)
        assert words in reply.sentence
    huge = tmp_path / "huge.toml"
    with huge.open("wb") as file:
        file.truncate(1 << 34)
    reply = client.request("start", {"test": str(huge), "out": out}, 60.0)
    assert "huge.toml: is larger than" in reply.sentence
    assert "folder" in client.request("resume_file", {"file": str(tmp_path)}).sentence
    assert "empty" in client.request("examine_file", {"file": "/dev/zero"}).sentence


def test_a_note_has_a_bounded_length(client: Client) -> None:
    assert client.request("note", {"text": "n" * NOTE_CHARACTERS}).ok
    reply = client.request("note", {"text": "n" * (NOTE_CHARACTERS + 1)})
    assert reply.sentence == "The note has 2,001 characters; shorten it to 2,000."
    reply = client.request("extend", {"revolutions": 5, "reason": "r" * 2001})
    assert reply.sentence == "The reason has 2,001 characters; shorten it to 2,000."
    assert "not a text" in client.request("note", {"text": 7}).sentence
    deep: Any = 0
    for _ in range(100):
        deep = [deep]
    assert "what: expected a list" in client.request("zero", {"what": 7}).sentence
    assert "not usable" in client.request("hand", {"what": "x", "details": {"y": deep}}).sentence


NO_NUMBER_OF_REVOLUTIONS = (True, 5.5, 5.0, float("nan"), 0, 10**12, "7", "7\n[junk]")


@pytest.mark.long
def test_a_number_of_revolutions_that_is_none_is_refused(client: Client, tmp_path: Path) -> None:
    test, out = recipe(tmp_path, NEVER_OVER, twin=False), tmp_path / "out.h5"
    start = {"test": str(test), "out": str(out)}
    for bad in NO_NUMBER_OF_REVOLUTIONS:
        reply = client.request("start", start | {"revolutions": bad}, 120.0)
        assert reply.sentence.startswith("run.revolutions = "), bad
    assert not out.exists()
    assert client.request("start", start, 120.0).ok
    for bad in NO_NUMBER_OF_REVOLUTIONS:
        reply = client.request("extend", {"revolutions": bad})
        assert reply.sentence.startswith("run.revolutions = "), bad
    assert client.request("stop").ok


def test_what_a_request_lacks_or_has_of_another_kind_is_named(client: Client) -> None:
    assert client.request("note").sentence == "'note' needs 'text'."
    shelve = {"key": "overload", "reason": "known"}
    for bad in (True, "7", float("nan"), 1e300, [1.0], None):
        for verb, arguments in (
            ("shelve", shelve | {"minutes": bad}),
            ("signals", {"window_s": bad}),
        ):
            assert "is not a number" in client.request(verb, arguments).sentence, (verb, bad)


def test_a_message_of_megabytes_reaches_nobody(client: Client) -> None:
    with pytest.raises(EngineUnreachable):
        client.request("note", {"text": "n" * 10_000_000}, 0.3)
    with pytest.raises(EngineUnreachable):
        client.request("note", {"text": "n" * MESSAGE_BYTES}, 0.3)
    assert "not possible while idle" in client.request("stop").sentence


def test_stop_with_too_long_a_reason_is_obeyed(client: Client) -> None:
    reply = client.request("stop", {"reason": "r" * 60_000, "other": [[[]]]})
    assert "not possible while idle" in reply.sentence


def wire(*parts: bytes, more: bool = False) -> bytes:
    """Return the bytes of a message; more: without its end."""
    last = len(parts) - 1
    return b"".join(
        bytes([3 if more or number < last else 2]) + len(part).to_bytes(8, "big") + part
        for number, part in enumerate(parts)
    )


class RawPeer:
    """Speak ZMTP 3.0 over a Unix socket, so that nothing of what is sent is kept here."""

    def __init__(self, address: str, kind: bytes) -> None:
        self._socket = socket.socket(socket.AF_UNIX)
        self._socket.settimeout(PATIENCE_S)
        self._socket.connect(address.removeprefix("ipc://"))
        greeting = b"\xff" + bytes(8) + b"\x7f\x03\x00" + b"NULL".ljust(20, b"\x00") + bytes(32)
        ready = b"\x05READY\x0bSocket-Type" + len(kind).to_bytes(4, "big") + kind
        try:
            self._socket.sendall(greeting + bytes([4, len(ready)]) + ready)
        except OSError:
            self.close()
            raise
        # What comes before the engine's own READY is taken for a part of the handshake. A peer of
        # another kind than a viewer gets none.
        answer = b""
        with suppress(ConnectionError):
            while b"READY" not in answer and (part := self._socket.recv(4096)):
                answer += part

    def send(self, body: bytes) -> bool:
        """Send a message; False once the engine has ended the connection."""
        return self.send_wire(wire(body))

    def send_wire(self, data: bytes) -> bool:
        """Send bytes as they are; False once the engine has ended the connection."""
        try:
            self._socket.sendall(data)
        except OSError:
            return False
        return True

    def close(self) -> None:
        self._socket.close()


@pytest.mark.parametrize(
    ("kind", "size", "count"),
    [(b"SUB", 50_000, 200), (b"SUB", 900, 100_000), (b"DEALER", 50_000, 200)],
)
def test_subscriptions_to_topics_take_no_memory(
    client: Client, kind: bytes, size: int, count: int
) -> None:
    memory = psutil.Process().memory_info
    before = memory().rss
    with closing(RawPeer(client.entry.snapshots, kind)) as peer:
        topics = (b"\x01" + os.urandom(size) for _ in range(count))
        assert not all(peer.send(topic) for topic in topics), "the connection was not ended"
        assert client.request("status").ok
        assert memory().rss - before < 30_000_000


@pytest.mark.long
def test_100000_messages_to_the_stream_are_ignored(host: EngineHost, client: Client) -> None:
    chance, memory = random.Random(22), psutil.Process().memory_info
    with closing(RawPeer(client.entry.snapshots, b"DEALER")) as peer:
        before = memory().rss
        for number in range(100_000):
            body = chance.randbytes(chance.choice((1, 1, 2, 8, 100)))
            assert peer.send(body), number
        assert not host.watched
        assert client.request("status").ok
        assert memory().rss - before < 30_000_000


@pytest.mark.sampled
@pytest.mark.parametrize(
    ("where", "size"), [(one, n) for one in ("commands", "snapshots") for n in (0, 900)]
)
def test_a_message_that_is_never_finished_ends_its_connection(
    client: Client, where: str, size: int
) -> None:
    memory = psutil.Process().memory_info
    before = largest = memory().rss
    lot = wire(*[bytes(size)] * 1000, more=True)
    lots = 8 * GROWTH_BYTES // (1000 * (size + 64))  # libzmq takes 64 bytes for an empty part
    for _ in range(3):
        with closing(RawPeer(getattr(client.entry, where), b"DEALER")) as peer:
            sent = 0
            while sent < lots and peer.send_wire(lot):
                sent += 1
                largest = max(largest, memory().rss)
            assert sent < lots, "the connection was not ended"
        began = time.monotonic()
        assert "not possible while idle" in client.request("stop").sentence
        assert time.monotonic() - began < 1.0
    assert largest - before < 2.5 * GROWTH_BYTES


def test_a_viewer_that_sends_nothing_keeps_what_it_gets_when_another_takes_memory(
    host: EngineHost, client: Client
) -> None:
    with closing(Client(client.entry, "Bea")) as viewer:
        until(lambda: viewer.poll() is not None, "snapshots come")
        connections = host._server._connections
        until(lambda: connections._usual < math.inf, "the memory was looked at")
        connections._usual -= 2 * GROWTH_BYTES  # as if the engine had grown
        until(lambda: connections._usual > 0, "a growth of its own is borne")
        assert client.request("status").ok
        while viewer.poll() is not None:
            pass
        until(lambda: viewer.poll() is not None, "snapshots come again")


class Grown:
    """Connections of a process whose memory is what a test says."""

    def __init__(self, address: str, router: zmq.Socket[bytes]) -> None:
        self.address, self.used = address, SimpleNamespace(rss=10 * GROWTH_BYTES)
        self.connections = Connections([router])
        self.connections._usual = self.used.rss
        router.bind(address)

    def accepted(self, count: int, now_s: float) -> bool:
        """Bound the memory; return whether ``count`` connections are left."""
        self.connections.bound_memory(now_s, busy=False)
        return len(self.connections._accepted_s) == count


@pytest.fixture
def grown(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Grown]:
    monkeypatch.setattr("rigapp.service.server.GROWTH_BYTES", GROWTH_BYTES)
    context = zmq.Context()
    with context.socket(zmq.ROUTER) as router:
        grown = Grown(f"ipc://{tmp_path}/commands", router)
        process = SimpleNamespace(memory_info=lambda: grown.used)
        monkeypatch.setattr(grown.connections, "_process", process)
        yield grown
    context.destroy(linger=0)


def test_a_request_sent_while_memory_is_being_freed_is_not_ended(
    grown: Grown, monkeypatch: pytest.MonkeyPatch
) -> None:
    sending: set[int] = set()
    monkeypatch.setattr("rigapp.service.server._sends", lambda handle: handle in sending)
    with closing(RawPeer(grown.address, b"DEALER")) as silent:
        until(lambda: grown.accepted(1, 1.0), "the first connection is known")
        sender = RawPeer(grown.address, b"DEALER")
        until(lambda: grown.accepted(2, 1.0), "the second connection is known")
        sending.add(max(grown.connections._accepted_s))
        grown.used.rss = 13 * GROWTH_BYTES
        until(lambda: grown.accepted(1, 2.0), "the one that sends is ended")
        sending.clear()
        assert grown.accepted(1, 2.9), "nobody is ended while memory is being freed"
        with closing(RawPeer(grown.address, b"DEALER")) as viewer:
            until(lambda: grown.accepted(2, 2.9), "a viewer sends a request")
            until(lambda: grown.accepted(1, 3.5), "the connection from before the growth is ended")
            assert not silent._socket.recv(1), "the silent one"
            assert grown.accepted(1, 4.0), "the viewer keeps its connection"
            assert grown.accepted(1, 5.0), "the viewer keeps its connection"
            usual = grown.connections._usual
            assert usual == grown.used.rss, "none of the connections holds the memory"
            assert viewer.send(b"")
        sender.close()


@pytest.mark.parametrize(("every", "ended"), [(1, True), (4, True), (LOOKS, False)])
def test_a_program_that_sends_more_slowly_than_it_is_read_is_found(
    grown: Grown, monkeypatch: pytest.MonkeyPatch, every: int, ended: bool
) -> None:
    """every: looks of which one finds unread data; a request is found by one of them all."""
    looks = itertools.count(1)
    monkeypatch.setattr("rigapp.service.server._sends", lambda handle: next(looks) % every == 0)
    with closing(RawPeer(grown.address, b"DEALER")) as peer:
        until(lambda: grown.accepted(1, 0.0), "the connection is known")
        grown.used.rss += 2 * GROWTH_BYTES
        grown.connections.bound_memory(1.0, busy=False)
        assert peer.send(b"") is not ended


def test_a_message_of_many_parts_ends_its_connection(client: Client) -> None:
    with closing(RawPeer(client.entry.commands, b"DEALER")) as peer:
        parts = wire(*[b""] * 100_000)
        until(lambda: not peer.send_wire(parts), "the connection is ended")
    assert client.request("status").ok


def test_notes_of_one_client_do_not_fill_the_log(tmp_path: Path) -> None:
    from rigapp.schema.channels import BASE
    from rigapp.schema.columns import prediction_columns
    from rigapp.storage import FilePlan, TestMetadata, create_test, open_test

    plan = FilePlan(
        revolutions=10,
        cycles=1,
        samples_per_cycle=10,
        events=400,
        revolution_columns=BASE.revolution_columns[:2],
        cycle_columns=BASE.cycle_columns[:2],
        prediction_columns=prediction_columns()[:2],
        prediction_points=4,
    )
    writer = create_test(tmp_path / "t.h5", plan, TestMetadata("t", "rig", "test"))
    kept = 0
    while writer.append_event(Event(1.0, 1, "note", "Eve", f"note {kept}")):
        kept += 1
    assert kept == 200
    assert not writer.append_event(Event(1.0, 1, "alarm", "Eve", "shelved"))
    for number in range(100):
        assert writer.append_event(Event(2.0, 2, "alarm", "engine", f"alarm {number}"))
    writer.finish("stopped", "operator", "done")
    writer.close()
    with open_test(tmp_path / "t.h5") as reader:
        assert reader.first_altered_event() is None
        assert sum(event.kind == "alarm" for event in reader.events()) == 100


# ------------------------------------------------------------------------------------ mutated bytes


def honest_messages(folder: Path) -> list[bytes]:
    """Return one well-formed message of each verb that may be sent here."""
    words: dict[str, Any] = {
        "test": str(folder / "none.toml"), "out": str(folder / "none.h5"), "file": "none.h5",
        "reason": "worn", "text": "oiled", "key": "overload", "name": "overload_N",
        "value": 300.0, "revolutions": 40, "minutes": 1.0, "window_s": 0.5, "kind": "none",
        "what": ["load_cell"], "force": True,
    }  # fmt: skip
    return [packed(verb, **words) for verb in sorted(set(VERBS) - NOT_SENT)]


def mutated(message: bytes, chance: random.Random) -> bytes:
    """Return a message with a few bytes changed, left out, doubled or added."""
    data = bytearray(message)
    for _ in range(chance.choice((1, 1, 2, 4, 16))):
        place = chance.randrange(len(data) + 1)
        kind = chance.randrange(5)
        if kind == 0:
            data[place : place + 1] = bytes([chance.randrange(256)])
        elif kind == 1:
            del data[place : place + chance.choice((1, 2, 8))]
        elif kind == 2:
            data[place:place] = chance.randbytes(chance.choice((1, 4, 32)))
        elif kind == 3:
            data[place:place] = data[place : place + chance.randrange(64)]
        else:
            data[place:place] = bytes([chance.choice(b"\x91\x81\xdc\xdd\xdf\xc1\xd9\xc7\xcb")]) * 8
    return bytes(data)


def send_mutated(
    host: EngineHost, client: Client, folder: Path, seed: int, thousands: int, size: int
) -> None:
    """Send thousands of mutated messages; after each lot a test is started, and stopped."""
    chance = random.Random(seed)
    honest = honest_messages(folder)
    test = recipe(folder, 5000, twin=False)
    for lot in range(thousands):
        with Stranger(client) as stranger:
            for _ in range(size // BATCH):
                lot_of = [mutated(chance.choice(honest), chance) for _ in range(BATCH)]
                assert len(stranger.send(*lot_of)) == BATCH
        start_and_stop(host, client, test, folder / f"{lot}.h5")
        assert host._server.failure is None


def mutated_wire(honest: list[bytes], chance: random.Random) -> bytes:
    """Return messages as a peer sends them: mutated, with parts cut, doubled, too large, too many.

    Mostly the frames hold, so that what is in them is read; else their bytes are mutated too.
    """
    parts = [b"", mutated(chance.choice(honest), chance)]
    kind = chance.randrange(8)
    if kind == 0:
        parts *= chance.choice((2, 5, 50))
    elif kind == 1:
        parts[chance.randrange(2)] = chance.randbytes(chance.choice((1, 1000, MESSAGE_BYTES + 1)))
    elif kind == 2:
        parts = [chance.choice(parts) for _ in range(chance.randrange(1, 12))]
    elif kind == 3:
        parts[1] = parts[1][: chance.randrange(len(parts[1]) + 1)]
    data = wire(*parts, more=chance.randrange(100) == 0)
    return mutated(data, chance) if chance.randrange(50) == 0 else data


def send_mutated_wire(host: EngineHost, client: Client, folder: Path, seed: int, size: int) -> None:
    """Send mutated messages to both sockets; meanwhile Stop is answered, and memory stays flat."""
    chance, memory = random.Random(seed), psutil.Process().memory_info
    honest, before, slowest_s, sent = honest_messages(folder), memory().rss, 0.0, 0
    while sent < size:
        where = chance.choice((client.entry.commands, client.entry.snapshots))
        with suppress(ConnectionError), closing(RawPeer(where, b"DEALER")) as peer:
            while sent < size and peer.send_wire(mutated_wire(honest, chance)):
                sent += 1
                if sent % 200 == 0:
                    began = time.monotonic()
                    assert client.request("stop").sentence
                    slowest_s = max(slowest_s, time.monotonic() - began)
                    break
    grown = memory().rss - before
    print(f"{sent} messages: {grown / 1e6:.1f} MB more, the slowest Stop took {slowest_s:.3f} s")
    assert slowest_s < 1.0
    assert grown < 50_000_000
    assert host._server.failure is None


def start_and_stop(host: EngineHost, client: Client, test: Path, out: Path) -> None:
    """Bring a rig, in whatever state it was left, to a running test, and stop that by request."""
    assert client.request("take_command", {"force": True}).ok
    if host.engine.state in ACTIVE:
        stop(host, client)

    def started() -> bool:
        for verb in ("connect", "acknowledge", "reset"):
            client.request(verb, {}, 60.0)
        return client.request("start", {"test": str(test), "out": str(out)}, 60.0).ok

    # A computer that is late loses the simulated drive now and then: it is connected again.
    until(started, "a test starts")
    stop(host, client)
    assert client.request("release_command").ok
    out.unlink()


def stop(host: EngineHost, client: Client) -> None:
    reply = client.request("stop", {"reason": "enough"})
    assert reply.ok or host.engine.state not in ACTIVE, reply.sentence
    assert host.engine.wait(ENDED | {RunState.READY}, 60.0) not in ACTIVE


@pytest.mark.long
def test_mutated_messages_are_survived(host: EngineHost, client: Client, tmp_path: Path) -> None:
    send_mutated(host, client, tmp_path, seed=14, thousands=1, size=1000)


@pytest.mark.long
def test_mutated_bytes_of_both_sockets_are_survived(
    host: EngineHost, client: Client, tmp_path: Path
) -> None:
    send_mutated_wire(host, client, tmp_path, seed=30, size=2000)


@pytest.mark.soak
@pytest.mark.timeout(7200)
def test_100000_mutated_messages_as_bytes_are_survived(
    host: EngineHost, client: Client, tmp_path: Path
) -> None:
    seed = int(os.environ.get("RIGAPP_SEED", str(time.time_ns() % 2**32)))
    print(f"seed {seed}: RIGAPP_SEED={seed} sends the same messages again")
    send_mutated_wire(host, client, tmp_path, seed, size=100_000)


@pytest.mark.soak
@pytest.mark.timeout(7200)
def test_110000_mutated_messages_are_survived(
    host: EngineHost, client: Client, tmp_path: Path
) -> None:
    seed = int(os.environ.get("RIGAPP_SEED", str(time.time_ns() % 2**32)))
    print(f"seed {seed}: RIGAPP_SEED={seed} sends the same messages again")
    send_mutated(host, client, tmp_path, seed, thousands=110, size=1000)
