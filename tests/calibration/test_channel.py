"""Records of free channels: fitted, refused, used in a rig file, kept in the file of a test."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rigapp.calibrating.certificate import write_certificate
from rigapp.calibrating.records_in_use import only_records_differ, with_records
from rigapp.commands.calibrate import calibrate_table
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, parse_rig
from rigapp.config.rig import RigFile
from rigapp.engine.recording.store import calibration_record
from rigapp.engine.values.calibrate import calibration_of
from rigapp.report.testreport.facts import stated_uncertainties
from rigapp_calibration.channel import (
    ChannelCalibration,
    ChannelReadings,
    ChannelSettings,
    calibrate_channel,
    value_at,
)
from rigapp_calibration.records import seal
from rigapp_drivers.api import ChannelSpec, StreamSetup

EXAMPLES = Path(__file__).parents[2] / "examples"
SETTINGS, READINGS = (EXAMPLES / "calibration" / f"channel.{one}" for one in ("toml", "csv"))
NEVER = 4_000_000_000.0
INPUTS = [ChannelSpec(f"analog_{number}", "V") for number in range(1, 6)]
SETUP = StreamSetup((*INPUTS, ChannelSpec("counter_1", "count")), 1000.0, {})


def readings(signal: Any, runs: int = 2, points: int = 9, noise: float = 1e-4) -> ChannelReadings:
    """Return readings from 0 to 100 in runs up, of signal(reference) with normal noise."""
    reference = np.tile(np.linspace(0.0, 100.0, points), runs)
    scatter = np.random.default_rng(7).normal(0.0, noise, len(reference))
    series = tuple(str(run + 1) for run in range(runs) for _ in range(points))
    step = np.tile(np.arange(1, points + 1), runs)
    return ChannelReadings(series, step, reference, signal(reference) + scatter)


def fitted(given: ChannelReadings, method: Any = "line", u: float = 0.01) -> ChannelCalibration:
    return calibrate_channel(given, ChannelSettings(method, u))


def test_a_line_is_found_within_its_uncertainty() -> None:
    found = fitted(readings(lambda x: 0.2 + 0.05 * x))
    assert found.accepted
    assert found.scale
    assert found.offset
    assert found.budget
    assert found.scale == pytest.approx(20.0, rel=1e-4)
    assert found.offset == pytest.approx(0.2, abs=2e-4)
    # 0.01 of the reference and 0.002 (0.1 mV) of the readings, twice.
    assert found.budget.expanded == pytest.approx(0.02, rel=0.1)


def test_a_table_follows_a_bent_characteristic_and_holds_what_lies_between() -> None:
    def bent(x: Any) -> Any:
        return 8.0 - 0.06 * x + 2e-4 * x * x

    table, line = (fitted(readings(bent), method) for method in ("table", "line"))
    assert table.accepted
    assert table.points is not None
    assert table.budget
    assert line.budget
    assert line.budget.expanded > 5.0 * table.budget.expanded
    assert np.all(np.diff(table.points[0]) > 0.0)
    true = np.linspace(0.0, 100.0, 401)
    off = np.abs(value_at(table.points, bent(true)) - true)
    assert 0.2 * table.budget.expanded < off.max() < table.budget.expanded


@pytest.mark.parametrize(
    ("given", "method", "code"),
    [
        (readings(lambda x: 0.05 * x, points=2, runs=3), "line", "too_few_points"),
        (readings(lambda x: 0.0 * x, noise=1e-6), "line", "signal_dead"),
        (readings(lambda x: 0.05 * x, runs=1), "table", "no_repeats"),
        (readings(lambda x: (x - 50.0) ** 2), "table", "not_monotonic"),
        (readings(lambda x: 0.05 * x, noise=0.2), "line", "too_uncertain"),
        (readings(lambda x: np.where(x > 50.0, np.nan, x)), "line", "not_a_number"),
    ],
)
def test_what_is_wrong_is_refused_by_its_name(
    given: ChannelReadings, method: str, code: str
) -> None:
    found = fitted(given, method)
    assert not found.accepted
    assert code in [one.code for one in found.problems]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with a record of the example, as a line and as a table."""
    folder = tmp_path_factory.mktemp("records")
    bent = folder / "table.toml"
    bent.write_text(SETTINGS.read_text("utf-8").replace('method = "line"', 'method = "table"'))
    for settings, name in ((SETTINGS, "line.json"), (bent, "table.json")):
        assert calibrate_table("channel", READINGS, settings, folder / name, as_json=False) == 0
    return folder


def rig_with(folder: Path, lines: str, unit: str = "degC") -> Document[RigFile]:
    text = (EXAMPLES / "simulated.toml").read_text("utf-8") + (
        f'\n[channels.oil]\ndevice = "daq"\ninput = "analog_5"\nunit = "{unit}"\n{lines}\n'
    )
    path = folder / "rig.toml"
    return Document(path, text, parse_rig(text, str(path)))


@pytest.mark.parametrize("name", ["line", "table"])
def test_a_record_takes_the_place_of_the_numbers_and_is_in_the_file(
    folder: Path, name: str
) -> None:
    found = with_records(rig_with(folder, f'scale = 7.0\ncalibration = "{name}.json"'))
    assert found.blocking == {}
    assert found.remarks["channel_oil"].startswith("record ")
    result = json.loads(found.texts["channel_oil"])["result"]
    rig = found.rig.record
    if name == "line":
        assert rig.channels["oil"].scale == result["scale_per_V"] == pytest.approx(99.6, rel=0.01)
    else:
        assert len(rig.channels["oil"].table) == 6
    kept = calibration_record(calibration_of(rig, SETUP))
    assert kept["channel_oil"]["record"] == f"{name}.json"
    assert stated_uncertainties(kept) == {"oil": result["expanded_uncertainty_value"]}
    one, other = (rig_with(folder, more).record for more in ("", f'calibration = "{name}.json"'))
    assert only_records_differ(one, other)


def test_an_expired_record_blocks_unless_a_reason_is_given(folder: Path) -> None:
    named = 'calibration = "line.json"'
    why = with_records(rig_with(folder, named), NEVER).blocking["channel_oil"]
    assert "expired on" in why
    reason = f'{named}\ncalibration_override = "the bath is away"'
    used = with_records(rig_with(folder, reason), NEVER)
    assert used.blocking == {}
    assert "the bath is away" in used.remarks["channel_oil"]


def test_a_record_that_does_not_follow_from_its_readings_blocks(folder: Path) -> None:
    content = json.loads((folder / "line.json").read_bytes())
    content["result"]["scale_per_V"] *= 1.01
    rest = {key: value for key, value in content.items() if key not in ("digest", "number")}
    (folder / "forged.json").write_bytes(seal(rest))
    found = with_records(rig_with(folder, 'calibration = "forged.json"'))
    assert "scale_per_V: the record states" in found.blocking["channel_oil"]


def test_a_record_in_another_unit_or_of_something_else_is_refused(folder: Path) -> None:
    with pytest.raises(UnusableInput, match=r"channels\.oil\.unit = 'K', and the record .* degC"):
        with_records(rig_with(folder, 'calibration = "line.json"', "K"))
    (folder / "other.json").write_bytes(seal({"kind": "probe"}))
    with pytest.raises(UnusableInput, match="record of a probe, not of a channel"):
        with_records(rig_with(folder, 'calibration = "other.json"'))
    slow = '[channels.a]\nsource = "drive.current_A"\ncalibration = "line.json"'
    text = (EXAMPLES / "simulated.toml").read_text("utf-8") + slow
    with pytest.raises(UnusableInput, match=r"channels\.a\.calibration has no effect with"):
        parse_rig(text, "rig.toml")


def test_the_certificate_states_points_budget_and_range(folder: Path) -> None:
    to = folder / "table.html"
    write_certificate(folder / "table.json", to)
    words = to.read_text("utf-8")
    for one in ("between the points", "15.02 degC to 90 degC", "Bushing thermometer (channel)"):
        assert one in words
