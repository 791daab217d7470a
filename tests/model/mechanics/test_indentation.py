"""How deep a pin sinks by each contact law, and what each gives back of an impact's speed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rigapp_model.bushing.ring import pressure_distribution, ring_of
from rigapp_model.contact import impact_laws as kernel
from rigapp_model.contact import indentation as laws
from rigapp_model.contact.impact import contact_cycle
from rigapp_model.contact.impact_system import clearance_system
from rigapp_model.contact_law import ContactModel
from rigapp_model.errors import ModelError
from rigapp_model.parameters import Joint, Material, Mechanism, Spring
from rigapp_model.restitution import CONTACT_LAWS, exact_damping, restitution_of

JOINT = Joint(9.5e-3, 10e-3, 20e-3, 13.1e-3)
POLYMER, STEEL, RIGID = Material(500e6, 0.38), Material(206e9, 0.29), Material(1e18, 0.3)
CASE_B = Mechanism(0.0762, 0.4045, 204e-6, 0.2032, 0.8175, 5500e-6, 5.54871, 0.0, (0.0, 0.0),
                   Spring(525.0, 0.2794 + 20.0 / 525.0))  # fmt: skip


@pytest.mark.sampled(every=3)
@pytest.mark.parametrize("width", [3e-3, 13.1e-3, 50e-3])
@pytest.mark.parametrize("material", [POLYMER, STEEL])
def test_the_default_law_is_as_stiff_as_the_elements_at_every_width(
    material: Material, width: float
) -> None:
    joint = replace(JOINT, bushing_width=width)
    law = laws.elements(joint, material, RIGID)
    ring = ring_of(joint, material)
    for force in (2.0, 20.0, 97.0, 700.0):
        if force / width > 0.4e-3 * ring.modulus:
            continue
        found = pressure_distribution(ring, (force / width, 0.0))
        sunk = float(found.pin[0]) - ring.clearance
        assert float(law.depth(force)) == pytest.approx(sunk, rel=4e-3)
        assert float(law.force(sunk)) == pytest.approx(force, rel=4e-3)


def test_three_widths_sink_by_three_depths() -> None:
    # The sphere's law gives 43.3 um at each width.
    for width, depth in ((3e-3, 53.9e-6), (13.1e-3, 17.55e-6), (50e-3, 5.98e-6)):
        joint = replace(JOINT, bushing_width=width)
        system = clearance_system(CASE_B, joint, POLYMER, STEEL, np.pi)
        assert system.penetration_under(97.0) == pytest.approx(depth, rel=5e-3)
        sphere = clearance_system(CASE_B, joint, POLYMER, STEEL, np.pi, ContactModel("flores"))
        assert sphere.penetration_under(97.0) == pytest.approx(43.3e-6, rel=2e-2)
        cycle = contact_cycle(system)
        at = int(np.argmax(cycle.normal_force))
        assert cycle.penetration[at] == pytest.approx(
            system.penetration_under(float(cycle.normal_force[at])), rel=2e-2
        )


def test_the_published_laws_are_their_formulas() -> None:
    modulus = laws.contact_modulus(POLYMER, STEEL)
    assert modulus == pytest.approx(1.0 / ((1 - 0.38**2) / 500e6 + (1 - 0.29**2) / 206e9))
    depth = np.geomspace(1e-8, 1e-3, 12)
    liu = 0.5 * np.pi * modulus * 13.1e-3 * depth * np.sqrt(depth / (2.0 * (0.5e-3 + depth)))
    np.testing.assert_allclose(laws.liu(JOINT, POLYMER, STEEL).force(depth), liu, rtol=1e-6)
    exponent = (0.0151 * 0.5 + 1.151) * 0.5**-0.005
    stiff = (0.965 * 0.5 + 0.0965) * 13.1 * modulus * 1e-6 / 0.5
    np.testing.assert_allclose(
        laws.pereira(JOINT, POLYMER, STEEL).force(depth), stiff * (1e3 * depth) ** exponent, 1e-6
    )
    close = replace(JOINT, pin_radius=10e-3 - 2e-6)
    with pytest.raises(ModelError, match=r"fitted from 5e-06 to 0\.01 m; choose elements"):
        laws.pereira(close, POLYMER, STEEL)


def test_pereiras_branches_meet_where_one_ends() -> None:
    """A printed 0.75 mm would leave a step of 2.4 % in the exponent, 8 % in the force at 50 um."""
    at = 0.34954e-3
    below, above = (
        laws.pereira(replace(JOINT, pin_radius=10e-3 - at * part), POLYMER, STEEL).force(50e-6)
        for part in (1.0 - 1e-7, 1.0 + 1e-7)
    )
    assert float(below) == pytest.approx(float(above), rel=5e-4)


def test_the_kernel_reads_the_curve_as_it_is() -> None:
    system = clearance_system(CASE_B, JOINT, POLYMER, STEEL, np.pi)
    law = system.elastic
    assert isinstance(law, laws.Indentation)
    for depth in np.geomspace(1e-18, 5e-3, 60):
        force = kernel.elastic_force(system.vector, depth)
        assert force == pytest.approx(float(law.force(depth)), rel=1e-12)
        assert float(law.depth(force)) == pytest.approx(depth, rel=1e-9)


@pytest.mark.parametrize("power", [1.0, 1.15, 1.5])
@pytest.mark.parametrize("wanted", [0.3, 0.5, 0.8, 0.95])
def test_the_damping_gives_the_restitution_back_whatever_the_elastic_law_is(
    power: float, wanted: float
) -> None:
    for factor, expected in (
        (exact_damping(wanted), wanted),
        (0.75 * (1.0 - wanted**2), restitution_of(0.75 * (1.0 - wanted**2))),
    ):

        def leaves(t, y):  # type: ignore[no-untyped-def]
            return y[0] if t > 1e-3 else 1.0

        leaves.terminal = True  # type: ignore[attr-defined]
        run = solve_ivp(
            lambda t, y, a=factor: (y[1], -max(y[0], 0.0) ** power * (1.0 + a * y[1])),
            (0.0, 100.0), (0.0, 1.0), "DOP853", rtol=1e-10, atol=1e-13, events=leaves,
        )  # fmt: skip
        assert -run.y[1, -1] == pytest.approx(expected, abs=1e-5)


def test_a_law_that_misses_its_restitution_says_so() -> None:
    assert ContactModel("elements", 0.3).sentence() == ""
    assert ContactModel("lankarani-nikravesh", 0.95).sentence() == ""
    words = ContactModel("lankarani-nikravesh", 0.5).sentence()
    assert "gives a restitution of 0.73 where 0.50 is set" in words
    assert "0.47 where 0.50" in ContactModel("flores", 0.5).sentence()
    assert next(iter(CONTACT_LAWS)) == Joint(1e-3, 2e-3, 3e-3, 1e-3).contact_law
    for law in CONTACT_LAWS.values():
        assert restitution_of(law.damping(1.0)) == 1.0
        assert 0.0 < restitution_of(law.damping(0.01)) < 1.0
