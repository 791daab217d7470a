"""Free channels of a rig in the window: from the engine's table or the file's, by no list of it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import Qt
from snapshots import make_status

from rigapp.config.loading import parse_test
from rigapp.gui.panels.cycle import ChannelCurvePanel
from rigapp.gui.panels.limits import LimitPanel
from rigapp.gui.panels.trends import WearProfilePanel
from rigapp.gui.plots.overlay import OverlayPanel
from rigapp.gui.plots.plotting import QuietPlot
from rigapp.gui.plots.trend import TrendPanel
from rigapp.gui.testfile.rules import LimitSentences
from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import DARK, LIGHT
from rigapp.replay.client import ReplayClient
from rigapp.schema.channels import BASE, Channel, ChannelTable, Kind
from rigapp.schema.messages import ChannelView, Cycle, RunState, Snapshot
from rigapp.viewer.channels import table_of
from rigapp.viewer.connection import EngineConnection
from rigapp.viewer.news import News
from rigapp.viewer.quantities import compared_columns, trend_quantities
from rigapp.viewer.series import LiveData
from rigapp.viewer.shown import free_values
from rigapp.viewer.showntest import ShownTest

EXAMPLES = Path(__file__).parents[2] / "examples"
WARM = Channel("bushing_temperature", "degC", "bushing temperature")
ROOM = Channel("room_temperature", "degC", "room temperature", Kind.SLOW)
TABLE = ChannelTable((*BASE.channels, WARM, ROOM))


@pytest.fixture
def warm_snapshot(make_snapshot: Callable[..., Snapshot]) -> Callable[..., Snapshot]:
    """Return the maker of snapshots of a rig with a free channel and a slow one."""

    def make(first: int = 1, count: int = 20, **changes: Any) -> Snapshot:
        plain = make_snapshot(first, count, **changes)
        base = np.frombuffer(plain.rows).reshape(count, len(BASE.names))
        rows = np.full((count, len(TABLE.names)), np.nan)
        rows[:, : base.shape[1]] = base
        warm = 30.0 + 0.1 * np.arange(first, first + count)
        for column, values in (
            ("bushing_temperature_max", warm + 0.5),
            ("bushing_temperature_rms", warm),
            ("bushing_temperature_mean", warm),
            ("bushing_temperature_min", warm - 0.5),
            ("room_temperature", np.full(count, 21.5)),
            ("room_temperature_age", np.full(count, 12.0)),
        ):
            rows[:, TABLE.place[column]] = values
        cycle = plain.cycle
        if cycle is not None:
            angle = np.frombuffer(cycle.angle_deg, "<f4")
            curve = (31.0 + np.sin(np.radians(angle))).astype("<f4").tobytes()
            cycle = Cycle(cycle.revolution, cycle.angle_deg, {**cycle.curves, WARM.name: curve})
        return msgspec.structs.replace(plain, rows=rows.tobytes(), cycle=cycle, columns=TABLE.units)

    return make


def test_the_table_is_known_by_its_columns() -> None:
    assert table_of(TABLE.units).channels == TABLE.channels
    assert table_of(BASE.units).channels == BASE.channels


def test_every_channel_can_be_chosen_in_trend_and_comparison() -> None:
    plain, found = trend_quantities(BASE), trend_quantities(TABLE)
    assert found.keys() - plain.keys() == {WARM.name, ROOM.name}
    assert found[WARM.name].axis == "Temperature (°C)"
    assert [line.column for line in found[ROOM.name].measured] == [ROOM.name]
    columns = compared_columns(TABLE)
    assert columns["bushing_temperature_mean"] == "Bushing temperature, mean (°C)"
    assert columns["room_temperature"] == "Room temperature (°C)"
    assert "room_temperature_age" not in columns


def test_a_free_channel_is_watched_live_with_its_unit_and_age(
    window: MainWindow, engine: Any, attach: Callable[[], None], warm_snapshot: Any
) -> None:
    views = (
        ChannelView(WARM.name, 0.315, "V", 31.5, "degC", "by its line in the rig file"),
        ChannelView(ROOM.name, 21.4, "degC", 21.4, "degC", "told by thermometer", age_s=7.0),
    )
    engine.snapshots.append(warm_snapshot(count=0, curves=False, channels=views))
    attach()
    free = window.side.live.free
    assert free[WARM.name].value.whole == "31.50 °C"
    assert free[ROOM.name].value.whole == "21.40 °C"
    assert free[ROOM.name].caption.whole.endswith(", 7 s old")
    window.tabs.show_page("devices")
    window.draw_now()
    rows = {row[0]: row[1:] for row in window.tabs.panels["devices"].channels.texts()}
    assert rows[WARM.name][:2] == ["0.315 V", "31.50 °C"]
    assert rows[ROOM.name][1] == "21.40 °C, 7 s old"
    window.dress(DARK)
    engine.say(first=1, count=3)  # another rig, without them
    attach()
    assert not window.side.live.free


def test_a_plot_without_data_says_what_it_waits_for_and_shows_no_axes(
    qtbot: Any, qapp: Any, warm_snapshot: Any
) -> None:
    wear, curves = TrendPanel("x", LIGHT, "wear"), ChannelCurvePanel("x", LIGHT)
    overlay, profile = OverlayPanel("x", LIGHT), WearProfilePanel("x", LIGHT)
    panels = (wear, curves, overlay, profile)
    for panel in panels:
        qtbot.addWidget(panel)
        panel.show_news(News())
    plots = [plot for panel in panels for plot in panel.findChildren(QuietPlot)]
    assert len(plots) == 5
    for plot in plots:
        assert plot.instead.startswith("No ")
        assert not plot.getPlotItem().isVisible()
        assert plot.accessibleDescription() == plot.instead
    data = LiveData()
    unpredicted = {"predictions": b"", "prediction": None}
    data.take(msgspec.structs.replace(warm_snapshot(), **unpredicted))
    for panel in panels:
        panel.show_news(News(data=data))
    assert curves.plot.instead == overlay.plot.instead == ""
    assert overlay.plot.getPlotItem().isVisible()
    assert overlay.residual_plot.instead == "No prediction yet: measured − model is drawn here."
    assert wear.plot.instead == "No value of Wear depth yet; it is computed by the model."


def test_a_free_channel_is_drawn_in_the_trend_and_against_the_angle(
    qtbot: Any, qapp: Any, warm_snapshot: Any
) -> None:
    data = LiveData()
    data.take(warm_snapshot())
    trend, curves = TrendPanel("x", LIGHT), ChannelCurvePanel("x", LIGHT)
    for panel in (trend, curves):
        qtbot.addWidget(panel)
        panel.show_news(News(data=data))
    trend.choice.setCurrentIndex(trend.choice.findData(WARM.name))
    trend.show_news(News(data=data))
    assert trend.words == "Now: maximum 32.5 °C, RMS 32 °C, minimum 31.5 °C"
    trend.choice.setCurrentIndex(trend.choice.findData(ROOM.name))
    trend.show_news(News(data=data))
    assert trend.words == "Now: newest 21.5 °C, 12 s old"
    assert [curves.choice.itemText(i) for i in range(2)] == ["Pin position", "Bushing temperature"]
    curves.choice.setCurrentIndex(1)
    curves.show_news(News(data=data))
    drawn = curves._curves[0].y
    assert drawn.min() == pytest.approx(30.0, abs=1e-3)
    assert drawn.max() == pytest.approx(32.0, abs=1e-3)
    assert curves.title.whole == "°C, mean 31.0"
    # another rig: what was chosen is gone, and the panels show what is there
    for panel in (trend, curves):
        panel.show_news(News(data=LiveData()))
    assert trend.quantity.title == "|F|"
    assert curves.group.title == "Pin position"


def test_a_limit_on_a_free_channel_is_offered_and_changed(
    qtbot: Any, qapp: Any, make_status: Any
) -> None:
    rules = LimitSentences()
    qtbot.addWidget(rules)
    rules.fill([{"quantity": "force_max", "warning_above": 150.0}])
    rules.know(TABLE)
    box = rules.rows[0].quantity
    box.setCurrentIndex(box.findData("bushing_temperature_max"))
    assert box.currentText() == "maximum bushing temperature"
    assert rules.validate(None) == (
        [{"quantity": "bushing_temperature_max", "warning_above": 150.0}],
        0,
    )
    panel = LimitPanel()
    qtbot.addWidget(panel)
    name = "bushing_temperature_max.warning_above"
    quick = EXAMPLES / "quick.toml"
    limit = '[[limits.rule]]\nquantity = "bushing_temperature_max"\nwarning_above = 60.0\n'
    recipe = parse_test(quick.read_text(encoding="utf-8") + limit, "quick.toml")
    data = LiveData()
    data.channels = TABLE
    panel.show_news(News(make_status(), data, recipe))
    asked: list[Any] = []
    panel.wanted.connect(lambda verb, arguments: asked.append((verb, arguments)))
    sentence = "Warn when maximum bushing temperature is above"
    panel.table.selectRow([row[0] for row in panel.table.texts()].index(sentence))
    panel.value.setText("70")
    panel.reason.setText("hotter oil")
    panel.change.click()
    assert asked == [("set_limit", {"name": name, "value": 70, "reason": "hotter oil"})]


def test_newest_values_come_from_rows_where_nothing_is_live(warm_snapshot: Any) -> None:
    data = LiveData()
    data.take(warm_snapshot())
    status = make_status(channels=(), data_age_s=400.0, revolution_age_s=360.0)
    found = {one.name: one for one in free_values(News(status, data))}
    assert found[WARM.name].value == "32.00 °C"
    assert (found[WARM.name].detail, found[WARM.name].old) == ("6 min 0 s old", True)
    # Its age at the revolution, and since then.
    assert (found[ROOM.name].value, found[ROOM.name].detail) == ("21.50 °C", "6 min 12 s old")
    assert free_values(News(status)) == []


@pytest.mark.long
@pytest.mark.timeout(300)
def test_a_rig_with_free_channels_from_the_start_of_a_test_to_its_replay(
    operate: Any, tmp_path: Path, qtbot: Any
) -> None:
    quick = (EXAMPLES / "quick.toml").read_text(encoding="utf-8")
    test = tmp_path / "warm.toml"
    limit = '[[limits.rule]]\nquantity = "bushing_temperature_max"\nwarning_above = 90.0\n'
    test.write_text(quick.replace("revolutions = 500", "revolutions = 5000", 1) + limit, "utf-8")
    with operate(EXAMPLES / "simulated_channels.toml", test) as hands:
        window, panels = hands.window, hands.window.tabs.panels
        hands.start_test()
        hands.see(lambda: window.side.live.free["bushing_temperature"].value.whole.endswith(" °C"))
        hands.see(lambda: window.side.live.free["humidity"].caption.whole.endswith(" old"))
        trend = panels["overview_trend"]
        hands.choose(trend.choice, "Bushing temperature")
        hands.see(lambda: "maximum 2" in trend.words)
        window.tabs.setCurrentIndex(1)
        curves = panels["cycle"].channels
        hands.choose(curves.choice, "Bushing temperature")
        hands.see(lambda: curves.title.whole.startswith("°C, mean 2"))
        window.tabs.setCurrentIndex(3)
        limits, name = panels["limits"], "Warn when maximum bushing temperature is above"
        hands.see(lambda: name in [row[0] for row in limits.table.texts()])
        limits.table.selectRow([row[0] for row in limits.table.texts()].index(name))
        limits.value.setText("5")
        limits.reason.setText("to see it warn")
        hands.click(limits.change)
        hands.see(lambda: any("bushing_temperature" in one.cause for one in hands.status.alarms))
        file = hands.status.test.file
        hands.press(Qt.Key.Key_F12)
        hands.sees_state(RunState.STOPPED)
    client = ReplayClient(Path(file), at_end=True)
    window = MainWindow(EngineConnection(lambda: client), ShownTest(), DARK)
    qtbot.addWidget(window)
    window.show()
    window.start()

    trend = window.tabs.panels["overview_trend"]
    qtbot.waitUntil(lambda: trend.choice.findData("humidity") >= 0, timeout=PATIENCE_MS)

    def shown() -> bool:
        free = window.side.live.free
        value = free["bushing_temperature"].value.whole if "bushing_temperature" in free else ""
        return value.endswith(" °C") and free["humidity"].caption.whole.endswith(" old")

    qtbot.waitUntil(shown, timeout=PATIENCE_MS)
    trend.choice.setCurrentIndex(trend.choice.findData("humidity"))
    window.draw_now()
    assert trend.words.startswith("Now: newest ")
    assert any("bushing_temperature" in one.cause for one in window._connection.status.alarms)
    window._leave()
