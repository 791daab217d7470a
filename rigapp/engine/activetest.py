"""The test under way, or the last one: its step, its file, its progress, its end."""

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
"""Changes of step that the log of a test has room for, each with its states and its rest; of the
8192 lines they take at most 3500. Which step a later revolution belongs to follows from its number.
"""


@dataclass(slots=True, eq=False)
class Rest:
    """A rest between two steps; its duration begins when the crank is stationary.

    step: after which it is. since_s: host time of the standstill, None before. signals: of the
    load cell at that time.
    """

    duration_s: float
    step: int
    since_s: float | None = None
    signals: RestSignals | None = None

    def left_s(self, pace: float) -> float:
        """Return the rig's time until its end. pace: the rig's seconds in one of this computer."""
        rested = 0.0 if self.since_s is None else time.monotonic() - self.since_s
        return max(0.0, self.duration_s - rested * pace)


@dataclass(slots=True, eq=False)
class ActiveTest:
    """One test.

    stage: the step that the crank is in; changes: of step, so far. approach: how a regular end
    brings the crank to its rest. resting: the rest between two steps, None while there is none.
    fresh: its file was made by its own start. steady_from: ordinal of the first whole revolution at
    the set speed, None while it changes. off: power is off, or was commanded off. stood: the
    spindle was stationary at the end, or could not be shown to be.
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
        """Return whether the log has room for the present change of step."""
        return self.changes <= STEPS_LOGGED

    @property
    def target_rpm(self) -> float:
        """Return the set speed of the step."""
        return self.stage.speed_rpm

    @property
    def ramp_rpm_per_s(self) -> float:
        """Return how fast the speed of the step is reached."""
        return self.stage.acceleration_rpm_per_s

    @property
    def rows(self) -> int:
        """Return the rows recorded."""
        return self.recorder.rows

    def begin(self, sample: int) -> None:
        """Set the device sample at which its time starts."""
        self.run.begin(sample)
        self.recorder.begin(sample)

    def end(self, ending: Ending) -> bool:
        """Record an end; True when the drive must be commanded.

        For the first, for off, and for what is not regular: it forbids to turn on to the rest.
        """
        first = self.ending is None
        if self.ending is None:
            self.ending = ending
            self.stopping_since = time.monotonic()
        elif ending.fault > self.ending.fault:
            self.fault_sentence = self.fault_sentence or ending.sentence
        tell = first or (ending.off and not self.off) or not (ending.off or ending.regular)
        self.off |= ending.off
        return tell
