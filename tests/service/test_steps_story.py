"""A test of five steps on the simulated rig, killed in the third and taken up again."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from stories import EXAMPLES, RIG, Running, summary

from rigapp.config.loading import read_test
from rigapp.config.sequence import Sequence
from rigapp.report.results import sequence_of, step_numbers
from rigapp.schema.messages import Flag
from rigapp.storage import export_test, open_test

SHORTER = {
    "revolutions = 500": "revolutions = 70",
    "revolutions = 50\n": "revolutions = 12\n",
    "revolutions = 40": "revolutions = 12",
    "duration_s = 60.0 ": "duration_s = 12.0 ",
    "rest_s = 60.0": "rest_s = 20.0",
    "acceleration_rpm_per_s = 60.0": "acceleration_rpm_per_s = 240.0",
    "acceleration_rpm_per_s = 20.0": "acceleration_rpm_per_s = 120.0",
}


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    return tmp_path


def short_test(folder: Path) -> Path:
    text = (EXAMPLES / "steps.toml").read_text("utf-8")
    for old, new in SHORTER.items():
        assert old in text, old
        text = text.replace(old, new)
    path = folder / "steps.toml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.long
@pytest.mark.timeout(400)
def test_five_steps_with_a_resume_in_the_third_are_made_and_predicted(
    folder: Path, running: Callable[..., Running]
) -> None:
    test, file = short_test(folder), folder / "t.h5"
    steps = Sequence(read_test(test).record.run)
    first = running("run", test, "--rig", RIG, "--out", file)

    def third_is_predicted() -> bool:
        """Tell whether the file holds a prediction of the third step: a busy twin is late."""
        if first.committed < 28:
            return False
        with open_test(file) as reader:
            numbers = reader.predictions()["revolution"]
        return any(steps.at(int(one)).step == 3 for one in numbers)

    first.wait_for(third_is_predicted, "the third step has begun")
    first.kill()
    before = summary(file)["last_revolution"]
    assert steps.at(before).step in (3, 4)
    again = running("resume", file, "--rig", RIG)
    again.end()
    assert again.process.returncode == 0, again.complaint()
    with open_test(file) as reader:
        number = reader.column("revolution").astype(int)
        speed, quality = reader.column("speed"), reader.column("quality").astype(int)
        predicted = reader.predictions()
        events = reader.events()
        found = sequence_of(reader)
    assert found is not None
    assert number[-1] == 70
    assert np.all(np.diff(number) >= 1)
    of = step_numbers(found, number)
    assert of.tolist() == [steps.at(int(one)).step for one in number]
    judged = (quality & int(Flag.RAMP | Flag.PAUSED | Flag.PARTIAL | Flag.GAP_BEFORE)) == 0
    for step, rpm in ((1, 30.0), (2, 60.0), (3, 75.0), (4, 45.0), (5, 60.0)):
        mine = judged & (of == step)
        assert mine.any(), step
        np.testing.assert_allclose(speed[mine], rpm, rtol=0.03)
        known = np.isin(predicted["revolution"], number[mine])
        residual = predicted["residual_rms"][known]
        assert np.nanmedian(residual) < 10.0, f"the model follows step {step}"
    told = [one for one in events if one.kind == "step" and one.after]
    assert [one.after.split()[1] for one in told][-2:] == ["5", "2"]
    in_the_rest = 36 <= before <= 38  # one that was cut off is not made up for
    assert np.count_nonzero(quality & Flag.PAUSED) in ((0, 1) if in_the_rest else (1,))
    table = folder / "t.csv"
    export_test(file, table, steps=lambda revolutions: step_numbers(found, revolutions))
    lines = table.read_text().splitlines()
    assert lines[0].endswith(",step")
    assert lines[1].endswith(",1")
    assert lines[-1].endswith(",2")
