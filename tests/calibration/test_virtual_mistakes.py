"""Virtual calibrations: each mistake is refused with its right name, good ones are not refused."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from tests.calibration.virtual_mistakes import (
    KINDS,
    MISTAKES,
    blocking,
    can_be_told,
    outcomes,
    refusals,
    rightly_named,
    take,
)

ALL = [name for name in KINDS if name.endswith("all")]
PAIRS = [pair for pair in product(MISTAKES, ALL) if can_be_told(*pair)]
SHORT = [pair for pair in PAIRS if pair[1] in ("4 angles, coarse, all", "8 angles, means, all")]
ONCE = dict(reversed(SHORT))
"""Each mistake in the first plan that can tell it."""


@pytest.mark.sampled(every=5)
@pytest.mark.parametrize("name", KINDS)
def test_good_calibrations_are_accepted(name: str) -> None:
    assert refusals(KINDS[name], 2, 1) == {}


def test_a_display_that_rounds_alike_at_every_angle_makes_no_wrong_piece() -> None:
    # A coarse display without noise, a zero that drifts: the steps are the same at all four angles.
    kind = KINDS["4 angles, quiet coarse, drift"]
    for number in (14, 31, 164, 183):
        assert blocking(take(kind, np.random.default_rng((11, number))).readings) == ()


@pytest.mark.parametrize(("mistake", "name"), ONCE.items())
def test_a_mistake_has_its_right_name(mistake: str, name: str) -> None:
    found = outcomes(KINDS[name], MISTAKES[mistake], 1, 2)
    assert rightly_named(found, MISTAKES[mistake].right) == 1.0, found


@pytest.mark.long
@pytest.mark.parametrize(("mistake", "name"), SHORT)
def test_a_mistake_has_its_right_name_in_each_plan(mistake: str, name: str) -> None:
    found = outcomes(KINDS[name], MISTAKES[mistake], 3, 2)
    assert rightly_named(found, MISTAKES[mistake].right) == 1.0, found


@pytest.mark.soak
@pytest.mark.timeout(7200)
def test_good_calibrations_are_hardly_ever_refused() -> None:
    found = {name: refusals(kind, 200, 3) for name, kind in KINDS.items()}
    assert sum(one.total() for one in found.values()) < 0.005 * 200 * len(KINDS), found


@pytest.mark.soak
@pytest.mark.timeout(7200)
@pytest.mark.parametrize(("mistake", "name"), PAIRS)
def test_a_mistake_nearly_always_has_its_right_name(mistake: str, name: str) -> None:
    found = outcomes(KINDS[name], MISTAKES[mistake], 200, 4)
    assert rightly_named(found, MISTAKES[mistake].right) >= 0.95, found
