"""What those who judge see of the run and of the rig, and the few things they may do to them.

``JudgedRun`` is what all threads share, ``JudgedRig`` the devices as they are connected now; no
more of the engine is needed to judge. An attribute that stands here is set by its owner alone.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol

from rigapp.config.loading import Document
from rigapp.config.recipe import LimitsSection
from rigapp.config.rig import RigFile
from rigapp.config.sequence import Sequence, StepPlace
from rigapp.engine.drive.driving import SpindleControl
from rigapp.engine.drive.timing import Timing
from rigapp.engine.judging.alarms import AlarmBook
from rigapp.engine.judging.testrun import Row, TestRun
from rigapp.engine.samples.assembler import Assembler
from rigapp.engine.samples.motion import MotionWindow
from rigapp.engine.samples.slow import SlowChannels
from rigapp.engine.values.calibrate import Calibration
from rigapp.schema.alarms import Cause
from rigapp.schema.channels import ChannelTable
from rigapp.schema.messages import RunState
from rigapp.schema.states import Ending, Trigger
from rigapp_drivers.edge import GuardedSource, GuardedSpindle


class OpenTest(Protocol):
    """The test under way, or the last one.

    run: numbers and judges its revolutions. sequence: its steps; stage: the one that the crank is
    in. steady_from: ordinal of the first whole revolution at the set speed, None while it changes;
    the guard sets it. stood: the spindle was seen to stand at its end.
    """

    run: TestRun
    sequence: Sequence
    stage: StepPlace
    steady_from: int | None
    stood: bool

    @property
    def target_rpm(self) -> float:
        """Return the set speed of the step."""

    @property
    def ramp_rpm_per_s(self) -> float:
        """Return how fast the speed is changed."""

    @property
    def rows(self) -> int:
        """Return the rows recorded."""

    def begin(self, sample: int) -> None:
        """Take note of the device sample at which its time starts."""


class JudgedRun(Protocol):
    """The state of the run, its limits and alarms, and what follows from a judgement.

    rig: the rig file. table: its channels and columns.
    """

    rig: Document[RigFile]
    table: ChannelTable
    timing: Timing
    alarms: AlarmBook

    @property
    def state(self) -> RunState:
        """Return the present state."""

    @property
    def limits(self) -> LimitsSection:
        """Return the limits in force."""

    @property
    def test(self) -> OpenTest | None:
        """Return the test under way, or the last one."""

    def warn(self, cause: Cause) -> None:
        """Raise an alarm that does nothing else."""

    def act_on(self, cause: Cause, off: bool = False) -> None:
        """Raise an alarm and do what the table says of it; off: without power in any case."""

    def trip(self, ending: Ending, cause: Cause | None = None) -> bool:
        """End the test under way; the drive is commanded before this returns."""

    def fire_if(self, trigger: Trigger, reason: str = "", only: Iterable[RunState] = ()) -> bool:
        """Carry out a transition when it is possible (and the state is one of ``only``)."""

    def gap(self, text: str) -> None:
        """Write an interruption of the data to the file, and count it."""

    def note_limit(self, cause: Cause) -> None:
        """Write a limit that is passed to the log, and do nothing else."""

    def record(self, row: Row) -> None:
        """Store a judged revolution of the test under way, then publish it."""


class JudgedSamples(Protocol):
    """What the samples have come to so far.

    calibration: the one in use. next_sample: device sample that is expected next; saturated_until:
    the same behind the last block with a saturated one.
    """

    assembler: Assembler
    motion: MotionWindow
    calibration: Calibration
    next_sample: int
    saturated_until: int


class JudgedRig(Protocol):
    """The devices of a rig and what they show."""

    source: GuardedSource
    spindle: GuardedSpindle
    control: SpindleControl
    slow_channels: SlowChannels
    counts_per_turn: float

    @property
    def processor(self) -> JudgedSamples:
        """Return what the samples have come to."""

    @property
    def swinging(self) -> bool:
        """Tell whether the crank may turn as it likes: its power is off, or was asked to be."""

    def pause(self, reason: str) -> bool:
        """Begin to pause at the safe angle, when the state allows it; tell whether it does."""

    def go_on_to(self, stage: StepPlace) -> None:
        """Begin the next step of the test: rest before it, or go to its speed."""

    def queue_age_s(self) -> float:
        """Return the age of the oldest samples that are not processed yet."""

    def age_s(self, since_s: float) -> float:
        """Return how long ago a host time was, as a silence is judged."""
