"""Protect rows and whole cycles by CRC-32C, as they are stored.

The checksum of a row covers its columns' bytes in the order of the plan; that of a cycle its
samples, column after column, then its row without ``first``, which is only a position.
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
"""Size of a value in bytes -> the word type for checking many rows at once."""
MANY_ROWS = 64
"""Fewer rows take less time than loading the compiled code."""


def row_checksums(fields: Sequence[FileColumn], columns: Sequence[NDArray[Any]], rows: int) -> Crcs:
    """Return the CRC-32C of each of ``rows`` rows; columns: an array of each field's type."""
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

    words: (columns, rows), the bytes of each value, padded above with zeros. sizes: bytes of a
    value of each column, in ``WORDS``.
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

    samples: of each column, contiguous and of the file's type. fields: of its row; row: the value
    of each.
    """
    crc = 0
    for column in samples:
        crc = google_crc32c.extend(crc, column)
    values = (np.asarray(row[field.name], field.dtype) for field in fields if field.name != "first")
    return int(google_crc32c.extend(crc, b"".join(value.tobytes() for value in values)))
