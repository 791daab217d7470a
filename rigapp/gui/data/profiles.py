"""Worn profiles as the screen has them: from the engine's messages, or from a file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp.schema.columns import PROFILE_ANGLES_DEG, PROFILE_CURVES, profile_columns
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


def profile_message(columns: Mapping[str, NDArray[Any]], index: int) -> WornProfile:
    """Return profile ``index`` of a file's ``profiles()`` as the engine would send it."""
    values = [float(columns[one.name][index]) for one in profile_columns()]
    curves = {name: columns[name][index].astype("<f4").tobytes() for name in PROFILE_CURVES}
    return WornProfile(
        int(columns["revolution"][index]), np.array(values, dtype="<f8").tobytes(), **curves
    )
