"""The present or last test: its step, its file, its progress, its end."""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass, field
from pathlib import Path

from rigapp.config.loading import Document
from rigapp.config.recipe import LimitsSection, TestFile
from rigapp.config.sequence import Sequence, StepPlace
from rigapp.engine.drive.driving import RestApproach
from rigapp.engine.judging.testrun import TestRun
from rigapp.engine.recording.recorder import Recorder
from rigapp.schema.loglines import RestSignals
from rigapp.schema.messages import Prediction
from rigapp.schema.notices import Finished
from rigapp.schema.states import Ending

STEPS_LOGGED = 500
"""Changes of step in the log of a test, each with its states and its rest: at most 3500 of the
8192 lines. The step of a later revolution follows from its number.
"""


@dataclass(slots=True, eq=False)
class Rest:
    """Rest between two steps; its duration begins when the crank is stationary.

    step: the step before it. since_s: host time of the standstill, None before. signals: of the
    load cell at that time.
    """

    duration_s: float
    step: int
    since_s: float | None = None
    signals: RestSignals | None = None

    def left_s(self, pace: float) -> float:
        """Return the remaining time of the rig. pace: seconds of the rig per second of the host."""
        elapsed_s = 0.0 if self.since_s is None else time.monotonic() - self.since_s
        return max(0.0, self.duration_s - elapsed_s * pace)


@dataclass(slots=True, eq=False)
class ActiveTest:
    """One test.

    stage: present step; changes: of step, so far. approach: to the angle of rest at a regular end.
    resting: present rest between two steps, else None. fresh: its start created the file.
    steady_from: ordinal of the first complete revolution at the set speed, None while it changes.
    off: power is off, or was commanded off. reached_standstill: the spindle is stationary at the
    end, or that could not be confirmed.
    """

    document: Document[TestFile]
    path: Path
    run: TestRun
    recorder: Recorder
    limits: LimitsSection
    operator: str
    started_at: float
    deadline_s: float
    fresh: bool
    sequence: Sequence
    stage: StepPlace
    approach: RestApproach
    resting: Rest | None = None
    changes: int = 0
    steady_from: int | None = None
    ending: Ending | None = None
    fault_sentence: str = ""
    off: bool = False
    stopping_since: float = 0.0
    reached_standstill: bool = False
    finished: bool = False
    outcome: Finished | None = None
    prediction: Prediction | None = None
    prediction_at: float = 0.0
    revolution_at: float | None = None
    committed: int = -1
    cycles_refused: int = 0
    triggers_refused: int = 0
    finishing: threading.Lock = field(default_factory=threading.Lock)

    @property
    def logs_steps(self) -> bool:
        """Return whether the present change of step is logged (``STEPS_LOGGED``)."""
        return self.changes <= STEPS_LOGGED

    @property
    def target_rpm(self) -> float:
        """Return the set speed of the step."""
        return self.stage.speed_rpm

    @property
    def ramp_rpm_per_s(self) -> float:
        """Return the acceleration of the step."""
        return self.stage.acceleration_rpm_per_s

    @property
    def rows(self) -> int:
        """Return the number of recorded rows."""
        return self.recorder.rows

    def begin(self, sample: int) -> None:
        """Set the device sample at which its time starts."""
        self.run.begin(sample)
        self.recorder.begin(sample)

    def end(self, ending: Ending) -> bool:
        """Record an end; return whether the drive must be commanded.

        For the first end, for power off, and for an irregular one: that excludes the approach to
        the angle of rest.
        """
        first = self.ending is None
        if self.ending is None:
            self.ending = ending
            self.stopping_since = time.monotonic()
        elif ending.fault > self.ending.fault:
            self.fault_sentence = self.fault_sentence or ending.sentence
        must_command = first or (ending.off and not self.off) or not (ending.off or ending.regular)
        self.off |= ending.off
        return must_command
