"""The wire between a simulated device and the host: a bounded queue, and faults of the wire.

A pty or socket buffers data; a device loses them. So data that cannot be sent at once wait in a
bounded queue, and when that is full the OLDEST measured data are dropped, whole deliveries at a
time, never a partly sent one. Replies are kept. Faults act between queue and endpoint, on the
wire's clock.
"""

from __future__ import annotations

import collections
import enum
import math
import random
from dataclasses import dataclass

from rigapp.simulation.wire.endpoints import Endpoint

QUEUE_BYTES = 65536  # some 0.2 s of a GSV-8 at its highest rate
HELD_BYTES = 1 << 24  # limit during the fault ``hold``: minutes of the example rigs
HANDOVER_S = 0.00015  # a pty passes bytes on in less than 0.1 ms


class WireFault(enum.StrEnum):
    """The faults of a wire."""

    CABLE_PULL = "cable_pull"
    HANG = "hang"
    HOLD = "hold"  # the device's output is held back, then delivered together
    GARBAGE = "garbage"
    TRUNCATED = "truncated"
    SPLIT = "split"
    SLOW = "slow"


@dataclass(slots=True)
class _Delivery:
    data: bytes
    due_s: float
    droppable: bool


class OutputQueue:
    """Queue of data not yet read by the host, at most ``limit`` bytes."""

    def __init__(self, limit: int = QUEUE_BYTES) -> None:
        self.limit = limit
        self.bytes = 0
        self._deliveries: collections.deque[_Delivery] = collections.deque()
        self._sent = 0

    def push(self, data: bytes, due_s: float, droppable: bool) -> bool:
        """Append a delivery; return False if older ones were dropped for it."""
        self._deliveries.append(_Delivery(data, due_s, droppable))
        self.bytes += len(data)
        kept_all = True
        while self.bytes > self.limit and len(self._deliveries) > 1:
            self._drop_oldest()
            kept_all = False
        return kept_all

    def head(self, now_s: float) -> memoryview:
        """Return the next bytes to send, empty if none are due."""
        if not self._deliveries or self._deliveries[0].due_s > now_s:
            return memoryview(b"")
        return memoryview(self._deliveries[0].data)[self._sent :]

    def sent(self, count: int) -> None:
        """Remove ``count`` sent bytes of the head."""
        self._sent += count
        self.bytes -= count
        if self._sent == len(self._deliveries[0].data):
            self._deliveries.popleft()
            self._sent = 0

    def clear(self) -> None:
        """Drop everything."""
        self._deliveries.clear()
        self.bytes = 0
        self._sent = 0

    def _drop_oldest(self) -> None:
        first = 1 if self._sent else 0
        last = len(self._deliveries) - 1
        for position in range(first, last):
            if self._deliveries[position].droppable:
                break
        else:
            position = min(first, last)
        self.bytes -= len(self._deliveries[position].data)
        del self._deliveries[position]


class SimulatedWire:
    """Transport bytes between one simulated device and the host of its endpoint.

    Fault options: garbage ``bytes`` before each delivery, truncated ``bytes`` cut out of one,
    split into pieces of ``bytes``, slow by ``delay_s``.
    """

    def __init__(self, endpoint: Endpoint, *, seed: int = 1, limit: int = QUEUE_BYTES) -> None:
        self.endpoint = endpoint
        self.dropped = 0
        self._fresh = 0
        self._fresh_s = -math.inf
        self._queue = OutputQueue(limit)
        self._limit = limit
        self._random = random.Random(seed)
        self._faults: dict[WireFault, float] = {}

    def start_fault(self, fault: WireFault, value: float = 0.0) -> None:
        """Begin a fault; value: bytes or seconds, see the class."""
        self._faults[fault] = value
        if fault is WireFault.CABLE_PULL:
            self._queue.clear()
            self.endpoint.pull()
        elif fault is WireFault.HOLD:
            self._queue.limit = HELD_BYTES

    def stop_fault(self, fault: WireFault) -> None:
        """End a fault; no effect if it is not active."""
        self._faults.pop(fault, None)
        if fault is WireFault.CABLE_PULL:
            self.endpoint.restore()

    def connected(self) -> bool:
        """Return whether a host has the port open."""
        connected = self.endpoint.connected()
        if not connected:
            self._queue.clear()
        return connected

    def receive(self) -> bytes:
        """Return the host's data; nothing while the device hangs."""
        data = self.endpoint.read()
        return b"" if WireFault.HANG in self._faults else data

    def send(self, data: bytes, now_s: float, *, droppable: bool) -> bool:
        """Queue a delivery and send as much as possible; return False if older were dropped."""
        if not data or WireFault.HANG in self._faults or not self.endpoint.connected():
            return True
        data = self._damaged(data)
        if not data:
            return True
        due = now_s + self._faults.get(WireFault.SLOW, 0.0)
        kept_all = self._queue.push(data, due, droppable)
        self.dropped += not kept_all
        self.flush(now_s)
        return kept_all

    def flush(self, now_s: float) -> None:
        """Send the data that are due, as much as the endpoint accepts."""
        if WireFault.HOLD in self._faults:
            return
        piece = int(self._faults.get(WireFault.SPLIT, 0.0))
        while head := self._queue.head(now_s):
            offered = head[:piece] if piece else head
            count = self.endpoint.write(offered)
            if count:
                self._queue.sent(count)
                self._note(count, now_s)
            if count < len(offered) or piece:
                return
        if not self._queue.bytes:
            self._queue.limit = self._limit

    def waiting(self) -> int:
        """Return the bytes in the queue."""
        return self._queue.bytes

    def backlog(self, now_s: float) -> int:
        """Return the number of bytes in the queue and of those not yet read by the host.

        The kernel passes data on with a delay: data sent just now count as unread. Data held back
        by a fault are no backlog: the device continues measuring.
        """
        if WireFault.HOLD in self._faults:
            return 0
        fresh = self._fresh if now_s - self._fresh_s < HANDOVER_S else 0
        return self._queue.bytes + max(fresh, self.endpoint.unread())

    def close(self) -> None:
        """Release the endpoint; never raises."""
        self.endpoint.close()

    def _note(self, count: int, now_s: float) -> None:
        if now_s - self._fresh_s >= HANDOVER_S:
            self._fresh = 0
        self._fresh += count
        self._fresh_s = now_s

    def _damaged(self, data: bytes) -> bytes:
        truncated = self._faults.get(WireFault.TRUNCATED)
        if truncated is not None:
            cut = min(max(1, int(truncated)), len(data))
            start = self._random.randrange(len(data) - cut + 1)
            data = data[:start] + data[start + cut :]
        garbage = self._faults.get(WireFault.GARBAGE)
        if garbage is not None:
            data = self._random.randbytes(max(1, int(garbage))) + data
        return data
