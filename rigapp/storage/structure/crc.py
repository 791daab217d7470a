"""Compute the CRC-32C of many short rows at once; of one long text ``google_crc32c`` is faster.

The overhead of a call exceeds the cost of a row: one call a row takes 130 us for 256 rows of 272
bytes, this module 25 us. Column after column, each row's CRC is extended by eight bytes with eight
tables ("slicing by eight", Kounavis and Berry 2005); the last bytes need the first table only.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rigapp_model.compiled import njit

Crcs = NDArray[np.uint32]
Words = NDArray[np.uint64]

POLYNOMIAL = 0x82F63B78
"""Castagnoli polynomial, bits reversed (RFC 3720, B.4)."""
ALL_ONES = 0xFFFFFFFF


def _tables() -> Crcs:
    """Return the change of a CRC by each byte; table [k] for a byte that k others follow."""
    tables = np.zeros((8, 256), np.uint32)
    rest = np.arange(256, dtype=np.uint32)
    for _ in range(8):
        rest = np.where(rest & 1, (rest >> 1) ^ np.uint32(POLYNOMIAL), rest >> 1)
    tables[0] = rest
    for k in range(1, 8):
        tables[k] = (tables[k - 1] >> 8) ^ tables[0][tables[k - 1] & 0xFF]
    return tables


@njit("void(uint64[:, ::1], int64[::1], uint32[:, ::1], uint32[::1])", cache=True, nogil=True)
def _extend(words: Words, sizes: NDArray[np.int64], t: Crcs, crcs: Crcs) -> None:
    """Extend the CRC of each row by its words; words: [column, row], sizes: 4 or 8 bytes."""
    byte = np.uint32(0xFF)
    for j in range(words.shape[0]):
        if sizes[j] == 8:
            for i in range(words.shape[1]):
                low = np.uint32(words[j, i]) ^ crcs[i]
                high = np.uint32(words[j, i] >> np.uint64(32))
                crcs[i] = (
                    t[7, low & byte]
                    ^ t[6, (low >> np.uint32(8)) & byte]
                    ^ t[5, (low >> np.uint32(16)) & byte]
                    ^ t[4, low >> np.uint32(24)]
                    ^ t[3, high & byte]
                    ^ t[2, (high >> np.uint32(8)) & byte]
                    ^ t[1, (high >> np.uint32(16)) & byte]
                    ^ t[0, high >> np.uint32(24)]
                )
        else:
            for i in range(words.shape[1]):
                low = np.uint32(words[j, i]) ^ crcs[i]
                crcs[i] = (
                    t[3, low & byte]
                    ^ t[2, (low >> np.uint32(8)) & byte]
                    ^ t[1, (low >> np.uint32(16)) & byte]
                    ^ t[0, low >> np.uint32(24)]
                )


TABLES = _tables()


def checksums_of_words(words: Words, sizes: NDArray[np.int64]) -> Crcs:
    """Return the CRC-32C of each row.

    words: (columns, rows), each value's bytes, little-endian, padded above with zeros; sizes: bytes
    of a value of each column, 4 or 8.
    """
    crcs = np.full(words.shape[1], ALL_ONES, np.uint32)
    _extend(np.ascontiguousarray(words), sizes, TABLES, crcs)
    return ~crcs
