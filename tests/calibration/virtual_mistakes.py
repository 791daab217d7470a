"""Virtual calibrations: good ones of many kinds, and mistakes planted in them.

``KINDS`` are what honest laboratories take; ``MISTAKES`` what goes wrong, with the codes that are
right names for it. Each set has a cell of its own, drawn by its seed.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rigapp_calibration.load_cell.calibrate import calibrate_load_cell
from rigapp_calibration.load_cell.readings import LoadCellReadings
from rigapp_calibration.load_cell.settings import LoadCellSettings
from rigapp_calibration.load_cell.weights import pin_force, weight_force
from tests.calibration.simulated_cell import SETTINGS, Cell, plan

Rng = np.random.Generator


@dataclass(frozen=True)
class Kind:
    """How a calibration is taken, and what is not ideal about it; N and degrees.

    noise: standard deviation of a reading; display: step of the display. angle: standard deviation
    of the pin angle of a series. again: so many angles, a quarter turn apart, have a second series
    at the end.
    """

    angles: int
    noise: float = 0.7
    display: float = 2.0
    hysteresis: float = 0.0
    angle: float = 0.0
    drift: float = 0.0
    again: int = 0


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
    f"{angles} angles{words}, {display}, all": Kind(angles, **how, **FAULTS["all"], again=again)
    for angles, words, again in ((4, " twice", 4), (8, " and 2 again", 2))
    for display, how in DISPLAYS.items()
}
"""The last are the routine plan."""


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
    if kind.again:
        turns = 2.0 * np.pi * np.arange(kind.again) / 4.0
        late = np.flatnonzero(np.isclose(angle[:, None], turns).any(axis=1))
        series = (*series, *(f"{kind.angles + int(series[at])}" for at in late))
        step, mass, angle, rising = (
            np.append(one, one[late]) for one in (step, mass, angle, rising)
        )
    numbers = np.array([int(name) - 1 for name in series])
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


def column(name: str, change: Callable[[np.ndarray], np.ndarray]):
    """A whole column of the table is written wrongly."""

    def plant(taken: Taken, rng: Rng) -> LoadCellReadings:
        return replace(taken.readings, **{name: change(getattr(taken.readings, name))})

    return plant


def one_cell(name: str, value: float):
    """One field of the table is written wrongly."""

    def plant(taken: Taken, rng: Rng) -> LoadCellReadings:
        written = getattr(taken.readings, name).astype(np.float64).copy()
        written[int(rng.integers(len(written)))] = value
        return replace(taken.readings, **{name: written})

    return plant


def one_empty(taken: Taken, rng: Rng) -> LoadCellReadings:
    signal = taken.readings.signal.copy()
    signal[rng.integers(len(signal)), rng.integers(2)] = np.nan
    return replace(taken.readings, signal=signal)


def only(chosen: Callable[[Taken], np.ndarray]):
    """Some of the readings are all there are."""

    def plant(taken: Taken, rng: Rng) -> LoadCellReadings:
        return rows(taken.readings, np.flatnonzero(chosen(taken)).tolist())

    return plant


def angle_among(count: int) -> Callable[[Taken], np.ndarray]:
    def chosen(taken: Taken) -> np.ndarray:
        return np.isin(taken.readings.angle, np.unique(taken.readings.angle)[:count])

    return chosen


def half_turn(taken: Taken) -> np.ndarray:
    """Return what was taken within half a turn, and one angle more."""
    return np.asarray(taken.readings.angle <= np.pi + 1e-9)


def felt(change: Callable[[Taken, Rng, np.ndarray], np.ndarray]):
    """Something else hangs than is written; change: of the forces (n, 2)."""

    def plant(taken: Taken, rng: Rng) -> LoadCellReadings:
        force = change(taken, rng, taken.force.copy())
        return replace(taken.readings, signal=taken.again(rng, force))

    return plant


def seen(change: Callable[[Taken, Rng, np.ndarray], np.ndarray]):
    """The signals are other ones than the cell's; change: of the signals (n, 2)."""

    def plant(taken: Taken, rng: Rng) -> LoadCellReadings:
        return replace(taken.readings, signal=change(taken, rng, taken.readings.signal.copy()))

    return plant


def some_loaded(taken: Taken, rng: Rng, count: int = 1) -> np.ndarray:
    """Return rows with weights, none beside another."""
    loaded = np.flatnonzero(taken.readings.mass > 0.0)
    first = int(rng.integers(len(loaded)))
    return loaded[(first + np.arange(count) * (len(loaded) // max(count, 1))) % len(loaded)]


def other_weights(kg: float, count: int = 1):
    def change(taken: Taken, rng: Rng, force: np.ndarray) -> np.ndarray:
        at = some_loaded(taken, rng, count)
        return _times(force, at, 1.0 + kg / taken.readings.mass[at])

    return felt(change)


def _times(force: np.ndarray, at: np.ndarray, factor: np.ndarray) -> np.ndarray:
    force[at] *= factor[:, None]
    return force


def with_each_load(kg: float):
    """So much more hangs than is written, but not at the zeros."""

    def change(taken: Taken, rng: Rng, force: np.ndarray) -> np.ndarray:
        at = np.flatnonzero(taken.readings.mass > 0.0)
        return _times(force, at, 1.0 + kg / taken.readings.mass[at])

    return felt(change)


def shifted(by: int):
    """In one series each reading from the third on is that of another step."""

    def plant(taken: Taken, rng: Rng) -> LoadCellReadings:
        names = list(dict.fromkeys(taken.readings.series))
        name = names[int(rng.integers(len(names)))]
        members = np.flatnonzero(np.array(taken.readings.series) == name)
        signal = taken.readings.signal.copy()
        moved = members[2:-1]
        signal[moved] = taken.readings.signal[moved + by]
        return replace(taken.readings, signal=signal)

    return plant


def swapped(taken: Taken, rng: Rng, signal: np.ndarray) -> np.ndarray:
    names = list(dict.fromkeys(taken.readings.series))
    members = np.flatnonzero(np.array(taken.readings.series) == names[rng.integers(len(names))])
    one, other = members[1], members[3]
    signal[[one, other]] = signal[[other, one]]
    return signal


def swinging(taken: Taken, rng: Rng, signal: np.ndarray) -> np.ndarray:
    names = list(dict.fromkeys(taken.readings.series))
    here = np.array(taken.readings.series) == names[rng.integers(len(names))]
    here &= taken.readings.mass > 0.0
    size = 8.0 * np.abs(np.diag(taken.cell.sensitivity))
    signal[here] += rng.normal(0.0, 1.0, (int(here.sum()), 2)) * size
    return signal


def loose(taken: Taken, rng: Rng, signal: np.ndarray) -> np.ndarray:
    at = rng.choice(len(signal), 3, replace=False)
    axis = int(rng.integers(2))
    signal[at, axis] += 90.0 * taken.cell.sensitivity[axis, axis]
    return signal


def saturated(taken: Taken, rng: Rng, signal: np.ndarray) -> np.ndarray:
    axis = int(rng.integers(2))
    end = 0.75 * np.abs(signal[:, axis]).max()
    signal[:, axis] = np.clip(signal[:, axis], -end, end)
    return signal


def late(newton: float, place: float = 0.5):
    """The zero of one signal jumps between two series."""

    def change(taken: Taken, rng: Rng, signal: np.ndarray) -> np.ndarray:
        axis = int(rng.integers(2))
        signal[from_series(taken, place), axis] += newton * taken.cell.sensitivity[axis, axis]
        return signal

    return seen(change)


def wandering(newton: float):
    def change(taken: Taken, rng: Rng, signal: np.ndarray) -> np.ndarray:
        ramp = np.linspace(0.0, newton, len(signal))[:, None]
        return signal + ramp * np.diag(taken.cell.sensitivity)

    return seen(change)


def reversed_from(place: float, axes: tuple[int, ...]):
    def change(taken: Taken, rng: Rng, signal: np.ndarray) -> np.ndarray:
        signal[np.ix_(from_series(taken, place), list(axes))] *= -1.0
        return signal

    return seen(change)


def slow_gain(percent: float):
    def plant(taken: Taken, rng: Rng) -> LoadCellReadings:
        gains = 1.0 + np.linspace(0.0, percent / 100.0, len(taken.readings))[:, None]
        return replace(
            taken.readings, signal=taken.again(rng, taken.force, np.repeat(gains, 2, axis=1))
        )

    return plant


def loop(taken: Taken, rng: Rng, force: np.ndarray) -> np.ndarray:
    """2 % of full scale more coming down."""
    size = np.hypot(*force.T)
    bend = 8.0 * np.sin(np.pi * np.clip(size / 400.0, 0.0, 1.0)) * ~taken.rising
    return force * (1.0 + bend / np.maximum(size, 1e-9))[:, None]


def one_angle(degrees: float):
    def plant(taken: Taken, rng: Rng) -> LoadCellReadings:
        names = list(dict.fromkeys(taken.readings.series))
        here = np.array(taken.readings.series) == names[rng.integers(len(names))]
        return replace(taken.readings, angle=taken.readings.angle + np.radians(degrees) * here)

    return plant


def one_angle_typed(taken: Taken, rng: Rng) -> LoadCellReadings:
    at = int(some_loaded(taken, rng)[0])
    heavy = np.flatnonzero(
        (np.array(taken.readings.series) == taken.readings.series[at])
        & (taken.readings.mass >= 0.5 * taken.readings.mass.max())
    )
    written = taken.readings.angle.copy()
    written[heavy[0]] += np.radians(10.0)
    return replace(taken.readings, angle=written)


def angles_exchanged(taken: Taken, rng: Rng) -> LoadCellReadings:
    series = np.array(taken.readings.series)
    written = taken.readings.angle.copy()
    names = list(dict.fromkeys(taken.readings.series))
    of = {name: float(written[series == name][0]) for name in names}
    pairs = [(a, b) for a in names for b in names if of[a] < of[b] - 1e-6]
    one, other = pairs[int(rng.integers(len(pairs)))]
    written[series == one], written[series == other] = of[other], of[one]
    return replace(taken.readings, angle=written)


def as_taken(taken: Taken, rng: Rng) -> LoadCellReadings:
    """Return the readings as they are: the mistake is in the settings."""
    return taken.readings


Plant = Callable[[Taken, Rng], LoadCellReadings]
CELL, WEIGHTS, PLACE = SETTINGS.cell, SETTINGS.weights, SETTINGS.place


@dataclass(frozen=True)
class Mistake:
    """What goes wrong: the codes that are right names for it, and how it comes about.

    settings: what is written about cell, weights and place. least_angles: of a plan that tells it.
    rated: the cell's rated output is stated, by which it is told.
    """

    right: frozenset[str]
    plant: Plant
    settings: LoadCellSettings = SETTINGS
    least_angles: int = 4
    rated: bool = False


def kind_of(right: str, plant: Plant, **more: Any) -> Mistake:
    return Mistake(frozenset(right.split()), plant, **more)


def setting(right: str, **sections: Any) -> Mistake:
    return Mistake(frozenset(right.split()), as_taken, replace(SETTINGS, **sections))


MISTAKES: dict[str, Mistake] = {
    # the table
    "table pasted twice": kind_of("duplicated_rows", table_twice),
    "table pasted twice, renumbered": kind_of("copied_series", series_copied),
    "a line twice": kind_of("duplicated_rows", line_twice),
    "a line again at the end": kind_of("duplicated_rows", line_again_at_end),
    "a line before its time": kind_of(
        "unordered_steps", lambda t, r: rows(t.readings, [1, 0, *range(2, len(t.readings))])
    ),
    "a step number twice": kind_of(
        "duplicated_step",
        lambda t, r: replace(t.readings, step=np.where(t.readings.step == 3, 2, t.readings.step)),
    ),
    "a signal left empty": kind_of("not_a_number", one_empty),
    "masses in grams": kind_of("mass_unit", column("mass", lambda m: 1e3 * m)),
    "masses in tonnes": kind_of("mass_unit", column("mass", lambda m: 1e-3 * m)),
    "newtons for kilograms": kind_of("overload", column("mass", lambda m: 9.81 * m)),
    "pounds for kilograms": kind_of("overload", column("mass", lambda m: 2.2046 * m)),
    "a negative mass": kind_of("negative_mass", one_cell("mass", -5.0)),
    "a mass of 80 kg": kind_of("overload", one_cell("mass", 80.0)),
    "angles in radians": kind_of("angle_unit", column("angle", np.radians)),
    "signals in uV/V": kind_of("signal_unit", column("signal", lambda s: 1e3 * s)),
    "signals in V/V": kind_of("signal_unit", column("signal", lambda s: 1e-3 * s)),
    "signals in newtons": kind_of("signal_unit", column("signal", lambda s: 200.0 * s)),
    "no zeros": kind_of("no_zero", only(lambda t: t.readings.mass > 0.0)),
    "three angles": kind_of("too_few_angles", only(angle_among(3)), least_angles=8),
    "two angles": kind_of("too_few_angles", only(angle_among(2)), least_angles=8),
    "angles of half a turn": kind_of("angles_uneven", only(half_turn), least_angles=8),
    "two loads": kind_of(
        "too_few_loads",
        only(lambda t: np.isin(t.readings.mass, np.unique(t.readings.mass)[[0, 2, 4]])),
    ),
    "one load": kind_of(
        "too_few_loads",
        only(lambda t: np.isin(t.readings.mass, np.unique(t.readings.mass)[[0, 4]])),
        least_angles=8,
    ),
    # wiring
    "plugs exchanged from the start": kind_of("axes_swapped", plugs(0.0)),
    "plugs exchanged for half": kind_of("axes_swapped", plugs(0.5)),
    "plugs exchanged for a quarter": kind_of("axes_swapped", plugs(0.75)),
    "bridge 1 reversed": kind_of("axis_reversed", reversed_from(0.0, (0,))),
    "bridge 2 reversed": kind_of("axis_reversed", reversed_from(0.0, (1,))),
    "bridge 1 reversed for half": kind_of("axis_reversed", reversed_from(0.5, (0,))),
    "both bridges reversed": kind_of("axes_reversed", reversed_from(0.0, (0, 1))),
    "dead from the start": kind_of("bridge_dead", dead(0.0, "zero")),
    "dead, stuck, from 0.6 on": kind_of("bridge_dead", dead(0.6, "stuck")),
    "dead, zero, from 0.6 on": kind_of("bridge_dead", dead(0.6, "zero")),
    "dead, noise, from 0.6 on": kind_of("bridge_dead", dead(0.6, "noise")),
    "a loose cable": kind_of("cable_loose", seen(loose), least_angles=8),
    "input saturated": kind_of("saturated", seen(saturated)),
    # gain and zero
    "gain of bridge 1 +2 %": kind_of("gain_changed", gain((0,), 2.0)),
    "gain of bridge 2 -2 %": kind_of("gain_changed", gain((1,), -2.0)),
    "gain of both +2 %": kind_of("gain_changed", gain((0, 1), 2.0)),
    "gain of both -2 % for a quarter": kind_of("gain_changed", gain((0, 1), -2.0, 0.75)),
    "gain of both slowly +3 %": kind_of("gain_changed", slow_gain(3.0)),
    "zero jumps by 3 %": kind_of("zero_jump", late(12.0)),
    "zero jumps by 10 %": kind_of("zero_jump", late(40.0)),
    "zero drifts by 3 %": kind_of("drift", wandering(12.0)),
    "hysteresis 2 %": kind_of("hysteresis", felt(loop)),
    # weights
    "first piece 0.2 kg light": kind_of("dead_zone wrong_piece", light_piece(0)),
    "a later piece 0.2 kg light": kind_of("wrong_piece", light_piece()),
    "hanger of 0.5 kg forgotten": kind_of("hanger_mass", with_each_load(0.5)),
    "hanger counted that does not hang": kind_of("hanger_mass", with_each_load(-0.5)),
    "hanger stated that does not hang": setting(
        "hanger_mass", weights=replace(WEIGHTS, hanger_mass=0.5)
    ),
    "2.5 N of each load held back": kind_of("dead_zone", with_each_load(-2.5 / 9.81)),
    "1 kg too much once": kind_of("wrong_weight", other_weights(1.0)),
    "2 kg too little once": kind_of("wrong_weight", other_weights(-2.0)),
    "1 kg too much three times": kind_of("wrong_weight", other_weights(1.0, 3)),
    "a step skipped": kind_of("skipped_step", shifted(1)),
    "a step taken twice": kind_of("repeated_step", shifted(-1)),
    "two readings exchanged": kind_of("swapped_steps", seen(swapped)),
    "a weight that swings": kind_of("scatter", seen(swinging)),
    # angles
    "one angle 2 degrees off": kind_of("angle_off", one_angle(2.0), least_angles=8),
    "one angle 5 degrees off": kind_of("angle_off", one_angle(5.0), least_angles=8),
    "one angle typed 10 degrees off": kind_of("angle_off", one_angle_typed),
    "angles of two series exchanged": kind_of("angles_exchanged", angles_exchanged, least_angles=8),
    "every angle 6 degrees off": kind_of("angle_reference", angle(6.0)),
    "every angle 12 degrees off": kind_of("angle_reference", angle(12.0)),
    "every angle 90 degrees off": kind_of("axes_swapped", angle(90.0)),
    "every angle 180 degrees off": kind_of("axes_reversed", angle(180.0)),
    "angles counted the wrong way": kind_of("axis_reversed", column("angle", lambda a: -a)),
    # settings
    "gravity 9.0": setting("wrong_gravity", place=replace(PLACE, gravity=9.0)),
    "gravity in Gal": setting("wrong_gravity", place=replace(PLACE, gravity=981.2)),
    "gravity of another place": setting("wrong_gravity", gravity_expected=9.78),
    "density in g/cm3": setting("weight_density", weights=replace(WEIGHTS, density=8.0)),
    "air density in g/cm3": setting("air_density", place=replace(PLACE, air_density=0.0012)),
    "hanger in grams": setting("hanger_mass", weights=replace(WEIGHTS, hanger_mass=500.0)),
    "signal unit mV": setting("signal_unit", cell=replace(CELL, signal_unit="mV")),
    "20 lb for 10 kg": kind_of(
        "rated_output", felt(lambda t, r, force: 0.9072 * force), rated=True
    ),
    "a cable carries 5 %": kind_of(
        "rated_output", felt(lambda t, r, force: 0.95 * force), rated=True
    ),
}
UNSEEN: dict[str, Mistake] = {
    "angle +1 deg": kind_of("angle_reference", angle(1.0)),
    "angle +2 deg": kind_of("angle_reference", angle(2.0)),
}
"""No reading shows them: an independent angle reference is asked for."""


def can_be_told(mistake: str, name: str) -> bool:
    """Tell whether readings of a kind hold enough to tell a mistake at all.

    A piece 0.2 kg light, or as much held back, is one step of the coarse display: fewer than 250
    readings do not tell it.
    A quiet cell repeats its coarse display by itself. What all loads share is told within the
    tolerance of the rated output, and U.
    """
    kind = KINDS[name]
    if kind.angles < MISTAKES[mistake].least_angles:
        return False
    if "gain of" in mistake and kind.angles == 8 and not kind.again and "coarse" in name:
        return False  # it looks like a cell that feels push and pull a little differently
    if "0.2 kg light" in mistake or "held back" in mistake:
        return "means" in name or kind.angles == 12
    return not ("renumbered" in mistake and "quiet" in name)


def blocking(readings: LoadCellReadings, settings: LoadCellSettings = SETTINGS) -> tuple[str, ...]:
    """Return the codes for which a calibration is refused."""
    found = calibrate_load_cell(readings, settings)
    return tuple(problem.code for problem in found.problems if problem.blocks)


def refusals(kind: Kind, sets: int, seed: int) -> Counter[str]:
    """Return what good sets of a kind are refused for: code -> number of sets."""
    found: Counter[str] = Counter()
    for number in range(sets):
        codes = blocking(take(kind, np.random.default_rng((seed, number))).readings)
        found.update(["+".join(codes)] if codes else [])
    return found


def outcomes(kind: Kind, mistake: Mistake, sets: int, seed: int) -> Counter[str]:
    """Return what sets with a mistake are refused for: codes -> number of sets."""
    found: Counter[str] = Counter()
    for number in range(sets):
        rng = np.random.default_rng((seed, number))
        taken, settings = take(kind, rng), mistake.settings
        if mistake.rated:
            full = settings.cell.full_scale
            output = float(np.diag(taken.cell.sensitivity).mean()) * full
            settings = replace(
                settings, cell=replace(settings.cell, rated_output=output, rated_tolerance=0.02)
            )
        found["+".join(blocking(mistake.plant(taken, rng), settings)) or "accepted"] += 1
    return found


def rightly_named(found: Counter[str], right: Collection[str]) -> float:
    """Return the share of sets refused with right names and no other."""
    good = sum(count for codes, count in found.items() if set(codes.split("+")) <= set(right))
    return good / found.total()
