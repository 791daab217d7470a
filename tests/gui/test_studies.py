"""The page of the studies: what it lists, draws and says."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from patience import PATIENCE_MS
from study.studies import finished
from study.test_folder import JOINTS, POWER_STUDY

from rigapp.gui.panels.studies import StudiesPanel
from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import DARK, LIGHT
from rigapp.study.folder import IDENTITY, points_done
from rigapp.viewer.tasks import TaskWorker

Opened = Callable[[Path], StudiesPanel]


@pytest.fixture
def opened(qtbot: Any, light_application: Any) -> Any:
    """Return a function that opens the page on a folder and waits until it is read."""
    worker = TaskWorker("test-studies")

    def open_(folder: Path) -> StudiesPanel:
        panel = StudiesPanel(LIGHT, folder, worker)
        qtbot.addWidget(panel)
        panel.resize(1300, 760)
        panel.show()
        read(panel)
        return panel

    def read(panel: StudiesPanel) -> None:
        def idle() -> bool:
            worker.deliver()
            return worker.idle

        qtbot.waitUntil(idle, timeout=PATIENCE_MS)

    open_.read = read  # type: ignore[attr-defined]
    yield open_
    worker.close()


def choose(panel: StudiesPanel, name: str) -> None:
    names = [row[0] for row in panel.list.texts()]
    panel.list.selectRow(names.index(name))


def test_a_folder_without_studies_says_how_one_is_made(opened: Opened, tmp_path: Path) -> None:
    panel = opened(tmp_path)
    assert panel.list.texts() == []
    assert panel.summary.whole.startswith(f"No study is in {tmp_path}.")
    assert panel.plot.plot.instead.startswith("Choose a study")
    gone = opened(tmp_path / "gone")
    assert gone.summary.whole.startswith("No study is in ")


def test_a_study_is_drawn_and_what_it_depends_on_is_said(opened: Opened, tmp_path: Path) -> None:
    finished(tmp_path / "contact", problems={5: "the pin is too large"})
    panel = opened(tmp_path)
    assert panel.list.texts()[0][:3] == ["contact", "pressure", "64"]
    assert panel.sentence.text().startswith("63 of 64 points have a result. The reasons")
    assert panel.failed.texts() == [["5", "the pin is too large"]]
    plot = panel.plot
    assert plot.result.currentText() == "Largest contact pressure (MPa)"
    assert len(plot._dots.x) == 63
    assert " to " in plot.range.whole
    assert not plot.plot.instead
    rows = panel.depends.texts()
    assert {row[0] for row in rows} == {"Bushing radius (mm)", "Force (N)"}
    assert all(row[1].count("%") == row[2].count("%") == 1 for row in rows)
    assert panel.depends_title.text().startswith("Too few points to say")  # 16 base points
    assert not panel._power.isVisible()
    plot.result.setCurrentIndex(1)
    plot.parameter.setCurrentIndex(1)
    chosen = plot.result.currentText(), plot.parameter.currentText()
    panel.look()
    opened.read(panel)  # type: ignore[attr-defined]
    assert (plot.result.currentText(), plot.parameter.currentText()) == chosen
    panel.dress(DARK)


@pytest.mark.long
def test_texts_stand_at_the_axis_and_power_in_a_table(opened: Opened, tmp_path: Path) -> None:
    finished(tmp_path / "joints", JOINTS)
    finished(tmp_path / "power", POWER_STUDY)
    panel = opened(tmp_path)
    choose(panel, "joints")
    plot = panel.plot
    plot.parameter.setCurrentIndex(plot.parameter.findData("run.joint"))
    assert [text for _, text in plot.plot._axes["bottom"].ticks()] == ["continuous", "perfect"]
    assert not panel._depends.isVisible()
    choose(panel, "power")
    assert panel._power.isVisible()
    assert [row[:2] for row in panel.power.texts()] == [["1", "3"], ["2", "3"]]
    assert panel.power.texts()[0][2:] == ["not in time"] * 4
    assert panel.power.horizontalHeaderItem(2).text() == "50 %"
    assert plot.parameter.currentData() == "run.coefficient_factor"
    assert not plot.plot._axes["bottom"]._tickLevels


def test_another_folder_is_opened_and_one_without_a_study_is_said(
    opened: Opened, tmp_path: Path
) -> None:
    here, there = tmp_path / "here", tmp_path / "there"
    for folder in (here, there):
        folder.mkdir()
    finished(here / "first", JOINTS)
    finished(there / "second", JOINTS)
    panel = opened(here)
    said: list[tuple[str, bool]] = []
    panel.reported.connect(lambda words, good: said.append((words, good)))
    panel.open_folder(str(there / "second"))
    opened.read(panel)  # type: ignore[attr-defined]
    assert sorted(row[0] for row in panel.list.texts()) == ["first", "second"]
    assert panel._shown is not None
    assert panel._shown.folder.name == "second"
    panel.open_folder(str(tmp_path))
    opened.read(panel)  # type: ignore[attr-defined]
    assert said == [(f"There is no study in {tmp_path}.", False)]


def test_a_study_under_way_says_so(opened: Opened, tmp_path: Path) -> None:
    (tmp_path / "going").mkdir()
    (tmp_path / "going" / IDENTITY).write_bytes(b"{}")
    panel = opened(tmp_path)
    assert panel.sentence.text().startswith("The study has no table yet")
    assert panel.plot.plot.instead.startswith("The study has no table yet")
    assert panel.list.texts()[0][:3] == ["going", "–", "–"]


def test_the_window_has_the_page_among_its_results(window: MainWindow) -> None:
    window.tabs.show_page("studies")
    assert [page.title for page in window.tabs.pages()] == ["Results", "Studies", "Trip"]
    assert isinstance(window.tabs.panels["studies"], StudiesPanel)


STUDY = """
schema = 1
kind = "pressure"
parameters = "parameters.toml"

[run]
force_N = 60.0

[vary]
"joint.bushing_radius_mm" = { low = 9.6, high = 9.9 }

[design]
kind = "latin-hypercube"
points = POINTS
seed = 1
"""


def study_file(folder: Path, points: int) -> Path:
    (folder / "parameters.toml").write_text(
        (Path(__file__).parents[2] / "examples" / "parameters.toml").read_text("utf-8"), "utf-8"
    )
    file = folder / "radius.toml"
    file.write_text(STUDY.replace("POINTS", str(points)), "utf-8")
    return file


@pytest.mark.long
def test_a_study_is_computed_from_the_window(opened: Opened, tmp_path: Path, qtbot: Any) -> None:
    panel = opened(tmp_path)
    panel.run.begin(str(study_file(tmp_path, 4)))
    assert panel.run.running
    assert not panel.run.compute.isEnabled()
    qtbot.waitUntil(lambda: not panel.run.running, timeout=PATIENCE_MS)
    assert panel.run.progress.whole.startswith("4 of 4 points are done"), panel.run.progress.whole
    opened.read(panel)  # type: ignore[attr-defined]
    assert panel.list.texts()[0][:3] == ["radius", "pressure", "4"]
    assert panel.run.compute.isEnabled()


@pytest.mark.long
def test_an_interrupted_study_is_safe_and_a_wrong_file_is_told(
    opened: Opened, tmp_path: Path, qtbot: Any
) -> None:
    panel = opened(tmp_path)
    panel.run.begin(str(study_file(tmp_path, 5000)))
    qtbot.waitUntil(lambda: points_done(tmp_path / "radius") > 0, timeout=PATIENCE_MS)
    panel.run.interrupt.click()
    assert not panel.run.running
    assert 0 < points_done(tmp_path / "radius") < 5000
    assert panel.run.progress.whole
    wrong = tmp_path / "wrong.toml"
    wrong.write_text("schema = 1\n", "utf-8")
    panel.run.begin(str(wrong))
    qtbot.waitUntil(lambda: not panel.run.running, timeout=PATIENCE_MS)
    assert "wrong.toml" in panel.run.progress.whole
