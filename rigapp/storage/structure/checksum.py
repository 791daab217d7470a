"""Protect rows and whole cycles by CRC-32C, as they are stored.

The checksum of a row is that of its columns' bytes in the order of the plan; of a cycle that of its
samples, column after column, then of its row without ``first``, which says only where it lies.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import google_crc32c
import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.storage.structure.layout import FileColumn

Crcs = NDArray[np.uint32]

WORDS: dict[int, np.dtype[Any]] = {4: np.dtype("<u4"), 8: np.dtype("<u8")}
"""Size of a value in bytes -> the word by which many rows are checked at once."""
MANY_ROWS = 64
"""Fewer are done before the compiled code is loaded."""


def row_checksums(fields: Sequence[FileColumn], columns: Sequence[NDArray[Any]], rows: int) -> Crcs:
    """Return the CRC-32C of each of ``rows`` rows; columns: an array a field, of its type."""
    if rows >= MANY_ROWS and all(
        column.ndim == 1 and column.itemsize in WORDS for column in columns
    ):
        words = np.empty((len(columns), rows), np.uint64)
        for word, column in zip(words, columns, strict=True):
            word[:] = column.view(WORDS[column.itemsize])
        return word_checksums(words, np.array([column.itemsize for column in columns]))
    packed = np.empty(rows, [(field.name, field.dtype, field.shape) for field in fields])
    for field, column in zip(fields, columns, strict=True):
        packed[field.name] = column
    size, data, value = packed.itemsize, packed.tobytes(), google_crc32c.value
    result = [value(data[start : start + size]) for start in range(0, rows * size, size)]
    return np.array(result, np.uint32)


def word_checksums(words: NDArray[np.uint64], sizes: NDArray[np.int64]) -> Crcs:
    """Return the CRC-32C of each row.

    words: (columns, rows), the bytes of each value and above them zeros; sizes: those of a value of
    each column, in ``WORDS``.
    """
    return load_kernel()(words, sizes)


def load_kernel() -> Callable[[NDArray[np.uint64], NDArray[np.int64]], Crcs]:
    """Return the compiled function for many rows; few rows need no numba."""
    from rigapp.storage.structure.crc import checksums_of_words

    return checksums_of_words


def cycle_checksum(
    samples: Iterable[NDArray[Any]], fields: Sequence[FileColumn], row: Mapping[str, ArrayLike]
) -> int:
    """Return the CRC-32C of a cycle.

    samples: each column's, of the file's type and without gaps. fields: of its row; row: the value
    of each.
    """
    crc = 0
    for column in samples:
        crc = google_crc32c.extend(crc, column)
    values = (np.asarray(row[field.name], field.dtype) for field in fields if field.name != "first")
    return int(google_crc32c.extend(crc, b"".join(value.tobytes() for value in values)))
