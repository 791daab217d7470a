"""Copy an HDF5 test file piece by piece into trimmed, compressed datasets, and compare the two."""

from __future__ import annotations

import contextlib
import zlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from rigapp.storage.structure.build import scale_label
from rigapp.storage.structure.digest import SCALE_ATTRIBUTES
from rigapp.storage.structure.hdf import is_bare, open_for_reading
from rigapp.storage.structure.layout import COMPRESSED, FILE_NAME_ATTRIBUTE, FORM_ATTRIBUTE

# Filter the chunks of a dataset as HDF5 does, in as many threads as there are processors.
#
# HDF5 runs one thread at a time and so compresses on one processor. The content of a chunk
# (shuffle, gzip, fletcher32) is computed here and passed to HDF5 complete.

GZIP_LEVEL = 4


def write_chunks(new: h5py.Dataset, pieces: Iterable[NDArray[Any]], processors: int) -> None:
    """Write a dataset with the filters shuffle, gzip and fletcher32.

    pieces: its rows in order; the length of each but the last is a multiple of the chunk length.
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
    """Return a chunk of ``rows`` rows as HDF5 stores it; a short block is padded with zeros."""
    missing = (rows - len(block)) * block[:1].nbytes
    plain = np.frombuffer(block.tobytes() + bytes(missing), np.uint8)
    shuffled = plain.reshape(-1, block.dtype.itemsize).T.tobytes()
    data = zlib.compress(shuffled, GZIP_LEVEL)
    return data + fletcher32(data).to_bytes(4, "little")


def fletcher32(data: bytes) -> int:
    """Return Fletcher's checksum of big-endian words of 16 bits, as HDF5 computes it."""
    words = np.frombuffer(data + bytes(len(data) % 2), ">u2").astype(np.uint64)
    weights = np.arange(words.size, 0, -1, dtype=np.uint64)
    return _folded(int(words @ weights)) << 16 | _folded(int(words.sum()))


def _folded(total: int) -> int:
    """Return a sum modulo 65535 by end-around carry, where only 0 gives 0."""
    return (total - 1) % 0xFFFF + 1 if total else 0


CHUNK_BYTES = 1 << 18  # compresses well, and reading one cycle opens only a few chunks
PIECE_BYTES = 1 << 24  # memory of a copy, independent of the file's size


Ranges = Sequence[tuple[int, int]]
"""Start and stop of each range of rows to copy, in order."""

_DAMAGE = (OSError, RuntimeError, LookupError, ValueError, TypeError)
"""Errors that HDF5 and NumPy raise for damaged data."""


def write_duplicate(
    source: Path,
    target: Path,
    sizes: Mapping[str, int | Ranges],
    lost: Callable[[str], object] | None = None,
    processors: int = 1,
) -> None:
    """Copy ``source`` to a new file; datasets in ``sizes`` keep only these rows.

    sizes: number of first rows, or ranges. lost: called with the path of each unreadable object,
    which is skipped; None raises. processors: number of compressing threads. The copy stores the
    name of ``source``, which it will replace.
    """
    with (
        open_for_reading(source) as old,
        # From this format HDF5 protects its own structure by checksums (HDF5 1.10 or later).
        h5py.File(target, "x", libver=("v110", "v110"), locking=False) as new,
    ):
        _copy_attributes(old, new)
        new.attrs[FORM_ATTRIBUTE] = COMPRESSED
        new.attrs[FILE_NAME_ATTRIBUTE] = source.name
        for path, item in _items(old):
            if isinstance(item, h5py.Group):
                _copy_attributes(item, new.require_group(path))
                continue
            try:
                _copy_dataset(item, new, path, _ranges(sizes.get(path)), processors)
            except _DAMAGE:
                if lost is None:
                    raise
                lost(path)
        # By address: HDF5 would search the whole file for the name of a scale.
        scales: dict[int, str] = {}
        for path, item in _items(old):
            if isinstance(item, h5py.Dataset) and item.is_scale and path in new:
                scales[h5py.h5o.get_info(item.id).addr] = path
                name = scale_label(not is_bare(item), path.rpartition("/")[2], len(new[path]))
                new[path].make_scale(name)
        for path, item in _items(old):
            if isinstance(item, h5py.Dataset) and not item.is_scale and path in new:
                _attach_scales(item, new, path, scales)


def open_copy(copy: Path) -> h5py.File:
    """Open a copy that still has a hidden name, to complete it."""
    return h5py.File(copy, "r+", libver=("v110", "v110"), locking=False)


def first_difference(source: Path, copy: Path, sizes: Mapping[str, int]) -> str:
    """Return the path of the first dataset or attribute that differs in the copy, or ""."""
    with (
        open_for_reading(source) as old,
        open_for_reading(copy) as new,
    ):
        for path, item in _items(old):
            if path not in new:
                return path
            name = _differing_attribute(item, new[path])
            if name:
                return f"{path}@{name}"
            if isinstance(item, h5py.Dataset) and not _same(item, new[path], sizes.get(path)):
                return path
    return ""


def _items(file: h5py.File) -> Iterator[tuple[str, Any]]:
    names: list[str] = []
    file.visit(names.append)
    for name in names:
        yield f"/{name}", file[name]


def _copy_attributes(old: Any, new: Any) -> None:
    for name, value in old.attrs.items():
        if name not in SCALE_ATTRIBUTES:
            new.attrs[name] = value


def _ranges(kept: int | Ranges | None) -> Ranges | None:
    return [(0, kept)] if isinstance(kept, int) else kept


def _copy_dataset(
    old: h5py.Dataset, file: h5py.File, path: str, kept: Ranges | None, processors: int
) -> None:
    rows = None if kept is None else sum(stop - first for first, stop in kept)
    if is_bare(old):
        new = file.create_dataset(path, (len(old) if rows is None else rows,), old.dtype)
    elif kept is None or rows is None:
        new = file.create_dataset(path, data=old[()], dtype=old.dtype)
    else:
        shape = (rows, *old.shape[1:])
        new = file.create_dataset(path, shape, old.dtype, **_compression(old, rows))
        if rows and kept == [(0, rows)]:
            write_chunks(new, (old[part] for part in _pieces(old, 0, rows)), processors)
            kept = ()
        row = 0
        for first, stop in kept:
            for part in _pieces(old, first, stop):
                length = part.stop - part.start
                new[row : row + length] = old[part]
                row += length
    _copy_attributes(old, new)


def _compression(dataset: h5py.Dataset, rows: int) -> dict[str, Any]:
    if rows == 0:
        return {}
    row_bytes = max(1, dataset.nbytes // max(1, len(dataset)))
    chunk = max(1, min(rows, CHUNK_BYTES // row_bytes))
    return {
        "chunks": (chunk, *dataset.shape[1:]),
        "compression": "gzip",
        "compression_opts": GZIP_LEVEL,
        "shuffle": True,
        "fletcher32": True,
    }


def _pieces(dataset: h5py.Dataset, first: int, stop: int) -> Iterator[slice]:
    row_bytes = max(1, dataset.nbytes // max(1, len(dataset)))
    step = max(1, PIECE_BYTES // CHUNK_BYTES * (CHUNK_BYTES // row_bytes))
    for start in range(first, stop, step):
        yield slice(start, min(stop, start + step))


def _attach_scales(
    old: h5py.Dataset, file: h5py.File, path: str, scales: Mapping[int, str]
) -> None:
    for position, dimension in enumerate(old.dims):
        for scale in dimension.values():
            name = scales.get(h5py.h5o.get_info(scale.id).addr)
            if name is not None:
                file[path].dims[position].attach_scale(file[name])


def _differing_attribute(old: Any, new: Any) -> str:
    for name, value in old.attrs.items():
        if name in (*SCALE_ATTRIBUTES, FILE_NAME_ATTRIBUTE):
            continue
        if name not in new.attrs or not np.array_equal(new.attrs[name], value):
            return str(name)
    return ""


def _same(old: h5py.Dataset, new: h5py.Dataset, rows: int | None) -> bool:
    if old.dtype != new.dtype:
        return False
    if rows is None:
        before, after = np.asarray(old[()]), np.asarray(new[()])
        if before.dtype.kind == "O":
            return np.array_equal(before, after)
        return before.shape == after.shape and before.tobytes() == after.tobytes()
    if new.shape != (rows, *old.shape[1:]):
        return False
    if is_bare(old):
        return True
    return all(
        np.asarray(old[part]).tobytes() == np.asarray(new[part]).tobytes()
        for part in _pieces(old, 0, rows)
    )
