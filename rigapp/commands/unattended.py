"""Unattended operation: queue of tests, messages, and services that start with the computer."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import msgspec
import platformdirs

from rigapp.commands.doctor import RULES_FOLDERS, RULES_NAME, installed_drivers, port_rules
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.config.notify import NotifySection
from rigapp.config.writing import whole_file
from rigapp.notify.channels import (
    DeliveryChannels,
    address,
    attempt,
    inspected,
    tell,
    user_folder,
    ways_of,
)
from rigapp.notify.delivery import AttemptRequest
from rigapp.notify.message import Message, clock
from rigapp.notify.store import identity, read_state, state_file
from rigapp.process.children import module_command
from rigapp.queue.items import Queue, halted, line, removed
from rigapp.queue.store import QueueStore
from rigapp.schema.queue import ItemState
from rigapp.schema.wire import json_bytes
from rigapp.service.registry import lasting_folder

CONNECTING_S = 90.0
POLL_S = 0.2


def queue_tests(tests: Sequence[Path], rig: Path, folder: Path) -> int:
    """Append tests to a rig's queue and print it; return the exit status. Raises UnusableInput."""
    from rigapp.service.rigqueue import add_tests

    return _shown_queue(add_tests(_store(rig), read_rig(rig).record, tests, folder))


def unqueue_tests(numbers: Sequence[int], rig: Path) -> int:
    """Remove tests from a rig's queue, print it, return the exit status. Raises UnusableInput."""
    return _shown_queue(_store(rig).change(lambda queue: removed(queue, list(numbers))))


def show_queue(rig: Path, *, as_json: bool) -> int:
    """Print a rig's queue; return the exit status. Raises UnusableInput."""
    queue = _store(rig).read()
    if as_json:
        print(msgspec.json.format(json_bytes(queue)).decode())
        return 0
    return _shown_queue(queue)


def start_queue(rig: Path, operator: str) -> int:
    """Make the rig's engine, started if necessary, run the queue; return the exit status.

    Returns when the first test runs. Raises UnusableInput for a refusal.
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
    """Pause the queue after the running test; return the exit status."""
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
    """Wait while the engine opens its devices; the start reports their problems."""
    deadline = time.monotonic() + CONNECTING_S
    while client.request("status").result["state"] in ("idle", "connecting"):
        if time.monotonic() > deadline:
            raise UnusableInput(f"The devices are not connected after {CONNECTING_S:g} s.")
        time.sleep(POLL_S)


def _shown_queue(queue: Queue) -> int:
    left = sum(item.state is not ItemState.DONE for item in queue.items)
    print(f"{left} to be done, the queue is {'running' if queue.working else 'paused'}")
    for item in queue.items:
        print(line(item))
    return 0


def show_ways(rig: Path | None) -> int:
    """Print each notification channel, its topics, and its waiting messages."""
    ways = _ways(rig)
    known = {}
    if rig is not None:
        folder = lasting_folder() / "messages"
        known = dict(read_state(state_file(folder, str(rig.resolve()))).ways)
    for way in ways.ways:
        line = f"{_named(way)}: {', '.join(way.when)}"
        state = known.get(identity(way))
        if state is not None and state.outbox.waiting:
            line += f"; {len(state.outbox.waiting)} wait to be sent"
        if state is not None and state.outbox.failing_since:
            line += f", it fails since {clock(state.outbox.failing_since)}"
        print(f"{line}.")
    if ways.ping is not None:
        print(
            f"ping, {address(ways.ping.url)}: every {ways.ping.interval_s:g} s while all is well."
        )
    return 0


def try_ways(rig: Path | None) -> int:
    """Send a message through every channel and print the results; return 1 after a failure."""
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
        outcome = "sent" if result.ok else f"NOT SENT: {result.reason.rstrip('.')}"
        print(f"{way}: {outcome}.")
    return 0 if all(result.ok for _, result in results) else 1


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


# `rigapp service`: engines and page started with the computer, as systemd units of the user.
# Such an engine connects its devices and reports a test that was cut off; nothing moves.

PAGE = "rigapp-page.service"
STOP_S = 150
"""Time limit of systemd: an engine stops the spindle and ends its file and messages in 120 s."""
SYSTEMCTL_S = 60.0

UNIT = """\
[Unit]
Description=rigapp {what}
StartLimitIntervalSec=600
StartLimitBurst=5

[Service]
X-Of={of}
Type=exec
ExecStart={command}
Restart=on-failure
RestartSec=10
{ending}
[Install]
WantedBy=default.target
"""
ENGINE_ENDING = f"KillMode=mixed\nTimeoutStopSec={STOP_S}\n"
"""Only the engine receives the signal; it ends simulation, twin and notifier at standstill."""


@dataclass(frozen=True, slots=True)
class SystemdUnit:
    """One unit: file name, text, and subject (a rig file, or the page)."""

    name: str
    text: str
    of: str


def engine_unit(rig: Path) -> SystemdUnit:
    """Return the unit of a rig's engine; raises UnusableInput for an unusable rig file."""
    document = read_rig(rig)
    of = str(rig.resolve())
    name = " ".join(document.record.name.split()) or rig.stem
    command = command_line([*PROGRAM, "engine", of, "--stay"])
    what = f"engine of {escaped(name)}"
    text = UNIT.format(what=what, of=escaped(of), command=command, ending=ENGINE_ENDING)
    return SystemdUnit(_unit_name(rig), text, of)


def _unit_name(rig: Path) -> str:
    words = re.sub(r"[^A-Za-z0-9_.-]+", "-", rig.stem).strip("-.") or "rig"
    return f"rigapp-engine-{words}.service"


def page_unit(
    bind: str, token: Path | None = None, certificate: Path | None = None, key: Path | None = None
) -> SystemdUnit:
    """Return the unit of the page, with the options of ``rigapp page``."""
    words = [*PROGRAM, "page", "--bind", bind]
    for option, path in (("--token", token), ("--certificate", certificate), ("--key", key)):
        if path is not None:
            words += [option, str(path.resolve())]
    text = UNIT.format(what="page", of="page", command=command_line(words), ending="")
    return SystemdUnit(PAGE, text, "page")


PROGRAM = module_command("rigapp")


def escaped(text: str) -> str:
    """Return a text as a unit's value, with the characters escaped that systemd replaces."""
    return text.replace("\\", "\\\\").replace("%", "%%")


def command_line(words: Sequence[str]) -> str:
    """Return words as a value of ``ExecStart=`` (systemd.service, section Command lines)."""
    return " ".join(
        '"{}"'.format(escaped(word).replace('"', '\\"').replace("$", "$$")) for word in words
    )


def units_folder() -> Path:
    """Return the folder of the user's units."""
    return platformdirs.user_config_path("systemd") / "user"


def install_units(units: Sequence[SystemdUnit]) -> int:
    """Write, enable and start units; print the result and return the exit status.

    Raises UnusableInput where a unit of that name belongs to another rig.
    """
    folder = units_folder()
    for unit in units:
        owner = _owner(folder / unit.name)
        if owner not in ("", unit.of):
            raise UnusableInput(
                f"{folder / unit.name}: is of {owner}; give one of the two rig files another name."
            )
    folder.mkdir(parents=True, exist_ok=True)
    for unit in units:
        (folder / unit.name).write_text(unit.text, encoding="utf-8")
        print(f"Written: {folder / unit.name}")
    names = [unit.name for unit in units]
    if not _systemctl("daemon-reload") or not _systemctl("enable", "--now", *names):
        return 1
    print(f"Started, and started with the computer: {', '.join(names)}")
    install_rules()
    if not _lingers():
        print(
            "They start when you log in and end when you log out; to have them from the start of"
            " the computer on: loginctl enable-linger"
        )
    return 0


def rules_folder() -> Path:
    """Return the folder of this computer's udev rules."""
    return RULES_FOLDERS[0]


def install_rules(folder: Path | None = None) -> int:
    """Write the udev rules for the ports, or print the command for it; return the exit status.

    The command is printed where this user may not write. Nothing is done where the rules are up to
    date, or without udev.
    """
    folder = folder or rules_folder()
    path, text = folder / RULES_NAME, port_rules(installed_drivers([]))
    if not folder.is_dir():
        print("Rules for ports: this system has no udev, and needs none.")
        return 0
    if path.is_file() and path.read_text("utf-8", "replace") == text:
        print(f"Rules for ports: {path} is up to date.")
        return 0
    if not os.access(folder, os.W_OK):
        program = command_line(module_command("rigapp", "service", "install", "--rules"))
        print(f"Rules for ports: not installed, only root may. Run once: sudo {program}")
        return 1
    with whole_file(path) as part:
        part.write_text(text, "utf-8")
    print(f"Written: {path}")
    done = [_run_program("udevadm", *words) for words in (("control", "--reload"), ("trigger",))]
    if not all(done):
        print("Restart the computer, or plug the boxes in again, so that the rules are used.")
    return 0


def show_units(units: Sequence[SystemdUnit]) -> int:
    """Print units as they would be written; return the exit status."""
    for unit in units:
        print(f"# {units_folder() / unit.name}\n{unit.text}")
    return 0


def remove_units(rigs: Sequence[Path]) -> int:
    """Stop and disable the engines of rigs, by default all and the page; return the exit status.

    Raises UnusableInput where no such unit is installed.
    """
    folder = units_folder()
    there = {path.name: _owner(path) for path in sorted(folder.glob("rigapp-*.service"))}
    wanted = {str(rig.resolve()) for rig in rigs}
    known = [name for name, of in there.items() if of in wanted or not rigs]
    if not known:
        raise UnusableInput(f"{folder}: nothing of rigapp's is installed{' for it' * bool(rigs)}.")
    done = _systemctl("disable", "--now", *known)
    for name in known:
        (folder / name).unlink()
        print(f"Removed: {folder / name}")
    return 0 if _systemctl("daemon-reload") and done else 1


def _owner(path: Path) -> str:
    """Return the subject of a unit file, empty without one."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except FileNotFoundError:
        return ""
    except (OSError, ValueError) as error:
        raise UnusableInput(f"{path}: cannot be read ‹{error}›.") from error
    of = next((line.removeprefix("X-Of=") for line in lines if line.startswith("X-Of=")), "")
    return of.replace("%%", "%").replace("\\\\", "\\") or "another program"


def _systemctl(*arguments: str) -> bool:
    """Call the user's systemd; print the reason for a failure on standard error."""
    return _run_program("systemctl", "--user", *arguments)


def _run_program(program: str, *arguments: str) -> bool:
    """Run a program of the system; print the reason for a failure on standard error."""
    command = " ".join((program, *arguments[:2]))
    if shutil.which(program) is None:
        print(f"rigapp: there is no {program} here; the files are as told.", file=sys.stderr)
        return False
    try:
        done = subprocess.run(
            [program, *arguments],
            capture_output=True,
            text=True,
            timeout=SYSTEMCTL_S,
            check=False,
        )
    except subprocess.TimeoutExpired:
        print(f"rigapp: {command} did not answer in a minute.", file=sys.stderr)
        return False
    if done.returncode:
        why = " ".join(done.stderr.split()) or f"exit status {done.returncode}"
        print(f"rigapp: {command}: {why}", file=sys.stderr)
    return done.returncode == 0


def _lingers() -> bool:
    """Return whether the user's units run without a login; True where unknown."""
    if shutil.which("loginctl") is None:
        return True
    try:
        answer = subprocess.run(
            ["loginctl", "show-user", "--property=Linger", "--value"],
            capture_output=True,
            text=True,
            timeout=SYSTEMCTL_S,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return True
    return answer.returncode != 0 or answer.stdout.strip() == "yes"
