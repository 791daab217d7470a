"""Open an HDF5 file for reading, whoever else has it open and however; tell what is no data."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path

import h5py

from rigapp.config.errors import UnusableInput

NOT_A_VARIABLE = "This is a netCDF dimension but not a netCDF variable. "
"""How netCDF marks a dimension without coordinates; its length follows in ten characters."""


def open_for_reading(path: Path) -> h5py.File:
    """Open a file for reading; raises OSError.

    HDF5's own default of locking is the first choice; the others where the file system has no
    locks, or where this process has the file open already by another choice: all must agree.
    """
    for locking in (None, False):
        try:
            return h5py.File(path, "r", locking=locking)
        except OSError as error:
            if "lock" not in str(error):
                raise
    return h5py.File(path, "r", locking=True)


@contextlib.contextmanager
def telling_damage(path: Path, what: str) -> Iterator[None]:
    """Raise UnusableInput where a block cannot make sense of what it reads in a file.

    what: the place in the file. HDF5 and NumPy raise one of many errors, as the damage wants.
    """
    try:
        yield
    except (OSError, RuntimeError, LookupError, ValueError, TypeError, MemoryError) as error:
        raise UnusableInput(
            f"{path}: the file is damaged, {what} cannot be read ‹{error}›; "
            "take a copy made before, and check the disk"
        ) from error


def is_bare(dataset: h5py.Dataset) -> bool:
    """Tell whether a dataset is a dimension without coordinates."""
    name = dataset.attrs.get("NAME", b"")
    return bool(name.startswith(NOT_A_VARIABLE.encode()))
