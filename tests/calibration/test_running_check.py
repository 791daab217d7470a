"""The running check: the pin's inertia is found, its absence and wrong axes are named."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rigapp_calibration.records import unseal
from rigapp_calibration.turning.running_check import Known, SpeedRun, dither_error, running_check

RIG = Path(__file__).parents[2] / "examples" / "simulated.toml"
KNOWN = Known(moment=0.05 * 0.0762, moment_uncertainty=0.01, resolution=2.0, relative=0.001)


def run(rpm: float, moment: float = KNOWN.moment, across: float = 0.0, n: int = 20) -> SpeedRun:
    rng = np.random.default_rng(int(rpm))
    speed = rpm * np.pi / 30.0 * (1.0 + 1e-3 * rng.standard_normal(n))
    force = np.column_stack((3.0 - moment * speed**2, 1.0 + across * speed**2))
    return SpeedRun(speed, force + 0.05 * rng.standard_normal((n, 2)), 0.9)


def test_the_known_term_is_found_with_its_sign() -> None:
    found = running_check([run(30.0), run(120.0), run(240.0)], KNOWN)
    assert found.accepted, found.problems
    fast = found.comparisons[-1]
    assert fast.known[0] == pytest.approx(-KNOWN.moment * (8.0**2 - 1.0) * np.pi**2, rel=1e-2)
    assert fast.measured == pytest.approx(fast.known, abs=0.1)
    assert found.moment == pytest.approx(KNOWN.moment, rel=0.05)
    assert "is passed" in found.sentence


@pytest.mark.parametrize(
    ("moment", "across", "code"),
    [
        (1.5 * KNOWN.moment, 0.0, "inertia_differs"),
        (-KNOWN.moment, 0.0, "inertia_differs"),
        (KNOWN.moment, 0.5 * KNOWN.moment, "across"),
    ],
)
def test_what_does_not_agree_is_named(moment: float, across: float, code: str) -> None:
    found = running_check([run(30.0, moment, across), run(240.0, moment, across)], KNOWN)
    assert not found.accepted
    assert [one.code for one in found.problems] == [code]


def test_few_revolutions_and_slow_runs_are_told() -> None:
    assert not running_check([run(30.0), run(240.0, n=3)], KNOWN).accepted
    slow = running_check([run(30.0), run(40.0)], KNOWN)
    assert slow.accepted
    assert [one.code for one in slow.problems] == ["too_slow"]
    with pytest.raises(ValueError, match="two speeds"):
        running_check([run(30.0)], KNOWN)


def test_error_of_coarse_steps_in_a_mean_against_simulation() -> None:
    rng = np.random.default_rng(4)
    for own in (0.2, 0.5, 0.8):
        true = rng.uniform(-10.0, 10.0, 400)
        read = 2.0 * np.round((true[:, None] + own * rng.standard_normal((400, 4000))) / 2.0)
        error = np.sqrt(np.mean((read.mean(axis=1) - true) ** 2))
        spread = np.sqrt(np.mean(read.var(axis=1)))
        told = np.hypot(dither_error(float(spread), 2.0), spread / np.sqrt(4000))
        assert told > 0.8 * error
    assert dither_error(0.3, 0.0) == 0.0


@pytest.mark.long
def test_simulated_rig_passes_with_its_pin_and_not_with_another(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    from rigapp.calibrating.certificate import write_certificate
    from rigapp.calibrating.running_check import read_run
    from rigapp.commands.live.spindle_runs import check_running

    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    text = RIG.read_text().replace(
        "resolution_N = 2.0", "resolution_N = 2.0\noutboard_mass_kg = 0.08"
    )
    text = text.replace("speed = 20.0", 'speed = "max"')
    (tmp_path / "rig.toml").write_text(text)

    status = check_running(
        tmp_path / "rig.toml", tmp_path / "right.json", speeds="60,240", revolutions=6,
        mass_kg=None, radius_mm=None, follower_off=False, settings=None, as_json=True,
    )  # fmt: skip
    result = json.loads(capsys.readouterr().out)
    assert status == 0, result
    assert result["speeds"][0]["agrees"]
    assert result["speeds"][0]["known_N"][0] == pytest.approx(-3.61, abs=0.05)
    assert unseal((tmp_path / "right.json").read_bytes()).kind == "running check"
    for ending in ("html", "pdf"):
        write_certificate(tmp_path / "right.json", tmp_path / f"c.{ending}")
    assert "the known inertia of the pin" in (tmp_path / "c.html").read_text()
    runs = [read_run(tmp_path / f"right.{rpm:g}rpm.h5", rpm) for rpm in (60.0, 240.0)]
    wrong = running_check(runs, replace(KNOWN, moment=0.04 * 0.0762))
    assert [one.code for one in wrong.problems] == ["inertia_differs"]
