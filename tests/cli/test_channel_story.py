"""A rig with channels of its own, as a person uses it: run, limit, resume, export, replay."""

from __future__ import annotations

import csv
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from commandline import program, rigapp
from patience import PATIENCE_S

from rigapp.replay.client import ReplayClient
from rigapp.schema.loglines import alarm_change
from rigapp.storage import open_test

EXAMPLES = Path(__file__).parents[2] / "examples"
RIG = EXAMPLES / "simulated_channels.toml"
COMMAND = [sys.executable, "-m", "rigapp"]
REVOLUTIONS = 60
WARM_DEGC = 21.2
"""Above the room, which has 21 degC when the test begins, and soon below the bushing."""

FREE = ("bushing_temperature", "motor_current", "room_temperature", "humidity")


@pytest.fixture(autouse=True)
def _own_runtime_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))


def recipe(folder: Path) -> Path:
    rule = f'[[limits.rule]]\nquantity = "bushing_temperature_mean"\nwarning_above = {WARM_DEGC}\n'
    text = (EXAMPLES / "quick.toml").read_text("utf-8")
    text = text.replace("revolutions = 500", f"revolutions = {REVOLUTIONS}")
    path = folder / "test.toml"
    path.write_text(text.replace("[prediction]", f"{rule}\n[prediction]"), "utf-8")
    return path


@pytest.mark.long
def test_channels_go_from_the_rig_file_to_limit_file_export_and_replay(tmp_path: Path) -> None:
    test, out = recipe(tmp_path), tmp_path / "t.h5"
    refused = rigapp("check", EXAMPLES / "simulated.toml", test)
    assert refused.returncode == 2
    assert "(bushing_temperature_mean): there is no such quantity" in refused.stderr
    first = subprocess.Popen(
        [*COMMAND, "run", test, "--rig", RIG, "--out", out, "--progress", "json"],
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        assert first.stdout is not None
        for line in first.stdout:
            if '"alarm"' in line and "bushing_temperature_mean" in line:
                break
        first.send_signal(signal.SIGINT)
        first.communicate(timeout=PATIENCE_S)
    finally:
        first.kill()
    with open_test(out) as reader:
        assert 0 < reader.committed() < REVOLUTIONS
    gone_on = program("resume", out, "--rig", RIG, "--speed", "max")
    assert gone_on.returncode == 0, gone_on.stderr

    with open_test(out) as reader:
        assert int(reader.column("revolution")[-1]) == REVOLUTIONS
        bushing = reader.column("bushing_temperature_mean")
        assert np.isfinite(bushing).all()
        assert bushing[-1] > WARM_DEGC
        assert np.isfinite(reader.column("motor_current")).all()
        assert (reader.column("motor_current_age") >= 0.0).all()
        assert np.nanmedian(reader.column("room_temperature")) == pytest.approx(21.0, abs=0.1)
        assert np.nanmedian(reader.column("humidity")) == pytest.approx(45.0, abs=0.5)
        cycle = reader.cycle(-1).columns
        shown, signal_V = cycle["bushing_temperature"], cycle["raw_bushing_temperature"]
        np.testing.assert_allclose(shown, 100.0 * signal_V, atol=0.3)  # latency: its neighbours
        raised = [one for one in reader.events() if (found := alarm_change(one)) and found.active]
        assert any("bushing_temperature_mean" in one.key for one in raised)

    assert rigapp("export", out, "--to", tmp_path / "t.csv").returncode == 0
    with (tmp_path / "t.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(bushing)
    assert float(rows[-1]["bushing_temperature_mean_degC"]) == pytest.approx(bushing[-1])
    assert "humidity_percent" in rows[0]
    replay = ReplayClient(out, at_end=True)
    try:
        snapshot = None
        while snapshot is None:
            snapshot = replay.poll()
    finally:
        replay.close()
    assert {f"{name}_age" for name in FREE[1:]} <= set(snapshot.columns)
    assert snapshot.recorded == len(bushing)
