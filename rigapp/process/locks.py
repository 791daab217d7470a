"""A file lock held by one process, which the system releases when the process ends."""

from __future__ import annotations

import sys


def taken(descriptor: int) -> bool:
    """Acquire the lock of an open file without waiting; return False if another process has it.

    Always True on systems without such locks.
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
