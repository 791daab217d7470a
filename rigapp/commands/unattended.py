"""What runs unattended: `rigapp queue` with its tests, `rigapp notify` with its messages."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.config.notify import NotifySection
from rigapp.notify.channels import (
    DeliveryChannels,
    address,
    attempt,
    inspected,
    tell,
    user_folder,
    ways_of,
)
from rigapp.notify.delivery import AttemptRequest, DeliveryResult
from rigapp.notify.message import Message, clock
from rigapp.notify.store import identity, read_state, state_file
from rigapp.queue.items import Queue, halted, line, removed
from rigapp.queue.store import QueueStore
from rigapp.schema.queue import ItemState
from rigapp.schema.wire import json_bytes
from rigapp.service.registry import lasting_folder

CONNECTING_S = 90.0
LOOK_EVERY_S = 0.2


def queue_tests(tests: Sequence[Path], rig: Path, folder: Path) -> int:
    """Put tests at the end of a rig's queue and print it; raise UnusableInput. Exit status."""
    from rigapp.service.rigqueue import add_tests

    return _shown_queue(add_tests(_store(rig), read_rig(rig).record, tests, folder))


def unqueue_tests(numbers: Sequence[int], rig: Path) -> int:
    """Take tests out of a rig's queue and print it; raise UnusableInput. Exit status."""
    return _shown_queue(_store(rig).change(lambda queue: removed(queue, list(numbers))))


def show_queue(rig: Path, *, as_json: bool) -> int:
    """Print a rig's queue; raise UnusableInput. Exit status."""
    queue = _store(rig).read()
    if as_json:
        print(msgspec.json.format(json_bytes(queue)).decode())
        return 0
    return _shown_queue(queue)


def start_queue(rig: Path, operator: str) -> int:
    """Let the rig's engine, started where none runs, work the queue through. Exit status.

    Returns when the first test runs. Raises UnusableInput where it is refused.
    """
    from rigapp.service.launch import attach

    read_rig(rig)
    if _store(rig).read().next is None:
        raise UnusableInput("No test waits in the queue; add one: rigapp queue add.")
    client = attach(rig, operator)
    try:
        _wait_for_devices(client)
        return _shown_queue(_queue_after(client, "queue_start"))
    finally:
        client.close()


def stop_queue(rig: Path, operator: str) -> int:
    """Begin no other test of the queue; the one that runs goes on. Exit status."""
    from rigapp.service.client import Client
    from rigapp.service.launch import find_engine

    entry = find_engine(rig)
    if entry is None:
        return _shown_queue(_store(rig).change(halted))
    client = Client(entry, operator, look=False)
    try:
        return _shown_queue(_queue_after(client, "queue_stop"))
    finally:
        client.close()


def _store(rig: Path) -> QueueStore:
    from rigapp.service.registry import kept_of

    return QueueStore(kept_of(rig, "queues"), rig)


def _queue_after(client: Any, verb: str) -> Queue:
    reply = client.request(verb)
    if not reply.ok:
        raise UnusableInput(reply.sentence)
    return msgspec.convert(reply.result, Queue)


def _wait_for_devices(client: Any) -> None:
    """Wait while the engine opens its devices; what is wrong with them is told by the start."""
    deadline = time.monotonic() + CONNECTING_S
    while client.request("status").result["state"] in ("idle", "connecting"):
        if time.monotonic() > deadline:
            raise UnusableInput(f"The devices are not connected after {CONNECTING_S:g} s.")
        time.sleep(LOOK_EVERY_S)


def _shown_queue(queue: Queue) -> int:
    left = sum(one.state is not ItemState.DONE for one in queue.items)
    print(f"{left} to be done, the queue {'works' if queue.working else 'stands'}")
    for one in queue.items:
        print(line(one))
    return 0


def show_ways(rig: Path | None) -> int:
    """Print each way, when it tells, and what waits for it."""
    ways = _ways(rig)
    known = {}
    if rig is not None:
        folder = lasting_folder() / "messages"
        known = dict(read_state(state_file(folder, str(rig.resolve()))).ways)
    for way in ways.ways:
        line = f"{_named(way)}: {', '.join(way.when)}"
        found = known.get(identity(way))
        if found is not None and found.outbox.waiting:
            line += f"; {len(found.outbox.waiting)} wait to be sent"
        if found is not None and found.outbox.failing_since:
            line += f", it fails since {clock(found.outbox.failing_since)}"
        print(f"{line}.")
    if ways.ping is not None:
        print(
            f"ping, {address(ways.ping.url)}: every {ways.ping.interval_s:g} s while all is well."
        )
    return 0


def try_ways(rig: Path | None) -> int:
    """Send one message by every way and say what became of it; 1 when one did not arrive."""
    ways = _ways(rig)
    wrong = inspected(ways)
    if wrong:
        raise UnusableInput(f"{'; '.join(wrong)}.")
    name = read_rig(rig).record.name if rig is not None else "rigapp"
    text = "This is a test of the messages. Nothing has happened."
    message = Message("test", "told", "information", "Test of the messages", text, time.time())
    results = [(_named(way), tell(way, ways.secrets, name, [message])) for way in ways.ways]
    if ways.ping is not None:
        request = AttemptRequest("ping", ways.ping.url, str(ways.secrets))
        results.append((f"ping, {address(ways.ping.url)}", attempt(request)))
    for way, result in results:
        print(f"{way}: {_outcome(result)}.")
    return 0 if all(result.ok for _, result in results) else 1


def _outcome(result: DeliveryResult) -> str:
    return "sent" if result.ok else f"NOT SENT: {result.reason.rstrip('.')}"


def _named(way: NotifySection) -> str:
    return f"{way.name}, {way.command[0] if way.command else address(way.url)}"


def _ways(rig: Path | None) -> DeliveryChannels:
    ways = ways_of(read_rig(rig) if rig is not None else None)
    if not ways:
        where = f"in {rig} or " if rig is not None else ""
        raise UnusableInput(
            f"No way is set up: write [[notify]] {where}in {user_folder() / 'notify.toml'};"
            " see examples/notify.toml."
        )
    return ways
