"""The wear laws: what is known of each in closed form, and the bound of the error by each."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from fine_reference import fine_life

from rigapp_model.bushing.contact import simpson_weights
from rigapp_model.bushing.ring import ring_of
from rigapp_model.parameters import Parameters, WearLaw
from rigapp_model.wear.coefficient import cycles_at, steady_cycles
from rigapp_model.wear.forces import constant_source
from rigapp_model.wear.front import touched, wear_problem
from rigapp_model.wear.laws import LAWS
from rigapp_model.wear.life import life

SPEED = np.pi
EXAMPLES = {
    "running-in": WearLaw("running-in", excess=4.0, running_in=900.0),
    "pressure-exponent": WearLaw("pressure-exponent", exponent=1.5, reference_pressure=1e6),
    "two-regimes": WearLaw("two-regimes", transition=8e3, beyond=4.0),
}


def by(parameters: Parameters, law: WearLaw) -> Parameters:
    return replace(parameters, bushing=replace(parameters.bushing, law=law))


def test_every_law_of_the_table_but_archard_has_an_example_here() -> None:
    assert set(EXAMPLES) == set(LAWS) - {"archard"}


def test_running_in_is_the_life_of_a_constant_coefficient_on_another_clock(
    parameters: Parameters,
) -> None:
    law = EXAMPLES["running-in"]
    cycles = np.array([0.0, 3.0, 400.0, 5000.0, 1e6])
    assert steady_cycles(law, cycles)[1] == pytest.approx(3.0 * 5.0, rel=2e-3)
    assert steady_cycles(law, cycles)[-1] == pytest.approx(1e6 + 4.0 * 900.0)
    np.testing.assert_allclose(cycles_at(law, steady_cycles(law, cycles)), cycles, atol=2e-6)
    fast = life(by(parameters, law), SPEED, 5000.0, force=110.0)
    plain = life(parameters, SPEED, float(steady_cycles(law, 5000.0)), force=110.0)
    assert fast.cycles[-1] == 5000.0
    assert fast.max_depth[-1] == pytest.approx(plain.max_depth[-1], rel=2e-3)


@pytest.mark.parametrize(("transition", "factor"), [(1e3, 4.0), (1e6, 1.0)])
def test_in_one_regime_only_the_coefficient_is_that_regimes(
    parameters: Parameters, transition: float, factor: float
) -> None:
    law = WearLaw("two-regimes", transition=transition, beyond=4.0)
    found = life(by(parameters, law), SPEED, 2000.0, force=110.0)
    plain = life(parameters, SPEED, 2000.0 * factor, force=110.0)
    assert found.max_depth[-1] == pytest.approx(plain.max_depth[-1], rel=2e-3)


def test_the_reference_pressure_only_scales_the_coefficient_of_a_pressure_exponent(
    parameters: Parameters,
) -> None:
    one, other = (
        life(by(parameters, WearLaw("pressure-exponent", exponent=1.5, reference_pressure=at)),
             SPEED, cycles, force=110.0)
        for at, cycles in ((1e6, 1000.0), (4e6, 2000.0))
    )  # fmt: skip
    assert one.max_depth[-1] == pytest.approx(other.max_depth[-1], rel=2e-3)


@pytest.mark.sampled
@pytest.mark.parametrize("exponent", [0.7, 1.5])
def test_a_pressure_exponent_wears_as_many_small_explicit_steps_say(
    parameters: Parameters, exponent: float
) -> None:
    cycles, steps, force = 100.0, 400, 110.0
    law = WearLaw("pressure-exponent", exponent=exponent, reference_pressure=2e6)
    ring = ring_of(parameters.joint, parameters.bushing.material)
    loads = constant_source(force, parameters.joint).unworn(1)
    coefficient, width = parameters.bushing.wear_coefficient, parameters.joint.bushing_width
    problem = wear_problem(ring, 120, width, coefficient, loads, 0.6)
    front, nodes = problem.unworn(), problem.compliance.nodes
    for _ in range(steps):
        front = touched(problem, front, loads)
        pressure = front.force[0] / simpson_weights(front.surface)[nodes]
        away = front.surface[nodes] - front.pins[0]
        away /= np.hypot(away[:, 0], away[:, 1])[:, None]
        rate = coefficient * loads.slip[0] * pressure**exponent / 2e6 ** (exponent - 1.0)
        surface = front.surface.copy()
        surface[nodes] += (cycles / steps * rate)[:, None] * away
        front = replace(front, surface=surface)
    expected = front.depth(ring.inner).max()
    found = life(by(parameters, law), SPEED, cycles, force=force, tolerance=1e-3)
    assert found.max_depth[-1] == pytest.approx(expected, rel=5e-3)


@pytest.mark.sampled
@pytest.mark.parametrize("law", EXAMPLES.values(), ids=EXAMPLES)
def test_the_bound_of_the_error_holds_for_each_law(parameters: Parameters, law: WearLaw) -> None:
    worn = by(parameters, law)
    rows = np.array([60.0, 300.0, 3000.0])
    clock = steady_cycles(law, rows)
    reference = fine_life(worn, SPEED, clock, "continuous", None, 180, 48, 6, 0.9)[:, -1]
    for tolerance in (3e-3, 3e-2):
        found = life(worn, SPEED, 3000.0, tolerance=tolerance)
        assert found.tolerance_met
        assert abs(found.max_depth[-1] - reference[0]) <= found.estimated_error[-1]
        assert abs(found.worn_area[-1] - reference[1]) <= found.area_error[-1]
        assert any(law.name in note for note in found.notes)


def test_explicit_steps_are_refused_where_their_limit_is_not_known(parameters: Parameters) -> None:
    with pytest.raises(ValueError, match="use implicit steps"):
        life(by(parameters, EXAMPLES["pressure-exponent"]), SPEED, 100.0, method="explicit")
