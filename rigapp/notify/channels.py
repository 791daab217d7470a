"""The channels for messages: those of rig file and user's file, their checks and use."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

import msgspec
import platformdirs

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, parse_notify, read_document
from rigapp.config.notify import REFERENCE, NotifyFile, NotifySection, PingSection
from rigapp.config.reading import read_text
from rigapp.config.rig import RigFile
from rigapp.config.writing import whole_file
from rigapp.notify.delivery import AttemptRequest, DeliveryResult
from rigapp.notify.message import Message, worded, worst_level
from rigapp.process.children import module_command
from rigapp.schema.wire import json_bytes, tree_of

if TYPE_CHECKING:
    from tomlkit import TOMLDocument

ATTEMPT_S = 120.0
"""Time limit of an attempt: a healthy server answers within seconds, and a busy computer needs time
to start."""


@dataclass(frozen=True, slots=True)
class DeliveryChannels:
    """All channels of a rig: its own and those of the user, each with a name; the ping, if any."""

    ways: tuple[NotifySection, ...] = ()
    ping: PingSection | None = None
    secrets: Path = Path()

    def __bool__(self) -> bool:
        """Return whether there is any channel or ping."""
        return bool(self.ways) or self.ping is not None


def user_folder() -> Path:
    """Return the folder of the user's ``notify.toml`` and ``secrets.toml``."""
    return platformdirs.user_config_path("rigapp")


def ways_of(rig: Document[RigFile] | None) -> DeliveryChannels:
    """Return the channels of a rig, of the user alone without one; raise UnusableInput."""
    own = user_folder() / "notify.toml"
    user = read_document(own, NotifyFile).record if own.exists() else None
    sections = [*(rig.record.notify if rig is not None else ()), *(user.notify if user else ())]
    named = tuple(
        msgspec.structs.replace(way, name=way.name or f"way {number}")
        for number, way in enumerate(sections, 1)
    )
    names = [way.name for way in named]
    for name in names:
        if names.count(name) > 1:
            raise UnusableInput("{}: notify.name = {} is in the rig file, too.", own, repr(name))
    ping = rig.record.ping if rig is not None and rig.record.ping is not None else None
    ping = ping or (user.ping if user else None)
    return DeliveryChannels(named, ping, user_folder() / "secrets.toml")


@dataclass(frozen=True, slots=True)
class ListedWay:
    """A channel in a list: name, address, kinds of events; own: of the user's file."""

    name: str
    leads_to: str
    when: tuple[str, ...]
    own: bool


def listed_ways(rig: Document[RigFile] | None) -> tuple[ListedWay, ...]:
    """Return the channels of a rig and of the user for a list; raise UnusableInput."""
    of_rig = len(rig.record.notify) if rig is not None else 0
    return tuple(
        ListedWay(way.name, address(way.url) or way.command[0], way.when, number >= of_rig)
        for number, way in enumerate(ways_of(rig).ways)
    )


def add_way(way: NotifySection) -> None:
    """Add a channel to the user's file, comments kept; raise UnusableInput for an unusable one."""

    def add(document: TOMLDocument) -> None:
        import tomlkit

        entry = tomlkit.table()
        for key, value in tree_of(way).items():
            if value != getattr(NotifySection(), key):
                entry.add(key, list(value) if isinstance(value, list | tuple) else value)
        ways = document.setdefault("notify", tomlkit.aot())
        ways.append(entry)

    _change_user_file(add)


def remove_way(name: str) -> None:
    """Remove a channel of the user's file by its name, or by its number where it has none."""

    def remove(document: TOMLDocument) -> None:
        ways = document.get("notify", [])
        for at, way in enumerate(ways):
            if way.get("name") == name:
                del ways[at]
                return
        raise UnusableInput(
            "{}: {} has no name there; edit the file.", user_folder() / "notify.toml", name
        )

    _change_user_file(remove)


def _change_user_file(change: Callable[[TOMLDocument], None]) -> None:
    """Change the user's file; it is written only if it is usable afterwards."""
    import tomlkit

    file = user_folder() / "notify.toml"
    document = tomlkit.parse(read_text(file) if file.exists() else "schema = 1\n")
    change(document)
    text = tomlkit.dumps(document)
    parse_notify(text, str(file))
    file.parent.mkdir(parents=True, exist_ok=True)
    with whole_file(file, mode=0o600) as part:
        part.write_text(text, encoding="utf-8", newline="")


def address(url: str) -> str:
    """Return the address of a URL for the log: scheme and host, no secret and no path."""
    if REFERENCE.fullmatch(url):
        return url
    try:
        parts = urlsplit(url)
        return f"{parts.scheme}://{parts.hostname or ''}"
    except ValueError:
        return url.partition("://")[0]


def inspected(ways: DeliveryChannels) -> list[str]:
    """Return the faults of channels, one sentence each; nothing is sent."""
    requested: list[tuple[str, NotifySection | PingSection]] = [
        (way.name, way) for way in ways.ways
    ]
    requested += [("ping", ways.ping)] if ways.ping is not None and "{" in ways.ping.url else []
    if not requested:
        return []
    with ThreadPoolExecutor(len(requested)) as pool:
        results = list(pool.map(lambda request: _inspect(request[1], ways.secrets), requested))
    return [
        f"notify, {name}: {result.reason}"
        for (name, _), result in zip(requested, results, strict=True)
        if not result.ok
    ]


def _inspect(way: NotifySection | PingSection, secrets: Path) -> DeliveryResult:
    if isinstance(way, PingSection) or way.url:
        what = "inspect" if isinstance(way, NotifySection) else "look up"
        return attempt(AttemptRequest(what, way.url, str(secrets)))  # type: ignore[arg-type]
    if shutil.which(way.command[0]) is None:
        return DeliveryResult(False, f"there is no program {way.command[0]}")
    return DeliveryResult(True)


def tell(way: NotifySection, secrets: Path, rig: str, batch: Sequence[Message]) -> DeliveryResult:
    """Send messages by a channel as one, within ATTEMPT_S; never raises."""
    title, text = worded(rig, batch)
    level = worst_level(batch)
    if way.url:
        return attempt(AttemptRequest("send", way.url, str(secrets), title, text, level))
    settings = {
        "rig": rig,
        "title": title,
        "text": text,
        "level": level,
        "messages": tree_of(batch),
    }
    try:
        status, _ = _bounded(way.command, json.dumps(settings).encode(), keep=False)
    except OSError as error:
        return DeliveryResult(False, f"{way.command[0]} cannot be started ({error.strerror})")
    if status is None:
        return DeliveryResult(False, f"{way.command[0]} took longer than {ATTEMPT_S:g} s")
    return DeliveryResult(status == 0, "" if status == 0 else f"it ended with status {status}")


def attempt(request: AttemptRequest) -> DeliveryResult:
    """Make an attempt in a process of its own, and end it at the time limit."""
    argv = module_command("rigapp.notify.delivery")
    try:
        status, answer = _bounded(argv, json_bytes(request), keep=True)
        if status is None:
            return DeliveryResult(False, f"no answer within {ATTEMPT_S:g} s")
        return msgspec.json.decode(answer, type=DeliveryResult)
    except (OSError, ValueError) as error:
        return DeliveryResult(False, f"the attempt failed ‹{type(error).__name__}›")


def _bounded(argv: Sequence[str], text: bytes, *, keep: bool) -> tuple[int | None, bytes]:
    """Run a program; return its exit status, None on time-out, and its output."""
    process = subprocess.Popen(
        argv,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE if keep else subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        written, _ = process.communicate(text, ATTEMPT_S)
    except subprocess.TimeoutExpired:
        return None, b""
    finally:
        if process.returncode is None:
            if sys.platform != "win32":
                with suppress(OSError):
                    os.killpg(process.pid, signal.SIGKILL)
            process.kill()
            process.wait()
            for stream in (process.stdin, process.stdout):
                if stream is not None:
                    with suppress(OSError):
                        stream.close()
    return process.returncode, written or b""
