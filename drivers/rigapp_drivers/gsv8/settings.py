"""The keys of ``[devices.NAME.settings]`` that the GSV-8 driver knows."""

from __future__ import annotations

from collections.abc import Mapping

from rigapp_drivers.api import SettingSpec

BAUD_RATES = (
    *(19200, 38400, 57600, 115200, 230400, 460800),
    *(921600, 1250000, 1458333, 1750000, 2500000, 3500000),
)
DATA_TYPES = ("float32", "int24", "int16")
QUADRATURES = ("x4", "x2", "x1", "pulse and direction")
FILTERS = ("automatic", "28 Hz", "885 Hz", "11400 Hz")

SETTINGS: Mapping[str, SettingSpec] = {
    "sample_rate_Hz": SettingSpec(
        float,
        960.0,
        "Samples per second: a divisor of 48000 from the device's list.",
        1.0,
        48000.0,
    ),
    "data_type": SettingSpec(
        str,
        "float32",
        "Number format on the wire: float32 to 12000 /s, int24 to 24000 /s, int16 to 48000 /s; "
        "with a counter to 16000 /s.",
        choices=DATA_TYPES,
    ),
    "baud_rate": SettingSpec(
        int, 115200, "Speed of a UART or RS-422 line; without meaning on USB.", choices=BAUD_RATES
    ),
    "command_checksum": SettingSpec(
        bool, False, "Protect commands and answers by a CRC-8 (firmware 1.56 or newer)."
    ),
    "data_checksum": SettingSpec(
        object,
        "auto",
        "Protect measured values by a CRC-16 (firmware 1.56 or newer); auto does it where firmware "
        "and line can. Without it a sample waits for the next one.",
        choices=("auto", True, False),
    ),
    "high_speed_frames": SettingSpec(
        bool, False, "Allow several samples in one frame from 12000 /s on (USB, firmware 1.54)."
    ),
    "object_map": SettingSpec(
        list,
        [],
        "Inputs in the order of the frame's objects, for example "
        '["analog_1", "analog_2", "counter_1"]; empty: analog inputs first, counters last.',
    ),
    "counts_per_unit": SettingSpec(
        float,
        1.0,
        "Counts of the encoder for one unit of the counter's value; 1 is assumed until one turn by "
        "hand has confirmed it.",
    ),
    "counter_quadrature": SettingSpec(
        str, "x4", "Edges of A and B that count for each encoder line.", choices=QUADRATURES
    ),
    "counter_index": SettingSpec(bool, True, "Let the encoder's index set the counter."),
    "counter_index_inverted": SettingSpec(bool, False, "The index pulse is low, not high."),
    "counter_home": SettingSpec(
        int, 0, "Count that the index sets.", minimum=0, maximum=(1 << 23) - 1
    ),
    "counter_saturates": SettingSpec(
        bool, False, "Hold the count at the end of its range instead of wrapping."
    ),
    "counter_noise_filter": SettingSpec(bool, False, "Filter noise on the encoder inputs."),
    "counter_pull_ups": SettingSpec(bool, True, "Use the 10 kohm pull-ups of the encoder inputs."),
    "analog_filter": SettingSpec(
        str, "automatic", "Limit of the analog filter; automatic follows the rate.", choices=FILTERS
    ),
    "on_overrun": SettingSpec(
        str,
        "flag",
        "When the device reports that it lost data: flag the samples, or stop the test.",
        choices=("flag", "stop"),
    ),
    "poll_interval_s": SettingSpec(
        float, 1.0, "How often the device is asked for lost data while it streams.", 0.1, 60.0
    ),
    "reply_timeout_s": SettingSpec(
        float, 1.0, "How long to wait for the answer to a command.", 0.05, 10.0
    ),
    "block_s": SettingSpec(
        float, 0.02, "Time of the samples that are handed over together.", 0.001, 1.0
    ),
}
