"""The short form of ``bench_identified_noise.py``: probes disturbed as rigs disturb them."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import rig_noise as rig
import virtual_tests as virtual

from rigapp_model.identification import Bins, Consistency, depth_life, identify, sentence
from rigapp_model.identification.consistency import FINE


@cache
def told_life():
    progress = np.concatenate([[0.0], np.geomspace(1.0, 12.0 * rig.LAST, 400)])
    return depth_life(rig.COEFFICIENT, progress, rig.worn(rig.USUAL, progress))


def known(one: rig.Recorded, last: int):
    bins = virtual.gathered_at_once(one.read[:last])
    return identify(bins, told_life(), virtual.ERRORS, virtual.PRIOR)


MORE = ("AR 200", "hourly", "creep")


@pytest.mark.sampled
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
    found = known(rig.recorded("step", 2), int(0.6 * rig.LAST))
    step = next(one for one in found.disturbances if one.name == "step")
    assert abs(step.size) == pytest.approx(2e-6, abs=3.0 * step.doubt)
    assert step.revolutions == pytest.approx(5194, rel=0.1)
    assert "The probes are disturbed, which the limits allow for: " in sentence(found)
    swing = known(rig.recorded("hourly", 1), int(0.6 * rig.LAST)).disturbances
    hour = next(one for one in swing if one.name == "swing")
    assert hour.size == pytest.approx(1e-6, abs=0.4e-6)
    assert hour.revolutions == pytest.approx(rig.HOUR, rel=0.2)


def test_a_touched_probe_is_not_told_as_other_wear() -> None:
    one = rig.recorded("step", 2)  # at revolution 5194
    watch = Consistency()
    watch.renew(known(one, 4641))
    for fine in virtual.gathered_at_once(one.read[:7000], FINE):
        if fine.first > 4641:
            assert watch.judge(fine, told_life()) is None
    assert watch.stepped == pytest.approx(5194, rel=0.02)


def test_a_temperature_channel_takes_out_what_the_room_does() -> None:
    one = rig.recorded("hourly", 1)
    room = 21.0 + one.room
    last, bins = int(0.6 * rig.LAST), Bins()
    for number in range(1, last + 1):
        bins.add(number, float(number), one.read[number - 1], room[number - 1])
    with_room = identify(bins, told_life(), virtual.ERRORS, virtual.PRIOR)
    heat = next(each for each in with_room.disturbances if each.name == "temperature")
    assert heat.size == pytest.approx(0.5e-6, abs=3.0 * heat.doubt)
    assert heat.doubt < 0.05e-6
    assert "swing" not in [each.name for each in with_room.disturbances]
    assert "for a degree of temperature" in sentence(with_room)
    # Without the channel nobody knows whether a day's swing is in what was seen so far.
    unsure = "A slow drift of the probes, as by the room's temperature, cannot be excluded yet."
    assert unsure not in sentence(with_room)
    assert unsure in sentence(known(rig.recorded("white", 1), last))
    limits = with_room.coefficient
    assert limits.low <= one.ratio * rig.COEFFICIENT <= limits.high


def test_the_coefficient_now_is_known_while_the_joint_still_runs_in() -> None:
    number = np.arange(1.0, 4001.0)
    made = number + 2.0 * 8000.0 * -np.expm1(-number / 8000.0)
    random = np.random.default_rng(3)
    read = rig.worn(rig.USUAL, made) + 0.2e-6 * random.normal(size=number.size)
    found = identify(virtual.gathered_at_once(read), told_life(), virtual.ERRORS, virtual.PRIOR)
    best = next(each for each in found.verdicts if each.name == "running-in")
    now = (1.0 + 2.0 * np.exp(-4000.0 / 8000.0)) * rig.COEFFICIENT
    assert best.coefficient.low < now < best.coefficient.high
    # What it will fall to is hardly known by then: half the way is still to come.
    width = best.coefficient.high / best.coefficient.low
    assert best.after.high / best.after.low > width**2
