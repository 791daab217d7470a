"""What the calibration says of the uncertainty of a position, and of a free channel's value."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from rigapp.schema.channels import BASE, PROBES

Stated = Mapping[str, float]
"""Channel -> expanded uncertainty of one of its values, in its unit; without those not stated."""


def stated_uncertainties(calibration: Mapping[str, Any]) -> Stated:
    """Return what a file states of the channels beside the forces."""
    probes = calibration.get("probes")
    both = probes.get("uncertainty_um") if isinstance(probes, Mapping) else None
    found: dict[str, Any] = dict(
        zip(BASE.names_of(PROBES), () if both is None else both, strict=False)
    )
    for name, section in calibration.items():
        if name.startswith("channel_") and isinstance(section, Mapping):
            found[name.removeprefix("channel_")] = section.get("uncertainty")
    known = {name: one for name, one in found.items() if isinstance(one, int | float)}
    return {name: float(one) for name, one in known.items() if math.isfinite(one)}
