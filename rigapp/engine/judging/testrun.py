"""One test under way: numbers its revolutions, fills their rows, judges, stores, publishes.

Which revolutions count. The first row is the first revolution that begins at an index after the
start command; the ramp is part of the test, its revolutions carry the flag RAMP. Every revolution
the crank makes from then on counts, whatever its quality, up to the planned number; a revolution
lost in a gap of the data counts too and leaves a gap in the numbers. A pause does not end a
revolution: its row carries the flag PAUSED, and the samples of the standstill are left out.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp.config.recipe import StopSection
from rigapp.engine.judging.criteria import CriterionMet, StopMonitor
from rigapp.engine.judging.depthwatch import DepthWatch
from rigapp.engine.judging.jointwatch import JointWatch
from rigapp.engine.judging.limits import LevelPassed, RuleMonitor
from rigapp.engine.samples.assembler import Revolution
from rigapp.engine.values.calibrate import Calibration, Measured
from rigapp.engine.values.reduce import Reducer
from rigapp.schema.messages import NOT_STEADY, Flag

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Row:
    """A finished row with its revolution; named: its values by column."""

    number: int
    values: Array
    named: Mapping[str, float]
    measured: Measured
    verdicts: tuple[LevelPassed, ...]
    last: bool
    met: CriterionMet | None = None


class TestRun:
    """Turn the revolutions of one test into rows; the processing thread calls ``take``.

    first: number of the first revolution to record. planned: number of the last. time_offset_s:
    the test's time at its start (not 0 when it was resumed). utc: UTC seconds of a host time.
    stops: the criteria that end the test before. slow: the columns of the slow channels at a host
    time. joint, depth: the checks of the twin's answers. step: number of the step of a
    revolution.
    """

    __test__ = False

    def __init__(
        self,
        calibration: Calibration,
        monitor: RuleMonitor,
        first: int,
        planned: int,
        time_offset_s: float,
        utc: Callable[[int, float], float],
        resumed: bool,
        stops: StopMonitor | None = None,
        slow: Callable[[int, float], Mapping[str, float]] = lambda host_time_ns, lasted_s: {},
        joint: JointWatch | None = None,
        depth: DepthWatch | None = None,
        step: Callable[[int], int] = lambda number: 0,
    ) -> None:
        self.calibration = calibration
        self.monitor = monitor
        self.stops = stops if stops is not None else StopMonitor(StopSection())
        self.joint = joint if joint is not None else JointWatch()
        self.depth = depth if depth is not None else DepthWatch()
        self.first = first
        self.planned = planned
        self.time_offset_s = time_offset_s
        self.number = first - 1
        self.start_sample: int | None = None
        self.complete = False
        self.newest: Row | None = None
        self.evaluated: Row | None = None
        self._reducer = Reducer(calibration)
        self._utc = utc
        self._slow = slow
        self.step = step
        self._resumed = resumed
        self._first_ordinal: int | None = None
        self._ended_ns: int | None = None

    def begin(self, sample: int) -> None:
        """Set the device sample at which the test's time starts."""
        self.start_sample = sample

    def take(self, revolution: Revolution, steady: bool) -> Row | None:
        """Number a revolution, reduce and judge it; None when it does not belong to the test.

        steady: the engine was not changing the speed in any part of it.
        """
        if self.complete or self.start_sample is None:
            return None
        if self._first_ordinal is None:
            self._first_ordinal = revolution.ordinal
        number = self.first + revolution.ordinal - self._first_ordinal
        if number > self.planned:
            self.complete = True
            return None
        measured = Measured(revolution, self.calibration)
        row = self._reducer.reduce(measured)
        flags = revolution.flags
        if not steady:
            flags |= Flag.RAMP
        if self._resumed:
            flags |= Flag.GAP_BEFORE
            self._resumed = False
        elapsed = (revolution.end_sample - self.start_sample) / revolution.sample_rate_Hz
        index = self.calibration.table.place
        row[index["revolution"]] = number
        row[index["time"]] = elapsed + self.time_offset_s
        row[index["host_time"]] = self._utc(
            revolution.host_time_ns, revolution.later_samples / revolution.sample_rate_Hz
        )
        row[index["quality"]] = int(flags)
        ended_ns = revolution.host_time_ns
        for name, value in self._slow(ended_ns, self._lasted_s(row, ended_ns)).items():
            row[index[name]] = value
        named = dict(zip(index, row.tolist(), strict=True))
        steady = not flags & NOT_STEADY
        verdicts = tuple(self.monitor.judge(named, self.step(number))) if steady else ()
        self.number = number
        self.complete = number >= self.planned
        met = self.stops.row(row)
        self._ended_ns = ended_ns
        self.newest = Row(number, row, named, measured, verdicts, self.complete, met)
        self.evaluated = self.newest if steady else self.evaluated
        return self.newest

    def _lasted_s(self, row: NDArray[np.float64], host_time_ns: int) -> float:
        """Return how long a revolution took in host time, which a simulated rig may outrun."""
        speed = float(row[self.calibration.table.place["speed"]])
        lasted_s = 60.0 / speed if speed > 0.0 else 0.0
        if self._ended_ns is None:
            return lasted_s
        return min(lasted_s, (host_time_ns - self._ended_ns) * 1e-9)
