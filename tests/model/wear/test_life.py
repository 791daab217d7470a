"""Whole lives: reference numbers, honest errors, the three joints, and the live state."""

from __future__ import annotations

from dataclasses import replace

import fine_reference
import numpy as np
import pytest

from rigapp_model.bushing.contact import ContactError
from rigapp_model.errors import ModelError, OutOfTime
from rigapp_model.joints import continuous_contact
from rigapp_model.parameters import Bushing, Joint, Material, Mechanism, Parameters, Spring
from rigapp_model.wear.front import WornThrough
from rigapp_model.wear.life import Life, below_archard, life, row_cycles
from rigapp_model.wear.state import unworn_state

RPM30 = np.pi


def test_constant_force_follows_the_reference(parameters, wear_reference) -> None:
    found = life(parameters, RPM30, 21377, tolerance=1e-3, force=110.0)
    for cycles, depth, area in wear_reference[:, :3]:
        row = int(np.flatnonzero(found.cycles == cycles)[0])
        bound = 1e-3 if cycles >= 1000 else 5e-3
        assert 1e3 * found.max_depth[row] == pytest.approx(depth, rel=bound)
        assert 1e6 * found.worn_area[row] == pytest.approx(area, rel=bound)
    assert found.worn_mass[-1] == pytest.approx(found.worn_area[-1] * 0.0131 * 2200.0)
    assert found.estimated_error[-1] <= 1e-3 * found.max_depth[-1]
    assert found.tolerance_met
    assert found.complete
    np.testing.assert_allclose(found.mass_error, found.area_error * 0.0131 * 2200.0, rtol=1e-12)
    assert found.notes == ()
    assert np.all(np.diff(found.max_depth) > 0.0)
    assert np.all(np.diff(found.peak_pressure) < 0.0)
    assert found.depth.max() == pytest.approx(found.max_depth[-1], rel=1e-9)
    assert found.angle[[0, -1]] == pytest.approx([-np.pi, np.pi])
    assert found.depth[np.argmin(np.abs(found.angle))] == found.depth.max()


def steel(parameters: Parameters) -> Parameters:
    """Return the paper's steel bushing (section 4.3)."""
    return replace(parameters, bushing=Bushing(Material(206e9, 0.29), 7850.0, 1e-17))


def thin(parameters: Parameters) -> Parameters:
    """Return a thin, stiffer, nearly incompressible bushing."""
    return replace(
        parameters,
        joint=Joint(0.0095, 0.010, 0.012, 0.0131),
        bushing=Bushing(Material(2e9, 0.47), 2200.0, 1e-13),
    )


def close(parameters: Parameters) -> Parameters:
    """Return a close fit."""
    return replace(parameters, joint=Joint(0.00995, 0.010, 0.020, 0.0131))


def rubbing(parameters: Parameters) -> Parameters:
    """Return a joint with friction."""
    return replace(parameters, joint=replace(parameters.joint, friction_coefficient=0.13))


CASES = {
    "constant": (None, 21377, "perfect", 110.0, (360, 1, 8, 1.2)),
    "early": (None, 30, "perfect", 110.0, (720, 1, 8, 0.5)),
    "continuous": (None, 3000, "continuous", None, (240, 12, 4, 0.9)),
    "steel, constant": (steel, 23000, "perfect", 97.0, (4608, 1, 8, 0.15)),
    "steel, continuous": (steel, 23000, "continuous", None, (2880, 16, 4, 0.1)),
    "thin": (thin, 5000, "continuous", None, (240, 12, 4, 0.9)),
    "close": (close, 500, "continuous", None, (120, 12, 4, 1.6)),
    "friction": (rubbing, 2000, "perfect", None, (216, 12, 4, 0.9)),
}


@pytest.mark.sampled(every=3)
@pytest.mark.parametrize("case", CASES)
def test_error_reported_is_not_below_the_true_one(parameters, case: str) -> None:
    change, cycles, technique, force, fine = CASES[case]
    chosen = change(parameters) if change else parameters
    rows = row_cycles(cycles)
    depth, area = fine_reference.fine_life(chosen, RPM30, rows, technique, force, *fine)
    for tolerance in (1e-2, 2e-3):
        found = life(chosen, RPM30, cycles, technique, tolerance, force)
        at = np.searchsorted(found.cycles, rows)
        assert found.cycles[at] == pytest.approx(rows)
        true = np.abs(found.max_depth[at] - depth)
        assert np.all(true <= found.estimated_error[at]), case
        assert np.all(np.abs(found.worn_area[at] - area) <= found.area_error[at]), case
        assert found.estimated_error[-1] <= tolerance * found.max_depth[-1]
        assert found.tolerance_met


@pytest.mark.sampled
@pytest.mark.parametrize("case", ["constant", "continuous", "thin", "close", "friction"])
def test_explicit_steps_agree_with_implicit_ones_within_their_errors(parameters, case: str) -> None:
    change, cycles, technique, force, _ = CASES[case]
    chosen = change(parameters) if change else parameters
    cycles = min(cycles, 1000)
    fine = life(chosen, RPM30, cycles, technique, 1e-3, force)
    half = life(chosen, RPM30, cycles, technique, 1e-2, force, method="explicit")
    assert half.extrapolation is not None
    limit = half.extrapolation.limit
    assert half.extrapolation.step == 0.5 * limit
    most = life(chosen, RPM30, cycles, technique, 1e-2, force, method="explicit", step=limit)
    for found in (half, most):
        at = np.searchsorted(fine.cycles, found.cycles)
        assert found.cycles == pytest.approx(fine.cycles[at])
        off = np.abs(found.max_depth - fine.max_depth[at])
        assert np.all(off <= found.estimated_error + fine.estimated_error[at])
        off = np.abs(found.worn_area - fine.worn_area[at])
        assert np.all(off <= found.area_error + fine.area_error[at])
        assert np.all(found.estimated_error[1:] > 0.0)
    assert most.steps < half.steps
    # Longer steps are less exact, and that is told.
    assert most.estimated_error[-1] > half.estimated_error[-1]


def test_explicit_life_goes_on_where_separate_bodies_are_refreshed(parameters) -> None:
    found = life(parameters, RPM30, 1500, "contact", 1e-2, method="explicit")
    joined = life(parameters, RPM30, 1500, "continuous", 1e-2)
    assert found.clearance[-1] == pytest.approx(joined.clearance[-1], rel=3e-3)
    assert abs(found.max_depth[-1] - joined.max_depth[-1]) <= found.estimated_error[-1]


def test_an_explicit_life_ends_where_time_runs_out(parameters) -> None:
    def tell(part: float) -> None:
        if part > 0.7:
            raise OutOfTime

    found = life(
        parameters, RPM30, 500, tolerance=1e-2, force=110.0, progress=tell, method="explicit"
    )
    assert not found.complete
    assert 350.0 < found.cycles[-1] < 350.0 + 20.0
    whole = life(parameters, RPM30, 500, tolerance=1e-2, force=110.0, method="explicit")
    np.testing.assert_array_equal(found.max_depth[:-1], whole.max_depth[: len(found.cycles) - 1])
    assert found.steps < whole.steps
    assert "Time ran out after" in found.notes[-1]


def test_bed_of_springs_is_low_in_early_pressure_and_right_at_the_end(
    parameters, wear_reference
) -> None:
    found = life(parameters, RPM30, 21377, tolerance=1e-3, force=110.0, contact="winkler")
    elastic = life(parameters, RPM30, 21377, tolerance=1e-3, force=110.0)
    assert found.peak_pressure[0] / elastic.peak_pressure[0] == pytest.approx(0.74, abs=0.01)
    # The worn area follows the force, whatever the elasticity; the depth only in the end.
    early = int(np.flatnonzero(found.cycles == 10)[0])
    assert 1e3 * found.max_depth[early] < 0.8 * wear_reference[0, 1]
    assert 1e3 * found.max_depth[-1] == pytest.approx(wear_reference[-1, 1], rel=2e-3)
    assert 1e6 * found.worn_area[-1] == pytest.approx(wear_reference[-1, 2], rel=1e-3)
    assert found.peak_pressure[-1] == pytest.approx(elastic.peak_pressure[-1], rel=5e-3)
    assert "2.182 MPa is 26% below the 2.94" in found.notes[0]
    for coarse in (
        life(parameters, RPM30, 21377, tolerance=1e-2, force=110.0, contact="winkler"),
        life(
            parameters,
            RPM30,
            21377,
            tolerance=1e-2,
            force=110.0,
            contact="winkler",
            method="explicit",
        ),
    ):
        at = [int(np.flatnonzero(coarse.cycles == row)[0]) for row in row_cycles(21377)]
        same = [int(np.flatnonzero(found.cycles == row)[0]) for row in row_cycles(21377)]
        off = np.abs(coarse.max_depth[at] - found.max_depth[same])
        assert np.all(off <= coarse.estimated_error[at] + found.estimated_error[same])


def test_worn_outboard_spring_lowers_force_and_wear(parameters) -> None:
    constant = life(parameters, RPM30, 20000, "perfect", 2e-3)
    evolving = life(parameters, RPM30, 20000, "continuous", 2e-3)
    assert np.ptp(constant.mean_force) < 1e-9 * constant.mean_force[0]
    assert np.all(constant.clearance == 0.0)
    assert evolving.clearance[0] == pytest.approx(0.5e-3)
    assert evolving.clearance[-1] == pytest.approx(0.5e-3 + evolving.max_depth[-1], rel=1e-3)
    assert np.all(np.diff(evolving.mean_force) < 0.0)
    drop = constant.max_depth[-1] - evolving.max_depth[-1]
    assert 0.001 < drop / constant.max_depth[-1] < 0.02
    assert drop > 0.5 * (constant.estimated_error[-1] + evolving.estimated_error[-1])
    assert evolving.notes == ()


def test_separate_bodies_agree_where_contact_holds(parameters) -> None:
    joined = life(parameters, RPM30, 8000, "continuous", 1e-2)
    apart = life(parameters, RPM30, 8000, "contact", 1e-2)
    assert apart.max_depth[-1] == pytest.approx(joined.max_depth[-1], rel=3e-3)
    assert apart.clearance[-1] == pytest.approx(joined.clearance[-1], rel=3e-3)
    assert apart.estimated_error[-1] >= abs(apart.max_depth[-1] - joined.max_depth[-1]) / 3.0
    assert apart.notes == ()


@pytest.mark.long
def test_losing_contact_is_said(parameters, monkeypatch) -> None:
    monkeypatch.setattr("rigapp_model.wear.impact_forces.MOST_REVOLUTIONS", 32)
    loose = replace(parameters, mechanism=replace(parameters.mechanism, spring=None))
    found = life(loose, RPM30, 300, "continuous", 5e-2)
    assert any("Continuous contact does not hold" in note for note in found.notes)
    assert np.count_nonzero(found.depth[np.abs(found.angle) > 2.5] > 0.0) > 5
    apart = life(loose, RPM30, 50, "contact", 1e-1)
    assert any("touch only" in note for note in apart.notes)
    strict = life(loose, RPM30, 50, "continuous", 5e-4)
    missed = [note for note in strict.notes if "exceeds the tolerance of 0.0005" in note]
    assert len(missed) == (0 if strict.tolerance_met else 1)
    assert strict.tolerance_met == (strict.estimated_error[-1] <= 5e-4 * strict.max_depth[-1])


def unsprung_lives(
    parameters: Parameters, number: int, cycles: float, tolerance: float
) -> list[Life]:
    """Return lives without spring whose pin radius differs by a millionth of a micrometre."""
    loose = replace(parameters, mechanism=replace(parameters.mechanism, spring=None))
    radii = [loose.joint.pin_radius + 1e-12 * part for part in range(number)]
    return [
        life(
            replace(loose, joint=replace(loose.joint, pin_radius=r)),
            RPM30,
            cycles,
            "contact",
            tolerance,
        )
        for r in radii
    ]


@pytest.mark.long
@pytest.mark.parametrize(
    ("number", "cycles"),
    [(2, 300), pytest.param(10, 300, marks=[pytest.mark.soak, pytest.mark.timeout(3600)])],
)
def test_chaotic_lives_agree_within_their_stated_errors(
    parameters, number: int, cycles: int, monkeypatch
) -> None:
    if number < 10:
        monkeypatch.setattr("rigapp_model.wear.impact_forces.MOST_REVOLUTIONS", 32)
    found = unsprung_lives(parameters, number, cycles, 0.1)
    for values, errors in (
        ([f.max_depth[-1] for f in found], [f.estimated_error[-1] for f in found]),
        ([f.worn_area[-1] for f in found], [f.area_error[-1] for f in found]),
    ):
        mean = np.mean(values)
        assert np.ptp(values) > 0.0
        assert np.all(np.abs(np.array(values) - mean) <= errors)
        assert np.max(errors) < 0.45 * mean
    # Sorted by direction, twice and four times as many positions give the same depth.
    # Counted by the relative rotation alone it would be less: the pin slides further as it travels.
    assert found[0].max_depth[-1] == pytest.approx(4.15e-7, rel=0.15)


def test_wear_follows_the_force_to_the_other_wall(parameters) -> None:
    pushed = life(parameters, RPM30, 1000, tolerance=1e-2, force=-110.0)
    pulled = life(parameters, RPM30, 1000, tolerance=1e-2, force=110.0)
    assert pushed.max_depth[-1] == pytest.approx(pulled.max_depth[-1], rel=1e-6)
    assert abs(pushed.angle[np.argmax(pushed.depth)]) == pytest.approx(np.pi)
    assert pushed.depth[0] == pushed.depth[-1]


def test_speed_sets_force_and_sense_does_not_matter(parameters) -> None:
    forward = life(parameters, 2.0, 500, "continuous", 1e-2)
    backward = life(parameters, -2.0, 500, "continuous", 1e-2)
    assert backward.max_depth[-1] == pytest.approx(forward.max_depth[-1], rel=1e-4)
    faster = life(parameters, 6.0, 500, "continuous", 1e-2)
    assert faster.mean_force[-1] != pytest.approx(forward.mean_force[-1], rel=1e-2)


def test_without_wear_coefficient_nothing_is_lost(parameters) -> None:
    hard = replace(parameters, bushing=replace(parameters.bushing, wear_coefficient=0.0))
    for method in ("implicit", "explicit"):
        found = life(hard, RPM30, 1000, "perfect", 1e-2, method=method)
        assert np.all(found.max_depth == 0.0)
        assert np.all(found.worn_area == 0.0)
        assert found.peak_pressure[-1] > 1e6
        assert found.tolerance_met


def test_rows_are_round_and_end_with_the_life() -> None:
    assert list(row_cycles(21377)) == [10, 30, 100, 300, 1000, 3000, 10000, 21377]
    assert list(row_cycles(1)) == [1]
    assert list(row_cycles(10)) == [1, 3, 10]


@pytest.mark.parametrize("cycles", [3, 30, 300])
def test_coarse_lives_wear_no_less_than_the_force_alone(parameters, cycles: int) -> None:
    found = life(parameters, RPM30, cycles, tolerance=0.1, force=110.0)
    slip = 2.0 * np.pi * parameters.joint.pin_radius
    least = 5.05e-13 * slip * cycles * 110.0 / parameters.joint.bushing_width
    assert found.worn_area[-1] > least
    fine = life(parameters, RPM30, cycles, tolerance=1e-3, force=110.0)
    assert abs(found.worn_area[-1] - fine.worn_area[-1]) <= found.area_error[-1]
    assert found.worn_area[-1] == pytest.approx(fine.worn_area[-1], rel=1e-3)


def test_less_wear_than_possible_is_said() -> None:
    assert below_archard(1.0, 0.02, 1.01) == []
    (sentence,) = below_archard(0.974, 0.01, 1.0)
    assert "0.9740 of what Archard's law makes of the force" in sentence
    assert "smaller tolerance" in sentence


def test_a_life_ends_where_time_runs_out(parameters) -> None:
    def tell(part: float) -> None:
        if part > 0.2:
            raise OutOfTime

    whole = life(parameters, RPM30, 500, tolerance=1e-2, force=110.0)
    found = life(parameters, RPM30, 500, tolerance=1e-2, force=110.0, progress=tell)
    assert not found.complete
    assert 100.0 < found.cycles[-1] < 500.0
    rows = len(found.cycles)
    np.testing.assert_array_equal(found.max_depth, whole.max_depth[:rows])
    assert f"Time ran out after {found.cycles[-1]:.6g} of 500 cycles" in found.notes[-1]

    def at_once(part: float) -> None:
        raise OutOfTime

    with pytest.raises(OutOfTime):
        life(parameters, RPM30, 500, tolerance=1e-2, force=110.0, progress=at_once)


def test_progress_is_told(parameters) -> None:
    parts: list[float] = []
    life(parameters, RPM30, 500, tolerance=1e-2, force=50.0, progress=parts.append)
    assert parts[0] == 0.0
    assert parts[-1] == 1.0
    assert parts == sorted(parts)


@pytest.mark.parametrize(
    ("changes", "error", "words"),
    [
        ({"cycles": 0}, ModelError, "cycles"),
        ({"tolerance": 0.0}, ModelError, "tolerance"),
        ({"speed": 0.0}, ModelError, "stationary crank"),
        ({"technique": "glued"}, ModelError, "perfect, continuous or contact"),
        ({"force": 0.0}, ModelError, "force"),
        ({"force": 1e5}, ContactError, "through the wall|found no balance|linear elasticity"),
        ({"force": 110.0, "cycles": 10**8}, WornThrough, "worn through"),
    ],
)
def test_impossible_lives_are_refused_in_words(parameters, changes, error, words) -> None:
    arguments = {"speed": RPM30, "cycles": 100, "technique": "perfect", "tolerance": 1e-2}
    arguments |= changes
    with pytest.raises(error, match=words):
        life(parameters, **arguments)


def test_live_state_follows_the_life(parameters) -> None:
    whole = life(parameters, RPM30, 3000, "continuous", 1e-3)
    state = unworn_state(parameters, 97.0)
    angle = 2.0 * np.pi * np.arange(360) / 360
    assert state.max_depth == 0.0
    assert state.estimated_error == 0.0
    done = 0
    for cycles in (10, 90, 400, 500, 500, 500, 500, 500):
        motion = continuous_contact(
            parameters.mechanism, parameters.joint, angle, RPM30, 0.0, state.clearance
        ).motion
        slip = motion.slip_increments(parameters.joint.pin_radius)
        state = state.advance(motion.force_follower, slip, cycles)
        done += cycles
        assert state.cycles == done
    assert abs(state.max_depth - whole.max_depth[-1]) <= state.estimated_error
    assert state.max_depth == pytest.approx(whole.max_depth[-1], rel=5e-3)
    assert state.worn_mass == pytest.approx(whole.worn_mass[-1], rel=5e-3)
    assert state.depth_at_contact == pytest.approx(state.max_depth, rel=1e-3)
    assert state.mean_force == pytest.approx(whole.mean_force[-1], rel=1e-2)
    angles, depths = state.profile()
    assert depths.max() == pytest.approx(state.max_depth, rel=1e-9)
    assert abs(angles[np.argmax(depths)]) < 0.02


def test_live_state_rests_without_force(parameters) -> None:
    state = unworn_state(parameters, 97.0)
    still = state.advance(np.zeros((2, 8)), np.full(8, 1e-3), 10.0)
    assert still.cycles == 10.0
    assert still.max_depth == 0.0
    with pytest.raises(ModelError, match="typical force"):
        unworn_state(parameters, 0.0)


def test_a_follower_in_compression_wears_the_other_wall_and_its_clearance_grows(
    parameters,
) -> None:
    pressed = replace(
        parameters,
        mechanism=replace(parameters.mechanism, spring=Spring(525.0, 0.127 - 20.0 / 525.0)),
    )
    found = life(pressed, RPM30, 5000.0, "continuous", 1e-2)
    assert abs(abs(found.angle[np.argmax(found.depth)]) - np.pi) < 0.02
    grown = found.clearance - pressed.joint.clearance
    np.testing.assert_allclose(grown[1:], found.max_depth[1:], rtol=0.02)
    assert found.mean_force[-1] < found.mean_force[0]
    assert "compression at all crank angles" in found.notes[0]


@pytest.mark.parametrize("mass", [1e-300, 1e-30, 1e-9])
def test_a_mechanism_of_next_to_no_mass_is_refused_in_words(parameters, mass: float) -> None:
    weightless = Mechanism(0.0762, mass, mass, 0.2032, mass, mass, mass)
    for technique in ("perfect", "continuous"):
        with pytest.raises(ModelError, match="too small for a contact that elements can see"):
            life(replace(parameters, mechanism=weightless), RPM30, 100, technique, 1e-1)
    sprung = replace(weightless, spring=parameters.mechanism.spring)
    with pytest.raises(ModelError, match="use the technique continuous"):
        life(replace(parameters, mechanism=sprung), RPM30, 100, "contact", 1e-1)


@pytest.mark.parametrize("contact", ["finite-element", "winkler"])
@pytest.mark.parametrize("step", [None, 10.0])
def test_nothing_wears_without_a_wear_coefficient(
    parameters, step: float | None, contact: str
) -> None:
    unworn = replace(parameters, bushing=replace(parameters.bushing, wear_coefficient=0.0))
    found = life(
        unworn, RPM30, 100, "continuous", 1e-2, method="explicit", step=step, contact=contact
    )
    assert found.max_depth[-1] == found.worn_area[-1] == found.estimated_error[-1] == 0.0
    assert found.tolerance_met


@pytest.mark.long
def test_the_stated_error_bounds_every_row_of_a_stiff_wide_bushing(parameters) -> None:
    """Its early rows had been stated 1.3 times too well: few positions, narrow contact."""
    stiff = replace(
        parameters,
        mechanism=replace(parameters.mechanism, slider_mass=1.0165),
        joint=replace(parameters.joint, bushing_radius=9.92163e-3, bushing_width=26.25e-3),
        bushing=Bushing(Material(913.4e6, 0.38), 2200.0, 3.782e-13),
    )
    fine, coarse = (life(stiff, 9.2416, 19942.0, tolerance=one) for one in (2e-4, 1e-3))
    rows = row_cycles(19942.0)
    at, same = (np.searchsorted(one.cycles, rows) for one in (coarse, fine))
    off = np.abs(coarse.max_depth[at] - fine.max_depth[same])
    assert np.all(off <= coarse.estimated_error[at])
    assert off[0] > 0.5 * coarse.estimated_error[at[0]], "the row that was stated too well"


def test_rows_are_those_that_were_asked_for(parameters) -> None:
    asked = [250.0, 500.0, 750.0]
    found = life(parameters, RPM30, 1000.0, tolerance=1e-2, force=110.0, rows=asked)
    assert set(asked) <= set(found.cycles.tolist())
    assert found.cycles[-1] == 1000.0
    with pytest.raises(ModelError, match="increasing"):
        life(parameters, RPM30, 1000.0, tolerance=1e-2, force=110.0, rows=[500.0, 250.0])


@pytest.mark.parametrize("method", ["implicit", "explicit"])
@pytest.mark.parametrize("coefficient", [1e-300, 1e-30, 1e-22])
def test_a_coefficient_lost_in_rounding_is_refused_in_words(
    parameters, coefficient: float, method: str
) -> None:
    faint = replace(parameters, bushing=replace(parameters.bushing, wear_coefficient=coefficient))
    with pytest.raises(ModelError, match="below the resolution of the numbers"):
        life(faint, RPM30, 1000.0, tolerance=1e-2, method=method)
