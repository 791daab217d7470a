"""The window's connection to the engine: attach, detect silence, reconnect; requests."""

from __future__ import annotations

import enum
import logging
import time
from collections.abc import Callable
from contextlib import suppress
from typing import Any, Protocol

from rigapp.presentation.translation import Text
from rigapp.schema.details import error_text
from rigapp.schema.messages import Reply, Snapshot, Status
from rigapp.schema.verbs import verb_of
from rigapp.texts import say
from rigapp.viewer.tasks import TaskWorker

ASK_EVERY_S = 2.0  # a lost control is shown within two glances at the screen


class CommandHolder(enum.Enum):
    """The holder of control, as seen from this window."""

    NOBODY = "nobody"
    THIS = "this window"
    OTHER = "another viewer"


class CommandWatch:
    """Track who has control. A name is not enough, for two viewers may have the same one.

    Whenever the name changes, and every two seconds while a viewer has control, the engine is asked
    whether it is this one.
    """

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._requested_at = -ASK_EVERY_S
        self._mine = False
        self.name = ""

    @property
    def holder(self) -> CommandHolder:
        """Return the holder."""
        if not self.name:
            return CommandHolder.NOBODY
        return CommandHolder.THIS if self._mine else CommandHolder.OTHER

    def take_name(self, name: str) -> bool:
        """Take the name in the engine's status; return whether to ask whose it is."""
        now = self._clock()
        if name != self.name:
            self.name = name
            self._mine = False
            self._requested_at = -ASK_EVERY_S
        if not name or now - self._requested_at < ASK_EVERY_S:
            return False
        self._requested_at = now
        return True

    def answered(self, reply: Reply) -> None:
        """Take the engine's answer to ``present``."""
        result = reply.result
        if reply.ok and isinstance(result, dict):
            self._mine = bool(result.get("in_command"))

    def forget(self) -> None:
        """Reset: another engine may answer next."""
        self.name, self._mine = "", False
        self._requested_at = -ASK_EVERY_S


log = logging.getLogger(__name__)

SILENT_AFTER_S = 2.0  # snapshots come ten to twenty times a second
LOST_AFTER_S = 5.0  # longer than a busy computer pauses an engine
FIRST_SNAPSHOT_S = 10.0  # an engine that has just been started imports meanwhile
RETRY_S = (0.5, 1.0, 2.0, 5.0)
BROKEN: Text = say("The connection to the engine was lost.")
RELEASE_S = 1.0  # longest wait at the closing of the window


class EngineClient(Protocol):
    """The interface of an engine's client, in this process or another; operator: its sender."""

    operator: str

    def poll(self) -> Snapshot | None:
        """Return what is new since the last poll, or None; never waits."""
        ...

    def request(
        self, verb: str, arguments: dict[str, Any] | None = None, timeout_s: float = 5.0
    ) -> Reply:
        """Send a request and wait for the reply; may be called from several threads."""
        ...

    def close(self) -> None:
        """Detach; the engine continues."""
        ...


ClientFactory = Callable[[], EngineClient]
ReplyHandler = Callable[[Reply], None]


class ConnectionState(enum.StrEnum):
    """The state of the connection to the engine."""

    ATTACHING = "attaching"
    ATTACHED = "attached"
    SILENT = "silent"
    LOST = "lost"


class EngineConnection:
    """Own the client. ``pump`` is called by the window's timer and never waits.

    Stopping has a thread of its own, so that it never waits behind another request.
    """

    def __init__(self, factory: ClientFactory, clock: Callable[[], float] = time.monotonic) -> None:
        self._factory = factory
        self._clock = clock
        self._attaching = TaskWorker("gui-attach", bound=4)
        self._requests = TaskWorker("gui-requests", bound=16)
        self._urgent = TaskWorker("gui-stop", bound=4)
        self._client: EngineClient | None = None
        self._discarded: list[EngineClient] = []
        self._state = ConnectionState.ATTACHING
        self._reason: str = say("searching for the engine")
        self._last_snapshot_at: float | None = None
        self._attached_at = 0.0
        self._attempts = 0
        self._retry_at: float | None = 0.0
        self._closed = False
        self._operator = ""
        self.command = CommandWatch(clock)
        self.status: Status | None = None

    @property
    def state(self) -> ConnectionState:
        """Return the state of the connection."""
        return self._state

    @property
    def reason(self) -> str:
        """Return why the connection is not good, in words."""
        return self._reason

    def sign_as(self, operator: str) -> None:
        """Set the operator of requests from now on; empty: that of the client."""
        self._operator = operator
        if self._client is not None and operator:
            self._client.operator = operator

    @property
    def is_replay(self) -> bool:
        """Return whether the client plays a recorded test instead of holding an engine."""
        return bool(getattr(self._client, "is_replay", False))

    @property
    def last_recorded(self) -> int:
        """Return the last revolution of the recorded test that is played, 0 without one."""
        return int(getattr(self._client, "last_recorded", 0))

    @property
    def handle(self) -> int | None:
        """Return the handle that becomes readable when ``pump`` may have news, if there is one.

        Readable once for all that has come: call ``pump`` then.
        """
        return getattr(self._client, "handle", None)

    def silence_s(self) -> float:
        """Return the seconds since the engine's last message (0 before the first)."""
        if self._last_snapshot_at is None:
            return 0.0
        return self._clock() - self._last_snapshot_at

    def data_age_s(self) -> float | None:
        """Return the age of the newest data, growing while the engine is silent; None: no data."""
        if self.status is None or self.status.rig.data_age_s is None:
            return None
        return self.status.rig.data_age_s + self.silence_s()

    def pump(self) -> Snapshot | None:
        """Deliver replies, keep the connection up, return a new snapshot."""
        for worker in (self._urgent, self._requests, self._attaching):
            worker.deliver()
        self._close_discarded()
        now = self._clock()
        if self._client is None:
            self._attach_when_due(now)
            return None
        try:
            snapshot = self._client.poll()
        except Exception as error:
            self._lose(error_text(error, BROKEN), now)
            return None
        if snapshot is not None:
            self._last_snapshot_at = now
            self._state, self._reason, self._attempts = ConnectionState.ATTACHED, "", 0
            self.status = snapshot.status
            self._look_who_commands(snapshot.status)
            return snapshot
        self._judge_silence(now)
        return None

    def request(self, verb: str, arguments: dict[str, Any], handler: ReplyHandler) -> None:
        """Send a request; the handler gets the reply, or a refusal in words, from ``pump``."""
        client = self._client
        if client is None:
            handler(
                Reply(ok=False, sentence=say("The engine is not reachable ({}).", self._reason))
            )
            return
        treated = verb_of(verb)
        worker = self._urgent if treated.urgent else self._requests
        accepted = worker.submit(
            lambda: client.request(verb, arguments, treated.timeout_s),
            handler,
            lambda error: handler(Reply(ok=False, sentence=error_text(error, BROKEN))),
        )
        if not accepted:
            handler(Reply(ok=False, sentence=say("Too many requests are waiting for an answer.")))

    def close(self) -> None:
        """Detach; the engine continues. A client in use is left to the end of the process."""
        self._closed = True
        client, self._client = self._client, None
        if client is not None and self.command.holder is CommandHolder.THIS:
            with suppress(Exception):
                client.request("release_command", {}, RELEASE_S)
        for worker in (self._attaching, self._requests, self._urgent):
            worker.close(timeout_s=1.0)
        # The last requests, such as the end of a calibration, are sent before.
        if client is not None and self._requests.ended and self._urgent.ended:
            client.close()

    def _look_who_commands(self, status: Status) -> None:
        client = self._client
        if client is None or not self.command.take_name(status.engine.in_command):
            return
        self._attaching.submit(
            lambda: client.request("present", {}, verb_of("present").timeout_s),
            self.command.answered,
            lambda error: log.info("Who has control is not known: %s", error),
        )

    def _attach_when_due(self, now: float) -> None:
        if self._retry_at is None or now < self._retry_at or self._closed:
            return
        self._retry_at = None
        self._attaching.submit(self._factory, self._attached, self._not_attached)

    def _attached(self, client: EngineClient) -> None:
        if self._closed:
            client.close()
            return
        self._client = client
        self.sign_as(self._operator)
        self._attached_at = self._clock()

    def _not_attached(self, error: Exception) -> None:
        reason = error_text(error, BROKEN)
        if reason != self._reason:
            log.warning("No engine: %s", reason)
        self._reason = reason
        self._schedule()

    def _schedule(self) -> None:
        self._retry_at = self._clock() + RETRY_S[min(self._attempts, len(RETRY_S) - 1)]
        self._attempts += 1

    def _judge_silence(self, now: float) -> None:
        if self._state in (ConnectionState.ATTACHED, ConnectionState.SILENT):
            silence = self.silence_s()
            if silence > LOST_AFTER_S:
                self._lose(say("no message from the engine for {:.0f} s", silence), now)
            elif silence > SILENT_AFTER_S:
                self._state = ConnectionState.SILENT
                self._reason = say("no message from the engine")
        elif now - self._attached_at > FIRST_SNAPSHOT_S:
            self._lose(say("the engine did not answer within {:.0f} s", FIRST_SNAPSHOT_S), now)

    def _lose(self, reason: str, now: float) -> None:
        log.error("Engine lost: %s", reason)
        client, self._client = self._client, None
        self.command.forget()
        seen_before = self._last_snapshot_at is not None
        self._state = ConnectionState.LOST if seen_before else ConnectionState.ATTACHING
        self._reason = reason
        if client is not None:
            self._discarded.append(client)
        self._schedule()

    def _close_discarded(self) -> None:
        """Close lost clients once no request uses them: sockets are not shared between threads."""
        if self._discarded and self._requests.idle and self._urgent.idle:
            client = self._discarded.pop()
            self._attaching.submit(client.close, lambda _: None, lambda _: None)
