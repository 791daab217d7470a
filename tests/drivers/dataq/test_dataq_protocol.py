"""Commands, words, replies and conversions against bytes and numbers written by hand."""

from __future__ import annotations

import struct

import numpy as np
import pytest

from rigapp_drivers.api import ChannelSpec, DataRequest, InvalidRequest, filled
from rigapp_drivers.dataq import protocol as p
from rigapp_drivers.dataq.plan import make_plan
from rigapp_drivers.dataq.protocol import Clock
from rigapp_drivers.dataq.scans import Layout, ScanParser, Steps
from rigapp_drivers.dataq.settings import SETTINGS


def _request(**inputs: tuple[str, float]) -> DataRequest:
    return DataRequest(960.0, inputs)


def test_the_set_up_of_a_di_4108_is_these_lines_in_this_order() -> None:
    request = _request(
        counter_1=("counter", 900.0), analog_2=("voltage", 5.0), analog_1=("voltage", 10.0)
    )
    settings = filled(SETTINGS, {"model": 4108, "digital": True, "rate_range_Hz": 500.0})
    lines = make_plan(request, settings | {"filter": "average"}).commands(end_list=True)
    assert lines == (
        b"encode 0\r",
        b"endo 0\r",
        b"slist 0 0\r",
        b"slist 1 257\r",
        b"slist 2 8\r",
        b"slist 3 1801\r",
        b"slist 4 10\r",
        b"slist 5 65535\r",
        b"filter 0 1\r",
        b"filter 1 1\r",
        b"dec 1\r",
        b"deca 1\r",
        b"srate 62500\r",
        b"ps 2\r",
    )


def test_analog_1_is_channel_0_and_the_end_of_the_list_can_be_left_away() -> None:
    request = _request(analog_1=("voltage", 10.0), analog_8=("voltage", 10.0))
    lines = make_plan(request, filled(SETTINGS, {})).commands(end_list=False)
    assert [line for line in lines if line.startswith(b"slist")] == [
        b"slist 0 0\r",
        b"slist 1 7\r",
        b"slist 2 10\r",
    ]


@pytest.mark.parametrize(
    ("clock", "line"), [(Clock.INTERNAL, b"start\r"), (Clock.ENCODER, b"start 2\r")]
)
def test_start(clock: Clock, line: bytes) -> None:
    assert p.start_line(clock) == line


@pytest.mark.parametrize(
    ("hertz", "word"), [(50e3, 0x0109), (500.0, 1801), (100.0, 0x0909), (10.0, 0x0C09)]
)
def test_rate_words(hertz: float, word: int) -> None:
    assert p.rate_word(hertz) == word


def test_rate_words_of_other_ranges_are_refused() -> None:
    with pytest.raises(ValueError, match="no range of 30 Hz"):
        p.rate_word(30.0)


@pytest.mark.parametrize("channel", [-1, 8])
def test_analog_words_of_other_channels_are_refused(channel: int) -> None:
    with pytest.raises(ValueError, match="is not 0 to 7"):
        p.analog_word(channel, 0)


@pytest.mark.parametrize(
    ("data", "lines", "rest"),
    [
        (b"info 1 2108\r", ["info 1 2108"], b""),
        (b"info 1 2108\r\0\0slist 0 0\rps", ["info 1 2108", "slist 0 0"], b"ps"),
        (b"stop\r\n", ["stop"], b""),
        (b"\xff\r", ["\\xff"], b""),
        (b"", [], b""),
    ],
)
def test_idle_text_is_cut_into_lines(data: bytes, lines: list[str], rest: bytes) -> None:
    assert p.split_replies(data) == (lines, rest)


def test_query_values() -> None:
    assert p.query_value(b"info 1\r", "info 1 2108") == "2108"
    assert p.query_value(b"info 9\r", "info 9 60000000") == "60000000"
    for reply in ("info 1", "info 2 65", "", "info 1 "):
        with pytest.raises(p.BadReply, match="info 1"):
            p.query_value(b"info 1\r", reply)


@pytest.mark.parametrize(
    ("data", "left"),
    [
        (b"start\r\x01\x02", b"\x01\x02"),
        (b"start 2\r\x01\x02", b"\x01\x02"),
        (b"start\r", b""),
        (b"star", None),
        (b"", None),
        (b"start 3\r\x01", b"start 3\r\x01"),
        (b"\x01\x0d\x02", b"\x01\x0d\x02"),
        (b"\x00start\r", b"\x00start\r"),
        (b"start\rstart\r", b"start\r"),
    ],
)
def test_only_an_exact_echo_at_the_beginning_is_taken_off(data: bytes, left: bytes | None) -> None:
    assert p.without_echo(data, p.echoes_of(b"start 2\r")) == left


# --- conversions: (word as it stands in 16 bits, electrical value), by hand ----------------------

ANALOG = [
    (2108, 10.0, 0x0000, 0.0),
    (2108, 10.0, 0x7FFF, 9.99969482421875),
    (2108, 10.0, 0x8000, -10.0),
    (2108, 10.0, 0xFFFF, -0.00030517578125),
    (2108, 10.0, 0x4000, 5.0),
    (4108, 5.0, 0x4003, 2.5),
    (4108, 0.2, 0xC001, -0.1),
    (4108, 0.2, 0xFFFF, -0.0000244140625),
    (4108, 1.0, 0x0003, 0.0),
]


def _value(spec: ChannelSpec, raw: int) -> float:
    return spec.scale * raw + spec.offset


def _scan(layout: Layout, *words: int) -> np.ndarray:
    parser = ScanParser(layout, Steps(0, 10, 10))
    parser.feed(2 * struct.pack(f"<{len(words)}H", *words))
    (run,) = parser.finish()
    return run.values[:, 0]


@pytest.mark.parametrize(("model", "volts", "word", "expected"), ANALOG)
def test_analog_conversion(model: int, volts: float, word: int, expected: float) -> None:
    settings = filled(SETTINGS, {"model": model})
    plan = make_plan(_request(analog_3=("voltage", volts)), settings)
    raw = _scan(plan.layout, word, 0x8000)
    assert _value(plan.channels[0], int(raw[0])) == pytest.approx(expected, abs=1e-12)
    assert (plan.channels[0].unit, plan.channels[0].name) == ("V", "analog_3")


@pytest.mark.parametrize(
    ("word", "expected"), [(0x8000, 0.0), (0x7FFF, 500.0), (0x0000, 250.0038147554742)]
)
def test_rate_conversion(word: int, expected: float) -> None:
    plan = make_plan(_request(), filled(SETTINGS, {"rate_range_Hz": 500.0}))
    raw = _scan(plan.layout, word, 0x8000)
    assert _value(plan.channels[0], int(raw[0])) == pytest.approx(expected, abs=1e-9)
    assert plan.channels[0].unit == "Hz"


@pytest.mark.parametrize(
    ("word", "lines"), [(0x0100, 1), (0x4000, 64), (0xFF00, 127), (0x8000, 0), (0x00FF, 0)]
)
def test_digital_lines_are_in_the_high_byte(word: int, lines: int) -> None:
    plan = make_plan(_request(), filled(SETTINGS, {"digital": True}))
    assert _scan(plan.layout, word, 0x8000)[0] == lines


@pytest.mark.parametrize(
    ("word", "count"), [(0x8000, 0), (0x8001, 1), (0xFFFF, 32767), (0x0000, 32768), (0x7FFF, 65535)]
)
def test_counter_conversion(word: int, count: int) -> None:
    plan = make_plan(_request(counter_1=("counter", 900.0)), filled(SETTINGS, {}))
    assert plan.channels[-1].name == "counter_1"
    assert _scan(plan.layout, word)[0] == count


# --- what cannot be -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("inputs", "settings", "sentence"),
    [
        ({"analog_1": ("bridge", 3.5)}, {}, "no bridge inputs; use a bridge amplifier"),
        ({"analog_1": ("voltage", 5.0)}, {}, "no range of 5 V; it has 10 V"),
        ({"analog_1": ("voltage", 3.0)}, {"model": 4108}, "it has 10, 5, 2, 1, 0.5, 0.2 V"),
        ({"analog_9": ("voltage", 10.0)}, {}, "write analog_1 to analog_8"),
        ({"counter_2": ("counter", 900.0)}, {}, "one counter, counter_1"),
        ({"counter_1": ("counter", 0.0)}, {}, "0 counts per revolution cannot be"),
        ({"counter_1": ("counter", float("nan"))}, {}, "cannot be"),
        ({"analog_1": ("current", 10.0)}, {}, "a current input does not exist"),
        ({"counter_1": ("counter", 90000.0)}, {"maximum_speed_rpm": 20000.0}, "lower maximum"),
        ({}, {"direction_line": "D0"}, 'direction_line = "D0" needs clock = "encoder"'),
        ({}, {"index_line": "D5"}, 'index_line = "D5" needs clock = "encoder"'),
        (
            {},
            {"clock": "encoder", "index_line": "D2", "rate_range_Hz": 10e3},
            'index_line = "D2" is the rate input',
        ),
        (
            {},
            {"clock": "encoder", "index_line": "D1", "direction_line": "D1"},
            'both "D1"; each needs its own',
        ),
    ],
)
def test_refusals_say_what_to_do(
    inputs: dict[str, tuple[str, float]], settings: dict[str, object], sentence: str
) -> None:
    with pytest.raises(InvalidRequest, match=sentence):
        make_plan(_request(**inputs), filled(SETTINGS, settings))


@pytest.mark.parametrize(
    ("settings", "wiring"),
    [
        ({}, "encoder line A to D3 (counter)"),
        ({"rate_range_Hz": 10e3}, "encoder line A to D3 (counter), D2 (rate)"),
        (
            {"clock": "encoder", "direction_line": "D0", "index_line": "D1"},
            "encoder line A to D6 (scan clock), D3 (counter), line B to D0, line Z to D1",
        ),
    ],
)
def test_the_wiring_is_told(settings: dict[str, object], wiring: str) -> None:
    plan = make_plan(_request(counter_1=("counter", 900.0)), filled(SETTINGS, settings))
    assert plan.wiring == wiring


def test_the_encoder_clock_refuses_a_nominal_rate_above_its_base_rate() -> None:
    settings = filled(SETTINGS, {"clock": "encoder"})
    with pytest.raises(InvalidRequest, match="20000 at most"):
        make_plan(DataRequest(30000.0, {"analog_1": ("voltage", 10.0)}), settings)


def test_steps_follow_from_speed_and_acceleration() -> None:
    request = _request(counter_1=("counter", 900.0))
    settings = filled(
        SETTINGS, {"maximum_speed_rpm": 640.0, "maximum_acceleration_rev_per_s2": 512.0}
    )
    assert make_plan(request, settings).steps == Steps(0, 12, 3)
    assert make_plan(request, {**settings, "clock": "encoder"}).steps == Steps(1, 1, 0)
