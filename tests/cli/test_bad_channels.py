"""Every mistake in ``[channels.NAME]`` is one sentence with file, key and remedy."""

from __future__ import annotations

from pathlib import Path

import pytest

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_rig
from rigapp.engine.devices import plan_devices

RIG = (Path(__file__).resolve().parents[2] / "examples" / "simulated.toml").read_text("utf-8")
GOOD = 'device = "daq"\ninput = "analog_5"\nunit = "degC"\n'

WRONG = [
    ("Bushing", GOOD, "channels.Bushing is no name for a channel; write at most 40 lower-case"),
    ("raw_a", GOOD, "channels.raw_a is no name"),
    ("force", GOOD, "channels.force is not a possible name: its column 'force' exists"),
    ("speed", GOOD, "its column 'speed' exists"),
    ("force_1", GOOD, "channels.force_1 is not a possible name"),
    ("wear_depth", GOOD, "its column 'wear_depth' exists"),
    ("count", GOOD, "its column 'count' exists"),
    ("a", 'device = "daq"\ninput = "analog_5"\n', "channels.a.unit is missing; write unit ="),
    ("a", 'unit = "degC"\n', "channels.a.device is missing; write device ="),
    ("a", GOOD.replace("daq", "drive"), "channels.a.device = 'drive' must be 'daq', the device of"),
    ("a", GOOD.replace("analog_5", "analog_3"), "both name 'analog_3'; each needs an input"),
    ("a", GOOD + "scale = 0.0", "channels.a.scale = 0 is outside"),
    ("a", GOOD + "scale = nan", "channels.a.scale = nan is not a finite number"),
    ("a", GOOD + "range_V = 0.0", "channels.a.range_V = 0 is outside 0.001 to 1000 V"),
    ("a", GOOD + "latency_ms = -1.0", "channels.a.latency_ms = -1 is outside 0 to 100 ms"),
    ("a", GOOD + "scale = 2.0\ntable = [[0, 1], [1, 2]]", "a.table is given together with scale"),
    ("a", GOOD + "table = [[0, 1]]", "channels.a.table has one point"),
    ("a", GOOD + "table = [[0, 1], [0, 2]]", "a.table 2: voltage 0 V is not above 0 V before"),
    ("a", GOOD + "table = [[0, 1], [1, 1]]", "a.table 2: value 1 is that of the row before"),
    ("a", GOOD + "table = [[0, 1], [1, 2], [2, 0]]", "channels.a.table rises and falls"),
    ("a", GOOD + "scala = 1.0", "channels.a.scala is not a known key; did you mean scale"),
    ("a", GOOD + 'source = "drive.current_A"', "channels.a.device has no effect with"),
    ("a", 'source = "current_A"', "channels.a.source = 'current_A' is not readable; write"),
    ("a", 'source = "oven.temperature_C"', "oven is not among the devices (daq, drive)"),
    ("a", 'source = "daq.temperature_C"', "daq is the data source; give channels.a.device"),
]


@pytest.mark.parametrize(("name", "body", "words"), WRONG)
def test_a_wrong_channel_is_refused_with_its_key(name: str, body: str, words: str) -> None:
    with pytest.raises(UnusableInput) as refused:
        parse_rig(f"{RIG}\n[channels.{name}]\n{body}\n", "rig.toml")
    assert str(refused.value).startswith("rig.toml: ")
    assert words in str(refused.value)


def test_two_channels_cannot_share_a_column() -> None:
    two = f'[channels.a]\n{GOOD}\n[channels.a_max]\nsource = "drive.current_A"\n'
    with pytest.raises(UnusableInput, match=r"channels\.a_max is not a possible name"):
        parse_rig(f"{RIG}\n{two}", "rig.toml")


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ('source = "drive.humidity_percent"', "reports current_A, supply_V, temperature_C"),
        ('source = "drive.torque_Nm"', "give devices.drive.settings.torque_constant_Nm_per_A, wi"),
        (GOOD.replace("analog_5", "analog_99"), "channels.a.input = 'analog_99'"),
    ],
)
def test_what_a_device_cannot_do_is_refused_before_a_port_is_opened(body: str, words: str) -> None:
    rig = parse_rig(f"{RIG}\n[channels.a]\n{body}\n", "rig.toml")
    with pytest.raises(UnusableInput) as refused:
        plan_devices(rig, "rig.toml")
    assert words in str(refused.value)
