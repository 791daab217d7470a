"""The connection of a command to an engine: the running one of the rig, or one hosted here."""

from __future__ import annotations

import logging
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.config.names import login_name
from rigapp.config.recipe import TestFile
from rigapp.presentation.states import calibration_words
from rigapp.process.ending import ending_as_interrupt
from rigapp.schema.messages import OpenCalibration, Reply, Request
from rigapp.service.calibration import delete_calibration, stored_calibration
from rigapp.service.client import Client
from rigapp.service.launch import find_engine

log = logging.getLogger(__name__)

Ask = Callable[[str, dict[str, Any]], Any]


@contextmanager
def engine_line(
    rig: Path, operator: str = "", *, own: bool = False, test: TestFile | None = None
) -> Iterator[Ask]:
    """Yield a function that sends requests to the rig's engine; a refusal raises UnusableInput.

    own: host an engine here even if another one runs (simulated rigs). test: has the mechanism of a
    rig simulated here, by default the packaged one.
    """
    from rigapp.service.host import EngineHost
    from rigapp.service.simulated import parse_speed

    entry = None if own else find_engine(rig)
    if entry is not None:
        client = Client(entry, operator)
        try:
            yield lambda verb, arguments: result_of(client.request(verb, arguments))
        finally:
            client.close()
        return
    document = read_rig(rig)
    with ending_as_interrupt():
        host = EngineHost(document, parse_speed(None, document), own=own)
        try:
            host.connect(test)
            yield lambda verb, arguments: result_of(host.handle(Request(verb, arguments, operator)))
        finally:
            host.close()


@contextmanager
def occupied(ask: Ask, what: str, fastest_rpm: float = 0.0) -> Iterator[str]:
    """Occupy the rig for a calibration and yield its key; the calibration always ends on exit.

    fastest_rpm: highest speed of its tests. Raises UnusableInput where the rig is occupied.
    """
    key = ask("calibration_begin", {"what": what, "fastest_rpm": fastest_rpm})["key"]
    try:
        yield key
    finally:
        try:
            ask("calibration_end", {"key": key})
        except UnusableInput as error:
            log.warning("the end of the calibration: %s", error)


def result_of(reply: Reply) -> Any:
    """Return the result of a reply; raises UnusableInput for a refusal."""
    if not reply.ok:
        raise UnusableInput(reply.sentence)
    return reply.result


QUESTION = "Look at the pin. Does anything hang on it, or is a hand in the rig? Write no: "
ENDED = "The calibration is ended; the readings so far stay in its journal."


def release_calibration(
    rig: Path, reason: str, *, sure: bool, read: Callable[[str], str] = input
) -> int:
    """Show the open calibration, ask whether the pin is free, and end it; return the exit status.

    sure: do not ask. Raises UnusableInput without a terminal.
    """
    read_rig(rig)
    entry = find_engine(rig)
    if entry is None:
        kept = stored_calibration(rig)
        if _confirm_end(rig, kept.shown if kept is not None else None, sure, read):
            delete_calibration(rig)
            print(ENDED)
        return 0
    client = Client(entry, login_name(), look=False)
    try:
        tree = result_of(client.request("status")).get("calibration")
        calibration = msgspec.convert(tree, OpenCalibration) if tree is not None else None
        if _confirm_end(rig, calibration, sure, read):
            assert calibration is not None
            requested = {"since": calibration.since, "reason": reason}
            result_of(client.request("calibration_release", requested))
            print(ENDED)
    finally:
        client.close()
    return 0


def _confirm_end(
    rig: Path, calibration: OpenCalibration | None, sure: bool, read: Callable[[str], str]
) -> bool:
    """Return whether to end an open calibration; raises UnusableInput where it may not end."""
    if calibration is None:
        print(f"{rig}: no calibration is open.")
        return False
    words = calibration_words(calibration)
    if not sure and read is input and not sys.stdin.isatty():
        raise UnusableInput(f"{words}: look whether weights hang on the pin, then add --yes.")
    print(f"Open: {words}.")
    if not sure and read(QUESTION).strip().lower() != "no":
        raise UnusableInput("the calibration stays open; nothing was changed.")
    return True
