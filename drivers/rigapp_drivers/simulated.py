"""Common parts of all simulated devices: time of the wire, fault data, delayed replies.

Simulators only; no driver imports this.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any


@dataclass(frozen=True, slots=True)
class Fault:
    """One fault, in the time of the wire since the simulator's first call.

    A state fault lasts from start_s to end_s. A link fault affects ``count`` messages (None: all)
    about ``target`` (command number or object index; None: any) in that time. An instantaneous
    fault occurs once, at start_s. ``value``: its meaning depends on the kind of fault.
    """

    kind: enum.StrEnum
    start_s: float = 0.0
    end_s: float = math.inf
    target: int | None = None
    count: int | None = None
    value: float | None = None


Faults = Iterable[Fault | Mapping[str, Any]]
"""Records, or tables such as ``{"kind": "wrong_crc", "count": 2}``."""


class FaultPlan:
    """The time of the wire and the active faults, and count down the link faults.

    Raises ValueError for an unknown kind and TypeError for an unknown key.
    """

    def __init__(self, kinds: type[enum.StrEnum], faults: Faults = ()) -> None:
        self.time_s = 0.0
        self._start_s: float | None = None
        self._kinds = kinds
        self._faults: list[Fault] = []
        self._late: list[tuple[float, bytes]] = []
        for fault in faults:
            if isinstance(fault, Fault):
                self._faults.append(fault)
            else:
                self.add(**fault)

    def tick(self, now_s: float) -> float:
        """Set the time; return it, counted from the first call."""
        if self._start_s is None:
            self._start_s = now_s
        self.time_s = now_s - self._start_s
        return self.time_s

    def add(self, kind: str, **data: Any) -> None:
        """Add a fault while the simulation runs; it starts now unless ``start_s`` is set."""
        self._faults.append(Fault(self._kinds(kind), **data))

    def clear(self, kind: str) -> None:
        """Remove all faults of a kind."""
        wanted = self._kinds(kind)
        self._faults = [fault for fault in self._faults if fault.kind is not wanted]

    def on(self, kind: enum.StrEnum) -> bool:
        """Return whether a state fault is active now."""
        return self.active(kind) is not None

    def active(self, kind: enum.StrEnum, default: float = 0.0) -> float | None:
        """Return the value of an active state fault, None if there is none."""
        for fault in self._faults:
            if fault.kind is kind and fault.start_s <= self.time_s < fault.end_s:
                return default if fault.value is None else fault.value
        return None

    def link_fault(self, kind: enum.StrEnum, target: int, default: float = 0.0) -> float | None:
        """Return the value of a fault that affects this message, and count it; None if none."""
        for position, fault in enumerate(self._faults):
            hit = fault.kind is kind and fault.start_s <= self.time_s < fault.end_s
            if not hit or fault.target not in (None, target) or fault.count == 0:
                continue
            if fault.count is not None:
                self._faults[position] = replace(fault, count=fault.count - 1)
            return default if fault.value is None else fault.value
        return None

    def take(self, kind: enum.StrEnum, default: float = 0.0) -> float | None:
        """Return the value of an instantaneous fault that is due, once."""
        for fault in self._faults:
            if fault.kind is kind and fault.start_s <= self.time_s:
                self._faults.remove(fault)
                return default if fault.value is None else fault.value
        return None

    def in_time(self, reply: bytes, slow: enum.StrEnum, target: int, delay_s: float) -> bytes:
        """Return a reply, or nothing if a fault delays it (see ``due``)."""
        delay = self.link_fault(slow, target, delay_s)
        if delay is None:
            return reply
        self._late.append((self.time_s + delay, reply))
        return b""

    def due(self) -> bytes:
        """Return the delayed replies that are due."""
        due = b"".join(reply for when, reply in self._late if when <= self.time_s)
        self._late = [entry for entry in self._late if entry[0] > self.time_s]
        return due

    def forget_late(self) -> None:
        """Discard the delayed replies after a reset of the device."""
        self._late.clear()
