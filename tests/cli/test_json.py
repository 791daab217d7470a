"""What a script reads in place of a table: `rigapp check --json`, `rigapp doctor --json`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from rigapp.checks.check import Check, CheckVerdict
from rigapp.commands import check, doctor

EXAMPLES = Path(__file__).parents[2] / "examples"
RIG, TEST = EXAMPLES / "simulated.toml", EXAMPLES / "quick.toml"


def found_at_the_rig(*found: Check) -> Any:
    """Return what looks at the rig: no status, and what was found."""
    return lambda records, test: (None, list(found))


@pytest.mark.parametrize("verdict", list(CheckVerdict))
def test_checks_are_values_and_the_status_says_whether_one_blocks(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], verdict: CheckVerdict
) -> None:
    found = Check("Device drive", verdict, "/dev/ttyACM0: said", "Do this")
    monkeypatch.setattr(check, "look", found_at_the_rig(found))
    status = check.check_rig(RIG, TEST, as_json=True)
    told = json.loads(capsys.readouterr().out)
    blocks = verdict is CheckVerdict.BLOCKS
    assert (status, told["blocked"]) == (int(blocks), blocks)
    assert {
        "what": "Device drive",
        "verdict": str(verdict),
        "finding": "/dev/ttyACM0: said",
        "action": "Do this",
    } in told["checks"]
    assert len(told["checks"]) > 3


def test_the_table_has_the_same_lines(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(check, "look", found_at_the_rig())
    check.check_rig(RIG, TEST, as_json=True)
    checks = json.loads(capsys.readouterr().out)["checks"]
    check.check_rig(RIG, TEST)
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == len(checks)
    for line, one in zip(lines, checks, strict=True):
        assert one["what"] in line
        assert one["finding"] in line


@pytest.mark.parametrize("good", [True, False])
def test_findings_of_the_machine_are_values(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], good: bool
) -> None:
    findings = (doctor.Observation("Python", "3.11"), doctor.Observation("port", "said", good))
    monkeypatch.setattr(doctor, "_all", lambda: iter(findings))
    assert doctor.examine(as_json=True) == (0 if good else 1)
    assert json.loads(capsys.readouterr().out) == {
        "good": good,
        "findings": [
            {"subject": "Python", "text": "3.11", "good": True},
            {"subject": "port", "text": "said", "good": good},
        ],
    }
