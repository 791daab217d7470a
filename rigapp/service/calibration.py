"""The calibration that occupies a rig: weights may hang on the pin, so nothing else may turn it.

Its start returns a key, with which its holder ends it and may turn the spindle at its speeds. A
calibration whose window failed stays open until an operator releases it, in a new engine of the rig
too.
"""

from __future__ import annotations

import logging
import threading
import time
import uuid
from collections.abc import Callable
from pathlib import Path

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.writing import whole_file
from rigapp.process.private import read_own
from rigapp.schema.messages import OpenCalibration, Request
from rigapp.schema.states import Occupied, Refused
from rigapp.schema.wire import json_bytes
from rigapp.service.registry import kept_of
from rigapp.texts import say

log = logging.getLogger(__name__)

Log = Callable[[str, str], None]
"""Function that logs the text of an event and the operator."""


class HeldCalibration(msgspec.Struct, frozen=True):
    """An open calibration with the secret of its holder.

    key: required to end it and to start its tests, at most at ``fastest_rpm``. client: the viewer
    that started it.
    """

    shown: OpenCalibration
    key: str
    fastest_rpm: float = 0.0
    client: str = ""


class RigCalibration:
    """The one open calibration of a rig; every method may be called from any thread."""

    def __init__(self, rig: Path | None, log_line: Log) -> None:
        """Continue a stored calibration of a rig file; None: a rig that ends with its engine."""
        self._rig, self._log = rig, log_line
        self._lock = threading.Lock()
        self._held = stored_calibration(rig) if rig is not None else None

    @property
    def shown(self) -> OpenCalibration | None:
        """Return the public part of the calibration for viewers, None without one."""
        held = self._held
        return held.shown if held is not None else None

    def begin(self, request: Request, what: str, fastest_rpm: float) -> dict[str, str | float]:
        """Occupy the rig; return key and start time. Raises Occupied where another one is open."""
        operator = request.operator.strip() or "somebody"
        with self._lock:
            self._refuse()
            shown = OpenCalibration(what, operator, round(time.time(), 3))
            self._held = HeldCalibration(shown, uuid.uuid4().hex, fastest_rpm, request.client)
            key = self._held.key
            self._store()
        self._log(say("the calibration begins: {}", what), operator)
        return {"key": key, "since": shown.since}

    def end(self, key: str, request: Request) -> None:
        """End the calibration by its key; raises Refused where it is no longer open."""
        with self._lock:
            held = self._held
            if held is None or held.key != key:
                raise Refused("this calibration was ended already")
            self._held = None
            self._store()
        self._log(
            say("the calibration is over: {}", held.shown.what), request.operator or held.shown.who
        )

    def release(self, since: float, reason: str, request: Request) -> None:
        """End the calibration without its key; raises Refused where another one is open."""
        with self._lock:
            held = self._held
            if held is None:
                raise Refused("no calibration is open")
            if since and since != held.shown.since:
                raise Refused("another calibration is open: {}", _words(held.shown))
            self._held = None
            self._store()
        why = say(": {}", reason.strip()) if reason.strip() else ""
        self._log(say("ended the calibration of {}, {}{}", held.shown.who, held.shown.what, why),
                  request.operator.strip() or "somebody")  # fmt: skip

    def check(self, key: str = "", rpm: float = 0.0) -> None:
        """Raise Occupied where a test may not start; rpm: its fastest speed, key: the holder's."""
        held = self._held
        if held is None or held.key != key:
            self._refuse()
        elif rpm > held.fastest_rpm:
            raise Refused(
                "this calibration turns the spindle at {:g} rpm at most, the test at {:g} rpm",
                held.fastest_rpm,
                rpm,
            )

    def check_viewer(self, client: str) -> None:
        """Raise Occupied where another viewer calibrates."""
        held = self._held
        if held is None or not client or held.client != client:
            self._refuse()

    def _refuse(self) -> None:
        if self._held is not None:
            raise Occupied(occupied_words(self._held.shown))

    def _store(self) -> None:
        """Store the calibration for the next engine; a failure does not stop it."""
        if self._rig is None:
            return
        try:
            path = kept_of(self._rig, "calibrations")
            if self._held is None:
                path.unlink(missing_ok=True)
                return
            with whole_file(path, mode=0o600) as part:
                part.write_bytes(json_bytes(self._held))
        except (UnusableInput, OSError) as error:
            log.warning("the open calibration is not kept for another engine: %s", error)


def stored_calibration(rig: Path) -> HeldCalibration | None:
    """Return the stored open calibration of a rig, None without one."""
    try:
        text = read_own(kept_of(rig, "calibrations"))
        return msgspec.json.decode(text or b"", type=HeldCalibration)
    except (UnusableInput, ValueError):
        return None


def delete_calibration(rig: Path) -> None:
    """Delete the stored open calibration of a rig, while no engine runs."""
    kept_of(rig, "calibrations").unlink(missing_ok=True)


def occupied_words(shown: OpenCalibration) -> str:
    """Return a description of the calibration that occupies the rig, and how to end it."""
    return say(
        "{}. Close that calibration, or end it: End calibration in a window, or rigapp"
        " calibrate release",
        _words(shown),
    )


def _words(shown: OpenCalibration) -> str:
    since = time.strftime("%H:%M", time.localtime(shown.since))
    return say("{} is calibrating: {}, since {}", shown.who, shown.what, since)
