"""Freeze start-up objects so that garbage collection pauses stay short.

Also return freed memory to the system.
"""

from __future__ import annotations

import ctypes
import gc
from contextlib import suppress


def begin_to_load() -> None:
    """Disable garbage collection while modules are loaded and a window is created.

    ``end_of_loading`` ends it.
    """
    gc.disable()


def end_of_loading() -> None:
    """Enable garbage collection, and freeze all objects made so far.

    Each collection of the objects of all libraries would pause a process for about 40 ms.
    """
    gc.freeze()
    gc.enable()


def give_back() -> None:
    """Return freed memory to the operating system if the C library retains it, as glibc does."""
    with suppress(AttributeError, OSError, TypeError):
        ctypes.CDLL(None).malloc_trim(0)
