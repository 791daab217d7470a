"""A calibration in the wizard on the real simulated rig, engine and plant included."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from calibration.records import unseal
from rigapp.commands.live_calibration import Rig
from rigapp.config.loading import read_rig
from rigapp.engine.messages import Request
from rigapp.gui.calibration.wizard import CalibrationWizard
from rigapp.gui.palette import LIGHT
from rigapp.gui.tasks import Worker
from rigapp.service.host import EngineHost
from rigapp.simulation.constants import plant_section

WITHIN_S = 240.0
EXAMPLE = Path(__file__).parents[2] / "examples" / "simulated.toml"


class HostLine:
    """Ask an engine of this process as the window's link does: on a worker, answers when pumped."""

    def __init__(self, host: EngineHost) -> None:
        self._host = host
        self.worker = Worker("story-requests", bound=64)

    def __call__(self, verb: str, arguments: dict[str, Any], handler: Any) -> None:
        """Queue a request."""
        request = Request(verb=verb, arguments=arguments, operator="E. Sample")
        assert self.worker.submit(lambda: self._host.handle(request), handler, _raise)


def _raise(error: Exception) -> None:
    raise error


@pytest.fixture
def line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[HostLine]:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    host = EngineHost(read_rig(EXAMPLE), 20.0)
    line = HostLine(host)
    try:
        host.connect()
        yield line
    finally:
        line.worker.close()
        host.close()


def pump(wizard: CalibrationWizard, line: HostLine, until: Any, what: str, within: float) -> None:
    deadline = time.monotonic() + within
    while not until():
        assert time.monotonic() < deadline, (
            f"{what} did not come: {wizard.readings.problem.text()} {wizard.bench.readiness}"
        )
        wizard.bench.tick()
        line.worker.deliver()
        time.sleep(0.005)


def test_wizard_finds_the_plants_matrix_and_refuses_exchanged_plugs(
    qtbot: Any, line: HostLine, tmp_path: Path
) -> None:
    settings = tmp_path / "settings.toml"
    settings.write_text(
        'schema = 1\n[cell]\nname = "Pin cell"\n[place]\ngravity_m_s2 = 9.8123\n', "utf-8"
    )
    rig = Rig("Simulated slider-crank", True, "E. Sample")
    wizard = CalibrationWizard(line, rig, LIGHT, tmp_path, settings)
    qtbot.addWidget(wizard)
    wizard.show()
    bench = wizard.bench
    wizard.next()
    bench.lend_a_hand()
    pump(wizard, line, wizard.angle.isComplete, "the angle", WITHIN_S)
    wizard.next()
    assert wizard.currentPage() is wizard.readings
    bench.goes_ahead = True
    pump(wizard, line, lambda: bench.session.procedure.position > 43, "series 3", WITHIN_S)
    # The plugs of the two bridges are exchanged at the last pin angle.
    wizard.readings.hands.mistake.setCurrentIndex(2)
    pump(wizard, line, wizard.readings.isComplete, "the end", WITHIN_S)
    wizard.next()
    pump(wizard, line, lambda: bench.outcome is not None, "the verdict", WITHIN_S)
    assert wizard.result_page.verdict.text() == "✗ Refused"
    assert not list(tmp_path.glob("*.json"))
    # The plugs are put right and the last series is taken again.
    wizard.back()
    wizard.readings.hands.mistake.setCurrentIndex(0)
    assert bench.reject(len(bench.session.procedure.taken) - 1, "plugs exchanged")
    pump(wizard, line, wizard.readings.isComplete, "series 4 again", WITHIN_S)
    wizard.next()
    pump(wizard, line, lambda: bench.outcome is not None, "the verdict", WITHIN_S)
    assert wizard.result_page.verdict.text() == "✓ Accepted", wizard.result_page.problems.text()
    wizard.next()
    record = unseal(bench.outcome.saved.read_bytes())
    result = record.content["result"]
    x = plant_section(read_rig(EXAMPLE).record).cross_talk_percent / 100.0
    truth = np.array([[1.0, x], [x, 1.0]]) @ np.diag([200.0, 200.0])
    found = np.array(result["matrix_N_per_unit"])
    allowed = 2.0 * np.array(result["matrix_standard_uncertainty_N_per_unit"])
    assert np.all(np.abs(found - truth) < allowed)
    # A force of 300 N in any direction is told within the stated U.
    turn = np.radians(np.arange(0.0, 360.0, 15.0))
    force = 300.0 * np.stack((np.cos(turn), np.sin(turn)))
    signal = np.linalg.inv(truth) @ force
    told = found @ (signal - np.array(result["zero"])[:, None])
    line_N = result["uncertainty_line_N"]
    assert np.hypot(*(told - force)).max() < line_N["constant_N"] + 300.0 * line_N["per_N"]
    wizard.accept()
    pump(wizard, line, lambda: not wizard.isVisible(), "the end", WITHIN_S)
