"""Keep answers with their questions on a line whose answers do not say what they answer.

A device answers in the order in which it is asked. So a question that got no answer in time is
open, and the next answer may be its own. Two rules follow: a late answer that comes while nothing
else was asked is the right one, and nothing else is asked before what is open has come or is given
up for lost. Where answers name their question neither is needed: ``NamedQuestions`` measures only.
"""

from __future__ import annotations

import logging
import time
from collections import deque
from typing import Final

from rigapp.texts import say

FIRST_WAIT: Final = 2.0
"""Time-outs that the first try waits; the tries after it wait one each."""
GIVEN_UP: Final = 8.0
"""Time-outs after which an answer that has not come is held for lost."""
_ADVICE: Final = 2.0  # the time-out to set, in latencies that were measured

_log = logging.getLogger(__name__)


class OpenQuestions:
    """Account for the questions of one line. Times in s of the monotonic clock.

    setting: the key of the time-out in the rig file, and how many of its units are a second.
    late_s: the longest latency above the time-out that was measured, 0 without any. late: answers
    that came after their time-out.
    """

    def __init__(self, device: str, timeout_s: float, setting: str, per_s: float = 1.0) -> None:
        self.timeout_s = timeout_s
        self.late_s = 0.0
        self.late = 0
        self._device = device
        self._setting, self._per_s = setting, per_s
        self._asked_s: deque[float] = deque()

    def requested(self) -> None:
        """Note that a question was sent."""
        self._asked_s.append(time.monotonic())

    def answered(self) -> None:
        """Note that an answer came: it is that to the oldest open question."""
        if not self._asked_s:
            return
        self.measure(time.monotonic() - self._asked_s.popleft())

    def measure(self, latency_s: float) -> None:
        """Note how long an answer took; above the time-out it was late, which is told."""
        if latency_s <= self.timeout_s:
            return
        self.late += 1
        if latency_s > 1.2 * self.late_s:
            self.late_s = latency_s
            _log.warning("%s: %s", self._device, self.words())
        self.late_s = max(self.late_s, latency_s)

    def open_until_s(self) -> float:
        """Return until when answers to open questions may come, 0 when none is open.

        After that they are given up.
        """
        if not self._asked_s:
            return 0.0
        until_s = self._asked_s[-1] + max(GIVEN_UP * self.timeout_s, 2.0 * self.late_s)
        if time.monotonic() >= until_s:
            self._asked_s.clear()
            return 0.0
        return until_s

    def first_wait(self) -> float:
        """Return for how many time-outs the first try waits; longer once answers were late."""
        return max(FIRST_WAIT, min(GIVEN_UP, 1.5 * self.late_s / self.timeout_s))

    def waits(self, tries: int) -> tuple[float, ...]:
        """Return for how many time-outs each try waits: as many in all as there are tries."""
        if tries < 2:
            return (1.0,) * tries
        return (self.first_wait(), *(1.0 for _ in range(tries - 2)))

    def words(self) -> str:
        """Return what to do about late answers, "" when none was late."""
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
    """Measure how late answers are that name their question, so that none is taken for another's.

    A late answer is measured when it comes after its question was left: while a question is asked
    again, its answer may be that to either try.
    """

    def __init__(self, device: str, timeout_s: float, setting: str, per_s: float = 1.0) -> None:
        super().__init__(device, timeout_s, setting, per_s)
        self._name: str | bytes = ""
        self._tries_s: list[float] = []
        self._left_s: dict[str | bytes, float] = {}

    def begin(self, name: str | bytes) -> None:
        """Note what is asked from now on."""
        self._name, self._tries_s = name, []
        self._left_s.pop(name, None)

    def requested(self) -> None:
        """Note that the question was sent."""
        self._tries_s.append(time.monotonic())

    def leave(self, *, answered: bool) -> None:
        """Note that the question is left, with answers to its tries that may still come."""
        if not answered:
            self._left_s[self._name] = self._tries_s[0]
        elif len(self._tries_s) > 1:
            self._left_s[self._name] = self._tries_s[-1]

    def is_answer(self, name: str | bytes) -> bool:
        """Tell whether an answer is that to the question; measure it where it is a late one."""
        if name == self._name:
            return True
        asked_s = self._left_s.pop(name, None)
        latency_s = 0.0 if asked_s is None else time.monotonic() - asked_s
        if latency_s < GIVEN_UP * self.timeout_s:
            self.measure(latency_s)
        return False
