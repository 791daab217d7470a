"""Screening of disturbances: kinds of noise, periods of a swing, steps, by their evidence.

All are compared at once on the bins, linearised about the best constant coefficient, with and
without a change; the relevant ones are then computed exactly.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp_model.identification.colour import covariance
from rigapp_model.identification.evidence import swept
from rigapp_model.identification.noise import (
    DepthBins,
    Kinds,
    Noise,
    covariance_of,
    noise_of,
    possible_kinds,
)
from rigapp_model.identification.posterior import IdentificationInputs
from rigapp_model.identification.shapes import (
    COLUMNS,
    HEAT,
    NO_PERIOD,
    NO_STEPS,
    STEP,
    SWING,
    WITHIN,
    shapes,
)
from rigapp_model.identification.statements import Hypotheses, Statement

Array = NDArray[np.float64]

SHORTEST, LONGEST, BEYOND, RATIO = 500.0, 5.0, 8.0, 1.3
"""Periods compared: shortest, revolutions; longest, days and multiples of the test; ratio of
consecutive ones."""
DAILY = 0.75
"""Prior share of a period of one day among the slow swings: that of rooms."""
WARMED = 0.1
"""Share of swings with another cause than a known temperature."""
STEP_SHARE = 0.1
"""Prior probability of a step, uniform over the revolutions."""
STEP_ODDS = float(np.log(100.0))
"""Log odds above which a step counts as present, else as possible."""
MOST_STEPS = 3
PARTS = 2
"""Positions of a change per bin."""
NEVER = 1e12
"""Precision of ln r without a change."""
MOST_KINDS, COUNTS = 10, 6.0
"""Largest number of kinds of noise used, and log of their ratio to the most probable; also used is
the best one of each period with LEAST_SHARE of the weight."""
LEAST_SHARE = 0.02


def periods(last: float, day: float) -> Array:
    """Return the periods compared after ``last`` revolutions: none (0), a day, and others."""
    longest = max(min(LONGEST * day, BEYOND * last), SHORTEST)
    count = int(np.ceil(np.log(longest / SHORTEST) / np.log(RATIO))) + 1
    return np.concatenate([[NO_PERIOD, day], np.geomspace(SHORTEST, longest, count)])


def likely_noise(inputs: IdentificationInputs, constant: Statement, change: Statement) -> Noise:
    """Return the relevant kinds of noise, the most probable first, with detected steps."""
    readings = inputs.readings
    errors = inputs.errors
    swing = periods(float(readings.revolution[-1]), errors.day)
    base, by_spread = possible_kinds(readings, errors.drift, swing)
    share = (readings.revolution - readings.begin) / readings.revolution[-1]
    share[0] = 0.0  # the zero is taken in this bin
    others = np.full(swing.size - 2, (1.0 - DAILY) / (swing.size - 2))
    swing_probability = WARMED * errors.swing if readings.warm_zero is not None else errors.swing
    swings = swing_probability * np.append(DAILY, others)
    prior = np.concatenate(
        [(1.0 - STEP_SHARE) * np.append(1.0 - swing_probability, swings), STEP_SHARE * share]
    )
    with np.errstate(divide="ignore"):
        log_weight = np.log(prior) + np.concatenate(
            [by_spread, np.repeat(by_spread[:, :1], share.size, axis=1)], axis=1
        )
    period = np.append(swing, np.zeros(share.size))
    each = np.column_stack([readings.begin, readings.revolution])
    jump = np.concatenate([np.zeros((swing.size, 2)), each])
    linear = _linearised(inputs, constant, change)
    steps = NO_STEPS
    while True:
        compared = _log_evidence(readings, base, log_weight, swing, linear, steps)
        step = _step_bin(compared, readings) if len(steps) < MOST_STEPS else NO_STEPS
        if not step.size:
            kinds = _relevant_kinds(compared, base, log_weight, period, jump)
            return noise_of(readings, kinds, steps)
        steps = np.concatenate([steps, step])


@dataclass(frozen=True, slots=True, eq=False)
class _Linear:
    """Linearised bins.

    columns (4 + PARTS (n - 1), n): of ln K, e, b, a, and of ln r for each position of a change;
    misfit (n,); precision (2, 6, 6), off (2, 6): of ln K, e, b, a and ln r at two neighbouring
    positions, whose combination is a change between them; without a change, and with one.
    """

    columns: Array
    misfit: Array
    precision: Array
    off: Array


def _linearised(inputs: IdentificationInputs, constant: Statement, change: Statement) -> _Linear:
    """Linearise about the best constant coefficient."""
    start = inputs.best_constant(constant)
    by, half = inputs.readings.progress[1:, None], inputs.readings.half[1:, None]
    change_at = (by - half + 2.0 * half * np.arange(PARTS) / PARTS).ravel()
    same = np.full(change_at.size, start)
    depth, slopes = inputs.depth(Hypotheses(change, same, np.zeros(change_at.size), change_at))
    columns = np.concatenate([slopes[0, :1], inputs.linear(depth[:1])[0], slopes[1]])
    off = np.zeros((2, 6))
    off[:, 0] = inputs.log_median - start
    precision = np.tile(np.eye(6), (2, 1, 1))
    precision[0, 0, 0], precision[0, 4, 4] = inputs.prior.spread**-2, NEVER
    precision[0, 5, 5] = NEVER
    precision[1][np.ix_([0, 4], [0, 4])] = change.precision(inputs.prior)
    precision[1, 5, 5] = change.spread**-2
    return _Linear(columns, inputs.readings.depth - depth[0], precision, off)


def _log_evidence(
    readings: DepthBins, base: Kinds, log_weight: Array, swing: Array, linear: _Linear, steps: Array
) -> Array:
    """Compare kinds of noise with a swing or a step, in addition to known steps.

    Returns their log evidence plus log prior (2, J, T + n): without a change and with the most
    probable one, J kinds of noise, T periods, a step in one of n bins. Each swing and step is two
    more columns, with evidence in closed form.
    """
    end, at, none = readings.revolution, readings.moments, np.zeros(1)
    nothing = np.zeros((base.size.size, 2))
    always = shapes(nothing[:, 0], nothing, base.creeps, steps, at)
    lower = np.linalg.cholesky(covariance_of(readings, base) + always.swapaxes(1, 2) @ always)
    log_determinant = 2.0 * np.log(np.diagonal(lower, axis1=1, axis2=2)).sum(axis=1)
    nowhere = np.zeros((swing.size - 1, 2))
    sines = shapes(swing[1:], nowhere, nowhere[:, 0], NO_STEPS, at)[:, 1:HEAT]
    sines = sines.reshape(-1, end.size)
    jumps = shapes(none, nowhere[:1], none, np.column_stack([at.begin, end]), at)[0, COLUMNS:]
    rows = np.concatenate([linear.columns, linear.misfit[None], sines, jumps])
    along = np.linalg.inv(lower) @ rows.T
    k = len(linear.columns)
    first, second = along[:, :, k + 1 :: 2], along[:, :, k + 2 :: 2]
    weight = log_weight[:, :1] - 0.5 * log_determinant[:, None]
    likely = min(_likely_change(linear, along[:, :, : k + 1], weight), k - 2)
    selected = [0, 1, 2, 3, likely, likely + 1, k]
    gram = along[:, :, selected].swapaxes(1, 2) @ along[:, :, [*selected, *range(k + 1, len(rows))]]
    known, cross = gram[:, :, :7], gram[:, :, 7:]
    pull = (linear.precision @ linear.off[..., None])[..., 0]
    matrix = known[:, None, :6, :6] + linear.precision
    right = known[:, None, :6, 6] + pull
    inverse, step, determinant = swept(matrix, right)
    plain = -0.5 * (
        known[:, 6, 6][:, None]
        + (linear.off * pull).sum(axis=1)
        - (right * step).sum(axis=2)
        + determinant
        - np.linalg.slogdet(linear.precision)[1]
        + log_determinant[:, None]
    )
    over = cross[:, None, :6]
    by = inverse @ over
    toward = cross[:, None, 6] - (step[:, :, None] @ over)[:, :, 0]
    u, v = toward[:, :, 0::2], toward[:, :, 1::2]
    by_first, by_second = over[:, :, :, 0::2], over[:, :, :, 1::2]

    def product(a: Array, b: Array) -> Array:
        return np.asarray((a * b).sum(axis=1)[:, None])

    def explained(a: Array, b: Array) -> Array:
        return np.asarray((a * b).sum(axis=2))

    aa = 1.0 + product(first, first) - explained(by_first, by[:, :, :, 0::2])
    ab = product(first, second) - explained(by_first, by[:, :, :, 1::2])
    bb = 1.0 + product(second, second) - explained(by_second, by[:, :, :, 1::2])
    area = aa * bb - ab**2
    gain = 0.5 * ((bb * u**2 - 2.0 * ab * u * v + aa * v**2) / area - np.log(area))
    evidence = plain.T[:, :, None] + log_weight
    evidence[:, :, 1:] += gain.swapaxes(0, 1)
    return np.asarray(evidence)


def _likely_change(linear: _Linear, along: Array, weight: Array) -> int:
    """Return the column index of the most probable change without swing and step.

    along (J, n, M + 1): whitened columns and misfit; weight (J, 1): log weight.
    """
    low = along[:, :, [0, 1, 2, 3, -1]].swapaxes(1, 2) @ along
    matrix, over, toward = low[:, None, :4, :4], low[:, :4, 4:-1], low[:, 4, 4:-1]
    pull = linear.precision[0, :4, :4] @ linear.off[0, :4]
    inverse, step, determinant = swept(
        matrix + linear.precision[0, :4, :4], low[:, None, :4, -1] + pull
    )
    right = low[:, :4, -1] + pull
    plain = 0.5 * ((right * step[:, 0]).sum(axis=1) - low[:, 4, -1] - determinant[:, 0])
    toward = toward - (step @ over)[:, 0]
    size = 1.0 + np.square(along[:, :, 4:-1]).sum(axis=1)
    size -= (over * (inverse[:, 0] @ over)).sum(axis=1)
    gain = 0.5 * (toward**2 / size - np.log(size))
    return 4 + int(np.argmax((plain[:, None] + weight + gain).max(axis=0)))


def _step_bin(compared: Array, readings: DepthBins) -> Array:
    """Return the bin with a step (1, 2), or none (0, 2)."""
    n = readings.revolution.size
    without = np.logaddexp.reduce(compared[:, :, :-n], axis=(1, 2)).max()
    each = np.logaddexp.reduce(compared[:, :, -n:], axis=1)
    if np.logaddexp.reduce(each, axis=1).max() - without < STEP_ODDS:
        return NO_STEPS
    at = int(np.argmax(each.max(axis=0)))
    return np.array([[readings.begin[at], readings.revolution[at]]])


def _relevant_kinds(
    compared: Array, base: Kinds, log_weight: Array, period: Array, jump: Array
) -> Kinds:
    """Return the relevant kinds, the most probable first; each swing and step keeps its weight.

    period (T + n,), jump (T + n, 2): of the swings and steps compared.
    """
    total = np.logaddexp.reduce(compared, axis=(1, 2))
    relative = compared - total[:, None, None]
    score = relative.max(axis=0)
    order = np.argsort(-score, axis=None)[:MOST_KINDS]
    selected = {
        (int(j), int(t)) for j, t in zip(*np.unravel_index(order, score.shape), strict=True)
    }
    selected = {pair for pair in selected if score[pair] > score.max() - COUNTS}
    of_shape = np.logaddexp.reduce(relative, axis=1)
    for t in np.flatnonzero((of_shape > np.log(LEAST_SHARE)).any(axis=0)):
        selected.add((int(np.argmax(score[:, t])), int(t)))
    kind, shape = np.array(sorted(selected, key=lambda pair: -score[pair])).T
    best = relative[int(np.argmax(total))]
    left_out = [
        np.logaddexp.reduce(best[:, t]) - np.logaddexp.reduce(best[kind[shape == t], t])
        for t in shape
    ]
    return replace(
        base.at(kind),
        period=period[shape],
        jump=jump[shape],
        log_prior=log_weight[kind, shape] + left_out,
    )


# The cause of unexpected fine bins: a change of wear, a step, or an undetected swing.
#
# Each increases a sum of innovations. So the bins since the rise are compared with the prediction
# before it: the differences are a ramp from some bin on for a change of wear, and a constant from
# some bin on if a probe was touched. They may also be part of a slow swing, of which too few
# periods have passed. All amplitudes have normal priors, so that the evidence of each is in closed
# form, including all earlier uncertainty.

MOST = 64
"""Largest number of stored bins; beyond it, every second one is dropped."""
CHANGE = 1.0
"""Standard deviation of the relative change of K: a third of changes exceeds a factor of 2."""
ODDS = float(np.log(20.0))
"""Log odds above which a change of wear or a step is reported."""

KNOWN_AFTER = 2.5
"""Periods after which a swing would be detected in the bins."""
UNSEEN_SWING = 0.35
"""Prior probability of a swing of each period; more delays the report of an early change."""


@dataclass(slots=True)
class Excursion:
    """Bins since a sum was last 0, and the posterior at that time; of fixed size.

    mean, covariance: of all states at that time; bins: for each its first and last revolution,
    progress, difference to the prediction of that time (m), slope by ln K (m), variance of its
    scatter (m^2), and slopes by all states; stride: every stride-th bin is stored; seen: bins
    added.
    """

    mean: Array | None = None
    covariance: Array | None = None
    bins: list[list[float]] = field(default_factory=list)
    stride: int = 1
    seen: int = 0

    def begin(self, mean: Array, covariance: Array) -> None:
        """Restart with the present posterior."""
        self.mean, self.covariance = mean.copy(), covariance.copy()
        self.bins, self.stride, self.seen = [], 1, 0

    def add(self, closed: list[float]) -> None:
        """Add a bin."""
        self.seen += 1
        if self.seen % self.stride:
            return
        self.bins.append(closed)
        if len(self.bins) > MOST:
            self.bins, self.stride = self.bins[1::2], 2 * self.stride

    def odds(
        self, drift: float, size: float, length: float, wander: float, swings: float = UNSEEN_SWING
    ) -> tuple[float, float, float]:
        """Return the log odds of a change of wear and of a step, each against all others.

        Also the first revolution of the more probable one of the two. drift, size, length: of the
        noise, see ``Kinds``; wander: of a swing, m^2 per revolution; swings: prior probability of a
        swing of each period.
        """
        assert self.covariance is not None
        table = np.array(self.bins)
        first, last, progress, off, slope, scatter = table[:, :6].T
        rows = table[:, 6:]
        n = off.size
        middle = np.log(np.maximum(0.5 * (first + last), 1.0))
        walk = drift**2 * (np.minimum(middle[:, None], middle) - middle[0])
        walk += wander * (np.minimum(last[:, None], last) - first[0] + 1.0)
        noise = covariance(np.array([size]), np.array([length]), first - 1.0, last)[0]
        known = rows @ self.covariance @ rows.T
        lower = np.linalg.cholesky(np.diag(scatter) + walk + noise + known)
        start = np.append(progress[0] - (progress[-1] - progress[0]) / n, progress[:-1])
        ramps = CHANGE * slope * np.maximum(1.0 - start[:, None] / progress, 0.0)
        at = np.arange(n)
        after = STEP * (np.where(at == at[:, None], 0.5, at > at[:, None]))
        inside = STEP * WITHIN * np.eye(n)
        columns = np.concatenate([ramps, after, inside, off[None]])
        white = np.linalg.solve(lower, columns.T).T
        misfit = white[-1]
        ramp, after, inside = white[:n], white[n : 2 * n], white[2 * n : -1]
        size_of = 1.0 + (ramp**2).sum(axis=1)
        wear = 0.5 * ((ramp @ misfit) ** 2 / size_of - np.log(size_of))
        aa, bb = 1.0 + (after**2).sum(axis=1), 1.0 + (inside**2).sum(axis=1)
        ab, u, v = (after * inside).sum(axis=1), after @ misfit, inside @ misfit
        area = aa * bb - ab**2
        step = 0.5 * ((bb * u**2 - 2.0 * ab * u * v + aa * v**2) / area - np.log(area))
        by_wear, by_step = (float(np.logaddexp.reduce(x) - np.log(n)) for x in (wear, step))
        by_chance = float(
            np.logaddexp(_swing_evidence(lower, misfit, first, last) + np.log(swings), 0.0)
        )
        since = first[int(np.argmax(wear if by_wear > by_step else step))]
        return (
            by_wear - float(np.logaddexp(by_step, by_chance)),
            by_step - float(np.logaddexp(by_wear, by_chance)),
            float(since),
        )

    def numbers(self) -> dict[str, Any]:
        """Return the state as plain numbers, for a checkpoint."""
        return {
            "mean": None if self.mean is None else self.mean.tolist(),
            "covariance": None if self.covariance is None else self.covariance.tolist(),
            "bins": [list(row) for row in self.bins],
            "stride": self.stride,
            "seen": self.seen,
        }


def _swing_evidence(lower: Array, misfit: Array, first: Array, last: Array) -> float:
    """Return the log evidence of a swing of which too few periods have passed.

    lower (n, n): Cholesky factor of the covariance of bins; misfit (n,): whitened differences.
    """
    count = int(np.ceil(np.log(max(BEYOND * last[-1] / SHORTEST, RATIO)) / np.log(RATIO)))
    periods = SHORTEST * RATIO ** np.arange(count + 1)
    undetected = periods[periods * KNOWN_AFTER > first[0]]
    if not undetected.size:
        return -np.inf
    turn = 2.0 * np.pi / undetected[:, None]
    middle, began = 0.5 * (first + last), first[0]
    attenuation = np.sinc((last - first) / undetected[:, None])
    sine = SWING * attenuation * np.sin(turn * (middle - began))
    cosine = SWING * (attenuation * np.cos(turn * (middle - began)) - 1.0)
    sine, cosine = (np.linalg.solve(lower, part.T).T for part in (sine, cosine))
    aa, bb = 1.0 + (sine**2).sum(axis=1), 1.0 + (cosine**2).sum(axis=1)
    ab, u, v = (sine * cosine).sum(axis=1), sine @ misfit, cosine @ misfit
    area = aa * bb - ab**2
    each = 0.5 * ((bb * u**2 - 2.0 * ab * u * v + aa * v**2) / area - np.log(area))
    return float(np.logaddexp.reduce(each))


def excursion_of(numbers: Mapping[str, Any]) -> Excursion:
    """Restore an excursion from its ``numbers``."""
    mean, covariance_then = numbers["mean"], numbers["covariance"]
    return Excursion(
        None if mean is None else np.array(mean),
        None if covariance_then is None else np.array(covariance_then),
        [list(row) for row in numbers["bins"]],
        numbers["stride"],
        numbers["seen"],
    )
