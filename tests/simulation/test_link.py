"""Endpoints and wires: overrun policy, hosts that come and go, cable pull and other faults."""

from __future__ import annotations

import os
import select
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
import serial

from rigapp.simulation.wire.endpoints import Endpoint, SocketEndpoint
from rigapp.simulation.wire.link import OutputQueue, SimulatedWire, WireFault
from rigapp.simulation.wire.pty import PtyEndpoint


def wait_for(condition: Callable[[], bool], what: str, deadline_s: float = 60.0) -> None:
    end = time.monotonic() + deadline_s
    while not condition():
        assert time.monotonic() < end, f"waited {deadline_s} s for {what}"
        time.sleep(0.002)


@pytest.fixture(params=["pty", "socket"])
def endpoint(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Endpoint]:
    made: Endpoint = PtyEndpoint(tmp_path / "daq") if request.param == "pty" else SocketEndpoint()
    yield made
    made.close()


def opened(endpoint: Endpoint) -> serial.SerialBase:
    return serial.serial_for_url(endpoint.url, timeout=60.0)


def heard_by(endpoint: Endpoint, count: int) -> bytes:
    heard = bytearray()

    def hear() -> bool:
        heard.extend(endpoint.read())
        return len(heard) >= count

    wait_for(hear, f"{count} bytes from the host")
    return bytes(heard)


def test_host_opens_talks_closes_and_opens_again(endpoint: Endpoint) -> None:
    url = endpoint.url
    assert not endpoint.connected()
    for turn in range(5):
        with opened(endpoint) as host:
            wait_for(endpoint.connected, "the host")
            said = bytes(range(256)) + bytes([turn])
            host.write(said)
            assert heard_by(endpoint, len(said)) == said
            assert endpoint.write(said) == len(said)
            assert host.read(len(said)) == said
        wait_for(lambda: endpoint.read() == b"" and not endpoint.connected(), "the host's going")
        assert endpoint.url == url


def test_last_words_of_a_host_are_heard(endpoint: Endpoint) -> None:
    host = opened(endpoint)
    wait_for(endpoint.connected, "the host")
    host.write(b"drive off")
    host.close()
    assert heard_by(endpoint, 9) == b"drive off"


def test_next_host_does_not_get_what_the_last_one_left(tmp_path: Path) -> None:
    endpoint = PtyEndpoint(tmp_path / "daq")
    first = os.open(endpoint.url, os.O_RDWR | os.O_NOCTTY)
    assert endpoint.connected()
    while endpoint.write(b"old" * 1000):
        pass
    os.close(first)
    assert not endpoint.connected()
    second = os.open(endpoint.url, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    assert endpoint.connected()
    endpoint.write(b"new")
    assert select.select([second], [], [], 60.0)[0]
    assert os.read(second, 100) == b"new"
    os.close(second)
    endpoint.close()


def test_gauge_sees_what_the_host_has_not_read_and_that_it_goes(tmp_path: Path) -> None:
    endpoint = PtyEndpoint(tmp_path / "daq")
    assert endpoint.unread() == 0
    host = opened(endpoint)
    assert endpoint.connected()
    endpoint.write(b"x" * 1000)
    wait_for(lambda: endpoint.unread() == 1000, "the bytes to wait in the pty")
    host.read(600)
    assert endpoint.unread() == 400
    host.close()
    wait_for(lambda: not endpoint.connected(), "the host's going to be noticed")
    endpoint.close()


def test_pulled_cable_breaks_the_connection_and_comes_back_under_the_same_name(
    endpoint: Endpoint,
) -> None:
    host = opened(endpoint)
    wait_for(endpoint.connected, "the host")
    endpoint.pull()
    with pytest.raises(serial.SerialException):
        host.read(10)
    host.close()
    with pytest.raises(serial.SerialException):
        opened(endpoint)
    assert not endpoint.connected()
    assert endpoint.write(b"x") == 0
    endpoint.restore()
    with opened(endpoint):
        wait_for(endpoint.connected, "the host to come again")


def test_queue_drops_the_oldest_data_whole_and_keeps_answers() -> None:
    queue = OutputQueue(limit=100)
    assert queue.push(b"a" * 40, 0.0, True)
    assert queue.push(b"R" * 20, 0.0, False)
    assert queue.push(b"b" * 40, 0.0, True)
    queue.sent(10)
    assert not queue.push(b"c" * 40, 0.0, True)
    sent = b""
    while head := queue.head(0.0):
        sent += bytes(head)
        queue.sent(len(head))
    # The half-sent a goes on, the answer stays, b is the oldest whole delivery of data.
    assert sent == b"a" * 30 + b"R" * 20 + b"c" * 40
    assert queue.bytes == 0


def test_wire_tells_of_an_overrun_only_when_the_host_does_not_read(tmp_path: Path) -> None:
    wire = SimulatedWire(PtyEndpoint(tmp_path / "daq"), limit=2000)
    frame = b"f" * 100
    frames = 4000  # far more than the system holds for a host that reads late
    assert wire.send(frame, 0.0, droppable=True)
    assert wire.waiting() == 0, "without a host nothing waits"
    host = os.open(wire.endpoint.url, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    kept = [wire.send(frame, 0.0, droppable=True) for _ in range(frames)]
    assert kept[0]
    assert not kept[-1]
    assert wire.dropped == kept.count(False) > 0
    assert wire.waiting() <= 2000
    got = 0

    def read() -> bool:
        nonlocal got
        while select.select([host], [], [], 0.0)[0]:
            got += len(os.read(host, 65536))
            wire.flush(0.0)
        return got >= 100 * (frames - wire.dropped)

    wait_for(read, "all that was kept")
    assert got == 100 * (frames - wire.dropped)
    os.close(host)
    wire.close()


Talk = tuple[SimulatedWire, Callable[[float, int], bytes]]


@pytest.fixture
def talk(tmp_path: Path) -> Iterator[Talk]:
    """Yield a wire and what hears: ``hear(now_s, count)`` returns so many bytes, none is more."""
    wire = SimulatedWire(PtyEndpoint(tmp_path / "daq"), seed=3)
    host = os.open(wire.endpoint.url, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)

    def hear(now_s: float, count: int) -> bytes:
        heard = b""

        def listen() -> bool:
            nonlocal heard
            wire.flush(now_s)
            if select.select([host], [], [], 0.0)[0]:
                heard += os.read(host, 65536)
            return len(heard) >= count

        wait_for(listen, f"{count} bytes from the wire")
        assert not select.select([host], [], [], 0.01)[0], "more than was meant to come"
        return heard

    yield wire, hear
    os.close(host)
    wire.close()


def test_garbage_and_truncation_spoil_the_bytes_in_a_repeatable_way(talk: Talk) -> None:
    wire, hear = talk
    wire.start_fault(WireFault.GARBAGE, 5)
    wire.send(b"12345678", 0.0, droppable=True)
    spoilt = hear(0.0, 13)
    assert len(spoilt) == 13
    assert spoilt.endswith(b"12345678")
    wire.stop_fault(WireFault.GARBAGE)
    wire.start_fault(WireFault.TRUNCATED, 3)
    wire.send(b"12345678", 0.0, droppable=True)
    cut = hear(0.0, 5)
    assert len(cut) == 5
    assert set(cut) <= set(b"12345678")
    wire.send(b"123", 0.0, droppable=True)
    assert hear(0.0, 0) == b""
    wire.stop_fault(WireFault.TRUNCATED)
    wire.send(b"whole", 0.0, droppable=True)
    assert hear(0.0, 5) == b"whole"


def test_split_sends_a_piece_a_pass_and_slow_waits(talk: Talk) -> None:
    wire, hear = talk
    wire.start_fault(WireFault.SPLIT, 3)
    wire.send(b"12345678", 0.0, droppable=True)
    assert wire.waiting() == 5
    assert hear(0.0, 8) == b"12345678"
    wire.stop_fault(WireFault.SPLIT)
    wire.start_fault(WireFault.SLOW, 0.5)
    wire.send(b"late", 10.0, droppable=False)
    assert hear(10.4, 0) == b""
    assert hear(10.49, 0) == b""
    assert hear(10.6, 4) == b"late"


def test_hanging_device_hears_and_says_nothing(talk: Talk) -> None:
    wire, hear = talk
    host = os.open(wire.endpoint.url, os.O_RDWR | os.O_NOCTTY)
    wire.start_fault(WireFault.HANG)
    os.write(host, b"hello")
    wire.send(b"x", 0.0, droppable=True)
    assert hear(0.0, 0) == b""
    assert wire.receive() == b""
    wire.stop_fault(WireFault.HANG)
    os.write(host, b"again")
    heard = b""

    def listen() -> bool:
        nonlocal heard
        heard += wire.receive()
        return b"again" in heard

    wait_for(listen, "the device to hear again")
    os.close(host)
