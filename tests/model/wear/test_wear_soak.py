"""Many random joints: lives of two tolerances agree within their bounds, whatever the numbers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rigapp_model.parameters import Bushing, Joint, Material, Parameters, Spring
from rigapp_model.wear.life import life


def random_joint(parameters: Parameters, rng: np.random.Generator) -> Parameters:
    """Return a joint of any size, fit, material and wear, with a spring that keeps tension."""
    radius = 10.0 ** rng.uniform(-2.5, -1.5)
    gap = radius * 10.0 ** rng.uniform(-3.5, -1.3)
    spring = Spring(525.0, 0.2794 + rng.uniform(20.0, 100.0) / 525.0)
    return Parameters(
        replace(parameters.mechanism, spring=spring),
        Joint(radius - gap, radius, radius * rng.uniform(1.2, 3.0), radius, rng.choice([0.0, 0.1])),
        Bushing(Material(10.0 ** rng.uniform(8.5, 11.3), rng.uniform(0.0, 0.49)), 2000.0, 1e-15),
        parameters.pin,
    )


@pytest.mark.soak
@pytest.mark.timeout(1200)
@pytest.mark.parametrize("seed", range(40))
def test_lives_of_two_tolerances_agree(parameters: Parameters, seed: int) -> None:
    rng = np.random.default_rng(seed)
    chosen = random_joint(parameters, rng)
    cycles = int(10.0 ** rng.uniform(1.0, 5.0))
    # A wear coefficient that makes the depth a thousandth to once the clearance.
    depth = chosen.joint.clearance * 10.0 ** rng.uniform(-3.0, 0.0)
    slip = 2.0 * np.pi * chosen.joint.pin_radius
    arc = 2.0 * np.sqrt(2.0 * depth / chosen.joint.clearance) * chosen.joint.pin_radius
    coefficient = depth * min(arc, chosen.joint.pin_radius) * chosen.joint.bushing_width
    coefficient /= slip * 60.0 * cycles
    chosen = replace(chosen, bushing=replace(chosen.bushing, wear_coefficient=coefficient))
    technique = ("perfect", "continuous")[seed % 2]
    loose = life(chosen, np.pi, cycles, technique, 1e-2)
    tight = life(chosen, np.pi, cycles, technique, 2e-3)
    rows = np.intersect1d(loose.cycles, tight.cycles)[1:]
    assert rows[-1] == cycles
    one, two = (np.searchsorted(found.cycles, rows) for found in (loose, tight))
    apart = np.abs(loose.max_depth[one] - tight.max_depth[two])
    assert np.all(apart <= loose.estimated_error[one] + tight.estimated_error[two])
    assert np.all(np.diff(tight.max_depth) > 0.0)
