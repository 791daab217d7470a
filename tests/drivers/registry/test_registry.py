"""The registry: entry points, lazy loading, settings checked in plain sentences."""

from __future__ import annotations

import fnmatch
import math
import subprocess
import sys
import tomllib
from collections.abc import Mapping
from importlib.metadata import EntryPoint
from pathlib import Path
from typing import Any, cast

import pytest

from rigapp_drivers import registry
from rigapp_drivers.api import DriverFactory, DriverInfo, DriverKind, SettingSpec


def _factory(name: str, port: str, settings: Mapping[str, Any]) -> Any:
    return (name, port, settings)


INFO = DriverInfo(
    name="thirdparty",
    title="A third party's box",
    kind=DriverKind.DATA_SOURCE,
    factory=cast(DriverFactory, _factory),
    settings={
        "sample_rate_Hz": SettingSpec(float, 960.0, "Samples per second.", 1.0, 48000.0),
        "address": SettingSpec(int, 128, "Address on the bus.", 128, 135),
        "mode": SettingSpec(str, "slow", "How fast.", choices=("slow", "fast")),
        "crc": SettingSpec(bool, False, "Checksums on."),
        "map": SettingSpec(list, [], "Objects in the frame."),
    },
    simulator="collections:OrderedDict",
)


@pytest.fixture
def third_party(monkeypatch: pytest.MonkeyPatch) -> None:
    entry = EntryPoint(name="thirdparty", value=f"{__name__}:INFO", group=registry.GROUP)
    broken = EntryPoint(name="broken", value="no_such_package_at_all:X", group=registry.GROUP)
    wrong = EntryPoint(name="wrong", value="math:pi", group=registry.GROUP)
    former = EntryPoint(name="former", value="model.mine:DRIVER", group=registry.GROUP)
    entries = (entry, broken, wrong, former)
    monkeypatch.setattr(registry, "entry_points", lambda group: entries)


def test_installed_drivers_are_listed_without_import() -> None:
    script = (
        "import sys; from rigapp_drivers.registry import available_drivers as installed;"
        "print(installed());"
        "print('rigapp_drivers.gsv8.driver' in sys.modules, 'serial' in sys.modules)"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert "gsv8" in done.stdout
    assert "roboclaw" in done.stdout
    assert "False False" in done.stdout


@pytest.mark.usefixtures("third_party")
def test_third_party_driver_loads_by_entry_point() -> None:
    assert registry.available_drivers() == ("broken", "former", "thirdparty", "wrong")
    assert registry.load_driver("thirdparty").title == "A third party's box"


@pytest.mark.usefixtures("third_party")
def test_unknown_driver_names_the_nearest() -> None:
    with pytest.raises(registry.DriverNotFound, match='did you mean "thirdparty"'):
        registry.load_driver("thirdpart")


@pytest.mark.usefixtures("third_party")
@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("broken", "reinstall or update the package no_such_package_at_all"),
        ("wrong", "float"),
        ("former", '"from rigapp.model import ...'),
    ],
)
def test_unusable_entry_is_explained(name: str, words: str) -> None:
    with pytest.raises(registry.DriverNotFound, match=words):
        registry.load_driver(name)


def test_simulator_is_loaded_by_name() -> None:
    from collections import OrderedDict

    assert registry.load_simulator(INFO) is OrderedDict


@pytest.mark.parametrize("target", [None, "no_such_package_at_all:X", "math:nothing", "math:pi"])
def test_missing_simulator_is_explained(target: str | None) -> None:
    import dataclasses

    with pytest.raises(registry.DriverNotFound, match="thirdparty"):
        registry.load_simulator(dataclasses.replace(INFO, simulator=target))


def test_defaults_are_filled_and_whole_numbers_become_floats() -> None:
    checked = registry.check_settings(INFO, {"sample_rate_Hz": 500, "address": 129.0}, "rig.toml")
    assert checked == {
        "sample_rate_Hz": 500.0,
        "address": 129,
        "mode": "slow",
        "crc": False,
        "map": [],
    }
    assert type(checked["sample_rate_Hz"]) is float
    assert type(checked["address"]) is int


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"sample_rate": 1.0}, 'did you mean "sample_rate_Hz"'),
        ({"zzz": 1.0}, "its settings are: address, crc, map, mode, sample_rate_Hz"),
        ({"sample_rate_Hz": "fast"}, '"fast" is not a number'),
        ({"sample_rate_Hz": True}, "true is not a number"),
        ({"sample_rate_Hz": 0.5}, "below the smallest value 1"),
        ({"sample_rate_Hz": 96000}, "above the largest value 48000"),
        ({"sample_rate_Hz": math.nan}, "not a finite number"),
        ({"address": 128.5}, "128.5 is not an integer"),
        ({"address": 127}, "below the smallest value 128"),
        ({"mode": "fasst"}, 'did you mean "fast"'),
        ({"mode": 3}, "3 is not a text"),
        ({"crc": 1}, "1 is not true or false"),
        ({"map": "a"}, '"a" is not a list'),
    ],
)
def test_mistakes_are_said_in_one_sentence(settings: dict[str, Any], words: str) -> None:
    with pytest.raises(registry.SettingsError) as caught:
        registry.check_settings(INFO, settings, "rig.toml [devices.daq.settings]")
    assert words in str(caught.value)
    assert str(caught.value).startswith("rig.toml [devices.daq.settings]")


def test_the_import_rules_cover_every_simulator() -> None:
    root = Path(__file__).parents[3]
    rules = tomllib.loads((root / "pyproject.toml").read_text("utf-8"))["tool"]["importlinter"]
    (rule,) = [row for row in rules["contracts"] if "never imports a simulator" in row["name"]]
    simulators = {
        str(registry.load_driver(name).simulator) for name in registry.available_drivers()
    }
    shared = ("rigapp_drivers.simulated", "rigapp_drivers.simulator_api")
    for module in (*shared, *(one.partition(":")[0] for one in simulators)):
        assert any(fnmatch.fnmatch(module, one) for one in rule["forbidden_modules"]), module
