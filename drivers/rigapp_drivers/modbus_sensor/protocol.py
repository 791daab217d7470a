"""Modbus RTU: questions to bytes, bytes to words; framing and checksum are pymodbus's. Pure.

Sources: Modbus application protocol specification 1.1b3, Modbus over serial line 1.02.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

from pymodbus.framer.rtu import FramerRTU
from pymodbus.pdu import DecodePDU
from pymodbus.pdu.register_message import ReadHoldingRegistersRequest, ReadInputRegistersRequest

_REQUESTS: Final[Mapping[int, Any]] = {3: ReadHoldingRegistersRequest, 4: ReadInputRegistersRequest}
_FRAMER: Final = FramerRTU(DecodePDU(is_server=False))
_EXCEPTIONS: Final = {
    1: "illegal function",
    2: "illegal data address",
    3: "illegal data value",
    4: "server device failure",
    5: "acknowledge, still at work",
    6: "server device busy",
}


@dataclass(frozen=True, slots=True)
class ModbusReply:
    """What came: words, or an exception in words, or why it is no answer."""

    words: tuple[int, ...] = ()
    exception: str = ""
    wrong: str = ""


def encode_request(device: int, function: int, address: int, count: int) -> bytes:
    """Return the frame that reads ``count`` registers of a device from an address on."""
    return bytes(_FRAMER.buildFrame(_REQUESTS[function](device, 0, address, count)))


def decode_reply(data: bytes, device: int, function: int, count: int) -> ModbusReply | None:
    """Return what the bytes since a request say, None while the frame is not whole."""
    used, pdu = _FRAMER.handleFrame(data, 0, 0)
    if pdu is None:
        return ModbusReply(wrong="a damaged answer ‹wrong checksum›") if used else None
    if pdu.dev_id != device:
        return ModbusReply(wrong=f"an answer of device {pdu.dev_id}")
    if pdu.isError():
        code = pdu.exception_code
        return ModbusReply(
            exception=f"a refusal ‹exception {code}, {_EXCEPTIONS.get(code, 'unknown')}›"
        )
    if pdu.function_code != function or len(pdu.registers) != count:
        return ModbusReply(
            wrong=f"{len(pdu.registers)} words to function {pdu.function_code} instead of "
            f"{count} to {function}"
        )
    return ModbusReply(tuple(pdu.registers))
