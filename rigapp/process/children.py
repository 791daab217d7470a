"""Processes that the program starts of itself: their command line and how they begin."""

from __future__ import annotations

import subprocess
import sys
from typing import IO


def module_command(module: str, *arguments: object) -> list[str]:
    """Return the command line that runs a module of the program.

    ``-P`` keeps the working folder off the import path: there a user's ``signal.py`` or
    ``model.py`` would be imported in place of Python's or the program's own module.
    """
    return [sys.executable, "-P", "-m", module, *map(str, arguments)]


def start_module(
    module: str,
    *arguments: object,
    stdin: int = subprocess.DEVNULL,
    stdout: int | IO[bytes] = subprocess.DEVNULL,
    stderr: int | IO[bytes] = subprocess.DEVNULL,
    environment: dict[str, str] | None = None,
) -> subprocess.Popen[bytes]:
    """Start a module of the program as a process of its own.

    In a session of its own: Ctrl-C at the terminal is for whoever started it, who decides what
    becomes of it. environment: instead of the own one.
    """
    return subprocess.Popen(
        module_command(module, *arguments),
        stdin=stdin,
        stdout=stdout,
        stderr=stderr,
        env=environment,
        start_new_session=True,
    )
