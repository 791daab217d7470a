"""The examples run, and their numbers are right."""

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


def test_perfect(capsys: pytest.CaptureFixture[str]) -> None:
    result = run("model_perfect", capsys)
    assert result["maximum_N"] == pytest.approx(96.902350, abs=1e-6)
    assert result["maximum_at_deg"] == pytest.approx(180.0)
    assert result["minimum_N"] == pytest.approx(26.467943, abs=1e-6)
    assert result["rms_N"] == pytest.approx(71.067093, abs=1e-6)
    assert result["largest_difference_N"] < 1e-10


def test_continuous(capsys: pytest.CaptureFixture[str]) -> None:
    result = run("model_continuous", capsys)
    assert result["change_percent_at_0.1_mm"] == pytest.approx(-0.055, abs=1e-3)
    assert result["change_percent_at_0.5_mm"] == pytest.approx(-0.275, abs=1e-3)
    assert result["change_percent_at_1_mm"] == pytest.approx(-0.55, abs=1e-2)
    assert result["compression_from_deg"] == pytest.approx(71.7, abs=0.1)
    assert result["compression_to_deg"] == pytest.approx(288.3, abs=0.1)


def test_contact(capsys: pytest.CaptureFixture[str]) -> None:
    result = run("model_contact", capsys)
    assert result["sprung_contact_fraction"] == pytest.approx(1.0, abs=1e-12)
    assert result["difference_from_technique_2_N"] < 0.05
    assert 30.0 < result["sprung_penetration_um"] < 60.0
    assert 0.65 < result["free_contact_fraction"] < 0.85
    assert 15.0 < result["free_impacts_per_revolution"] < 60.0


def test_measured(capsys: pytest.CaptureFixture[str]) -> None:
    result = run("model_measured", capsys)
    assert result["error_from_counts_N"] < 0.005
    assert result["error_if_speed_were_constant_N"] > 0.1


def test_the_snippet_of_the_page(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    page = (EXAMPLES.parent / "docs" / "model.md").read_text()
    monkeypatch.chdir(EXAMPLES.parent)
    exec(page.split("```python\n")[1].split("```")[0], {})  # noqa: S102
    greatest, holds = capsys.readouterr().out.split()
    assert float(greatest) == pytest.approx(96.636, abs=1e-3)
    assert holds == "True"
