"""Ask carefully whether a DATAQ instrument is on a port: ``info`` queries, nothing is set.

A scanning instrument answers to ``stop`` alone, which is not sent: it is known by its USB id.
"""

from __future__ import annotations

import re
import time
from typing import Final

from drivers.api import BytePort, Identity, Probe
from drivers.dataq.protocol import BadReply, Info, line, query_value, split_replies

_MOST_BYTES: Final = 4096
_SERIAL_DIGITS: Final = 8


def ask(port: BytePort, timeout_s: float) -> Identity | None:
    """Return who answers ``info 1`` with its echo and a model number."""
    port.write(b"\r")  # ends what another question left in the device's line
    port.read_some(_MOST_BYTES, min(timeout_s, 0.05))
    model = _query(port, Info.MODEL, timeout_s)
    if model is None or not model.isalnum():
        return None
    firmware = _query(port, Info.FIRMWARE, timeout_s) or ""
    return Identity(
        maker="DATAQ Instruments",
        model=f"DI-{model}",
        firmware=_version(firmware),
        serial_number=(_query(port, Info.SERIAL_NUMBER, timeout_s) or "")[:_SERIAL_DIGITS],
        port=port.port,
    )


def _version(text: str) -> str:
    """Return the firmware's version, which comes as hundredths in hexadecimal digits."""
    if re.fullmatch(r"[0-9A-Fa-f]+", text) is None:
        return text
    hundredths = int(text, 16)
    return f"{hundredths // 100}.{hundredths % 100:02d}"


def _query(port: BytePort, info: Info, timeout_s: float) -> str | None:
    command = line("info", info.value)
    port.write(command)
    rest = b""
    deadline = time.monotonic() + timeout_s
    while (left := deadline - time.monotonic()) > 0.0 and len(rest) < _MOST_BYTES:
        rest += port.read_some(_MOST_BYTES, left)
        lines, rest = split_replies(rest)
        for reply in lines:
            try:
                return query_value(command, reply)
            except BadReply:
                continue
    return None


PROBE: Final = Probe(ask)
