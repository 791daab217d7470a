"""Keep the computer awake by an inhibitor lock of systemd's logind.

The lock is held by a process that reads its standard input, so that it ends with this program in
any case. Without systemd-inhibit there is no lock, and the caller can report it.
"""

from __future__ import annotations

import select
import shutil
import subprocess
import threading
from contextlib import suppress
from typing import Final

from rigapp.process.ending import Background
from rigapp.texts import say

HOLDER: Final = "systemd-inhibit"
_KINDS: Final = ("sleep:idle:handle-lid-switch", "sleep:idle", "sleep")
"""Locks to try, the strongest first: logind does not allow every user to inhibit the lid switch."""
_HELD_S: Final = 5.0  # logind replies within a few ms; do not wait for a hanging bus
_ECHO: Final = b"held\n"


class StayAwake:
    """Keep the computer awake from ``begin`` to ``end``; any thread may call both."""

    def __init__(self) -> None:
        self._changing = threading.Lock()
        self._wanted = False
        self._holder: subprocess.Popen[bytes] | None = None

    def begin(self) -> None:
        """Acquire the lock in the background; no error if it is not possible."""
        self._wanted = True
        Background(self.hold, say("stay awake"))

    def hold(self) -> str:
        """Acquire the lock and return its kind, empty for none."""
        with self._changing:
            if self._holder is not None or shutil.which(HOLDER) is None:
                return ""
            for kinds in _KINDS:
                holder = _hold(kinds)
                if holder is not None:
                    self._holder = holder
                    break
            else:
                kinds = ""
        if not self._wanted:
            self.end()
        return kinds

    def end(self) -> None:
        """Release the lock."""
        self._wanted = False
        with self._changing:
            holder, self._holder = self._holder, None
        if holder is not None:
            _release(holder)


def kept_awake() -> str:
    """Return the kind of lock available here, by a trial; empty for none."""
    trial = StayAwake()
    try:
        return trial.hold()
    finally:
        trial.end()


def _hold(kinds: str) -> subprocess.Popen[bytes] | None:
    """Return a holder process after its echo has confirmed the lock."""
    words = [f"--what={kinds}", "--who=rigapp", "--why=A wear test runs", "--mode=block", "cat"]
    try:
        holder = subprocess.Popen(
            [HOLDER, *words],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
    except OSError:
        return None
    assert holder.stdin is not None
    assert holder.stdout is not None
    with suppress(OSError):
        holder.stdin.write(_ECHO)
        holder.stdin.flush()
        if select.select([holder.stdout], [], [], _HELD_S)[0] and holder.stdout.read(1):
            return holder
    _release(holder)
    return None


def _release(holder: subprocess.Popen[bytes]) -> None:
    for pipe in (holder.stdin, holder.stdout):
        assert pipe is not None
        with suppress(OSError):
            pipe.close()
    try:
        holder.wait(_HELD_S)
    except subprocess.TimeoutExpired:
        holder.kill()
        holder.wait()
