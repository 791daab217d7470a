"""Ask carefully whether a Modbus RTU transmitter is on a port: two input registers are read."""

from __future__ import annotations

import time
from typing import Final

from rigapp_drivers.api import BytePort, DeviceFault, Identity, Probe, ProtocolError, ReplyTimeout
from rigapp_drivers.modbus_sensor.link import ModbusLink

_USUAL_ADDRESS: Final = 1  # as transmitters are delivered
_FUNCTION, _REGISTER, _COUNT = 4, 1, 2


def ask(line: BytePort, timeout_s: float) -> Identity | None:
    """Return who answers at Modbus address 1; an exception is an answer, too."""
    link = ModbusLink(line, _USUAL_ADDRESS, PROBE.baud_rates[0], timeout_s)
    deadline_s = time.monotonic() + timeout_s
    try:
        link.read(_FUNCTION, _REGISTER, _COUNT, deadline_s, tries=1)
    except DeviceFault:
        pass
    except (ReplyTimeout, ProtocolError):
        return None
    details = {"address": str(_USUAL_ADDRESS)}
    return Identity("", "Modbus RTU device", "", "", line.port, details)


PROBE: Final = Probe(ask, (9600, 19200, 38400, 115200))
