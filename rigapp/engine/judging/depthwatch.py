"""Whether the measured wear depth can be believed: worn material does not come back.

Each depth is compared with the specimen's last known one, at first that of its last test or of the
part before an interruption, then the mean of every ``BIN`` revolutions. What differs by more than
both uncertainties and more than the bushing wears meanwhile is a jump; what lies below the deepest
mean so far falls; below a new bushing's there is nothing. From then on the depth judges nothing.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rigapp.schema.alarms import Cause, make_alarm
from rigapp.schema.criteria import CRITERIA
from rigapp.texts import say

BIN = 10
"""Revolutions of a mean: they wear less than its uncertainty but where the joint runs in."""

STAYS = 3
"""Revolutions in a row until a depth counts as another one: one may be a chip or a knock."""

MODEL_FACTOR = 10.0
"""Largest plausible ratio of measured to predicted wear: the coefficient is uncertain."""

DEPTH_COLUMNS = tuple(sorted({name for rule in CRITERIA.values() for name in rule.of_depth}))
"""Columns of a prediction that follow from the measured depth."""


@dataclass(frozen=True, slots=True)
class KnownDepth:
    """A depth that was believed, with its expanded uncertainty (k = 2), um.

    model: wear by the model under the measured forces then, um; when: in words.
    """

    depth: float
    uncertainty: float
    model: float = math.nan
    when: str = ""


class DepthWatch:
    """Check the measured depth of every judged revolution of a test.

    last: the specimen's last known depth, None for a new one. remark: why the depth is not to be
    believed, in a sentence, empty while it is.
    """

    def __init__(self, last: KnownDepth | None = None) -> None:
        self._last = self._deepest = last
        self._sum = [0.0, 0.0]
        self._count = 0
        self._in_a_row = 0
        self._negative = 0
        self.remark = ""

    @property
    def doubtful(self) -> bool:
        """Return whether the newest depth is not to be judged by."""
        return bool(self.remark or self._in_a_row or self._negative)

    def look(self, number: int, values: Mapping[str, float]) -> Iterator[Cause]:
        """Yield what is to be raised; values: the columns of a prediction by name."""
        names = ("measured_wear_depth", "measured_wear_depth_uncertainty", "driven_wear_depth")
        depth, doubt, model = (1e3 * values[name] for name in names)
        if not (math.isfinite(depth) and math.isfinite(doubt)):
            return
        now = KnownDepth(depth, doubt, model, say("revolution {}", number))
        self._negative = self._negative + 1 if depth < -doubt else 0
        cause = self._differs(now)
        self._in_a_row = self._in_a_row + 1 if cause is not None else 0
        if cause is None:
            self._add(now)
        elif self._in_a_row >= STAYS:
            self._last = self._deepest = now
            self._sum, self._count, self._in_a_row = [0.0, 0.0], 0, 0
            yield self._unbelieved(cause)
        if self._negative == STAYS and not self.remark:
            yield self._unbelieved(make_alarm("wear_negative", depth_um=depth, doubt_um=doubt))

    def _unbelieved(self, cause: Cause) -> Cause:
        self.remark = self.remark or say("The wear depth is not reliable. {}", cause.sentence)
        return cause

    def _differs(self, now: KnownDepth) -> Cause | None:
        """Return how a depth contradicts what was known, None where it does not."""
        last, deepest = self._last, self._deepest
        if last is None or deepest is None:
            return None
        grown = now.model - last.model
        grown = max(grown, 0.0) if math.isfinite(grown) else 0.0
        change, doubt = now.depth - last.depth, math.hypot(now.uncertainty, last.uncertainty)
        if not -doubt <= change <= doubt + MODEL_FACTOR * grown:
            return _depth_alarm(last, now, doubt, jumped=True)
        doubt = math.hypot(now.uncertainty, deepest.uncertainty)
        if now.depth < deepest.depth - doubt:
            return _depth_alarm(deepest, now, doubt, jumped=False)
        return None

    def _add(self, now: KnownDepth) -> None:
        """Take a believed depth into the mean; a full one is what the next are compared with."""
        self._sum[0] += now.depth
        self._sum[1] += now.uncertainty
        self._count += 1
        if self._count < BIN and self._last is not None:
            return
        depth, doubt = (total / self._count for total in self._sum)
        self._last = KnownDepth(depth, doubt, now.model, now.when)
        if self._deepest is None or depth > self._deepest.depth:
            self._deepest = self._last
        self._sum, self._count = [0.0, 0.0], 0


def _depth_alarm(before: KnownDepth, now: KnownDepth, doubt: float, *, jumped: bool) -> Cause:
    return make_alarm(
        "wear_jumped" if jumped else "wear_fell",
        when=before.when,
        before_um=before.depth,
        now_um=now.depth,
        doubt_um=doubt,
    )
