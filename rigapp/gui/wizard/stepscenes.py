"""Which scene the step under way of a calibration is."""

from __future__ import annotations

import math
from typing import Any

from calibration.taking.procedure import StepKind
from calibration.taking.signals import Readiness
from rigapp.gui.wizard.scenes import ProbeScene, Scene, WeightScene, stack_of


def weight_scene(session: Any, window: Any, readiness: Readiness | None) -> Scene | None:
    """Return crank and weights of the present step; None when all are done."""
    procedure = session.procedure
    if procedure.done:
        return None
    step = procedure.step
    before = procedure.steps[procedure.position - 1].pieces if procedure.position else ()
    now = None if window is None else window.angle
    turning = step.kind is StepKind.SET_UP
    return WeightScene(
        step.set_up or 0.0,
        now,
        tuple(stack_of(step.pieces, before)),
        0.0 if turning or not step.pieces else session.expected(),
        turning,
    )


def probe_scene(session: Any, window: Any, readiness: Readiness | None) -> Scene | None:
    """Return probe and micrometer of the present step; None when all are done."""
    procedure = session.procedure
    if procedure.done:
        return None
    step = procedure.step
    return ProbeScene(
        int(step.set_up or 1),
        1e6 * step.value,
        1e6 * procedure.plan.reach,
        math.nan if readiness is None else 1e6 * readiness.felt,
        step.falling or step.number == 1,
    )
