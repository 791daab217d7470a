"""Unsolicited messages of a drive, with time stamps: heartbeat, emergencies, TPDOs."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from rigapp_drivers.cia402.protocol import (
    Emergency,
    NodeState,
    parse_emergency,
    parse_status,
    parse_status_and_value,
)

HISTORY: Final = 64  # more than a fault and its consequential faults


@dataclass(frozen=True, slots=True)
class AxisMotion:
    """Status word, velocity and position in the drive's units."""

    status_word: int
    velocity: int
    position: int


class NodeMonitor:
    """Receive frames in the receiving thread; return the newest values in any other.

    The emergency history keeps the last 64 and drops the oldest.
    """

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._state: int | None = None
        self._heartbeat_ns: int | None = None
        self._boot_ups = 0
        self._emergencies = 0
        self._history: deque[Emergency] = deque(maxlen=HISTORY)
        self._active: dict[int, Emergency] = {}
        self._unseen: list[Emergency] = []
        self._status_word: int | None = None
        self._values: dict[str, int] = {}
        self._counts = {"velocity": 0, "position": 0}

    # --- receiving thread ------------------------------------------------------------------------

    def take_heartbeat(self, data: bytes, host_time_ns: int) -> None:
        """Process a heartbeat or boot-up message."""
        if not data:
            return
        with self._changed:
            self._state = data[0] & 0x7F
            self._heartbeat_ns = host_time_ns
            if self._state == NodeState.BOOT_UP:
                self._boot_ups += 1
            self._changed.notify_all()

    def take_emergency(self, data: bytes, host_time_ns: int) -> None:
        """Process an emergency message; code 0 ends all active errors."""
        emergency = parse_emergency(data, host_time_ns)
        if emergency is None:
            return
        with self._changed:
            self._history.append(emergency)
            self._emergencies += emergency.code != 0
            if emergency.code == 0:
                self._active.clear()
            else:
                self._active[emergency.code] = emergency
                self._unseen = [*self._unseen[-HISTORY:], emergency]
            self._changed.notify_all()

    def take_status(self, data: bytes, _: int) -> None:
        """Process a TPDO that begins with the status word."""
        word = parse_status(data)
        with self._changed:
            if word is not None:
                self._status_word = word
            self._changed.notify_all()

    def take_value(self, name: str, data: bytes, _: int) -> None:
        """Process the TPDO with the status word and ``velocity`` or ``position``."""
        pair = parse_status_and_value(data)
        if pair is None:
            return
        with self._changed:
            self._status_word, self._values[name] = pair
            self._counts[name] += 1
            self._changed.notify_all()

    # --- other threads ---------------------------------------------------------------------------

    @property
    def node_state(self) -> int | None:
        """Return the state of the last heartbeat, None before the first."""
        with self._changed:
            return self._state

    @property
    def boot_ups(self) -> int:
        """Return the number of received boot-up messages."""
        with self._changed:
            return self._boot_ups

    @property
    def emergencies(self) -> int:
        """Return the number of received emergency messages that report an error."""
        with self._changed:
            return self._emergencies

    @property
    def history(self) -> tuple[Emergency, ...]:
        """Return the last emergencies, oldest first."""
        with self._changed:
            return tuple(self._history)

    def active(self) -> tuple[Emergency, ...]:
        """Return the active emergencies."""
        with self._changed:
            return tuple(self._active.values())

    def take_passed(self) -> tuple[Emergency, ...]:
        """Return the emergencies that began and ended since the last call."""
        with self._changed:
            passed = tuple(e for e in self._unseen if e.code not in self._active)
            self._unseen = []
            return passed

    def forget_active(self) -> None:
        """Clear all active emergencies."""
        with self._changed:
            self._active.clear()
            self._unseen = []

    def heartbeat_age_s(self) -> float | None:
        """Return the age of the last heartbeat, None before the first."""
        with self._changed:
            stamp = self._heartbeat_ns
        return None if stamp is None else (time.monotonic_ns() - stamp) * 1e-9

    def wait_for_state(self, state: int, since_ns: int, timeout_s: float) -> bool:
        """Wait until a heartbeat received after since_ns reports a state."""

        def is_reported() -> bool:
            return self._state == state and (self._heartbeat_ns or 0) > since_ns

        with self._changed:
            return self._changed.wait_for(is_reported, timeout_s)

    def wait_for_heartbeat(self, younger_than_s: float, timeout_s: float) -> bool:
        """Wait for a heartbeat younger than a time, as frames may still be queued."""

        def is_young() -> bool:
            stamp = self._heartbeat_ns
            return stamp is not None and time.monotonic_ns() - stamp < younger_than_s * 1e9

        with self._changed:
            return self._changed.wait_for(is_young, timeout_s)

    def marks(self) -> dict[str, int]:
        """Return the present counts of motion TPDOs, for ``wait_for_motion`` after a SYNC."""
        with self._changed:
            return dict(self._counts)

    def wait_for_motion(self, marks: Mapping[str, int], timeout_s: float) -> AxisMotion | None:
        """Wait until both motion TPDOs were received since the marks; None on time-out."""

        def are_received() -> bool:
            return all(count > marks[name] for name, count in self._counts.items())

        with self._changed:
            if not self._changed.wait_for(are_received, timeout_s):
                return None
            assert self._status_word is not None
            return AxisMotion(self._status_word, **self._values)
