"""Detection of a change of wear: new readings compared with their prediction.

Readings are averaged in fine bins, 0.25 % of the revolutions long. Each is compared with its
prediction from earlier bins; the normalised innovation is standard normal while the statement
holds. Two cumulative sums (E. S. Page, Biometrika 41 (1954) 100-115), for faster and for slower
wear, report an event above a threshold that follows from the false alarm rate (D. Siegmund,
Sequential Analysis, 1985, Eq. 2.56). A step of the readings has the same effect as a change of
wear: ``Excursion`` distinguishes them. After a step the level is uncertain again.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp_model.identification.bins import Bin, Bins, bins_of
from rigapp_model.identification.inference import Identification, Verdict
from rigapp_model.identification.life import DepthLife
from rigapp_model.identification.posterior import Nodes
from rigapp_model.identification.screening import (
    ODDS,
    UNSEEN_SWING,
    WARMED,
    Excursion,
    excursion_of,
)
from rigapp_model.identification.shapes import COLUMNS, CREEP, HEAT, STEP, SWING, WARMTH
from rigapp_model.identification.statements import CHANGE, STATEMENTS, Hypotheses

Array = NDArray[np.float64]

FINE = 920
"""Fine bins per decade, each 0.25 % of the revolutions: three with the largest innovation raise the
alarm, and a bushing that wears 5 um in 1,000 revolutions wears 0.1 um in each at 10,000."""
FALSE_ALARM = 0.0015
"""Probability of a false alarm per decade of revolutions: 0.005 in the first 21,377."""
REFERENCE = 0.75
"""Decrement of a sum per innovation: half of the shift that it detects fastest, 1.5 sigma, the
effect of 1.5 K on a fine bin at 10,000 revolutions with a scatter of 0.4 um."""
LARGEST = 4.0
"""Limit of an innovation, so that one faulty bin raises no alarm."""
FREE_FOR = 0.25
"""Revolutions with an uncertain level after a step, relative to its revolution: until a bin sets
it."""
PERIOD_DOUBT = 0.1
"""Relative uncertainty of a swing's period; the periods compared have a ratio of 1.3."""
EARLY, EARLY_ODDS = 0.8, float(np.log(300.0))
"""Fraction of the threshold from which a change of wear with these log odds is reported."""
SURE = 0.95
"""Probability of a change from which it is the reference; a less probable one may be a swing."""
STEP_LASTS = 2.0
"""Factor of a step's revolution until which bins cannot distinguish it from a change of K."""
OVERSHOOT = 1.166
"""Mean overshoot of a sum of normal steps above a threshold (Siegmund), in sigma."""
STATES, LEVEL, NOISE = 11, 5, 6
SWINGS = (8, 9)
"""Number of states of the prediction; indices of the level, the correlated noise, the swing."""
WIDEST = 0.2
"""Largest standard deviation of ln K with predictions: depth is linear in it to 1 % within this."""


def threshold(false_alarm: float = FALSE_ALARM) -> float:
    """Return the threshold of a sum for a probability of a false alarm per decade of revolutions.

    The mean number of bins between false alarms is (exp(x) - x - 1) / (2 k^2) with
    x = 2 k (threshold + overshoot) and the decrement k.
    """
    bins_between = 2.0 * REFERENCE**2 * 2.0 * FINE / false_alarm  # each of two sums
    x = float(np.log(bins_between))
    for _ in range(20):
        x = float(np.log(bins_between + x + 1.0))
    return x / (2.0 * REFERENCE) - OVERSHOOT


THRESHOLD = threshold()


@dataclass(frozen=True, slots=True)
class Departure:
    """Change of the joint's wear.

    revolution: of the report; since: start of the rise of the sum; faster: else slower.
    """

    revolution: float
    since: float
    faster: bool


@dataclass(slots=True)
class Consistency:
    """Sequential comparison of readings with their prediction; its state has a fixed size.

    mean (11,), covariance (11, 11): current, of ln K/K0, ln r, e / u_e, b / u_b, the modulus, the
    level (drift and steps, m), the correlated noise, m, creep, a swing's value and that a quarter
    of its period later, m, and the effect of a kelvin; None before ``renew``.
    scales: u_e, u_b, strength of the drift, scatter, size and length of the correlated noise, and
    the swing's period; ended: revolution of the state, anchor: of the swing; warm_zero: reference
    of temperatures, degC, None if unknown.
    sums: for faster and slower wear; since: last revolution at which each was 0; rising: bins since
    then, for each; stepped: revolution of the last step, 0 for none; departure: the first one
    reported, until ``acknowledged``.
    """

    bins: Bins = field(default_factory=lambda: Bins(FINE))
    statement: str = ""
    transition: float = 1.0
    mean: Array | None = None
    covariance: Array | None = None
    walked: float = 0.0
    scales: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0, 0.0, 1.0, np.inf)
    ended: float = 0.0
    anchor: float = 0.0
    warm_zero: float | None = None
    sums: tuple[float, float] = (0.0, 0.0)
    since: tuple[float, float] = (0.0, 0.0)
    rising: tuple[Excursion, Excursion] = field(default_factory=lambda: (Excursion(), Excursion()))
    stepped: float = 0.0
    innovation: float = float("nan")
    departure: Departure | None = None

    @property
    def score(self) -> float:
        """Return the larger sum over its threshold: 1 is the alarm; NaN before ``renew``."""
        return max(self.sums) / THRESHOLD if self.mean is not None else float("nan")

    def renew(self, known: Identification) -> None:
        """Replace the posterior by that of all closed bins; a new swing resets the sums."""
        best = self._reference_verdict(known)
        nodes = best.nodes
        if nodes.log_moments[1] > WIDEST:
            return
        transitions = nodes.hypotheses.transition
        likely = transitions == transitions[int(np.argmax(nodes.weight))]
        nodes = nodes.at(np.flatnonzero(likely))
        period = _period(nodes)
        onward = _states(nodes, known.revolution, period)
        inner = np.zeros((nodes.weight.size, STATES, STATES))
        inner[:, 0, 0] = nodes.breadth**2 / 12.0
        inner[:, 1:LEVEL, 1:LEVEL] = nodes.covariance
        across = -nodes.covariance @ nodes.pulled.swapaxes(1, 2) @ onward.swapaxes(1, 2)
        inner[:, 1:LEVEL, LEVEL:], inner[:, LEVEL:, 1:LEVEL] = across, across.swapaxes(1, 2)
        pulled = onward @ nodes.pulled
        inner[:, LEVEL:, LEVEL:] = onward @ nodes.spare @ onward.swapaxes(1, 2) - pulled @ across
        left = (onward @ nodes.left[..., None])[..., 0]
        at = nodes.hypotheses
        centre = np.column_stack([at.log_coefficient, nodes.log_ratio, nodes.mean[:, 1:], left])
        mean = nodes.weight @ centre
        deviations = centre - mean
        self.mean = mean
        self.covariance = np.tensordot(
            nodes.weight, inner + deviations[:, :, None] * deviations[:, None, :], axes=1
        )
        phase_error = min(2.0 * np.pi * PERIOD_DOUBT * known.revolution / period, 1.0)
        for swing in SWINGS:
            self.covariance[swing, swing] += (phase_error * SWING) ** 2 * self._swing()
        swings = float(nodes.weight @ (nodes.kinds.period > 0.0))
        if swings > SURE and period != self.scales[-1]:
            # A newly detected swing explains the rise of a sum.
            self.sums, self.since = (0.0, 0.0), (known.revolution, known.revolution)
        self.statement, self.transition = best.name, float(nodes.hypotheses.transition[0])
        self.walked = float(known.readings.walked[-1])
        self.scales = (
            known.sensitivity,
            known.errors.reference,
            known.drift,
            *_noise(nodes),
            period,
        )
        self.ended = self.anchor = known.revolution
        self.warm_zero = known.readings.warm_zero
        if 0.0 < known.revolution - self.stepped < FREE_FOR * self.stepped:
            self.covariance[LEVEL, LEVEL] += STEP**2

    def _reference_verdict(self, known: Identification) -> Verdict:
        """Return the most probable statement, without an uncertain change.

        Also without a change soon after a reported step, which has the same effect.
        """
        if known.best.weight < SURE or known.revolution < STEP_LASTS * self.stepped:
            return next(verdict for verdict in known.verdicts if verdict.name != CHANGE)
        return known.best

    def add(
        self,
        revolution: float,
        progress: float,
        depth: float,
        life: DepthLife,
        warm: float = float("nan"),
    ) -> Departure | None:
        """Add a reading; return a departure if it is detected.

        revolution, progress (nominal cycles), depth (m), warm (degC): as for ``Bins.add``.
        """
        closed = self.bins.add(revolution, progress, depth, warm)
        if closed is None:
            return None
        self.bins.closed.clear()
        return self.judge(closed, life)

    def judge(self, closed: Bin, life: DepthLife) -> Departure | None:
        """Compare a fine bin with its prediction; return a departure if it is detected."""
        if self.mean is None or self.covariance is None:
            return None
        sensitivity, reference, drift, scatter, size, length, period = self.scales
        middle = closed.revolution * closed.progress / max(closed.last, 1e-300)
        walked = float(np.log(max(middle, 1.0)))
        self.covariance[LEVEL, LEVEL] += drift**2 * max(walked - self.walked, 0.0)
        self.walked = max(walked, self.walked)
        for swing in SWINGS:
            self.covariance[swing, swing] += (
                self._swing() * _wander(period) * max(closed.revolution - self.ended, 0.0)
            )
        self._propagate_noise(closed.revolution - closed.count, size, length)
        statement = next(named for named in STATEMENTS if named.name == self.statement)
        for sum_so_far, rising in zip(self.sums, self.rising, strict=True):
            if not sum_so_far or rising.mean is None:
                rising.begin(self.mean, self.covariance)
        x = self.mean
        at = Hypotheses(statement, x[:1], x[1:2], np.array([self.transition]))
        half = np.array([0.5 * (closed.last - closed.first)])
        depth, slopes = life.depth(np.array([closed.progress]), at.scaled(half))
        expected = float(depth[0, 0])
        # The noise at the bin's beginning is a state; its mean over the bin has an additional part,
        # which is correlated with the noise at the end.
        turn = (middle - self.anchor) / period
        attenuation = float(np.sinc(closed.count / period))
        wide = closed.count / length
        decay = float(np.exp(-wide))
        share = (1.0 - decay) / wide
        row = np.array(
            [
                slopes[0, 0, 0],
                slopes[1, 0, 0],
                sensitivity * expected,
                reference,
                float(life.elastic_doubt(np.array([expected]))[0]),
                1.0,
                share,
                CREEP * walked,
                attenuation * float(np.cos(2.0 * np.pi * turn)),
                attenuation * float(np.sin(2.0 * np.pi * turn)),
                WARMTH * self._relative_temperature(closed),
            ]
        )
        fresh = size**2 * (2.0 / wide * (1.0 - share) - share**2)
        onward = np.ones(STATES)
        onward[NOISE] = decay
        gain = onward * (self.covariance @ row)
        gain[NOISE] += size**2 * share * (1.0 - decay)
        variance = float(row @ self.covariance @ row) + fresh + scatter**2 / closed.count
        residual = closed.depth - expected - float(row[2:] @ x[2:])
        without = row.copy()
        without[NOISE] = 0.0
        for rising in self.rising:
            assert rising.mean is not None
            # Prediction of that time with the present slopes: later information is removed.
            moved = float(without @ (x - rising.mean)) + row[NOISE] * x[NOISE]
            own = scatter**2 / closed.count
            edges = [closed.revolution - closed.count + 1.0, closed.revolution, closed.progress]
            rising.add([*edges, float(residual + moved), float(row[0]), own, *without.tolist()])
        deviation = float(np.sqrt(variance))
        self.innovation = residual / deviation
        counted = float(np.clip(self.innovation, -LARGEST, LARGEST))
        self.mean = onward * x + gain * (counted / deviation)
        self.covariance = onward[:, None] * self.covariance * onward
        self.covariance[NOISE, NOISE] += size**2 * (1.0 - decay**2)
        self.covariance = self.covariance - np.outer(gain, gain) / variance
        self.ended = closed.revolution
        return self._update_sums(closed.revolution)

    def _relative_temperature(self, closed: Bin) -> float:
        """Return the temperature of a bin relative to the first one, K, 0 if unknown."""
        if closed.warm is None or self.warm_zero is None:
            return 0.0
        return closed.warm - self.warm_zero

    def _swing(self) -> float:
        """Return the present swing's mean square over that of a usual one, 0 to 1."""
        assert self.mean is not None
        assert self.covariance is not None
        size = sum(float(self.mean[index] ** 2 + self.covariance[index, index]) for index in SWINGS)
        return min(size / SWING**2, 1.0)

    def _propagate_noise(self, revolution: float, size: float, length: float) -> None:
        """Propagate the correlated noise to a revolution over missing readings."""
        assert self.mean is not None
        assert self.covariance is not None
        decay = float(np.exp(-max(revolution - self.ended, 0.0) / length))
        onward = np.ones(STATES)
        onward[NOISE] = decay
        self.mean = onward * self.mean
        self.covariance = onward[:, None] * self.covariance * onward
        self.covariance[NOISE, NOISE] += size**2 * (1.0 - decay**2)

    def _update_sums(self, revolution: float) -> Departure | None:
        """Add the last innovation to both sums; return a departure if it is detected."""
        step = float(np.clip(self.innovation, -LARGEST, LARGEST))
        up = max(self.sums[0] + step - REFERENCE, 0.0)
        down = max(self.sums[1] - step - REFERENCE, 0.0)
        self.since = (
            self.since[0] if up > 0.0 else revolution,
            self.since[1] if down > 0.0 else revolution,
        )
        self.sums = (up, down)
        if max(up, down) < EARLY * THRESHOLD or self.departure is not None:
            return None
        faster = up > down
        _, _, drift, _, size, length, period = self.scales
        wander = self._swing() * _wander(period)
        swings = UNSEEN_SWING * (1.0 if self.warm_zero is None else WARMED)
        wear, step, since = self.rising[not faster].odds(drift, size, length, wander, swings)
        if wear > (ODDS if max(up, down) >= THRESHOLD else EARLY_ODDS):
            self.departure = Departure(revolution, since, faster)
            return self.departure
        if step > ODDS and max(up, down) >= THRESHOLD:
            assert self.covariance is not None
            self.covariance[LEVEL, LEVEL] += STEP**2
            self.stepped, self.sums, self.since = since, (0.0, 0.0), (revolution, revolution)
        return None

    def acknowledged(self) -> None:
        """Reset the sums and the departure; later readings are compared with the new posterior."""
        self.sums, self.departure = (0.0, 0.0), None

    def numbers(self) -> dict[str, Any]:
        """Return the state as plain numbers, for a checkpoint."""
        return {
            "bins": self.bins.numbers(),
            "statement": self.statement,
            "place": self.transition,
            "mean": None if self.mean is None else self.mean.tolist(),
            "covariance": None if self.covariance is None else self.covariance.tolist(),
            "walked": self.walked,
            "ended": self.ended,
            "anchor": self.anchor,
            "warm_zero": self.warm_zero,
            "scales": list(self.scales),
            "sums": list(self.sums),
            "since": list(self.since),
            "rising": [excursion.numbers() for excursion in self.rising],
            "stepped": self.stepped,
            "innovation": self.innovation,
            "departure": None if self.departure is None else asdict(self.departure),
        }


def _wander(period: float) -> float:
    """Return the random walk of value and slope of a swing, m^2 per revolution.

    The uncertainty PERIOD_DOUBT of its period is a phase error after a quarter of it.
    """
    return float((SWING * 0.5 * np.pi * PERIOD_DOUBT) ** 2 * 4.0 / period)


def _noise(nodes: Nodes) -> tuple[float, float, float]:
    """Return scatter, size and length of the most probable kind of noise over all nodes."""
    kinds, which = np.unique(
        np.column_stack([nodes.kinds.scatter, nodes.kinds.size, nodes.kinds.length]),
        axis=0,
        return_inverse=True,
    )
    weight = np.bincount(which.ravel(), nodes.weight)
    scatter, size, length = kinds[int(np.argmax(weight))]
    return float(scatter), float(size), float(length)


def _period(nodes: Nodes) -> float:
    """Return the most probable period of a swing, infinite without one."""
    periods, which = np.unique(nodes.kinds.period, return_inverse=True)
    weight = np.bincount(which.ravel(), nodes.weight) * (periods > 0.0)
    return float(periods[int(np.argmax(weight))]) if weight.any() else float("inf")


def _states(nodes: Nodes, revolution: float, period: float) -> Array:
    """Return the map from states of noise (S) to level, noise, creep, swing, heat, (H, 6, S).

    A swing with another period than the selected one keeps its value and its rate.
    """
    own_period = nodes.kinds.period
    swings = own_period > 0.0
    angle = 2.0 * np.pi * revolution / np.where(swings, own_period, np.inf)
    faster = (
        period / np.where(swings, own_period, np.inf)
        if np.isfinite(period)
        else np.zeros(own_period.size)
    )
    states = np.zeros((own_period.size, STATES - LEVEL, nodes.left.shape[1]))
    states[:, 0, 0] = states[:, 1, 1] = states[:, 5, 2 + HEAT] = 1.0
    states[:, 2, 2] = nodes.kinds.creeps
    states[:, 0, 3] = np.where(swings, -SWING, STEP * (nodes.kinds.jump[:, 1] > 0.0))
    states[:, 0, 2 + COLUMNS :: 2] = STEP
    states[:, 3, 3] = SWING * swings * np.cos(angle)
    states[:, 3, 4] = SWING * swings * np.sin(angle)
    states[:, 4, 3] = -SWING * faster * np.sin(angle)
    states[:, 4, 4] = SWING * faster * np.cos(angle)
    return states


def consistency_of(numbers: Mapping[str, Any]) -> Consistency:
    """Restore a ``Consistency`` from its ``numbers``."""
    values = dict(numbers)
    if (
        "rising" not in values
        or len(values["scales"]) != len(Consistency().scales)
        or len(values["mean"] or STATES * [0.0]) != STATES
    ):
        # From a version with fewer states of noise: predictions resume with the next bin.
        values |= {"mean": None, "covariance": None, "scales": Consistency().scales}
        values |= {"rising": [excursion.numbers() for excursion in Consistency().rising]}
    departure, values["transition"] = values["departure"], values.pop("place", 1.0)
    return Consistency(
        **{
            **values,
            "bins": bins_of(values["bins"]),
            "mean": None if values["mean"] is None else np.array(values["mean"]),
            "covariance": None if values["covariance"] is None else np.array(values["covariance"]),
            "scales": tuple(values["scales"]),
            "sums": tuple(values["sums"]),
            "since": tuple(values["since"]),
            "rising": tuple(excursion_of(kept) for kept in values["rising"]),
            "departure": None if departure is None else Departure(**departure),
        }
    )
