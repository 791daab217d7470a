"""A virtual wear test: a joint of known wear coefficient, probes with errors, the result."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, Literal

import msgspec
import numpy as np

from rigapp.config.numbers import within
from rigapp.texts import say
from rigapp_model.wear.techniques import SOLVABLE

if TYPE_CHECKING:
    from rigapp_model.identification import Credible, DepthLife, ProbeErrors
    from rigapp_model.parameters import Parameters

    SolvableName = str
else:
    SolvableName = Literal[SOLVABLE]

MICRO = 1e-6
MM3_PER_NM = 1e9
POINTS = 720
DEEPER = 1.5
"""Factor of the test's depth up to which the life is computed."""


class VirtualTest(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[run] of ``simulate``: a test whose bushing wears by ``coefficient_factor`` times the model.

    probe_*: standard uncertainties as a certificate of the probes states them: of the sensitivity
    (relative), of the zero of depth, drift a root of the logarithm of the revolutions, scatter of a
    revolution's depth.
    """

    rpm: Annotated[float, within(0.001, 10_000.0)]
    revolutions: Annotated[int, within(20, 10_000_000)]
    joint: SolvableName = "continuous"
    coefficient_factor: Annotated[float, within(0.01, 100.0)] = 1.0
    probe_sensitivity: Annotated[float, within(0.0, 1.0)] = 0.01
    probe_reference_um: Annotated[float, within(1e-3, 1000.0)] = 1.0
    probe_drift_um: Annotated[float, within(0.0, 1000.0)] = 0.3
    probe_scatter_um: Annotated[float, within(1e-3, 1000.0)] = 0.4


def virtual_test(parameters: Parameters, run: VirtualTest, seed: int) -> dict[str, float]:
    """Return the identified wear coefficient of a virtual test; the same seed gives the same."""
    from rigapp_model.identification import Bins, NotIdentifiable, Prior, ProbeErrors, identify

    life = _life(parameters, run.rpm, run.joint, run.revolutions, run.coefficient_factor)
    true = run.coefficient_factor * life.coefficient
    errors = ProbeErrors(
        sensitivity=run.probe_sensitivity,
        reference=MICRO * run.probe_reference_um,
        drift=MICRO * run.probe_drift_um,
        scatter=MICRO * run.probe_scatter_um,
        swing=0.0,  # none is drawn
    )
    number = np.arange(1.0, run.revolutions + 1.0)
    depth = life.course.at(run.coefficient_factor * number)[0]
    seen, bins = _measured(depth, errors, seed), Bins()
    estimates: list[tuple[float, Credible]] = []
    for revolution, depth in zip(number.tolist(), seen.tolist(), strict=True):
        closed = len(bins.closed)
        bins.add(revolution, revolution, depth)
        if len(bins.closed) > closed:
            try:
                known = identify(bins.closed, life, errors, Prior(life.coefficient)).coefficient
            except NotIdentifiable:
                continue
            estimates.append((revolution, known))
    if not estimates:
        raise ValueError(say("the test is over before a bin of revolutions is complete"))
    last = estimates[-1][1]
    return {
        "wear_coefficient_mm3_per_Nm": MM3_PER_NM * last.median,
        "wear_coefficient_low_mm3_per_Nm": MM3_PER_NM * last.low,
        "wear_coefficient_high_mm3_per_Nm": MM3_PER_NM * last.high,
        "half_width": 0.5 * (last.high - last.low) / last.median,
        "covered": float(last.low <= true <= last.high),
        "seen_revolution": _seen_from(estimates, life.coefficient),
    }


def _seen_from(estimates: list[tuple[float, Credible]], reference: float) -> float:
    """Return the revolution from which all limits exclude a coefficient; NaN without one."""
    seen = math.nan
    for revolution, known in reversed(estimates):
        if known.low <= reference <= known.high:
            break
        seen = revolution
    return seen


def _measured(depth: np.ndarray, errors: ProbeErrors, seed: int) -> np.ndarray:
    """Return the probes' readings of a depth (n,), m, with errors drawn by a seed."""
    random = np.random.default_rng(seed)
    number = np.arange(1.0, depth.size + 1.0)
    walked = np.sqrt(np.diff(np.log(number), prepend=0.0))
    drift = np.cumsum(random.normal(0.0, errors.drift, depth.size) * walked)
    scale = 1.0 + random.normal(0.0, errors.sensitivity)
    zero = random.normal(0.0, errors.reference)
    read = scale * depth + zero + drift + random.normal(0.0, errors.scatter, depth.size)
    return np.asarray(read)


@lru_cache(maxsize=8)
def _life(
    parameters: Parameters, rpm: float, joint: str, revolutions: int, factor: float
) -> DepthLife:
    """Return the depth by nominal cycles, as far as the test goes; cached for a point."""
    from rigapp_model.identification import depth_life, worn_ahead
    from rigapp_model.wear.life import life
    from rigapp_model.wear.loads import gathered, loads_of_cycle
    from rigapp_model.wear.state import POSITIONS, unworn_state
    from rigapp_model.wear.techniques import solve_of

    angle = 2.0 * np.pi / POINTS * np.arange(POINTS)
    speed = rpm * np.pi / 30.0
    motion, _ = solve_of(joint)(parameters, angle, speed, 0.0, 0.0)
    slip = motion.slip_increments(parameters.joint.pin_radius)
    loads = gathered(loads_of_cycle(motion.force_follower, slip).pressing(), POSITIONS).pressing()
    reached = life(parameters, speed, revolutions * factor, joint, 0.01, evolving=False)
    state = unworn_state(parameters, float(loads.magnitude.max()))
    ahead = worn_ahead(state, loads, DEEPER * float(reached.max_depth[-1]))
    return depth_life(parameters.bushing.wear_coefficient, *ahead)
