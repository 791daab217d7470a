"""Read slow quantities from a Modbus transmitter (RTU on RS-485, or TCP): temperature, others."""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import Any, Final

from rigapp.texts import joined, say, sentence_of_error
from rigapp_drivers.api import (
    BytePort,
    ConnectionFailed,
    DeviceFault,
    DriverInfo,
    DriverKind,
    Identity,
    InvalidRequest,
    Probe,
    ProtocolError,
    ReplyTimeout,
    SettingSpec,
    SlowRequest,
    WrongDevice,
    filled,
    refusing,
)
from rigapp_drivers.modbus_sensor.bus import SharedPort
from rigapp_drivers.modbus_sensor.link import Decoder, ModbusLink
from rigapp_drivers.modbus_sensor.registers import OWN, PRESETS, Question, questions, registers_of
from rigapp_drivers.transport import byte_counters

SETTINGS: Final[Mapping[str, SettingSpec]] = {
    "preset": SettingSpec(
        str,
        "SHT20",
        say("Registers of a usual transmitter (temperature_C and humidity_percent), or one's own."),
        choices=(*PRESETS, OWN),
    ),
    "registers": SettingSpec(
        list,
        [],
        say(
            "One table a quantity: quantity (its name with the unit at the end), function"
            " (3 or 4), address, type (i16, u16, i32, f32), scale, offset, words, invalid."
        ),
    ),
    "address": SettingSpec(int, 1, say("Modbus address of the device."), 1, 247),
    "baud_rate": SettingSpec(
        int,
        9600,
        say("Speed of the RS-485 line."),
        choices=(1200, 2400, 4800, 9600, 14400, 19200, 38400, 57600, 115200),
    ),
    "parity": SettingSpec(str, "none", say("Parity of the line."), choices=("none", "even", "odd")),
    "stop_bits": SettingSpec(int, 1, say("Stop bits of the line."), choices=(1, 2)),
    "reply_timeout_s": SettingSpec(
        float, 0.3, say("How long to wait for the answer to a request."), 0.02, 5.0
    ),
}


_USUAL_ADDRESS: Final = 1  # as transmitters are delivered
_FUNCTION, _REGISTER, _COUNT = 4, 1, 2


def ask(line: BytePort, timeout_s: float) -> Identity | None:
    """Probe Modbus address 1 and return the device's identity; an exception reply counts, too."""
    link = ModbusLink(line, _USUAL_ADDRESS, PROBE.baud_rates[0], timeout_s)
    deadline_s = time.monotonic() + timeout_s
    try:
        link.read(_FUNCTION, _REGISTER, _COUNT, deadline_s, tries=1)
    except DeviceFault:
        pass
    except (ReplyTimeout, ProtocolError):
        return None
    details = {"address": str(_USUAL_ADDRESS)}
    return Identity("", say("Modbus RTU device"), "", "", line.port, details)


PROBE: Final = Probe(ask, (9600, 19200, 38400, 115200))


_OPEN_S: Final = 2.0  # two tries of a few requests at the longest usual time-out


class ModbusSensor:
    """One transmitter, alone or on a shared line; implements ``SlowSource``."""

    def __init__(self, name: str, port: str, settings: Mapping[str, Any]) -> None:
        self.name = name
        self.port = port
        self._settings = filled(SETTINGS, settings)
        address, baud_rate, parity, stop_bits, timeout_s = (
            self._settings[key]
            for key in ("address", "baud_rate", "parity", "stop_bits", "reply_timeout_s")
        )
        self._line = SharedPort(name, port, baud_rate, parity, stop_bits, address)
        self._link = ModbusLink(self._line, address, baud_rate, timeout_s)
        self._questions: tuple[Question, ...] = ()
        self._timeout_s = _OPEN_S

    def open(self) -> Identity:
        """Open the port and read every register once.

        Raises ConnectionFailed if nothing answers, WrongDevice if another device does or a register
        is missing, SettingRefused for invalid registers.
        """
        with refusing(self):
            self._questions = questions(registers_of(self._settings))
        self._line.open()
        self._link.share(self._line.bus)
        try:
            self._request(_OPEN_S)
        except BaseException as error:
            self._line.close()
            kind = _ON_OPENING.get(type(error))
            if kind is None:
                raise
            raise kind.at(self, getattr(error, "sentence", sentence_of_error(error))) from error
        address = self._settings["address"]
        model = say("Modbus RTU device, {}", self._settings["preset"])
        return Identity("", model, "", "", self.port, {"address": str(address)})

    def configure(self, request: SlowRequest) -> Mapping[str, str | float | int]:
        """Check that registers exist for these quantities; return the register of each."""
        with refusing(self):
            check(SlowRequest(request.quantities, request.timeout_s, self._settings))
        requested = [
            register
            for register in registers_of(self._settings)
            if register.quantity in request.quantities
        ]
        self._questions = questions(requested)
        self._timeout_s = request.timeout_s
        return {
            "address": self._settings["address"],
            **{
                register.quantity: say(
                    "function {}, address {}, {}, scale {:g}",
                    register.function,
                    register.address,
                    register.type,
                    register.scale,
                )
                for register in requested
            },
        }

    def read(self) -> Mapping[str, float]:
        """Return the present quantities, NaN if a register reports no valid value.

        Raises ReplyTimeout, ProtocolError, DeviceFault or DeviceLost.
        """
        return self._request(self._timeout_s)

    def close(self) -> None:
        """Release the port; never raises; safe to call twice."""
        self._line.close()

    def counters(self) -> Mapping[str, int]:
        """Return the counters of the line since it was opened."""
        link = self._link
        return {
            **byte_counters(self._line),
            "crc_errors": link.crc_errors,
            "retries": link.retries,
            "busy": link.busy,
        }

    def _request(self, timeout_s: float) -> dict[str, float]:
        deadline_s = time.monotonic() + timeout_s
        values: dict[str, float] = {}
        for question in self._questions:
            words = self._link.read(question.function, question.address, question.count, deadline_s)
            values |= question.values(words)
        return values


_ON_OPENING: Final[Mapping[type[BaseException], type[ConnectionFailed] | type[WrongDevice]]] = {
    ReplyTimeout: ConnectionFailed,
    ProtocolError: WrongDevice,
    DeviceFault: WrongDevice,
}
"""Error of the first request -> error raised by ``open``."""


def check(request: SlowRequest) -> None:
    """Raise InvalidRequest for quantities without a register in the settings."""
    settings = filled(SETTINGS, request.settings)
    known = [register.quantity for register in registers_of(settings)]
    missing = [name for name in request.quantities if name not in known]
    if missing:
        raise InvalidRequest(
            "the device does not report {}; its settings give {}.",
            joined(", ", missing),
            joined(", ", known),
        )


DRIVER: Final = DriverInfo(
    name="modbus_sensor",
    title=say("Modbus transmitter (RTU or TCP)"),
    kind=DriverKind.SLOW_SOURCE,
    factory=ModbusSensor,
    settings=SETTINGS,
    simulator="rigapp_drivers.modbus_sensor.simulator:ModbusSensorSimulator",
    probe=PROBE,
    check=check,
    quantities=tuple(register.quantity for register in PRESETS[SETTINGS["preset"].default]),
    decoder=Decoder,
)
