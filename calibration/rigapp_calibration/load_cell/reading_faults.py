"""Single readings and series that deviate from the others, with the most likely mistake.

Readings explained by one check are left out of the next: angle, order, swinging, cable, weight.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rigapp.texts import say
from rigapp_calibration.arrays import Array, Marks
from rigapp_calibration.load_cell.characteristics import SURE, Evidence, examine
from rigapp_calibration.load_cell.two_axis import ITERATIONS
from rigapp_calibration.problems import Problem, refusal
from rigapp_calibration.taking.readings import each_series, place_of

ANGLE_OFF = np.radians(0.5)
"""An angle set by eye and read from a protractor is right to a few tenths: that is scatter, which
the uncertainty holds; five times the 0.1 degrees of an encoder is a mistake."""

FAR_OFF = np.radians(2.5)
"""A gain change of one bridge that turns loads this far, 9 %, is detected by another check."""
MOST_OFF, FEW_OFF = 0.6, 0.2
"""Share of the runs whose angles may be off; the second of those in the first search."""
FEWEST_LEFT = 4
"""Pin angles; with fewer, other mistakes cannot be located."""
SWINGS = 3.0
"""Factor of the noise of all readings, which is robust against single wrong ones."""
NORMAL_MEDIAN = 0.6745
"""Median of the magnitude of a normal variable of standard deviation 1."""
FEWEST_SMOOTH = 6
"""Loaded readings of a run needed to separate a curvature of two coefficients from an outlier."""


def single_faults(evidence: Evidence) -> Iterator[Problem]:
    """Yield mistakes of single readings and series, one of each code."""
    explained: Marks = np.zeros(len(evidence.readings), dtype=np.bool_)
    for check in (_angle_off, _angle_of_one, _steps, _swinging, _loose_cable, _wrong_weight):
        yield from _first_of_each_code(list(check(evidence, explained)))
    yield from _not_monotonic(evidence, explained)
    yield from _scatter(evidence, explained)


def wrong_angles(evidence: Evidence) -> tuple[list[Problem], Evidence]:
    """Return angles that are off by far, and the evidence without their readings.

    Checked before changes between series: a load turned by far looks like a changed gain.
    """
    explained: Marks = np.zeros(len(evidence.readings), dtype=np.bool_)
    problems = _first_of_each_code(
        [*_angle_of_one(evidence, explained), *_angle_off(evidence, explained, FAR_OFF, FEW_OFF)]
    )
    left = ~explained
    if not problems or len(np.unique(evidence.loads.group[left])) < FEWEST_LEFT:
        return [], evidence
    return problems, examine(evidence.readings.only(left), evidence.settings)


def swinging_series(evidence: Evidence) -> tuple[list[Problem], Evidence]:
    """Return series whose weight swung all the time, and the evidence without them.

    They scatter about their own line, along and across; checked before changes between series,
    since by chance they look like a changed gain.
    """
    found, swung = evidence.loads, np.zeros(len(evidence.readings), dtype=np.bool_)
    problems, least = [], max(1.5 * _allowed(evidence), SWINGS * evidence.noise)
    for name, members in each_series(evidence.readings.series):
        loaded = members & (found.applied > 0.0)
        if np.count_nonzero(loaded) < FEWEST_SMOOTH:
            continue
        share = found.applied[loaded] / found.applied.max()
        rows = np.column_stack((np.ones_like(share), share))
        rest = np.column_stack(
            [
                one - rows @ _huber_line(rows, one, evidence.noise)[0]
                for one in (found.along[loaded], found.across[loaded])
            ]
        )
        if np.median(np.abs(rest), axis=0).min() / NORMAL_MEDIAN > least:
            swung |= members
            spread = float(np.sqrt(np.mean(rest**2)))
            problems.append(Problem("scatter", _scatter_words(name, spread)))
    if not problems or len(np.unique(found.group[~swung])) < FEWEST_LEFT:
        return [], evidence
    return _first_of_each_code(problems), examine(evidence.readings.only(~swung), evidence.settings)


def _significant_difference(evidence: Evidence) -> float:
    """Return the difference (N) from which a reading counts as wrong."""
    return max(SURE * evidence.noise, 0.005 * float(evidence.loads.applied.max()))


def _deviations(evidence: Evidence) -> tuple[Array, Array]:
    """Return the deviations of readings along and across their load, N."""
    return evidence.loads.along - evidence.loads.applied, evidence.loads.across


def _along_only(evidence: Evidence) -> Marks:
    """Return which readings deviate along their load, and little across it.

    A cell of third degree shifts every load of its run, which is not a mistake: a reading must
    also deviate from the rest of its run.
    """
    (off, across), sure = _deviations(evidence), _significant_difference(evidence)
    wrong = (np.abs(off) > sure) & (np.abs(across) < np.maximum(sure, 0.5 * np.abs(off)))
    return wrong & (np.abs(_deviations_within_run(evidence, off, wrong)) > 0.5 * sure)


def _deviations_within_run(evidence: Evidence, off: Array, selected: Marks) -> Array:
    """Return the deviations of readings from the rest of their run, (n,) N; ``off`` of all others.

    The rest gives a gain and a curvature, by Huber. Its prediction of the heaviest load is less
    certain: deviations are scaled to those of a well predicted reading.
    """
    deviations, runs = off.copy(), evidence.loads.runs()
    share = evidence.loads.applied / evidence.loads.applied.max()
    rows = np.column_stack((share, share**3))
    for index in np.flatnonzero(selected):
        rest = (runs == runs[index]) & (share > 0.0)
        rest[index] = False
        if np.count_nonzero(rest) + 1 < FEWEST_SMOOTH:
            continue
        solved, spread = _huber_line(rows[rest], off[rest], evidence.noise)
        doubt = float(rows[index] @ spread @ rows[index])
        deviations[index] = (off[index] - rows[index] @ solved) / np.sqrt(1.0 + doubt)
    return deviations


def _huber_line(rows: Array, values: Array, noise: float) -> tuple[Array, Array]:
    """Return a solution by Huber's weights, and its covariance in squares of the noise."""
    root = np.ones(len(values))
    for _ in range(ITERATIONS):
        weighted = rows * root[:, None]
        solved = np.linalg.lstsq(weighted, values * root, rcond=None)[0]
        rest = np.abs(values - rows @ solved)
        root = np.minimum(1.0, noise / np.maximum(rest, 1e-300))
    return np.asarray(solved), np.asarray(np.linalg.pinv(weighted.T @ weighted))


# --- angles --------------------------------------------------------------------------------------


def _angle_off(
    evidence: Evidence, explained: Marks, least: float = ANGLE_OFF, most: float = MOST_OFF
) -> Iterator[Problem]:
    """Yield a pin angle at which every load seems turned by the same amount.

    least: rad, that counts; most: share of the runs that may be off.
    """
    found, readings = evidence.loads, evidence.readings
    turns: list[tuple[float, float, Marks]] = []
    for _, members in each_series(readings.series):
        for group in np.unique(found.group[members]):
            block = members & (found.group == group)
            turn = _turn(evidence, block & (found.applied > 0.0))
            if turn is not None:
                turns.append((*turn, block))
    if len(turns) < 3:
        return
    middle = float(np.median([turn for turn, _, _ in turns]))
    off = [
        (turn - middle, block)
        for turn, sigma, block in turns
        if abs(turn - middle) > max(SURE * sigma, least)
    ]
    if not off or len(off) > most * len(turns):
        return
    for _, block in off:
        explained |= block
    worst, block = max(off, key=lambda one: abs(one[0]))
    index = int(np.flatnonzero(block)[0])
    yield refusal(
        "angle_off",
        "At the pin angle of {:.1f} degrees (series {}) every load seems turned by"
        " {:+.2f} degrees: the angle written there, or at the opposite position, is"
        " off; take it from the encoder.",
        np.degrees(readings.angle[index]),
        readings.series[index],
        np.degrees(worst),
    )


def _turn(evidence: Evidence, members: Marks) -> tuple[float, float] | None:
    """Return (turn, its standard deviation) in rad of turned loads, else None."""
    found = evidence.loads
    power = float(np.sum(found.applied[members] ** 2))
    if np.count_nonzero(members) < 3 or power == 0.0:
        return None
    along, across, applied = (
        found.along[members], found.across[members], found.applied[members],
    )  # fmt: skip
    turns = np.arctan2(across, along)
    start = float(np.angle(np.sum(np.exp(1j * turns))))
    turn = start + float(np.median(np.angle(np.exp(1j * (turns - start)))))
    rest = np.hypot(along - applied * np.cos(turn), across - applied * np.sin(turn))
    if np.median(rest) > max(2.0 * evidence.noise, 0.02 * float(np.median(applied))):
        return None
    near = rest < max(SURE * evidence.noise, 3.0 * float(np.median(rest)))
    turned = np.exp(1j * (turns[near] - turn))
    turn += float(np.angle(np.sum(applied[near] ** 2 * turned)))
    scatter = max(evidence.noise, float(np.median(rest)))  # of a swinging weight
    return turn, scatter / np.sqrt(float(np.sum(applied[near] ** 2)))


def _angle_of_one(evidence: Evidence, explained: Marks) -> Iterator[Problem]:
    """Yield a reading whose written angle differs from its neighbours' as its load is turned."""
    found, readings = evidence.loads, evidence.readings
    sure = _significant_difference(evidence)
    for index in np.flatnonzero((found.applied > 0.0) & ~explained):
        turn = float(np.arctan2(found.across[index], found.along[index]))
        size = float(np.hypot(found.along[index], found.across[index]))
        if (
            found.applied[index] * abs(turn) < sure
            or abs(size - found.applied[index]) > sure
            or abs(turn) < np.radians(0.5)
        ):
            continue
        near = [
            i
            for i in (index - 1, index + 1)
            if 0 <= i < len(readings) and readings.series[i] == readings.series[index]
        ]
        if not near:
            continue
        written = readings.angle[index] - readings.angle[near]
        differs = np.angle(np.exp(1j * written))
        if np.all(np.abs(np.abs(differs) - abs(turn)) < 0.3 * abs(turn) + np.radians(0.3)):
            explained[index] = True
            yield refusal(
                "angle_off",
                "The pin angle of {:.1f} degrees at {} is off by about {:.1f} degrees;"
                " take it from the encoder.",
                np.degrees(readings.angle[index]),
                place_of(readings, int(index)),
                abs(np.degrees(turn)),
            )


# --- order ---------------------------------------------------------------------------------------


def _steps(evidence: Evidence, explained: Marks) -> Iterator[Problem]:
    """Yield readings that fit the mass of another step: skipped, repeated, swapped."""
    wrong = _along_only(evidence) & ~explained
    for _, marks in each_series(evidence.readings.series):
        members = np.flatnonzero(marks).tolist()
        yield from _shifted(evidence, members, wrong, explained)
        yield from _swapped(evidence, members, wrong, explained)


def _shifted(
    evidence: Evidence, members: list[int], wrong: Marks, explained: Marks
) -> Iterator[Problem]:
    """Yield a run of readings that each fit the next (or previous) step's mass: a skipped step."""
    found, sure = evidence.loads, SURE * evidence.noise
    for shift, code, words in (
        (1, "skipped_step", say("a step was skipped there: each reading belongs to the next load")),
        (
            -1, "repeated_step",
            say("a step was repeated there: each reading belongs to the previous one"),
        ),
    ):  # fmt: skip
        run = [
            i
            for k, i in enumerate(members)
            if 0 <= k + shift < len(members)
            and wrong[i]
            and not explained[i]
            and found.group[i] == found.group[members[k + shift]]
            and abs(found.along[i] - found.applied[members[k + shift]]) < sure
        ]
        if len(run) >= 2:
            group = found.group[run[0]]
            explained[[i for i in members if i >= run[0] and found.group[i] == group]] = True
            yield refusal(code, "From {} on, {}.", place_of(evidence.readings, run[0]), words)


def _swapped(
    evidence: Evidence, members: list[int], wrong: Marks, explained: Marks
) -> Iterator[Problem]:
    found, readings, sure = evidence.loads, evidence.readings, SURE * evidence.noise
    suspects = [i for i in members if wrong[i] and not explained[i]]
    if len(suspects) > 6:
        return
    for place, first in enumerate(suspects):
        for second in suspects[place + 1 :]:
            if (
                not explained[[first, second]].any()
                and found.group[first] == found.group[second]
                and abs(found.along[first] - found.applied[second]) < sure
                and abs(found.along[second] - found.applied[first]) < sure
            ):
                explained[[first, second]] = True
                yield refusal(
                    "swapped_steps",
                    "In series {} the readings of steps {} and {} are swapped.",
                    readings.series[first],
                    readings.step[first],
                    readings.step[second],
                )


# --- single readings -----------------------------------------------------------------------------


def _swinging(evidence: Evidence, explained: Marks) -> Iterator[Problem]:
    """Yield a series whose readings scatter to and fro, along and across."""
    off, across = _deviations(evidence)
    size = np.hypot(off, across)
    for name, members in each_series(evidence.readings.series):
        members &= (evidence.loads.applied > 0.0) & ~explained
        bad = members & (size > 4.0 * evidence.noise)
        if np.count_nonzero(bad) < max(3.0, 0.4 * np.count_nonzero(members)):
            continue
        spread = float(np.sqrt(np.mean(size[members] ** 2) / 2.0))
        sideways = float(np.sqrt(np.mean(across[bad] ** 2) / np.mean(size[bad] ** 2)))
        if spread > 1.5 * _allowed(evidence) and sideways > 0.3:
            explained |= members
            yield Problem("scatter", _scatter_words(name, spread))


def _loose_cable(evidence: Evidence, explained: Marks) -> Iterator[Problem]:
    """Yield readings far off in one signal alone, whatever the direction of the load."""
    readings, (off, across) = evidence.readings, _deviations(evidence)
    scale = np.linalg.norm(evidence.found.sensitivity, axis=1)
    jump = np.abs(evidence.found.residual_signal) / scale
    far = max(4.0 * SURE * evidence.noise, 0.05 * evidence.settings.cell.full_scale)
    alone = (jump.max(axis=1) > far) & (jump.min(axis=1) < 0.25 * jump.max(axis=1)) & ~explained
    # A load at 45 degrees is off along it as much as across it.
    telling = alone & (np.abs(across) > 0.5 * np.abs(off))
    empty = alone & (evidence.loads.applied == 0.0)
    axes = [axis for axis in range(2) if (telling | empty)[jump.argmax(axis=1) == axis].any()]
    bad = alone & np.isin(jump.argmax(axis=1), axes)
    count = int(np.count_nonzero(bad))
    if count == 0 or count > 0.4 * len(readings):
        return
    explained |= bad
    index = int(np.flatnonzero(bad)[0])
    axis = int(np.argmax(jump[index]))
    yield Problem(
        "cable_loose",
        say(
            "signal_{} jumps by {:.0f} N at {}",
            axis + 1,
            jump[index, axis],
            place_of(readings, index),
        )
        + (say(" (and at {} more)", count - 1) if count > 1 else "")
        + say(", of unknown cause: is a cable or the slip ring loose?"),
    )


def _wrong_weight(evidence: Evidence, explained: Marks) -> Iterator[Problem]:
    readings, found = evidence.readings, evidence.loads
    wrong = _along_only(evidence) & ~explained
    if np.count_nonzero(wrong) > 0.4 * len(readings):
        return
    for index in np.flatnonzero(wrong):
        explained[index] = True
        felt = found.along[index] / evidence.newton_per_kg
        yield refusal(
            "wrong_weight",
            (
                "At {} the cell read {:.2f} kg, but {:g} kg is written; check the weights of"
                " that step."
            ),
            place_of(readings, int(index)),
            felt,
            readings.mass[index],
        )


def _not_monotonic(evidence: Evidence, explained: Marks) -> Iterator[Problem]:
    found, readings = evidence.loads, evidence.readings
    for index in range(1, len(readings)):
        if (
            readings.series[index] != readings.series[index - 1]
            or explained[[index - 1, index]].any()
            or found.group[index] != found.group[index - 1]
        ):
            continue
        applied = found.applied[index] - found.applied[index - 1]
        seen = found.along[index] - found.along[index - 1]
        if applied != 0.0 and seen * np.sign(applied) < -SURE * evidence.noise:
            yield refusal(
                "not_monotonic",
                "From step {} to {} of series {} the load {} but the reading went the"
                " other way; check what hung there.",
                readings.step[index - 1],
                readings.step[index],
                readings.series[index],
                say("grew") if applied > 0 else say("fell"),
            )
            return


def _scatter(evidence: Evidence, explained: Marks) -> Iterator[Problem]:
    """Yield a series, or one reading, that scatters more than the cell can."""
    size = np.hypot(*_deviations(evidence))
    readings, allowed = evidence.readings, _allowed(evidence)
    worst: tuple[float, str] = (0.0, "")
    for name, members in each_series(readings.series):
        members &= ~explained
        if np.count_nonzero(members) >= 4:
            spread = float(np.sqrt(np.mean(size[members] ** 2) / 2.0))
            worst = max(worst, (spread, name))
    if worst[0] > 1.5 * allowed:
        yield Problem("scatter", _scatter_words(worst[1], worst[0]))
        return
    rest = np.where(explained, 0.0, size)
    index = int(np.argmax(rest))
    if rest[index] > max(8.0 * evidence.noise, 3.0 * allowed):
        yield refusal(
            "scatter",
            "The reading at {} is {:.1f} N off, not only along its load: was the weight"
            " still swinging? Take it again.",
            place_of(readings, index),
            rest[index],
        )


def _scatter_words(name: str, spread: float) -> str:
    return say(
        "The readings of series {} scatter by {:.1f} N: was the weight still swinging?"
        " Wait until it hangs still.",
        name,
        spread,
    )


def _allowed(evidence: Evidence) -> float:
    cell = evidence.settings.cell
    return max(cell.resolution, 0.005 * cell.full_scale)


def _first_of_each_code(problems: list[Problem]) -> list[Problem]:
    """Return the first problem of each code, with the number of the others."""
    kept: dict[str, Problem] = {}
    count: dict[str, int] = {}
    for problem in problems:
        kept.setdefault(problem.code, problem)
        count[problem.code] = count.get(problem.code, 0) + 1
    return [
        problem
        if count[code] == 1
        else Problem(
            code, say("{} ({} more like it.)", problem.sentence, count[code] - 1), problem.blocks
        )
        for code, problem in kept.items()
    ]
