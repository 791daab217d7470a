"""Faults that a simulated RoboClaw can be told to have, as data."""

from __future__ import annotations

import enum
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any


class FaultKind(enum.StrEnum):
    """Name a fault; ``value`` of the fault means what stands behind it."""

    EMERGENCY_STOP = "emergency_stop"  # the S3 input is active
    OVER_CURRENT = "over_current"  # A, shown as the motor's current
    UNDER_VOLTAGE = "under_voltage"  # V of the main supply
    OVER_TEMPERATURE = "over_temperature"  # degrees C
    DRIVER_FAULT = "driver_fault"
    STATUS_BITS = "status_bits"  # bits to set in the status word
    WRONG_CRC = "wrong_crc"
    WRONG_ACKNOWLEDGE = "wrong_acknowledge"  # byte sent instead of FF
    NO_REPLY = "no_reply"
    LOST_COMMAND = "lost_command"  # the packet is neither obeyed nor answered
    SLOW_REPLY = "slow_reply"  # s of delay
    DUPLICATED_REPLY = "duplicated_reply"
    RESET = "reset"  # s until the drive answers again


@dataclass(frozen=True, slots=True)
class Fault:
    """Describe one fault in the time of the wire, counted from the simulator's first call.

    A state fault (emergency stop, over-current, ...) lasts from start_s to end_s. A link fault
    strikes ``count`` packets (None: all) of ``command`` (None: any) in that time. A reset happens
    once, at start_s.
    """

    kind: FaultKind
    start_s: float = 0.0
    end_s: float = math.inf
    command: int | None = None
    count: int | None = None
    value: float | None = None


def fault_of(data: Fault | Mapping[str, Any]) -> Fault:
    """Return a Fault from a table such as ``{"kind": "wrong_crc", "count": 2}``.

    Raises ValueError for an unknown kind and TypeError for an unknown key.
    """
    if isinstance(data, Fault):
        return data
    return replace(Fault(**data), kind=FaultKind(data["kind"]))


class FaultPlan:
    """Tell which faults are active at a time, and count down the link faults."""

    def __init__(self, faults: Iterable[Fault | Mapping[str, Any]]) -> None:
        self._faults = [fault_of(fault) for fault in faults]

    def add(self, fault: Fault) -> None:
        """Add a fault while the simulation runs."""
        self._faults.append(fault)

    def clear(self, kind: FaultKind) -> None:
        """Forget all faults of a kind."""
        self._faults = [fault for fault in self._faults if fault.kind is not kind]

    def active(self, kind: FaultKind, time_s: float, default: float = 0.0) -> float | None:
        """Return the value of a state fault that is active now, None when there is none."""
        for fault in self._faults:
            if fault.kind is kind and fault.start_s <= time_s < fault.end_s:
                return default if fault.value is None else fault.value
        return None

    def strike(
        self, kind: FaultKind, time_s: float, command: int, default: float = 0.0
    ) -> float | None:
        """Return the value of a fault that strikes this packet, and count it; None for none."""
        for position, fault in enumerate(self._faults):
            hit = fault.kind is kind and fault.start_s <= time_s < fault.end_s
            if not hit or fault.command not in (None, command) or fault.count == 0:
                continue
            if fault.count is not None:
                self._faults[position] = replace(fault, count=fault.count - 1)
            return default if fault.value is None else fault.value
        return None

    def take_reset(self, time_s: float, default: float) -> float | None:
        """Return the silence of a reset that is due, once; None for none."""
        for fault in self._faults:
            if fault.kind is FaultKind.RESET and fault.start_s <= time_s:
                self._faults.remove(fault)
                return default if fault.value is None else fault.value
        return None
