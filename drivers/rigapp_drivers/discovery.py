"""Find out which device is on a serial port: by its USB id, and by asking carefully.

A question may neither move a motor nor change a setting. The shipped ones read versions only, and
none of their bytes means anything to the other devices in their packet modes. A motor controller in
a simple serial mode, however, takes ANY byte for a speed. So a port is asked without being named by
the user only when it belongs to a USB device itself, never behind a UART adapter.
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

QUESTION_S: Final = 0.3  # many times the slowest answer, and eight drivers may ask
_PAUSE_S: Final = 0.03  # lets a device forget what was not meant for it
_WITHOUT_SPEED: Final = re.compile(
    r"^[a-z0-9]+://|/pts/|/ttyACM\d+$|/(cu|tty)\.usbmodem|/ttyGS\d+$", re.IGNORECASE
)
_NATIVE_USB: Final = re.compile(r"/ttyACM\d+$|/(cu|tty)\.usbmodem")


@dataclass(frozen=True, slots=True)
class Answer:
    """Tell who answered, and which driver speaks with it.

    baud_rate: None where a port has no speed. low_latency: the adapter took that mode.
    """

    driver: str
    title: str
    identity: Identity
    baud_rate: int | None
    low_latency: bool


@dataclass(frozen=True, slots=True)
class Inquiry:
    """Tell what came of asking one port; tried: titles; problem: why it could not be asked."""

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
    """Tell whether a port may be asked that the user has not named.

    known: drivers of its USB id. A UART adapter may lead to a device that obeys any byte.
    """
    return bool(known) or _NATIVE_USB.search(os.path.realpath(port)) is not None


def has_speed(port: str) -> bool:
    """Tell whether the baud rate matters; USB devices, ptys and sockets ignore it."""
    return _WITHOUT_SPEED.search(port if "://" in port else os.path.realpath(port)) is None


def ask(port: str, drivers: Iterable[DriverInfo], timeout_s: float = QUESTION_S) -> Inquiry:
    """Ask a port on behalf of all drivers that can, until one knows the answer; never raises.

    drivers: in the order of asking. The port is opened exclusively, so a device in use is left
    alone.
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
                identity = _ask_one(info, line, timeout_s, problems)
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
    """Return baud rates, each with the drivers to ask at it; the usual ones come first."""
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


def _ask_one(
    info: DriverInfo, line: SerialPort, timeout_s: float, problems: list[str]
) -> Identity | None:
    """Ask for one driver; a broken port raises DeviceError, a fault in the probe is noted."""
    assert info.probe is not None
    line.read_some(1 << 16, 0.0)
    edge = Edge(info.probe, line.device, line.port, info.name)
    try:
        with edge.calling(say("it was identified")):
            return info.probe.ask(line, timeout_s)
    except DriverFailed as error:  # must not end the search
        problems.append(error.sentence)
        return None
    finally:
        time.sleep(_PAUSE_S)
