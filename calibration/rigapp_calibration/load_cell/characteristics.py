"""Characteristics of the cell: hysteresis, zero return, repeatability, reproducibility.

Definitions follow ISO 376 where the readings allow it, taken along the direction of the load; in
per cent of the force (of full scale for zero return), computed from the readings themselves.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import compress, pairwise

import numpy as np

from rigapp.texts import joined, say
from rigapp_calibration.arrays import Array, Marks, Whole
from rigapp_calibration.load_cell.readings import HungReadings, LoadCellReadings
from rigapp_calibration.load_cell.settings import LoadCellSettings
from rigapp_calibration.load_cell.two_axis import TwoAxisFit, robust_fit
from rigapp_calibration.load_cell.weights import force_per_mass, pin_force, weight_force
from rigapp_calibration.load_cell.zeros import Zeros, examine_zeros
from rigapp_calibration.problems import Problem, note, refusal
from rigapp_calibration.taking.readings import each_series

CREEP_AT = (30.0, 300.0)
"""Seconds after the load change at which ISO 376 reads the creep."""
CREEP_TIMES = 0.2
"""Relative tolerance of these times: creep goes with the logarithm of time, so that it changes by
less than a fifth."""
LARGEST_CREEP = 0.01
"""Part of the load: five times the limit of class 2 of ISO 376; more is not the creep of a cell."""
ANGLE_STEP = np.radians(1.0)
"""Pin angles closer than this are one: a technician sets them to half a degree by eye."""


@dataclass(frozen=True, slots=True)
class Characteristics:
    """Characteristics defined by the readings; None where not determined. Percentages; N for drift.

    reproducibility b: between pin angles. repeatability b': between series at one angle.
    interpolation fc, zero_return f0, reversibility v (hysteresis). drift: change of the zero over
    the whole calibration, N. Loads below a tenth of full scale are left out.
    """

    reproducibility: float | None
    repeatability: float | None
    interpolation: float | None
    zero_return: float | None
    reversibility: float | None
    drift: float | None


@dataclass(frozen=True, slots=True)
class Loads:
    """Readings in terms of the load: applied and measured along it and across it, N.

    group: number of the pin angle (angles within a degree are one). rising: the load was reached
    from below. direction (n, 2): of the load, at rest that of its angle's loads.
    """

    applied: Array
    along: Array
    across: Array
    group: Whole
    rising: Marks
    series: tuple[str, ...]
    direction: Array

    def runs(self) -> Whole:
        """Return the number (n,) of each reading's run (a series at one pin angle), as taken."""
        return run_numbers(self.series, self.group)

    def only(self, kept: Marks) -> Loads:
        """Return the selected readings."""
        return Loads(
            self.applied[kept],
            self.along[kept],
            self.across[kept],
            self.group[kept],
            self.rising[kept],
            tuple(compress(self.series, kept)),
            self.direction[kept],
        )


def run_numbers(series: Sequence[str], group: Whole) -> Whole:
    """Return the number (n,) of the run of each reading, as taken: a series at one pin angle."""
    numbers: dict[tuple[str, int], int] = {}
    runs = zip(series, group.tolist(), strict=True)
    return np.array([numbers.setdefault(one, len(numbers)) for one in runs], dtype=np.int64)


def angle_groups(angle: Array) -> Whole:
    """Return the number of the pin angle of each reading; within one degree is the same angle."""
    turned = np.mod(angle, 2.0 * np.pi)
    turned = np.where(turned > 2.0 * np.pi - 0.5 * ANGLE_STEP, 0.0, turned)
    order = np.argsort(turned, kind="stable")
    group = np.zeros(len(angle), dtype=np.int64)
    number = 0
    for before, here in pairwise(order):
        if turned[here] - turned[before] > ANGLE_STEP:
            number += 1
        group[here] = number
    return group


def loads(readings: LoadCellReadings, force: Array, measured: Array) -> Loads:
    """Resolve applied and measured forces (n, 2) along the load of each reading."""
    size = np.hypot(*force.T)
    group = angle_groups(readings.angle)
    direction = np.zeros_like(force)
    for number in np.unique(group):
        members = group == number
        loaded = members & (size > 0.0)
        if loaded.any():
            mean = (force[loaded] / size[loaded, None]).mean(axis=0)
            direction[members] = mean / np.hypot(*mean)
    own = size > 0.0
    direction[own] = force[own] / size[own, None]
    along = np.einsum("ij,ij->i", measured, direction)
    across = measured[:, 1] * direction[:, 0] - measured[:, 0] * direction[:, 1]
    return Loads(size, along, across, group, _rising(readings), readings.series, direction)


def characteristics(found: Loads, full_scale: float, residual: Array) -> Characteristics:
    """Compute the characteristics; residual (n, 2) in N from the fit."""
    enough = found.applied >= 0.1 * full_scale
    size = np.hypot(*residual.T)
    interpolation = (
        float(100.0 * np.max(size[enough] / found.applied[enough])) if enough.any() else None
    )
    return Characteristics(
        reproducibility=_spread(found, enough, between_angles=True),
        repeatability=_spread(found, enough, between_angles=False),
        interpolation=interpolation,
        zero_return=_zero_return(found, full_scale),
        reversibility=_reversibility(found, enough),
        drift=_drift(found),
    )


def _reversibility(found: Loads, enough: Marks) -> float | None:
    """Return the mean |falling - rising| over the loads taken both ways, per cent of the load.

    The largest load, where a series turns, is left out.
    """
    rising = _means(found, enough & found.rising, by_series=True)
    falling = _means(found, enough & ~found.rising, by_series=True)
    largest = round(float(found.applied.max()), 3)
    by_load: dict[float, list[float]] = {}
    for key in sorted(set(rising) & set(falling)):
        if key[2] < largest:
            by_load.setdefault(key[2], []).append(falling[key] - rising[key])
    if not by_load:
        return None
    shares = [abs(np.mean(changes)) / load for load, changes in by_load.items()]
    return float(100.0 * np.mean(shares))


def hysteresis_by_load(found: Loads) -> dict[float, float]:
    """Return load -> falling less rising (N), the median over the pin angles; empty without both.

    The median over angles is robust against a single wrong reading.
    """
    loaded = found.applied > 0.0
    rising = _means(found, loaded & found.rising, by_series=False)
    falling = _means(found, loaded & ~found.rising, by_series=False)
    by_load: dict[float, list[float]] = {}
    for key in set(rising) & set(falling):
        by_load.setdefault(key[2], []).append(falling[key] - rising[key])
    return {load: float(np.median(values)) for load, values in by_load.items()}


Key = tuple[int, str, float]


def _means(found: Loads, chosen: Marks, *, by_series: bool) -> dict[Key, float]:
    collected: dict[Key, list[float]] = {}
    for index in np.flatnonzero(chosen):
        name = found.series[index] if by_series else ""
        key = (int(found.group[index]), name, round(float(found.applied[index]), 3))
        collected.setdefault(key, []).append(float(found.along[index]))
    return {key: float(np.mean(values)) for key, values in collected.items()}


def _spread(found: Loads, enough: Marks, *, between_angles: bool) -> float | None:
    rising = _means(found, enough & found.rising, by_series=not between_angles)
    by_load: dict[tuple[int, float], list[float]] = {}
    for (group, _, load), value in rising.items():
        by_load.setdefault((0 if between_angles else group, load), []).append(value)
    spreads = [
        100.0 * (max(values) - min(values)) / float(np.mean(values))
        for values in by_load.values()
        if len(values) > 1 and np.mean(values) != 0.0  # of a dead bridge
    ]
    return float(max(spreads)) if spreads else None


def _zero_return(found: Loads, full_scale: float) -> float | None:
    """Return the mean change of the zero over a series, per cent of full scale."""
    changes = []
    for _, members in each_series(found.series):
        zeros = np.flatnonzero(members & (found.applied == 0.0))
        if len(zeros) > 1:
            changes.append(
                (
                    found.along[zeros[-1]] - found.along[zeros[0]],
                    found.across[zeros[-1]] - found.across[zeros[0]],
                )
            )
    if not changes:
        return None
    return float(100.0 * np.hypot(*np.mean(changes, axis=0)) / full_scale)


def _drift(found: Loads) -> float | None:
    zeros = np.flatnonzero(found.applied == 0.0)
    if len(zeros) < 3:
        return None
    order = zeros / max(len(found.applied) - 1, 1)
    slopes = [np.polyfit(order, values[zeros], 1)[0] for values in (found.along, found.across)]
    return float(np.hypot(*slopes))


def _rising(readings: LoadCellReadings) -> Marks:
    """Return which readings were reached by adding weights within their series."""
    rising = np.ones(len(readings), dtype=np.bool_)
    last: dict[str, float] = {}
    state: dict[str, bool] = {}
    for index, (name, mass) in enumerate(zip(readings.series, readings.mass, strict=True)):
        before = last.get(name)
        if before is not None and mass != before:
            state[name] = bool(mass > before)
        rising[index] = state.get(name, True)
        last[name] = float(mass)
    return rising


# --- creep ---------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Creep:
    """Change (N) of the indication under a constant load (N) between two times (s).

    half_width: relative to the load; includes what the scatter of both readings may hide.
    """

    load: float
    times: tuple[float, float]
    change: float
    half_width: float

    @property
    def percent(self) -> float:
        """Return ISO 376's c, per cent of the load."""
        return 100.0 * abs(self.change) / self.load


def unusable_creep(hung: HungReadings) -> Iterator[Problem]:
    """Yield a note where readings under a constant load give no creep by ISO 376."""
    wanted = joined(say(" and "), (f"{one:g} s" for one in CREEP_AT))
    why = ""
    if len(hung.time) != len(CREEP_AT):
        why = say("there are {} and not {}", len(hung.time), len(CREEP_AT))
    elif not np.isfinite(np.column_stack((hung.mass, hung.angle, hung.time, hung.signal))).all():
        why = say("one is not a number")
    elif np.any(np.abs(hung.time / CREEP_AT - 1.0) > CREEP_TIMES):
        taken = joined(say(" and "), (f"{one:.0f} s" for one in hung.time))
        why = say("they were taken {} after loading, not {}", taken, wanted)
    elif hung.mass[0] != hung.mass[1] or not hung.mass[0] > 0.0:
        why = say("they are not of one load")
    if why:
        yield note(
            "creep_unusable",
            (
                "The readings of the creep are not used, {}: the creep stated in the settings is"
                " used."
            ),
            why,
        )


def creep(hung: HungReadings, found: TwoAxisFit, load: float, scatter: float) -> Creep:
    """Return the creep from two readings of a load (N); scatter: of one component, N.

    The scatter of both is added to the square of their difference, since it may hide as much.

    """
    early, late = found.force(hung.signal)
    change = float((late - early) @ early / np.hypot(*early))
    return Creep(
        load=load,
        times=(float(hung.time[0]), float(hung.time[1])),
        change=change,
        half_width=float(np.hypot(change, np.sqrt(2.0) * scatter) / load),
    )


def check_creep(found: Creep) -> Iterator[Problem]:
    """Yield a problem if the load was touched between the two readings of the creep."""
    if abs(found.change) > LARGEST_CREEP * found.load:
        yield refusal(
            "creep",
            "Between {:.0f} s and {:.0f} s under {:.1f} N the indication changes by"
            " {:+.2f} N, {:.1f} % of the load. No cell creeps so far: was the load"
            " touched? Take the creep again, or leave it out.",
            found.times[0],
            found.times[1],
            found.load,
            found.change,
            found.percent,
        )


def creep_words(found: Creep | None, stated: float) -> str:
    """Return the creep used in U: the measured one, else the stated part of the load."""
    if found is None:
        return say("Creep: not measured; U has the {:g} % that the settings state.", 100.0 * stated)
    early, late = found.times
    return say(
        "Creep at {:.1f} N, from {:.0f} s to {:.0f} s after loading: {:+.3f} N; U has"
        " {:.3f} %, the scatter of the two readings included.",
        found.load,
        early,
        late,
        found.change,
        100.0 * found.half_width,
    )


SURE = 5.0
"""Standard deviations beyond which a difference is not noise."""
SURE_WEIGHT = 3.0
"""For the weight of the pin, against the scatter of zeros: it is far smaller than any mistake."""


@dataclass(frozen=True, slots=True)
class Evidence:
    """Input of the second round of checks: readings, robust fit, noise (N), loads, N per kg.

    force (n, 2): applied to the pin, N.
    """

    readings: LoadCellReadings
    settings: LoadCellSettings
    found: TwoAxisFit
    noise: float
    loads: Loads
    newton_per_kg: float
    force: Array


def applied_force(readings: LoadCellReadings, settings: LoadCellSettings) -> Array:
    """Return the forces (n, 2), N, that the weights put on the pin, in its frame."""
    weight = weight_force(readings.mass, settings.weights, settings.place)
    return pin_force(weight, readings.angle, settings.angle_offset)


def zeros_of(readings: LoadCellReadings, settings: LoadCellSettings, sensitivity: Array) -> Zeros:
    """Return the zeros of the unloaded readings; sensitivity (2, 2): signal per newton."""
    hanging = settings.weights.at_zero * force_per_mass(settings.weights, settings.place)
    return examine_zeros(
        readings.signal,
        readings.mass == 0.0,
        run_numbers(readings.series, angle_groups(readings.angle)),
        pin_force(1.0, readings.angle, settings.angle_offset),
        sensitivity,
        hanging,
    )


def examine(readings: LoadCellReadings, settings: LoadCellSettings) -> Evidence:
    """Fit robustly; raise numpy.linalg.LinAlgError when the loads do not span both axes."""
    applied = applied_force(readings, settings)
    found, noise = robust_fit(applied, readings.signal, settings.cell.resolution / np.sqrt(12.0))
    seen = loads(readings, applied, found.force(readings.signal))
    newton_per_kg = force_per_mass(settings.weights, settings.place)
    return Evidence(readings, settings, found, noise, seen, newton_per_kg, applied)


def without_pin_weight(evidence: Evidence) -> Evidence:
    """Return the evidence without the weight of the turning parts, if significant in the zeros.

    A constant load would otherwise be reported as an unweighed hanger.
    """
    readings = evidence.readings
    if not np.any(readings.mass == 0.0):
        return evidence
    zeros = zeros_of(readings, evidence.settings, evidence.found.sensitivity)
    hanging = evidence.settings.weights.at_zero * evidence.newton_per_kg
    if abs(zeros.weight + hanging) <= SURE_WEIGHT * zeros.weight_uncertainty:
        return evidence
    flat = replace(readings, signal=readings.signal - zeros.circle)
    return examine(flat, evidence.settings)
