"""What the window says of the wear: tiles, sentence, bands and the narrowing of the posterior."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest
from patience import PATIENCE_MS

from rigapp.gui.panels.trends import WearPanel
from rigapp.gui.plots.knownwear import ForecastPanel
from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import DARK, LIGHT
from rigapp.schema.columns import prediction_columns
from rigapp.schema.messages import Snapshot
from rigapp.viewer.knownwear import (
    KnownWear,
    WearReader,
    known_wear,
    newest_wear,
    of_tree,
    run_identify,
    wear_values,
)
from rigapp.viewer.news import News
from rigapp.viewer.series import LiveData
from rigapp.viewer.tasks import TaskWorker

NAMES = [one.name for one in prediction_columns()]
STATED = {
    "wear_coefficient": 5.55e-4,
    "wear_coefficient_low": 5.3e-4,
    "wear_coefficient_high": 5.8e-4,
    "remaining_revolutions": 3000.0,
    "remaining_revolutions_low": 2500.0,
    "remaining_revolutions_high": np.inf,
    "wear_consistency": 0.2,
    "wear_model": 0.0,
    "wear_model_weight": 0.97,
}
TREE: dict[str, Any] = {
    "refused": False,
    "sentence": "The joint wears at a constant coefficient (sure to 97 %).",
    "revolution": 1000,
    "planned_revolutions": 4000,
    "bands": [
        {
            "after_revolution": after,
            "revolution": [after, 2000, 4000],
            "low_um": [low, 20.0, None],
            "median_um": [low + 1.0, 25.0, None],
            "high_um": [low + 2.0, 30.0, None],
        }
        for after, low in ((400, 4.0), (1000, 10.0))
    ],
    "readings": {"revolution": [10, 100, 1000], "depth_um": [0.1, 1.0, 10.0]},
    "course": {
        "revolution": [100.0, 1000.0],
        "wear_coefficient_low": [4e-4, 5.3e-4],
        "wear_coefficient": [5e-4, 5.55e-4],
        "wear_coefficient_high": [7e-4, 5.8e-4],
    },
    "remaining_revolutions": {"depth_um": 40.0},
}


@pytest.fixture
def worker() -> Iterator[TaskWorker]:
    worker = TaskWorker("test-wear")
    yield worker
    worker.close()


@pytest.fixture
def stated(make_snapshot: Callable[..., Snapshot]) -> Callable[..., Snapshot]:
    """Return the maker of snapshots whose newest prediction states the wear."""

    def make(count: int = 1000, **values: float) -> Snapshot:
        plain = make_snapshot(count=count)
        table = np.frombuffer(plain.predictions).reshape(count, len(NAMES)).copy()
        for name, value in {**STATED, **values}.items():
            table[-5:-2, NAMES.index(name)] = value
        return msgspec.structs.replace(plain, predictions=table.tobytes())

    return make


def test_the_tiles_tell_coefficient_limits_and_what_remains(stated: Any) -> None:
    data = LiveData()
    data.take(stated())
    now = 1.8e9
    coefficient, left = wear_values(data.predictions, 30.0, now, 1000.0)
    assert coefficient.value == "555 · 10⁻⁶ mm³/(N m)"
    assert coefficient.detail == "530 to 580 (95 %); constant"
    assert left.value == "1 h 39 min", "2 revolutions of 2 s less than 6000 s"
    assert left.detail.endswith("2\u202f498 to beyond the model revolutions (95 %)")
    assert ":" in left.detail.partition(";")[0]
    standing = wear_values(data.predictions, 0.0, None, 1000.0)[1]
    assert standing.value == "2\u202f998 revolutions"


def test_without_a_statement_there_is_no_tile(make_snapshot: Any) -> None:
    data = LiveData()
    data.take(make_snapshot(count=10))
    assert wear_values(data.predictions, 30.0, 0.0, 10.0) == []
    assert newest_wear(data.predictions).statement == ""


def test_running_in_and_a_change_are_words_in_the_tile(stated: Any) -> None:
    for model, share, words in (
        (1.0, 0.97, "running-in"),
        (2.0, 0.97, "change"),
        (2.0, 0.9, "not identified, most likely change (90 %)"),
    ):
        data = LiveData()
        data.take(stated(wear_model=model, wear_model_weight=share))
        assert newest_wear(data.predictions).statement == words


@pytest.mark.parametrize("model", [-1.0, 0.5, 3.0, 1e30, np.inf])
def test_a_wear_model_of_another_version_is_said_to_be_unknown(stated: Any, model: float) -> None:
    data = LiveData()
    data.take(stated(wear_model=model))
    said = newest_wear(data.predictions).statement
    assert said == ("" if np.isinf(model) else f"the file's wear model {model:g} is unknown here")


def test_the_panel_draws_bands_and_course_and_asks_again_only_for_news(
    qtbot: Any, qapp: Any, stated: Any, worker: TaskWorker
) -> None:
    asked: list[tuple[Path, int]] = []

    def read(path: Path, after: int) -> KnownWear:
        asked.append((path, after))
        return of_tree(TREE)

    panel = WearPanel(LIGHT, WearReader(worker, read))
    qtbot.addWidget(panel)
    panel.show_news(News())
    assert panel.sentence.text().startswith("No revolution measured yet")
    data = LiveData()
    data.take(stated())
    news = News(data=data, path=Path("a.h5"))

    def drawn() -> bool:
        panel.show_news(news)
        worker.deliver()
        x = panel.bands.plot.newest.median.x
        return len(x) > 0

    qtbot.waitUntil(drawn, timeout=PATIENCE_MS)
    for _ in range(3):
        panel.show_news(news)
    assert asked == [(Path("a.h5"), 1000)]
    assert panel.sentence.text().startswith("The joint wears at a constant coefficient")
    assert [one.text for one in panel.bands.plot.marks.names] == [
        "from 400 on",
        "from 1\u202f000 on",
        "measured",
    ]
    assert list(panel.bands.plot.newest.median.x) == [1000, 2000], "not what is unknown"
    assert panel.narrowing.plot.instead == ""
    panel.dress(DARK)
    panel.show_news(News(path=Path("b.h5")))
    assert panel.narrowing.plot.instead.startswith("No revolution measured yet")


def test_a_refusal_is_told_in_words(
    qtbot: Any, qapp: Any, make_snapshot: Any, worker: TaskWorker
) -> None:
    sentence = "The wear coefficient cannot be determined, because the probes have no record."

    def run(arguments: list[str]) -> str:
        assert arguments == ["a.h5", "--json", "--after", "50"]
        return json.dumps({"tests": [{"refused": True, "sentence": sentence}]})

    panel = WearPanel(LIGHT, WearReader(worker, lambda path, after: known_wear(path, after, run)))
    qtbot.addWidget(panel)
    data = LiveData()
    data.take(make_snapshot(count=50))

    def told() -> bool:
        panel.show_news(News(data=data, path=Path("a.h5")))
        worker.deliver()
        return panel.sentence.text() == sentence

    qtbot.waitUntil(told, timeout=PATIENCE_MS)
    assert panel.narrowing.plot.instead.startswith("The wear coefficient is drawn here")


def test_the_tiles_stand_in_the_window(
    window: MainWindow, engine: Any, attach: Callable[[], None], stated: Any
) -> None:
    engine.snapshots.append(stated())
    attach()
    assert window.side.live.free["wear_coefficient"].value.whole == "555 · 10⁻⁶ mm³/(N m)"


def forecast(qtbot: Any, worker: TaskWorker, tree: dict[str, Any] = TREE) -> ForecastPanel:
    panel = ForecastPanel(
        LIGHT, WearReader(worker, lambda path, after: of_tree(tree)), lambda: None
    )
    qtbot.addWidget(panel)
    panel.show()
    return panel


def test_the_forecast_runs_to_the_planned_end_and_says_what_remains(
    qtbot: Any, qapp: Any, stated: Any, worker: TaskWorker
) -> None:
    panel = forecast(qtbot, worker)
    data = LiveData()
    data.take(stated())
    news = News(status=stated().status, data=data, path=Path("a.h5"))

    def drawn() -> bool:
        panel.show_news(news)
        worker.deliver()
        return len(panel.plot.newest.median.x) > 0

    qtbot.waitUntil(drawn, timeout=PATIENCE_MS)
    assert [one.text for one in panel.plot.marks.names] == ["forecast, 95 %", "measured"]
    assert panel.plot.viewRange()[0][1] == max(4000, news.status.test.planned)
    assert panel.remains.whole.startswith("Until the final wear depth: ")
    assert "to beyond the model revolutions (95 %)" in panel.remains.whole
    assert panel.why.isHidden()
    assert panel.calibrate_button.isHidden()


def test_without_a_record_of_the_probes_one_sentence_says_so_with_the_way_out(
    qtbot: Any, qapp: Any, make_snapshot: Any, worker: TaskWorker
) -> None:
    panel = forecast(qtbot, worker, {"refused": True, "sentence": "Not known."})
    data, snapshot = LiveData(), make_snapshot(count=50)
    data.take(snapshot)
    status = snapshot.status
    for uncertainty, lacking in ((None, True), (0.5, False)):
        probes = tuple(
            msgspec.structs.replace(one, name=f"probe_{at}", uncertainty=uncertainty)
            for at, one in enumerate(status.rig.channels[:2], 1)
        )
        rig = msgspec.structs.replace(status.rig, channels=probes)
        news = News(msgspec.structs.replace(status, rig=rig), data, path=Path("a.h5"))
        panel.show_news(news)
        assert panel.calibrate_button.isHidden() is not lacking
        assert ("no calibration record" in panel.why.text()) is lacking
        panel.show_news(replace(news, is_replay=True))
        assert panel.calibrate_button.isHidden(), "a replay has no rig to calibrate"


@pytest.mark.long  # a program of its own
def test_what_the_command_refuses_is_its_own_sentence(tmp_path: Path) -> None:
    with pytest.raises(OSError, match=r"gone\.h5"):
        run_identify([str(tmp_path / "gone.h5"), "--json"])
