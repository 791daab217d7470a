"""Logging of the program: level, terminal and files.

Modules write to ``logging.getLogger(__name__)`` only. Writers never wait: a slow disk or a stalled
terminal loses log lines, not samples.
"""

from __future__ import annotations

import errno
import logging
import logging.handlers
import os
import queue
import stat
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from io import TextIOWrapper
from pathlib import Path

from rigapp.config.errors import UnusableInput
from rigapp.texts import joined, say

LEVELS = ("debug", "info", "warning", "error")
LEVEL_VARIABLE = "RIGAPP_LOG_LEVEL"
"""Environment variable that passes the level to child processes."""

OWN = ("rigapp", "rigapp_drivers", "rigapp_model", "rigapp_calibration")
MOST_WAITING = 1000  # lines; more come only from a malfunction
LARGEST_FILE = 1_000_000
"""Maximum bytes of a log file; one previous file is kept."""
LAST_WORDS_S = 2.0
"""Maximum wait at the end for unwritten lines."""

_FORMAT = "%(asctime)s %(levelname)-7s %(name)s: %(message)s"


class BoundedQueueHandler(logging.Handler):
    """Pass records to a handler in a separate thread; a full queue drops new records."""

    def __init__(self, target: logging.Handler, name: str) -> None:
        super().__init__(target.level)
        self._target = target
        self._waiting: queue.Queue[logging.LogRecord | None] = queue.Queue(MOST_WAITING)
        self._thread = threading.Thread(target=self._write, name=f"log to {name}", daemon=True)
        self._thread.start()

    def emit(self, record: logging.LogRecord) -> None:
        """Queue a record with its text formatted now; never waits, never raises.

        Records of other packages are kept from level warning.
        """
        if record.levelno < logging.WARNING and record.name.partition(".")[0] not in OWN:
            return
        with suppress(Exception):
            message = logging.makeLogRecord({**record.__dict__, "msg": record.getMessage()})
            message.args = None
            self._waiting.put_nowait(message)

    def close(self) -> None:
        """Write the queue, waiting at most ``LAST_WORDS_S``."""
        with suppress(queue.Full):
            self._waiting.put(None, timeout=LAST_WORDS_S)
        self._thread.join(LAST_WORDS_S)
        super().close()

    def _write(self) -> None:
        while (record := self._waiting.get()) is not None:
            with suppress(Exception):
                self._target.handle(record)
        # A lost disk fails again here for the last lines.
        with suppress(Exception):
            self._target.close()


class _Terminal(logging.StreamHandler):  # type: ignore[type-arg]
    """Standard error as it is at the moment of writing."""

    def emit(self, record: logging.LogRecord) -> None:
        self.stream = sys.stderr
        super().emit(record)

    def handleError(self, record: logging.LogRecord) -> None:
        """Do nothing: the terminal is closed."""


class _File(logging.handlers.RotatingFileHandler):
    """A file of limited size, created by the first record."""

    def __init__(self, path: Path) -> None:
        super().__init__(path, maxBytes=LARGEST_FILE, backupCount=1, encoding="utf-8", delay=True)

    def _open(self) -> TextIOWrapper:
        """Open the file, but not through a link or a pipe of another user."""
        flags = os.O_WRONLY | os.O_CREAT | os.O_APPEND
        for name in ("O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC"):
            flags |= getattr(os, name, 0)
        fd = os.open(self.baseFilename, flags, 0o666)
        if not stat.S_ISREG(os.fstat(fd).st_mode):
            os.close(fd)
            raise OSError(errno.EINVAL, say("this is no file"), self.baseFilename)
        return TextIOWrapper(open(fd, "ab"), encoding="utf-8")

    def handleError(self, record: logging.LogRecord) -> None:
        """Do nothing: a failed write to the log must not end a test."""


def chosen_level(option: str | None) -> str:
    """Return the level of an option, else of the environment, else "warning".

    Raises UnusableInput.
    """
    level = (option or os.environ.get(LEVEL_VARIABLE) or "warning").lower()
    if level not in LEVELS:
        raise UnusableInput(
            "--log-level {}: choose {} or {}.", level, joined(", ", LEVELS[:-1]), LEVELS[-1]
        )
    return level


@contextmanager
def on_terminal(level: str) -> Iterator[None]:
    """Log records from a level to standard error in this context; children inherit the level."""
    os.environ[LEVEL_VARIABLE] = level
    terminal = _Terminal()
    terminal.setLevel(level.upper())
    terminal.setFormatter(logging.Formatter("rigapp: %(levelname)s: %(message)s"))
    with _attached(terminal, say("the terminal")):
        yield


@contextmanager
def in_file(path: Path) -> Iterator[None]:
    """Log records from "info", or from a lower chosen level, to a file in this context."""
    file = _File(path)
    file.setLevel(min(logging.INFO, getattr(logging, chosen_level(None).upper())))
    file.setFormatter(logging.Formatter(_FORMAT))
    with _attached(file, path.name):
        yield


def log_beside(result: Path) -> Path:
    """Return the log file of a result file."""
    return result.with_suffix(".log")


@contextmanager
def _attached(target: logging.Handler, name: str) -> Iterator[None]:
    """Attach a handler to the root logger in this context."""
    outlet = BoundedQueueHandler(target, name)
    logging.getLogger().addHandler(outlet)
    _listen()
    try:
        yield
    finally:
        logging.getLogger().removeHandler(outlet)
        _listen()
        outlet.close()


def _listen() -> None:
    """Set the root logger's level to the lowest of its handlers."""
    root = logging.getLogger()
    levels = [
        handler.level for handler in root.handlers if isinstance(handler, BoundedQueueHandler)
    ]
    root.setLevel(min(levels, default=logging.WARNING))
