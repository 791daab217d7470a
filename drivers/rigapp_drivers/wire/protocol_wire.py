"""pyserial handler of ``wire://FILE``: a port on which a recorded line replies."""

from __future__ import annotations

import logging
import threading
import time
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

from serial.serialutil import PortNotOpenError, SerialBase, SerialException

from rigapp_drivers.wire.trace import RecordKind, TraceError, WireRecord, WireTrace, read_trace

# Play a recorded line as a device: find each request in the recording and return its reply.
#
# Replies keep their recorded delay. A stream continues past recorded requests that are not
# repeated; a reply is returned only to its own request.

_STREAM_S: Final = 0.02  # a long reply arrives within this time
_STREAM_BYTES: Final = 300  # longer than any reply of a serial device
_PATIENCE_S: Final = 0.5  # wait for a request that the recording has at this time

_log = logging.getLogger(__name__)


@dataclass(slots=True)
class Turn:
    """One request and the bytes received until the next one, with their delays in s."""

    sent: bytes
    time_ns: int
    received: list[tuple[float, bytes]] = field(default_factory=list)

    @property
    def length(self) -> int:
        """Return the number of received bytes."""
        return sum(len(data) for _, data in self.received)

    @property
    def streams(self) -> bool:
        """Return whether the received bytes are a stream rather than a reply."""
        last_s = self.received[-1][0] if self.received else 0.0
        return last_s > _STREAM_S and self.length > _STREAM_BYTES


def turns_of(records: Sequence[WireRecord]) -> list[Turn]:
    """Return the exchanges; the first has no request, only the bytes received before any."""
    turns = [Turn(b"", records[0].time_ns if records else 0)]
    for record in records:
        if record.kind is RecordKind.SENT:
            turns.append(Turn(record.data, record.time_ns))
        elif record.kind is RecordKind.RECEIVED:
            turns[-1].received.append(((record.time_ns - turns[-1].time_ns) / 1e9, record.data))
    return turns


class Player:
    """Reply from a recording. Times in s of any monotonic clock.

    unknown: requests without a recorded reply, in order of arrival.
    """

    def __init__(self, trace: WireTrace, now_s: float) -> None:
        self._trace = trace
        self._turns = turns_of(trace.records)
        self._text = trace.header.get("protocol") == "slcan"
        self._coming: deque[tuple[float, bytes]] = deque()
        self.unknown: list[bytes] = []
        self._turn = 0
        self._since_s = now_s
        streams = [index for index, turn in enumerate(self._turns) if turn.streams]
        self._last_stream = streams[-1] if streams else -1
        self._begin(0, now_s)

    def write(self, data: bytes, now_s: float) -> None:
        """Process bytes from the driver and schedule the recorded reply."""
        index = self._find(data)
        if index is None:
            # python-can opens the adapter; these bytes do not reach the bus.
            if not (self._text and data[:1] not in (b"t", b"T")):
                self.unknown.append(data)
                _log.warning(
                    "%s: the recording has no answer to %s", self._trace.path, data.hex(" ")
                )
            return
        skipped = self._turns[self._turn + 1 : index] if index > self._turn else []
        left = [data for _, data in self._coming] if self._turns[self._turn].streams else []
        left += [part for turn in skipped if turn.streams for _, part in turn.received]
        self._coming.clear()
        self._coming.extend((now_s, part) for part in left)
        self._begin(index, now_s)

    def read(self, now_s: float) -> bytes:
        """Return the bytes that are due."""
        self._skip_requests(now_s)
        parts = []
        while self._coming and self._coming[0][0] <= now_s:
            parts.append(self._coming.popleft()[1])
        return b"".join(parts)

    def ended(self, now_s: float) -> bool:
        """Return whether a recorded stream is over."""
        self._skip_requests(now_s)
        return 0 <= self._last_stream <= self._turn and not self._coming

    def _find(self, data: bytes) -> int | None:
        """Return the index of the next turn with this request, else of the last one before."""
        after = range(self._turn + 1, len(self._turns))
        before = range(self._turn, 0, -1)
        for index in (*after, *before):
            if self._turns[index].sent == data:
                return index
        return None

    def _begin(self, index: int, now_s: float) -> None:
        self._turn, self._since_s = index, now_s
        self._coming.extend((now_s + at, data) for at, data in self._turns[index].received)

    def _skip_requests(self, now_s: float) -> None:
        """Continue a stream past recorded requests that are not repeated."""
        while not self._coming and self._turn < self._last_stream:
            now, then = self._turns[self._turn], self._turns[self._turn + 1]
            due_s = self._since_s + (then.time_ns - now.time_ns) / 1e9
            if not now.streams or now_s < due_s + _PATIENCE_S:
                return
            self._begin(self._turn + 1, due_s)


SCHEME: Final = "wire://"
_POLL_S: Final = 0.001
_ENDED_S: Final = 0.5  # by then the driver has read the last bytes


class Serial(SerialBase):  # type: ignore[misc]
    """Play a recording; the method names are pyserial's."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        self._player: Player | None = None
        self._buffer = b""
        self._ended_s = 0.0
        self._lock = threading.RLock()
        options.pop("exclusive", None)
        super().__init__(*arguments, **options)

    def open(self) -> None:
        """Play from the start; raise SerialException."""
        path = Path(str(self.portstr).removeprefix(SCHEME))
        try:
            trace = read_trace(path)
        except TraceError as error:
            raise SerialException(str(error)) from error
        self._player = Player(trace, time.monotonic())
        self.is_open = True

    def close(self) -> None:
        """Stop playing."""
        self._player, self.is_open = None, False

    @property
    def in_waiting(self) -> int:
        """Return the number of bytes waiting."""
        with self._lock:
            self._take()
            return len(self._buffer)

    def read(self, size: int = 1) -> bytes:
        """Return up to size bytes within the time-out."""
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
                time.sleep(_POLL_S)
        return b"".join(parts)

    def write(self, data: bytes) -> int:
        """Pass a request to the recording."""
        with self._lock:
            self._take()
            self._playing().write(bytes(data), time.monotonic())
        return len(data)

    def flush(self) -> None:
        """Do nothing: writes are not buffered."""

    def reset_input_buffer(self) -> None:
        """Discard the bytes waiting."""
        with self._lock:
            self._take()
            self._buffer = b""

    def reset_output_buffer(self) -> None:
        """Do nothing: writes are not buffered."""

    def _reconfigure_port(self, force_update: bool = False) -> None:
        """Do nothing: a recording has no baud rate."""

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
