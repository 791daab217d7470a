"""A recorded line as pyserial opens it: ``wire://FILE``, a port on which the recording answers."""

from __future__ import annotations

import threading
import time
from pathlib import Path
from typing import Any, Final

from serial.serialutil import PortNotOpenError, SerialBase, SerialException

from rigapp_drivers.wire.player import Player
from rigapp_drivers.wire.trace import TraceError, read_trace

SCHEME: Final = "wire://"
_LOOK_S: Final = 0.001
_ENDED_S: Final = 0.5  # by then the driver has taken what came last


class Serial(SerialBase):  # type: ignore[misc]
    """Play a recording; the names are pyserial's."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        self._player: Player | None = None
        self._buffer = b""
        self._ended_s = 0.0
        self._lock = threading.RLock()
        options.pop("exclusive", None)
        super().__init__(*arguments, **options)

    def open(self) -> None:
        """Begin to play from the start; raise SerialException."""
        path = Path(str(self.portstr).removeprefix(SCHEME))
        try:
            trace = read_trace(path)
        except TraceError as error:
            raise SerialException(str(error)) from error
        self._player = Player(trace, time.monotonic())
        self.is_open = True

    def close(self) -> None:
        """Play no longer."""
        self._player, self.is_open = None, False

    @property
    def in_waiting(self) -> int:
        """Return how many bytes have come."""
        with self._lock:
            self._take()
            return len(self._buffer)

    def read(self, size: int = 1) -> bytes:
        """Return up to size bytes, within the time-out."""
        deadline = None if self._timeout is None else time.monotonic() + self._timeout
        parts: list[bytes] = []
        missing = size
        while missing:
            with self._lock:
                self._take()
                part, self._buffer = self._buffer[:missing], self._buffer[missing:]
            parts.append(part)
            missing -= len(part)
            if missing and deadline is not None and time.monotonic() >= deadline:
                break
            if missing:
                time.sleep(_LOOK_S)
        return b"".join(parts)

    def write(self, data: bytes) -> int:
        """Ask the recording."""
        with self._lock:
            self._take()
            self._playing().write(bytes(data), time.monotonic())
        return len(data)

    def flush(self) -> None:
        """Do nothing: all is sent at once."""

    def reset_input_buffer(self) -> None:
        """Forget what has come."""
        with self._lock:
            self._take()
            self._buffer = b""

    def reset_output_buffer(self) -> None:
        """Do nothing: all is sent at once."""

    def _reconfigure_port(self, force_update: bool = False) -> None:
        """Do nothing: a recording has no speed."""

    def _playing(self) -> Player:
        if self._player is None:
            raise PortNotOpenError
        return self._player

    def _take(self) -> None:
        player, now_s = self._playing(), time.monotonic()
        self._buffer += player.read(now_s)
        if self._buffer or not player.ended(now_s):
            self._ended_s = now_s
        elif now_s - self._ended_s > _ENDED_S:
            raise SerialException("the recording ends here")
