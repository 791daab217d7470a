"""How elasticity moves the pin into an unworn bushing under measured forces. Pure functions."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rigapp.texts import say
from rigapp.twin.ahead import bushing_ahead
from rigapp.twin.approach import RIGID
from rigapp.twin.measureddepth import ELASTIC_DOUBT
from rigapp.twin.pinpath import FRICTION_DOUBT, rotated
from rigapp.twin.predict import GRID, PredictionError
from rigapp_model.frames import into_frame
from rigapp_model.joints import perfect_joint
from rigapp_model.parameters import Parameters

Array = NDArray[np.float64]

DOUBTS = (ELASTIC_DOUBT * np.eye(2), FRICTION_DOUBT * np.array([[0.0, -1.0], [1.0, 0.0]]))
"""Errors of the size and of the direction; times the motion, one standard uncertainty each."""


def elastic_motions(
    parameters: Parameters, angles: Sequence[Array], forces: Sequence[Array]
) -> list[Array]:
    """Return the elastic motion (2, n) of the pin in the follower frame, m, in each revolution.

    angles (n,) each: crank angle, rad; forces (2, n) each: on the follower by the pin, crank frame,
    N. The clearance is left out of the follower's angle. Raises PredictionError, ModelError.
    """
    if not angles:
        return []
    if not all(np.isfinite(force).all() for force in forces):
        raise PredictionError(say("its forces are not all numbers"))
    motion = perfect_joint(parameters.mechanism, GRID, 1.0, 0.0, parameters.joint)
    seen = []
    for angle, force in zip(angles, forces, strict=True):
        turn = np.interp(angle, GRID, motion.follower_angle, period=2.0 * np.pi) - angle
        seen.append(into_frame(force, np.cos(turn), np.sin(turn)))
    together, crank = np.concatenate(seen, axis=1), np.concatenate(angles)
    usual = np.array([np.interp(GRID, crank, row, period=2.0 * np.pi) for row in together])
    bushing = bushing_ahead(parameters, usual, motion.slip_increments(parameters.joint.pin_radius))
    approach = RIGID if bushing is None else bushing.upto(0.0)
    if approach is None:
        raise PredictionError(say("the model cannot tell how far the force presses the pin in"))
    lean = -float(np.arctan(parameters.joint.friction_coefficient))
    motions = []
    for force in seen:
        size = np.hypot(*force)
        normal = rotated(force / np.maximum(size, 1e-300), lean)
        motions.append(np.asarray(approach.at(0.0, size) * normal))
    return motions
