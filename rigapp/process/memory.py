"""Freeze start-up objects so that garbage collection pauses stay short.

Also return freed memory to the system.
"""

from __future__ import annotations

import ctypes
import gc
from contextlib import suppress


def begin_to_load() -> None:
    """Disable garbage collection while modules are loaded and a window is made.

    ``end_of_loading`` ends it.
    """
    gc.disable()


def end_of_loading() -> None:
    """Enable garbage collection, and freeze all objects made so far.

    A collection over the objects of all libraries stops a process for some 40 ms, again and again.
    """
    gc.freeze()
    gc.enable()


def give_back() -> None:
    """Return freed memory to the operating system where the C library keeps it, as glibc does."""
    with suppress(AttributeError, OSError, TypeError):
        ctypes.CDLL(None).malloc_trim(0)
