"""Ctrl-C, kill and a closed terminal close the window, in the middle of a test too."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from patience import PATIENCE_S

PROGRAM = """
import sys
sys.path.insert(0, {folder!r})
from pathlib import Path
from rigapp.schema.messages import RunState
from story_app import TalkingClient, main

class Running(TalkingClient):
    def __init__(self):
        super().__init__()
        self._state = RunState.RUNNING
        self._looks = 0

    def poll(self):
        self._looks += 1
        if self._looks == 5:
            print("looked", flush=True)
        return super().poll()

sys.exit(main(Running, rig_path=Path("rig.toml"), tests=[], results_folder=Path({results!r})))
"""


@pytest.mark.parametrize(
    "number", [signal.SIGINT, pytest.param(signal.SIGHUP, marks=pytest.mark.long)]
)
def test_window_over_a_running_test_is_closed_by_a_signal(
    tmp_path: Path, number: signal.Signals
) -> None:
    program = PROGRAM.format(folder=str(Path(__file__).parent), results=str(tmp_path))
    environment = {
        **os.environ,
        "QT_QPA_PLATFORM": "offscreen",
        "QT_LOGGING_RULES": "default.warning=false",
        "XDG_CONFIG_HOME": str(tmp_path / "config"),
    }
    process = subprocess.Popen(
        [sys.executable, "-c", program],
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        assert process.stdout is not None
        assert any(line == "looked\n" for line in process.stdout)
        process.send_signal(number)
        _, complaint = process.communicate(timeout=PATIENCE_S)
    finally:
        process.kill()
        process.wait()
    assert process.returncode == 0
    assert "Traceback" not in complaint
