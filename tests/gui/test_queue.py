"""The page of the queue: what it says and asks for, and two tests by real clicks."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from rigapp.gui.panels.queue import QueuePanel
from rigapp.schema.messages import RunState
from rigapp.schema.queue import ItemState, QueuedTest
from rigapp.storage import open_test
from rigapp.viewer.news import News

EXAMPLES = Path(__file__).parents[2] / "examples"
FIVE = tuple(
    QueuedTest(number, f"/t/{name}.toml", "/r", state, f"/r/{name}.h5" if file else "", said)
    for number, name, state, file, said in (
        (3, "a", ItemState.DONE, True, "The planned 30 revolutions are made and recorded."),
        (4, "b", ItemState.RUNNING, True, ""),
        (5, "c", ItemState.WAITING, False, ""),
    )
)


@pytest.fixture
def panel(qtbot: Any, tmp_path: Path) -> QueuePanel:
    one = QueuePanel(tmp_path)
    qtbot.addWidget(one)
    one.asked = []  # type: ignore[attr-defined]
    one.wanted.connect(lambda verb, arguments: one.asked.append((verb, arguments)))  # type: ignore[attr-defined]
    return one


def show(panel: QueuePanel, make_status: Any, tests: Any, *, works: bool) -> None:
    panel.show_news(News(status=make_status(queue=tests, queue_works=works)))


def cells(panel: QueuePanel, row: int) -> list[str]:
    return [panel.list.item(row, at).text() for at in range(panel.list.columnCount())]


def test_an_empty_queue_says_what_it_is_for(panel: QueuePanel) -> None:
    assert "No test is in the queue" in panel.summary.text()
    assert [one.isEnabled() for one in (panel.begin, panel.halt, panel.take_out)] == [False] * 3
    assert panel.add.isEnabled()


def test_a_queue_that_works_is_shown_and_can_be_stopped(
    panel: QueuePanel, make_status: Any
) -> None:
    show(panel, make_status, FIVE, works=True)
    assert "Queue running" in panel.summary.text()
    assert "2 to be done" in panel.summary.text()
    assert cells(panel, 0) == ["3", "done", "a.toml", "a.h5", FIVE[0].sentence]
    assert cells(panel, 1) == ["4", "running", "b.toml", "b.h5", ""]
    assert cells(panel, 2) == ["5", "waiting", "c.toml", "", ""]
    assert not panel.begin.isEnabled()
    panel.halt.click()
    panel.list.selectRow(1)
    assert not panel.take_out.isEnabled()  # it runs
    panel.list.selectRow(2)
    panel.take_out.click()
    assert panel.asked == [("queue_stop", {}), ("queue_remove", {"numbers": [5]})]  # type: ignore[attr-defined]


def test_a_queue_that_has_stopped_says_where_and_what_leads_on(
    panel: QueuePanel, make_status: Any, tmp_path: Path
) -> None:
    stopped = QueuedTest(4, "/t/b.toml", "/r", ItemState.STOPPED, "/r/b.h5", "Overload.")
    show(panel, make_status, (FIVE[0], stopped, FIVE[2]), works=False)
    assert "Test 4 did not end as planned" in panel.summary.text()
    assert panel.begin.isEnabled()
    assert not panel.halt.isEnabled()
    panel.begin.click()
    panel.add_files(["/t/d.toml", "/t/e.toml"])
    panel.add_files([])  # the dialog was left
    assert panel.asked == [  # type: ignore[attr-defined]
        ("queue_start", {}),
        ("queue_add", {"tests": ["/t/d.toml", "/t/e.toml"], "folder": str(tmp_path.resolve())}),
    ]


@pytest.mark.long
@pytest.mark.timeout(300)
def test_two_tests_are_put_in_and_worked_off(operate: Any, tmp_path: Path) -> None:
    text = (EXAMPLES / "quick.toml").read_text(encoding="utf-8")
    text = text.replace("revolutions = 500", "revolutions = 8", 1)
    text = text.replace("[prediction]", "[prediction]\nenabled = false", 1)
    tests = [tmp_path / "first.toml", tmp_path / "second.toml"]
    for path in tests:
        path.write_text(text, "utf-8")
    with operate(EXAMPLES / "simulated.toml", tests[0]) as hands:
        hands.host.connect()
        hands.sees_state(RunState.READY)
        hands.window.tabs.show_page("queue")
        panel = hands.window.tabs.panels["queue"]
        panel.add_files([str(path) for path in tests])
        hands.see(lambda: panel.list.rowCount() == 2)
        panel.add_files([str(tmp_path / "none.toml")])
        hands.see(lambda: "queue add refused" in hands.window.controls.answer.text())
        assert panel.list.rowCount() == 2
        hands.click(panel.begin)
        hands.see(lambda: cells(panel, 0)[1] == "running")
        hands.see(lambda: [cells(panel, at)[1] for at in range(2)] == ["done", "done"])
        hands.see(lambda: not panel.halt.isEnabled())
    files = sorted(tmp_path.glob("*.h5"))
    assert [path.stem.split("-")[0] for path in files] == ["first", "second"]
    for path in files:
        with open_test(path) as recorded:
            assert recorded.summary()["status"] == "complete"
            assert recorded.summary()["revolutions"] == 8
