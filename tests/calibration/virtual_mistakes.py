"""Virtual calibrations: good ones of many kinds, and mistakes planted in them.

``KINDS`` are what honest laboratories take; ``MISTAKES`` what goes wrong, with the codes that are
right names for it. Each set has a cell of its own, drawn by its seed.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np

from rigapp_calibration.load_cell.calibrate import calibrate_load_cell
from rigapp_calibration.load_cell.readings import LoadCellReadings
from rigapp_calibration.load_cell.weights import pin_force, weight_force
from tests.calibration.simulated_cell import SETTINGS, Cell, plan

Rng = np.random.Generator


@dataclass(frozen=True)
class Kind:
    """How a calibration is taken, and what is not ideal about it; N and degrees.

    noise: standard deviation of a reading; display: step of the display. angle: standard deviation
    of the pin angle of a series. twice: every angle has two series.
    """

    angles: int
    noise: float = 0.7
    display: float = 2.0
    hysteresis: float = 0.0
    angle: float = 0.0
    drift: float = 0.0
    twice: bool = False


MEANS = {"noise": 0.07, "display": 0.02}
"""Means of a hundred readings."""
QUIET = {"noise": 0.05}
"""A cell so quiet that its coarse display repeats itself."""
FAULTS = {
    "ideal": {},
    "hysteresis": {"hysteresis": 1.2},
    "angle scatter": {"angle": 0.1},
    "drift": {"drift": 1.0},
    "all": {"hysteresis": 1.2, "angle": 0.1, "drift": 1.0},
}
DISPLAYS: dict[str, dict[str, float]] = {"coarse": {}, "means": MEANS, "quiet coarse": QUIET}
KINDS: dict[str, Kind] = {
    f"{angles} angles, {display}, {fault}": Kind(angles, **how, **what)
    for angles in (4, 8, 12)
    for display, how in DISPLAYS.items()
    for fault, what in FAULTS.items()
} | {
    f"4 angles twice, {display}, all": Kind(4, **how, **FAULTS["all"], twice=True)
    for display, how in DISPLAYS.items()
}


@dataclass(frozen=True)
class Taken:
    """One virtual calibration: its cell, its plan, the forces as they are, the order, the loads."""

    kind: Kind
    cell: Cell
    readings: LoadCellReadings
    force: np.ndarray
    rising: np.ndarray

    def again(self, rng: Rng, force: np.ndarray, gain: np.ndarray | None = None) -> np.ndarray:
        """Return the signals of other forces, with the gains (n, 2) of the two bridges."""
        order = np.linspace(0.0, 1.0, len(force))
        return displayed(self.cell, force, order, self.rising, rng, gain)


def displayed(cell, force, order, rising, rng: Rng, gain=None) -> np.ndarray:
    """Return what the display shows: ``Cell.signal``, its bridges' gains applied before it."""
    fine = replace(cell, step=0.0).signal(force, order, rising, rng)
    if gain is not None:
        fine = fine * gain
    quantum = cell.step * np.abs(np.diag(cell.sensitivity))
    return np.round(fine / quantum) * quantum


def take(kind: Kind, rng: Rng) -> Taken:
    """Take a good calibration of a cell of its own."""
    gain = rng.choice([0.0025, 0.005])
    cell = Cell(
        sensitivity=gain * (np.eye(2) + rng.normal(0.0, 0.01, (2, 2))),
        zero=gain * rng.normal(0.0, 2.0, 2),
        noise=kind.noise,
        step=kind.display,
        hysteresis=kind.hysteresis,
        drift=rng.choice([-1.0, 1.0]) * kind.drift,
        offset=rng.normal(0.0, np.radians(0.05)),
    )
    steps = 10 if kind.angles == 12 else 5
    series, step, mass, angle = plan(kind.angles, steps)
    rising = np.tile(np.arange(2 * steps + 1) <= steps, kind.angles)
    if kind.twice:
        series = (*series, *(str(kind.angles + int(name)) for name in series))
        step, mass, angle, rising = (np.tile(one, 2) for one in (step, mass, angle, rising))
    numbers = np.unique(np.array(series), return_inverse=True)[1]
    off = rng.normal(0.0, np.radians(kind.angle), numbers.max() + 1)[numbers]
    force = pin_force(
        weight_force(mass, SETTINGS.weights, SETTINGS.place), angle + off, cell.offset
    )
    readings = LoadCellReadings(series, step, mass, angle, np.zeros((len(mass), 2)))
    taken = Taken(kind, cell, readings, force, rising)
    return replace(taken, readings=replace(readings, signal=taken.again(rng, force)))


# --- mistakes ------------------------------------------------------------------------------------


def rows(readings: LoadCellReadings, kept: Iterable[int]) -> LoadCellReadings:
    """Return rows of a table, in this order."""
    at = list(kept)
    return replace(
        readings,
        series=tuple(readings.series[i] for i in at),
        step=readings.step[at],
        mass=readings.mass[at],
        angle=readings.angle[at],
        signal=readings.signal[at],
    )


def from_series(taken: Taken, place: float) -> np.ndarray:
    """Return the rows of the series from a part (0 .. 1) of them on."""
    names = list(dict.fromkeys(taken.readings.series))
    late = set(names[round(place * len(names)) :])
    return np.array([name in late for name in taken.readings.series])


def table_twice(taken: Taken, rng: Rng) -> LoadCellReadings:
    count = len(taken.readings)
    return rows(taken.readings, [*range(count), *range(count)])


def line_twice(taken: Taken, rng: Rng) -> LoadCellReadings:
    at = int(rng.integers(len(taken.readings)))
    return rows(taken.readings, [*range(at + 1), at, *range(at + 1, len(taken.readings))])


def line_again_at_end(taken: Taken, rng: Rng) -> LoadCellReadings:
    return rows(
        taken.readings, [*range(len(taken.readings)), int(rng.integers(len(taken.readings)))]
    )


def series_copied(taken: Taken, rng: Rng) -> LoadCellReadings:
    """The same table pasted a second time and its series numbered on."""
    twice = table_twice(taken, rng)
    count = len(taken.readings)
    names = len(set(taken.readings.series))
    series = [
        str(int(name) + (names if at >= count else 0)) for at, name in enumerate(twice.series)
    ]
    return replace(twice, series=tuple(series))


def gain(axes: tuple[int, ...], percent: float, place: float | None = None):
    def plant(taken: Taken, rng: Rng) -> LoadCellReadings:
        late = from_series(taken, 0.5 if place is None else place)
        gains = np.ones((len(late), 2))
        gains[np.ix_(late, list(axes))] = 1.0 + percent / 100.0
        return replace(taken.readings, signal=taken.again(rng, taken.force, gains))

    return plant


def light_piece(joins: int | None = None):
    """A piece 0.2 kg light, which hangs from one of the loads on."""

    def plant(taken: Taken, rng: Rng) -> LoadCellReadings:
        loads = np.unique(taken.readings.mass[taken.readings.mass > 0.0])
        at = loads[int(rng.integers(1, len(loads))) if joins is None else joins]
        share = np.where(taken.readings.mass >= at, 1.0 - 0.2 / taken.readings.mass.clip(1e-9), 1.0)
        return replace(taken.readings, signal=taken.again(rng, taken.force * share[:, None]))

    return plant


def dead(place: float, how: str):
    def plant(taken: Taken, rng: Rng) -> LoadCellReadings:
        late = from_series(taken, place)
        axis = int(rng.integers(2))
        signal = taken.readings.signal.copy()
        first = int(np.flatnonzero(late)[0])
        at = {"stuck": signal[first - 1, axis], "zero": 0.0, "noise": 0.0}[how]
        signal[late, axis] = at
        if how == "noise":
            signal[late, axis] += 1e-3 * rng.normal(size=int(late.sum()))
        return replace(taken.readings, signal=signal)

    return plant


def plugs(place: float):
    def plant(taken: Taken, rng: Rng) -> LoadCellReadings:
        late = from_series(taken, place)
        if place == 0.5 and rng.random() < 0.5:
            late = ~late
        signal = taken.readings.signal.copy()
        signal[late] = signal[late][:, ::-1]
        return replace(taken.readings, signal=signal)

    return plant


def angle(degrees: float):
    def plant(taken: Taken, rng: Rng) -> LoadCellReadings:
        return replace(taken.readings, angle=taken.readings.angle + np.radians(degrees))

    return plant


Plant = Callable[[Taken, Rng], LoadCellReadings]
MISTAKES: dict[str, tuple[set[str], Plant]] = {
    "table pasted twice": ({"duplicated_rows"}, table_twice),
    "table pasted twice, renumbered": ({"copied_series"}, series_copied),
    "a line twice": ({"duplicated_rows"}, line_twice),
    "a line again at the end": ({"duplicated_rows"}, line_again_at_end),
    "gain of bridge 1 +2 %": ({"gain_changed"}, gain((0,), 2.0)),
    "gain of bridge 2 -2 %": ({"gain_changed"}, gain((1,), -2.0)),
    "gain of both +2 %": ({"gain_changed"}, gain((0, 1), 2.0)),
    "first piece 0.2 kg light": ({"hanger_mass", "wrong_piece"}, light_piece(0)),
    "a later piece 0.2 kg light": ({"wrong_piece"}, light_piece()),
    "dead, stuck, from 0.6 on": ({"bridge_dead"}, dead(0.6, "stuck")),
    "dead, zero, from 0.6 on": ({"bridge_dead"}, dead(0.6, "zero")),
    "dead, noise, from 0.6 on": ({"bridge_dead"}, dead(0.6, "noise")),
    "plugs exchanged for half": ({"axes_swapped"}, plugs(0.5)),
    "plugs exchanged for a quarter": ({"axes_swapped"}, plugs(0.75)),
    "plugs exchanged from the start": ({"axes_swapped"}, plugs(0.0)),
}
UNSEEN: dict[str, Plant] = {"angle +1 deg": angle(1.0), "angle +2 deg": angle(2.0)}
"""No reading shows them: an independent angle reference is asked for."""


def can_be_told(mistake: str, name: str) -> bool:
    """Tell whether readings of a kind hold enough to tell a mistake at all.

    A piece 0.2 kg light is one step of the coarse display: fewer than 250 readings do not tell it.
    A quiet cell repeats its coarse display by itself.
    """
    if "piece" in mistake:
        return "means" in name or KINDS[name].angles == 12
    return not ("renumbered" in mistake and "quiet" in name)


def blocking(readings: LoadCellReadings) -> tuple[str, ...]:
    """Return the codes for which a calibration is refused."""
    found = calibrate_load_cell(readings, SETTINGS)
    return tuple(problem.code for problem in found.problems if problem.blocks)


def refusals(kind: Kind, sets: int, seed: int) -> Counter[str]:
    """Return what good sets of a kind are refused for: code -> number of sets."""
    found: Counter[str] = Counter()
    for number in range(sets):
        codes = blocking(take(kind, np.random.default_rng((seed, number))).readings)
        found.update(["+".join(codes)] if codes else [])
    return found


def outcomes(kind: Kind, plant: Plant, sets: int, seed: int) -> Counter[str]:
    """Return what sets with a mistake are refused for: codes -> number of sets."""
    found: Counter[str] = Counter()
    for number in range(sets):
        rng = np.random.default_rng((seed, number))
        found["+".join(blocking(plant(take(kind, rng), rng))) or "accepted"] += 1
    return found


def rightly_named(found: Counter[str], right: set[str]) -> float:
    """Return the share of sets refused with right names and no other."""
    good = sum(count for codes, count in found.items() if set(codes.split("+")) <= right)
    return good / found.total()
