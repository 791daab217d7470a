"""A slow roll of the simulated rig by the engine, from the command to the record and back."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from rigapp.calibrating.rolls import RollPlan, roll_test, rolls_of
from rigapp.calibrating.spindle import speeds_of
from rigapp.commands.live.spindle_runs import calibrate_run_out, plain_test
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig, read_test
from rigapp_calibration.records import seal, unseal

EXAMPLES = Path(__file__).parents[2] / "examples"
RIG = EXAMPLES / "simulated.toml"


@pytest.mark.long
def test_live_roll_makes_a_record_and_its_file_makes_it_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    # A loaded machine may hold the samples back for a while; that is not what is tested here.
    patient = (
        (EXAMPLES / "quick.toml").read_text().replace("stale_data_s = 2.0", "stale_data_s = 60")
    )
    (tmp_path / "patient.toml").write_text(patient)

    def make(to: Path, rig: Path | None, recorded: list[Path]) -> int:
        return calibrate_run_out(
            rig,
            recorded,
            to,
            settings=EXAMPLES / "calibration" / "run_out.toml",
            test=tmp_path / "patient.toml",
            rpm="10",
            revolutions=5,
            orders=4,
            as_json=True,
        )

    assert make(tmp_path / "map.json", RIG, []) == 0
    result = json.loads(capsys.readouterr().out)
    assert result["peak_to_peak_um"] == pytest.approx([6.0, 6.0], abs=0.5)
    # The bushing gives way by more than that; it is taken off and counted as uncertainty.
    assert result["elastic_um"][0] > 5.0
    assert result["expanded_uncertainty_um"] > 2.0 * 0.2 * result["elastic_um"][0]
    assert [one["code"] for one in result["problems"]] == ["few_revolutions"]
    record = unseal((tmp_path / "map.json").read_bytes())
    assert record.kind == "run-out map"
    assert record.content["settings"]["pin"] == {"name": "Pin 7"}
    kept = record.content["taken"]["files"][0]
    assert kept["speed_rpm"] == pytest.approx(10.0, abs=0.2)
    roll = tmp_path / "map.roll-10rpm.h5"
    assert make(tmp_path / "again.json", None, [roll]) == 0
    again = unseal((tmp_path / "again.json").read_bytes())
    assert again.content["result"] == record.content["result"]
    assert again.content["taken"]["files"] == record.content["taken"]["files"]
    with pytest.raises(UnusableInput, match="never overwritten"):
        make(tmp_path / "map.json", None, [roll])


def test_roll_keeps_mechanism_and_guards_of_a_test() -> None:
    rig = read_rig(RIG).record
    roll = roll_test(rig, read_test(EXAMPLES / "quick.toml").record, 4.0, 12, "E. Sample")
    assert roll.run.speed_rpm == 4.0
    assert roll.run.revolutions == 14
    assert roll.cycles.every_revolutions == 1
    assert not roll.prediction.enabled
    assert roll.limits.overload_N == 380.0
    assert roll.limits.overspeed_rpm == 22.0
    plain = roll_test(rig, plain_test(), 4.0, 12, "")
    assert plain.limits.overload_N <= 380.0


@pytest.mark.parametrize("text", ["fast", "", "3,3", "0.1", "60"])
def test_speeds_that_are_no_slow_roll_are_refused(text: str) -> None:
    with pytest.raises(UnusableInput, match="--rpm"):
        speeds_of("--rpm", text, 0.5, 15.0, 1)
    assert speeds_of("--rpm", "3, 6", 0.5, 15.0, 1) == [3.0, 6.0]


def test_rig_and_files_together_are_refused(tmp_path: Path) -> None:
    with pytest.raises(UnusableInput, match="one of the two"):
        calibrate_run_out(
            None,
            [],
            tmp_path / "map.json",
            settings=None,
            test=None,
            rpm="3",
            revolutions=5,
            orders=4,
            as_json=True,
        )


def test_expired_map_is_to_be_taken_out_before_the_roll(tmp_path: Path) -> None:
    old = {
        "kind": "run-out map",
        "calibrated_at": "2020-01-01T00:00:00Z",
        "due_at": "2021-01-01T00:00:00Z",
        "settings": {"pin": {"name": "pin"}},
        "result": {"cos_um": [[1], [1]], "sin_um": [[0], [0]], "expanded_uncertainties_um": [1, 1]},
    }
    (tmp_path / "old.json").write_bytes(seal(old))
    rig = tmp_path / "rig.toml"
    rig.write_text(RIG.read_text().replace("[probes]\n", '[probes]\nrun_out = "old.json"\n'))
    with pytest.raises(UnusableInput, match="take run_out out of"):
        rolls_of(read_rig(rig), plain_test(), RollPlan((3.0,), 5), tmp_path / "map", "")
    assert not list(tmp_path.glob("map*"))
