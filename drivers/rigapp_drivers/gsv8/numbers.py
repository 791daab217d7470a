"""Convert the three number formats of measured-value frames (SPEC p14-16).

Integers on the wire are offset-binary on most interfaces and two's complement on some, as given by
a basic interface flag. In both cases the code here is signed: 0 is zero input, and the
normalised input is ``code * 1.05 / 2**23`` (int24) or ``code * 1.05 / 2**15`` (int16).
"""

from __future__ import annotations

import enum

import numpy as np
from numpy.typing import NDArray

from rigapp.texts import say

OVERRANGE = 1.05
"""Normalised input at the end of the integer range; 1.0 is the nominal range."""

Values = NDArray[np.float32] | NDArray[np.int32]


class DataType(enum.IntEnum):
    """Number format of measured values; the value is the code on the wire."""

    INT16 = 1
    INT24 = 2
    FLOAT32 = 3

    @property
    def width(self) -> int:
        """Return the number of bytes of one value."""
        return self.value + 1

    @property
    def bits(self) -> int:
        """Return the number of bits of one value."""
        return 8 * self.width


def scale_of_code(data_type: DataType, nominal_range: float) -> float:
    """Return the electrical signal per step of an integer code, in the unit of the range."""
    if data_type is DataType.FLOAT32:
        raise ValueError(say("float32 values are scaled in the device"))
    return nominal_range * OVERRANGE / 2.0 ** (data_type.bits - 1)


def decode(
    payload: NDArray[np.uint8], objects: int, data_type: DataType, *, offset_binary: bool
) -> Values:
    """Return (objects, samples) from payload rows (frames, sequences * objects * width).

    float32 for float32; signed codes as int32 for the integers.
    """
    if data_type is DataType.FLOAT32:
        wire = np.ascontiguousarray(payload).view(">f4").reshape(-1, objects)
        return wire.T.astype(np.float32, order="C")
    if data_type is DataType.INT16:
        words = np.ascontiguousarray(payload).view(">u2").reshape(-1, objects).T
        code = words.astype(np.int32, order="C")
    else:
        triples = payload.reshape(-1, objects, 3).transpose(2, 1, 0).astype(np.int32, order="C")
        code = (triples[0] << 16) | (triples[1] << 8) | triples[2]
    sign = 1 << (data_type.bits - 1)
    if not offset_binary:
        code ^= sign
    code -= sign
    return code


def encode(
    values: NDArray[np.generic], data_type: DataType, *, offset_binary: bool = True
) -> NDArray[np.uint8]:
    """Return payload rows (samples, objects * width) of values (objects, samples).

    values: floats for float32; signed codes for the integers.
    """
    objects, count = values.shape
    if data_type is DataType.FLOAT32:
        return values.T.astype(">f4", order="C").view(np.uint8).reshape(count, objects * 4)
    code = values.T.astype(np.int64)
    if offset_binary:
        code += 1 << (data_type.bits - 1)
    code &= (1 << data_type.bits) - 1
    octets = code.astype(">u4", order="C").view(np.uint8).reshape(count, objects, 4)
    used = np.ascontiguousarray(octets[:, :, 4 - data_type.width :])
    return used.reshape(count, objects * data_type.width)
