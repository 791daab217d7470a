"""The steps of a test: step, speed and duration of any revolution.

A test without ``[[run.step]]`` is a sequence of one step. After the last step the sequence
continues with ``repeat_from_step`` until the planned revolutions are completed. The step of a
revolution thus depends only on its number, also in a resumed or extended test.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import accumulate

from rigapp.config.recipe import RunSection, RunStep
from rigapp.texts import say


@dataclass(frozen=True, slots=True)
class StepPlace:
    """One step at its position in a test.

    step: its number in the file, from 1; 0 in a test without steps. first, last: its revolutions.
    rest_s: rest of the crank after the last revolution.
    """

    step: int
    name: str
    first: int
    last: int
    speed_rpm: float
    acceleration_rpm_per_s: float
    rest_s: float

    @property
    def words(self) -> str:
        """Return the step's number and name as text."""
        named = f" ({self.name})" if self.name else ""
        return say("step {}{}", self.step, named) if self.step else say("the test")


class Sequence:
    """All steps of a test.

    ends: last revolution of each step in the first pass. loop_from, loop: number of revolutions
    before the repeated ones, and of the repeated ones.
    """

    def __init__(self, run: RunSection) -> None:
        self._steps = run.step or (RunStep(revolutions=run.revolutions),)
        self._numbered = bool(run.step)
        self._run = run
        self.ends = list(accumulate(revolutions_of(step, run) for step in self._steps))
        before = min(run.repeat_from_step, len(self._steps)) - 1
        self.loop_from = self.ends[before - 1] if before else 0
        self.loop = self.ends[-1] - self.loop_from
        self._loop_s = sum(
            revolutions_of(step, run) * 60.0 / self._speed(step) + step.rest_s
            for step in self._steps[before:]
        )

    @property
    def count(self) -> int:
        """Return the number of steps in the file, 0 without steps."""
        return len(self._steps) if self._numbered else 0

    @property
    def length(self) -> int:
        """Return the number of revolutions of one pass through all steps."""
        return self.ends[-1]

    @property
    def again(self) -> int:
        """Return the step with which the sequence continues after the last one."""
        return self._run.repeat_from_step

    @property
    def fastest_rpm(self) -> float:
        """Return the highest speed of all steps."""
        return max(self._speed(step) for step in self._steps)

    @property
    def fastest_key(self) -> str:
        """Return the key of the highest speed, for a sentence."""
        step = max(self._steps, key=self._speed)
        own = self._numbered and step.speed_rpm is not None
        return say("run.step {} speed_rpm", self._steps.index(step) + 1) if own else "run.speed_rpm"

    @property
    def slowest_rpm(self) -> float:
        """Return the lowest speed of all steps."""
        return min(self._speed(step) for step in self._steps)

    @property
    def lowest_acceleration_rpm_per_s(self) -> float:
        """Return the acceleration of the longest ramp."""
        return min(self._ramp(step) for step in self._steps)

    def at(self, revolution: int) -> StepPlace:
        """Return the step of a revolution, counted from 1."""
        rounds = max(0, -(-(revolution - self.ends[-1]) // self.loop))
        shift = rounds * self.loop
        index = bisect_left(self.ends, revolution - shift)
        step = self._steps[index]
        return StepPlace(
            step=index + 1 if self._numbered else 0,
            name=step.name,
            first=(self.ends[index - 1] if index else 0) + 1 + shift,
            last=self.ends[index] + shift,
            speed_rpm=self._speed(step),
            acceleration_rpm_per_s=self._ramp(step),
            rest_s=step.rest_s,
        )

    def stages(self, first: int, last: int) -> Iterator[StepPlace]:
        """Yield the steps of the revolutions first .. last."""
        while first <= last:
            stage = self.at(first)
            yield stage
            first = stage.last + 1

    def seconds(self, first: int, last: int) -> float:
        """Return the duration of revolutions first .. last with rests between, without ramps."""
        if first > last:
            return 0.0
        start = min(last, max(first, self.loop_from + 1))
        loops = (last - start) // self.loop
        return (
            self._seconds(first, start - 1, last)
            + loops * self._loop_s
            + self._seconds(start + loops * self.loop, last, last)
        )

    def _seconds(self, first: int, to: int, last: int) -> float:
        """Return the time of some revolutions, with rests except that after the last one."""
        return sum(
            (min(to, stage.last) - max(first, stage.first) + 1) * 60.0 / stage.speed_rpm
            + (stage.rest_s if stage.last <= to and stage.last < last else 0.0)
            for stage in self.stages(first, to)
        )

    def _speed(self, step: RunStep) -> float:
        return self._run.speed_rpm if step.speed_rpm is None else step.speed_rpm

    def _ramp(self, step: RunStep) -> float:
        own = step.acceleration_rpm_per_s
        return self._run.acceleration_rpm_per_s if own is None else own


def revolutions_of(step: RunStep, run: RunSection) -> int:
    """Return the revolutions of a step; a duration is converted at its set speed, without ramp."""
    if step.revolutions is not None:
        return step.revolutions
    speed = run.speed_rpm if step.speed_rpm is None else step.speed_rpm
    return max(1, round((step.duration_s or 0.0) * speed / 60.0))
