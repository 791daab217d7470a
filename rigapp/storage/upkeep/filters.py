"""Do what HDF5's filters do to chunks of a dataset, in as many threads as there are processors.

HDF5 lets one thread in at a time, so that it compresses by one processor. What it would make of a
chunk (shuffle, gzip, fletcher32) is made here, and given to it ready.
"""

from __future__ import annotations

import contextlib
import zlib
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

GZIP_LEVEL = 4


def write_chunks(new: h5py.Dataset, pieces: Iterable[NDArray[Any]], processors: int) -> None:
    """Fill a dataset with the filters shuffle, gzip and fletcher32.

    pieces: its rows in order, each but the last a multiple of its chunks long.
    """
    step, row = new.chunks[0], 0
    with contextlib.ExitStack() as stack:
        apply: Callable[..., Iterable[bytes]] = map
        if processors > 1 and len(new) > step:
            apply = stack.enter_context(ThreadPoolExecutor(processors, "chunks")).map
        for piece in pieces:
            blocks = [piece[first : first + step] for first in range(0, len(piece), step)]
            for data in apply(partial(filtered, rows=step), blocks):
                new.id.write_direct_chunk((row, *(0,) * (new.ndim - 1)), data)
                row += step


def filtered(block: NDArray[Any], rows: int) -> bytes:
    """Return a chunk of so many rows as HDF5 stores it; what a block lacks at its end is zeros."""
    missing = (rows - len(block)) * block[:1].nbytes
    plain = np.frombuffer(block.tobytes() + bytes(missing), np.uint8)
    shuffled = plain.reshape(-1, block.dtype.itemsize).T.tobytes()
    data = zlib.compress(shuffled, GZIP_LEVEL)
    return data + fletcher32(data).to_bytes(4, "little")


def fletcher32(data: bytes) -> int:
    """Return Fletcher's checksum of words of 16 bits, the first byte high, as HDF5 computes it."""
    words = np.frombuffer(data + bytes(len(data) % 2), ">u2").astype(np.uint64)
    weights = np.arange(words.size, 0, -1, dtype=np.uint64)
    return _folded(int(words @ weights)) << 16 | _folded(int(words.sum()))


def _folded(total: int) -> int:
    """Return a sum modulo 65535 by carrying over, which makes 0 of 0 only."""
    return (total - 1) % 0xFFFF + 1 if total else 0
