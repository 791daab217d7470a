"""`rigapp calibrate release`: end a calibration that occupies the rig, on purpose."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import msgspec

from rigapp.commands.live.engine_line import result_of
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.config.names import login_name
from rigapp.presentation.states import calibration_words
from rigapp.schema.messages import OpenCalibration
from rigapp.service.calibration import forget_calibration, kept_calibration
from rigapp.service.client import Client
from rigapp.service.launch import find_engine

QUESTION = "Look at the pin. Does anything hang on it, or is a hand in the rig? Write no: "
ENDED = "The calibration is ended; the readings so far stay in its journal."


def release_calibration(
    rig: Path, reason: str, *, sure: bool, read: Callable[[str], str] = input
) -> int:
    """Say who calibrates what, ask whether the pin is free, and end it; return the exit status.

    sure: do not ask. Raises UnusableInput where there is nobody to ask.
    """
    read_rig(rig)
    entry = find_engine(rig)
    if entry is None:
        kept = kept_calibration(rig)
        if _may_end(rig, kept.shown if kept is not None else None, sure, read):
            forget_calibration(rig)
            print(ENDED)
        return 0
    client = Client(entry, login_name(), look=False)
    try:
        told = result_of(client.request("status")).get("calibration")
        found = msgspec.convert(told, OpenCalibration) if told is not None else None
        if _may_end(rig, found, sure, read):
            assert found is not None
            asked = {"since": found.since, "reason": reason}
            result_of(client.request("calibration_release", asked))
            print(ENDED)
    finally:
        client.close()
    return 0


def _may_end(
    rig: Path, found: OpenCalibration | None, sure: bool, read: Callable[[str], str]
) -> bool:
    """Tell whether the calibration that was found shall end; raise UnusableInput where not."""
    if found is None:
        print(f"{rig}: no calibration is open.")
        return False
    words = calibration_words(found)
    if not sure and read is input and not sys.stdin.isatty():
        raise UnusableInput(f"{words}: look whether weights hang on the pin, then add --yes.")
    print(f"Open: {words}.")
    if not sure and read(QUESTION).strip().lower() != "no":
        raise UnusableInput("the calibration stays open; nothing was changed.")
    return True
