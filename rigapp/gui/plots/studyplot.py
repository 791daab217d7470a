"""Scatter plot of a study: one result against one varied parameter."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import PurePath
from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtWidgets import QComboBox

from rigapp.gui.language.keys import key_name
from rigapp.gui.plots.palette import LinePen
from rigapp.gui.plots.plotpanel import PlotPanel
from rigapp.gui.plots.plotting import QuietPlot
from rigapp.gui.widgets.build import choice, column
from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.gui.widgets.reflow import flowing
from rigapp.presentation.numbers import true_minus, unit_text
from rigapp.presentation.tokens import STEP, Theme
from rigapp.presentation.translation import Text, tr, translate
from rigapp.study.folder import StudyColumn, StudyResults
from rigapp.texts import capitalised
from rigapp.viewer.ranges import SteadyRange

NOTHING: Final[Text] = "Choose a study: its points are drawn here."
LEAST_LETTERS = 16
"""Minimum number of characters of a choice in a narrow window."""
MOST_NAMES = 6
"""Maximum number of texts at an axis; more would overlap."""
ROOM = 0.03
"""Margin beside the first and the last point, share of the width."""


def with_unit(words: str, unit: str) -> str:
    """Return a text with its unit in brackets."""
    unit = unit_text(unit)
    return f"{words} ({unit})" if unit else words


def result_title(result: StudyColumn) -> str:
    """Return the title of a result in the language of the window, with its unit."""
    words = translate(result.words) or result.name
    return with_unit(capitalised(words), result.unit)


def parameter_title(parameter: StudyColumn, study: StudyResults) -> str:
    """Return a parameter's name with its unit; its complete key where names would be equal."""
    endings = [column.name.rpartition(".")[2] for column in study.parameters]
    ending = parameter.name.rpartition(".")[2]
    words = parameter.name if endings.count(ending) > 1 else tr(key_name(ending))
    return with_unit(words, parameter.unit)


class StudyPlot(PlotPanel):
    """Draw the chosen result against the chosen parameter, and show its range."""

    def __init__(self, theme: Theme) -> None:
        super().__init__("study_plot_panel", "Points of the study")
        self._study: StudyResults | None = None
        self.result = choice("study_result", "Result to draw", (), self._draw)
        self.parameter = choice("study_parameter", "Parameter to draw it against", (), self._draw)
        self.range = ElidedLabel("study_range", "Range of the result")
        self.plot = QuietPlot("study_plot", "Result against parameter", theme)
        self._dots = self.plot.dots(LinePen("first"))
        for box in (self.result, self.parameter):
            box.setSizeAdjustPolicy(
                QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
            )
            box.setMinimumContentsLength(LEAST_LETTERS)
        choices = flowing("Of", (self.result, 1), "Against", (self.parameter, 1))
        choices.setSpacing(STEP)
        column(choices, self.range, (self.plot, 1), on=self)
        self.plot.empty(NOTHING)

    @property
    def column(self) -> StudyColumn | None:
        """Return the drawn result."""
        index = self.result.currentIndex()
        return None if self._study is None or index < 0 else self._study.results[index]

    def show_study(self, study: StudyResults | None) -> None:
        """List parameters and results of a study; a selection that still exists stays."""
        self._study = study
        results: list[tuple[str, str]] = []
        parameters: list[tuple[str, str]] = []
        if study is not None:
            results = [(result_title(result), result.name) for result in study.results]
            parameters = [
                (parameter_title(column, study), column.name) for column in study.parameters
            ]
        for box, items in ((self.result, results), (self.parameter, parameters)):
            chosen = box.currentData()
            box.blockSignals(True)
            box.clear()
            for text, name in items:
                box.addItem(text, name)
            box.setCurrentIndex(max(box.findData(chosen), 0 if items else -1))
            box.blockSignals(False)
            if box is self.parameter and box.findData(chosen) < 0:
                self._choose_strongest()
        self._draw()

    def _choose_strongest(self) -> None:
        """Select the parameter with the strongest influence on the result, where known."""
        known = (self._study.sensitivities or {}) if self._study is not None else {}
        if self.column is not None and self.column.name in known:
            self.parameter.blockSignals(True)
            self.parameter.setCurrentIndex(int(np.nanargmax(known[self.column.name].total)))
            self.parameter.blockSignals(False)

    def _draw(self) -> None:
        index, result = self.parameter.currentIndex(), self.column
        if self._study is None or result is None or index < 0:
            sentence = translate(self._study.reason) if self._study is not None else ""
            self._show_nothing(sentence or tr(NOTHING))
            return
        against = self._study.parameters[index]
        known = result.values[np.isfinite(result.values)]
        if not known.size:
            self._show_nothing(tr("No point has this result."))
            return
        low, high = float(known.min()), float(known.max())
        self.range.show_text(
            tr("{} to {}, half of them below {}", _short(low), _short(high), _short(_middle(known)))
        )
        self.plot.name_places("bottom", _names(against.texts))
        self.plot.label("bottom", parameter_title(against, self._study))
        self._dots.setData(against.values, result.values)
        first, last = float(against.values.min()), float(against.values.max())
        room = ROOM * (last - first) or 0.5
        self.plot.show_range("x", first - room, last + room)
        self.plot.steady = SteadyRange((high - low) or abs(high) or 1.0)
        self.plot.fit(low, high)

    def _show_nothing(self, why: str) -> None:
        self.range.show_text("")
        nothing = np.empty(0)
        self._dots.setData(nothing, nothing)
        self.plot.empty(why)


def _names(texts: Sequence[str]) -> list[str]:
    """Return the texts of an axis, for paths the file names; only some where there are many."""
    apart = math.ceil(len(texts) / MOST_NAMES)
    return [PurePath(text).name if index % apart == 0 else "" for index, text in enumerate(texts)]


def _short(number: float) -> str:
    return true_minus(f"{number:.4g}")


def _middle(known: NDArray[np.float64]) -> float:
    return float(np.median(known))
