"""Look for CANopen nodes without a word on the bus: heartbeats are listened to, nothing is sent.

On a serial port an slcan adapter is asked for its version and opened listen-only. A drive says a
heartbeat only when it was told to (object 1017), and a boot-up message when its power comes.
"""

from __future__ import annotations

import contextlib
import re
import time
from collections.abc import Iterable, Mapping
from typing import Any, Final

import can

from rigapp_drivers.api import BytePort, ConnectionFailed, DeviceError, Identity, Probe
from rigapp_drivers.cia402.protocol import HEARTBEAT_BASE, NodeState
from rigapp_drivers.cia402.slcan import decode_frame

_USUAL_RATES: Final[Mapping[int, str]] = {
    500_000: "S6",
    1_000_000: "S8",
    250_000: "S5",
    125_000: "S4",
}
_MOST_BYTES: Final = 65536
_LISTEN_S: Final = 0.6  # six periods of a usual heartbeat
_MOST_NODES: Final = 127


def ask(line: BytePort, timeout_s: float) -> Identity | None:
    """Return the slcan adapter on a port, with the nodes heard in ``details["nodes"]``."""
    line.write(b"\rV\r")
    version = re.search(rb"V([0-9A-Fa-f]{4})\r", _until(line, rb"V[0-9A-Fa-f]{4}\r", timeout_s))
    if version is None:
        return None
    nodes: dict[int, int] = {}
    heard_at = 0
    try:
        for rate, code in _USUAL_RATES.items():
            line.write(f"C\r{code}\rL\r".encode())
            nodes = _heartbeats(_until(line, None, _LISTEN_S).decode("ascii", "replace"))
            if nodes:
                heard_at = rate
                break
    finally:
        with contextlib.suppress(DeviceError):
            line.write(b"C\r")
    details = {"nodes": node_words(nodes)}
    if heard_at:
        details["bit_rate"] = str(heard_at)
    return Identity("", "slcan CAN adapter", version[1].decode("ascii"), "", line.port, details)


def listen(interface: str, channel: str, seconds: float = 1.0, **options: Any) -> dict[int, int]:
    """Return node id -> state of the nodes whose heartbeat is heard on a CAN interface.

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
    except Exception as error:  # each interface has errors of its own
        raise ConnectionFailed(
            "CAN", channel, f"the CAN interface {interface} cannot be listened to ‹{error}›."
        ) from error
    return nodes


def node_words(nodes: Mapping[int, int]) -> str:
    """Return the nodes and their states in words."""
    if not nodes:
        return "no heartbeat heard"
    return ", ".join(f"node {node} ({_state(nodes[node])})" for node in sorted(nodes))


def _state(state: int) -> str:
    try:
        return NodeState(state).name.lower().replace("_", "-")
    except ValueError:
        return f"state {state}"


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
    """Return what comes until a pattern is there, or for the whole time."""
    data = b""
    deadline = time.monotonic() + timeout_s
    while (left := deadline - time.monotonic()) > 0.0 and len(data) < _MOST_BYTES:
        data += line.read_some(_MOST_BYTES, left)
        if pattern is not None and re.search(pattern, data):
            break
    return data


PROBE: Final = Probe(ask)
