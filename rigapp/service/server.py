"""Serve an engine over ZeroMQ: commands with a reply, and a stream of snapshots.

Commands arrive on a ROUTER socket and are answered in the order in which they finish; a slow one
(connect, start) never delays another (stop). At most ``PENDING`` are under way; further ones are
answered "busy". Snapshots leave on an XPUB socket with a short queue: a viewer that lags loses the
oldest, and sees the gap in ``Snapshot.first_row``; ``Server.watched`` tells whether anyone looks.
"""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import msgspec
import zmq

from rigapp.engine.messages import PROTOCOL_VERSION, Reply, Request, Snapshot

PENDING = 16
SNAPSHOT_QUEUE = 4
PUBLISH_PERIOD_S = 0.05
POLL_MS = 10

Handler = Callable[[Request], Reply]
Source = Callable[[], Snapshot]


class Server:
    """Answer requests and publish snapshots from one supervised thread."""

    def __init__(self, handler: Handler, snapshots: Source, commands: str, stream: str) -> None:
        """Bind at once, so that the addresses are known; ``start`` begins to serve."""
        self._handler = handler
        self._snapshots = snapshots
        self._context = zmq.Context()
        self._router = self._context.socket(zmq.ROUTER)
        self._publisher = self._context.socket(zmq.XPUB)
        for socket in (self._router, self._publisher):
            socket.setsockopt(zmq.LINGER, 200)
            socket.setsockopt(zmq.SNDHWM, SNAPSHOT_QUEUE if socket is self._publisher else 100)
        self._router.bind(commands)
        self._publisher.bind(stream)
        self.commands = self._router.getsockopt_string(zmq.LAST_ENDPOINT)
        self.stream = self._publisher.getsockopt_string(zmq.LAST_ENDPOINT)
        self._replies: queue.Queue[tuple[bytes, bytes]] = queue.Queue()
        self._under_way = 0
        self._stop = threading.Event()
        self._workers = ThreadPoolExecutor(max_workers=PENDING, thread_name_prefix="request")
        self._thread = threading.Thread(target=self._serve, name="service", daemon=True)
        self.watched = False
        self.failure: BaseException | None = None

    def start(self) -> None:
        """Begin to serve."""
        self._thread.start()

    def close(self) -> None:
        """Publish the last snapshot, answer what is under way, release the sockets."""
        self._stop.set()
        if self._thread.is_alive():
            self._thread.join(timeout=5.0)
        self._workers.shutdown(wait=False, cancel_futures=True)
        self._context.destroy(linger=200)

    @property
    def alive(self) -> bool:
        """Tell whether the serving thread lives."""
        return self._thread.is_alive()

    def _serve(self) -> None:
        try:
            poller = zmq.Poller()
            poller.register(self._router, zmq.POLLIN)
            poller.register(self._publisher, zmq.POLLIN)
            clock = _Period(PUBLISH_PERIOD_S)
            while not self._stop.is_set():
                ready = dict(poller.poll(POLL_MS))
                if self._router in ready:
                    self._accept()
                if self._publisher in ready:
                    self.watched = self._publisher.recv()[:1] == b"\x01"
                self._send_replies()
                if clock.due():
                    self._publish()
            self._publish()
            self._send_replies()
        except BaseException as error:
            self.failure = error
            raise

    def _accept(self) -> None:
        frames = self._router.recv_multipart()
        sender, body = frames[0], frames[-1]
        try:
            request = msgspec.msgpack.decode(body, type=Request)
        except (msgspec.DecodeError, msgspec.ValidationError) as error:
            self._answer(sender, Reply(ok=False, sentence=f"The request is not readable: {error}."))
            return
        if request.version != PROTOCOL_VERSION:
            sentence = (
                f"This engine speaks version {PROTOCOL_VERSION} of the protocol, the request is of"
                f" version {request.version}; use the same rigapp on both sides."
            )
            self._answer(sender, Reply(ok=False, sentence=sentence, identifier=request.identifier))
            return
        if self._under_way >= PENDING:
            sentence = f"The engine is busy with {PENDING} requests; ask again."
            self._answer(sender, Reply(ok=False, sentence=sentence, identifier=request.identifier))
            return
        self._under_way += 1
        self._workers.submit(self._work, sender, request)

    def _work(self, sender: bytes, request: Request) -> None:
        try:
            reply = self._handler(request)
        except Exception as error:
            reply = Reply(ok=False, sentence=f"{type(error).__name__}: {error}")
        reply = msgspec.structs.replace(reply, identifier=request.identifier)
        self._replies.put((sender, msgspec.msgpack.encode(reply)))

    def _send_replies(self) -> None:
        while True:
            try:
                sender, body = self._replies.get_nowait()
            except queue.Empty:
                return
            self._under_way -= 1
            self._router.send_multipart([sender, b"", body])

    def _answer(self, sender: bytes, reply: Reply) -> None:
        self._router.send_multipart([sender, b"", msgspec.msgpack.encode(reply)])

    def _publish(self) -> None:
        self._publisher.send(msgspec.msgpack.encode(self._snapshots()), zmq.NOBLOCK)


class _Period:
    """Tell when the next of a row of equally spaced moments has come."""

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self._next = time.monotonic()

    def due(self) -> bool:
        """Return True once a period."""
        now = time.monotonic()
        if now < self._next:
            return False
        self._next = max(self._next + self._seconds, now)
        return True
