"""One revolution of the joint force: measured solid, model dashed, their difference below."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from rigapp.gui.frames import COMPONENT_NAMES, Frame, to_frame
from rigapp.gui.header import ElidedLabel
from rigapp.gui.palette import Theme, measured_pen, model_pen
from rigapp.gui.plotting import LegendEntry, LegendRow, QuietPlot
from rigapp.gui.pyramid import thinned
from rigapp.gui.ranges import SteadyRange
from rigapp.gui.series import LiveData, MeasuredCycle, PredictedCycle

Floats = NDArray[np.float64]

CURVES = ("force", "force_1", "force_2")
COMPONENT_SYMBOLS = {Frame.CRANK: "F₁", Frame.FOLLOWER: "F₁", Frame.GLOBAL: "F"}


@dataclass(frozen=True, slots=True)
class Shown:
    """The arrays on the screen: crank angle, |F| and components of measurement and model.

    ``model`` is on the model's own angles, ``residual`` (measured - model) on the measured ones.
    """

    angle_deg: Floats
    measured: dict[str, Floats]
    measured_revolution: int
    model_angle_deg: Floats | None = None
    model: dict[str, Floats] | None = None
    residual: dict[str, Floats] | None = None
    model_revolution: int | None = None


def compose(
    cycle: MeasuredCycle,
    prediction: PredictedCycle | None,
    frame: Frame,
    crank_over_follower: float | None,
) -> Shown:
    """Return measurement, model and their difference over one revolution in a frame."""
    angle = cycle.angle_deg.astype(np.float64)
    measured = _in_frame(angle, cycle.channels, frame, crank_over_follower)
    if prediction is None:
        return Shown(angle, measured, cycle.revolution)
    model_angle = np.append(prediction.angle_deg, 360.0)
    curves = {name: np.append(values, values[0]) for name, values in prediction.curves.items()}
    on_measured = {name: prediction.at(angle, name) for name in CURVES}
    model = _in_frame(angle, on_measured, frame, crank_over_follower)
    return Shown(
        angle,
        measured,
        cycle.revolution,
        model_angle,
        _in_frame(model_angle, curves, frame, crank_over_follower),
        {name: measured[name] - model[name] for name in CURVES},
        prediction.revolution,
    )


def _in_frame(
    angle_deg: Floats,
    curves: Mapping[str, NDArray[np.floating]],
    frame: Frame,
    crank_over_follower: float | None,
) -> dict[str, Floats]:
    one, two = to_frame(curves["force_1"], curves["force_2"], angle_deg, frame, crank_over_follower)
    return {"force": curves["force"].astype(np.float64), "force_1": one, "force_2": two}


class OverlayPanel(QWidget):
    """Draw the newest revolution and the model's, with a strip for their difference."""

    def __init__(self, prefix: str, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._frame = Frame.CRANK
        self._ratio: float | None = None
        self._stale = False
        self._drawn: tuple[object, ...] = ()
        self.shown: Shown | None = None
        self.setObjectName(f"{prefix}_overlay_panel")
        self.setAccessibleName("Joint force over one revolution")
        self.plot = QuietPlot(f"{prefix}_force_plot", "Joint force against crank angle", theme)
        self.plot.label("left", "Force (N)")
        self.plot.show_crank_angle(theme, label=False)
        self.plot.guide(0.0, horizontal=True, theme=theme)
        self.residual_plot = QuietPlot(
            f"{prefix}_residual_plot", "Measured minus model against crank angle", theme
        )
        self.residual_plot.label("left", "Meas. − model (N)")
        self.residual_plot.show_crank_angle(theme)
        self.residual_plot.guide(0.0, horizontal=True, theme=theme)
        self._measured = {name: self.plot.curve(measured_pen(theme, name)) for name in CURVES}
        self._model = {name: self.plot.curve(model_pen(theme)) for name in CURVES}
        self._residual = {
            name: self.residual_plot.curve(measured_pen(theme, name)) for name in CURVES
        }
        self._range = SteadyRange(10.0)
        self._residual_range = SteadyRange(4.0, symmetric=True)
        self._build(prefix)

    def _build(self, prefix: str) -> None:
        self.title = ElidedLabel(f"{prefix}_overlay_title", "Revolutions shown")
        self.frame_box = QComboBox()
        self.frame_box.setObjectName(f"{prefix}_frame")
        self.frame_box.setAccessibleName("Frame of the force components")
        for frame in Frame:
            self.frame_box.addItem(f"{frame.value} frame", frame)
        self.frame_box.currentIndexChanged.connect(self._frame_chosen)
        caption = QLabel("Fra&me")
        caption.setBuddy(self.frame_box)
        top = QHBoxLayout()
        top.addWidget(self.title, 1)
        top.addWidget(caption)
        top.addWidget(self.frame_box)
        self.legend = LegendRow(f"{prefix}_overlay_legend")
        self.column = QVBoxLayout(self)
        self.column.setContentsMargins(0, 0, 0, 0)
        self.column.setSpacing(2)
        self.column.addLayout(top)
        self.column.addWidget(self.legend)
        self.column.addWidget(self.plot, 5)
        self.column.addWidget(self.residual_plot, 2)
        self._offer_follower_frame()
        self._show_legend()

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme = theme
        self.plot.dress(theme)
        self.residual_plot.dress(theme)
        for name in CURVES:
            self._measured[name].setPen(measured_pen(theme, name))
            self._residual[name].setPen(measured_pen(theme, name))
        self._apply_model_pen()
        self._show_legend()

    def set_mechanism(self, crank_over_follower: float | None) -> None:
        """Take crank radius / follower length of the test; None: the follower frame is closed."""
        if crank_over_follower != self._ratio:
            self._ratio = crank_over_follower
            self._offer_follower_frame()

    def refresh(self, data: LiveData, *, stale: bool) -> None:
        """Draw the newest revolution if it is not drawn yet."""
        if stale != self._stale:
            self._stale = stale
            self._apply_model_pen()
            self._show_legend()
        prediction, cycle = data.prediction, data.cycle
        if prediction is not None and cycle is not None and not stale:
            cycle = data.partner(prediction) or cycle
        if cycle is None:
            self.title.show_text("No revolution measured yet")
            return
        token = (cycle.revolution, prediction and prediction.revolution, self._frame, self._ratio)
        if token == self._drawn:
            return
        self._drawn = token
        self.draw(compose(cycle, prediction, self._frame, self._ratio))

    def draw(self, shown: Shown) -> None:
        """Draw arrays."""
        self.shown = shown
        buckets = max(self.plot.width(), 200)
        for name in CURVES:
            self._measured[name].setData(*thinned(shown.angle_deg, shown.measured[name], buckets))
        shapes = [*shown.measured.values()]
        text = f"Measured: revolution {shown.measured_revolution}"
        if shown.model is None or shown.residual is None:
            for name in CURVES:
                self._model[name].setData([], [])
                self._residual[name].setData([], [])
            self.title.show_text(f"{text}.  No prediction yet")
        else:
            shapes += shown.model.values()
            for name in CURVES:
                self._model[name].setData(shown.model_angle_deg, shown.model[name])
                self._residual[name].setData(
                    *thinned(shown.angle_deg, shown.residual[name], buckets)
                )
            worst = max(float(np.abs(values).max()) for values in shown.residual.values())
            if self._residual_range.update(-worst, worst):
                self.residual_plot.setYRange(*self._known(self._residual_range), padding=0.0)
            self.title.show_text(f"{text}.  Model: revolution {shown.model_revolution}")
        low = min(float(values.min()) for values in shapes)
        high = max(float(values.max()) for values in shapes)
        if self._range.update(low, high):
            self.plot.setYRange(*self._known(self._range), padding=0.0)

    @staticmethod
    def _known(steady: SteadyRange) -> tuple[float, float]:
        return steady.range or (-1.0, 1.0)

    def _frame_chosen(self) -> None:
        self._frame = Frame(self.frame_box.currentData())
        self._range.forget()
        self._residual_range.forget()
        self._drawn = ()
        self._show_legend()

    def _offer_follower_frame(self) -> None:
        index = self.frame_box.findData(Frame.FOLLOWER)
        known = self._ratio is not None
        flags = None if known else Qt.ItemFlag.NoItemFlags.value
        self.frame_box.setItemData(index, flags, Qt.ItemDataRole.UserRole - 1)
        if not known and self._frame is Frame.FOLLOWER:
            self.frame_box.setCurrentIndex(self.frame_box.findData(Frame.CRANK))

    def _apply_model_pen(self) -> None:
        for curve in self._model.values():
            curve.setPen(model_pen(self._theme, stale=self._stale))

    def _show_legend(self) -> None:
        first, second = COMPONENT_NAMES[self._frame]
        self.legend.show_entries(
            (
                LegendEntry("|F|", measured_pen(self._theme, "force")),
                LegendEntry(first, measured_pen(self._theme, "force_1")),
                LegendEntry(second, measured_pen(self._theme, "force_2")),
                LegendEntry(
                    "model (stale)" if self._stale else "model",
                    model_pen(self._theme, stale=self._stale),
                ),
            )
        )
