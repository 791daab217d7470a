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


THRESHOLDS = (700, 10, 10)
"""Allocations, and collections of the younger generation, until a collection: Python's own."""


def stop_automatic_collection() -> None:
    """Leave garbage collection to ``collect_when_due``, in a process with windows.

    An automatic collection may start inside a call of Qt that holds a lock: a widget that it
    deletes then waits for this lock, and the window hangs. In a worker thread it would delete the
    widgets of another thread.
    """
    gc.set_threshold(0)


def collect_when_due() -> None:
    """Collect the oldest generation that is due; call it between events, in the thread of Qt.

    While objects are loaded (``begin_to_load``) it does nothing.
    """
    if not gc.isenabled():
        return
    counts = gc.get_count()
    for generation in (2, 1, 0):
        if counts[generation] > THRESHOLDS[generation]:
            gc.collect(generation)
            return


def give_back() -> None:
    """Return freed memory to the operating system if the C library retains it, as glibc does."""
    with suppress(AttributeError, OSError, TypeError):
        ctypes.CDLL(None).malloc_trim(0)
