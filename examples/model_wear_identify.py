"""The wear coefficient from measured depths: one virtual test, and five specimens together.

Run with ``python examples/model_wear_identify.py``; for recorded tests: ``rigapp identify FILE``.
"""

from __future__ import annotations

import numpy as np

from rigapp_model.identification import (
    Bins,
    DepthLife,
    Identification,
    Prior,
    ProbeErrors,
    depth_life,
    estimate_of,
    identify,
    pairing_of,
    remaining,
    worn_ahead,
)
from rigapp_model.identification.words import sentence
from rigapp_model.joints import continuous_contact
from rigapp_model.parameters import Bushing, Joint, Material, Mechanism, Parameters, Spring
from rigapp_model.wear.loads import gathered, loads_of_cycle
from rigapp_model.wear.state import POSITIONS, unworn_state

PARAMETERS = Parameters(
    Mechanism(
        0.0762, 0.4045, 204e-6, 0.2032, 0.8175, 5500e-6, 5.54871, spring=Spring(525.0, 0.3174952)
    ),
    Joint(9.5e-3, 10e-3, 20e-3, 13.1e-3),
    Bushing(Material(500e6, 0.38), density=2200.0, wear_coefficient=5.05e-13),
    pin=Material(206e9, 0.29),
)
ANGLES = 2.0 * np.pi * np.arange(720) / 720
PROBES = ProbeErrors(sensitivity=0.01, reference=0.3e-6, drift=0.2e-6, scatter=0.4e-6)
"""As a calibration record states them: relative, m, m per root of ln n, m."""
REVOLUTIONS = 4000
END = 150e-6
"""The test ends at this depth, m."""
MM3_PER_NM = 1e9


def life() -> DepthLife:
    """Return the depth of the model's bushing by nominal cycles: it serves every coefficient."""
    motion = continuous_contact(PARAMETERS.mechanism, PARAMETERS.joint, ANGLES, np.pi).motion
    slip = motion.slip_increments(PARAMETERS.joint.pin_radius)
    loads = gathered(loads_of_cycle(motion.force_follower, slip).pressing(), POSITIONS).pressing()
    state = unworn_state(PARAMETERS, float(loads.magnitude.max()))
    return depth_life(PARAMETERS.bushing.wear_coefficient, *worn_ahead(state, loads, 2.0 * END))


def test_of(life: DepthLife, coefficient: float, seed: int) -> Identification:
    """Return what a virtual test tells whose bushing wears by a coefficient, m^2/N."""
    random = np.random.default_rng(seed)
    number = np.arange(1.0, REVOLUTIONS + 1.0)
    depth = life.course.at(coefficient / life.coefficient * number)[0]
    seen = depth * (1.0 + random.normal(0.0, PROBES.sensitivity))
    seen += random.normal(0.0, PROBES.reference) + random.normal(0.0, PROBES.scatter, number.size)
    bins = Bins()
    for revolution, depth in zip(number, seen, strict=True):
        bins.add(revolution, revolution, depth)
    return identify(bins, life, PROBES, Prior(life.coefficient))


def main() -> dict[str, float]:
    """Print and return a coefficient with its limits, what remains, and the next specimen's."""
    model = life()
    known = test_of(model, 1.1 * model.coefficient, seed=1)
    print(sentence(known))
    left = remaining(known, model, END).revolutions
    scatter = np.random.default_rng(7).normal(0.0, 0.2, 5)
    tests = [test_of(model, k, n) for n, k in enumerate(1.1 * model.coefficient * np.exp(scatter))]
    pairing = pairing_of([estimate_of(test, "one record") for test in tests], "five virtual tests")
    result = {
        "coefficient_mm3_per_Nm": MM3_PER_NM * known.coefficient.median,
        "low_mm3_per_Nm": MM3_PER_NM * known.coefficient.low,
        "high_mm3_per_Nm": MM3_PER_NM * known.coefficient.high,
        "remaining_revolutions": float("nan") if left is None else left.median,
        "next_low_mm3_per_Nm": MM3_PER_NM * pairing.next.low,
        "next_high_mm3_per_Nm": MM3_PER_NM * pairing.next.high,
        "scatter_factor": pairing.scatter.median,
    }
    for name, value in result.items():
        print(f"{name:<24} {value:.6g}")
    return result


if __name__ == "__main__":
    main()
