"""The measured wear depth: the one definition that trend, criterion, file, resume and report share.

It is how far the pin's centre lies from the bushing's under the usual direction of load, beyond the
clearance of the new bushing and less the elastic approach of the bushing as it is worn now: the
mean over the loaded parts of one revolution. Its uncertainty is expanded (k = 2) and contains the
spread of the readings, the reference and the approach; not the probes' calibration, drift or heat.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rigapp.twin.approach import Approach
from rigapp.twin.pinpath import LOADED, PathSum, Reference, centres

FIRST_STEADY = 3
NEW_REVOLUTIONS = 5
"""The bushing counts as new in so many revolutions from FIRST_STEADY on."""
ELASTIC_DOUBT = 0.2
"""Relative standard uncertainty of the change of the elastic approach: modulus, load, support."""
USUAL_RAD = float(np.radians(10.0))
"""Parts of a revolution with the force this near to its mean direction count."""


@dataclass(frozen=True, slots=True)
class MeasuredDepth:
    """Hold a measured wear depth and its expanded uncertainty (k = 2), m; NaN when not known."""

    depth: float = float("nan")
    uncertainty: float = float("nan")


def measured_depth(
    path: PathSum, reference: Reference | None, clearance: float, approach: Approach | None
) -> MeasuredDepth:
    """Return the measured wear depth of a revolution, NaN when there is none to tell.

    clearance: of the new bushing, m; approach: by the model, None when the model cannot tell: then
    it stays in the depth, and nobody knows how uncertain that is.
    """
    if reference is None:
        return MeasuredDepth()
    force = path.mean_force
    size = np.hypot(*force)
    mean = force.sum(axis=1)
    length = float(np.hypot(*mean))
    if not (size.size and length > 0.0):
        return MeasuredDepth()
    along = (mean @ force) / (length * np.maximum(size, 1e-300))
    usual = (size > LOADED * size.max()) & (along > np.cos(USUAL_RAD))
    if not usual.any():
        return MeasuredDepth()
    load = size[usual]
    far = np.hypot(*centres(path, reference)[:, usual])
    beyond = float(np.average(far, weights=load)) - clearance
    if approach is None:
        return MeasuredDepth(depth=beyond)
    mean_approach = approach.mean(load)
    new = mean_approach.at(0.0)
    depth = mean_approach.depth_of(beyond + (0.0 if reference.elastic else new))
    noise = path.standard_error / float(np.sqrt(load.size))
    change = ELASTIC_DOUBT * (new - mean_approach.at(depth))
    doubt = float(np.hypot(np.hypot(reference.radial, noise) * mean_approach.gain(depth), change))
    return MeasuredDepth(depth, 2.0 * doubt)
