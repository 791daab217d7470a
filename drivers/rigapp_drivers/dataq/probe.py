"""Ask carefully whether a DATAQ instrument is on a port: ``info`` queries, nothing is set.

A scanning instrument answers to ``stop`` alone, which is not sent: it is known by its USB id.
"""

from __future__ import annotations

import re
from typing import Final

from rigapp.texts import say
from rigapp_drivers.api import BytePort, Identity, Probe, ProtocolError, ReplyTimeout
from rigapp_drivers.dataq.link import Link
from rigapp_drivers.dataq.protocol import Info

_REST_S: Final = 0.05  # by then the rest of another answer has come
_MOST_BYTES: Final = 4096
_SERIAL_DIGITS: Final = 8


def ask(port: BytePort, timeout_s: float) -> Identity | None:
    """Return who answers ``info 1`` with its echo and a model number."""
    port.write(b"\r")  # ends what another question left in the device's line
    port.read_some(_MOST_BYTES, min(timeout_s, _REST_S))
    link = Link(port, timeout_s, 0.0)
    try:
        model = link.query(Info.MODEL, tries=1)
        if not model.isalnum():
            return None
        firmware, serial = (link.query(one, tries=1) for one in (Info.FIRMWARE, Info.SERIAL_NUMBER))
    except (ReplyTimeout, ProtocolError):
        return None
    return identity_of(model, firmware, serial, port.port)


def identity_of(model: str, firmware: str, serial: str, port: str) -> Identity:
    """Return who answers, by what it says; its firmware's version comes as hundredths in hex."""
    if re.fullmatch(r"[0-9A-Fa-f]+", firmware):
        firmware = version_words(int(firmware, 16))
    return Identity(
        say("DATAQ Instruments"), f"DI-{model}", firmware, serial[:_SERIAL_DIGITS], port
    )


def version_words(hundredths: int) -> str:
    """Return a firmware version as the maker writes it."""
    return f"{hundredths // 100}.{hundredths % 100:02d}"


PROBE: Final = Probe(ask)
