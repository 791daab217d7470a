"""Plan of a test's file, which determines its disk space."""

from __future__ import annotations

import math

import numpy as np

from rigapp.config.recipe import TestFile
from rigapp.config.sequence import Sequence
from rigapp.engine.recording.history import Schedule, triggered_cycles, waiting_cycles
from rigapp.schema.channels import BASE, ChannelTable
from rigapp.storage import FilePlan, profile_rows

SLOWER = 1.05
"""Largest number of samples of a revolution, relative to one at the set speed."""

STAND_S = 3.0
"""Time of standstill in an unfinished revolution, with a margin."""

UNFINISHED = 2
"""Unfinished revolutions for which space is reserved."""


def _bytes_of(table: ChannelTable) -> int:
    """Return the bytes of one sample of all columns."""
    return sum(np.dtype(column.dtype).itemsize for column in table.cycle_columns)


def file_plan(
    test: TestFile,
    sample_rate_Hz: float,
    samples_per_revolution: float | None = None,
    table: ChannelTable = BASE,
) -> FilePlan:
    """Return the plan of a test's file. table: the channels of the rig.

    samples_per_revolution: of a device clocked by the encoder; None: from the rate and the lowest
    set speed.
    """
    revolutions = test.run.revolutions
    if samples_per_revolution is None:
        samples_per_revolution = 60.0 / Sequence(test.run).slowest_rpm * sample_rate_Hz
    samples = max(1, math.ceil(SLOWER * samples_per_revolution))
    # An unfinished revolution includes the ramp, with half the set speed, and some standstill.
    unfinished = 2 * samples + math.ceil(STAND_S * sample_rate_Hz)
    scheduled = Schedule(test.cycles, revolutions).planned()
    return FilePlan(
        revolutions=revolutions,
        cycles=scheduled + min(triggered_cycles(test.cycles, revolutions), revolutions - scheduled),
        samples_per_cycle=samples,
        channels=table.channels,
        revolution_columns=table.revolution_columns,
        cycle_columns=table.cycle_columns,
        prediction=test.prediction.enabled,
        cycle_reason=True,
        event_details=True,
        unfinished_samples=UNFINISHED * unfinished,
        checksums=True,
        waiting_cycles=waiting_cycles(test.cycles, revolutions, samples * _bytes_of(table)),
        profiles=profile_rows(revolutions) if test.prediction.enabled else 0,
    )
