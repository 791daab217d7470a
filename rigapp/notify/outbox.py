"""The waiting messages of one channel: bounded, limited in rate, with pauses after failures.

Pure functions from outbox to outbox.
"""

from __future__ import annotations

import msgspec

from rigapp.notify.message import Message

MOST_WAITING = 200
"""Messages that wait for one channel: a week of trouble, and less than a megabyte."""

MOST_IN_ONE = 20
"""Messages combined in one when the hourly limit is too low; each keeps some lines."""

FIRST_WAIT_S, LONGEST_WAIT_S = 5.0, 900.0
"""Pause after a failure, doubled each time: short after a brief outage, and a quarter of an hour at
most."""

HOUR_S = 3600.0


class Outbox(msgspec.Struct, frozen=True):
    """Messages in their order, times of the last hour's messages, and failures since.

    sent_at: UTC s, of the last hour. not_before: UTC s. failing_since: 0 while it works. lost:
    messages dropped since the last one was sent.
    """

    waiting: tuple[Message, ...] = ()
    sent_at: tuple[float, ...] = ()
    failures: int = 0
    not_before: float = 0.0
    failing_since: float = 0.0
    lost: int = 0


def put(outbox: Outbox, message: Message) -> Outbox:
    """Add a message; of too many the oldest one that is not critical is dropped."""
    waiting, lost = [*outbox.waiting, message], outbox.lost
    while len(waiting) > MOST_WAITING:
        minor = (index for index, message in enumerate(waiting) if message.level != "critical")
        del waiting[next(minor, 0)]
        lost += 1
    return msgspec.structs.replace(outbox, waiting=tuple(waiting), lost=lost)


def due(outbox: Outbox, now: float, most_per_hour: int) -> tuple[Message, ...]:
    """Return the messages to send now: the oldest one, or several in one; none: wait.

    Several are combined when more wait than the hour allows, so that none waits for long and none
    is left out.
    """
    left = most_per_hour - len(_of_last_hour(outbox, now))
    if not outbox.waiting or left <= 0:
        return ()
    if 0.0 < outbox.not_before - now <= LONGEST_WAIT_S:
        return ()
    if len(outbox.waiting) <= left:
        return outbox.waiting[:1]
    return outbox.waiting[:MOST_IN_ONE]


def sent(outbox: Outbox, batch: tuple[Message, ...], now: float) -> Outbox:
    """Return the outbox after a batch was delivered."""
    delivered = set(batch)
    return Outbox(
        waiting=tuple(message for message in outbox.waiting if message not in delivered),
        sent_at=(*_of_last_hour(outbox, now), now),
    )


def failed(outbox: Outbox, now: float) -> Outbox:
    """Return the outbox after a failed attempt, with a pause that grows each time."""
    wait = min(FIRST_WAIT_S * 2.0 ** min(outbox.failures, 30), LONGEST_WAIT_S)
    return msgspec.structs.replace(
        outbox,
        failures=outbox.failures + 1,
        not_before=now + wait,
        failing_since=outbox.failing_since or now,
    )


def _of_last_hour(outbox: Outbox, now: float) -> tuple[float, ...]:
    """Return the times of the last hour's messages; later times are of a wrong clock."""
    return tuple(at for at in outbox.sent_at if 0.0 <= now - at < HOUR_S)
