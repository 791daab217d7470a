"""Serve an engine over ZeroMQ: commands with a reply, and a stream of snapshots.

Commands arrive on a ROUTER socket and are answered in the order in which they finish; each safety
verb has its own threads (``verbs``, ``RequestQueue``), so that slow requests do not delay it.
Excess requests are answered "busy"; unreadable ones are answered, too.
Snapshots are sent on a second ROUTER socket to every viewer that sent an empty message, with a
short queue for each: a slow viewer misses some, and sees the gap in ``Snapshot.first_row``. A PUB
socket is not used, since it stores every subscribed topic without a bound. ``Server.watched``
returns whether a viewer is attached. With keys, viewers without an authorised key have no access.
"""

from __future__ import annotations

import logging
import math
import queue
import socket as os_socket
import threading
import time
from collections import Counter
from collections.abc import Callable, Collection, Iterable
from contextlib import suppress
from pathlib import Path

import msgspec
import psutil
import zmq
from zmq.utils.monitor import recv_monitor_message

from rigapp.config.errors import UnusableInput
from rigapp.process.memory import give_back
from rigapp.schema.messages import PROTOCOL_VERSION, Reply, Request, Snapshot
from rigapp.schema.states import Refused
from rigapp.schema.verbs import Priority, verb_of
from rigapp.schema.wire import encode
from rigapp.service.bounds import MESSAGE_BYTES, bounded, refusal
from rigapp.service.registry import other_version
from rigapp.service.security import KeyCheck
from rigapp.texts import say, sentence_of_error

# Receive the messages of viewers, and end connections that use unlimited memory.
#
# libzmq holds the parts of a message until the last one arrives, and limits neither their number
# nor their sum: ``MAXMSGSIZE`` limits one part, ``RCVHWM`` counts complete messages. A program that
# implements ZMTP and never ends its message filled 500 MB in 0.8 s. The growth of the process is
# therefore monitored, and connections are ended at the level of the operating system: libzmq frees
# their memory, and a regular viewer among them reconnects automatically.

GROWTH_BYTES = 100_000_000
"""Limit of the growth in memory; an engine grows by 15 MB up to a running test, and then stays."""
PARTS = 8
"""Maximum number of parts of a message; a request has two or three, each received in 1 us."""
SETTLE_S = 1.0
"""Time for libzmq, which frees the parts in a separate thread; quick requests end meanwhile."""
LOOKS, LOOK_S = 10, 0.002
"""Looks at the unread data of a connection, and the time between them. libzmq reads faster than
many a program sends, so that a single look finds nothing; it reads a request within one."""

log = logging.getLogger(__name__)
Socket = zmq.Socket[bytes]


class Connections:
    """Connections of some sockets; to be used only by the thread that serves them."""

    def __init__(self, sockets: Iterable[Socket]) -> None:
        """Start to monitor sockets, before they are bound."""
        events = zmq.EVENT_ACCEPTED | zmq.EVENT_DISCONNECTED
        self._monitors = [socket.get_monitor_socket(events) for socket in sockets]
        self._accepted_s: dict[int, float] = {}  # of each connection's handle
        self._process = psutil.Process()
        self._usual = self._process.memory_info().rss
        self._grown_s = math.inf  # time at which the growth was noticed
        self._settled_s = math.inf

    def receive(self, socket: Socket) -> list[bytes]:
        """Return sender and body of the next message, empty for one that needs no answer.

        A message of too many parts is ignored, and its sender's connection ended while it keeps
        sending. Raises zmq.Again when no message is waiting.
        """
        first = frame = socket.recv(zmq.NOBLOCK, copy=False)
        parts = 1
        while frame.more:
            frame = socket.recv(copy=False)
            parts += 1
        if parts <= PARTS:
            return [first.bytes, frame.bytes]
        self._note(time.monotonic())
        handle = int(frame.get(zmq.SRCFD))
        if _sends(handle):  # still the sender's: another connection may have reused the handle
            log.warning("a message of %d parts: its sender's connection is ended", parts)
            self._end({handle})
        return []

    def bound_memory(self, now_s: float, *, busy: bool) -> None:
        """End connections when the process has grown: those that are sending, then older ones.

        A connection that was accepted after the growth was noticed did not cause it: its request
        is answered. busy: a request is being executed, which may need the memory.
        """
        self._note(now_s)
        used = self._process.memory_info().rss
        if used > self._usual + GROWTH_BYTES:
            give_back()
            used = self._process.memory_info().rss
        self._usual = min(self._usual, used)
        if used < self._usual + GROWTH_BYTES:
            self._grown_s = math.inf
            return
        if self._grown_s == math.inf:
            self._grown_s, self._settled_s = now_s, now_s + SETTLE_S
        guilty = _senders(self._accepted_s)
        if not guilty and not busy and now_s > self._settled_s:
            guilty = {one for one, since_s in self._accepted_s.items() if since_s < self._grown_s}
            self._settled_s = now_s + SETTLE_S
            if not guilty:  # none of them uses the memory
                self._usual, self._grown_s = used, math.inf
        if guilty:
            log.warning("grown to %.0f MB: %d connections are ended", used / 1e6, len(guilty))
            self._end(guilty)

    def _note(self, now_s: float) -> None:
        """Record new and ended connections."""
        for monitor in self._monitors:
            while monitor.poll(0):
                event = recv_monitor_message(monitor)
                if event["event"] == zmq.EVENT_ACCEPTED:
                    self._accepted_s[event["value"]] = now_s
                else:
                    self._accepted_s.pop(event["value"], None)

    def _end(self, handles: set[int]) -> None:
        for handle in handles & self._accepted_s.keys():
            with suppress(OSError):
                connection = os_socket.socket(fileno=handle)
                try:
                    connection.shutdown(os_socket.SHUT_RDWR)
                finally:
                    connection.detach()  # libzmq closes it


def _senders(handles: Collection[int]) -> set[int]:
    """Return the connections that keep sending; takes a fiftieth of a second."""
    seen = Counter[int]()
    for _ in range(LOOKS):
        seen.update(handle for handle in handles if _sends(handle))
        time.sleep(LOOK_S)
    return {handle for handle, looks in seen.items() if looks > 1}


def _sends(handle: int) -> bool:
    """Return whether a connection has unread data, which is rare for a viewer."""
    try:
        connection = os_socket.socket(fileno=handle)
    except OSError:
        return False
    try:
        return bool(connection.recv(1, os_socket.MSG_PEEK))
    except OSError:
        return False
    finally:
        connection.detach()


UNDER_WAY = {Priority.SAFETY: 4, Priority.LOOK: 16, Priority.WORK: 16}
"""Number of concurrent requests: of each safety verb, and of each other priority."""

REQUEST_QUEUE = 100  # of each connection: 6.4 MB at most
SNAPSHOT_QUEUE = 4  # a slow viewer needs only the newest
SUBSCRIPTION = b""
"""Message of a viewer that subscribes to snapshots, the only one accepted on their socket."""
SUBSCRIPTION_BYTES = 1024  # a CurveZMQ handshake takes about 300
VIEWERS = 64
"""Maximum number of viewers of snapshots; a rig has a few windows and a page."""
PUBLISH_PERIOD_S = 0.05  # smooth live values
MEMORY_PERIOD_S = 0.05  # a quick sender on this computer fills 90 MB meanwhile
EARLY_PERIOD_S = 0.1
"""Period in which two snapshots are sent early: of a revolution that has just ended, and of its
prediction. A real rig is slower; a faster simulated one is limited by this period."""
CLOSE_S = 5.0  # for running requests; a handler that takes longer is abandoned
LINGER_MS = 200  # longest time for sending the last snapshot

Handler = Callable[[Request], Reply]
Source = Callable[[], Snapshot]


class _Head(msgspec.Struct, frozen=True):
    """Common part of all versions of a request, sufficient to answer another version."""

    version: int = 0
    identifier: int = 0


class RequestQueue:
    """Run each request in a thread, up to the number of threads of its priority.

    They are daemon threads, so that a hanging one does not keep the process from ending.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._under_way: dict[str, int] = {}

    @property
    def busy(self) -> bool:
        """Return whether a request is being executed."""
        with self._lock:
            return any(self._under_way.values())

    def submit(self, verb: str, job: Callable[[], None]) -> str:
        """Start a job of a verb; return why it cannot be started, empty on success."""
        lane = verb_of(verb).lane
        name = verb if lane is Priority.SAFETY else lane.value
        bound = UNDER_WAY[lane]
        with self._lock:
            if self._under_way.get(name, 0) >= bound:
                return say("The engine is busy with {} requests of this kind; ask again.", bound)
            self._under_way[name] = self._under_way.get(name, 0) + 1
        thread = threading.Thread(
            target=self._carry_out, args=(name, job), name=f"request {verb[:32]}", daemon=True
        )
        try:
            thread.start()
        except RuntimeError as error:
            self._leave(name)
            return say("The engine's request queue is full ‹{}›; try again.", error)
        return ""

    def _carry_out(self, name: str, job: Callable[[], None]) -> None:
        try:
            job()
        finally:
            self._leave(name)

    def _leave(self, name: str) -> None:
        with self._lock:
            self._under_way[name] -= 1


class Server:
    """Answer requests and publish snapshots from one supervised thread."""

    def __init__(
        self,
        handler: Handler,
        snapshots: Source,
        commands: str,
        stream: str,
        keys: Path | None = None,
        on_failure: Callable[[str], None] = lambda sentence: None,
        on_viewers: Callable[[bool], None] = lambda watched: None,
        waits: Callable[[], bool] = lambda: False,
    ) -> None:
        """Bind immediately, so that the addresses are known; ``start`` begins to serve.

        on_failure: called in the serving thread when viewers get no snapshots, or nothing at all.
        on_viewers: called when the first viewer attaches and when the last one has detached.
        waits: returns whether there is data that must be sent immediately, after a call of
        ``wake``. keys: folder with the keys, if viewers must authenticate. Raises UnusableInput
        when an address is unavailable.
        """
        self._handler = handler
        self._on_failure = on_failure
        self._on_viewers = on_viewers
        self._waits = waits
        self._failure_reported = False
        self._wake = Wake()
        self._snapshots = snapshots
        self._context = zmq.Context()
        self._key_check = KeyCheck(self._context, keys) if keys is not None else None
        self._router = self._context.socket(zmq.ROUTER)
        self._publisher = self._context.socket(zmq.ROUTER)
        self._publisher.setsockopt(zmq.ROUTER_MANDATORY, 1)  # sending to a lost viewer raises
        for socket, size, waiting in (
            (self._router, MESSAGE_BYTES, REQUEST_QUEUE),
            (self._publisher, SUBSCRIPTION_BYTES, SNAPSHOT_QUEUE),
        ):
            socket.setsockopt(zmq.LINGER, LINGER_MS)
            socket.setsockopt(zmq.MAXMSGSIZE, size)
            socket.setsockopt(zmq.SNDHWM, waiting)
            socket.setsockopt(zmq.RCVHWM, waiting)
            if self._key_check is not None:
                self._key_check.protect(socket)
        self._connections = Connections((self._router, self._publisher))
        self._bind(self._router, commands)
        self._bind(self._publisher, stream)
        self.commands = self._router.getsockopt_string(zmq.LAST_ENDPOINT)
        self.stream = self._publisher.getsockopt_string(zmq.LAST_ENDPOINT)
        self._replies: queue.Queue[tuple[bytes, bytes]] = queue.Queue()
        self._lanes = RequestQueue()
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._serve, name="service", daemon=True)
        self._viewers: set[bytes] = set()
        self.failure: BaseException | None = None

    @property
    def public_key(self) -> str:
        """Return the key that viewers need, empty if none is needed."""
        return self._key_check.public_key if self._key_check is not None else ""

    def start(self) -> None:
        """Start to serve."""
        self._thread.start()

    def wake(self) -> None:
        """Send a waiting reply or new data now; may be called from any thread, never waits."""
        self._wake.set()

    def close(self) -> None:
        """Publish the last snapshot, answer running requests, release the sockets."""
        self._stop.set()
        self.wake()
        if self._thread.is_alive():
            self._thread.join(timeout=CLOSE_S)
        self._release()

    def _bind(self, socket: zmq.Socket[bytes], address: str) -> None:
        try:
            socket.bind(address)
        except zmq.ZMQError as error:
            self._release()
            raise UnusableInput(
                "The engine cannot listen at {} ‹{}›; choose another address or port.",
                address,
                error,
            ) from error

    def _release(self) -> None:
        if self._key_check is not None:
            self._key_check.close()
        self._context.destroy(linger=LINGER_MS)
        self._wake.close()

    @property
    def alive(self) -> bool:
        """Return whether the serving thread is alive."""
        return self._thread.is_alive()

    def _serve(self) -> None:
        try:
            poller = zmq.Poller()
            poller.register(self._router, zmq.POLLIN)
            poller.register(self._publisher, zmq.POLLIN)
            poller.register(self._wake, zmq.POLLIN)
            clock, haste = _Period(PUBLISH_PERIOD_S), _RateLimit(EARLY_PERIOD_S)
            watch = _Period(MEMORY_PERIOD_S)
            while not self._stop.is_set():
                ready = dict(poller.poll(math.ceil(1000.0 * min(clock.left_s(), watch.left_s()))))
                self._wake.clear()
                if self._router in ready:
                    self._accept()
                if self._publisher in ready:
                    self._subscribe()
                self._send_replies()
                if watch.due():
                    self._connections.bound_memory(time.monotonic(), busy=self._lanes.busy)
                if clock.due() or (self._waits() and haste.allowed(time.monotonic())):
                    self._publish()
            self._publish()
            self._send_replies()
        except BaseException as error:
            self.failure = error
            self._on_failure(say("The part that serves windows has stopped ‹{}›.", repr(error)))
            raise

    @property
    def watched(self) -> bool:
        """Return whether a viewer is attached."""
        return bool(self._viewers)

    def _subscribe(self) -> None:
        """Add the sender of an empty message to the viewers, and ignore every other message."""
        message = self._connections.receive(self._publisher)
        if not message:
            return
        sender, body = message
        if body == SUBSCRIPTION and len(self._viewers) < VIEWERS:
            self._viewers.add(sender)
            if len(self._viewers) == 1:
                self._note_viewers()

    def _note_viewers(self) -> None:
        try:
            self._on_viewers(self.watched)
        except Exception as error:
            self._on_failure(say("A window could not be attached ‹{}›.", repr(error)))

    def _accept(self) -> None:
        try:
            message = self._connections.receive(self._router)
        except zmq.Again:
            return
        if not message:
            return
        sender, body = message
        identifier = 0
        # Any error: no message may end the thread that receives "stop".
        try:
            head = msgspec.msgpack.decode(body, type=_Head)
            identifier = head.identifier
            if head.version == PROTOCOL_VERSION:
                request = bounded(msgspec.msgpack.decode(body, type=Request))
                why_not = self._lanes.submit(request.verb, lambda: self._work(sender, request))
            else:  # a plain string for an older viewer
                why_not = str(other_version(PROTOCOL_VERSION, head.version))
        except Refused as error:
            why_not = sentence_of_error(error)
        except Exception as error:
            why_not = say("The request cannot be read ‹{}›.", error)
        if why_not:
            body = encode(refusal(why_not, identifier))
            self._router.send_multipart([sender, b"", body])

    def _work(self, sender: bytes, request: Request) -> None:
        try:
            reply = self._handler(request)
            reply = msgspec.structs.replace(reply, identifier=request.identifier)
            body = encode(reply)
        except Exception as error:
            body = encode(
                refusal(say("The engine failed to do this ‹{}›.", repr(error)), request.identifier)
            )
        self._replies.put((sender, body))
        self.wake()

    def _send_replies(self) -> None:
        while True:
            try:
                sender, body = self._replies.get_nowait()
            except queue.Empty:
                return
            self._router.send_multipart([sender, b"", body])

    def _publish(self) -> None:
        try:
            body = encode(self._snapshots())
        except Exception as error:
            if not self._failure_reported:
                self._failure_reported = True
                self._on_failure(say("No snapshot could be made for windows ‹{}›.", repr(error)))
            return
        lost = set()
        for viewer in self._viewers:
            try:
                self._publisher.send_multipart([viewer, body], zmq.NOBLOCK)
            except zmq.Again:
                continue  # its queue is full
            except zmq.ZMQError:
                lost.add(viewer)
        if lost:
            self._viewers -= lost
            if not self._viewers:
                self._note_viewers()


class Wake:
    """A flag that ends the waiting of a thread in ``zmq.Poller``: a byte in a pair of sockets."""

    def __init__(self) -> None:
        self._here, self._there = os_socket.socketpair()
        for end in (self._here, self._there):
            end.setblocking(False)

    def fileno(self) -> int:
        """Return the handle to wait for."""
        return self._here.fileno()

    def set(self) -> None:
        """End the waiting; may be called from any thread, also after ``close``."""
        with suppress(OSError):  # full: the flag is set
            self._there.send(b"\0")

    def clear(self) -> None:
        """Clear the flag."""
        with suppress(BlockingIOError):
            while self._here.recv(4096):
                pass

    def close(self) -> None:
        """Close the pair."""
        self._here.close()
        self._there.close()


class _Period:
    """Timer for periodic actions."""

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self._next = time.monotonic()

    def left_s(self) -> float:
        """Return the time until the next period."""
        return max(0.0, self._next - time.monotonic())

    def due(self) -> bool:
        """Return True once a period."""
        now = time.monotonic()
        if now < self._next:
            return False
        self._next = max(self._next + self._seconds, now)
        return True


class _RateLimit:
    """Limit an action to two in a period."""

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self._last = self._before = -math.inf

    def allowed(self, now: float) -> bool:
        """Return whether the action is allowed now, and count it; now: s of any clock."""
        if now - self._before < self._seconds:
            return False
        self._before, self._last = self._last, now
        return True
