"""Match replies to requests on a line whose replies do not identify their request.

A device replies in the order of the requests. So a request that timed out stays pending, and the
next reply may belong to it. Two rules follow: a late reply is valid if no other request was sent
since, and no other request is sent before the pending reply has arrived or is considered lost.
If replies identify their request neither is needed: ``NamedQuestions`` only measures latency.
"""

from __future__ import annotations

import logging
import time
from collections import deque
from typing import Final

from rigapp.texts import say

FIRST_WAIT: Final = 2.0
"""Wait of the first try in time-outs; each further try waits one."""
GIVEN_UP: Final = 8.0
"""Time-outs after which a missing reply is considered lost."""
_ADVICE: Final = 2.0  # recommended time-out as a multiple of the measured latency

_log = logging.getLogger(__name__)


class OpenQuestions:
    """Track the pending requests of one line. Times in s of the monotonic clock.

    setting: the key of the time-out in the rig file; per_s: its units per second.
    late_s: the longest measured latency above the time-out, 0 if none. late: number of replies
    after their time-out.
    """

    def __init__(self, device: str, timeout_s: float, setting: str, per_s: float = 1.0) -> None:
        self.timeout_s = timeout_s
        self.late_s = 0.0
        self.late = 0
        self._device = device
        self._setting, self._per_s = setting, per_s
        self._sent_s: deque[float] = deque()

    def requested(self) -> None:
        """Record that a request was sent."""
        self._sent_s.append(time.monotonic())

    def answered(self) -> None:
        """Record a reply; it belongs to the oldest pending request."""
        if not self._sent_s:
            return
        self.measure(time.monotonic() - self._sent_s.popleft())

    def measure(self, latency_s: float) -> None:
        """Record the latency of a reply; log it if it exceeds the time-out."""
        if latency_s <= self.timeout_s:
            return
        self.late += 1
        if latency_s > 1.2 * self.late_s:
            self.late_s = latency_s
            _log.warning("%s: %s", self._device, self.words())
        self.late_s = max(self.late_s, latency_s)

    def open_until_s(self) -> float:
        """Return the time until which pending replies may arrive, 0 if none is pending.

        After that they are considered lost.
        """
        if not self._sent_s:
            return 0.0
        until_s = self._sent_s[-1] + max(GIVEN_UP * self.timeout_s, 2.0 * self.late_s)
        if time.monotonic() >= until_s:
            self._sent_s.clear()
            return 0.0
        return until_s

    def first_wait(self) -> float:
        """Return the wait of the first try in time-outs; longer once replies were late."""
        return max(FIRST_WAIT, min(GIVEN_UP, 1.5 * self.late_s / self.timeout_s))

    def waits(self, tries: int) -> tuple[float, ...]:
        """Return the wait of each try in time-outs; their sum equals the number of tries."""
        if tries < 2:
            return (1.0,) * tries
        return (self.first_wait(), *(1.0 for _ in range(tries - 2)))

    def words(self) -> str:
        """Return the advice on late replies, "" if none was late."""
        if not self.late_s:
            return ""
        advised = float(f"{_ADVICE * self.late_s * self._per_s:.2g}")
        return say(
            "answers come up to {:.2g} s late; set {} to {:g} or more",
            self.late_s,
            self._setting,
            advised,
        )


class NamedQuestions(OpenQuestions):
    """Measure the latency of late replies that identify their request.

    A late reply is measured only after its request has ended: while the request is retried, the
    reply may belong to either try.
    """

    def __init__(self, device: str, timeout_s: float, setting: str, per_s: float = 1.0) -> None:
        super().__init__(device, timeout_s, setting, per_s)
        self._name: str | bytes = ""
        self._tries_s: list[float] = []
        self._sent_by_name_s: dict[str | bytes, float] = {}

    def begin(self, name: str | bytes) -> None:
        """Begin a request."""
        self._name, self._tries_s = name, []
        self._sent_by_name_s.pop(name, None)

    def requested(self) -> None:
        """Record that the request was sent."""
        self._tries_s.append(time.monotonic())

    def leave(self, *, answered: bool) -> None:
        """End the request; replies to its tries may still arrive."""
        if not answered:
            self._sent_by_name_s[self._name] = self._tries_s[0]
        elif len(self._tries_s) > 1:
            self._sent_by_name_s[self._name] = self._tries_s[-1]

    def is_answer(self, name: str | bytes) -> bool:
        """Return whether a reply belongs to the request; measure it if it is a late one."""
        if name == self._name:
            return True
        sent_s = self._sent_by_name_s.pop(name, None)
        latency_s = 0.0 if sent_s is None else time.monotonic() - sent_s
        if latency_s < GIVEN_UP * self.timeout_s:
            self.measure(latency_s)
        return False
