"""Worn profiles as the screen has them: from the engine's messages, or from a file."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp.schema.columns import PROFILE_ANGLES_DEG, PROFILE_CURVES
from rigapp.schema.messages import WornProfile, as_array

Floats = NDArray[np.float64]

ANGLES_DEG = np.asarray(PROFILE_ANGLES_DEG, dtype=np.float64)


@dataclass(frozen=True, slots=True, eq=False)
class ShownProfile:
    """A worn profile, mm at ANGLES_DEG; NaN where nothing is known."""

    revolution: int
    measured: Floats
    predicted: Floats
    driven: Floats
    uncertainty: Floats

    @property
    def deepest(self) -> float:
        """Return the largest depth of all curves, 0 when there is none."""
        curves = np.concatenate([self.measured + self.uncertainty, self.predicted, self.driven])
        finite = curves[np.isfinite(curves)]
        return max(float(finite.max(initial=0.0)), 0.0)


def shown_profile(message: WornProfile) -> ShownProfile:
    """Unpack a message."""
    curves = {name: as_array(getattr(message, name)).astype(np.float64) for name in PROFILE_CURVES}
    return ShownProfile(message.revolution, **curves)
