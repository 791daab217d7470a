"""The control chart of the daily check: each rule, the chained store, the pictures."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from rigapp.calibrating.daily_history import append_check, read_history
from rigapp.commands.calibrate import show_history
from rigapp.config.errors import UnusableInput
from rigapp_calibration.load_cell.daily import chart, limit_factor

QUIET = [1.0, 1.0004, 0.9997, 1.0002, 0.9999, 1.0003, 0.9998, 1.0001, 0.9996, 1.0002]


def codes(values: list[float], expanded: float | None = 0.01) -> list[str]:
    return [one.code for one in chart(values, 1.0, expanded).findings]


def test_a_quiet_history_has_limits_and_no_finding() -> None:
    found = chart(QUIET, 1.0, 0.01)
    assert not found.findings
    before = np.array(QUIET[:-1])
    assert found.centre == pytest.approx(before.mean())
    assert found.sigma == pytest.approx(np.abs(np.diff(before)).mean() / 1.128)
    half = limit_factor(len(before)) * found.sigma
    assert found.limits == pytest.approx((found.centre - half, found.centre + half))
    assert limit_factor(9) > 5.0 > limit_factor(12) > 4.0
    assert limit_factor(1000) == pytest.approx(3.0, abs=0.02)
    assert chart(QUIET[:7], 1.0, 0.01).limits is None


@pytest.mark.parametrize(
    ("values", "code"),
    [
        ([*QUIET, 1.003], "beyond_limits"),
        ([*QUIET, *[1.0012] * 2], "two_of_three"),
        ([*QUIET, *([1.0005, 1.0006] * 2)], "four_of_five"),
        ([*QUIET[:8], *([1.00035, 1.0004] * 4)], "shift"),
        ([*QUIET, *np.linspace(0.9997, 1.0003, 7)], "trend"),
        ([1.0, 1.02], "beyond_uncertainty"),
    ],
)
def test_each_rule_is_told(values: list[float], code: str) -> None:
    assert code in codes(values)


def test_random_histories_alarm_seldom() -> None:
    rng = np.random.default_rng(3)
    alarms = sum(
        any(one.action for one in chart(1.0 + 4e-4 * rng.standard_normal(30), 1.0, 0.01).findings)
        for _ in range(400)
    )
    assert alarms < 0.03 * 400


def entry(number: int, ratio: float, calibration: str = "first") -> dict:
    return {
        "time": 1.78e9 + 86400.0 * number, "rig": "Rig", "simulated": True, "operator": "E. Sample",
        "passed": True, "sensitivity_ratio": ratio, "cross_talk_ratio": 0.0001 * (number % 3),
        "zero_N": [0.0, 0.0], "largest_N": 0.3, "allowed_N": 2.0, "weight_N": 390.0,
        "expanded_uncertainty_ratio": 0.007, "calibration": calibration,
        "source": f"journal-{number}",
    }  # fmt: skip


@pytest.fixture
def store(tmp_path: Path) -> Path:
    path = tmp_path / "daily-checks.jsonl"
    append_check(path, entry(0, 1.05, "older"))
    for number, ratio in enumerate(QUIET, 1):
        append_check(path, entry(number, ratio))
    return path


def test_checks_since_the_last_calibration_count(store: Path) -> None:
    append_check(store, entry(len(QUIET), QUIET[-1]))  # judged again: the same readings
    found = read_history(store)
    assert (len(found.entries), found.earlier) == (len(QUIET), 1)
    assert found.in_control
    append_check(store, entry(20, 1.004))
    assert not read_history(store, "Rig").in_control
    with pytest.raises(UnusableInput, match="no daily check of the rig"):
        read_history(store, "Other")


@pytest.mark.parametrize("spoil", ["change", "remove"])
def test_a_changed_store_is_refused(store: Path, spoil: str) -> None:
    lines = store.read_text().splitlines(keepends=True)
    if spoil == "change":
        lines[3] = lines[3].replace("0.9997", "1.0000")
    else:
        del lines[3]
    store.write_text("".join(lines))
    with pytest.raises(UnusableInput, match="line 4 was changed"):
        read_history(store)


def test_history_is_shown_and_drawn(store: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for ending, start in ((".png", b"\x89PNG"), (".html", b"<!"), (".pdf", b"%PDF")):
        to = store.with_suffix(ending)
        assert show_history(store, to, None, as_json=False) == 0
        assert to.read_bytes()[: len(start)].lower() == start.lower()
    assert "in control" in capsys.readouterr().out
    append_check(store, entry(20, 1.004))
    assert show_history(store, None, None, as_json=True) == 1
    result = json.loads(capsys.readouterr().out)
    assert [one["code"] for one in result["findings"]] == ["beyond_limits"]
    with pytest.raises(UnusableInput, match="name it so"):
        show_history(store, store.with_suffix(".gif"), None, as_json=False)
