"""`rigapp check`: the data source's own test value, where it has one."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from rigapp.checks.check import CheckVerdict
from rigapp.commands.check import self_check
from rigapp.config.loading import read_rig
from rigapp_drivers.api import (
    ChannelSpec,
    DriverInfo,
    DriverKind,
    Identity,
    ReplyTimeout,
    SettingSpec,
    StreamSetup,
)

RIG = Path(__file__).parents[2] / "examples" / "simulated.toml"


@dataclass
class Value:
    name: str
    measured: float
    right: bool
    expected: float = 1.75
    unit: str = "mV/V"


class Device:
    """Something that opens, configures and closes."""

    name, port = "daq", "memory"
    closed = False

    def open(self) -> Identity:
        return Identity("test", "memory", "1", "1", "memory")

    def configure(self, request: Any) -> Any:
        return StreamSetup((ChannelSpec("analog_1", "mV/V"),), 960.0, {})

    def close(self) -> None:
        self.closed = True


class Checking(Device):
    """A source with a test value."""

    def __init__(self, *values: Value, fails: bool = False) -> None:
        self.values, self.fails = values, fails

    def half_scale(self) -> tuple[Value, ...]:
        if self.fails:
            raise ReplyTimeout("daq", "memory", "no answer to the test value")
        return self.values


class Spindle(Device):
    name = "drive"

    def configure(self, request: Any) -> Any:
        return {}


def checked(source: Device) -> list[Any]:
    def load(name: str) -> DriverInfo:
        if name == "gsv8":
            settings = {"sample_rate_Hz": SettingSpec(float, 960.0, "Sample rate.")}
            return DriverInfo(name, "", DriverKind.DATA_SOURCE, lambda *_: source, settings)
        settings = {"address": SettingSpec(int, 128, "Address.")}
        return DriverInfo(name, "", DriverKind.SPINDLE, lambda *_: Spindle(), settings)

    ports = {"daq": "memory", "drive": "memory"}
    found = list(self_check(read_rig(RIG).record, ports, load))
    assert source.closed
    return found


def test_right_test_values_are_told() -> None:
    (check,) = checked(Checking(Value("analog_1", 1.75, True), Value("analog_2", 1.75, True)))
    assert check.verdict is CheckVerdict.GOOD
    assert "analog_1, analog_2" in check.sentence


def test_wrong_test_value_blocks_and_is_named() -> None:
    (check,) = checked(Checking(Value("analog_1", 1.75, True), Value("analog_2", 0.35, False)))
    assert check.verdict is CheckVerdict.BLOCKS
    assert check.sentence == "analog_2 0.35 mV/V in place of 1.75"
    assert "rig file" in check.advice


@pytest.mark.parametrize(("source", "lines"), [(Device(), 0), (Checking(fails=True), 1)])
def test_source_without_test_value_blocks_nothing(source: Device, lines: int) -> None:
    found = checked(source)
    assert len(found) == lines
    assert all(check.verdict is CheckVerdict.ATTENTION for check in found)
