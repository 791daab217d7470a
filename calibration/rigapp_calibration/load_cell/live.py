"""Live readings of the load cell: is it steady, and does the pin stand right for the step?"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rigapp_calibration.arrays import Array
from rigapp_calibration.load_cell.plans import wrong_angle
from rigapp_calibration.load_cell.two_axis import forces
from rigapp_calibration.load_cell.weights import STANDARD_GRAVITY, pin_force
from rigapp_calibration.load_cell.wiring import told_by_one_load
from rigapp_calibration.taking.procedure import Step, StepKind
from rigapp_calibration.taking.signals import (
    Judgement,
    Readiness,
    SignalState,
    SignalWindow,
    assess,
)

SPREAD_SHARE = 0.25
"""Part of the cell's resolution that a steady signal may spread: below what a reading can tell."""
NOISE_SHARE = 0.6
"""And of one sample's noise, which is about half the resolution: it is no swinging."""
SLOPE_SHARE = 0.05
"""Part of the resolution by which a steady signal may change in a second: creep is slower."""
FELT_SHARE = 0.3
"""Of what hangs must be felt before plugs and the time under it count: else it does not hang."""


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class LoadCellWindow(SignalWindow):
    """The cell's signals of the last seconds.

    angle: of the pin (rad) from the encoder, None while its index has not been passed. matrix
    (2, 2), zero (2,), quadratic (2, 3) or None: the calibration in use.
    """

    angle: float | None
    matrix: Array
    zero: Array
    quadratic: Array | None = None

    def force(self, signal: Array) -> float:
        """Return the size of the force (N) that the calibration in use makes of a signal (2,)."""
        return float(np.hypot(*forces(signal, self.matrix, self.zero, self.quadratic)[0]))


def assess_load(
    window: LoadCellWindow, step: Step, resolution: float, since: float, wait: float
) -> Readiness:
    """Judge a window for a step; resolution: of the cell, N; since, wait: see ``assess``."""
    per_newton = 1.0 / max(float(np.sqrt(abs(np.linalg.det(window.matrix)))), 1e-12)
    return assess(
        window,
        since=since,
        wait=wait,
        spread=resolution * (SPREAD_SHARE + NOISE_SHARE * window.noise_share) * per_newton,
        slope=resolution * SLOPE_SHARE * per_newton,
        first=_first(window),
        set_up=lambda found: (
            _stands(window, step)
            or _hangs(window, step, found.mean)
            or _plugs(window, step, found.mean)
        ),
        felt=window.force,
    )


def _first(window: LoadCellWindow) -> Judgement | None:
    if window.angle is None:
        return (
            SignalState.WAITING,
            "the angle is not known yet: turn the crank by hand once past the encoder's index",
        )
    return None if window.stands else (SignalState.MOVING, "the crank turns")


def _stands(window: LoadCellWindow, step: Step) -> Judgement | None:
    """Judge where the pin stands, for a step at which nothing is read or where it stands wrong."""
    assert window.angle is not None
    if step.kind is StepKind.ANGLE_REFERENCE:
        return SignalState.STEADY, "the crank stands"
    wrong = wrong_angle(window.angle, step)
    if wrong:
        return SignalState.WAITING, wrong
    if step.kind is StepKind.SET_UP:
        return SignalState.STEADY, f"the pin stands at {math.degrees(window.angle):.1f} degrees"
    return None


def _hangs(window: LoadCellWindow, step: Step, signal: Array) -> Judgement | None:
    """Judge whether the load is there from which on the time of a series counts."""
    if step.kind is not StepKind.PRELOAD or not step.series:
        return None
    if window.force(signal) > FELT_SHARE * step.value * STANDARD_GRAVITY:
        return None
    return SignalState.WAITING, f"the {step.value:g} kg do not hang yet"


def _plugs(window: LoadCellWindow, step: Step, signal: Array) -> Judgement | None:
    """Judge by the load that hangs whether the plugs are exchanged or turned, before it is taken.

    The first preload tells it already, whatever calibration is in use.
    """
    assert window.angle is not None
    expected = FELT_SHARE * step.value * STANDARD_GRAVITY
    if not (expected > 0.0 and window.force(signal) > expected):
        return None
    problem = told_by_one_load(signal - window.zero, pin_force(1.0, window.angle, 0.0))
    return None if problem is None else (SignalState.WAITING, problem.sentence)
