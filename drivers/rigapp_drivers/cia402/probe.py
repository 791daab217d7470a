"""Find CANopen nodes by their heartbeats; nothing is sent before one is received.

On a serial port the version of an slcan adapter is read and the channel opened listen-only. Then
the objects of each detected node are read; none is written. A drive sends heartbeats only if
configured to (object 1017), and a boot-up message at power-on.
"""

from __future__ import annotations

import contextlib
import re
import struct
import time
from collections.abc import Iterable, Mapping
from typing import Any, Final

import can

from rigapp.texts import joined, say
from rigapp_drivers.api import BytePort, ConnectionFailed, DeviceError, Identity, Probe
from rigapp_drivers.cia402.protocol import (
    HEARTBEAT_BASE,
    PROFILE_VELOCITY_BIT,
    SDO_REPLY_BASE,
    SDO_REQUEST_BASE,
    NodeState,
)
from rigapp_drivers.cia402.slcan import Frame, decode_frame, encode_frame

_USUAL_RATES: Final[Mapping[int, str]] = {
    500_000: "S6",
    1_000_000: "S8",
    250_000: "S5",
    125_000: "S4",
}
_MOST_BYTES: Final = 65536
_LISTEN_S: Final = 0.6  # six periods of a usual heartbeat
_MOST_NODES: Final = 127
_MAX_PROBED: Final = 8
_ABORT: Final = 0x80
ABILITIES: Final[Mapping[tuple[int, int], str]] = {
    (0x6502, 0): say("profile velocity mode"),
    (0x1016, 1): say("monitor of this computer"),
    (0x6007, 0): say("reaction to its silence"),
    (0x60A9, 0): say("unit of speeds"),
    (0x607F, 0): say("highest speed"),
    (0x6083, 0): say("acceleration"),
    (0x6084, 0): say("deceleration"),
    (0x6078, 0): say("motor current"),
    (0x6077, 0): say("torque"),
    (0x6079, 0): say("supply voltage"),
}
"""Object -> optional function of a CiA 402 drive."""


def ask(line: BytePort, timeout_s: float) -> Identity | None:
    """Return the slcan adapter on a port, with the detected nodes in ``details["nodes"]``."""
    line.write(b"\rV\r")
    version = re.search(rb"V([0-9A-Fa-f]{4})\r", _until(line, rb"V[0-9A-Fa-f]{4}\r", timeout_s))
    if version is None:
        return None
    nodes: dict[int, int] = {}
    details: dict[str, str] = {}
    try:
        for rate, code in _USUAL_RATES.items():
            line.write(f"C\r{code}\rL\r".encode())
            nodes = _heartbeats(_until(line, None, _LISTEN_S).decode("ascii", "replace"))
            if nodes:
                details["bit_rate"] = str(rate)
                line.write(b"C\rO\r")
                for node in sorted(nodes)[:_MAX_PROBED]:
                    details |= _abilities(line, node, timeout_s)
                break
    finally:
        with contextlib.suppress(DeviceError):
            line.write(b"C\r")
    details = {"nodes": node_words(nodes), **details}
    return Identity(
        "", say("slcan CAN adapter"), version[1].decode("ascii"), "", line.port, details
    )


def _abilities(line: BytePort, node: int, timeout_s: float) -> dict[str, str]:
    """Return which optional functions a node has and lacks, by reading their objects."""
    abilities: dict[bool, list[str]] = {True: [], False: []}
    for (index, subindex), what in ABILITIES.items():
        value = _read(line, node, index, subindex, timeout_s)
        if value is None:
            return {f"node_{node}": say("does not answer")}
        has = value is not False and (index != 0x6502 or bool(value & PROFILE_VELOCITY_BIT))
        abilities[has].append(say("{} ‹{}›", what, f"{index:04X}"))
    words = {f"node_{node}_has": abilities[True], f"node_{node}_lacks": abilities[False]}
    return {key: joined(", ", objects) for key, objects in words.items() if objects}


def _read(line: BytePort, node: int, index: int, subindex: int, timeout_s: float) -> int | None:
    """Return the number of an object, False if it does not exist, None without a reply."""
    address = struct.pack("<HB", index, subindex)
    line.write(encode_frame(Frame(SDO_REQUEST_BASE + node, b"\x40" + address + bytes(4))))
    data, deadline = "", time.monotonic() + timeout_s
    while (left := deadline - time.monotonic()) > 0.0 and len(data) < _MOST_BYTES:
        data += line.read_some(_MOST_BYTES, left).decode("ascii", "replace")
        *lines, data = data.split("\r")
        for frame in filter(None, map(decode_frame, lines)):
            answer = frame.data
            if frame.identifier == SDO_REPLY_BASE + node and answer[1:4] == address:
                return answer[0] != _ABORT and int.from_bytes(answer[4:8], "little")
    return None


def listen(interface: str, channel: str, seconds: float = 1.0, **options: Any) -> dict[int, int]:
    """Return node id -> state of the nodes whose heartbeat is received on a CAN interface.

    interface: of python-can. Nothing is sent. Raises ConnectionFailed.
    """
    nodes: dict[int, int] = {}
    try:
        with can.Bus(interface=interface, channel=channel, **options) as bus:
            deadline = time.monotonic() + seconds
            while (left := deadline - time.monotonic()) > 0.0:
                message = bus.recv(left)
                if message is not None and not message.is_extended_id:
                    _note(nodes, message.arbitration_id, bytes(message.data))
    except Exception as error:  # each interface has its own exception classes
        raise ConnectionFailed(
            "CAN", channel, "the CAN interface {} cannot be listened to ‹{}›.", interface, error
        ) from error
    return nodes


def node_words(nodes: Mapping[int, int]) -> str:
    """Return the nodes and their states in words."""
    if not nodes:
        return say("no heartbeat received")
    return joined(", ", (say("node {} ({})", node, _state(nodes[node])) for node in sorted(nodes)))


def _state(state: int) -> str:
    try:
        return NodeState(state).name.lower().replace("_", "-")
    except ValueError:
        return say("state {}", state)


def _heartbeats(text: str) -> dict[int, int]:
    nodes: dict[int, int] = {}
    for line in text.split("\r"):
        frame = decode_frame(line)
        if frame is not None and not frame.extended and not frame.remote:
            _note(nodes, frame.identifier, frame.data)
    return nodes


def _note(nodes: dict[int, int], identifier: int, data: Iterable[int]) -> None:
    node, states = identifier - HEARTBEAT_BASE, list(data)
    if 1 <= node <= _MOST_NODES and len(states) == 1:
        nodes[node] = states[0] & 0x7F


def _until(line: BytePort, pattern: bytes | None, timeout_s: float) -> bytes:
    """Return the bytes received until a pattern, or until the time-out."""
    data = b""
    deadline = time.monotonic() + timeout_s
    while (left := deadline - time.monotonic()) > 0.0 and len(data) < _MOST_BYTES:
        data += line.read_some(_MOST_BYTES, left)
        if pattern is not None and re.search(pattern, data):
            break
    return data


PROBE: Final = Probe(ask)
