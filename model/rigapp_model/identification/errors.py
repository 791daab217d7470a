"""Prior knowledge: errors of the probes, prior of the coefficient; error if not identifiable."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rigapp.texts import joined, say
from rigapp_model.errors import require_not_negative, require_positive


class NotIdentifiable(Exception):
    """No result is possible; the message gives the reason."""


USUAL_DAY = 43_200.0
"""Revolutions per day at 30 rpm, the speed of the usual rig."""


@dataclass(frozen=True, slots=True)
class ProbeErrors:
    """Errors of the probes from their record, as standard uncertainties.

    sensitivity: relative, common to all readings; reference: of the depth's zero, m; drift: lower
    bound of its strength, m per root of the natural logarithm of revolutions; scatter: expected
    value for one reading, m; load: relative, of the load by which the wear is divided: affects the
    coefficient, not the remaining revolutions; geometry: relative, of the coefficient due to width
    and clearance of the specimen, likewise; swing: probability of a slow swing of the readings, as
    with the temperature of a room; day: revolutions per day, the most probable period of it.
    """

    sensitivity: float
    reference: float
    drift: float
    scatter: float = 0.5e-6
    load: float = 0.0
    geometry: float = 0.0
    swing: float = 0.6
    day: float = USUAL_DAY

    def __post_init__(self) -> None:
        require_not_negative("sensitivity", self.sensitivity)
        require_positive("reference", self.reference, "m")
        require_not_negative("drift", self.drift, "m")
        require_positive("scatter", self.scatter, "m")
        require_not_negative("load", self.load)
        require_not_negative("geometry", self.geometry)
        require_not_negative("swing", self.swing)
        require_positive("day", self.day)

    @property
    def scale(self) -> float:
        """Return the relative uncertainty of the coefficient's scale."""
        return float(np.hypot(self.load, self.geometry))


def probe_errors(
    sensitivity: float | None,
    reference: float | None,
    drift: float | None,
    scatter: float = 0.5e-6,
    load: float = 0.0,
    geometry: float = 0.0,
) -> ProbeErrors:
    """Return the errors of the probes; raise NotIdentifiable if one is not stated (None)."""
    missing = [
        name
        for name, value in (
            (say("uncertainty of the sensitivity"), sensitivity),
            (say("uncertainty of the reference"), reference),
            ("drift", drift),
        )
        if value is None
    ]
    if sensitivity is None or reference is None or drift is None:
        raise NotIdentifiable(
            say(
                "the probes have no calibration record that states {}: calibrate them, or"
                " give the test their record",
                joined(", ", missing),
            )
        )
    return ProbeErrors(sensitivity, reference, drift, scatter, load, geometry)


WIDE = float(np.log(10.0) / 1.959964)
"""Spread of ln K if only its order of magnitude is known: 95 % within a decade to either side."""


@dataclass(frozen=True, slots=True)
class Prior:
    """Prior of the wear coefficient: ln K is normal.

    coefficient: median, m^2/N; spread: standard deviation of ln K; source: as text.
    """

    coefficient: float
    spread: float = WIDE
    source: str = say("the parameter file's order of magnitude, a decade to either side")

    def __post_init__(self) -> None:
        require_positive("coefficient", self.coefficient, "m^2/N")
        require_positive("spread", self.spread)
