"""The examples of the page on wear run, and their numbers are right."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[3] / "examples"


def run(name: str, capsys: pytest.CaptureFixture[str]) -> dict[str, float]:
    """Import an example from its file, run it, check that it prints what it returns."""
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    result = module.main()
    printed = capsys.readouterr().out
    assert all(key in printed for key in result)
    return result


def test_pressure(capsys: pytest.CaptureFixture[str]) -> None:
    result = run("model_wear_pressure", capsys)
    assert result["peak_pressure_MPa"] == pytest.approx(2.943, rel=2e-3)
    assert result["half_angle_deg"] == pytest.approx(10.35, abs=0.1)
    assert result["perssons_half_angle_deg"] == pytest.approx(10.35, abs=0.6)
    assert result["indentation_um"] == pytest.approx(19.386, rel=3e-3)
    assert result["pressure_integral_over_force"] == pytest.approx(8.43591 / 8.396947, rel=1e-4)


def test_life(capsys: pytest.CaptureFixture[str]) -> None:
    result = run("model_wear_life", capsys)
    assert result["perfect_depth_mm"] == pytest.approx(0.2985, rel=1e-3)
    assert result["continuous_depth_mm"] == pytest.approx(0.2970, rel=1e-3)
    assert result["continuous_error_mm"] <= 1e-3 * result["continuous_depth_mm"]
    assert result["continuous_mean_force_N"] < result["perfect_mean_force_N"]


def test_identify(capsys: pytest.CaptureFixture[str]) -> None:
    result = run("model_wear_identify", capsys)
    assert result["low_mm3_per_Nm"] < 1.1 * 5.05e-4 < result["high_mm3_per_Nm"]
    assert result["next_low_mm3_per_Nm"] < 1.1 * 5.05e-4 < result["next_high_mm3_per_Nm"]
    assert result["scatter_factor"] == pytest.approx(1.15, abs=0.15)
    assert 4000.0 < result["remaining_revolutions"] < 5500.0


def test_live(capsys: pytest.CaptureFixture[str]) -> None:
    result = run("model_wear_live", capsys)
    assert result["cycles"] == 1000.0
    assert result["clearance_mm"] == pytest.approx(0.5 + result["depth_mm"], rel=1e-5)
    assert result["error_mm"] < 0.03 * result["depth_mm"]
