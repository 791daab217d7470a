"""Warnings about the joint from the twin's predictions, independent of the test file's limits.

The pairing of materials is outside its stated range, or the wear of the joint has changed. They do
not end a test.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from rigapp.config.parameters import PairingSection
from rigapp.schema.alarms import Cause, make_alarm
from rigapp.schema.units import stem_of, unit_of_key
from rigapp.texts import say

STAYS = 20
"""Consecutive revolutions until a pairing is outside its range, or inside again: effects of heat
take minutes, and the maximum of one revolution is noisy."""


class JointWatch:
    """Check of each prediction of a test; see ``look``."""

    def __init__(self, pairing: PairingSection | None = None) -> None:
        self._pairing = pairing or PairingSection()
        self._in_a_row = 0
        self._outside = False
        self._reported_since = math.nan

    def look(self, values: Mapping[str, float]) -> Iterator[Cause | str]:
        """Yield the alarms to raise, and the keys of alarms to clear.

        values: the columns of a prediction by name.
        """
        beyond = self._beyond(values)
        # An unknown value does not show that the pairing is inside its range again.
        known = bool(beyond) or all(math.isfinite(value) for value in self._with_level(values))
        self._in_a_row = self._in_a_row + 1 if known and bool(beyond) != self._outside else 0
        if self._in_a_row >= STAYS:
            self._in_a_row, self._outside = 0, bool(beyond)
            yield make_alarm("pairing_left", sentence=beyond) if beyond else "pairing_left"
        since = values["wear_departure_revolution"]
        # A departure in an earlier test of the specimen was reported in that test.
        if since > 0.0 and since != self._reported_since:
            self._reported_since = since
            how = say("faster") if values["wear_consistency"] > 0.0 else say("more slowly")
            yield make_alarm("wears_otherwise", since=since, how=how)

    def _with_level(self, values: Mapping[str, float]) -> Iterator[float]:
        """Yield the values with a level."""
        for key in self._pairing.__struct_fields__:
            if getattr(self._pairing, key) is not None:
                yield values[f"{stem_of(key).rpartition('_')[0]}_max"]

    def _beyond(self, values: Mapping[str, float]) -> str:
        """Return a text with the exceeded level of the pairing, or an empty text."""
        for key in self._pairing.__struct_fields__:
            level = getattr(self._pairing, key)
            quantity, _, side = stem_of(key).rpartition("_")
            value = values[f"{quantity}_max"]
            if level is None or not (value > level if side == "high" else value < level):
                continue
            words, unit = quantity.replace("_", " "), unit_of_key(key).words
            return say(
                "The largest {} of a revolution is {:.4g} {}; model.pairing.{} is {:g}.",
                words,
                value,
                unit,
                key,
                level,
            )
        return ""
