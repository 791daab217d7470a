"""Record the traffic on a line: the reader of the port appends to a list, a thread writes the file.

Communication with the device never waits for the disk. The file size is bounded: at its limit it
becomes ``FILE.1`` (kept, as it contains the set-up of the device) or ``FILE.2``, and a new one
begins.
"""

from __future__ import annotations

import enum
import logging
import threading
import time
from collections import deque
from collections.abc import Collection, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, BinaryIO, Final

from rigapp_drivers.wire.trace import MAGIC, RecordKind, encode_note, encode_record

LIMIT_BYTES: Final = 64 << 20
"""Limit of each of the at most three files; 4 minutes of a GSV-8 at its full rate."""
_MOST_WAITING: Final = 16 << 20  # buffer for a disk that is blocked for a minute at that rate
_WRITE_S: Final = 0.2  # data of this period may be lost when the program is killed

_log = logging.getLogger(__name__)


class WireRecorder:
    """Record one line into a file, from any thread; a write error ends the recording.

    path: an earlier recording there is kept, and this one gets a name with a number. header: first
    record of the file (device, driver, settings, protocol).
    """

    def __init__(
        self, path: Path, header: Mapping[str, Any], limit_bytes: int = LIMIT_BYTES
    ) -> None:
        self.path = path
        self._header = dict(header)
        self._limit = limit_bytes
        self._waiting: deque[tuple[RecordKind, int, bytes]] = deque()
        self._bytes = 0
        self._dropped = 0
        self._file: BinaryIO | None = None
        self._failed = False
        self._begun = False
        self._number = 1
        self._ending = threading.Event()
        self._thread: threading.Thread | None = None
        self._guard = threading.Lock()

    def sent(self, data: bytes) -> None:
        """Record bytes sent to the device."""
        self._add(RecordKind.SENT, data)

    def received(self, data: bytes) -> None:
        """Record bytes received from the device."""
        self._add(RecordKind.RECEIVED, data)

    def note(self, content: Mapping[str, Any]) -> None:
        """Record a note on the line."""
        with self._guard:
            now_ns = time.monotonic_ns()
            encoded = encode_note(now_ns, content)
            self._waiting.append((RecordKind.NOTE, now_ns, encoded))
            self._bytes += len(encoded)
        self._run()

    def close(self) -> None:
        """Write the buffer and close the file; later records are appended."""
        thread = self._thread
        if thread is None:
            return
        self._ending.set()
        thread.join(2.0)

    def _add(self, kind: RecordKind, data: bytes) -> None:
        if self._failed or not data:
            return
        with self._guard:
            if self._bytes > _MOST_WAITING:
                self._dropped += len(data)
                return
            # Read the clock inside the lock, so that the times in the file never decrease.
            self._waiting.append((kind, time.monotonic_ns(), data))
            self._bytes += len(data)
        if self._thread is None:
            self._run()

    def _run(self) -> None:
        with self._guard:
            if self._thread is not None or self._failed:
                return
            self._ending = threading.Event()
            self._thread = threading.Thread(
                target=self._write_on, args=(self._ending,), name="wire recorder", daemon=True
            )
            self._thread.start()

    def _write_on(self, ending: threading.Event) -> None:
        try:
            ended = False
            while not ended:
                ended = ending.wait(_WRITE_S)
                self._write_waiting()
        except OSError as error:
            self._failed = True
            _log.warning("%s: the line is no longer recorded (%s)", self.path, error.strerror)
        finally:
            file, self._file = self._file, None
            if file is not None:
                file.close()
            with self._guard:
                self._thread = None
        if self._waiting and not self._failed:
            self._run()

    def _write_waiting(self) -> None:
        with self._guard:
            waiting, self._waiting = self._waiting, deque()
            dropped, self._dropped = self._dropped, 0
            self._bytes = 0
        if not waiting:
            return
        parts = [
            data if kind is RecordKind.NOTE else encode_record(kind, at, data)
            for kind, at, data in waiting
        ]
        if dropped:
            parts.append(encode_note(time.monotonic_ns(), {"not_recorded_bytes": dropped}))
        file = self._open()
        file.write(b"".join(parts))
        file.flush()
        if file.tell() >= self._limit:
            self._rotate(file)

    def _open(self) -> BinaryIO:
        if self._file is None:
            if not self._begun:
                self._begin()
                self._begun = True
            self._file = self.path.open("ab")
        return self._file

    def _begin(self) -> None:
        self.path.parent.mkdir(parents=True, exist_ok=True)
        if self._number == 1:
            self.path = _unused(self.path)
        started = {"started": datetime.now(UTC).isoformat(timespec="seconds")}
        # Who reads a recording while it is made never finds it without its beginning.
        part = self.path.with_name(f".{self.path.name}.part")
        try:
            part.write_bytes(MAGIC + encode_note(time.monotonic_ns(), self._header | started))
            part.replace(self.path)
        finally:
            part.unlink(missing_ok=True)

    def _rotate(self, file: BinaryIO) -> None:
        file.close()
        self._file, self._begun = None, False
        number, self._number = self._number, 2
        self.path.replace(self.path.with_name(f"{self.path.name}.{number}"))


def _unused(path: Path) -> Path:
    """Return the path, with a number if a file of an earlier recording has its name."""
    number, one = 1, path
    while any(one.with_name(one.name + end).exists() for end in ("", ".1", ".2")):
        number += 1
        one = path.with_name(f"{path.stem}-{number}{path.suffix}")
    return one


class RecordedFor(enum.Enum):
    """Purpose of a recording: set by the user, or for an error report."""

    SETTING = "setting"
    REPORT = "report"


_RECORDERS: dict[tuple[str, str], dict[RecordedFor, WireRecorder]] = {}


def record_line(
    device: str,
    port: str,
    recorder: WireRecorder | None,
    purpose: RecordedFor = RecordedFor.SETTING,
) -> None:
    """Start recording the line of a device on a port; None: stop it for this purpose."""
    kept = {**_RECORDERS.get((device, port), {}), purpose: recorder}
    # Replace the table in one step, as the line's thread reads it concurrently.
    _RECORDERS[device, port] = {key: value for key, value in kept.items() if value is not None}


def recorders_of(device: str, port: str) -> Collection[WireRecorder]:
    """Return the active recorders of a device on a port, often none."""
    return _RECORDERS.get((device, port), {}).values()
