"""The condensed contact against a general finite element library on the same mesh."""

from __future__ import annotations

import full_ring
import numpy as np
import pytest

from rigapp_model.bushing.contact import simpson_weights
from rigapp_model.bushing.ring import pressure_distribution


@pytest.mark.sampled
@pytest.mark.parametrize("sectors", [120, 180])
def test_condensed_contact_is_the_full_one(ring, sectors: int) -> None:
    force = 110.0 / 0.0131
    levels = ring.mesh(sectors).radii(ring.inner, ring.outer)
    angle, nodal, pin = full_ring.solve_full(
        ring.inner, ring.outer, ring.pin_radius, 500e6, 0.38, force, sectors, levels
    )
    found = pressure_distribution(ring, (force, 0.0), sectors=sectors)
    pressure = nodal / simpson_weights(ring.circle(sectors))
    assert angle == pytest.approx(found.angle, abs=1e-9)
    peak = float(found.pressure.max())
    assert np.abs(pressure - found.pressure).max() < 1e-4 * peak
    assert found.pin[0] == pytest.approx(pin, abs=1e-10)
