"""The same recipe and seed give equal rows, started by the command line or by the window."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from patience import PATIENCE_MS, PATIENCE_S

from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import LIGHT
from rigapp.schema.messages import RunState
from rigapp.service.client import Client
from rigapp.service.launch import find_engine
from rigapp.storage import open_test
from rigapp.viewer.connection import EngineConnection
from rigapp.viewer.showntest import ShownTest

EXAMPLES = Path(__file__).parents[2] / "examples"
RIG = EXAMPLES / "simulated.toml"
REVOLUTIONS = 6

OF_THE_START = {
    "time": "counts from the request to start, which comes at any moment between two samples",
    "host_time": "is this computer's clock",
}
"""Columns that cannot be equal, and why; everything else comes from the devices' samples."""


@pytest.fixture
def recipe(tmp_path: Path) -> Path:
    """Return a short test, without the twin (its answers depend on how busy the computer is)."""
    text = (EXAMPLES / "quick.toml").read_text(encoding="utf-8")
    text = text.replace("revolutions = 500", f"revolutions = {REVOLUTIONS}", 1)
    text = text.replace("every_revolutions = 10", "every_revolutions = 2", 1)
    text = text.replace("[prediction]", "[prediction]\nenabled = false", 1)
    path = tmp_path / "short.toml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.fixture
def engine_of_the_window(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Run an engine process as a window starts it, at full speed."""
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    with (tmp_path / "engine.log").open("wb") as log:
        process = subprocess.Popen(
            [sys.executable, "-m", "rigapp", "engine", str(RIG), "--speed", "max"],
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=log,
        )
    yield
    process.terminate()
    process.wait(timeout=PATIENCE_S)


@pytest.mark.long
def test_command_line_and_window_write_the_same_rows(
    recipe: Path, engine_of_the_window: None, tmp_path: Path, qtbot: Any, light_application: Any
) -> None:
    by_line, by_window = tmp_path / "line.h5", tmp_path / "window.h5"
    where = ("--rig", str(RIG), "--out", str(by_line), "--speed", "max")
    line = subprocess.Popen(
        [sys.executable, "-m", "rigapp", "run", str(recipe), *where],
        env={**os.environ, "RIGAPP_RUNTIME_DIR": str(tmp_path / "other")},
        stderr=subprocess.PIPE,
    )
    start_in_the_window(recipe, by_window, qtbot)
    _, errors = line.communicate(timeout=PATIENCE_S)
    assert line.returncode == 0, errors.decode()
    assert_equal(by_line, by_window)


def start_in_the_window(recipe: Path, out: Path, qtbot: Any) -> None:
    """Start the test with the window's own buttons and wait until it is complete."""

    def factory() -> Client:
        entry = find_engine(RIG)
        if entry is None:
            raise ConnectionError("the engine is not there yet")
        return Client(entry, "operator")

    window = MainWindow(
        EngineConnection(factory), ShownTest(), LIGHT, tests=[recipe], results_folder=out.parent
    )
    qtbot.addWidget(window)
    window.show()

    def in_state(*states: RunState) -> bool:
        window.tick()
        status = window._connection.status
        return status is not None and status.engine.state in states

    qtbot.waitUntil(lambda: in_state(RunState.READY), timeout=PATIENCE_MS)
    window.controls.buttons["start"].click()
    window.start_bar.out.setText(str(out))
    window.start_bar.go.click()

    def complete() -> bool:
        return in_state(RunState.STOPPED, RunState.READY) and out.exists() and is_complete(out)

    qtbot.waitUntil(complete, timeout=PATIENCE_MS)
    window.close()


def is_complete(path: Path) -> bool:
    """Tell whether a file holds an ended test."""
    with open_test(path) as test:
        return bool(test.summary()["status"] == "complete")


def assert_equal(one: Path, other: Path) -> None:
    """Compare every device-derived column bit for bit, of the rows and of whole cycles."""
    with open_test(one) as first, open_test(other) as second:
        rows, others = first.rows(), second.rows()
        assert list(rows) == list(others)
        assert len(rows["revolution"]) == REVOLUTIONS
        for name in rows:
            if name not in OF_THE_START:
                np.testing.assert_array_equal(rows[name], others[name], err_msg=name)
        steps, other_steps = np.diff(rows["time"]), np.diff(others["time"])
        np.testing.assert_allclose(steps, other_steps, rtol=0.0, atol=1e-6)
        assert np.ptp(rows["force_max"]) > 0.0
        saved = first.cycle_revolutions()
        np.testing.assert_array_equal(saved, second.cycle_revolutions())
        assert len(saved) > 0
        for index in range(len(saved)):
            columns, other_columns = first.cycle(index).columns, second.cycle(index).columns
            for name in columns:
                if name != "time":
                    np.testing.assert_array_equal(columns[name], other_columns[name], err_msg=name)
