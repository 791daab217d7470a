"""Give disk space inside a file back to the system, where that is possible (Linux)."""

from __future__ import annotations

import ctypes
import sys
from functools import cache
from typing import Any

KEEP_SIZE = 1
PUNCH_HOLE = 2
"""Flags of Linux's fallocate(2)."""


def punch_hole(fd: int, offset: int, length: int) -> bool:
    """Let a range of an open file read as zeros and take no space; False where nothing was done."""
    call = _fallocate()
    return call is not None and call(fd, KEEP_SIZE | PUNCH_HOLE, offset, length) == 0


@cache
def _fallocate() -> Any:
    if sys.platform != "linux":
        return None
    library = ctypes.CDLL(None)
    call = getattr(library, "fallocate64", None) or getattr(library, "fallocate", None)
    if call is not None:
        call.argtypes = (ctypes.c_int, ctypes.c_int, ctypes.c_int64, ctypes.c_int64)
    return call
