"""Control channel of the simulated rig: JSON lines in, one JSON line back for each.

::

    {"fault": "cable_pull", "device": "daq", "duration_s": 1.0}    -> {"ok": true}
    {"clear": "emergency_stop"}                                    -> {"ok": true}
    {"query": "state"}                                             -> the plant's truth
    {"hand": "turn_pin", "angle_deg": 90.0}                        -> {"ok": true}, see ``hands``
    {"state": {"wear_depth_um": 12.5, "worn_area_mm2": 0.3}}       -> {"ok": true}, see below
    anything else                                                  -> {"error": "a sentence"}

``state`` sets what an earlier test has left in the machine, before a test is resumed on a rig that
was started anew: the bushing's wear, by its depth at the contact and, if it is known, the area that
the wear has taken (else it follows from the depth). The crank must stand and nothing drive it. Keys
are those of the answer to ``query``.

A new command is one more verb in ``VERBS``: a function of the rig and the message's table.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.schema.wire import json_bytes
from rigapp.simulation.faults import fault_of
from rigapp.simulation.rig import RigSimulation
from rigapp.simulation.simulated_operator import hand_of
from rigapp.texts import joined

Table = dict[str, Any]
LONGEST_LINE = 65536


def _inject(rig: RigSimulation, message: Table) -> Table:
    data = dict(message)
    data["kind"] = data.pop("fault")
    rig.inject(fault_of(data))
    return {"ok": True}


def _clear(rig: RigSimulation, message: Table) -> Table:
    rig.clear(str(message["clear"]))
    return {"ok": True}


def _query(rig: RigSimulation, message: Table) -> Table:
    if message["query"] != "state":
        raise UnusableInput(
            "query {} is not known; the only one is 'state'.", repr(message["query"])
        )
    return rig.report()


def _hand(rig: RigSimulation, message: Table) -> Table:
    rig.hands.do(hand_of(message))
    return {"ok": True}


class WornState(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What ``state`` can set."""

    wear_depth_um: float
    worn_area_mm2: float | None = None


def _set_state(rig: RigSimulation, message: Table) -> Table:
    try:
        state = msgspec.convert(message["state"], WornState)
    except msgspec.ValidationError as error:
        raise UnusableInput("state: {}.", error) from error
    rig.wear_to(state.wear_depth_um, state.worn_area_mm2)
    return {"ok": True}


VERBS: Mapping[str, Callable[[RigSimulation, Table], Table]] = {
    "fault": _inject,
    "clear": _clear,
    "query": _query,
    "hand": _hand,
    "state": _set_state,
}


def answer(rig: RigSimulation, line: bytes) -> bytes:
    """Obey one line and return the line that answers it, with its newline."""
    try:
        message = msgspec.json.decode(line, type=dict[str, Any])
        verbs = [verb for verb in VERBS if verb in message]
        if len(verbs) != 1:
            raise UnusableInput("a message has one of the keys {}.", joined(", ", VERBS))
        reply = VERBS[verbs[0]](rig, message)
    except msgspec.DecodeError as error:
        reply = {"error": f"not a JSON object on one line: {error}"}
    except UnusableInput as error:
        reply = {"error": str(error)}
    return json_bytes(reply) + b"\n"


class Lines:
    """Cut what arrives into lines; a line without end is dropped at 64 KiB."""

    def __init__(self) -> None:
        self._rest = b""

    def feed(self, data: bytes) -> list[bytes]:
        """Return the lines that are complete, without empty ones."""
        *lines, self._rest = (self._rest + data).split(b"\n")
        if len(self._rest) > LONGEST_LINE:
            self._rest = b""
        return [line for line in lines if line.strip()]
