"""A scripted rig for calibrations: a cell with a hidden matrix that answers like the engine."""

from __future__ import annotations

import os

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("QT_LOGGING_RULES", "qt.qpa.*=false")

import gc
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rigapp.calibrating.session import Rig
from rigapp.process.memory import collect_when_due, stop_automatic_collection
from rigapp.schema.messages import Reply

TRUE_MATRIX = np.array([[201.0, 3.0], [2.0, 198.0]])
TRUE_ZERO = np.array([0.004, -0.003])
CREEP_PER_DECADE = 1e-3
BUOYANCY = 1.0 - 1.2 / 8000.0
RATE = 1000.0

SETTINGS = """schema = 1
[cell]
name = "Pin cell"
[place]
gravity_m_s2 = 9.8123
[angle]
standard_uncertainty_deg = 0.05
[paperwork]
operator = "E. Sample"
"""


@pytest.fixture(autouse=True)
def _collected_between_tests() -> Iterator[None]:
    """Collect garbage after a test only, as the window does between events."""
    thresholds = gc.get_threshold()
    stop_automatic_collection()
    yield
    gc.set_threshold(*thresholds)
    collect_when_due()


class ScriptedRig:
    """Obey hands and answer ``signals``; every question finds the rig four seconds later."""

    def __init__(self) -> None:
        self.noise = np.random.default_rng(7)
        self.now = 100.0
        self.angle_deg: float | None = 0.0
        self.force = 0.0
        self.faults: set[str] = set()
        self.requests: list[tuple[str, dict[str, Any]]] = []
        self.refuses = ""
        self.step_N = 2.0

    def ask(self, verb: str, arguments: dict[str, Any]) -> Any:
        """Answer as a terminal's line does."""
        reply = self.answer(verb, arguments)
        if not reply.ok:
            from rigapp.config.errors import UnusableInput

            raise UnusableInput(reply.sentence)
        return reply.result

    def line(self, verb: str, arguments: dict[str, Any], handler: Callable[[Reply], None]) -> None:
        """Answer as the window's link does."""
        handler(self.answer(verb, arguments))

    def answer(self, verb: str, arguments: dict[str, Any]) -> Reply:
        """Answer one request."""
        self.requests.append((verb, arguments))
        if self.refuses:
            return Reply(ok=False, sentence=self.refuses)
        if verb == "hand":
            return Reply(ok=True, result=self._hand(arguments["what"], arguments["details"]))
        if verb == "inject_fault":
            self.faults.add(arguments["fault"]["kind"])
            return Reply(ok=True)
        if verb == "clear_fault":
            self.faults.discard(arguments["kind"])
            return Reply(ok=True)
        assert verb == "signals"
        return Reply(ok=True, result=self._signals())

    def _hand(self, what: str, details: dict[str, Any]) -> dict[str, int]:
        if what == "turn_pin":
            self.angle_deg = details["angle_deg"] % 360.0
        if what == "hang_weight":
            creep = CREEP_PER_DECADE * np.log10(max(details.get("hung_s", 0.0), 30.0) / 30.0)
            self.force = details["mass_kg"] * details["gravity_m_s2"] * BUOYANCY * (1.0 + creep)
        return {"after_sample": int(self.now * RATE)}

    def _signals(self) -> dict[str, Any]:
        self.now += 4.0
        end = np.arange(self.now - 4.0, self.now, 0.05) + 0.05
        turn = np.radians(self.angle_deg or 0.0)
        force = -self.force * np.array([np.sin(turn), np.cos(turn)])
        swing = 1.0
        if "swinging_weight" in self.faults:
            swing = 1.0 + 0.03 * np.sin(2.0 * np.pi * 0.8 * end)[:, None]
        signal = TRUE_ZERO + (np.linalg.inv(TRUE_MATRIX) @ force) * swing
        signal = signal + self.noise.normal(0.0, 0.1 / 200.0, (len(end), 2))
        if "swapped_bridges" in self.faults:
            signal = signal[:, ::-1]
        return {
            "end": np.round(end * RATE).astype(int).tolist(),
            "signals": dict(zip(("force_1", "force_2"), signal.T.tolist(), strict=True)),
            "samples_per_mean": 50,
            "sample_rate_Hz": RATE,
            "units": ["mV/V", "mV/V", "V", "V"],
            "angle_deg": self.angle_deg,
            "count_deg": 0.1,
            "stands": True,
            "simulated": True,
            "matrix": [[200.0, 0.0], [0.0, 200.0]],
            "zero": [0.0, 0.0],
        }


@pytest.fixture
def scripted() -> ScriptedRig:
    """Return a scripted rig."""
    return ScriptedRig()


@pytest.fixture
def true_matrix() -> np.ndarray:
    """Return the matrix that a calibration of the scripted rig must find."""
    return TRUE_MATRIX


@pytest.fixture
def settings_file(tmp_path: Path) -> Path:
    """Return a settings file."""
    path = tmp_path / "settings.toml"
    path.write_text(SETTINGS, "utf-8")
    return path


@pytest.fixture
def simulated() -> Rig:
    """Return the name of the scripted rig."""
    return Rig("Scripted rig", True, "E. Sample")


@pytest.fixture
def wizard(
    qtbot: Any, scripted: ScriptedRig, simulated: Rig, settings_file: Path, tmp_path: Path
) -> Iterator[Any]:
    """Return the wizard on a scripted rig; the test ticks its bench by hand."""
    from rigapp.gui.wizard.wizard import CalibrationWizard
    from rigapp.presentation.tokens import LIGHT

    wizard = CalibrationWizard(scripted.line, simulated, LIGHT, tmp_path, settings_file)
    qtbot.addWidget(wizard)
    wizard.show()
    yield wizard
    wizard.reject()
