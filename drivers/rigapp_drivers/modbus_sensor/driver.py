"""Read slow quantities from a Modbus RTU (RS-485) transmitter: temperature, humidity, others."""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import Any, Final

from rigapp_drivers.api import (
    ConnectionFailed,
    DeviceFault,
    DriverInfo,
    DriverKind,
    Identity,
    ProtocolError,
    ReplyTimeout,
    SettingRefused,
    SlowRequest,
    WrongDevice,
    filled,
)
from rigapp_drivers.modbus_sensor.link import ModbusLink
from rigapp_drivers.modbus_sensor.probe import PROBE
from rigapp_drivers.modbus_sensor.registers import PRESETS, Question, questions, registers_of
from rigapp_drivers.modbus_sensor.settings import SETTINGS
from rigapp_drivers.transport import SerialPort, byte_counters

_OPEN_S: Final = 2.0  # two tries of some questions at the longest usual time-out


class ModbusSensor:
    """One transmitter on a line of its own; implements ``rigapp_drivers.api.SlowSource``."""

    def __init__(self, name: str, port: str, settings: Mapping[str, Any]) -> None:
        self.name = name
        self.port = port
        self._settings = given = filled(SETTINGS, settings)
        self._line = SerialPort(
            name,
            port,
            given["baud_rate"],
            parity=given["parity"],
            stop_bits=given["stop_bits"],
        )
        self._link = ModbusLink(
            self._line, given["address"], given["baud_rate"], given["reply_timeout_s"]
        )
        self._questions: tuple[Question, ...] = ()
        self._timeout_s = _OPEN_S

    def open(self) -> Identity:
        """Open the port and read every register once.

        Raises ConnectionFailed when nothing answers, WrongDevice when something else does or the
        device lacks a register, SettingRefused for registers that are none.
        """
        try:
            self._questions = questions(registers_of(self._settings))
        except ValueError as error:
            raise SettingRefused.at(self, str(error)) from error
        self._line.open()
        try:
            self._ask(_OPEN_S)
        except BaseException as error:
            self._line.close()
            kind = _ON_OPENING.get(type(error))
            if kind is None:
                raise
            raise kind.at(self, getattr(error, "sentence", str(error))) from error
        address = self._settings["address"]
        model = f"Modbus RTU device, {self._settings['preset']}"
        return Identity("", model, "", "", self.port, {"address": str(address)})

    def configure(self, request: SlowRequest) -> Mapping[str, str | float | int]:
        """Check that the registers tell these quantities; return which register tells which."""
        try:
            check(SlowRequest(request.quantities, request.timeout_s, self._settings))
        except ValueError as error:
            raise SettingRefused.at(self, str(error)) from error
        wanted = [one for one in registers_of(self._settings) if one.quantity in request.quantities]
        self._questions = questions(wanted)
        self._timeout_s = request.timeout_s
        return {
            "address": self._settings["address"],
            **{
                one.quantity: f"function {one.function}, address {one.address}, {one.type}, "
                f"scale {one.scale:g}"
                for one in wanted
            },
        }

    def read(self) -> Mapping[str, float]:
        """Return the quantities as they are now, NaN where a register says that it has no value.

        Raises ReplyTimeout, ProtocolError, DeviceFault or DeviceLost.
        """
        return self._ask(self._timeout_s)

    def close(self) -> None:
        """Release the port; never raises; safe to call twice."""
        self._line.close()

    def counters(self) -> Mapping[str, int]:
        """Return what was counted on the line since it was opened."""
        link = self._link
        return {
            **byte_counters(self._line),
            "crc_errors": link.crc_errors,
            "retries": link.retries,
        }

    def _ask(self, timeout_s: float) -> dict[str, float]:
        deadline_s = time.monotonic() + timeout_s
        found: dict[str, float] = {}
        for one in self._questions:
            found |= one.values(self._link.read(one.function, one.address, one.count, deadline_s))
        return found


_ON_OPENING: Final[Mapping[type[BaseException], type[ConnectionFailed] | type[WrongDevice]]] = {
    ReplyTimeout: ConnectionFailed,
    ProtocolError: WrongDevice,
    DeviceFault: WrongDevice,
}
"""What an error of the first question means while a device is being opened."""


def check(request: SlowRequest) -> None:
    """Raise ValueError for quantities that the settings give no register for."""
    settings = filled(SETTINGS, request.settings)
    known = [one.quantity for one in registers_of(settings)]
    missing = [name for name in request.quantities if name not in known]
    if missing:
        raise ValueError(
            f"the device does not tell {', '.join(missing)}; its settings give {', '.join(known)}."
        )


DRIVER: Final = DriverInfo(
    name="modbus_sensor",
    title="Modbus RTU transmitter",
    kind=DriverKind.SLOW_SOURCE,
    factory=ModbusSensor,
    settings=SETTINGS,
    simulator="rigapp_drivers.modbus_sensor.simulator:ModbusSensorSimulator",
    probe=PROBE,
    check=check,
    quantities=tuple(one.quantity for one in PRESETS[SETTINGS["preset"].default]),
)
