"""A calibration in the wizard on the real simulated rig, engine and plant included."""

from __future__ import annotations

import time
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rigapp.calibrating.session import Rig
from rigapp.commands.run import run_test
from rigapp.config.loading import read_rig
from rigapp.gui.wizard.wizard import CalibrationWizard
from rigapp.presentation.tokens import LIGHT
from rigapp.schema.messages import Request
from rigapp.service.host import EngineHost
from rigapp.simulation.constants import plant_section
from rigapp.simulation.handle import start_simulated_rig
from rigapp.storage import open_test
from rigapp.viewer.tasks import TaskWorker
from rigapp_calibration.load_cell.force_uncertainty import force_uncertainty
from rigapp_calibration.load_cell.plans import CREEP_SERIES
from rigapp_calibration.records import unseal
from rigapp_calibration.taking.procedure import StepKind

WITHIN_S = 240.0
REVOLUTIONS = 16
EXAMPLE = Path(__file__).parents[2] / "examples" / "simulated.toml"


class HostLine:
    """Ask an engine of this process as the window's link does: on a worker, answers when pumped."""

    def __init__(self, host: EngineHost) -> None:
        self._host = host
        self.worker = TaskWorker("story-requests", bound=64)

    def __call__(self, verb: str, arguments: dict[str, Any], handler: Any) -> None:
        """Queue a request."""
        request = Request(verb=verb, arguments=arguments, operator="E. Sample")
        assert self.worker.submit(lambda: self._host.handle(request), handler, _raise)


def _raise(error: Exception) -> None:
    raise error


@pytest.fixture
def line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[HostLine]:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    file = tmp_path / "rig.toml"
    file.write_text(EXAMPLE.read_text("utf-8").replace("speed = 20.0", 'speed = "max"'), "utf-8")
    host = EngineHost(read_rig(file), 20.0)
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
            f"{what} did not come: {wizard.readings.problem.text()} {wizard.live.readiness}"
        )
        wizard.live.tick()
        line.worker.deliver()
        time.sleep(0.005)


@pytest.mark.long
@pytest.mark.timeout(900)
def test_wizard_tells_plugs_refuses_wrong_weights_and_a_test_with_its_record_tells_the_forces(
    qtbot: Any, line: HostLine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    settings = tmp_path / "settings.toml"
    settings.write_text(
        'schema = 1\n[cell]\nname = "Pin cell"\n[place]\ngravity_m_s2 = 9.8123\n', "utf-8"
    )
    file = tmp_path / "rig.toml"
    rig = Rig("Simulated slider-crank", True, "E. Sample", file)
    wizard = CalibrationWizard(line, rig, LIGHT, tmp_path, settings)
    qtbot.addWidget(wizard)
    wizard.show()
    live = wizard.live
    wizard.next()
    live.perform_step()
    pump(wizard, line, wizard.angle.isComplete, "the angle", WITHIN_S)
    wizard.next()
    assert wizard.currentPage() is wizard.readings
    live.goes_ahead = True
    plan = live.session.procedure.steps
    mounted = max(number for number, one in enumerate(plan) if one.kind is StepKind.SET_UP)
    pump(wizard, line, lambda: live.session.procedure.position > mounted, "the last", WITHIN_S)
    # The plugs of the two bridges are exchanged at the last pin angle: no load is taken with them.
    wizard.readings.hands.mistake.setCurrentIndex(2)
    pump(wizard, line, lambda: "are swapped" in live.readiness.words, "the plugs", WITHIN_S)
    # They are put right, and from then on a wrong weight hangs.
    wizard.readings.hands.mistake.setCurrentIndex(1)
    pump(wizard, line, wizard.readings.isComplete, "the end", WITHIN_S)
    wizard.next()
    pump(wizard, line, lambda: live.outcome is not None, "the verdict", WITHIN_S)
    assert wizard.result_page.verdict.text() == "✗ Refused"
    assert not list(tmp_path.glob("*.json"))
    # The last series with weights of its own is taken again, with the right ones.
    wizard.back()
    wizard.readings.hands.mistake.setCurrentIndex(0)
    procedure = live.session.procedure
    steps = [procedure.steps[one.step] for one in procedure.taken]
    last = max(number for number, step in enumerate(steps) if step.series != CREEP_SERIES)
    assert live.reject(last, "a wrong weight hung")
    pump(wizard, line, wizard.readings.isComplete, "the last series again", WITHIN_S)
    wizard.next()
    pump(wizard, line, lambda: live.outcome is not None, "the verdict", WITHIN_S)
    assert wizard.result_page.verdict.text() == "✓ Accepted", wizard.result_page.problems.text()
    wizard.next()
    record = unseal(live.outcome.saved.read_bytes())
    result = record.content["result"]
    x = plant_section(read_rig(EXAMPLE).record).cross_talk_percent / 100.0
    truth = np.array([[1.0, x], [x, 1.0]]) @ np.diag([200.0, 200.0])
    found = np.array(result["matrix_N_per_unit"])
    # One draw of four elements: beyond twice the standard uncertainty one in ten would be.
    allowed = 4.0 * np.array(result["matrix_standard_uncertainty_N_per_unit"])
    assert np.all(np.abs(found - truth) < allowed)
    # A force of 300 N in any direction is told within the stated U.
    turn = np.radians(np.arange(0.0, 360.0, 15.0))
    force = 300.0 * np.stack((np.cos(turn), np.sin(turn)))
    signal = np.linalg.inv(truth) @ force
    told = found @ (signal - np.array(result["zero"])[:, None])
    line_N = result["uncertainty_line_N"]
    assert np.hypot(*(told - force)).max() < line_N["constant_N"] + 300.0 * line_N["per_N"]
    # The certificate is written, and its end is told.
    page = wizard.certificate
    page.pdf.click()
    pump(wizard, line, lambda: "certificate is" in page.words.text(), "certificate", WITHIN_S)
    assert live.outcome.saved.with_suffix(".pdf").read_bytes().startswith(b"%PDF")
    # The rig file names the record after a question, and a test with it tells the plant's forces.
    page.use.click()
    assert not read_rig(file).record.load_cell.calibration
    page.use.click()
    assert read_rig(file).record.load_cell.calibration == live.outcome.saved.name
    # The engine that runs uses it at once.
    pump(wizard, line, lambda: "from now on" in page.used.text(), "the engine's answer", WITHIN_S)
    pump(wizard, line, lambda: np.array_equal(live.window.matrix, found), "the record", WITHIN_S)
    wizard.accept()
    pump(wizard, line, lambda: not wizard.isVisible(), "the end", WITHIN_S)
    measured, at_plant, allowed_N = forces_of_a_test(file, tmp_path, monkeypatch)
    error = np.hypot(*(measured - at_plant))
    # U holds nineteen of twenty; of 72 values fewer than 60 come once in some thousand tests.
    assert (np.abs(measured - at_plant) <= allowed_N).sum() >= 60
    # With the numbers of the rig file it would be worse: the record is what was used.
    believed = np.diag([200.0, 200.0]) @ np.linalg.inv(found) @ measured
    worse = np.hypot(*(believed - at_plant))
    assert np.sqrt(np.mean(error**2)) < 0.7 * np.sqrt(np.mean(worse**2))


def forces_of_a_test(
    rig: Path, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Run a test; return the mean cycle, (2, bins) N: measured, as the plant had it, and U."""
    truth = folder / "truth.npz"
    start = partial(start_simulated_rig, truth=truth)
    monkeypatch.setattr("rigapp.service.simulated.start_simulated_rig", start)
    monkeypatch.setattr("rigapp.commands.run.settle", lambda end: None)
    text = (EXAMPLE.parent / "quick.toml").read_text("utf-8")
    for old, new in (
        ("revolutions = 500", f"revolutions = {REVOLUTIONS}"),
        ("every_revolutions = 10", "every_revolutions = 1"),
        ('joint = "continuous"', 'joint = "continuous"\nenabled = false'),
    ):
        assert old in text
        text = text.replace(old, new)
    (folder / "test.toml").write_text(text, "utf-8")
    out = folder / "test.h5"
    assert run_test(folder / "test.toml", rig, out, None, None, None) == 0
    told = []
    with open_test(out) as reader:
        assert "load_cell" in reader.calibration()
        stated = force_uncertainty(reader.calibration(), reader.configuration())
        assert stated is not None
        for cycle in reader.cycles():
            if int(cycle.revolution) > REVOLUTIONS // 2:
                columns = cycle.columns
                told.append(np.array([columns[n] for n in ("angle", "force_1", "force_2")]))
    with np.load(truth) as stored:
        steady = np.abs(stored["speed_rad_per_s"] * 30.0 / np.pi / 60.0 - 1.0) < 0.03
        angle = np.degrees(stored["angle_rad"][steady])
        plant = np.array([angle, stored["force_e1_N"][steady], stored["force_n1_N"][steady]])
    true, samples = mean_cycle(plant), np.hstack(told)
    count = np.bincount((np.mod(samples[0], 360.0) // 10.0).astype(int), minlength=36)
    allowed = stated.at(np.hypot(*true), count, component=true)
    return mean_cycle(samples), true, allowed


def mean_cycle(columns: np.ndarray) -> np.ndarray:
    """Return the mean of forces (angle in degrees, force_1, force_2) in bins of 10 degrees."""
    place = (np.mod(columns[0], 360.0) // 10.0).astype(int)
    return np.array([[one[place == k].mean() for k in range(36)] for one in columns[1:]])
