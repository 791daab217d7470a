"""Every text of a test file, wherever it stands: for whoever must know all that a file says."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import h5py
import numpy as np

LOG = "/entry/events"


def texts_of(file: h5py.File) -> Iterator[tuple[str, str]]:
    """Yield each text that is not empty with its path: of a dataset, or of an attribute.

    An attribute's path is that of its owner, ``@`` and its name. A text that stands several times
    in one dataset comes once. The log is left out: its lines are events.
    """
    found: list[h5py.HLObject] = [file]
    file.visititems(lambda _, one: found.append(one))
    for one in found:
        path = str(one.name)
        if path.startswith(f"{LOG}/"):
            continue
        if isinstance(one, h5py.Dataset) and h5py.check_string_dtype(one.dtype) is not None:
            yield from ((path, text) for text in _texts(one[()]))
        for name, value in one.attrs.items():
            yield from ((f"{path}@{name}", text) for text in _texts(value))


def _texts(value: Any) -> Iterator[str]:
    """Yield the different texts of a value, nothing of one that is none."""
    for one in dict.fromkeys(np.asarray(value).ravel().tolist()) if _is_text(value) else ():
        text = one.decode(errors="replace") if isinstance(one, bytes) else str(one)
        if text:
            yield text


def _is_text(value: Any) -> bool:
    array = np.asarray(value)
    if array.dtype.kind != "O":
        return array.dtype.kind in "SU"
    return all(isinstance(one, str | bytes) for one in array.ravel().tolist())
