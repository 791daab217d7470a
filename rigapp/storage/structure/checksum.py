"""Protect rows and whole cycles by CRC-32C, as they are stored.

The checksum of a row is that of its columns' bytes in the order of the plan; of a cycle that of its
samples, column after column, then of its row without ``first``, which says only where it lies.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import google_crc32c
import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.storage.structure.layout import FileColumn

Crcs = NDArray[np.uint32]


def row_checksums(fields: Sequence[FileColumn], columns: Iterable[NDArray[Any]], rows: int) -> Crcs:
    """Return the CRC-32C of each of ``rows`` rows; columns: an array a field, in their order."""
    packed = np.empty(rows, [(one.name, one.dtype, one.shape) for one in fields])
    for one, column in zip(fields, columns, strict=True):
        packed[one.name] = column
    size, data, value = packed.itemsize, packed.tobytes(), google_crc32c.value
    found = [value(data[start : start + size]) for start in range(0, rows * size, size)]
    return np.array(found, np.uint32)


def cycle_checksum(
    samples: Iterable[NDArray[Any]], fields: Sequence[FileColumn], row: Mapping[str, ArrayLike]
) -> int:
    """Return the CRC-32C of a cycle.

    samples: each column's, of the file's type. fields: of its row; row: the value of each.
    """
    crc = 0
    for column in samples:
        crc = google_crc32c.extend(crc, np.ascontiguousarray(column))
    for one in fields:
        if one.name != "first":
            crc = google_crc32c.extend(crc, np.asarray(row[one.name], one.dtype).tobytes())
    return int(crc)
