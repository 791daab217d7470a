"""What a drive says by itself, with time stamps: heartbeat, emergencies, TPDOs."""

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

HISTORY: Final = 64  # more than a fault and its followers


@dataclass(frozen=True, slots=True)
class AxisMotion:
    """Hold status word, velocity and position in the drive's units."""

    status_word: int
    velocity: int
    position: int


class NodeMonitor:
    """Take frames in the receiving thread; tell the newest in any other.

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
        """Take a heartbeat or boot-up message."""
        if not data:
            return
        with self._changed:
            self._state = data[0] & 0x7F
            self._heartbeat_ns = host_time_ns
            if self._state == NodeState.BOOT_UP:
                self._boot_ups += 1
            self._changed.notify_all()

    def take_emergency(self, data: bytes, host_time_ns: int) -> None:
        """Take an emergency message; code 0 ends all errors that are active."""
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
        """Take a TPDO that begins with the status word."""
        word = parse_status(data)
        with self._changed:
            if word is not None:
                self._status_word = word
            self._changed.notify_all()

    def take_value(self, name: str, data: bytes, _: int) -> None:
        """Take the TPDO with the status word and ``velocity`` or ``position``."""
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
        """Return how many boot-up messages came."""
        with self._changed:
            return self._boot_ups

    @property
    def emergencies(self) -> int:
        """Return how many emergency messages came that told of an error."""
        with self._changed:
            return self._emergencies

    @property
    def history(self) -> tuple[Emergency, ...]:
        """Return the last emergencies, oldest first."""
        with self._changed:
            return tuple(self._history)

    def active(self) -> tuple[Emergency, ...]:
        """Return the emergencies that are not over."""
        with self._changed:
            return tuple(self._active.values())

    def take_passed(self) -> tuple[Emergency, ...]:
        """Return the emergencies that came and went since the last call."""
        with self._changed:
            passed = tuple(e for e in self._unseen if e.code not in self._active)
            self._unseen = []
            return passed

    def forget_active(self) -> None:
        """Take all emergencies as over."""
        with self._changed:
            self._active.clear()
            self._unseen = []

    def heartbeat_age_s(self) -> float | None:
        """Return how long ago the last heartbeat came, None before the first."""
        with self._changed:
            stamp = self._heartbeat_ns
        return None if stamp is None else (time.monotonic_ns() - stamp) * 1e-9

    def wait_for_state(self, state: int, since_ns: int, timeout_s: float) -> bool:
        """Wait until a heartbeat that came after since_ns tells a state."""

        def is_told() -> bool:
            return self._state == state and (self._heartbeat_ns or 0) > since_ns

        with self._changed:
            return self._changed.wait_for(is_told, timeout_s)

    def wait_for_heartbeat(self, younger_than_s: float, timeout_s: float) -> bool:
        """Wait for a heartbeat that is younger than a time; frames may wait to be received."""

        def is_young() -> bool:
            stamp = self._heartbeat_ns
            return stamp is not None and time.monotonic_ns() - stamp < younger_than_s * 1e9

        with self._changed:
            return self._changed.wait_for(is_young, timeout_s)

    def marks(self) -> dict[str, int]:
        """Return marks to give to ``wait_for_motion`` after a SYNC."""
        with self._changed:
            return dict(self._counts)

    def wait_for_motion(self, marks: Mapping[str, int], timeout_s: float) -> AxisMotion | None:
        """Wait until both motion TPDOs have come since the marks; None when they did not."""

        def have_come() -> bool:
            return all(count > marks[name] for name, count in self._counts.items())

        with self._changed:
            if not self._changed.wait_for(have_come, timeout_s):
                return None
            assert self._status_word is not None
            return AxisMotion(self._status_word, **self._values)
