"""Warnings about the joint that follow from the twin's answers, whatever the test file limits.

The pairing of materials leaves the range that was given for it; the joint wears otherwise than
before. Nothing here ends a test.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from rigapp.config.parameters import PairingSection
from rigapp.schema.alarms import Cause, make_alarm
from rigapp.schema.units import stem_of, unit_of_key
from rigapp.texts import say

STAYS = 20
"""Revolutions in a row until a pairing counts as beyond its range, or as back in it: what heat does
to it takes minutes, and one revolution's maximum is a sample with its noise."""


class JointWatch:
    """Check every prediction of a test; see ``look``."""

    def __init__(self, pairing: PairingSection | None = None) -> None:
        self._pairing = pairing or PairingSection()
        self._in_a_row = 0
        self._left = False
        self._told = math.nan

    def look(self, values: Mapping[str, float]) -> Iterator[Cause | str]:
        """Yield what is to be raised, and the keys of alarms whose condition is over.

        values: the columns of a prediction by name.
        """
        beyond = self._beyond(values)
        # An unknown value does not show that the pairing is back.
        known = bool(beyond) or all(math.isfinite(value) for value in self._with_level(values))
        self._in_a_row = self._in_a_row + 1 if known and bool(beyond) != self._left else 0
        if self._in_a_row >= STAYS:
            self._in_a_row, self._left = 0, bool(beyond)
            yield make_alarm("pairing_left", sentence=beyond) if beyond else "pairing_left"
        since = values["wear_departure_revolution"]
        # One of an earlier test of the specimen was reported then.
        if since > 0.0 and since != self._told:
            self._told = since
            how = say("faster") if values["wear_consistency"] > 0.0 else say("more slowly")
            yield make_alarm("wears_otherwise", since=since, how=how)

    def _with_level(self, values: Mapping[str, float]) -> Iterator[float]:
        """Yield the values that have a level."""
        for key in self._pairing.__struct_fields__:
            if getattr(self._pairing, key) is not None:
                yield values[f"{stem_of(key).rpartition('_')[0]}_max"]

    def _beyond(self, values: Mapping[str, float]) -> str:
        """Return which level of the pairing is passed, empty for none."""
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
