"""Who writes a file: locks that the kernel drops when the writer dies, and that stop no reader.

Two locks are held by a writer. A byte-range lock of the open file description, far beyond the data,
marks the writer as alive and keeps a second one out. A shared ``flock`` makes HDF5 refuse to open
the file for writing (it asks for an exclusive one), while readers (shared) pass.

Without POSIX locks no test is written. Whether one is being written elsewhere is then told by the
process that the file names.
"""

from __future__ import annotations

import contextlib
import errno
import os
import re
import socket
import struct
import sys
from pathlib import Path
from typing import Any

try:
    import fcntl as _fcntl
except ImportError:  # not a POSIX system
    _fcntl = None  # type: ignore[assignment]

LOCK_OFFSET = 1 << 62  # beyond any data
_FLOCK = "hhqqi0q"
fcntl: Any = _fcntl
_OFD = sys.platform == "linux" and hasattr(fcntl, "F_OFD_SETLK")
_WRITER = re.compile(r"process (\d+) on (.+)")


def hold_writer_lock(fd: int) -> bool:
    """Take the writer's locks on an open file; False when another writer has them.

    Where the system has no such locks nobody is kept away, and they are taken.
    """
    if fcntl is None:
        return True
    try:
        if _OFD:
            fcntl.fcntl(fd, fcntl.F_OFD_SETLK, _record(fcntl.F_WRLCK))
        else:
            fcntl.lockf(fd, fcntl.LOCK_EX | fcntl.LOCK_NB, 1, LOCK_OFFSET)
    except OSError as error:
        if error.errno in (errno.EAGAIN, errno.EACCES):
            return False
        if error.errno not in (errno.ENOLCK, errno.EOPNOTSUPP, errno.EINVAL):
            raise
    with contextlib.suppress(OSError):
        fcntl.flock(fd, fcntl.LOCK_SH | fcntl.LOCK_NB)
    return True


def writer_is_alive(path: Path, named: str = "") -> bool:
    """Tell whether a process holds the writer's lock on a file.

    named: the writer as the file names it, ``process N on HOST``, for systems without such locks.
    """
    if fcntl is None:
        return _lives(named)
    fd = os.open(path, os.O_RDONLY)
    try:
        if _OFD:
            answer = fcntl.fcntl(fd, fcntl.F_OFD_GETLK, _record(fcntl.F_WRLCK))
            return bool(struct.unpack(_FLOCK, answer)[0] != fcntl.F_UNLCK)
        try:
            fcntl.lockf(fd, fcntl.LOCK_SH | fcntl.LOCK_NB, 1, LOCK_OFFSET)
        except OSError as error:
            return error.errno in (errno.EAGAIN, errno.EACCES)
        return False
    except OSError as error:
        if error.errno in (errno.ENOLCK, errno.EOPNOTSUPP, errno.EINVAL):
            return False
        raise
    finally:
        os.close(fd)


def _lives(named: str) -> bool:
    import psutil

    found = _WRITER.fullmatch(named)
    return (
        found is not None
        and found[2] == socket.gethostname()
        and bool(psutil.pid_exists(int(found[1])))
    )


def _record(kind: int) -> bytes:
    return struct.pack(_FLOCK, kind, os.SEEK_SET, LOCK_OFFSET, 1, 0)
