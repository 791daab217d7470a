"""Resolve the port of a rig file: a path or URL, ``serial:NUMBER`` or ``wire:FILE``.

``serial:NUMBER`` is the port of the USB device with that serial number, independent of the port
name assigned by the system; ``wire:FILE`` is a recorded line.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any, Final

import serial
from serial.tools import list_ports

from rigapp.texts import SentenceError, joined, say
from rigapp_drivers.wire.protocol_wire import SCHEME

BY_NUMBER: Final = "serial:"
RECORDED: Final = "wire:"
BY_ID: Final = Path("/dev/serial/by-id")

if "rigapp_drivers.wire" not in serial.protocol_handler_packages:
    serial.protocol_handler_packages.append("rigapp_drivers.wire")


class PortNotFound(SentenceError, LookupError):
    """No port, or more than one, has the requested USB serial number."""


def actual_port(port: str) -> str:
    """Return the port as pyserial opens it; raise PortNotFound."""
    if port.startswith(RECORDED) and not port.startswith(SCHEME):
        return SCHEME + port.removeprefix(RECORDED)
    if port.startswith(BY_NUMBER):
        return port_of_number(port.removeprefix(BY_NUMBER), list_ports.comports())
    return port


def beside(folder: Path, port: str) -> str:
    """Return a port with the path of its recording resolved relative to the rig file's folder."""
    recorded = port.startswith(RECORDED) and not port.startswith(SCHEME)
    return f"{RECORDED}{folder / port.removeprefix(RECORDED)}" if recorded else port


def port_of_number(number: str, found: Iterable[Any]) -> str:
    """Return the port of the USB device with a serial number; raise PortNotFound.

    found: ports as pyserial lists them.
    """
    ports = list(found)
    wanted = number.strip().casefold()
    fits = [port.device for port in ports if (port.serial_number or "").casefold() == wanted]
    if len(fits) == 1:
        return str(fits[0])
    if fits:
        raise PortNotFound(
            "{} ports have the USB serial number {} ({}); name the port itself.",
            len(fits),
            number,
            joined(", ", fits),
        )
    known = joined(
        ", ", (f"{port.serial_number} ({port.device})" for port in ports if port.serial_number)
    )
    raise PortNotFound(
        "no port has the USB serial number {}; there are: {}. Check the cable.",
        number,
        known or say("none"),
    )


def stable_name(port: str, folder: Path = BY_ID) -> str:
    """Return the port's name that is independent of the USB socket, "" if there is none."""
    try:
        names = sorted(folder.iterdir())
    except OSError:
        return ""
    real = os.path.realpath(port)
    return next((str(name) for name in names if os.path.realpath(name) == real), "")
