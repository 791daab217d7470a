"""Scan rates: only checked combinations, refusals name the nearest possible ones."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rigapp_drivers.dataq.rates import (
    DECIMATIONS,
    NoSuchRate,
    Rate,
    checked,
    encoder_rate,
    nearest_rates,
    rate_for,
)


@pytest.mark.parametrize(
    ("hertz", "entries", "rate"),
    [
        (1000.0, 5, Rate(60000, 1, 1)),
        (960.0, 5, Rate(62500, 1, 1)),
        (160000.0, 1, Rate(375, 1, 1)),
        (20000.0, 8, Rate(3000, 1, 1)),
        (500.0, 5, Rate(60000, 2, 1)),
        (10.0, 5, Rate(60000, 100, 1)),
        (1.0, 5, Rate(60000, 100, 10)),
    ],
)
def test_rates(hertz: float, entries: int, rate: Rate) -> None:
    found = rate_for(hertz, entries)
    assert found.sample_rate_Hz == pytest.approx(hertz, rel=1e-12)
    if hertz >= 10.0:
        assert found == rate


def test_the_makers_example() -> None:
    assert Rate(11718, 512, 1).sample_rate_Hz == pytest.approx(10.0, rel=1e-4)
    assert checked(Rate(11718, 512, 1), 8)


@pytest.mark.parametrize(
    ("hertz", "entries", "near"),
    [
        (7000.0, 5, "6999.53336 or 7000.35002"),
        (160000.0, 8, "nearest possible: 20000."),
        (1e9, 1, "nearest possible: 160000."),
        (1e-6, 1, "nearest possible: 0.0183"),
    ],
)
def test_refusals_name_the_nearest(hertz: float, entries: int, near: str) -> None:
    with pytest.raises(NoSuchRate, match=near):
        rate_for(hertz, entries)


@pytest.mark.parametrize("hertz", [0.0, -1.0, float("nan"), float("inf")])
def test_what_is_no_rate_is_refused(hertz: float) -> None:
    with pytest.raises(NoSuchRate, match="not a rate"):
        rate_for(hertz, 5)


@given(st.floats(0.02, 2e5), st.integers(1, 11))
def test_the_nearest_are_checked_and_enclose_the_wish(hertz: float, entries: int) -> None:
    near = nearest_rates(hertz, entries)
    assert near
    for rate in near:
        assert checked(rate, entries)
        assert 375 * entries <= rate.srate <= 65535
        assert 1 <= rate.dec <= 512
        assert 1 <= rate.deca <= 40000
    below = [rate.sample_rate_Hz for rate in near if rate.sample_rate_Hz <= hertz * (1 + 1e-9)]
    above = [rate.sample_rate_Hz for rate in near if rate.sample_rate_Hz >= hertz * (1 - 1e-9)]
    for dec, deca in DECIMATIONS:
        for srate in (375 * entries, 65535, *(rate.srate for rate in near)):
            other = Rate(srate, dec, deca).sample_rate_Hz
            assert not (below and max(below) * (1 + 1e-9) < other < hertz * (1 - 1e-9))
            assert not (above and hertz * (1 + 1e-9) < other < min(above) * (1 - 1e-9))


@pytest.mark.parametrize("entries", range(1, 12))
def test_the_encoder_clock_gets_a_checked_combination(entries: int) -> None:
    assert checked(encoder_rate(entries), entries)
