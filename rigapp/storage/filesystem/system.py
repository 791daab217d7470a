"""The implementation of ``FileSystem`` on this system.

``posix`` is for Linux and macOS, ``portable`` uses the functions of every system; the latter is
taken on Windows, where modules of POSIX systems are missing, and when RIGAPP_FILES is "portable".
"""

from __future__ import annotations

import contextlib
import os
import sys

from rigapp.storage.filesystem.calls import FileSystem


def _chosen() -> FileSystem:
    if sys.platform != "win32" and os.environ.get("RIGAPP_FILES") != "portable":
        with contextlib.suppress(ImportError):
            from rigapp.storage.filesystem.posix import PosixFiles

            return PosixFiles()
    from rigapp.storage.filesystem.portable import PortableFiles

    return PortableFiles()


FILES = _chosen()
"""The implementation in use."""


def hold_writer_lock(fd: int) -> bool:
    """Mark an open file as being written by this process; False when another one does."""
    return FILES.hold(fd)
