"""A Modbus RTU transmitter at the byte level: frames in, frames out, its own checksum.

Loaded by the simulated rig and by tests; no driver at run time imports it.
"""

from __future__ import annotations

import enum
import struct
from collections.abc import Mapping
from typing import Any, Final

from rigapp_drivers.modbus_sensor.registers import MOST_WORDS, registers_of
from rigapp_drivers.simulated import FaultPlan, Faults

_READS: Final = (3, 4)
_ILLEGAL_FUNCTION, _ILLEGAL_ADDRESS, _ILLEGAL_VALUE, _FAILURE = 1, 2, 3, 4
_SILENCE_S: Final = 0.05
"""A longer gap ends a frame; the standard's 3.5 characters are too short for a busy host."""
_REQUEST_BYTES: Final = 8


class ModbusSensorFault(enum.StrEnum):
    """Kinds of fault; the comment gives the meaning of ``value`` and its default."""

    # in the replies; count: number of replies, target: function code
    NO_REPLY = "no_reply"
    WRONG_CRC = "wrong_crc"
    CUT_REPLY = "cut_reply"  # bytes sent (3)
    SLOW_REPLY = "slow_reply"  # delay in s (1)
    EXCEPTION = "exception"  # its code (4)
    OTHER_ADDRESS = "other_address"  # address of the other device that answers (2)
    # while active
    SENSOR_BROKEN = "sensor_broken"  # registers return their number for no value, if they have one


def crc16(data: bytes) -> int:
    """Return the CRC-16 of Modbus: polynomial 8005 reflected, initial FFFF ("123456789": 4B37)."""
    crc = 0xFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0xA001 if crc & 1 else 0)
    return crc


class ModbusSensorSimulator:
    """Reply to reads of the registers in the settings; see ``SimulatedSlowSource``.

    preset, registers, address: as in the driver's settings. quantities: of these registers.
    faults: ``Fault`` records or tables of their fields, see ``ModbusSensorFault``.
    """

    kinds = ModbusSensorFault

    def __init__(
        self,
        *,
        preset: str = "SHT20",
        registers: list[dict[str, Any]] | None = None,
        address: int = 1,
        faults: Faults = (),
    ) -> None:
        self._registers = registers_of({"preset": preset, "registers": registers or []})
        self.quantities = tuple(register.quantity for register in self._registers)
        self._address = address
        self._plan = FaultPlan(ModbusSensorFault, faults)
        self.inject, self.clear = self._plan.add, self._plan.clear
        self._buffer = b""
        self._last_byte_s = 0.0
        self._words: dict[tuple[int, int], int] = {}
        self.observe({register.quantity: 0.0 for register in self._registers})

    def observe(self, values: Mapping[str, float]) -> None:
        """Set the sensors' present values by quantity; others keep theirs."""
        for register in self._registers:
            if register.quantity in values:
                for offset, word in enumerate(register.encode(values[register.quantity])):
                    self._words[register.function, register.address + offset] = word

    def receive(self, data: bytes, now_s: float) -> bytes:
        """Process bytes from the host and return the replies that are due."""
        time_s = self._plan.tick(now_s)
        if data:
            if time_s - self._last_byte_s > _SILENCE_S:
                self._buffer = b""
            self._last_byte_s = time_s
            self._buffer += data
        replies = self._plan.due()
        while len(self._buffer) >= _REQUEST_BYTES:
            frame, self._buffer = self._buffer[:_REQUEST_BYTES], self._buffer[_REQUEST_BYTES:]
            if crc16(frame) == 0:
                replies += self._answer(frame)
            else:
                self._buffer = (
                    b""  # discard everything after a damaged frame until the line is quiet
                )
        return replies

    def _answer(self, frame: bytes) -> bytes:
        address, function, first, count = struct.unpack(">BBHH", frame[:6])
        if address != self._address:
            return b""
        link_fault = self._plan.link_fault
        if link_fault(ModbusSensorFault.NO_REPLY, function) is not None:
            return b""
        code = link_fault(ModbusSensorFault.EXCEPTION, function, _FAILURE)
        other = link_fault(ModbusSensorFault.OTHER_ADDRESS, function, 2)
        body = self._exception(function, int(code)) if code else self._read(function, first, count)
        reply = bytes((address if other is None else int(other),)) + body
        checksum = crc16(reply)
        if link_fault(ModbusSensorFault.WRONG_CRC, function) is not None:
            checksum ^= 0x0100
        reply += struct.pack("<H", checksum)
        cut = link_fault(ModbusSensorFault.CUT_REPLY, function, 3)
        reply = reply if cut is None else reply[: int(cut)]
        return self._plan.in_time(reply, ModbusSensorFault.SLOW_REPLY, function, 1.0)

    def _read(self, function: int, first: int, count: int) -> bytes:
        if function not in _READS:
            return self._exception(function, _ILLEGAL_FUNCTION)
        if not 1 <= count <= MOST_WORDS:
            return self._exception(function, _ILLEGAL_VALUE)
        keys = [(function, address) for address in range(first, first + count)]
        if any(key not in self._words for key in keys):
            return self._exception(function, _ILLEGAL_ADDRESS)
        words = dict(self._words)
        if self._plan.on(ModbusSensorFault.SENSOR_BROKEN):
            for register in self._registers:
                if register.invalid is not None:
                    for index, word in enumerate(
                        register.encode(register.scale * register.invalid + register.offset)
                    ):
                        words[register.function, register.address + index] = word
        data = struct.pack(f">{count}H", *(words[key] for key in keys))
        return bytes((function, len(data))) + data

    @staticmethod
    def _exception(function: int, code: int) -> bytes:
        return bytes((function | 0x80, code))


__all__ = ["ModbusSensorFault", "ModbusSensorSimulator", "crc16"]
