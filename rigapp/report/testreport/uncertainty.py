"""What the calibration says of the uncertainty of a position."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True, slots=True)
class PositionUncertainty:
    """The expanded uncertainty of one position of each probe, um."""

    probe_1_um: float
    probe_2_um: float

    def of(self, channel: str) -> float | None:
        """Return that of a channel, um; None for what is no probe."""
        return {"probe_1": self.probe_1_um, "probe_2": self.probe_2_um}.get(channel)

    @property
    def words(self) -> str:
        """Return both as they are printed."""
        return f"± {self.probe_1_um:.2f} µm (probe 1), ± {self.probe_2_um:.2f} µm (probe 2)"


def position_uncertainty(calibration: Mapping[str, Any]) -> PositionUncertainty | None:
    """Return the uncertainty of positions that a file states, or None."""
    probes = calibration.get("probes")
    stated = probes.get("uncertainty_um") if isinstance(probes, Mapping) else None
    try:
        one, two = (float(value) for value in stated)  # type: ignore[union-attr]
    except (TypeError, ValueError):
        return None
    return PositionUncertainty(one, two) if np.isfinite([one, two]).all() else None
