"""The measured wear depth: the one definition that trend, criterion, file, resume and report share.

It is the distance of the pin's centre from the bushing's under the usual direction of load, beyond
the clearance of the new bushing and less the elastic approach of the bushing as it is worn now: the
mean over the loaded parts of one revolution. Its uncertainty is expanded (k = 2) and contains the
spread of the readings, the reference and the approach; not the probes' calibration, drift or heat.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp.schema.columns import PROFILE_ANGLES_DEG
from rigapp.twin.approach import Approach
from rigapp.twin.pinpath import LOADED, PathSum, Reference, centres

Array = NDArray[np.float64]

FIRST_STEADY = 3
NEW_REVOLUTIONS = 5
"""Number of revolutions from FIRST_STEADY on in which the bushing counts as new."""
ELASTIC_DOUBT = 0.2
"""Relative standard uncertainty of the change of the elastic approach: modulus, load, support."""
USUAL_RAD = float(np.radians(10.0))
"""Parts of a revolution with the force this near to its mean direction count."""


@dataclass(frozen=True, slots=True)
class MeasuredDepth:
    """A measured wear depth and its expanded uncertainty (k = 2), m; NaN when not known."""

    depth: float = float("nan")
    uncertainty: float = float("nan")


def measured_depth(
    path: PathSum, reference: Reference | None, clearance: float, approach: Approach | None
) -> MeasuredDepth:
    """Return the measured wear depth of a revolution, NaN without one.

    clearance: of the new bushing, m; approach: by the model, None when the model has no solution:
    then it stays in the depth, whose uncertainty is unknown.
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


# The worn surface of the bushing by the pin's measured positions. Pure functions.
#
# Every position of the pin is free of material: the worn surface is at least the envelope of the
# pin's circle over all measured positions of its centre, and equal to it where the pin bears.
# Where the pin's circle does not reach the bushing's first circle, it is unknown: NaN.


ANGLES = np.radians(np.asarray(PROFILE_ANGLES_DEG))
"""Angles (rad) of every profile, -pi .. pi, 0 at the initial contact point (wear frame)."""
REACHED = 2e-7
"""A surface this near, m, is reached even if the uncertainty is smaller."""
DOUBTED = 2e-6
"""A surface further away than this, m, is not reached even if the uncertainty is larger."""


def swept(positions: Array, pin_radius: float) -> Array:
    """Return the reach of the pin's circle from the bushing's centre at each angle, m.

    positions (2, n): of the pin's centre from the bushing's, m. The largest over all positions;
    -inf where no pin's circle is met.
    """
    ray = np.stack([np.cos(ANGLES), np.sin(ANGLES)])
    along = ray.T @ positions
    across = ray[0][:, None] * positions[1] - ray[1][:, None] * positions[0]
    square = pin_radius**2 - across**2
    reach = np.where(square >= 0.0, along + np.sqrt(np.maximum(square, 0.0)), -np.inf)
    return np.asarray(reach.max(axis=1, initial=-np.inf), dtype=np.float64)


def worn_depth(
    positions: Array,
    pin_radius: float,
    bushing_radius: float,
    uncertainty: Array | float = 0.0,
) -> Array:
    """Return the depth of wear at each angle, m, NaN where the pin never reached the surface.

    uncertainty: expanded, of the depth at each angle, m. A pin that misses the first circle by
    less than it has reached the surface, and the depth there is 0.
    """
    beyond = swept(positions, pin_radius) - bushing_radius
    margin = np.clip(uncertainty, REACHED, DOUBTED)
    return np.where(beyond >= -margin, np.maximum(beyond, 0.0), np.nan)


def depth_uncertainty(radial: float, across: float, direction: float) -> Array:
    """Return the expanded uncertainty (k = 2) of the depth at each angle, m.

    radial, across: standard uncertainties of the pin's position along the direction of load and
    across it, m; direction: of the load, rad. A pin moved by u adds u cos(angle between) to the
    depth.
    """
    apart = ANGLES - direction
    return np.asarray(2.0 * np.hypot(radial * np.cos(apart), across * np.sin(apart)))


def on_angles(angle: Array, depth: Array) -> Array:
    """Return a profile of the model, (n,) depths at (n,) angles from -pi, at ``ANGLES``, m."""
    return np.asarray(np.interp(ANGLES, angle, depth, period=2.0 * np.pi), dtype=np.float64)
