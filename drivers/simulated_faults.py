"""Faults that a simulated drive can be told to have, as data; no driver imports this."""

from __future__ import annotations

import enum
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, Generic, TypeVar

Kind = TypeVar("Kind", bound=enum.StrEnum)


@dataclass(frozen=True, slots=True)
class Fault(Generic[Kind]):
    """Describe one fault in the time of the wire, counted from the simulator's first call.

    A state fault lasts from start_s to end_s. A link fault strikes ``count`` messages (None: all)
    about ``target`` (command number or object index; None: any) in that time. A fault that happens
    at a moment does so once, at start_s. ``value``: what the kind of fault says.
    """

    kind: Kind
    start_s: float = 0.0
    end_s: float = math.inf
    target: int | None = None
    count: int | None = None
    value: float | None = None


class FaultPlan(Generic[Kind]):
    """Tell which faults are active at a time, and count down the link faults.

    faults: records, or tables such as ``{"kind": "wrong_crc", "count": 2}``. Raises ValueError for
    an unknown kind and TypeError for an unknown key.
    """

    def __init__(
        self, kinds: type[Kind], faults: Iterable[Fault[Kind] | Mapping[str, Any]] = ()
    ) -> None:
        self._kinds = kinds
        self._faults: list[Fault[Kind]] = []
        for fault in faults:
            if isinstance(fault, Fault):
                self._faults.append(fault)
            else:
                self.add(**fault)

    def add(self, kind: Kind | str, **data: Any) -> None:
        """Add a fault while the simulation runs."""
        self._faults.append(Fault(self._kinds(kind), **data))

    def clear(self, kind: Kind | str) -> None:
        """Forget all faults of a kind."""
        wanted = self._kinds(kind)
        self._faults = [fault for fault in self._faults if fault.kind is not wanted]

    def active(self, kind: Kind, time_s: float, default: float = 0.0) -> float | None:
        """Return the value of a state fault that is active now, None when there is none."""
        for fault in self._faults:
            if fault.kind is kind and fault.start_s <= time_s < fault.end_s:
                return default if fault.value is None else fault.value
        return None

    def strike(self, kind: Kind, time_s: float, target: int, default: float = 0.0) -> float | None:
        """Return the value of a fault that strikes this message, and count it; None for none."""
        for position, fault in enumerate(self._faults):
            hit = fault.kind is kind and fault.start_s <= time_s < fault.end_s
            if not hit or fault.target not in (None, target) or fault.count == 0:
                continue
            if fault.count is not None:
                self._faults[position] = replace(fault, count=fault.count - 1)
            return default if fault.value is None else fault.value
        return None

    def take(self, kind: Kind, time_s: float, default: float = 0.0) -> float | None:
        """Return the value of a fault that happens at a moment that has come, once."""
        for fault in self._faults:
            if fault.kind is kind and fault.start_s <= time_s:
                self._faults.remove(fault)
                return default if fault.value is None else fault.value
        return None
