"""How much of a wrong modulus reaches a reading of the depth, by lives of two moduli."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from plant_revolutions import PARAMETERS

from rigapp.twin.approach import MeanApproach
from rigapp.twin.identifying import MODULUS_SHARE, LifeAhead
from rigapp_model.wear.loads import constant_load

FIFTH = 1.2
CYCLES = (100.0, 300.0, 1000.0, 3000.0)


@cache
def life_with(factor: float, force: float) -> LifeAhead:
    """Return the life of the example's bushing with so many times its modulus under a load, N."""
    bushing = PARAMETERS.bushing
    stiffer = replace(bushing.material, youngs_modulus=factor * bushing.material.youngs_modulus)
    parameters = replace(PARAMETERS, bushing=replace(bushing, material=stiffer))
    ahead = LifeAhead(parameters, constant_load(force, parameters.joint.pin_radius))
    while ahead.progress[-1] < CYCLES[-1] and not ahead.failed:
        ahead.step()
    return ahead


@pytest.mark.sampled
@pytest.mark.parametrize(("factor", "force"), [(FIFTH, 50.0), (1.0 / FIFTH, 110.0), (FIFTH, 250.0)])
def test_a_wrong_modulus_moves_a_reading_by_its_stated_share(factor: float, force: float) -> None:
    """Read the depth of one bushing with the approach of another, as the probes' zero leaves it."""
    true, taken = life_with(factor, force), life_with(1.0, force)
    assert not true.failed
    assert not taken.failed
    approach = MeanApproach(np.array(taken.depth), np.array(taken.approach))
    shares = []
    for cycles in CYCLES:
        seen = np.interp(cycles, true.progress, np.add(true.depth, true.approach))
        read = approach.depth_of(float(seen) - true.approach[0] + approach.at(0.0))
        expected = float(np.interp(cycles, taken.progress, taken.depth))
        change = approach.gain(expected) * (approach.at(0.0) - approach.at(expected))
        shares.append((read - expected) / (np.log(factor) * change))
    assert np.mean(shares) == pytest.approx(MODULUS_SHARE, abs=0.1)
    assert min(shares) > 0.5
    assert max(shares) < 0.8
