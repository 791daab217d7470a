"""Every verb that a viewer may ask of an engine: who may, in which lane, within which time.

Each safety verb has workers of its own, so that nothing else, however many requests hang, keeps it
waiting. The others share the workers of their lane.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass


class Lane(enum.StrEnum):
    """Where a request waits its turn, and whose workers carry it out."""

    SAFETY = "safety"
    LOOK = "look"
    WORK = "work"


@dataclass(frozen=True, slots=True)
class Verb:
    """How the service treats a verb.

    everybody: it may come from any viewer while another one is in command. timeout_s: how long its
    sender waits for the answer unless it says otherwise.
    """

    lane: Lane
    timeout_s: float = 10.0
    everybody: bool = False


_SAFETY = Verb(Lane.SAFETY, everybody=True)
_LOOK = Verb(Lane.LOOK, everybody=True)
_WORK = Verb(Lane.WORK)

OTHER = _WORK
"""How a verb that nobody knows is treated."""

VERBS: dict[str, Verb] = {
    "stop": _SAFETY,
    "drive_off": _SAFETY,
    "acknowledge": _SAFETY,
    "reset": Verb(Lane.SAFETY, timeout_s=30.0),
    "hello": _LOOK,
    "status": _LOOK,
    "present": _LOOK,
    "take_command": _LOOK,
    "release_command": _LOOK,
    "signals": Verb(Lane.WORK, everybody=True),
    "simulation_state": Verb(Lane.WORK, everybody=True),
    "connect": Verb(Lane.WORK, timeout_s=90.0),
    "reconnect": Verb(Lane.WORK, timeout_s=90.0),
    "start": Verb(Lane.WORK, timeout_s=120.0),
    "resume_file": Verb(Lane.WORK, timeout_s=120.0),
    "examine_file": Verb(Lane.WORK, timeout_s=120.0),
    "pause": _WORK,
    "resume": Verb(Lane.WORK, timeout_s=30.0),
    "shelve": _WORK,
    "note": _WORK,
    "extend": _WORK,
    "set_limit": _WORK,
    "zero": Verb(Lane.WORK, timeout_s=60.0),
    "inject_fault": _WORK,
    "clear_fault": _WORK,
    "hand": Verb(Lane.WORK, timeout_s=30.0),
    "shutdown": Verb(Lane.LOOK),
}

SAFETY_VERBS = frozenset(name for name, verb in VERBS.items() if verb.lane is Lane.SAFETY)


def verb_of(name: str) -> Verb:
    """Return how a verb is treated, by name."""
    return VERBS.get(name, OTHER)
