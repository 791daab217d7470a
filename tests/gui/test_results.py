"""Recorded tests: what they came to, their list, the card at the end, the page to begin with."""

from __future__ import annotations

import math
import os
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import h5py
import msgspec
import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence

from rigapp.gui.panel import Act
from rigapp.gui.panels.results import ResultsPanel
from rigapp.gui.results.documents import KINDS, DocumentPanel
from rigapp.gui.results.resultcard import SHAPES, ResultCard, colour_of
from rigapp.gui.results.results_index import ResultReader, ResultsIndex
from rigapp.gui.results.resulttable import TITLES
from rigapp.gui.window.side import connection_steps
from rigapp.gui.window.tabs import NUMBERS
from rigapp.gui.window.window import MainWindow
from rigapp.presentation.results import key_numbers, trust_lines
from rigapp.presentation.tokens import DARK, LIGHT
from rigapp.report.results import main, result_of
from rigapp.schema.messages import Alarm, RunState, Severity, Status
from rigapp.schema.results import NOT_READABLE, HowEnded, TestResult
from rigapp.viewer.news import News
from rigapp.viewer.tasks import TaskWorker

Attach = Callable[[], None]


def ended(path: Path, status: bytes, code: bytes, reason: bytes) -> None:
    """Let a recorded file have ended otherwise."""
    with h5py.File(path, "r+") as file:
        for name, word in (("status", status), ("reason_code", code), ("reason", reason)):
            file[f"/entry/state/{name}"][()] = word


@pytest.fixture
def folder(recorded: Path) -> Path:
    """Return a folder with a complete test, a stopped one, a tripped one, and no test; by age."""
    for number, (name, code) in enumerate((("stopped", b"operator"), ("tripped", b"limit"))):
        path = recorded.with_name(f"{name}.h5")
        shutil.copy(recorded, path)
        ended(path, b"stopped", code, b"hands off" if number == 0 else b"force is 391 N")
    recorded.with_name("broken.h5").write_bytes(b"not hdf5")
    for age, name in enumerate((recorded.name, "stopped.h5", "tripped.h5", "broken.h5")):
        os.utime(recorded.with_name(name), (1.8e9 - age, 1.8e9 - age))
    return recorded.parent


def test_a_file_says_what_the_test_came_to(folder: Path, recorded: Path) -> None:
    found = result_of(recorded, closely=True)
    assert (found.outcome, found.title, found.revolutions) == (HowEnded.COMPLETE, "Quick test", 300)
    assert found.depth_um == pytest.approx(1e3 * (0.02 * 2.1 * math.log1p(0.1) + 0.001))
    assert found.depth_uncertainty_um == pytest.approx(1.1)
    assert found.residual_rms_N == pytest.approx(1.7)
    assert found.force_max_N == pytest.approx(98.0, abs=2.0)
    assert len(found.depths_um) == 48
    assert list(found.depths_um) == sorted(found.depths_um)
    assert result_of(folder / "stopped.h5").outcome is HowEnded.OPERATOR
    assert result_of(folder / "tripped.h5").outcome is HowEnded.TRIPPED
    broken = result_of(folder / "broken.h5")
    assert broken.status == NOT_READABLE
    assert "not an HDF5 file" in broken.reason
    assert result_of(folder / "gone.h5").outcome is HowEnded.NOT_READABLE


def test_each_outcome_has_a_shape_of_its_own() -> None:
    assert len(set(SHAPES.values())) == len(HowEnded) == len(SHAPES)
    for theme in (LIGHT, DARK):
        assert colour_of(HowEnded.TRIPPED, theme) == theme.critical
        assert colour_of(HowEnded.COMPLETE, theme) == colour_of(HowEnded.OPERATOR, theme)


def test_a_card_says_what_is_not_known_and_what_to_bear_in_mind() -> None:
    unknown = TestResult("x.h5", status="stopped", reason_code="device", revolutions=20, gaps=2)
    assert [one.value for one in key_numbers(unknown)] == ["–"] * 4
    assert [one.good for one in trust_lines(unknown)] == [False, True]
    full = msgspec.structs.replace(
        unknown,
        gaps=0,
        depth_um=50.1,
        depth_uncertainty_um=1.3,
        coefficient=5.49e-4,
        coefficient_low=5.29e-4,
        coefficient_high=5.71e-4,
        force_max_N=88.4,
        force_uncertainty_N=0.9,
        residual_rms_N=1.6,
        simulated=True,
    )
    depth, coefficient, force, agreement = key_numbers(full)
    assert depth.value == "50.1 ± 1.3 µm"
    assert coefficient.value == "549 · 10⁻⁶ mm³/(N m)"
    assert coefficient.line == "529 to 571 (95 %)"
    assert (force.value, agreement.value) == ("88.40 ± 0.90 N", "1.6 N")
    assert "Simulated" in [one.text for one in trust_lines(full)]


@pytest.fixture
def shelf(tmp_path: Path) -> Iterator[ResultsIndex]:
    """Return the shelf of the folder."""
    worker = TaskWorker("test-files")
    made = ResultsIndex(tmp_path, worker)
    made.worker_of_test = worker  # type: ignore[attr-defined]
    yield made
    made.close()
    worker.close()


@pytest.fixture
def panel(
    folder: Path, shelf: ResultsIndex, qtbot: Any, light_application: Any
) -> Iterator[tuple[ResultsPanel, list[list[str]]]]:
    """Return the page of the results, everything read, and what it has launched."""
    launched: list[list[str]] = []
    worker = shelf._worker
    made = ResultsPanel(LIGHT, shelf, worker, lambda words: launched.append([*words]))
    qtbot.addWidget(made)
    made.resize(1300, 700)
    made.show()

    def listed() -> bool:
        worker.deliver()
        return len(shelf.paths) == 4 and not shelf.unread

    qtbot.waitUntil(listed, timeout=PATIENCE_MS)
    made._pump.pump()
    yield made, launched
    made.hide()


def names(panel: ResultsPanel) -> list[str]:
    return [Path(path).name for path, _ in panel.table.rows.rows]


def test_results_are_found_sorted_looked_at_and_compared(
    panel: tuple[ResultsPanel, list[list[str]]], recorded: Path, qtbot: Any
) -> None:
    page, launched = panel
    table = page.table
    assert names(page) == [recorded.name, "stopped.h5", "tripped.h5", "broken.h5"]
    page.ending.setCurrentIndex(page.ending.findData(HowEnded.TRIPPED))
    assert names(page) == ["tripped.h5"]
    page.ending.setCurrentIndex(0)
    qtbot.keyClicks(page.words, "QUICK hands")
    assert names(page) == ["stopped.h5"]
    assert page.count.text().startswith("1 of 4 tests")
    page.words.clear()
    table.sort_by(TITLES.index("Ended"))
    assert names(page)[0] == "tripped.h5"
    table.sort_by(TITLES.index("Ended"))
    assert names(page)[-1] == "tripped.h5"
    table.sort_by(TITLES.index("Ended"))
    table.selectRow(3)
    assert page.card.headline.whole == "Cannot be read"
    assert not any(one.isEnabled() for one in page.buttons.values())
    table.selectRow(2)
    assert page.card.headline.whole == "Tripped"
    assert page.card.reason.text() == "Force is 391 N"
    page.wanted.connect(lambda verb, arguments: launched.append([verb, *arguments.values()]))
    page.buttons["resume"].click()
    assert launched.pop() == ["resume_file", str(recorded.with_name("tripped.h5"))]
    table.selectRow(0)
    assert not page.buttons["resume"].isEnabled()
    table.setFocus()
    qtbot.keyClick(table, Qt.Key.Key_Return)
    assert launched == [["replay", str(recorded)]]
    table.choose({str(recorded), str(recorded.with_name("stopped.h5"))})
    page.buttons["compare"].click()

    def compared() -> bool:
        page._shelf._worker.deliver()
        return len(page.compare.runs) == 2

    qtbot.waitUntil(compared, timeout=PATIENCE_MS)
    assert page.compare.isVisible()
    x, y = page.compare._curves[0].x, page.compare._curves[0].y
    assert len(x) == 300
    assert y[0] == pytest.approx(97.0, abs=2.0)
    for index in range(page.compare.quantity.count()):
        page.compare.quantity.setCurrentIndex(index)
    page.compare.axis.setCurrentIndex(1)
    page.dress(DARK)
    page.away.click()
    assert not page.compare.isVisible()
    assert len(table.chosen_paths()) == 2


def test_only_what_has_changed_is_read_again(
    panel: tuple[ResultsPanel, list[list[str]]], folder: Path, qtbot: Any
) -> None:
    page, _ = panel
    shelf = page._shelf
    before = {path: shelf.result(path) for path in shelf.paths}
    (folder / "broken.h5").unlink()
    shutil.copy(folder / "tripped.h5", folder / "new.h5")
    page.look()

    def seen() -> bool:
        shelf._worker.deliver()
        return str(folder / "new.h5") in shelf.paths and not shelf.unread

    qtbot.waitUntil(seen, timeout=PATIENCE_MS)
    page._pump.pump()
    assert "new.h5" in names(page)
    kept = [path for path in shelf.paths if shelf.result(path) is before.get(path)]
    assert len(kept) == 3


@pytest.mark.long
def test_what_is_written_can_be_opened(recorded: Path, qtbot: Any, qapp: Any) -> None:
    said: list[tuple[str, bool]] = []
    shown: list[Path] = []
    panel = DocumentPanel(
        "x", lambda *words: said.append(words), lambda path: bool(shown.append(path)) or True
    )
    qtbot.addWidget(panel)
    panel.show_test(recorded)
    assert not any(one.isEnabled() for one in panel.open.values())
    assert set(panel.write) == {"pdf", "html", "csv", "parquet"}
    panel.write["csv"].click()
    assert panel.write["csv"].text() == "Writing …"
    qtbot.waitUntil(lambda: len(said) == 2, timeout=PATIENCE_MS)
    target = recorded.with_suffix(".csv")
    assert said[1] == (f"Table, CSV is in {target}", True)
    assert target.read_text("utf-8").count("\n") > 300
    panel.open["csv"].click()
    assert shown == [target]
    csv = next(kind for kind in KINDS if kind.ending == ".csv")
    panel.show_test(recorded.with_name("gone.h5"))
    panel.begin(csv)
    qtbot.waitUntil(lambda: len(said) == 4, timeout=PATIENCE_MS)
    assert not said[3][1]
    assert "no such file" in said[3][0]


def test_the_reading_process_ends_with_its_reader(recorded: Path) -> None:
    reader = ResultReader([recorded] * 500)
    reader.close()
    assert reader._process.status is not None
    assert not reader._thread.is_alive()


def test_why_nothing_can_be_read_is_said(
    panel: tuple[ResultsPanel, list[list[str]]], folder: Path, qtbot: Any, monkeypatch: Any
) -> None:
    page, _ = panel
    shelf = page._shelf
    monkeypatch.setattr("sys.executable", "/bin/false")
    shutil.copy(folder / "tripped.h5", folder / "new.h5")
    said: list[str] = []
    page.reported.connect(lambda text, good: said.append(text))
    page.look()

    def told() -> bool:
        shelf._worker.deliver()
        return bool(said)

    qtbot.waitUntil(told, timeout=PATIENCE_MS)
    assert said[0].startswith("1 tests in ")
    assert page.count.text() == said[0]


def test_a_reader_that_is_left_alone_ends_quietly(recorded: Path, monkeypatch: Any) -> None:
    class Gone:
        buffer = property(lambda self: self)

        def write(self, data: bytes) -> None:
            raise BrokenPipeError

        def fileno(self) -> int:
            return os.open(os.devnull, os.O_WRONLY)

    class Paths:
        buffer = property(lambda self: self)

        def read(self) -> bytes:
            return os.fsencode(recorded)

    monkeypatch.setattr("sys.stdout", Gone())
    monkeypatch.setattr("sys.stdin", Paths())
    monkeypatch.setattr("os.nice", lambda _: 0)
    assert main([]) == 0


@pytest.fixture
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Read a single file here, not in a process: its answer is there when it is asked for."""

    def ask(self: ResultsIndex, path: Path, done: Callable[[TestResult], None]) -> None:
        done(result_of(path))

    monkeypatch.setattr(ResultsIndex, "ask", ask)


@pytest.mark.usefixtures("at_once")
def test_the_end_of_a_test_shows_its_card_and_leads_on(
    window: MainWindow, engine: Any, attach: Attach, recorded: Path, qtbot: Any
) -> None:
    engine.say(count=300, file=str(recorded))
    attach()
    assert not window.tabs.isTabVisible(NUMBERS["result"])
    reason = "All revolutions are done."
    engine.say(first=301, count=0, file=str(recorded), state=RunState.STOPPED, reason=reason)
    attach()
    assert window.tabs.currentIndex() == NUMBERS["result"]
    page = window.tabs.panels["result"]
    assert page.card.headline.whole == "Complete"
    assert page.card.reason.text() == reason
    assert not page.buttons["on"].isEnabled()
    assert "complete" in page.buttons["on"].toolTip()
    page.buttons["new"].click()
    assert window.tabs.currentIndex() == NUMBERS["prepare"]
    window.tabs.show_page("result")
    other = msgspec.structs.replace(page.card.result, path=str(recorded.with_name("other.h5")))
    shelf = window.tabs.panels["results"]._shelf
    shelf._stamps, shelf._known = {other.path: (0.0, 0)}, {other.path: other}
    page.buttons["compare"].click()
    assert window.tabs.currentIndex() == NUMBERS["results"]
    drawn = [path.name for path in window.tabs.panels["results"].compare._wanted]
    assert drawn == [recorded.name, "other.h5"]
    window.tabs.show_page("result")
    engine.say(first=301, count=1, file="next.h5")
    attach()
    assert window.tabs.currentIndex() == NUMBERS["overview"]


@pytest.mark.usefixtures("at_once")
def test_a_trip_leaves_the_plots_and_has_its_card_beside_them(
    window: MainWindow, engine: Any, attach: Attach, folder: Path, alarm: Alarm, qtbot: Any
) -> None:
    path = str(folder / "tripped.h5")
    engine.say(count=300, file=path)
    attach()
    critical = msgspec.structs.replace(alarm, severity=Severity.CRITICAL)
    engine.say(first=301, count=0, file=path, state=RunState.STOPPED, alarms=(critical,))
    attach()
    assert window.tabs.currentIndex() == NUMBERS["overview"]
    assert window.tabs.isTabVisible(NUMBERS["result"])
    window.tabs.show_page("result")
    page = window.tabs.panels["result"]
    assert page.card.headline.whole == "Tripped"
    assert page.card.shape.accessibleDescription() == "tripped"
    assert LIGHT.critical in page.card.styleSheet()
    assert page.buttons["on"].isEnabled()
    page.buttons["on"].click()

    def asked() -> bool:
        window.tick()
        return ("resume_file", {"file": path}) in engine.requests

    qtbot.waitUntil(asked, timeout=PATIENCE_MS)


def test_a_result_that_does_not_fit_is_cut_nowhere(qtbot: Any, folder: Path, qapp: Any) -> None:
    for name in ("stopped", "tripped"):
        card = ResultCard("card", LIGHT, across=1)
        qtbot.addWidget(card)
        card.show_result(result_of(folder / f"{name}.h5"), "")
        card.setFixedWidth(312)
        card.show()
        for tile in card.numbers:
            assert tile.value.text() == tile.value.whole
        card.close()


def test_the_window_begins_with_four_ways_and_the_last_tests(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any, monkeypatch: Any
) -> None:
    monkeypatch.setattr(window, "_rig_file", Path("examples/simulated.toml"))
    window.start()
    assert window.tabs.currentIndex() == NUMBERS["start"]
    engine.say(count=0, curves=False, state=RunState.READY, planned=0, file="")
    attach()
    assert window.tabs.currentIndex() == NUMBERS["start"]
    assert window.side.connecting.isVisible()
    assert window.side.connecting.title.whole == "Connected"
    page = window.tabs.panels["start"]
    assert "simulated: no real spindle turns" in page.rig.text()
    page.setFocus()
    with qtbot.waitActive(window, timeout=PATIENCE_MS):
        window.activateWindow()
    # Each key stands on its card, and does the same from a field that takes digits.
    for act, name in ((Act.RESULTS, "results"), (Act.PREPARE, "prepare")):
        window.controls.text.setFocus()
        key = page.ways[act].shortcut.text()
        press = QKeySequence(key)[0]
        qtbot.keyClick(window.controls.text, press.key(), press.keyboardModifiers())
        assert window.tabs.currentIndex() == NUMBERS[name]
        window.tabs.show_page("start")
    buttons = {act.value: way.button for act, way in page.ways.items()}
    buttons["prepare"].click()
    assert window.tabs.currentIndex() == NUMBERS["prepare"]
    window.tabs.show_page("start")
    assert page.ways[Act.TRY].shortcut.text() == "F11"
    assert page.ways[Act.CALIBRATE].shortcut.text() == "F3"
    window.controls.text.setFocus()
    qtbot.keyClick(window.controls.text, Qt.Key.Key_F11)

    def started() -> bool:
        window.tick()
        return "start" in engine.verbs

    qtbot.waitUntil(started, timeout=PATIENCE_MS)
    assert dict(engine.requests)["start"]["test"].endswith("quick.toml")
    engine.say(count=3)
    attach()
    assert window.tabs.currentIndex() == NUMBERS["overview"]
    assert not window.tabs.isTabVisible(NUMBERS["start"])
    assert window.side.limits.isVisible()
    assert not window.side.connecting.isVisible()


def test_a_real_rig_is_not_moved_by_trying(
    window: MainWindow, engine: Any, attach: Attach, monkeypatch: Any
) -> None:
    launched: list[list[str]] = []
    monkeypatch.setattr("rigapp.gui.window.window.launch_process", launched.append)
    engine.say(count=0, curves=False, state=RunState.READY, planned=0, file="", simulated=False)
    attach()
    window.tabs.panels["start"].ways["try"].button.click()  # type: ignore[index]
    assert launched == [["gui", "--start"]]
    assert "start" not in engine.verbs


def test_connecting_is_told_step_by_step(make_status: Callable[..., Status]) -> None:
    def seen(**changes: Any) -> list[tuple[str, bool, bool]]:
        age = changes.pop("age", None)
        status = make_status(**changes) if changes else None
        return [
            (one.name, one.done, one.now) for one in connection_steps(News(status, data_age_s=age))
        ]

    later = [("Devices", False, False), ("First samples", False, False)]
    assert seen() == [("Engine", False, True), *later]
    there = ("Engine", True, False)
    assert seen(state=RunState.CONNECTING, devices=())[:2] == [there, ("Devices", False, True)]
    daq, drive = make_status().rig.devices
    found = msgspec.structs.replace(drive, connected=False)
    steps = seen(state=RunState.CONNECTING, devices=(daq, found), age=math.inf)
    assert steps[1:] == [
        ("daq", True, False),
        ("drive", False, True),
        ("First samples", False, False),
    ]
    ready = seen(state=RunState.READY, devices=(daq, drive), age=0.1)
    assert all(done for _, done, _ in ready)
