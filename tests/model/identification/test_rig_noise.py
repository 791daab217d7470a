"""The short form of ``bench_identified_noise.py``: probes disturbed as rigs disturb them."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import rig_noise as rig
import virtual_tests as virtual

from rigapp_model.identification import Consistency, depth_life, identify, sentence
from rigapp_model.identification.consistency import FINE


@cache
def told_life():
    progress = np.concatenate([[0.0], np.geomspace(1.0, 12.0 * rig.LAST, 400)])
    return depth_life(rig.COEFFICIENT, progress, rig.worn(rig.USUAL, progress))


def known(one: rig.Recorded, last: int):
    bins = virtual.gathered_at_once(one.read[:last])
    return identify(bins, told_life(), virtual.ERRORS, virtual.PRIOR)


MORE = ("AR 200", "hourly", "creep")


@pytest.mark.parametrize(
    "kind", ["daily", "step", *(pytest.param(one, marks=pytest.mark.long) for one in MORE)]
)
def test_limits_hold_the_coefficient_where_the_probes_are_disturbed(kind) -> None:
    held = 0
    for seed in range(4):
        one = rig.recorded(kind, seed)
        limits = known(one, int(0.6 * rig.LAST)).coefficient
        held += limits.low <= one.ratio * rig.COEFFICIENT <= limits.high
    assert held >= 3


def test_what_disturbs_the_probes_is_named_with_its_size() -> None:
    found = known(rig.recorded("step", 0), int(0.6 * rig.LAST))
    step = next(one for one in found.disturbances if one.name == "step")
    assert abs(step.size) == pytest.approx(2e-6, abs=3.0 * step.doubt)
    assert step.place == pytest.approx(5291, rel=0.1)
    assert "The probes are disturbed, which the limits allow for: " in sentence(found)
    swing = known(rig.recorded("hourly", 1), int(0.6 * rig.LAST)).disturbances
    hour = next(one for one in swing if one.name == "swing")
    assert hour.size == pytest.approx(1e-6, abs=0.4e-6)
    assert hour.place == pytest.approx(rig.HOUR, rel=0.2)


def test_a_touched_probe_is_not_told_as_other_wear() -> None:
    one = rig.recorded("step", 2)  # at revolution 5194
    watch = Consistency()
    watch.renew(known(one, 4641))
    for fine in virtual.gathered_at_once(one.read[:7000], FINE):
        if fine.first > 4641:
            assert watch.judge(fine, told_life()) is None
    assert watch.stepped == pytest.approx(5194, rel=0.02)
