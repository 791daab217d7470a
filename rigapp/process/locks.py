"""A lock on a file that one process holds, and the system releases when that process dies."""

from __future__ import annotations

import sys


def taken(descriptor: int) -> bool:
    """Take the lock of an open file without waiting; False where another one has it.

    Where the system has no such locks it always counts as taken.
    """
    if sys.platform == "win32":
        return True
    try:
        import fcntl
    except ImportError:
        return True
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True
