"""The keys of ``[devices.NAME.settings]`` of the DATAQ driver."""

from __future__ import annotations

from collections.abc import Mapping

from rigapp.texts import say
from rigapp_drivers.api import SettingSpec
from rigapp_drivers.dataq.protocol import FILTERS, FREE_LINES, MODELS, Clock

NO_LINE = "none"

SETTINGS: Mapping[str, SettingSpec] = {
    "sample_rate_Hz": SettingSpec(
        float,
        960.0,
        say(
            "Scans per second of the internal clock: 60e6 / (srate dec deca). With the"
            " encoder clock the nominal rate: encoder lines times the usual revolutions per"
            " second."
        ),
        0.1,
        160000.0,
    ),
    "model": SettingSpec(int, 2108, say("Model number of the instrument."), choices=tuple(MODELS)),
    "clock": SettingSpec(
        str,
        Clock.INTERNAL.value,
        say("What makes the device scan: its own clock, or each pulse of the encoder on input D6."),
        choices=tuple(clock.value for clock in Clock),
    ),
    "direction_line": SettingSpec(
        str,
        NO_LINE,
        say("Digital line with line B of the encoder, for the direction; with the encoder clock."),
        choices=(NO_LINE, *FREE_LINES),
    ),
    "index_line": SettingSpec(
        str,
        NO_LINE,
        say("Digital line with the index Z of the encoder, for the angle; with the encoder clock."),
        choices=(NO_LINE, *FREE_LINES),
    ),
    "filter": SettingSpec(
        str,
        say("last point"),
        say("What becomes of the readings between two scans; average delays by an unknown time."),
        choices=tuple(FILTERS),
    ),
    "bridge_amplifiers": SettingSpec(
        dict,
        {},
        say(
            "External bridge amplifiers: their output in V for 1 mV/V of the bridge, by"
            " input, for example analog_1 = 2.5."
        ),
    ),
    "digital": SettingSpec(
        bool,
        False,
        say("Record the digital lines D0 to D6 as another row (an encoder index, say)."),
    ),
    "rate_range_Hz": SettingSpec(
        float,
        0.0,
        say("Record the rate input with this range as another row; 0 does not."),
        choices=(0.0, 50e3, 20e3, 10e3, 5e3, 2e3, 1e3, 500.0, 200.0, 100.0, 50.0, 20.0, 10.0),
    ),
    "maximum_speed_rpm": SettingSpec(
        float,
        1000.0,
        say(
            "Faster than this the shaft never turns; a larger counter step is taken as lost bytes."
        ),
        1.0,
        20000.0,
    ),
    "maximum_acceleration_rev_per_s2": SettingSpec(
        float,
        1000.0,
        say(
            "Faster than this the shaft never changes speed; a larger change is taken as"
            " lost bytes."
        ),
        1.0,
        100000.0,
    ),
    "end_scan_list": SettingSpec(
        bool,
        True,
        say("End the scan list by slist n 65535, in case a longer one is in the device."),
    ),
    "command_pause_s": SettingSpec(
        float, 0.02, say("Pause after each command of the set-up."), 0.0, 1.0
    ),
    "idle_check_s": SettingSpec(
        float,
        0.25,
        say("Silence of an encoder-clocked stream after which the device is queried."),
        0.2,
        3600.0,
    ),
    "silence_s": SettingSpec(
        float, 1.0, say("Silence of an internally clocked stream that means a fault."), 0.1, 60.0
    ),
    "reply_timeout_s": SettingSpec(
        float, 1.0, say("How long to wait for the answer to a command."), 0.05, 10.0
    ),
    "block_s": SettingSpec(
        float, 0.02, say("Time of the samples that are handed over together."), 0.001, 1.0
    ),
}
