"""Whether the joint still wears as it did: told soon, seldom falsely, and with the same numbers."""

from __future__ import annotations

import json

import numpy as np
import pytest
import virtual_tests as virtual

from rigapp_model.identification import Consistency, consistency_of, identify, sentence
from rigapp_model.identification.consistency import FINE, LARGEST, REFERENCE, THRESHOLD, threshold

LIFE = virtual.a_life()
LAST, HALF = 21377, 10688
NUMBER = np.arange(1.0, LAST + 1.0)
DOUBLED = np.minimum(NUMBER, HALF) + 2.0 * np.maximum(NUMBER - HALF, 0.0)
FIRST_RENEWED = 1000.0


def watched(depth, renewed_until: float = np.inf) -> Consistency:
    """Judge a test as the twin does; before FIRST_RENEWED nothing, which is quicker."""
    coarse = virtual.gathered_at_once(depth)
    found = Consistency()
    for fine in virtual.gathered_at_once(depth, FINE):
        closed = [one for one in coarse if FIRST_RENEWED < one.revolution < fine.first]
        if closed and found.walked < np.log(closed[-1].first) and closed[-1].last < renewed_until:
            bins = [one for one in coarse if one.revolution <= closed[-1].revolution]
            found.renew(identify(bins, LIFE, virtual.ERRORS, virtual.PRIOR))
        if found.judge(fine, LIFE) is not None:
            break
    return found


@pytest.mark.sampled
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_coefficient_that_doubles_is_told_before_five_times_the_scatter_has_worn(seed) -> None:
    depth = virtual.readings(LIFE, seed, LAST, 1.1 * DOUBLED)
    told = watched(depth).departure
    assert told is not None
    assert told.faster
    clean = LIFE.course.at(1.1 * DOUBLED)[0]
    grown = clean[int(told.revolution) - 1] - clean[HALF - 1]
    assert 0.0 < grown < 5.0 * virtual.ERRORS.scatter
    assert abs(told.since - HALF) < 0.05 * HALF


def test_a_coefficient_that_falls_is_told_as_slower() -> None:
    slower = np.minimum(NUMBER, HALF) + 0.4 * np.maximum(NUMBER - HALF, 0.0)
    told = watched(virtual.readings(LIFE, 1, LAST, slower)).departure
    assert told is not None
    assert not told.faster


@pytest.mark.sampled
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_nothing_is_told_where_nothing_changed(seed) -> None:
    found = watched(virtual.readings(LIFE, seed, LAST))
    assert found.departure is None
    assert 0.0 <= found.score < 1.0


def test_false_alarms_are_as_rare_as_the_threshold_was_made_for() -> None:
    random = np.random.default_rng(8)
    wanted, tests = 0.3, 3000
    up, down = np.zeros(tests), np.zeros(tests)
    told = np.zeros(tests, dtype=bool)
    for _ in range(FINE):
        step = np.clip(random.normal(size=tests), -LARGEST, LARGEST)
        up, down = np.maximum(up + step - REFERENCE, 0), np.maximum(down - step - REFERENCE, 0)
        told |= np.maximum(up, down) > threshold(wanted)
    assert told.mean() == pytest.approx(-np.expm1(-wanted), rel=0.12)
    assert threshold(wanted) < THRESHOLD


def test_one_wrong_bin_raises_no_alarm() -> None:
    assert LARGEST - REFERENCE < 0.5 * THRESHOLD


def test_it_goes_on_from_its_numbers_as_if_nothing_had_been() -> None:
    depth = virtual.readings(LIFE, 4, 6000)
    known = identify(virtual.gathered(depth[:2154]), LIFE, virtual.ERRORS, virtual.PRIOR)

    def judged(stops: list[int]) -> Consistency:
        watch = Consistency()
        for number in range(2155, 6001):
            if number == 3001:
                watch.renew(known)
            if number in stops:
                watch = consistency_of(json.loads(json.dumps(watch.numbers())))
            watch.add(number, float(number), float(depth[number - 1]), LIFE)
        return watch

    through = judged([])
    assert judged([2999, 3007, 4321]).numbers() == through.numbers()
    assert 0.0 <= through.score < 1.0


def test_before_the_coefficient_is_known_nothing_is_judged() -> None:
    watch = Consistency()
    watch.renew(
        identify(
            virtual.gathered(virtual.readings(LIFE, 1, 60)), LIFE, virtual.ERRORS, virtual.PRIOR
        )
    )
    assert np.isnan(watch.score)


def test_sentences_say_what_is_known_and_why_not() -> None:
    def said(last, scaled=None):
        depth = virtual.readings(LIFE, 1, last, scaled)
        return sentence(identify(virtual.gathered(depth), LIFE, virtual.ERRORS, virtual.PRIOR))

    assert said(100).startswith("The wear coefficient cannot be determined yet. Its limits are")
    assert said(8000).startswith("One wear coefficient, 54")
    runs_in = 1.1 * (NUMBER + 3000.0 * -np.expm1(-NUMBER / 1500.0))
    assert said(LAST, runs_in).startswith("Running-in: the wear coefficient fell from 14")
    assert "within 1" in said(LAST, runs_in)
    assert said(LAST, 1.1 * DOUBLED).startswith("Changed at revolution 10")
    told = watched(virtual.readings(LIFE, 1, LAST, 1.1 * DOUBLED))
    known = identify(
        virtual.gathered(virtual.readings(LIFE, 1, 8000)), LIFE, virtual.ERRORS, virtual.PRIOR
    )
    assert sentence(known, told.departure).startswith("The joint wears faster than before")
    later = virtual.gathered(virtual.readings(LIFE, 1, LAST, 1.1 * DOUBLED))
    known = identify(later, LIFE, virtual.ERRORS, virtual.PRIOR)
    assert sentence(known, told.departure).startswith("Changed at revolution 10")
