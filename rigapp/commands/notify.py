"""`rigapp notify`: by which ways an absent operator is told; try them."""

from __future__ import annotations

import time
from pathlib import Path

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
from rigapp.service.registry import lasting_folder


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
