"""The procedure as a state machine: planned, taken, closed, taken up, rejected, never erased."""

from __future__ import annotations

import json
from collections import Counter

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rigapp_calibration.load_cell.calibrate import calibrate_load_cell
from rigapp_calibration.load_cell.characteristics import angle_groups
from rigapp_calibration.load_cell.plans import WEIGHING, LoadCellPlan, PlanKind, load_cell_readings
from rigapp_calibration.load_cell.weights import (
    PiecesError,
    force_per_mass,
    next_change,
    pin_force,
    possible_loads,
)
from rigapp_calibration.taking.procedure import (
    Procedure,
    ProcedureError,
    StepKind,
    begin,
    take_up,
    time_needed,
)
from rigapp_calibration.taking.signals import judge
from tests.calibration.simulated_cell import SETTINGS, Cell

SET = (5.0,) * 8 + (2.0, 2.0, 1.0, 0.5)
LOADED = 10 * 11


def hand(
    procedure: Procedure[LoadCellPlan], cell: Cell, rng: np.random.Generator
) -> Procedure[LoadCellPlan]:
    """Do the present step as a technician would."""
    step = procedure.step
    if step.kind is StepKind.ANGLE_REFERENCE:
        return procedure.reference(0.0, float(np.radians(0.05)))
    if step.kind is StepKind.SET_UP:
        return procedure.set_up(step.set_up + np.radians(0.3))
    if step.kind is StepKind.PRELOAD:
        return procedure.exercised()
    newton_per_kg = force_per_mass(SETTINGS.weights, SETTINGS.place)
    angle = step.set_up + np.radians(0.3)
    force = pin_force([step.value * newton_per_kg], [angle], 0.0)
    signal = cell.signal(force, np.array([0.5]), np.array([True]), rng)[0]
    at = 1000.0 + procedure.position
    return procedure.record(signal, 1e-4, at, place=angle, hung=step.due)


def finish(procedure: Procedure[LoadCellPlan], seed: int = 3) -> Procedure[LoadCellPlan]:
    rng = np.random.default_rng(seed)
    while not procedure.done:
        procedure = hand(procedure, Cell(), rng)
    return procedure


def journal(procedure: Procedure[LoadCellPlan]) -> list[dict[str, object]]:
    """Return the events as they come back from a file."""
    return [json.loads(json.dumps(event)) for event in procedure.events]


@pytest.mark.parametrize("kind", list(PlanKind))
def test_plan_is_carried_out_to_a_calibration(kind: PlanKind) -> None:
    done = finish(begin(WEIGHING, LoadCellPlan(kind, 40.0, SET)))
    assert "All readings" in done.instruction
    readings = load_cell_readings(done)
    assert len(np.unique(angle_groups(readings.angle))) == {
        PlanKind.DAILY: 4, PlanKind.ROUTINE: 8, PlanKind.FULL: 12,
    }[kind]  # fmt: skip
    if kind is not PlanKind.DAILY:
        found = calibrate_load_cell(readings, SETTINGS)
        assert found.accepted, [p.sentence for p in found.problems]


def test_sizes_of_the_plans() -> None:
    def count(kind: PlanKind) -> int:
        return sum(s.kind is StepKind.READING for s in LoadCellPlan(kind, 40.0, SET).steps())

    assert (
        count(PlanKind.FULL)
        == 14 * (2 * len(LoadCellPlan(PlanKind.FULL, 40.0, SET).loads()) + 1) + 2
    )
    assert count(PlanKind.ROUTINE) == 10 * 11 + 2
    assert count(PlanKind.DAILY) == 4 * 3
    assert 70 < time_needed(LoadCellPlan(PlanKind.ROUTINE, 40.0, SET).steps()) / 60.0 < 120


def test_the_time_follows_the_pieces_that_are_moved() -> None:
    few, many = (
        time_needed(LoadCellPlan(PlanKind.ROUTINE, 40.0, pieces).steps())
        for pieces in ((8.0,) * 5, (1.0,) * 40)
    )
    assert many > 1.7 * few


@settings(deadline=None, max_examples=40)
@given(st.lists(st.sampled_from((0.5, 1.0, 2.0, 5.0, 10.0, 20.0)), min_size=3, max_size=16))
def test_rising_loads_only_add_pieces_and_falling_ones_only_remove(pieces: list[float]) -> None:
    plan = LoadCellPlan(PlanKind.ROUTINE, min(40.0, sum(pieces)), tuple(pieces))
    before: Counter[float] = Counter()
    for step in plan.steps():
        hanging = Counter(step.pieces)
        if step.kind is StepKind.READING and not step.due:
            assert not (before - hanging if not step.falling else hanging - before), step.words
            assert "and hang" not in step.words
        before = hanging


def test_a_journal_of_before_goes_on_in_its_own_steps() -> None:
    events = [{"event": "begin", "kind": "routine", "heaviest": 40.0, "pieces": list(SET)}]
    procedure = take_up(WEIGHING, events)
    readings = [one for one in procedure.steps if one.kind is StepKind.READING]
    assert len(readings) == 4 * 11 + 2
    assert [one.value for one in readings[:6]] == [0.0, 8.0, 16.0, 24.0, 32.0, 40.0]


def test_it_is_taken_up_where_it_was_left() -> None:
    rng = np.random.default_rng(1)
    whole = begin(WEIGHING, LoadCellPlan(PlanKind.ROUTINE, 40.0, SET))
    for _ in range(17):
        whole = hand(whole, Cell(), rng)
    again = take_up(WEIGHING, journal(whole))
    assert again == whole
    assert again.progress == whole.progress


def test_rejected_reading_stays_and_its_series_is_taken_again() -> None:
    rng = np.random.default_rng(1)
    procedure = begin(WEIGHING, LoadCellPlan(PlanKind.ROUTINE, 40.0, SET))
    while len(procedure.taken) < 5:
        procedure = hand(procedure, Cell(), rng)
    with pytest.raises(ProcedureError, match="reason"):
        procedure.reject(4, "  ")
    repeated = procedure.reject(4, "bumped the table")
    assert len(repeated.taken) == 5
    assert repeated.taken[4].rejected == "bumped the table"
    assert all(one.rejected for one in repeated.taken)
    assert repeated.step.number == 1
    done = finish(repeated)
    assert len(load_cell_readings(done)) == LOADED
    assert len(done.taken) == LOADED + 7
    assert take_up(WEIGHING, journal(done)) == done


def at_the_creep(readings: int = 0) -> Procedure[LoadCellPlan]:
    """Return a procedure whose creep comes now, or has been read so often."""
    rng = np.random.default_rng(1)
    procedure = begin(WEIGHING, LoadCellPlan(PlanKind.ROUTINE, 40.0, SET))
    while procedure.step.series != "creep" or len(procedure.taken) < LOADED + readings:
        procedure = hand(procedure, Cell(), rng)
    return procedure


@pytest.mark.parametrize("readings", [0, 1])
def test_a_creep_that_is_left_out_is_not_asked_for_again(readings: int) -> None:
    procedure = at_the_creep(readings).leave_out()
    assert procedure.done
    assert [one.rejected for one in procedure.taken[LOADED:]] == ["left out"] * readings
    assert take_up(WEIGHING, journal(procedure)) == procedure
    # Another series is rejected: only that one is taken again.
    done = finish(procedure.reject(3, "bumped"))
    assert len(done.taken) == LOADED + readings + 11
    assert take_up(WEIGHING, journal(done)) == done
    with pytest.raises(ProcedureError, match="cannot be left out"):
        begin(WEIGHING, procedure.plan).leave_out()


def test_the_creep_is_read_once_and_taken_again_where_it_is_rejected_or_late() -> None:
    late = at_the_creep(1).again("read after 500 s")
    assert late.step.kind is StepKind.PRELOAD
    assert late.taken[-1].rejected == "read after 500 s"
    assert take_up(WEIGHING, journal(late)) == late
    done = finish(late)
    assert [step.due for step, _ in done.standing(of=lambda step: step.due > 0.0)] == [30.0, 300.0]
    # It stands: the readings of another series are taken again without it.
    assert len(finish(done.reject(40, "bumped")).taken) == len(done.taken) + 11
    # After the end it begins with the preloads of its pin angle.
    again = done.reject(len(done.taken) - 1, "touched")
    assert again.step.kind is StepKind.SET_UP
    assert len(finish(again).taken) == len(done.taken) + 2


def test_wrong_event_is_refused_in_words() -> None:
    procedure = begin(WEIGHING, LoadCellPlan(PlanKind.ROUTINE, 40.0, SET))
    with pytest.raises(ProcedureError, match="angle reference"):
        procedure.record((0.0, 0.0), 0.0, 0.0)
    procedure = procedure.reference(0.0, 0.001)
    with pytest.raises(ProcedureError, match="turn the pin to 0"):
        procedure.set_up(np.radians(40.0))
    procedure = procedure.set_up(0.0).exercised().exercised()
    with pytest.raises(ProcedureError, match="not a number"):
        procedure.record((np.nan, 0.0), 0.0, 0.0)


@pytest.mark.parametrize(
    "events", [[], [{"event": "record"}], [{"event": "begin"}], [{"no": 1}]], ids=str
)
def test_spoilt_journal_is_refused(events: list[dict[str, object]]) -> None:
    with pytest.raises(ProcedureError, match="journal"):
        take_up(WEIGHING, events)


@settings(deadline=None, max_examples=40)
@given(st.lists(st.sampled_from(["do", "reject", "reload"]), max_size=60))
def test_any_sequence_keeps_every_reading(actions: list[str]) -> None:
    rng = np.random.default_rng(0)
    procedure = begin(WEIGHING, LoadCellPlan(PlanKind.ROUTINE, 40.0, SET))
    for action in actions:
        before = len(procedure.taken)
        if action == "reload":
            procedure = take_up(WEIGHING, journal(procedure))
        elif action == "reject":
            try:
                procedure = procedure.reject(before - 1, "a reason")
            except ProcedureError:
                continue
        elif not procedure.done:
            procedure = hand(procedure, Cell(), rng)
        assert len(procedure.taken) >= before
        standing = procedure.standing(of=lambda step: not step.due)
        assert len(standing) == len(load_cell_readings(procedure))


@settings(deadline=None, max_examples=60)
@given(st.floats(0.0, 40.0), st.lists(st.sampled_from(SET), max_size=5, unique=True))
def test_change_at_the_hanger_reaches_the_load(target: float, hanging: list[float]) -> None:
    change = next_change(target, tuple(hanging), SET, tolerance=0.26)
    assert abs(change.mass - target) <= 0.26
    after = sorted([*hanging, *change.add])
    for piece in change.remove:
        after.remove(piece)
    assert sorted(change.hanging) == after


def test_impossible_load_is_said() -> None:
    with pytest.raises(PiecesError, match=r"nearest is 45\.5 kg"):
        next_change(60.0, (), SET)


def test_rising_loads_need_only_additions() -> None:
    hanging: tuple[float, ...] = ()
    for load in possible_loads(40.0, 8, SET):
        change = next_change(load, hanging, SET)
        assert change.remove == ()
        hanging = change.hanging


def test_swinging_and_creeping_are_told_apart() -> None:
    t = np.linspace(0.0, 4.0, 200)
    noise = np.random.default_rng(0).normal(0.0, 1e-3, (200, 2))
    assert judge(t, 1.0 + noise, 5e-3, 1e-3).steady
    swing = 0.05 * np.sin(2 * np.pi * 0.7 * t)[:, None] * [1.0, 0.4]
    assert judge(t, 1.0 + noise + swing, 5e-3, 1e-3).reason.startswith("swinging")
    creep = 0.01 * t[:, None] * [1.0, 0.0]
    assert judge(t, 1.0 + noise + creep, 5e-3, 1e-3).reason == "still changing"
    assert "waiting" in judge(t[:3], noise[:3], 5e-3, 1e-3).reason
    spoilt = noise.copy()
    spoilt[3, 0] = np.nan
    assert not judge(t, spoilt, 5e-3, 1e-3).steady


def test_one_step_back_takes_the_newest_reading_again_and_a_note_changes_nothing() -> None:
    procedure, rng = begin(WEIGHING, LoadCellPlan(PlanKind.ROUTINE, 40.0, SET)), rng_of(3)
    with pytest.raises(ProcedureError, match="no reading just before"):
        procedure.back("a slip")
    while len(procedure.taken) < 3:
        procedure = hand(procedure, Cell(), rng)
    at = procedure.position
    noted = procedure.note(" a door \n slammed ")
    assert (noted.position, noted.events[-1]["text"]) == (at, "a door slammed")
    again = noted.back("a wrong piece hung")
    assert again.position == at - 1
    assert [one.rejected for one in again.taken] == ["", "", "a wrong piece hung"]
    twice = again.back("and the one before")
    assert twice.position == at - 2
    for empty in (procedure.back, procedure.note):
        with pytest.raises(ProcedureError):
            empty("  ")
    finished = finish(twice)
    assert len(load_cell_readings(finished)) == 110
    assert take_up(WEIGHING, journal(finished)) == finished
    # What hung before a set-up is gone: the other series is no step back.
    new = twice
    while new.under_way != "2":
        new = hand(new, Cell(), rng)
    with pytest.raises(ProcedureError, match="reject one of the table"):
        new.back("late").back("too late")


def rng_of(seed: int) -> np.random.Generator:
    return np.random.default_rng(seed)
