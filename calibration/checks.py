"""Checks that catch mistakes in dead-weight readings and name them in plain words.

The second round, after ``reading_checks``: it looks at the readings through a robust fit, which
single mistakes hardly move.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from calibration.characteristics import Loads, hysteresis
from calibration.problems import Problem
from calibration.reading_checks import place_of
from calibration.readings import LoadCellReadings
from calibration.settings import LoadCellSettings
from calibration.two_axis import TwoAxisFit

Array = NDArray[np.float64]

SURE = 5.0


@dataclass(frozen=True, slots=True)
class Evidence:
    """What the second round looks at: readings, robust fit, noise (N), loads, N per kg."""

    readings: LoadCellReadings
    settings: LoadCellSettings
    found: TwoAxisFit
    noise: float
    loads: Loads
    newton_per_kg: float


def check_fit(evidence: Evidence) -> Iterator[Problem]:
    """Yield the mistakes that the fit shows, the most telling first."""
    yield from _axes(evidence)
    saturated = list(_saturated(evidence))
    yield from saturated
    step_problems, explained = _steps(evidence)
    yield from step_problems
    loose = list(_loose_cable(evidence, explained))
    yield from loose
    yield from _angle_off(evidence, explained)
    if not saturated and not loose:
        yield from _not_monotonic(evidence, explained)
    yield from _hysteresis(evidence)
    yield from _drift(evidence)
    yield from _scatter(evidence, explained)
    yield from _range(evidence)


def _axes(evidence: Evidence) -> Iterator[Problem]:
    a = evidence.found.sensitivity
    straight, crossed = abs(a[0, 0]) + abs(a[1, 1]), abs(a[0, 1]) + abs(a[1, 0])
    if crossed > straight:
        yield Problem(
            "axes_swapped",
            "The two signals are swapped: signal_1 follows the force across the crank; exchange the"
            " two bridges' inputs.",
        )
        return
    reversed_axes = [str(axis + 1) for axis in range(2) if a[axis, axis] < 0.0]
    if len(reversed_axes) == 2:
        yield Problem(
            "axes_reversed",
            "Both signals have the wrong sign: the pin stands half a turn off, or both bridges are"
            " reversed; check the angle reference.",
        )
    elif reversed_axes:
        yield Problem(
            "axis_reversed",
            f"signal_{reversed_axes[0]} has the wrong sign: that bridge is reversed; exchange its"
            " two signal wires.",
        )
    else:
        yield from _cross_talk(a)


def _cross_talk(a: Array) -> Iterator[Problem]:
    share = 100.0 * max(abs(a[0, 1] / a[0, 0]), abs(a[1, 0] / a[1, 1]))
    if share > 20.0:
        yield Problem(
            "angle_reference",
            f"Each signal sees {share:.0f} % of the other axis; the pin's angle reference is"
            " probably off. Repeat the angle reference step.",
        )


def _saturated(evidence: Evidence) -> Iterator[Problem]:
    """A signal that stands still at its extreme while the load goes on growing."""
    readings, signal = evidence.readings, evidence.readings.signal
    small = evidence.loads.applied <= 0.6 * evidence.loads.applied.max()
    if np.count_nonzero(small) < 8:
        return
    force = _applied(evidence)
    rows = np.column_stack((force, np.ones(len(force))))
    try:
        coefficients = np.linalg.lstsq(rows[small], signal[small], rcond=None)[0]
    except np.linalg.LinAlgError:
        return
    predicted = rows @ coefficients
    noise = np.std(signal[small] - predicted[small], axis=0)
    for axis in range(2):
        for extreme in (signal[:, axis].max(), signal[:, axis].min()):
            at = np.isclose(signal[:, axis], extreme, rtol=1e-9, atol=0.0)
            beyond = np.abs(predicted[at, axis]) - abs(extreme)
            if np.count_nonzero(at) >= 2 and beyond.max() > max(
                6.0 * noise[axis], 0.02 * abs(extreme)
            ):
                index = int(np.flatnonzero(at)[0])
                yield Problem(
                    "saturated",
                    f"signal_{axis + 1} stands still at {extreme:g} from"
                    f" {place_of(readings, index)} while the load grows: the input is saturated;"
                    " choose a larger range.",
                )


def _applied(evidence: Evidence) -> Array:
    """Return the applied forces (n, 2), recomputed from the fit's residual and the readings."""
    angle = evidence.readings.angle + evidence.settings.angle_offset
    size = evidence.loads.applied
    return np.stack((-size * np.sin(angle), -size * np.cos(angle)), axis=-1)


def _steps(evidence: Evidence) -> tuple[list[Problem], NDArray[np.bool_]]:
    """Find readings that fit another mass than the one written: swapped, skipped, wrong."""
    readings, found = evidence.readings, evidence.loads
    off = found.along - found.applied
    sure = max(SURE * evidence.noise, 0.005 * found.applied.max())
    wrong = (np.abs(off) > sure) & (np.abs(found.across) < np.maximum(sure, 0.5 * np.abs(off)))
    explained = np.zeros(len(readings), dtype=np.bool_)
    problems: list[Problem] = []
    indices = {
        name: [i for i, one in enumerate(readings.series) if one == name]
        for name in dict.fromkeys(readings.series)
    }
    for members in indices.values():
        _swapped(evidence, members, wrong, explained, problems)
        _shifted(evidence, members, wrong, explained, problems)
    for index in np.flatnonzero(wrong & ~explained):
        if np.count_nonzero(wrong) > 0.4 * len(readings):
            break
        believed = found.along[index] / evidence.newton_per_kg
        explained[index] = True
        problems.append(
            Problem(
                "wrong_weight",
                f"At {place_of(readings, int(index))} the cell felt {believed:.2f} kg, but"
                f" {readings.mass[index]:g} kg is written; check the weights that hung there.",
            )
        )
    return _few(problems), explained


def _swapped(
    evidence: Evidence,
    members: list[int],
    wrong: NDArray[np.bool_],
    explained: NDArray[np.bool_],
    problems: list[Problem],
) -> None:
    found, sure = evidence.loads, SURE * evidence.noise
    suspects = [i for i in members if wrong[i]]
    if len(suspects) > 6:
        return
    for place, first in enumerate(suspects):
        for second in suspects[place + 1 :]:
            if explained[first] or explained[second]:
                continue
            if (
                abs(found.along[first] - found.applied[second]) < sure
                and abs(found.along[second] - found.applied[first]) < sure
            ):
                explained[[first, second]] = True
                problems.append(
                    Problem(
                        "swapped_steps",
                        f"In series {evidence.readings.series[first]} the readings of steps"
                        f" {evidence.readings.step[first]} and {evidence.readings.step[second]}"
                        " are swapped.",
                    )
                )


def _shifted(
    evidence: Evidence,
    members: list[int],
    wrong: NDArray[np.bool_],
    explained: NDArray[np.bool_],
    problems: list[Problem],
) -> None:
    """A run of readings that each fit the next (or previous) step's mass: a step was skipped."""
    found, sure = evidence.loads, SURE * evidence.noise
    for shift, code, words in (
        (1, "skipped_step", "a step was skipped there: each reading belongs to the next load"),
        (-1, "repeated_step", "a step was taken twice there: each reading belongs to the last one"),
    ):  # fmt: skip
        pairs = [
            (members[k], members[k + shift])
            for k in range(len(members))
            if 0 <= k + shift < len(members)
        ]
        run = [
            i
            for i, j in pairs
            if wrong[i] and not explained[i] and abs(found.along[i] - found.applied[j]) < sure
        ]
        if len(run) >= 2:
            explained[[i for i in members if i >= run[0]]] = True
            problems.append(
                Problem(
                    code,
                    f"From {place_of(evidence.readings, run[0])} on, {words}.",
                )
            )


def _loose_cable(evidence: Evidence, explained: NDArray[np.bool_]) -> Iterator[Problem]:
    """Readings off in one signal alone, or far off in no sensible direction."""
    readings = evidence.readings
    scale = np.abs(np.diag(evidence.found.sensitivity))
    off = np.abs(evidence.found.residual_signal) / scale
    far = max(4.0 * SURE * evidence.noise, 0.05 * evidence.settings.cell.full_scale)
    bad = (off.max(axis=1) > far) & ~explained
    if np.count_nonzero(bad) == 0:
        return
    index = int(np.flatnonzero(bad)[0])
    axis = int(np.argmax(off[index]))
    count = int(np.count_nonzero(bad))
    if count > 0.4 * len(readings):
        return
    explained[bad] = True
    yield Problem(
        "cable_loose",
        f"signal_{axis + 1} jumps by {off[index, axis]:.0f} N at {place_of(readings, index)}"
        + (f" (and at {count - 1} more)" if count > 1 else "")
        + ", whatever hangs there: is a cable or the slip ring loose?",
    )


def _angle_off(evidence: Evidence, explained: NDArray[np.bool_]) -> Iterator[Problem]:
    """A pin angle at which every load seems turned by the same amount."""
    found, readings = evidence.loads, evidence.readings
    turns = []
    for group in np.unique(found.group):
        members = (found.group == group) & (found.applied > 0.0) & ~explained
        power = float(np.sum(found.applied[members] ** 2))
        if power == 0.0:
            continue
        turn = float(np.sum(found.applied[members] * found.across[members]) / power)
        turns.append((turn, evidence.noise / np.sqrt(power), int(np.flatnonzero(members)[0])))
    if len(turns) < 3:
        return
    middle = float(np.median([turn for turn, _, _ in turns]))
    turn, sigma, index = max(turns, key=lambda one: abs(one[0] - middle))
    if abs(turn - middle) > max(SURE * sigma, np.radians(0.2)):
        angle = np.degrees(readings.angle[index])
        yield Problem(
            "angle_off",
            f"At the pin angle of {angle:.1f} degrees (series {readings.series[index]}) every load"
            f" seems turned by {np.degrees(turn - middle):+.2f} degrees: the angle written there,"
            " or at the opposite position, is off; take it from the encoder.",
        )


def _not_monotonic(evidence: Evidence, explained: NDArray[np.bool_]) -> Iterator[Problem]:
    found, readings = evidence.loads, evidence.readings
    for index in range(1, len(readings)):
        if (
            readings.series[index] != readings.series[index - 1]
            or explained[[index - 1, index]].any()
        ):
            continue
        if found.group[index] != found.group[index - 1]:
            continue
        applied = found.applied[index] - found.applied[index - 1]
        seen = found.along[index] - found.along[index - 1]
        if applied != 0.0 and seen * np.sign(applied) < -SURE * evidence.noise:
            yield Problem(
                "not_monotonic",
                f"From step {readings.step[index - 1]} to {readings.step[index]} of series"
                f" {readings.series[index]} the load {'grew' if applied > 0 else 'fell'} but the"
                " reading went the other way; check what hung there.",
            )
            return


def _hysteresis(evidence: Evidence) -> Iterator[Problem]:
    difference = hysteresis(evidence.loads)
    full = evidence.settings.cell.full_scale
    if difference is None:
        yield Problem(
            "no_descending_series",
            "No load was read both going up and going down, so hysteresis is unknown; add a"
            " descending series.",
            blocks=False,
        )
    elif abs(difference) > 0.01 * full:
        yield Problem(
            "hysteresis",
            f"Going down the cell reads {difference:+.1f} N against going up, more than 1 % of full"
            " scale: something rubs, slips or was overloaded; find it before calibrating.",
        )


def _drift(evidence: Evidence) -> Iterator[Problem]:
    found = evidence.loads
    zeros = np.flatnonzero(found.applied == 0.0)
    if len(zeros) < 3:
        return
    order = zeros / max(len(found.applied) - 1, 1)
    measured = evidence.found.residual[zeros]
    slope = np.array([np.polyfit(order, measured[:, axis], 1)[0] for axis in range(2)])
    sigma = evidence.noise / (np.std(order) * np.sqrt(len(zeros)) + 1e-12)
    size = float(np.hypot(*slope))
    allowed = max(evidence.settings.cell.resolution, 0.005 * evidence.settings.cell.full_scale)
    if size > max(SURE * sigma, allowed):
        yield Problem(
            "drift",
            f"The zero drifts by {size:.1f} N over the calibration; let the cell warm up and take"
            " the readings again.",
        )


def _scatter(evidence: Evidence, explained: NDArray[np.bool_]) -> Iterator[Problem]:
    size = np.hypot(*evidence.found.residual.T)
    allowed = max(evidence.settings.cell.resolution, 0.005 * evidence.settings.cell.full_scale)
    readings = evidence.readings
    worst: tuple[float, str] = (0.0, "")
    for name in dict.fromkeys(readings.series):
        members = np.array([one == name for one in readings.series]) & ~explained
        if np.count_nonzero(members) >= 4:
            spread = float(np.sqrt(np.mean(size[members] ** 2) / 2.0))
            worst = max(worst, (spread, name))
    if worst[0] > 1.5 * allowed:
        yield Problem(
            "scatter",
            f"The readings of series {worst[1]} scatter by {worst[0]:.1f} N: was the weight still"
            " swinging? Wait until it hangs still.",
        )


def _range(evidence: Evidence) -> Iterator[Problem]:
    heaviest, full = float(evidence.loads.applied.max()), evidence.settings.cell.full_scale
    if heaviest < 0.8 * full:
        yield Problem(
            "range_not_covered",
            f"The largest load is {heaviest:.0f} N of {full:.0f} N; above it the calibration is"
            " extrapolated.",
            blocks=False,
        )


def _few(problems: list[Problem]) -> list[Problem]:
    """Keep the first of each code and say how many more there are."""
    kept: dict[str, Problem] = {}
    count: dict[str, int] = {}
    for problem in problems:
        kept.setdefault(problem.code, problem)
        count[problem.code] = count.get(problem.code, 0) + 1
    return [
        problem
        if count[code] == 1
        else Problem(code, f"{problem.sentence} ({count[code] - 1} more like it.)", problem.blocks)
        for code, problem in kept.items()
    ]
