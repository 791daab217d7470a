"""Collect garbage without a stop that is felt: what a start has made is never searched again.

And give memory back that is free.
"""

from __future__ import annotations

import ctypes
import gc
from contextlib import suppress


def begin_to_load() -> None:
    """Search for no garbage while modules are loaded and a window is made: they leave hardly any.

    ``end_of_loading`` ends it.
    """
    gc.disable()


def end_of_loading() -> None:
    """Search for garbage from now on, but only among what is made after this moment.

    A search of all that the libraries have made stops a process for some 40 ms, again and again.
    """
    gc.freeze()
    gc.enable()


def give_back() -> None:
    """Return freed memory to the operating system where the C library keeps it, as glibc does."""
    with suppress(AttributeError, OSError, TypeError):
        ctypes.CDLL(None).malloc_trim(0)
