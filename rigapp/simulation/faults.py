"""Read fault files, and begin and end the faults on time.

A fault file is TOML::

    schema = 1
    [[fault]]
    kind = "cable_pull"
    device = "daq"            # device of the rig file (wire and device faults)
    at_revolution = 10.0      # start: at_s or at_revolution of the plant, at once without either
    duration_s = 2.0          # permanent without it
    [[fault]]
    kind = "stuck_value"
    channel = "probe_1"       # signal faults: force_1 ... probe_2, or a free channel with an input
    at_s = 30.0

Triggers are in plant time. The duration of a signal fault is plant time; that of a wire or device
fault is wall-clock time, as are the times of wire, drive's watchdog and host's time-outs.

Wire: cable_pull, hang (sent data are lost), hold (sent data are delayed, then delivered together),
garbage (value: bytes), truncated (value: bytes), split (value: bytes per piece), slow (value: s).
Signal: see ``disturbances.SignalFault``; slip_ring_spikes also has rate_per_s. Any other kind is
passed to the device's simulator, which has its own list, with value, count and target (command
number or object index). Every simulated drive has ignored_command (confirmed, not executed),
false_readback (it reports no power), false_standstill (its encoder is dead: it reports standstill),
turns_by_itself, slow_command (value: s until it is confirmed), restart_unseen and watchdog_lost.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Protocol

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.reading import read_text
from rigapp.config.toml import toml_tree
from rigapp.schema.channels import ChannelTable
from rigapp.schema.faults import FaultRecord
from rigapp.simulation.disturbances import BRIDGES, SignalFault
from rigapp.simulation.wire.link import WireFault
from rigapp.texts import joined

WIRE_KINDS = frozenset(WireFault)
SIGNAL_KINDS = frozenset(SignalFault)
"""Fault kinds whose duration is plant time."""


class FaultFile(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A fault file."""

    schema: int
    fault: tuple[FaultRecord, ...] = ()


class Victim(Protocol):
    """The target of faults: the simulated rig."""

    def begin(self, fault: FaultRecord) -> None:
        """Begin a fault."""

    def end(self, fault: FaultRecord) -> None:
        """End a fault."""


def read_faults(path: Path) -> tuple[FaultRecord, ...]:
    """Read a fault file; raise UnusableInput."""
    try:
        file = msgspec.convert(toml_tree(read_text(path), path), type=FaultFile)
    except msgspec.ValidationError as error:
        raise UnusableInput("{}: not a list of faults: {}.", path, error) from error
    if file.schema != 1:
        raise UnusableInput("{}: schema = {} is not readable; write schema = 1.", path, file.schema)
    return file.fault


def fault_of(tree: dict[str, Any]) -> FaultRecord:
    """Return the fault in a control message's table; raise UnusableInput."""
    try:
        return msgspec.convert(tree, FaultRecord)
    except msgspec.ValidationError as error:
        raise UnusableInput("fault: {}.", error) from error


def check_fault(fault: FaultRecord, devices: Sequence[str], channels: ChannelTable) -> None:
    """Check that a fault names a device of the rig or an input; raise UnusableInput."""
    if fault.kind in SIGNAL_KINDS:
        _check_channel(fault, channels)
        return
    if fault.device not in devices:
        known = ", ".join(devices)
        raise UnusableInput(
            "fault {}: device = {} is not in the rig; it has {}.",
            fault.kind,
            repr(fault.device),
            known,
        )


def _check_channel(fault: FaultRecord, channels: ChannelTable) -> None:
    """Check that the channel of a signal fault has an input; raise UnusableInput."""
    where, name = f"fault {fault.kind}: channel", fault.channel
    known = [channel.name for channel in channels.sampled]
    if fault.kind == SignalFault.SWAPPED_BRIDGES:
        known = list(BRIDGES)
    if not name and fault.kind == SignalFault.STUCK_VALUE:
        raise UnusableInput("{} is missing; choose one of {}.", where, joined(", ", known))
    if name in channels and channels[name] in channels.slow:
        device = channels[name].device
        raise UnusableInput(
            "{} = {} has no input; give device = {} a fault.", where, repr(name), repr(device)
        )
    if name and name not in known:
        raise UnusableInput(
            "{} = {} cannot have it; choose one of {}.", where, repr(name), joined(", ", known)
        )


class Timetable:
    """Begin and end faults when they are due."""

    def __init__(self, faults: Sequence[FaultRecord] = ()) -> None:
        self._waiting = list(faults)
        self._active: list[tuple[FaultRecord, float]] = []

    def add(self, fault: FaultRecord) -> None:
        """Add a fault."""
        self._waiting.append(fault)

    def act(self, victim: Victim, now_s: float, plant_s: float, revolutions: float) -> None:
        """Begin the faults that are due and end those that have expired."""
        for fault in [f for f in self._waiting if _due(f, plant_s, revolutions)]:
            self._waiting.remove(fault)
            victim.begin(fault)
            clock = plant_s if fault.kind in SIGNAL_KINDS else now_s
            span = math.inf if fault.duration_s is None else fault.duration_s
            self._active.append((fault, clock + span))
        for entry in list(self._active):
            fault, end = entry
            if (plant_s if fault.kind in SIGNAL_KINDS else now_s) >= end:
                self._active.remove(entry)
                victim.end(fault)

    def clear(self, victim: Victim, kind: str) -> None:
        """End the active faults of a kind now and remove the pending ones."""
        self._waiting = [fault for fault in self._waiting if fault.kind != kind]
        for entry in [e for e in self._active if e[0].kind == kind]:
            self._active.remove(entry)
            victim.end(entry[0])


def _due(fault: FaultRecord, plant_s: float, revolutions: float) -> bool:
    if fault.at_s is not None and plant_s < fault.at_s:
        return False
    return fault.at_revolution is None or abs(revolutions) >= fault.at_revolution
