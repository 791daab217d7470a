"""The client of a running engine: requests with a time-out, and a stream of snapshots.

A client that has control sends a heartbeat every ``HEARTBEAT_S`` from a separate thread, until it
releases control, loses it or is closed.
"""

from __future__ import annotations

import threading
import uuid
from collections.abc import Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import msgspec
import zmq

from rigapp.schema.messages import (
    FLAT_STATUS,
    NO_TEST,
    PROTOCOL_VERSION,
    Reply,
    Request,
    Snapshot,
    Status,
)
from rigapp.schema.verbs import verb_of
from rigapp.schema.wire import decode, encode, tree_of
from rigapp.service.registry import EngineEntry, lasting_folder, other_version
from rigapp.texts import SentenceError, say

if TYPE_CHECKING:
    from rigapp.service.security import KeyPair

SNAPSHOT_QUEUE = 64  # three seconds of a busy window
NEWEST = ("cycle", "prediction", "profile")
"""Fields of which only the newest value is kept."""
HEARTBEAT_S = 2.0  # short enough that one lost heartbeat does not release control


class EngineUnreachable(SentenceError):
    """Raised when an engine does not answer; the sentence names engine, request and time-out."""


class Client:
    """One viewer of one engine; ``poll`` and ``request`` may be called from different threads."""

    def __init__(self, entry: EngineEntry, operator: str = "", *, look: bool = True) -> None:
        """Attach to the engine of an entry without sending anything.

        look: receive snapshots as a viewer; without it ``poll`` returns None. Raises
        EngineUnreachable when the entry has another version of the protocol, and UnusableInput when
        the engine requires a key and this viewer's cannot be used.
        """
        if entry.version not in (PROTOCOL_VERSION, *FLAT_STATUS):
            raise EngineUnreachable(other_version(entry.version, PROTOCOL_VERSION))
        self.entry = entry
        self.identity = uuid.uuid4().hex
        self._keys = _viewer_keys(entry)
        self.operator = operator
        self._context = zmq.Context()
        self._stream = self._context.socket(zmq.DEALER)
        self._stream.setsockopt(zmq.RCVHWM, SNAPSHOT_QUEUE)
        self._stream.setsockopt(zmq.LINGER, 0)
        # Each new connection starts with an empty message, which requests snapshots.
        self._stream.setsockopt(zmq.PROBE_ROUTER, 1)
        self._stream.setsockopt(zmq.IMMEDIATE, 1)
        self._show_keys(self._stream)
        if look:
            self._stream.connect(entry.snapshots)
        self._lock = threading.Lock()
        self._identifier = 0
        self._closed = False
        self._held: Snapshot | None = None
        self._leave = threading.Event()
        self._presence: threading.Thread | None = None

    @property
    def handle(self) -> int:
        """Return the handle that becomes readable when ``poll`` may have news (ZMQ_FD)."""
        return int(self._stream.fileno())

    def poll(self) -> Snapshot | None:
        """Return the snapshots since the last call, merged into one, or None.

        Rows are merged only if they are contiguous: rows after a gap, or of another file, are left
        for the next call, so that ``first_row`` shows the gap.
        """
        parts: list[Snapshot] = []
        while not self._closed:
            snapshot = self._held or self._receive()
            self._held = None
            if snapshot is None:
                break
            if parts and not joins(parts, snapshot):
                self._held = snapshot
                break
            parts.append(snapshot)
        return merged(parts) if parts else None

    def _receive(self) -> Snapshot | None:
        try:
            body = self._stream.recv(zmq.NOBLOCK)
        except zmq.Again:
            return None
        snapshot = self._snapshot(body)
        return msgspec.structs.replace(snapshot, status=snapshot.status.shown())

    def _snapshot(self, body: bytes) -> Snapshot:
        if self.entry.version not in FLAT_STATUS:
            return decode(body, Snapshot)
        tree = decode(body, dict[str, Any])
        status = Status.of_tree(tree["status"])
        return msgspec.convert({**tree, "status": tree_of(status)}, Snapshot)

    def request(
        self, verb: str, arguments: dict[str, Any] | None = None, timeout_s: float | None = None
    ) -> Reply:
        """Send a request and return the reply; raises EngineUnreachable after timeout_s.

        timeout_s: if None, that of ``VERBS``.
        """
        reply = self._request(verb, arguments, timeout_s or verb_of(verb).timeout_s)
        if verb == "status" and reply.ok:
            shown = Status.of_tree(reply.result).shown().engine.state
            reply = msgspec.structs.replace(reply, result={**reply.result, "state": shown})
        if verb == "take_command" and reply.ok:
            self._start_heartbeat()
        if verb == "release_command" and reply.ok:
            self._leave.set()
        return reply

    def hello(self, timeout_s: float = 5.0) -> None:
        """Check that the engine answers in this protocol; raises EngineUnreachable."""
        reply = self.request("hello", timeout_s=timeout_s)
        if not reply.ok:
            raise EngineUnreachable(reply.sentence)

    def _request(self, verb: str, arguments: dict[str, Any] | None, timeout_s: float) -> Reply:
        with self._lock:
            self._identifier += 1
            request = Request(
                verb=verb,
                arguments=arguments or {},
                operator=self.operator,
                identifier=self._identifier,
                client=self.identity,
                version=self.entry.version,
            )
        socket = self._context.socket(zmq.REQ)
        socket.setsockopt(zmq.LINGER, 0)
        socket.setsockopt(zmq.IMMEDIATE, 1)
        socket.setsockopt(zmq.SNDTIMEO, max(1, int(1000 * timeout_s)))
        try:
            self._show_keys(socket)
            socket.connect(self.entry.commands)
            socket.send(encode(request))
            if not socket.poll(int(1000 * timeout_s)):
                raise EngineUnreachable(
                    "The engine did not answer within {:g} s; is it still running?"
                    " ‹process {}, request {}›",
                    timeout_s,
                    self.entry.pid,
                    verb,
                )
            return decode(socket.recv(), Reply)
        except zmq.Again as error:
            raise EngineUnreachable(
                "The engine could not be reached within {:g} s{}. ‹process {}, request {}›",
                timeout_s,
                self._key_advice(),
                self.entry.pid,
                verb,
            ) from error
        except zmq.ZMQError as error:
            raise EngineUnreachable(
                "The engine cannot be reached; is it still running? ‹process {}, request {}: {}›",
                self.entry.pid,
                verb,
                error,
            ) from error
        finally:
            socket.close()

    def close(self) -> None:
        """Detach; the engine continues."""
        self._closed = True
        self._leave.set()
        if self._presence is not None and self._presence is not threading.current_thread():
            self._presence.join(timeout=2.0 * HEARTBEAT_S)
        self._stream.close()
        self._context.destroy(linger=0)

    def _show_keys(self, socket: zmq.Socket[bytes]) -> None:
        if self._keys is not None:
            from rigapp.service.security import present_keys

            present_keys(socket, self.entry.server_key, self._keys)

    def _key_advice(self) -> str:
        if self._keys is None:
            return say("; is it still running?")
        return say(
            "; if it is running, the public key in {} is not among its authorised"
            " viewers, or its own key has changed",
            lasting_folder() / "keys" / "viewer.key",
        )

    def _start_heartbeat(self) -> None:
        with self._lock:
            if (
                self._presence is not None
                and self._presence.is_alive()
                and not self._leave.is_set()
            ):
                return
            self._leave = threading.Event()
            self._presence = threading.Thread(
                target=self._send_heartbeats, args=(self._leave,), name="in-command", daemon=True
            )
            self._presence.start()

    def _send_heartbeats(self, leave: threading.Event) -> None:
        while not leave.wait(HEARTBEAT_S):
            with suppress(EngineUnreachable):
                reply = self._request("present", None, verb_of("present").timeout_s)
                if reply.ok and not reply.result["in_command"]:
                    return


def _viewer_keys(entry: EngineEntry) -> KeyPair | None:
    if not entry.server_key:
        return None
    from rigapp.service.security import viewer_keys

    return viewer_keys(lasting_folder())


def joins(parts: Sequence[Snapshot], following: Snapshot) -> bool:
    """Return whether a snapshot follows others without a gap: same file, contiguous rows."""
    last = next((part for part in reversed(parts) if part.rows), None)
    if _file(following) != _file(parts[-1]):
        return False
    if last is None or not following.rows:
        return True
    return following.first_row == last.first_row + len(last.rows) // (8 * len(last.columns))


def _file(snapshot: Snapshot) -> str:
    return (snapshot.status.test or NO_TEST).file


def merged(parts: Sequence[Snapshot]) -> Snapshot:
    """Merge contiguous snapshots: all rows and predictions, the newest value of other fields."""
    with_rows = next((part for part in parts if part.rows), parts[-1])

    def newest(name: str) -> Any:
        return next((result for part in reversed(parts) if (result := getattr(part, name))), None)

    return msgspec.structs.replace(
        parts[-1],
        first_row=with_rows.first_row,
        rows=b"".join(part.rows for part in parts),
        predictions=b"".join(part.predictions for part in parts),
        **{name: newest(name) for name in NEWEST},
    )
