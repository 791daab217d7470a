"""The test under way, or the last one: what it is, what it has come to, and how it ends."""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass, field
from pathlib import Path

from rigapp.config.loading import Document
from rigapp.config.recipe import LimitsSection, TestFile
from rigapp.engine.judging.testrun import TestRun
from rigapp.engine.recording.recorder import Recorder
from rigapp.schema.messages import Prediction
from rigapp.schema.notices import Finished
from rigapp.schema.states import Ending


@dataclass(slots=True, eq=False)
class ActiveTest:
    """One test.

    fresh: its file was made by its own start. steady_from: ordinal of the first whole revolution at
    the set speed, None while it changes. off: power is off, or was asked to be. stood: the spindle
    was seen to stand at the end, or could not be shown to.
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
    steady_from: int | None = None
    ending: Ending | None = None
    fault_sentence: str = ""
    off: bool = False
    stopping_since: float = 0.0
    stood: bool = False
    finished: bool = False
    outcome: Finished | None = None
    prediction: Prediction | None = None
    prediction_at: float = 0.0
    committed: int = -1
    cycles_refused: int = 0
    triggers_refused: int = 0
    finishing: threading.Lock = field(default_factory=threading.Lock)

    @property
    def target_rpm(self) -> float:
        """Return the set speed."""
        return self.document.record.run.speed_rpm

    @property
    def ramp_rpm_per_s(self) -> float:
        """Return how fast the speed is changed."""
        return self.document.record.run.acceleration_rpm_per_s

    @property
    def rows(self) -> int:
        """Return the rows recorded."""
        return self.recorder.rows

    def begin(self, sample: int) -> None:
        """Take note of the device sample at which its time starts."""
        self.run.begin(sample)
        self.recorder.begin(sample)

    def end(self, ending: Ending) -> bool:
        """Take note of an end; True when the drive must be told: for the first, or for off."""
        first = self.ending is None
        if self.ending is None:
            self.ending = ending
            self.stopping_since = time.monotonic()
        elif ending.fault > self.ending.fault:
            self.fault_sentence = self.fault_sentence or ending.sentence
        tell = first or (ending.off and not self.off)
        self.off |= ending.off
        return tell
