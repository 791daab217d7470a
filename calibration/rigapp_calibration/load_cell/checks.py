"""Checks that catch mistakes in dead-weight readings and name them in plain words.

The second round, after ``reading_checks``: uses a robust fit, which single mistakes hardly move.
Effects on all readings (wiring, saturation, drift, hanger, hysteresis) are checked first and then
removed, so that they are not reported again as many small mistakes (``reading_faults``).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from rigapp.texts import say
from rigapp_calibration.arrays import Array
from rigapp_calibration.load_cell.characteristics import SURE, Evidence, examine, hysteresis_by_load
from rigapp_calibration.load_cell.patterns import check_patterns
from rigapp_calibration.load_cell.reading_checks import coarse
from rigapp_calibration.load_cell.reading_faults import (
    single_faults,
    swinging_series,
    wrong_angles,
)
from rigapp_calibration.load_cell.two_axis import Terms, huber_fit
from rigapp_calibration.load_cell.wiring import check_wiring
from rigapp_calibration.problems import Problem, note, refusal
from rigapp_calibration.taking.readings import place_of

NOTED_TURN = np.radians(2.0)
BLOCKING_TURN = np.radians(4.0)
"""Cross-talk of a cell resembles a turn of up to about two degrees; twice that is the angle
reference."""

DRIFT_STEPS = 2.0
"""Steps of the resolution: the first and last zero of a quiet cell may each be off by one."""


def check_fit(evidence: Evidence) -> Iterator[Problem]:
    """Yield the mistakes that the fit shows, the most significant first."""
    yield from _no_reference(evidence)
    wiring = list(check_wiring(evidence))
    if wiring:
        yield from wiring
        return
    yield from _axes(evidence)
    saturated = list(_saturated(evidence))
    if saturated:
        yield from saturated
        return
    problem, evidence = _wandering(evidence)
    if problem is not None:
        yield problem
    problems, evidence = wrong_angles(evidence)
    yield from problems
    problems, evidence = swinging_series(evidence)
    yield from problems
    problems, evidence = check_patterns(evidence)
    yield from problems
    problem, evidence = _hysteresis(evidence)
    if problem is not None:
        yield problem
    yield from single_faults(evidence)
    yield from _range(evidence)


# --- the axes of all readings --------------------------------------------------------------------


def _no_reference(evidence: Evidence) -> Iterator[Problem]:
    """Yield a note on what no reading can show: an angle error common to all pin angles."""
    if not evidence.settings.angle_stated:
        full = evidence.settings.cell.full_scale
        yield note(
            "no_angle_reference",
            "No angle reference is stated: an error that all pin angles have in common"
            " leaves no trace in the readings (1 degree turns every force by {:.1f} N"
            " at {:g} N), and U does not hold it. Take it with a level on the flat of"
            " the crank, and write [angle] offset_deg.",
            full * np.radians(1.0),
            full,
        )


def _axes(evidence: Evidence) -> Iterator[Problem]:
    a = evidence.found.sensitivity
    straight, crossed = abs(a[0, 0]) + abs(a[1, 1]), abs(a[0, 1]) + abs(a[1, 0])
    if crossed > straight:
        yield Problem(
            "axes_swapped",
            say(
                "The two signals are swapped: signal_1 follows the force across the crank;"
                " exchange the two bridges' inputs."
            )
            if np.linalg.det(a) < 0.0
            else say(
                "The two signals are swapped and one of them is reversed, or every pin"
                " angle is a quarter of a turn off; check the inputs, the wires and the"
                " angle reference."
            ),
        )
        return
    reversed_axes = [axis + 1 for axis in range(2) if a[axis, axis] < 0.0]
    if len(reversed_axes) == 2:
        yield refusal(
            "axes_reversed",
            (
                "Both signals have the wrong sign: the pin is half a turn off, or both bridges"
                " are reversed; check the angle reference."
            ),
        )
    elif reversed_axes:
        other = say(". Or the pin angle counts the wrong way") if reversed_axes[0] == 1 else ""
        yield refusal(
            "axis_reversed",
            "signal_{} has the wrong sign: that bridge is reversed; exchange its two"
            " signal wires{}.",
            reversed_axes[0],
            other,
        )
    else:
        yield from _turned(a)


def _turned(a: Array) -> Iterator[Problem]:
    """Yield the rotation in A: cross-talk of a cell is a few per cent, the rest is the angle."""
    share = 100.0 * max(abs(a[0, 1] / a[0, 0]), abs(a[1, 0] / a[1, 1]))
    turn = float(np.arctan2(a[1, 0] - a[0, 1], a[0, 0] + a[1, 1]))
    if share > 20.0 or abs(turn) > BLOCKING_TURN:
        yield refusal(
            "angle_reference",
            (
                "Each signal shows up to {:.0f} % of the other axis, as if every pin angle were"
                " {:.1f} degrees off; repeat the angle reference step."
            ),
            share,
            abs(np.degrees(turn)),
        )
    elif abs(turn) > NOTED_TURN:
        yield note(
            "angle_reference",
            (
                "The axes look as if every pin angle were {:.1f} degrees off. It can be the"
                " cell's own cross-talk; only the angle reference step decides."
            ),
            abs(np.degrees(turn)),
        )


# --- what touches all readings -------------------------------------------------------------------


def _saturated(evidence: Evidence) -> Iterator[Problem]:
    """Yield a signal that stays at its extreme while the load increases."""
    readings, signal = evidence.readings, evidence.readings.signal
    small = evidence.loads.applied <= 0.6 * evidence.loads.applied.max()
    if np.count_nonzero(small) < 8:
        return
    rows = np.column_stack((evidence.force, np.ones(len(signal))))
    coefficients = np.linalg.lstsq(rows[small], signal[small], rcond=None)[0]
    predicted = rows @ coefficients
    noise = np.std(signal[small] - predicted[small], axis=0)
    largest = np.isclose(np.abs(signal), np.abs(signal).max(), rtol=1e-9, atol=0.0)
    sharp = not coarse(readings)
    ends = [largest]
    for axis in range(2):
        for extreme in (signal[:, axis].max(), signal[:, axis].min()):
            at = np.zeros_like(largest)
            at[:, axis] = np.isclose(signal[:, axis], extreme, rtol=1e-9, atol=0.0)
            ends.append(at)
    for at in ends:
        if np.count_nonzero(at) < 2:
            continue
        beyond = np.sign(signal) * (predicted - signal)
        # Equal values are a coincidence only with a coarse display.
        sure = np.maximum(SURE * noise, (0.005 if sharp else 0.025) * np.abs(signal))
        if np.median((beyond / sure)[at]) > 1.0:
            index, axis = (int(one) for one in np.argwhere(at)[0])
            yield refusal(
                "saturated",
                (
                    "signal_{} stays at {:g} from {} while the load grows: the input is"
                    " saturated; choose a larger range."
                ),
                axis + 1,
                signal[index, axis],
                place_of(readings, index),
            )
            return


def _wandering(evidence: Evidence) -> tuple[Problem | None, Evidence]:
    """Return a zero that jumps or drifts, and the evidence without it."""
    found = _jump(evidence) or _drift(evidence)
    if found is None:
        return None, evidence
    problem, offset = found
    signal = evidence.readings.signal - offset
    return problem, examine(replace(evidence.readings, signal=signal), evidence.settings)


def _jump(evidence: Evidence) -> tuple[Problem, Array] | None:
    zeros = np.flatnonzero(evidence.loads.applied == 0.0)
    if len(zeros) < 6:
        return None
    signal = evidence.readings.signal
    felt = signal[zeros] @ evidence.found.matrix.T
    line = np.column_stack((np.ones(len(zeros)), zeros))
    drifting = felt - line @ np.linalg.lstsq(line, felt, rcond=None)[0]

    def parted(k: int) -> float:
        return float(
            np.sum((felt[:k] - felt[:k].mean(axis=0)) ** 2)
            + np.sum((felt[k:] - felt[k:].mean(axis=0)) ** 2)
        )

    split = min(range(2, len(zeros) - 1), key=parted)
    step = felt[split:].mean(axis=0) - felt[:split].mean(axis=0)
    size, cell = float(np.hypot(*step)), evidence.settings.cell
    noise = float(np.sqrt(parted(split) / (2.0 * (len(zeros) - 2))))
    least = max(SURE * noise, 0.01 * cell.full_scale, 2.0 * cell.resolution)
    if size < least or parted(split) > 0.4 * float(np.sum(drifting**2)):
        return None
    before, after = (place_of(evidence.readings, int(zeros[k])) for k in (split - 1, split))
    offset = np.zeros_like(signal)
    offset[(zeros[split - 1] + zeros[split] + 1) // 2 :] = evidence.found.sensitivity @ step
    return (
        refusal(
            "zero_jump",
            "The zero jumps by {:.1f} N between {} and {}: did something touch cable or"
            " amplifier? Take the readings again.",
            size,
            before,
            after,
        ),
        offset,
    )


def _drift(evidence: Evidence) -> tuple[Problem, Array] | None:
    """Return the drift by all readings: single zeros jump by a resolution step of the cell."""
    cell = evidence.settings.cell
    if np.count_nonzero(evidence.loads.applied == 0.0) < 3:
        return None
    terms = Terms(quadratic=evidence.found.terms.quadratic, drift=True)
    force, floor = evidence.force, cell.resolution / np.sqrt(12.0)
    try:
        found, _ = huber_fit(force, evidence.readings.signal, floor, terms)
    except np.linalg.LinAlgError:
        return None
    drift = found.matrix @ found.coefficients[-1]
    size = float(np.hypot(*drift))
    rows = [terms.count - 1, 2 * terms.count - 1]
    spread = found.matrix @ found.covariance[np.ix_(rows, rows)] @ found.matrix.T
    sigma = float(np.sqrt(np.linalg.eigvalsh(spread)[-1]))
    least = max(DRIFT_STEPS * cell.resolution, 0.0075 * cell.full_scale)
    if size <= max(SURE * sigma, least):
        return None
    zeros = np.flatnonzero(evidence.loads.applied == 0.0)
    along = evidence.readings.signal[zeros] @ found.matrix.T @ drift / size
    if np.polyfit(zeros / (len(force) - 1), along, 1)[0] < least:
        return None
    ramp = np.linspace(-0.5, 0.5, len(force))[:, None] * found.coefficients[-1]
    return (
        refusal(
            "drift",
            "The zero drifts by {:.1f} N over the calibration; let the cell warm up and"
            " take the readings again.",
            size,
        ),
        ramp,
    )


def _hysteresis(evidence: Evidence) -> tuple[Problem | None, Evidence]:
    by_load = hysteresis_by_load(evidence.loads)
    if not by_load:
        return (
            note(
                "no_descending_series",
                "No load was read both going up and going down, so hysteresis is"
                " unknown; add a descending series.",
            ),
            evidence,
        )
    largest = max(by_load.values(), key=abs)
    if abs(largest) <= 0.01 * evidence.settings.cell.full_scale:
        return None, evidence
    found = evidence.loads
    half = np.array([0.5 * by_load.get(round(float(load), 3), 0.0) for load in found.applied])
    along = found.along - np.where(found.rising, -half, half)
    return (
        refusal(
            "hysteresis",
            "Going down the cell reads {:+.1f} N against going up, more than 1 % of"
            " full scale: something rubs, slips or was overloaded; find it before"
            " calibrating.",
            largest,
        ),
        replace(
            evidence,
            loads=replace(found, along=along),
            noise=max(evidence.noise, 0.25 * abs(largest)),
        ),
    )


def _range(evidence: Evidence) -> Iterator[Problem]:
    heaviest, full = float(evidence.loads.applied.max()), evidence.settings.cell.full_scale
    if heaviest < 0.8 * full:
        yield note(
            "range_not_covered",
            "The largest load is {:.0f} N of {:.0f} N; above it the calibration is extrapolated.",
            heaviest,
            full,
        )
