"""Run of a test: numbers its revolutions, fills their rows and evaluates them.

Numbering: the first row is the first revolution that begins at an index after the start command;
the ramp is part of the test, its revolutions have the flag RAMP. Each revolution of the crank from
then on counts, of any quality, up to the planned number; one lost in a gap of the data counts too
and leaves a gap in the numbers. A pause does not end a revolution: its row has the flag PAUSED,
without the samples of the standstill.
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
    """A row with its revolution; named: its values by column."""

    number: int
    values: Array
    named: Mapping[str, float]
    measured: Measured
    verdicts: tuple[LevelPassed, ...]
    last: bool
    met: CriterionMet | None = None


class TestRun:
    """Converter of the revolutions of one test to rows; ``take`` is for the processing thread.

    first: number of the first revolution to record. planned: number of the last. time_offset_s:
    the test's time at the start (not 0 after a resume). utc: UTC seconds of a host time. stops: the
    stop criteria. slow: the columns of the slow channels at a host time. joint, depth: the checks
    of the twin's predictions. step: number of the step of a revolution.
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
        """Number, reduce and evaluate a revolution; None if it is not part of the test.

        steady: the set speed was constant during all of it.
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
        """Return the duration of a revolution in host time, which a simulated rig may outrun."""
        speed = float(row[self.calibration.table.place["speed"]])
        lasted_s = 60.0 / speed if speed > 0.0 else 0.0
        if self._ended_ns is None:
            return lasted_s
        return min(lasted_s, (host_time_ns - self._ended_ns) * 1e-9)
