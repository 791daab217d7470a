"""Open an HDF5 file for reading, whoever else has it open and however."""

from __future__ import annotations

from pathlib import Path

import h5py


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
