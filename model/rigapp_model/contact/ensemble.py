"""Statistics over many revolutions of a chaotic motion.

Where pin and bushing lose contact the motion is chaotic, and a revolution is one sample. Means over
many are comparable; their standard errors are those of batch means (Law, *Simulation modeling and
analysis*, section 9.5).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.texts import say
from rigapp_model.contact.impact import ContactCycle, contact_cycle
from rigapp_model.contact.impact_system import ClearanceSystem
from rigapp_model.errors import ModelError, OutOfTime

Array = NDArray[np.float64]

SETTLING = 5
"""Revolutions discarded at the start."""

MOST_BATCHES = 20  # 10 to 30 are suitable: fewer scatter, more are too short to be independent


@dataclass(frozen=True, slots=True)
class Mean:
    """Mean and standard error, of the same shape; the error of a single revolution is NaN."""

    value: Array
    standard_error: Array


class BatchMeans:
    """Sums of samples of one shape in at most 20 batches of equal size, in bounded memory."""

    def __init__(self) -> None:
        self._sums: list[Array] = []
        self._size = 1
        self._open: Array | None = None
        self._in_open = 0

    def add(self, sample: ArrayLike) -> None:
        """Add a sample."""
        value = np.asarray(sample, dtype=np.float64)
        self._open = value.copy() if self._open is None else self._open + value
        self._in_open += 1
        if self._in_open < self._size:
            return
        self._sums.append(self._open)
        self._open, self._in_open = None, 0
        if len(self._sums) == MOST_BATCHES:
            self._sums = [a + b for a, b in zip(self._sums[::2], self._sums[1::2], strict=True)]
            self._size *= 2

    def result(self) -> Mean:
        """Return the mean of all samples; its error from the complete batches."""
        total = sum(self._sums, np.zeros(()) if self._open is None else self._open)
        count = self._size * len(self._sums) + self._in_open
        batches = len(self._sums)
        if batches < 2:
            return Mean(total / count, np.full(np.shape(total), np.nan))
        spread = np.std(np.array(self._sums) / self._size, axis=0, ddof=1)
        return Mean(total / count, spread / np.sqrt(batches))


@dataclass(frozen=True, slots=True)
class Ensemble:
    """Means over ``revolutions``, with the first of them as a sample.

    At each crank angle of the sample, shapes as in its motion: ``force``, ``force_crank``,
    ``force_follower`` (2, n), ``force_magnitude`` (n,), N; ``drive_torque`` (n,), N m;
    ``touching`` (n,): fraction of revolutions in contact. Per revolution: ``mean_force``, N,
    normal force times sliding distance over the pin's circumference; ``slip``, m, sliding distance
    in contact; ``greatest_force``, N, also between the samples; ``contact_fraction``; ``impacts``.
    ``peaks`` (N, sorted) are the peak forces of all impacts of all revolutions.
    """

    revolutions: int
    sample: ContactCycle
    force: Mean
    force_crank: Mean
    force_follower: Mean
    force_magnitude: Mean
    drive_torque: Mean
    touching: Mean
    mean_force: Mean
    slip: Mean
    greatest_force: Mean
    contact_fraction: Mean
    impacts: Mean
    peaks: Array


def revolutions_of(
    system: ClearanceSystem,
    points: int,
    alive: Callable[[], None] = lambda: None,
) -> Iterator[ContactCycle]:
    """Yield consecutive revolutions without end, after a start in contact and ``SETTLING`` ones.

    alive: called between steps; may raise.
    """
    cycle = contact_cycle(
        system, points, settling_revolutions=SETTLING, progress=lambda part: alive()
    )
    while True:
        yield cycle
        cycle = contact_cycle(
            system,
            points,
            settling_revolutions=0,
            start=cycle.final_state,
            progress=lambda part: alive(),
        )


def ensemble(
    system: ClearanceSystem,
    revolutions: int,
    points: int = 360,
    progress: Callable[[float], None] = lambda part: None,
) -> Ensemble:
    """Simulate ``revolutions`` after the settling ones and return their means.

    progress: called with the fraction done; if it raises OutOfTime, the means so far are returned,
    or OutOfTime is raised before the first. Raises ModelError as ``contact_cycle`` does.
    """
    if revolutions < 1:
        raise ModelError("revolutions", revolutions, say("give at least 1"))
    means = {name: BatchMeans() for name in Ensemble.__dataclass_fields__ if name not in _NO_MEANS}
    samples: list[ContactCycle] = []
    peaks: list[Array] = []
    done = 0

    def check_time() -> None:
        progress(done / revolutions)

    try:
        for cycle in revolutions_of(system, points, check_time):
            for name, value in _quantities(system, cycle).items():
                means[name].add(value)
            peaks.append(cycle.impacts.peak)
            samples, done = [cycle], done + 1
            if done == revolutions:
                break
    except OutOfTime:
        if not samples:
            raise
    results = {name: mean.result() for name, mean in means.items()}
    return Ensemble(
        revolutions=done, sample=samples[0], peaks=np.sort(np.concatenate(peaks)), **results
    )


_NO_MEANS = ("revolutions", "sample", "peaks")


def _quantities(system: ClearanceSystem, cycle: ContactCycle) -> dict[str, ArrayLike]:
    """Return the quantities of one revolution to average, by the names of ``Ensemble``."""
    motion = cycle.motion
    circumference = 2.0 * np.pi * system.joint.pin_radius
    return {
        "force": motion.force,
        "force_crank": motion.force_crank,
        "force_follower": motion.force_follower,
        "force_magnitude": motion.force_magnitude,
        "drive_torque": motion.drive_torque,
        "touching": cycle.touching,
        "mean_force": cycle.work.sum() / circumference,
        "slip": cycle.slip.sum(),
        "greatest_force": cycle.greatest_force,
        "contact_fraction": cycle.contact_fraction,
        "impacts": len(cycle.impacts),
    }
