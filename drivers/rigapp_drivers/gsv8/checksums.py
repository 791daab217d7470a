"""Compute the optional checksums of the GSV-8 protocol (SPEC p12, p15, p99)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def _crc8_table() -> bytes:
    table = bytearray()
    for byte in range(256):
        for _ in range(8):
            byte = (byte << 1) ^ (0x07 if byte & 0x80 else 0)
        table.append(byte & 0xFF)
    return bytes(table)


def _crc16_table() -> NDArray[np.uint16]:
    table = []
    for byte in range(256):
        for _ in range(8):
            byte = (byte >> 1) ^ (0xA001 if byte & 1 else 0)
        table.append(byte)
    return np.array(table, dtype=np.uint16)


_CRC8 = _crc8_table()
_CRC16 = _crc16_table()


def crc8(data: bytes) -> int:
    """Return the CRC-8 of commands: polynomial 0x07, initial 0, over all behind the prefix."""
    crc = 0
    for byte in data:
        crc = _CRC8[crc ^ byte]
    return crc


def crc16(data: bytes) -> int:
    """Return the CRC-16 of measured values: Modbus, sent low byte first."""
    return int(crc16_of_rows(np.frombuffer(data, np.uint8)[None])[0])


def crc16_of_rows(rows: NDArray[np.uint8]) -> NDArray[np.uint16]:
    """Return the CRC-16 of every row of (n, bytes)."""
    crc = np.full(len(rows), 0xFFFF, dtype=np.uint16)
    for column in np.ascontiguousarray(rows.T):
        crc = (crc >> 8) ^ _CRC16[(crc ^ column) & 0xFF]
    return crc
