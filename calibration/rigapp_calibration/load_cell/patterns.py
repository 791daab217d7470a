"""Mistakes with a pattern over many readings: a changed gain, a piece not as marked.

Readings of one load in one run (a series at one pin angle) make one cell. The deviations of the
cells from the applied forces are explained by effects of correct calibrations (the fit itself, a
drift of the zero, a turn of each run, half a hysteresis loop) and by one mistake of ``patterns``.
The one that explains most is reported if Student's t of its size is significant and its size is
more than a good cell shows; then it is removed and the search is repeated.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from scipy import special

from rigapp.texts import say
from rigapp_calibration.arrays import Array, Whole
from rigapp_calibration.load_cell.characteristics import Evidence, examine
from rigapp_calibration.load_cell.two_axis import HUBER, Terms, cubes, squares
from rigapp_calibration.problems import Problem, refusal
from rigapp_calibration.taking.readings import place_of

FALSE_ALARMS = 1e-4
"""Probability of a false alarm, by Bonferroni's bound over all patterns: 1 in 10,000 good
calibrations."""
GAIN_CHANGE = 0.005
"""Relative: a bridge and its amplifier keep their gain ten times better through an afternoon."""
MASS_SHARE = 0.003
"""Part of full scale: good cells show as much hysteresis and nonlinearity."""
FRICTION = 0.0085
"""Part of full scale: friction or slack at a hanger holds back less, a hanger weighs more."""
LIKE_THE_HANGER = 0.25
"""Part of hanger_mass_kg within which a missing mass is attributed to the hanger itself."""
HELD_BACK = 1.5
"""Factor of the stated dead zone that readings may show: they determine it to a third."""
MOST_AT_ONCE = 3
"""Maximum number of such mistakes reported in one calibration."""
ROUNDS = 4
"""The weights of outlying cells and the best pattern converge in three rounds."""


RAYLEIGH_MEDIAN = 1.1774
"""Of the length of a vector whose two parts have standard deviation 1."""
ANGLES_OF_CUBES = 7
"""Number of pin angles from which terms of third degree, which good cells have, are
distinguishable."""
NONLINEARITY_OF_CELL = 0.004
"""Part of full scale, standard deviation of terms of second and third degree: makers state
linearities up to 0.5 %. A gain change between series looks similar, but is larger."""
FEWEST_DEGREES = 8
"""Fewer degrees give the noise to no better than a quarter: patterns are then not evaluated."""


@dataclass(frozen=True, slots=True)
class Pattern:
    """A mistake of size 1. column: its effect on the cells (2 cells), N; least: reported size.

    bridges: whose gain changes, empty for weights. place: first run concerned, or the
    index of the load; only: at that load alone; steady: all at once, not slowly.
    stated: a size that the settings allow for.
    """

    column: Array
    least: float
    bridges: tuple[int, ...]
    place: int
    only: bool = False
    steady: bool = True
    stated: float = 0.0


@dataclass(frozen=True, slots=True)
class Averages:
    """The readings by run and load. of: run (n) of each reading, load (n) of each.

    run, load (cells): numbers of both; force (cells, 2) applied, off: measured less applied, N;
    time: 0 .. 1 over the calibration; loads: N, rising; bow: half the hysteresis loop may be, N;
    repeats: share of the cells whose readings are equal in all digits; angles: how many.
    """

    of: tuple[Whole, Whole]
    run: Whole
    load: Whole
    force: Array
    off: Array
    time: Array
    loads: Array
    bow: float
    repeats: float
    angles: int


@dataclass(frozen=True, slots=True)
class Found:
    """The pattern that explains most, its size, and whether that is significant."""

    pattern: Pattern
    size: float
    sure: bool


def check_patterns(evidence: Evidence) -> tuple[list[Problem], Evidence]:
    """Return the mistakes with a pattern, and the evidence without them."""
    problems: list[Problem] = []
    for _ in range(MOST_AT_ONCE):
        cells = _cells(evidence)
        found = _search(evidence, cells)
        if found is None or not found.sure:
            break
        if abs(found.size) > found.pattern.stated:
            problems.append(_named(evidence, cells, found))
        evidence = _without(evidence, cells, found)
    return problems, evidence


def _cells(evidence: Evidence) -> Averages:
    force, found, run = evidence.force, evidence.found, evidence.loads.runs()
    loads, load = np.unique(np.round(evidence.loads.applied, 3), return_inverse=True)
    keys, cell = np.unique(run * len(loads) + load, return_inverse=True)
    count = np.bincount(cell)

    def mean(columns: Array) -> Array:
        return np.column_stack([np.bincount(cell, one) / count for one in columns.T])

    off = (evidence.readings.signal - found.zero) @ found.matrix.T - force
    time = np.linspace(0.0, 1.0, len(run))[:, None]
    return Averages(
        of=(run, np.asarray(load, dtype=np.int64)),
        run=keys // len(loads),
        load=keys % len(loads),
        force=mean(force),
        off=mean(off),
        time=mean(time)[:, 0],
        loads=loads,
        bow=_half_loop(evidence, cell),
        repeats=_repeats(evidence.readings.signal, cell),
        angles=len(np.unique(evidence.loads.group)),
    )


def _repeats(signal: Array, cell: Whole) -> float:
    order = np.argsort(cell, kind="stable")
    alike = np.diff(cell[order]) == 0
    equal = (np.diff(signal[order], axis=0) == 0.0).all(axis=1)
    return float(equal[alike].mean()) if alike.any() else 0.0


def _arch(load: Array) -> Array:
    """Return the shape of a hysteresis branch: 0 at no load and the largest, 1 between."""
    share = load / max(float(load.max()), 1e-9)
    return np.asarray(4.0 * share * (1.0 - share))


def _half_loop(evidence: Evidence, cell: Whole) -> float:
    """Return half the difference of falling and rising readings at mid-range, N."""
    loads, arch = evidence.loads, _arch(evidence.loads.applied)
    up, down = (np.bincount(cell, one) for one in (loads.rising, ~loads.rising))
    both = (up > 0) & (down > 0)
    if not both.any():
        return 0.0
    rising = np.bincount(cell, loads.along * loads.rising)[both] / up[both]
    falling = np.bincount(cell, loads.along * ~loads.rising)[both] / down[both]
    shape = (np.bincount(cell, arch) / (up + down))[both]
    return 0.5 * float(shape @ (falling - rising)) / max(float(shape @ shape), 1e-9)


# --- what is looked for --------------------------------------------------------------------------


def patterns(evidence: Evidence, cells: Averages) -> Iterator[Pattern]:
    """Yield every pattern of the search."""
    found = evidence.found
    signal = cells.force @ found.sensitivity.T + found.zero
    parts = [np.outer(signal[:, axis], found.matrix[:, axis]) for axis in range(2)]
    slowly = cells.time[:, None]
    for bridges in ((0,), (1,), (0, 1)):
        change = np.sum([parts[axis] for axis in bridges], axis=0)
        yield Pattern((change * slowly).ravel(), GAIN_CHANGE, bridges, 0, steady=False)
        for place in range(1, int(cells.run.max()) + 1):
            late = (cells.run >= place)[:, None]
            yield Pattern((change * late).ravel(), GAIN_CHANGE, bridges, place)
    towards = _towards(cells) * evidence.newton_per_kg
    least = MASS_SHARE * evidence.settings.cell.full_scale / evidence.newton_per_kg
    heaviest = len(cells.loads) - 1
    held_back = evidence.settings.use.dead_zone * evidence.settings.cell.full_scale
    stated = HELD_BACK * held_back / evidence.newton_per_kg
    for place in range(1, heaviest + 1):
        more = (cells.load >= place)[:, None]
        of_all = stated if place == 1 else 0.0
        yield Pattern((towards * more).ravel(), least, (), place, stated=of_all)
        if place < heaviest:
            here = (cells.load == place)[:, None]
            yield Pattern((towards * here).ravel(), least, (), place, only=True)


def _towards(cells: Averages) -> Array:
    """Return the directions (cells, 2) of the loads, 0 without load."""
    size = np.hypot(*cells.force.T)
    return cells.force / np.maximum(size, 1e-9)[:, None] * (size > 0.0)[:, None]


def _regular_effects(evidence: Evidence, cells: Averages, terms: Terms) -> tuple[Array, Array]:
    """Return the effects of correct calibrations: columns (2 cells, any), and their sizes, N.

    Size: a standard deviation, infinite if unbounded. The last column is an arch: half
    the hysteresis loop, which the mean of rising and falling readings may hold.
    """
    force = cells.force / float(np.abs(cells.force).max())
    rows = np.column_stack((force, np.ones(len(force)), cells.time))
    much = np.full(rows.shape[1], np.inf)
    if terms.quadratic:
        rows = np.column_stack((rows, squares(force)))
    if cells.angles >= ANGLES_OF_CUBES:
        rows = np.column_stack((rows, cubes(force)))
    curved = NONLINEARITY_OF_CELL * evidence.settings.cell.full_scale
    much = np.append(much, np.full(rows.shape[1] - len(much), curved))
    both = [np.column_stack((one, 0.0 * one)) for one in rows.T]
    both += [one[:, ::-1] for one in both]
    runs = int(cells.run.max()) + 1
    known = np.concatenate((much, much, np.full(runs, np.inf), [abs(cells.bow)]))
    across = np.column_stack((-cells.force[:, 1], cells.force[:, 0]))
    both += [across * (cells.run == run)[:, None] for run in range(runs)]
    both.append(_towards(cells) * _arch(np.hypot(*cells.force.T))[:, None])
    return np.column_stack([one.ravel() for one in both]), known


# --- the search ----------------------------------------------------------------------------------


def _search(evidence: Evidence, cells: Averages) -> Found | None:
    """Return the pattern that explains most, None without a significant one.

    Outlying cells weigh less (Huber), so that a single mistake makes no pattern.
    """
    tried = list(patterns(evidence, cells))
    columns = np.column_stack([one.column for one in tried])
    least = np.array([one.least for one in tried])
    fewer = np.array([_cells_per_independent(one, cells.repeats) for one in tried])
    weights, found = np.ones(len(cells.run)), None
    for _ in range(ROUNDS):
        left, degrees = _residuals(evidence, cells, evidence.found.terms, columns, weights)
        off, shapes = left[:, 0], left[:, 1:]
        power = np.maximum(np.einsum("ij,ij->j", shapes, shapes), 1e-12)
        sizes = shapes.T @ off / power
        rest = np.maximum(off @ off - sizes**2 * power, 1e-12)
        sigmas = np.sqrt(fewer * rest / (max(degrees - 1, 1) * power))
        told = sigmas < least
        if degrees < FEWEST_DEGREES or not told.any():
            return None
        best = int(np.argmax(np.where(told, np.abs(sizes) / sigmas, 0.0)))
        free = (degrees - 1) / float(fewer[best])
        limit = -float(special.stdtrit(free, FALSE_ALARMS / 2.0 / np.count_nonzero(told)))
        size, sigma = float(sizes[best]), float(sigmas[best])
        sure = abs(size) > max(limit * sigma, tried[best].least)
        found = Found(tried[best], size, sure)
        weights = _weights(off - size * shapes[:, best], weights, evidence.noise / np.sqrt(2.0))
    return found


def _cells_per_independent(pattern: Pattern, repeats: float) -> float:
    """Return how many cells equal one independent one, by the share of repeated readings.

    A coarse display rounds a load and its opposite alike, so that fewer cells are independent
    for a load, and both bridges alike where nearly all repeat; changes between runs are blurred
    only there.
    """
    often = 1.0 + repeats**2
    return often if pattern.bridges else (1.0 + repeats) * often


def _residuals(
    evidence: Evidence, cells: Averages, terms: Terms, columns: Array, weights: Array
) -> tuple[Array, int]:
    """Return the residuals of cells and columns after the honest effects; degrees of freedom.

    The first column is of the cells; rows (2 cells and more) are weighted, the last state
    what is known of honest effects: value 0, with their size as standard deviation.
    """
    honest, much = _regular_effects(evidence, cells, terms)
    known = np.flatnonzero(np.isfinite(much))
    prior = np.zeros((len(known), honest.shape[1]))
    prior[np.arange(len(known)), known] = evidence.noise / np.maximum(
        much[known], 0.1 * evidence.noise
    )
    root = np.append(np.repeat(np.sqrt(weights), 2), np.ones(len(known)))[:, None]
    rows = np.vstack((honest, prior)) * root
    # An effect that these cells cannot have is a column of zeros, and of no size.
    lengths = np.maximum(np.linalg.norm(rows, axis=0), 1e-300)
    basis, size, _ = np.linalg.svd(rows / lengths, full_matrices=False)
    basis = basis[:, size > 1e-7]
    both = np.column_stack((cells.off.ravel(), columns))
    both = np.vstack((both, np.zeros((len(known), both.shape[1])))) * root
    return both - basis @ (basis.T @ both), int(2.0 * weights.sum()) - basis.shape[1]


def _weights(rest: Array, weights: Array, noise: float) -> Array:
    """Return Huber's weights of the cells from their weighted residuals.

    noise: lower bound of the standard deviation, N: else cells that contradict a pattern would
    be discarded in its favour.
    """
    length = np.hypot(*rest[: 2 * len(weights)].reshape(-1, 2).T) / np.sqrt(weights)
    scale = max(noise, float(np.median(length)) / RAYLEIGH_MEDIAN)
    return np.clip(HUBER * scale / np.maximum(length, 1e-300), 1e-3, 1.0)


# --- in words ------------------------------------------------------------------------------------


def _named(evidence: Evidence, cells: Averages, found: Found) -> Problem:
    pattern, size = found.pattern, found.size
    if pattern.bridges:
        who = say("signal_{} reads", pattern.bridges[0] + 1)
        if len(pattern.bridges) == 2:
            who = say("both signals read")
        first = int(np.flatnonzero(cells.of[0] == pattern.place)[0])
        since = (
            say("From {} on", place_of(evidence.readings, first))
            if pattern.steady
            else say("Slowly")
        )
        return refusal(
            "gain_changed",
            (
                "{}: {} {:.1f} % {} of the same load than before: the gain changed (range,"
                " excitation, filter or cable?). Find the cause, and take all series again."
            ),
            since,
            who,
            abs(100.0 * size),
            say("more") if size > 0.0 else say("less"),
        )
    words = say(
        "{:.2f} kg {} than written", abs(size), say("heavier") if size > 0.0 else say("lighter")
    )
    mass = float(cells.loads[pattern.place]) / evidence.newton_per_kg
    if pattern.place == 1 and not pattern.only:
        return _of_every_load(evidence, size, words)
    which = (
        say("At {:.3g} kg the load", mass)
        if pattern.only
        else say("From {:.3g} kg on every load", mass)
    )
    return refusal(
        "wrong_piece",
        "{} seems {}, at every pin angle: weigh the piece that joins there.",
        which,
        words,
    )


def _of_every_load(evidence: Evidence, size: float, words: str) -> Problem:
    """Return the problem of a mass (kg) common to all loads.

    A dead zone, and a hanger counted but not hung, give the same readings: they are
    distinguished by the size and by the stated hanger.
    """
    hanger = evidence.settings.weights.hanger_mass
    share = -size * evidence.newton_per_kg / evidence.settings.cell.full_scale
    if share < 0.0:
        heavier = say(
            "Every load seems {}, while the zeros are right: check hanger_mass_kg and the first"
            " piece.",
            words,
        )
        return Problem("hanger_mass", heavier)
    itself = hanger > 0.0 and abs(size + hanger) < LIKE_THE_HANGER * hanger
    return refusal(
        "hanger_mass" if itself or share > FRICTION else "dead_zone",
        "Every load seems {}, while the zeros are right: a dead zone (friction or slack at the"
        " hanger), or a hanger or first piece that is not as written. Weigh both; if they are"
        " right, free the hanger or state [use] dead_zone_percent = {:.2g}.",
        words,
        100.0 * share,
    )


def _without(evidence: Evidence, cells: Averages, found: Found) -> Evidence:
    """Return the evidence with the mistake removed."""
    readings, pattern = evidence.readings, found.pattern
    run, load = cells.of
    if not pattern.bridges:
        there = load == pattern.place if pattern.only else load >= pattern.place
        mass = readings.mass + np.where(there, found.size, 0.0)
        return examine(replace(readings, mass=mass), evidence.settings)
    share = run >= pattern.place if pattern.steady else np.linspace(0.0, 1.0, len(run))
    gain = np.ones_like(readings.signal)
    gain[:, list(pattern.bridges)] += found.size * share[:, None]
    return examine(replace(readings, signal=readings.signal / gain), evidence.settings)
