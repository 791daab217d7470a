"""Compute the digest of the data that a test file fixes before its first row.

It covers the path, type and attributes of every group and dataset, and the values of those that no
writer changes later: settings, records, versions, axes. It excludes what differs in the compressed
copy: the file's name and form, and the attachment of dimensions in HDF5.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from typing import Any

import h5py
import numpy as np

from rigapp.storage.structure.hdf import is_bare
from rigapp.storage.structure.layout import (
    END_TIME,
    FILE_NAME_ATTRIBUTE,
    FORM_ATTRIBUTE,
    STATE,
    FilePlan,
    streams_of,
)

SCALE_ATTRIBUTES = frozenset(
    ("CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "DIMENSION_LABELS")
)
"""Attributes that mark a dimension scale or attach a dataset to one."""
SEAL = "/entry/seal"
_UNCOVERED = SCALE_ATTRIBUTES | {FILE_NAME_ATTRIBUTE, FORM_ATTRIBUTE}


def settings_digest(file: h5py.File, plan: FilePlan) -> bytes:
    """Return the hexadecimal SHA-256 of the fixed data of an open file."""
    changing = {END_TIME}
    for stream in streams_of(plan).values():
        changing.update(stream.path(field.name) for field in stream.stored)
        if stream.counter:
            changing.add(stream.path(stream.counter))
    total = hashlib.sha256()
    for part in _parts("/", file, values=False):
        _add(total, part)
    names: list[str] = []
    file.visit(names.append)
    for path in sorted(f"/{name}" for name in names):
        if path == SEAL or path.startswith((f"{STATE}/", f"{SEAL}/")):
            continue
        for part in _parts(path, file[path], path not in changing):
            _add(total, part)
    return total.hexdigest().encode()


def _add(total: Any, part: bytes) -> None:
    """Add a part preceded by its length, so that different lists of parts give different bytes."""
    total.update(len(part).to_bytes(8, "little") + part)


def _parts(path: str, item: Any, values: bool) -> Iterator[bytes]:
    """Yield the covered bytes of one object."""
    yield path.encode()
    if isinstance(item, h5py.Dataset):
        yield f"{item.dtype.str} {item.shape[1:]}".encode()
        if values and not is_bare(item):
            yield _bytes_of(item[()])
    for name in sorted(item.attrs):
        if name not in _UNCOVERED and not name.startswith("_Netcdf4"):
            yield name.encode()
            yield _bytes_of(item.attrs[name])


def _bytes_of(value: Any) -> bytes:
    if isinstance(value, str):
        return value.encode()
    array = np.asarray(value)
    if array.dtype.kind == "O":
        texts = (text if isinstance(text, bytes) else str(text).encode() for text in array.flat)
        return b"".join(len(text).to_bytes(8, "little") + text for text in texts)
    return f"{array.dtype.str} {array.shape}".encode() + array.tobytes()
