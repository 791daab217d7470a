"""Probe a port for a RoboClaw by reading its firmware text; nothing is written."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from rigapp_drivers.api import BytePort, Identity, Probe
from rigapp_drivers.roboclaw.protocol import Command, Rejected, parse_version, read_packet

_ANSWER_S: Final = 0.1  # per address, of eight; a drive replies within 10 ms
_ADDRESSES: Final = range(0x80, 0x88)
_LONGEST: Final = 64
_QUIET_S: Final = 0.015  # longer than the drive's own time-out inside a packet


def ask(line: BytePort, timeout_s: float) -> Identity | None:
    """Return the identity of the first drive that replies at the addresses 128 to 135.

    Over USB the drive replies at any of them.
    """
    wait_s = min(timeout_s, _ANSWER_S)
    for address in _ADDRESSES:
        line.write(read_packet(address, Command.VERSION))
        text = parse_version(address, _answer(line, wait_s))
        if isinstance(text, Rejected) or not text.strip():
            continue
        return identity_of(text, line.port, address)
    return None


def identity_of(
    text: str, port: str, address: int, details: Mapping[str, str] | None = None
) -> Identity:
    """Return the identity from a firmware text: model, then version."""
    model, _, firmware = text.rpartition(" ")
    known = {"address": str(address), **(details or {})}
    return Identity("Basicmicro", model or text, firmware if model else "", "", port, known)


def _answer(line: BytePort, timeout_s: float) -> bytes:
    """Return the bytes received until the line is quiet."""
    data = part = line.read_some(_LONGEST, timeout_s)
    while part and len(data) < _LONGEST:
        part = line.read_some(_LONGEST, _QUIET_S)
        data += part
    return data


PROBE: Final = Probe(ask, (38400, 115200, 460800, 230400, 57600, 19200, 9600, 2400))
