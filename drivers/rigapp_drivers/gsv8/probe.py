"""Ask carefully whether a GSV-8 is on a port: two reads, between measured values if it streams."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from rigapp.texts import say
from rigapp_drivers.api import (
    BytePort,
    Identity,
    Probe,
    ProtocolError,
    ReplyTimeout,
    SettingRefused,
)
from rigapp_drivers.gsv8 import protocol as p
from rigapp_drivers.gsv8.link import Link
from rigapp_drivers.gsv8.protocol import Command, u8

_NO_CHANGE: Final = 0  # of the transmission; the checksum of measured values is off until set


def ask(line: BytePort, timeout_s: float) -> Identity | None:
    """Return who answers the read of the firmware's version; the stream goes on as it was."""
    link = Link(line, timeout_s)
    try:
        version = link.command(Command.FIRMWARE_VERSION, reply=4, tries=1)
        reply = link.command(Command.GET_INTERFACE, u8(_NO_CHANGE), reply=4, tries=1)
        number = link.command(Command.GET_SERIAL_NUMBER, reply=4, tries=1)
    except (ReplyTimeout, ProtocolError, SettingRefused):
        return None
    interface = p.decode_interface(reply)
    known = interface.model == p.MODEL_GSV8
    model = "GSV-8" if known else say("GSV, model {}", f"{interface.model:02X}")
    details = {} if known else {"note": say("rigapp has no driver for this model")}
    return identity_of(model, p.decode_version(version), number, line.port, details)


def identity_of(
    model: str, firmware: tuple[int, int], number: bytes, port: str, details: Mapping[str, str]
) -> Identity:
    """Return who answers; number: the data of the serial number."""
    serial = f"{int.from_bytes(number, 'big'):08d}"
    return Identity("ME-Systeme", model, p.version_words(firmware), serial, port, details)


PROBE: Final = Probe(ask, (115200, 460800, 230400, 57600, 38400, 19200))
