"""Samples that the encoder clocks: their times, speeds, statistics and stands."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from rigapp.engine.processing import Processor
from rigapp.engine.samples.assembler import Assembler, EncoderSetup, Revolution
from rigapp.engine.samples.sampleclock import TICKS_PER_S, EncoderClock, PulseRate
from rigapp.engine.values.calibrate import Calibration, Measured, calibrate
from rigapp.engine.values.reduce import Reducer
from rigapp.schema.channels import BASE
from rigapp.schema.messages import Flag
from rigapp_drivers.api import Block, SampleClock
from tests.engine.calibrations import calibration_by_hand

LINES = 360
RATE_ROW = 5

Array = NDArray[np.float64]


def calibration(**changes: Any) -> Calibration:
    values: dict[str, Any] = {
        "encoder": EncoderSetup(LINES, restarts_at_index=False),
        "sample_rate_Hz": float(LINES),
        "matrix": np.array([[200.0, 3.0], [-4.0, 190.0]]),
        "sensitivity": np.array([100.0, 90.0]),
        "counter": {
            "clock": SampleClock.ENCODER,
            "pulse_rate": PulseRate(RATE_ROW, 1.0, 0.0),
            "fastest_Hz": 10.0 * LINES,
        },
    }
    return calibration_by_hand(**{**values, **changes})


def pulse_times(speed_of: Any, pulses: int, step_s: float = 1e-5) -> Array:
    """Return when the first pulses come, of a shaft with speed_of(time) in rev/s."""
    times, turned, last = [], 0.0, 0.0
    span = 1.0
    while len(times) < pulses:
        grid = np.arange(last, last + span, step_s)
        lines = turned + np.cumsum(speed_of(grid)) * step_s * LINES
        wanted = np.arange(np.floor(turned) + 1, np.floor(lines[-1]) + 1)
        times += np.interp(wanted, lines, grid).tolist()
        turned, last = float(lines[-1]), last + span
    return np.array(times[:pulses])


def stream(
    times: Array,
    size: int,
    signal: Array | None = None,
    lost: tuple[int, int] = (0, 0),
    late_s: Array | None = None,
) -> list[Block]:
    """Return Blocks of pulses; lost: so many pulses from a pulse on are missing."""
    n = times.size
    values = np.zeros((6, n), np.float32)
    if signal is not None:
        values[0] = signal
    values[4] = np.arange(1, n + 1)
    values[RATE_ROW] = 1.0 / np.gradient(times)
    kept = np.ones(n, bool)
    kept[lost[0] : lost[0] + lost[1]] = False
    found: list[Block] = []
    bounds = sorted({*range(0, n, size), lost[0], lost[0] + lost[1], n})
    for first, last in itertools.pairwise(bounds):
        if not kept[first]:
            continue
        missing = lost[1] if lost[1] and first == lost[0] + lost[1] else 0
        late = late_s[len(found) % late_s.size] if late_s is not None else 0.0
        host = round((times[last - 1] + 100.0 + late) * 1e9)
        found.append(
            Block(
                "daq", len(found), first, float(LINES), host, values[:, first:last].copy(),
                np.zeros(last - first, np.uint8), missing,
            )
        )  # fmt: skip
    return found


def cut(blocks: list[Block], clock: EncoderClock, kind: Calibration) -> list[Revolution]:
    assembler = Assembler(kind.encoder, kind.counter.row, kind.sample_rate_Hz, kind.margins)
    return [one for block in blocks for one in assembler.push(block, clock.times(block))]


def ramp(time: Array) -> Array:
    return np.asarray(np.clip(0.2 + 0.8 * time, 0.2, 2.0) + 0.05 * np.sin(3.0 * time), np.float64)


@pytest.mark.parametrize("real_time", [True, False])
@pytest.mark.parametrize("size", [1, 7, 36, 100_000])
def test_times_by_the_pulse_rate_are_true(real_time: bool, size: int) -> None:
    kind = calibration()
    times = pulse_times(ramp, 12 * LINES)
    found = cut(stream(times, size), EncoderClock(LINES, kind.counter.pulse_rate, real_time), kind)
    assert [one.ordinal for one in found] == list(range(1, 12))
    reducer = Reducer(kind)
    for one in found:
        begin, end = times[one.ordinal * LINES - 1], times[(one.ordinal + 1) * LINES - 1]
        assert (one.end_sample - one.first_sample) / TICKS_PER_S == pytest.approx(
            end - begin, rel=2e-3
        )
        row = reducer.reduce(Measured(one, kind))
        assert one.samples == LINES
        assert row[BASE.place["speed"]] == pytest.approx(60.0 / (end - begin), rel=2e-3)
        inside = (times > begin) & (times < end)
        local = 60.0 * ramp(times[inside])
        assert row[BASE.place["speed_max"]] == pytest.approx(local.max(), rel=2e-2)
        assert row[BASE.place["speed_min"]] == pytest.approx(local.min(), rel=2e-2)
        assert one.flags == Flag.GOOD


def test_times_by_the_host_follow_the_motion() -> None:
    """Without a pulse rate, and with blocks that come up to 8 ms late."""
    counter = {"clock": SampleClock.ENCODER, "fastest_Hz": 10.0 * LINES}
    kind = calibration(counter=counter)
    times = pulse_times(lambda t: 1.0 + 0.02 * np.sin(t), 40 * LINES)
    late = np.array([0.0, 0.003, 0.008, 0.001, 0.005])
    found = cut(stream(times, 18, late_s=late), EncoderClock(LINES, None, True), kind)
    ends = np.array([one.end_sample / TICKS_PER_S for one in found])[5:]
    true = times[[(one.ordinal + 1) * LINES - 1 for one in found]][5:]
    np.testing.assert_allclose(np.diff(ends), np.diff(true), rtol=0.02)
    assert ends[-1] - ends[0] == pytest.approx(true[-1] - true[0], abs=0.02)
    assert np.all(np.diff(found[-1].sample_indices()) > 0)


def test_a_simulated_rig_without_a_pulse_rate_has_no_time() -> None:
    with pytest.raises(ValueError, match="pulse rate"):
        EncoderClock(LINES, None, False)


def test_a_stand_is_time_but_not_speed() -> None:
    kind = calibration()
    times = pulse_times(lambda t: np.ones_like(t), 6 * LINES)
    times[3 * LINES + 100 :] += 30.0
    blocks = stream(times, 18)
    for block in blocks:
        block.values[RATE_ROW] = LINES
    found = cut(blocks, EncoderClock(LINES, kind.counter.pulse_rate, True), kind)
    held = found[2]
    assert held.flags & Flag.PAUSED
    assert (held.end_sample - held.first_sample) / TICKS_PER_S == pytest.approx(31.0, abs=0.05)
    row = Reducer(kind).reduce(Measured(held, kind))
    assert row[BASE.place["speed"]] == pytest.approx(60.0 / 3.0, rel=0.02)
    assert not found[1].flags & Flag.PAUSED
    assert Reducer(kind).reduce(Measured(found[1], kind))[BASE.place["speed"]] == pytest.approx(
        60.0, rel=5e-3
    )


def test_lost_pulses_take_their_time() -> None:
    kind = calibration()
    times = pulse_times(lambda t: np.full_like(t, 2.0), 8 * LINES)
    whole = cut(stream(times, 20), EncoderClock(LINES, kind.counter.pulse_rate, False), kind)
    torn = cut(
        stream(times, 20, lost=(4 * LINES + 50, 30)),
        EncoderClock(LINES, kind.counter.pulse_rate, False),
        kind,
    )
    assert [one.ordinal for one in torn] == [one.ordinal for one in whole]
    for one, other in zip(whole, torn, strict=True):
        assert other.end_sample - torn[0].first_sample == pytest.approx(
            one.end_sample - whole[0].first_sample, rel=1e-3
        )
    (gap,) = [one for one in torn if one.flags]
    assert gap.flags & Flag.LOST_SAMPLES
    assert gap.lost_samples == 30
    assert gap.samples == LINES - 30


@pytest.mark.parametrize("delay_s", [0.0, 0.001, 0.01])
def test_latency_is_a_time_also_between_pulses(delay_s: float) -> None:
    """The filter delays by a time: at another speed by another number of pulses."""
    kind = calibration(latency_s=np.array([delay_s, 0.0, 0.0, 0.0]))
    times = pulse_times(ramp, 12 * LINES)
    angle = np.arange(1, times.size + 1) / LINES
    delayed = np.interp(times - delay_s, times, angle)
    signal = np.sin(2 * np.pi * delayed)
    for one in cut(
        stream(times, 11, signal), EncoderClock(LINES, kind.counter.pulse_rate, False), kind
    )[1:-1]:
        values = calibrate(one, kind)
        wanted = -200.0 * np.sin(values.angle_rad)
        np.testing.assert_allclose(values["force_1"], wanted, atol=0.5)
        row = Reducer(kind).reduce(Measured(one, kind))
        assert row[BASE.place["force_1_max"]] == pytest.approx(values["force_1"].max(), rel=1e-5)
        assert row[BASE.place["force_1_rms"]] == pytest.approx(
            np.sqrt(np.mean(values["force_1"] ** 2)), rel=1e-5
        )


@settings(max_examples=40, deadline=None)
@given(
    rates=st.lists(st.floats(0.0, 50_000.0, width=32), min_size=1, max_size=200),
    sizes=st.lists(st.integers(1, 40), min_size=1, max_size=60),
    hosts=st.lists(st.integers(0, 3_000_000_000), min_size=1, max_size=60),
    real_time=st.booleans(),
)
def test_time_always_goes_on(
    rates: list[float], sizes: list[int], hosts: list[int], real_time: bool
) -> None:
    clock = EncoderClock(LINES, PulseRate(0, 1.0, 0.0), real_time)
    place, host, last = 0, 10**12, -1
    for sequence, size in enumerate(sizes):
        host += hosts[sequence % len(hosts)]
        values = np.resize(np.array(rates, np.float32), (1, size))
        quality = np.zeros(size, np.uint8)
        ticks = clock.times(Block("daq", sequence, place, 360.0, host, values, quality))
        assert ticks[0] > last
        assert np.all(np.diff(ticks) > 0)
        place, last = place + size, int(ticks[-1])
        assert clock.quiet(host + 5) >= last


class Quiet:
    """A judge that only looks at the speed."""

    def __init__(self) -> None:
        self.speeds: list[float] = []
        self.started: int | None = None

    def begun(self, sample: int) -> None:
        self.started = sample

    def overload(self, force_N: float, beyond_range: bool) -> None:
        raise AssertionError

    def calm(self) -> None:
        raise AssertionError

    def motion(self, speed_rpm: float) -> None:
        self.speeds.append(speed_rpm)

    def revolution(self, revolution: Revolution) -> None:
        return

    def lost(self, samples: int, seconds: float) -> None:
        raise AssertionError


def test_a_crank_that_has_never_turned_stands() -> None:
    processor = Processor(calibration(), lambda: 1e9, real_time=True)
    processor.monitor = Quiet()
    empty, quality = np.empty((6, 0), np.float32), np.empty(0, np.uint8)
    for number in range(3):
        host = 10**12 + number * 200_000_000
        processor.handle(Block("daq", number, 0, 360.0, host, empty, quality))
    assert processor.motion.standing(0.25)
    assert processor.motion.speed_rpm() == 0.0


def test_signs_of_life_show_that_the_crank_stands() -> None:
    kind, judge = calibration(), Quiet()
    processor = Processor(kind, lambda: 1e9, real_time=True)
    processor.monitor = judge
    processor.begin_test()
    times = pulse_times(lambda t: np.ones_like(t), 2 * LINES)
    blocks = stream(times, 18)
    for block in blocks:
        processor.handle(block)
    assert judge.speeds[-1] == pytest.approx(60.0, rel=0.02)
    assert not processor.motion.standing(0.25)
    assert judge.started is not None
    last = blocks[-1]
    empty = np.empty((6, 0), np.float32)
    for number in range(1, 5):
        host = last.host_time_ns + number * 250_000_000
        quality = np.empty(0, np.uint8)
        processor.handle(Block("daq", last.sequence + number, 720, 360.0, host, empty, quality))
    assert processor.motion.standing(0.25)
    assert abs(judge.speeds[-1]) < 1e-9
