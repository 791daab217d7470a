"""What leaves a plot: its picture in three forms, its data; and a look closer and back."""

from __future__ import annotations

import csv
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QContextMenuEvent, QGuiApplication, QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu, QWidget

from rigapp.config.errors import UnusableInput
from rigapp.gui.plots.marks import CurveName
from rigapp.gui.plots.overlay import OverlayPanel
from rigapp.gui.plots.palette import MODEL, LinePen
from rigapp.gui.plots.plotmenu import offer_menus, save_data, save_picture
from rigapp.gui.plots.plotting import QuietPlot
from rigapp.gui.plots.readings import ItemPoints, value_at
from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import LIGHT

X = np.linspace(0.0, 10.0, 11)


@pytest.fixture
def plot(light_application: Any, qtbot: Any) -> QuietPlot:
    """Return a plot of a measured and a predicted curve."""
    made = QuietPlot("test_plot", "Force against cycle", LIGHT)
    qtbot.addWidget(made)
    made.label("bottom", "Cycle")
    made.resize(400, 300)
    made.curve(LinePen("main")).setData(X, X**2)
    made.curve(MODEL).setData(X, np.where(X == 3.0, np.nan, 2.0 * X))
    made.show_range("x", 0.0, 10.0)
    made.fit(0.0, 100.0)
    made.show_marks(
        names=(CurveName("=|F|", LinePen("main"), 100.0), CurveName("model", MODEL, 20.0))
    )
    made.show()
    qtbot.waitExposed(made, timeout=PATIENCE_MS)
    return made


def test_the_data_have_names_units_and_no_formula(plot: QuietPlot, tmp_path: Path) -> None:
    save_data(plot, tmp_path / "data.csv")
    rows = list(csv.reader((tmp_path / "data.csv").read_text("utf-8").splitlines()))
    assert rows[0] == ["Curve", "Cycle", "Force against cycle"]
    assert rows[3] == ["'=|F|", "2", "4"]
    assert rows[12 + 3] == ["model", "3", ""], "what is not known stays empty"
    assert len(rows) == 1 + 22


@pytest.mark.sampled
@pytest.mark.parametrize("ending", ["png", "svg", "pdf"])
def test_the_picture_is_saved(plot: QuietPlot, tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"plot.{ending}"
    save_picture(plot, path)
    data = path.read_bytes()
    if ending == "png":
        image = QImage(str(path))
        assert image.width() == 1200
        colours = {
            image.pixelColor(x, y).name() for x in range(0, 1200, 2) for y in range(0, 900, 3)
        }
        assert LIGHT.curves["main"] in colours
    elif ending == "svg":
        assert b"<polyline" in data or b"<path" in data
        assert LIGHT.curves["model"].encode() in data
    else:
        from pypdf import PdfReader

        (page,) = PdfReader(path).pages
        assert "Cycle" in page.extract_text()
    with pytest.raises(UnusableInput, match="nowhere"):
        save_picture(plot, tmp_path / "nowhere" / f"x.{ending}")


def test_a_rectangle_is_shown_larger_and_backspace_shows_all_again(plot: QuietPlot) -> None:
    view, port = plot.getViewBox(), plot.viewport()
    before = view.viewRange()
    area = view.sceneBoundingRect()
    first = plot.mapFromScene(area.center())
    last = first + QPoint(60, 50)
    QTest.mousePress(port, Qt.MouseButton.LeftButton, pos=first)
    QTest.mouseMove(port, last)
    QTest.mouseRelease(port, Qt.MouseButton.LeftButton, pos=last)
    assert plot.zoomed
    (low, high), (bottom, top) = view.viewRange()
    assert before[0][0] < low < high < before[0][1]
    assert before[1][0] <= bottom < top < before[1][1]
    plot.fit(-500.0, 500.0)
    assert view.viewRange()[1] == [bottom, top], "new values do not take the closer look away"
    QTest.keyClick(plot, Qt.Key.Key_Backspace)
    assert not plot.zoomed
    assert view.viewRange()[0] == before[0]
    assert view.viewRange()[1][1] >= 500.0


def test_a_small_tremble_is_a_click(plot: QuietPlot) -> None:
    port = plot.viewport()
    QTest.mousePress(port, Qt.MouseButton.LeftButton, pos=QPoint(200, 150))
    QTest.mouseMove(port, QPoint(203, 152))
    QTest.mouseRelease(port, Qt.MouseButton.LeftButton, pos=QPoint(203, 152))
    assert not plot.zoomed


def test_the_menu_opens_by_its_key_and_copies(plot: QuietPlot, qtbot: Any) -> None:
    page = QWidget()
    qtbot.addWidget(page)
    plot.setParent(page)
    offer_menus(page, lambda text, good: None)
    at = plot.mapToGlobal(QPoint(5, 5))
    event = QContextMenuEvent(QContextMenuEvent.Reason.Keyboard, QPoint(5, 5), at)
    QApplication.sendEvent(plot, event)
    menu = plot.findChild(QMenu, "plot_menu")
    assert menu is not None
    texts = [one.text() for one in menu.actions()]
    assert texts == [
        "Copy picture",
        "Save picture…",
        "Save data…",
        "Two cursors",
        "Show all again",
    ]
    assert not menu.actions()[-1].isEnabled()
    QGuiApplication.clipboard().clear()
    menu.actions()[0].trigger()
    assert QGuiApplication.clipboard().pixmap().width() >= 400
    menu.close()
    plot.setParent(None)


def test_what_is_shown_as_a_plot_has_160_pixels_at_least(plot: QuietPlot, qtbot: Any) -> None:
    assert plot.minimumHeight() >= 160
    overlay = OverlayPanel("overview", LIGHT)
    qtbot.addWidget(overlay)
    assert overlay.plot.minimumHeight() >= 160
    assert overlay.residual_plot.minimumHeight() >= 80, "a strip below a plot"


def test_two_cursors_read_every_curve_and_the_difference(plot: QuietPlot, qtbot: Any) -> None:
    plot.show_range("x", 0.0, 12.0)
    qtbot.keyClick(plot, Qt.Key.Key_1)
    assert plot.cursors.places == pytest.approx([4.0, 8.0])
    qtbot.keyClick(plot, Qt.Key.Key_Right, Qt.KeyboardModifier.ControlModifier)
    assert plot.cursors.places == pytest.approx([4.06, 8.0])
    qtbot.keyClick(plot, Qt.Key.Key_2)
    both = Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier
    qtbot.keyClick(plot, Qt.Key.Key_Left, both)
    assert plot.cursors.places == pytest.approx([4.06, 7.4])
    head, across, *curves = plot.cursor_readout()
    assert head == ["", "1", "2", "2 \u2212 1"]
    assert across[1:] == ["4.06", "7.4", "3.34"]
    assert [row[0] for row in curves] == ["model", "=|F|"], "the one on top first"
    assert curves[1][1:] == ["16", "49", "33"]
    assert "2 \u2212 1" in plot.accessibleDescription()
    plot.grab()
    qtbot.keyClick(plot, Qt.Key.Key_Escape)
    assert plot.cursors.places == []


def test_shift_and_click_put_the_cursors_and_then_move_the_nearer_one(
    plot: QuietPlot, qtbot: Any
) -> None:
    frame = plot.getViewBox().sceneBoundingRect()
    low, high = plot.viewRange()[0]
    for share in (0.2, 0.8, 0.7):
        at = plot.mapFromScene(frame.left() + share * frame.width(), frame.center().y())
        qtbot.mouseClick(
            plot.viewport(), Qt.MouseButton.LeftButton, Qt.KeyboardModifier.ShiftModifier, at
        )
    found = [(one - low) / (high - low) for one in plot.cursors.places]
    assert found == pytest.approx([0.2, 0.7], abs=0.02)
    assert not plot.zoomed


def test_a_value_is_that_of_the_nearest_point_and_none_beyond_the_ends() -> None:
    curve = ItemPoints(np.array([0.0, 1.0, 2.0, 3.0]), np.array([5.0, np.nan, 7.0, 8.0]))
    assert [value_at(curve, at) for at in (0.4, 1.1, 2.9)] == [5.0, 7.0, 8.0]
    assert math.isnan(value_at(curve, 3.1))
    assert math.isnan(value_at(curve, -0.1))


def test_the_same_keys_do_so_on_every_plot_of_the_window(window: MainWindow, qtbot: Any) -> None:
    for plot in window.findChildren(QuietPlot):
        plot.empty("")
        qtbot.keyClick(plot, Qt.Key.Key_2)
        low, high = plot.viewRange()[0]
        before = list(plot.cursors.places)
        assert len(before) == 2, plot.objectName()
        qtbot.keyClick(plot, Qt.Key.Key_Left, Qt.KeyboardModifier.ControlModifier)
        step = before[1] - plot.cursors.places[1]
        assert step == pytest.approx((high - low) / 200.0), plot.objectName()
        qtbot.keyClick(plot, Qt.Key.Key_Escape)
        assert plot.cursors.places == [], plot.objectName()
