"""The page that the operator arranges: it is shown, changed, and saved with the test file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from rigapp.config.loading import read_test
from rigapp.config.recipe import MOST_TILES, ViewSection
from rigapp.gui.panels.own import OwnPage
from rigapp.gui.plots.overlay import OverlayPanel
from rigapp.gui.plots.trend import TrendPanel
from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import DARK

QUICK = Path(__file__).parents[2] / "examples" / "quick.toml"


@pytest.fixture
def page(window: MainWindow) -> OwnPage:
    window.tabs.show_page("own")
    return window.tabs.own


def add(page: OwnPage, kind: str, name: str) -> None:
    box = getattr(page, kind)
    box.setCurrentIndex(box.findData(name))
    getattr(page, f"add_{kind}").click()


def test_tiles_and_plots_are_added_moved_and_taken_away(
    page: OwnPage, window: MainWindow, engine: Any, attach: Callable[[], None]
) -> None:
    for name in ("force_max", "speed", "wear_depth"):
        add(page, "tile", name)
    add(page, "tile", "speed")
    for name in ("cycle", "wear", "speed"):
        add(page, "plot", name)
    assert page.view == ViewSection(
        ("force_max", "speed", "wear_depth"), ("cycle", "wear", "speed")
    )
    engine.say(count=30)
    attach()
    value = page._made["speed"].inside
    assert value.whole.endswith(" rpm")
    add(page, "tile", "wear_coefficient")
    assert page._made["wear_coefficient"].title.whole == "Wear coefficient"
    page._made["wear_coefficient"].moves["away"].click()
    kinds = [type(page._made[f"plot {name}"].inside) for name in page.view.plots]
    assert kinds == [OverlayPanel, TrendPanel, TrendPanel]
    trend = page._made["plot speed"].inside
    assert trend.plot.marks.names, "it is drawn"
    page._made["speed"].moves["earlier"].click()
    assert page.view.tiles == ("speed", "force_max", "wear_depth")
    page._made["speed"].moves["later"].click()
    page._made["speed"].moves["later"].click()
    page._made["speed"].moves["later"].click()
    assert page.view.tiles == ("force_max", "wear_depth", "speed")
    page._made["plot wear"].moves["away"].click()
    assert page.view.plots == ("cycle", "speed")
    assert "plot wear" not in page._made
    window.dress(DARK)


def test_there_are_no_more_than_are_read_at_a_glance(page: OwnPage) -> None:
    for at in range(page.tile.count()):
        page.tile.setCurrentIndex(at)
        page.add_tile.click()
    assert len(page.view.tiles) == MOST_TILES


def test_it_is_saved_with_the_test_file_and_comes_back(
    page: OwnPage, window: MainWindow, tmp_path: Path
) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(QUICK.read_text("utf-8"), "utf-8")
    recipe = window.tabs.prepare.recipe
    recipe.open_file(file)
    add(page, "tile", "force_max")
    add(page, "plot", "wear")
    page.save.click()
    assert read_test(file).record.view == ViewSection(("force_max",), ("wear",))
    assert file.read_text("utf-8").startswith("# A short wear test"), "comments stay"
    recipe.form.edit("metadata.specimen", "another")
    assert recipe.save(file)
    assert read_test(file).record.view.tiles == ("force_max",), "the form keeps it"
    recipe.open_file(QUICK)
    assert page.view == ViewSection()
    recipe.open_file(file)
    assert page.view == ViewSection(("force_max",), ("wear",))


def test_it_is_not_saved_over_changes_that_are_not(
    page: OwnPage, window: MainWindow, tmp_path: Path
) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(QUICK.read_text("utf-8"), "utf-8")
    window.tabs.prepare.recipe.open_file(file)
    window.tabs.prepare.recipe.form.edit("metadata.specimen", "another")
    add(page, "tile", "force_max")
    page.save.click()
    assert "not saved" in window.controls.answer.whole
    assert read_test(file).record.view == ViewSection()


def test_what_a_rig_does_not_have_is_named(page: OwnPage) -> None:
    page.take_view(ViewSection(("oil_pressure_max", "force_max"), ("oil_pressure",)))
    assert "oil_pressure, oil_pressure_max" in page.hint.text()
    assert list(page._made) == ["force_max"]


def test_lists_of_quantities_are_searched_and_grouped(page: OwnPage, qtbot: Any) -> None:
    box = page.tile
    names = [box.itemData(at) for at in range(box.count())]
    first_probe = next(at for at, name in enumerate(names) if name and name.startswith("probe_"))
    assert names[first_probe - 1] is None, "a line parts the groups"
    assert all(name.startswith("force") for name in names[: first_probe - 1])
    box.completer().setCompletionPrefix("wear coeff")
    assert box.completer().completionCount() == 1, "typed words may stand anywhere"
    before = box.currentText()
    box.setEditText("no such thing")
    box.lineEdit().editingFinished.emit()
    assert box.currentText() == before
