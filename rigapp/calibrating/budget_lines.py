"""A budget as a record keeps it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from calibration.taking.uncertainty import Contribution


def budget_lines(
    lines: Sequence[Contribution], unit: str, scale: float = 1.0
) -> list[dict[str, Any]]:
    """Return the lines of a budget, the unit in the key; ``scale``: units per SI unit."""
    return [
        {
            "name": one.name,
            f"standard_uncertainty_{unit}": scale * one.uncertainty,
            "type": one.evaluation,
            "distribution": one.distribution,
            "degrees_of_freedom": finite(one.degrees),
            "averages_out": one.averages,
        }
        for one in lines
    ]


def finite(degrees: float) -> float | None:
    """Return degrees of freedom, None where they are without end."""
    return degrees if math.isfinite(degrees) else None
