"""Whether the joint still wears as it did: how new readings lie in what was predicted of them.

Readings are gathered in fine bins, 0.25 % of the revolutions long. Each is compared with the depth
predicted before it came; the innovation over its standard deviation is standard normal while the
statement holds. Two cumulative sums (E. S. Page, Biometrika 41 (1954) 100-115), for faster and for
slower wear, raise an alarm where they pass a threshold that follows from the false alarm rate (D.
Siegmund, Sequential Analysis, 1985, Eq. 2.56).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp_model.identification.bins import Bin, Bins, bins_of
from rigapp_model.identification.inference import Identification
from rigapp_model.identification.life import DepthLife
from rigapp_model.identification.statements import STATEMENTS, Hypotheses

Array = NDArray[np.float64]

FINE = 920
"""Fine bins a decade, each 0.25 % of the revolutions: three with the largest innovation raise the
alarm, and a bushing that wears 5 um in 1,000 revolutions wears 0.1 um in each at 10,000."""
FALSE_ALARM = 0.0015
"""Probability of a false alarm in a decade of revolutions: 0.005 in the first 21,377."""
REFERENCE = 0.75
"""What a sum loses with each innovation: half of the shift that it finds soonest, 1.5 sigma, which
is what K times 1.5 makes of a fine bin at 10,000 revolutions with a scatter of 0.4 um."""
LARGEST = 4.0
"""An innovation counts as no more than this: one wrong bin raises no alarm."""
OVERSHOOT = 1.166
"""How far a sum of normal steps passes a threshold (Siegmund), in sigma."""
WIDEST = 0.2
"""Nothing is judged while ln K is less well known: its course is straight within this to 1 %."""


def threshold(false_alarm: float = FALSE_ALARM) -> float:
    """Return what a sum must pass, for a probability of a false alarm in a decade of revolutions.

    A sum runs (exp(x) - x - 1) / (2 k^2) bins between false alarms, x = 2 k (threshold + overshoot)
    with what it loses, k.
    """
    wanted = 2.0 * REFERENCE**2 * 2.0 * FINE / false_alarm  # each of two sums
    x = float(np.log(wanted))
    for _ in range(20):
        x = float(np.log(wanted + x + 1.0))
    return x / (2.0 * REFERENCE) - OVERSHOOT


THRESHOLD = threshold()


@dataclass(frozen=True, slots=True)
class Departure:
    """Hold that a joint wears otherwise than before.

    revolution: at which it was told; since: from which on the sum rose; faster: or slower.
    """

    revolution: float
    since: float
    faster: bool


@dataclass(slots=True)
class Consistency:
    """Judge readings one by one against what was predicted of them; a fixed number of numbers.

    mean (5,), covariance (5, 5): of ln K/K0, ln r, e / u_e, b / u_b and the drift, m, as known now;
    none before ``renew`` was called. sums: for faster and slower wear; since: the revolution at
    which each was last 0; departure: the first one told, until ``acknowledged``.
    """

    bins: Bins = field(default_factory=lambda: Bins(FINE))
    statement: str = ""
    place: float = 1.0
    mean: Array | None = None
    covariance: Array | None = None
    walked: float = 0.0
    scales: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    sums: tuple[float, float] = (0.0, 0.0)
    since: tuple[float, float] = (0.0, 0.0)
    innovation: float = float("nan")
    departure: Departure | None = None

    @property
    def score(self) -> float:
        """Return the larger sum as a part of its threshold: 1 is the alarm; NaN before any."""
        return max(self.sums) / THRESHOLD if self.mean is not None else float("nan")

    def renew(self, known: Identification) -> None:
        """Take over what the closed bins tell by now; the sums go on."""
        if known.spread > WIDEST:
            return
        nodes = known.best.nodes
        places = nodes.hypotheses.place
        best = places == places[int(np.argmax(nodes.weight))]
        nodes = nodes.at(np.flatnonzero(best))
        centre = np.column_stack(
            [
                nodes.hypotheses.log_coefficient,
                nodes.log_ratio,
                nodes.mean[:, 1:],
                nodes.left,
            ]
        )
        inner = np.zeros((centre.shape[0], 5, 5))
        inner[:, 0, 0] = nodes.breadth**2 / 12.0
        inner[:, 1:4, 1:4] = nodes.covariance
        across = -(nodes.covariance @ nodes.pulled[:, :, None])[:, :, 0]
        inner[:, 1:4, 4] = inner[:, 4, 1:4] = across
        inner[:, 4, 4] = nodes.spare - (across * nodes.pulled).sum(axis=1)
        mean = nodes.weight @ centre
        apart = centre - mean
        self.mean = mean
        self.covariance = np.tensordot(
            nodes.weight, inner + apart[:, :, None] * apart[:, None, :], axes=1
        )
        self.statement, self.place = known.best.name, float(nodes.hypotheses.place[0])
        self.walked = float(known.readings.walked[-1])
        self.scales = (
            known.sensitivity,
            known.errors.reference,
            known.drift,
            known.readings.scatter,
        )

    def add(
        self, revolution: float, progress: float, depth: float, life: DepthLife
    ) -> Departure | None:
        """Take one reading; return the departure that it told, None when none.

        revolution, progress (nominal cycles), depth (m): as for ``Bins.add``.
        """
        closed = self.bins.add(revolution, progress, depth)
        if closed is None:
            return None
        self.bins.closed.clear()
        return self.judge(closed, life)

    def judge(self, closed: Bin, life: DepthLife) -> Departure | None:
        """Judge a fine bin; return the departure that it told, None when none."""
        if self.mean is None or self.covariance is None:
            return None
        sensitivity, reference, drift, scatter = self.scales
        middle = closed.revolution * closed.progress / max(closed.last, 1e-300)
        walked = float(np.log(max(middle, 1.0)))
        self.covariance[4, 4] += drift**2 * max(walked - self.walked, 0.0)
        self.walked = max(walked, self.walked)
        statement = next(one for one in STATEMENTS if one.name == self.statement)
        x = self.mean
        at = Hypotheses(statement, x[:1], x[1:2], np.array([self.place]))
        half = np.array([0.5 * (closed.last - closed.first)])
        found, slopes = life.depth(np.array([closed.progress]), at.scaled(half))
        expected = float(found[0, 0])
        row = np.array([slopes[0, 0, 0], slopes[1, 0, 0], sensitivity * expected, reference, 1.0])
        ahead = self.covariance @ row
        variance = float(row @ ahead) + scatter**2 / closed.count
        off = closed.depth - expected - float(row[2:] @ x[2:])
        self.mean = x + ahead * (off / variance)
        self.covariance = self.covariance - np.outer(ahead, ahead) / variance
        self.innovation = off / float(np.sqrt(variance))
        return self._summed(closed.revolution)

    def _summed(self, revolution: float) -> Departure | None:
        """Take the last innovation into both sums; return the departure that it told."""
        step = float(np.clip(self.innovation, -LARGEST, LARGEST))
        up = max(self.sums[0] + step - REFERENCE, 0.0)
        down = max(self.sums[1] - step - REFERENCE, 0.0)
        self.since = (
            self.since[0] if up > 0.0 else revolution,
            self.since[1] if down > 0.0 else revolution,
        )
        self.sums = (up, down)
        if max(up, down) < THRESHOLD or self.departure is not None:
            return None
        faster = up > down
        self.departure = Departure(revolution, self.since[0 if faster else 1], faster)
        return self.departure

    def acknowledged(self) -> None:
        """Begin anew: what comes is judged against what the bins will have told by then."""
        self.sums, self.departure = (0.0, 0.0), None

    def numbers(self) -> dict[str, Any]:
        """Return all that is kept as plain numbers, for a checkpoint."""
        return {
            "bins": self.bins.numbers(),
            "statement": self.statement,
            "place": self.place,
            "mean": None if self.mean is None else self.mean.tolist(),
            "covariance": None if self.covariance is None else self.covariance.tolist(),
            "walked": self.walked,
            "scales": list(self.scales),
            "sums": list(self.sums),
            "since": list(self.since),
            "innovation": self.innovation,
            "departure": None if self.departure is None else asdict(self.departure),
        }


def consistency_of(numbers: Mapping[str, Any]) -> Consistency:
    """Return the judge of which ``numbers`` were kept; it goes on as that would have."""
    values = dict(numbers)
    departure = values["departure"]
    return Consistency(
        **{
            **values,
            "bins": bins_of(values["bins"]),
            "mean": None if values["mean"] is None else np.array(values["mean"]),
            "covariance": None if values["covariance"] is None else np.array(values["covariance"]),
            "scales": tuple(values["scales"]),
            "sums": tuple(values["sums"]),
            "since": tuple(values["since"]),
            "departure": None if departure is None else Departure(**departure),
        }
    )
