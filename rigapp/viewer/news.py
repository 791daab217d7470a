"""The data of the window at one moment, for every panel."""

from __future__ import annotations

import enum
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from rigapp.config.recipe import TestFile
from rigapp.schema.messages import NO_TEST, Event, RunState, Severity, Status
from rigapp.viewer.recording import TripCycles
from rigapp.viewer.series import LiveData

STALE_PREDICTION_S = 5.0
"""Predictions come once a revolution: at the usual 30 rpm, two dozen are missing by then."""


class Takes(enum.Flag):
    """The parts of the news that a panel takes, and so its updates.

    STATUS: every status, visible or not. REVOLUTION: the newest revolution, at every update while
    the panel is visible. HISTORY: all else, twice a second while it is visible. LOG: the test's log
    too, which is read while a panel takes it.
    """

    STATUS = enum.auto()
    REVOLUTION = enum.auto()
    HISTORY = enum.auto()
    LOG = enum.auto()


@dataclass(frozen=True, slots=True)
class News:
    """The newest of everything.

    status: None before the engine's first message. data: statistics, predictions and curves of the
    test that is shown; recipe, path, events: its test file, its file and its log; log_problem: why
    that cannot be read. silence_s: since the last message. data_age_s: of the newest sample.
    trip: the revolution in which the test tripped, from its file.
    """

    status: Status | None = None
    data: LiveData = field(default_factory=LiveData)
    recipe: TestFile | None = None
    path: Path | None = None
    events: Sequence[Event] = ()
    log_problem: str = ""
    silence_s: float = 0.0
    is_replay: bool = False
    data_age_s: float | None = None
    trip: TripCycles | None = None

    @property
    def crank_over_follower(self) -> float | None:
        """Return crank radius / follower length of the test, None when not known."""
        if self.recipe is None:
            return None
        mechanism = self.recipe.model.mechanism
        return mechanism.crank_radius_mm / mechanism.follower_length_mm

    @property
    def stale(self) -> bool:
        """Return whether the prediction has fallen behind a running test."""
        return self.status is not None and is_stale(self.status)


def tripped(status: Status) -> bool:
    """Return whether a critical alarm holds: then the plots show the trip."""
    return any(alarm.severity is Severity.CRITICAL for alarm in status.alarms)


def is_stale(status: Status) -> bool:
    """Return whether the prediction has fallen behind a running test."""
    test = status.test or NO_TEST
    age_s = test.twin_age_s
    return (
        status.engine.state is RunState.RUNNING and age_s is not None and age_s > STALE_PREDICTION_S
    )
