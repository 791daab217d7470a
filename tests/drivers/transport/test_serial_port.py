"""The serial transport over ptys, sockets and loop://."""

from __future__ import annotations

import os
import select
import socket
import sys
import threading
import time
from collections.abc import Iterator
from typing import Any

import pytest

from rigapp_drivers import transport
from rigapp_drivers.api import BytePort, ConnectionFailed, DeviceLost
from rigapp_drivers.transport import SerialPort

PAYLOAD = bytes(range(256)) * 1024


def _echo(data: bytes, now_s: float) -> bytes:
    return data


def _silent(data: bytes, now_s: float) -> bytes:
    return b""


@pytest.fixture
def server() -> Iterator[socket.socket]:
    with socket.create_server(("127.0.0.1", 0)) as listener:
        listener.settimeout(60.0)
        yield listener


def _url(server: socket.socket) -> str:
    return f"socket://127.0.0.1:{server.getsockname()[1]}"


def _collect(port: BytePort, count: int) -> bytes:
    deadline = time.monotonic() + 60.0
    data = b""
    while len(data) < count and time.monotonic() < deadline:
        data += port.read_some(1 << 20, 0.1)
    return data


def _write_often(port: SerialPort) -> None:
    for _ in range(1000):
        port.write(PAYLOAD)


def test_pty_carries_every_byte_value_in_bulk(wire: Any) -> None:
    device = wire(_silent)
    port = SerialPort("daq", device.port, 115200)
    port.open()
    assert port.is_open
    sent = PAYLOAD[:60000]
    device.send(sent)
    assert _collect(port, len(sent)) == sent
    port.close()


def test_write_and_echo(wire: Any) -> None:
    port = SerialPort("daq", wire(_echo).port, 115200)
    port.open()
    port.write(b"\xaa\x90\r\n\x85")
    assert _collect(port, 5) == b"\xaa\x90\r\n\x85"
    port.close()


def test_maximum_is_kept_and_the_rest_stays(wire: Any) -> None:
    device = wire(_silent)
    port = SerialPort("daq", device.port, 115200)
    port.open()
    device.send(b"0123456789")
    first = port.read_some(4, 60.0)
    assert len(first) <= 4
    assert first + _collect(port, 10 - len(first)) == b"0123456789"
    port.close()


def test_nothing_comes_in_time(wire: Any) -> None:
    port = SerialPort("daq", wire(_silent).port, 115200)
    port.open()
    assert port.read_some(100, 0.01) == b""
    assert port.read_some(100, 0.0) == b""
    port.close()


def test_what_came_while_the_computer_held_the_reader_up_is_found(
    wire: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    device = wire(_silent)
    port = SerialPort("daq", device.port, 115200)
    port.open()
    real = transport._read_selectable

    def held_up(opened: Any, maximum: int, wait_s: float) -> bytes:
        data = real(opened, maximum, 0.0)
        if wait_s:  # found nothing, and was then held up for longer than its time-out
            device.send(b"late")
            assert select.select([opened.fileno()], [], [], 60.0)[0]
        return data

    monkeypatch.setattr(transport, "_read_selectable", held_up)
    assert port.read_some(100, 0.001) == b"late"
    port.close()


def test_drain_empties_the_line(wire: Any) -> None:
    device = wire(_silent)
    port = SerialPort("daq", device.port, 115200)
    port.open()
    device.send(PAYLOAD[:9000])
    first = port.read_some(1, 60.0)
    assert first + port.drain() == PAYLOAD[:9000]
    assert port.read_some(100, 0.0) == b""
    port.close()


def test_second_opening_is_refused_with_a_reason(wire: Any) -> None:
    device = wire(_silent)
    first = SerialPort("daq", device.port, 115200)
    first.open()
    first.open()
    with pytest.raises(ConnectionFailed, match="in use by another program") as caught:
        SerialPort("other", device.port, 115200).open()
    assert caught.value.device == "other"
    assert device.port in str(caught.value)
    if sys.platform == "linux":
        assert f"‹process {os.getpid()}›; close it" in str(caught.value)
    first.close()
    again = SerialPort("other", device.port, 115200)
    again.open()
    again.close()


@pytest.mark.parametrize(
    ("port", "words"),
    [
        ("/dev/ttyNOSUCH0", "no such port"),
        ("nosuchscheme://x", "check the port's name"),
        ("socket://127.0.0.1", "check host"),
    ],
)
def test_unusable_ports_are_explained(port: str, words: str) -> None:
    with pytest.raises(ConnectionFailed, match=words) as caught:
        SerialPort("daq", port, 115200).open()
    assert caught.value.__cause__ is not None
    assert str(caught.value).startswith(f"daq on {port}: ")


def test_refused_socket_is_explained(server: socket.socket) -> None:
    url = _url(server)
    server.close()
    with pytest.raises(ConnectionFailed, match="check host, port number"):
        SerialPort("daq", url, 115200).open()


def test_unplugging_while_reading_is_a_lost_device(wire: Any) -> None:
    device = wire(_silent)
    port = SerialPort("daq", device.port, 115200)
    port.open()
    puller = threading.Timer(0.05, device.unplug)
    puller.start()
    with pytest.raises(DeviceLost, match="check cable and power") as caught:
        port.read_some(100, 10.0)
    puller.join()
    assert caught.value.__cause__ is not None
    with pytest.raises(DeviceLost):
        port.write(b"x")
    port.close()
    port.close()
    assert not port.is_open


def test_use_before_opening_is_a_lost_device() -> None:
    port = SerialPort("daq", "/dev/null", 115200)
    with pytest.raises(DeviceLost, match="not open"):
        port.read_some(1, 0.0)
    with pytest.raises(DeviceLost, match="not open"):
        port.write(b"x")
    port.close()


def test_closing_from_another_thread_ends_a_waiting_read(wire: Any) -> None:
    port = SerialPort("daq", wire(_silent).port, 115200)
    port.open()
    closer = threading.Timer(0.05, port.close)
    closer.start()
    with pytest.raises(DeviceLost, match="was closed"):
        port.read_some(100, 30.0)
    closer.join(60.0)
    assert not closer.is_alive()


def test_write_time_out_when_nobody_takes_the_bytes(server: socket.socket) -> None:
    port = SerialPort("drive", _url(server), 115200, write_timeout_s=0.1)
    port.open()
    peer, _ = server.accept()
    with pytest.raises(DeviceLost, match="takes no more data"):
        _write_often(port)
    port.close()
    peer.close()


def test_socket_reads_in_bulk(server: socket.socket) -> None:
    port = SerialPort("daq", _url(server), 115200)
    port.open()
    peer, _ = server.accept()
    sender = threading.Thread(target=peer.sendall, args=(PAYLOAD,), name="peer")
    sender.start()
    reads = 0
    data = b""
    while len(data) < len(PAYLOAD):
        part = port.read_some(1 << 20, 5.0)
        assert part
        data += part
        reads += 1
    sender.join(60.0)
    assert data == PAYLOAD
    assert reads < len(PAYLOAD) // 100
    port.write(b"to the peer")
    assert peer.recv(100) == b"to the peer"
    peer.close()
    with pytest.raises(DeviceLost, match="connection broke"):
        port.read_some(100, 60.0)
    port.close()


def test_port_without_descriptor() -> None:
    port = SerialPort("daq", "loop://", 115200)
    port.open()
    assert port.read_some(100, 0.01) == b""
    port.write(b"round and round")
    assert port.read_some(5, 1.0) == b"round"
    assert port.drain() == b" and round"
    assert port.low_latency is False
    port.close()
