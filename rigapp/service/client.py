"""Talk to a running engine: requests with a time-out, snapshots as they come."""

from __future__ import annotations

import threading
from typing import Any

import msgspec
import zmq

from rigapp.engine.messages import Reply, Request, Snapshot
from rigapp.service.registry import EngineEntry

SNAPSHOT_QUEUE = 64


class EngineUnreachable(Exception):
    """Say which engine did not answer, to what, within which time."""


class Client:
    """One viewer of one engine; ``poll`` and ``request`` may be called from different threads."""

    def __init__(self, entry: EngineEntry, operator: str = "") -> None:
        """Attach to the engine of an entry; nothing is sent yet."""
        self.entry = entry
        self._operator = operator
        self._context = zmq.Context()
        self._stream = self._context.socket(zmq.SUB)
        self._stream.setsockopt(zmq.RCVHWM, SNAPSHOT_QUEUE)
        self._stream.setsockopt(zmq.LINGER, 0)
        self._stream.setsockopt(zmq.SUBSCRIBE, b"")
        self._stream.connect(entry.snapshots)
        self._lock = threading.Lock()
        self._identifier = 0
        self._closed = False

    def poll(self) -> Snapshot | None:
        """Return what came since the last call, merged into one snapshot, or None."""
        newest: Snapshot | None = None
        rows: list[bytes] = []
        predictions: list[bytes] = []
        first_row = 0
        while not self._closed:
            try:
                body = self._stream.recv(zmq.NOBLOCK)
            except zmq.Again:
                break
            snapshot = msgspec.msgpack.decode(body, type=Snapshot)
            if not rows:
                first_row = snapshot.first_row
            rows.append(snapshot.rows)
            predictions.append(snapshot.predictions)
            newest = _with_newest_curves(snapshot, newest)
        if newest is None:
            return None
        return msgspec.structs.replace(
            newest, first_row=first_row, rows=b"".join(rows), predictions=b"".join(predictions)
        )

    def request(
        self, verb: str, arguments: dict[str, Any] | None = None, timeout_s: float = 5.0
    ) -> Reply:
        """Ask the engine and wait for the answer; raise EngineUnreachable after timeout_s."""
        with self._lock:
            self._identifier += 1
            request = Request(
                verb=verb,
                arguments=arguments or {},
                operator=self._operator,
                identifier=self._identifier,
            )
        socket = self._context.socket(zmq.REQ)
        socket.setsockopt(zmq.LINGER, 0)
        socket.setsockopt(zmq.IMMEDIATE, 1)
        socket.setsockopt(zmq.SNDTIMEO, max(1, int(1000 * timeout_s)))
        try:
            socket.connect(self.entry.commands)
            socket.send(msgspec.msgpack.encode(request))
            if not socket.poll(int(1000 * timeout_s)):
                raise EngineUnreachable(
                    f"The engine (process {self.entry.pid}) did not answer {verb!r} within"
                    f" {timeout_s:g} s; is it still running?"
                )
            return msgspec.msgpack.decode(socket.recv(), type=Reply)
        except zmq.ZMQError as error:
            raise EngineUnreachable(
                f"The engine (process {self.entry.pid}) cannot be reached for {verb!r}: {error}."
            ) from error
        finally:
            socket.close()

    def close(self) -> None:
        """Detach; the engine goes on."""
        self._closed = True
        self._stream.close()
        self._context.destroy(linger=0)


def _with_newest_curves(snapshot: Snapshot, older: Snapshot | None) -> Snapshot:
    """Keep the curves of an older snapshot where the newer one brings none."""
    if older is None:
        return snapshot
    return msgspec.structs.replace(
        snapshot,
        cycle=snapshot.cycle or older.cycle,
        prediction=snapshot.prediction or older.prediction,
    )
