"""Find and remove files of killed processes by the process id in their names."""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import stat
from pathlib import Path

import psutil

from rigapp.texts import joined


def process_alive(pid: int) -> bool:
    """Return whether a process exists (a zombie counts as dead)."""
    try:
        return bool(psutil.Process(pid).status() != psutil.STATUS_ZOMBIE)
    except psutil.NoSuchProcess:
        return False
    except psutil.AccessDenied:
        return True


def pid_exists(pid: int) -> bool:
    """Return whether the process with an id from a file name may still run.

    A process that is no Python program has reused the id.
    """
    if not process_alive(pid):
        return False
    try:
        line = joined(" ", psutil.Process(pid).cmdline()).lower()
    except psutil.Error:
        return True
    return not line or "python" in line or "rigapp" in line


def find_stale(folder: Path, pattern: str) -> list[tuple[Path, re.Match[str]]]:
    """Return this user's files whose process has ended, with the match of the name.

    pattern: of the whole name, with a group ``pid``.
    """
    result = []
    with contextlib.suppress(OSError):
        for entry in os.scandir(folder):
            match = re.fullmatch(pattern, entry.name)
            if match is not None and _abandoned(entry, int(match["pid"])):
                result.append((Path(entry.path), match))
    return result


def remove_left_behind(folder: Path, pattern: str) -> list[Path]:
    """Remove the results of ``find_stale``, folders with their content; return the paths."""
    removed = [path for path, _ in find_stale(folder, pattern)]
    for path in removed:
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path, ignore_errors=True)
        else:
            with contextlib.suppress(OSError):
                path.unlink()
    return removed


def _abandoned(entry: os.DirEntry[str], pid: int) -> bool:
    try:
        status = entry.stat(follow_symlinks=False)
    except OSError:
        return False
    if stat.S_ISLNK(status.st_mode) or (hasattr(os, "getuid") and status.st_uid != os.getuid()):
        return False
    return not pid_exists(pid)
