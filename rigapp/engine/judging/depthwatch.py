"""Plausibility of the measured wear depth: wear does not decrease.

Each depth is compared with the last known one of the specimen, at first that of its last test or
run, then the mean of each ``BIN`` revolutions. A difference beyond both uncertainties and the wear
since then is a jump; a depth below the deepest mean is a fall; a negative depth is impossible.
After any of these the depth is no longer used for criteria.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rigapp.schema.alarms import Cause, make_alarm
from rigapp.schema.criteria import CRITERIA
from rigapp.texts import say

BIN = 10
"""Revolutions per mean: except in running-in, their wear is less than its uncertainty."""

STAYS = 3
"""Consecutive revolutions that confirm a changed depth: one may be a chip or a knock."""

MODEL_FACTOR = 10.0
"""Largest ratio of the wear to that of the model, whose coefficient is uncertain."""

DEPTH_COLUMNS = tuple(sorted({name for rule in CRITERIA.values() for name in rule.of_depth}))
"""Columns of a prediction that depend on the measured depth."""


@dataclass(frozen=True, slots=True)
class KnownDepth:
    """Plausible depth with its expanded uncertainty (k = 2), um.

    model: wear by the model under the measured forces until then, um; when: as text.
    """

    depth: float
    uncertainty: float
    model: float = math.nan
    when: str = ""


class DepthWatch:
    """Check of the measured depth of each evaluated revolution of a test.

    last: last known depth of the specimen, None if new. remark: why the depth is not plausible, or
    empty.
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
        """Return whether the latest depth must not be used for criteria."""
        return bool(self.remark or self._in_a_row or self._negative)

    def look(self, number: int, values: Mapping[str, float]) -> Iterator[Cause]:
        """Yield the alarms to raise; values: the columns of a prediction by name."""
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
            yield self._implausible(cause)
        if self._negative == STAYS and not self.remark:
            yield self._implausible(make_alarm("wear_negative", depth_um=depth, doubt_um=doubt))

    def _implausible(self, cause: Cause) -> Cause:
        self.remark = self.remark or say("The wear depth is not reliable. {}", cause.sentence)
        return cause

    def _differs(self, now: KnownDepth) -> Cause | None:
        """Return an alarm if a depth contradicts the known ones, else None."""
        last, deepest = self._last, self._deepest
        if last is None or deepest is None:
            return None
        model_wear = now.model - last.model
        model_wear = max(model_wear, 0.0) if math.isfinite(model_wear) else 0.0
        change, doubt = now.depth - last.depth, math.hypot(now.uncertainty, last.uncertainty)
        if not -doubt <= change <= doubt + MODEL_FACTOR * model_wear:
            return _depth_alarm(last, now, doubt, jumped=True)
        doubt = math.hypot(now.uncertainty, deepest.uncertainty)
        if now.depth < deepest.depth - doubt:
            return _depth_alarm(deepest, now, doubt, jumped=False)
        return None

    def _add(self, now: KnownDepth) -> None:
        """Add a plausible depth to the mean; a complete mean is the next reference."""
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
