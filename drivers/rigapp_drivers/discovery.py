"""Identify the device on a serial port by its USB id and by safe probes.

A probe must neither move a motor nor change a setting. The shipped probes read versions only, and
their bytes have no meaning for the other devices in their packet modes. A motor controller in
simple serial mode, however, takes ANY byte as a speed. So a port that the user did not name is
probed only if it belongs to the USB device itself, never behind a UART adapter.
"""

from __future__ import annotations

import os
import re
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Final

from rigapp.texts import joined, say
from rigapp_drivers.api import DeviceError, DriverFailed, DriverInfo, Identity
from rigapp_drivers.edge import Edge
from rigapp_drivers.transport import SerialPort

QUESTION_S: Final = 0.3  # many times the slowest reply; up to eight drivers probe in turn
_PAUSE_S: Final = 0.03  # lets a device discard a request of another protocol
_WITHOUT_SPEED: Final = re.compile(
    r"^[a-z0-9]+://|/pts/|/ttyACM\d+$|/(cu|tty)\.usbmodem|/ttyGS\d+$", re.IGNORECASE
)
_NATIVE_USB: Final = re.compile(r"/ttyACM\d+$|/(cu|tty)\.usbmodem")


@dataclass(frozen=True, slots=True)
class Answer:
    """Device that answered, and its driver.

    baud_rate: None if the port has none. low_latency: the adapter accepted that mode.
    """

    driver: str
    title: str
    identity: Identity
    baud_rate: int | None
    low_latency: bool


@dataclass(frozen=True, slots=True)
class Inquiry:
    """Result of probing one port; tried: titles; problem: why it could not be probed."""

    port: str
    answer: Answer | None
    tried: tuple[str, ...]
    problem: str = ""


def drivers_of_usb_id(
    vendor: int | None, product: int | None, drivers: Iterable[DriverInfo]
) -> tuple[DriverInfo, ...]:
    """Return the drivers whose devices have this USB id."""
    return tuple(
        info
        for info in drivers
        if any(vendor == v and pid in (None, product) for v, pid in info.usb_ids)
    )


def may_be_probed(port: str, known: Sequence[DriverInfo]) -> bool:
    """Return whether a port that the user did not name may be probed.

    known: drivers of its USB id. A device behind a UART adapter may obey any byte.
    """
    return bool(known) or _NATIVE_USB.search(os.path.realpath(port)) is not None


def has_speed(port: str) -> bool:
    """Return whether the baud rate matters; USB devices, ptys and sockets ignore it."""
    return _WITHOUT_SPEED.search(port if "://" in port else os.path.realpath(port)) is None


def ask(port: str, drivers: Iterable[DriverInfo], timeout_s: float = QUESTION_S) -> Inquiry:
    """Probe a port with each driver until one recognises the reply; never raises.

    drivers: in probing order. The port is opened exclusively, so a device in use is not disturbed.
    """
    asking = [info for info in drivers if info.probe is not None]
    tried: list[str] = []
    problems: list[str] = []
    for baud_rate, infos in _rounds(asking, has_speed(port)):
        line = SerialPort("device", port, baud_rate or 115200)
        try:
            line.open()
            for info in infos:
                if info.title not in tried:
                    tried.append(info.title)
                identity = _probe_one(info, line, timeout_s, problems)
                if identity is not None:
                    answer = Answer(info.name, info.title, identity, baud_rate, line.low_latency)
                    return Inquiry(port, answer, tuple(tried))
        except DeviceError as error:
            return Inquiry(port, None, tuple(tried), error.sentence)
        finally:
            line.close()
    return Inquiry(port, None, tuple(tried), joined("; ", problems))


def _rounds(
    drivers: Sequence[DriverInfo], with_speed: bool
) -> list[tuple[int | None, list[DriverInfo]]]:
    """Return baud rates, each with the drivers to probe at it; the usual ones come first."""
    if not with_speed:
        return [(None, list(drivers))]
    rounds: dict[int, list[DriverInfo]] = {}
    rates = [info.probe.baud_rates for info in drivers if info.probe is not None]
    for rank in range(max(map(len, rates), default=0)):
        for info in drivers:
            probe = info.probe
            if probe is not None and rank < len(probe.baud_rates):
                rounds.setdefault(probe.baud_rates[rank], []).append(info)
    return list(rounds.items())


def _probe_one(
    info: DriverInfo, line: SerialPort, timeout_s: float, problems: list[str]
) -> Identity | None:
    """Run one driver's probe; a broken port raises DeviceError, a failed probe is recorded."""
    assert info.probe is not None
    line.read_some(1 << 16, 0.0)
    edge = Edge(info.probe, line.device, line.port, info.name)
    try:
        with edge.calling(say("it was identified")):
            return info.probe.ask(line, timeout_s)
    except DriverFailed as error:  # one faulty driver must not end the search
        problems.append(error.sentence)
        return None
    finally:
        time.sleep(_PAUSE_S)
