"""`rigapp queue`: tests of one rig, one after another, each into a file of its own."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.queue.items import Queue, halted, line, removed
from rigapp.queue.store import QueueStore
from rigapp.schema.queue import ItemState
from rigapp.schema.wire import json_bytes

CONNECTING_S = 90.0
LOOK_EVERY_S = 0.2


def add(tests: Sequence[Path], rig: Path, folder: Path) -> int:
    """Put tests at the end of a rig's queue and print it; raise UnusableInput. Exit status."""
    from rigapp.service.rigqueue import add_tests

    return _shown(add_tests(_store(rig), read_rig(rig).record, tests, folder))


def remove(numbers: Sequence[int], rig: Path) -> int:
    """Take tests out of a rig's queue and print it; raise UnusableInput. Exit status."""
    return _shown(_store(rig).change(lambda queue: removed(queue, list(numbers))))


def show(rig: Path, *, as_json: bool) -> int:
    """Print a rig's queue; raise UnusableInput. Exit status."""
    queue = _store(rig).read()
    if as_json:
        print(msgspec.json.format(json_bytes(queue)).decode())
        return 0
    return _shown(queue)


def start(rig: Path, operator: str) -> int:
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
        return _shown(_request(client, "queue_start"))
    finally:
        client.close()


def stop(rig: Path, operator: str) -> int:
    """Begin no other test of the queue; the one that runs goes on. Exit status."""
    from rigapp.service.client import Client
    from rigapp.service.launch import find_engine

    entry = find_engine(rig)
    if entry is None:
        return _shown(_store(rig).change(halted))
    client = Client(entry, operator, look=False)
    try:
        return _shown(_request(client, "queue_stop"))
    finally:
        client.close()


def _store(rig: Path) -> QueueStore:
    from rigapp.service.registry import kept_of

    return QueueStore(kept_of(rig, "queues"), rig)


def _request(client: Any, verb: str) -> Queue:
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


def _shown(queue: Queue) -> int:
    left = sum(one.state is not ItemState.DONE for one in queue.items)
    print(f"{left} to be done, the queue {'works' if queue.working else 'stands'}")
    for one in queue.items:
        print(line(one))
    return 0
