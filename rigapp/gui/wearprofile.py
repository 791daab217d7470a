"""The worn bushing as it follows from the wear depth, measured and predicted."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from PySide6.QtWidgets import QVBoxLayout, QWidget

from rigapp.config.parameters import JointSection
from rigapp.gui.palette import Theme, line_pen, measured_pen, model_pen
from rigapp.gui.plotting import LegendEntry, LegendRow, QuietPlot
from rigapp.gui.ranges import SteadyRange
from rigapp.gui.series import LiveData

Floats = NDArray[np.float64]

ANGLES_DEG = np.linspace(-180.0, 180.0, 721)


def worn_profile(depth_mm: float, pin_radius_mm: float, bushing_radius_mm: float) -> Floats:
    """Return the depth of wear in mm at ANGLES_DEG from the contact point.

    The pin's circle has sunk into the bushing by ``depth_mm`` at the contact point; what lies
    beyond the bushing's first circle is worn. This holds where wear is much larger than elastic
    indentation and the force keeps its direction.
    """
    centre = bushing_radius_mm - pin_radius_mm + depth_mm
    angle = np.radians(ANGLES_DEG)
    root = np.maximum(pin_radius_mm**2 - (centre * np.sin(angle)) ** 2, 0.0)
    surface = centre * np.cos(angle) + np.sqrt(root)
    return np.maximum(surface - bushing_radius_mm, 0.0)


class WearProfilePanel(QWidget):
    """Draw the worn profile in the follower frame."""

    def __init__(self, prefix: str, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._drawn: tuple[float, float, JointSection | None] | None = None
        self.setObjectName(f"{prefix}_profile_panel")
        self.setAccessibleName("Worn profile of the bushing")
        self.plot = QuietPlot(f"{prefix}_profile_plot", "Worn profile of the bushing", theme)
        self.plot.label("left", "Depth (mm)")
        self.plot.label("bottom", "Angle from the contact point (deg), follower frame")
        self.plot.setXRange(-180.0, 180.0, padding=0.0)
        ticks = [(float(at), str(at)) for at in range(-180, 181, 90)]
        self.plot.getAxis("bottom").setTicks([ticks])
        for at in (-90.0, 0.0, 90.0):
            self.plot.guide(at, horizontal=False, theme=theme)
        self._measured = self.plot.curve(measured_pen(theme, "max"))
        self._model = self.plot.curve(model_pen(theme, width=2.0))
        self._range = SteadyRange(0.002)
        self.legend = LegendRow(f"{prefix}_profile_legend")
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addWidget(self.legend)
        column.addWidget(self.plot, 1)
        self.dress(theme)

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme = theme
        self.plot.dress(theme)
        self._measured.setPen(measured_pen(theme, "max"))
        self._model.setPen(model_pen(theme, width=2.0))
        self._show_legend(math.nan, math.nan)
        self._drawn = None

    def refresh(self, data: LiveData, joint: JointSection | None) -> None:
        """Draw the profile of the newest depths."""
        measured = data.predictions.last("measured_wear_depth")
        predicted = data.predictions.last("wear_depth")
        token = (measured, predicted, joint)
        if joint is None or repr(token) == repr(self._drawn):
            return
        self._drawn = token
        deepest = 0.0
        for curve, depth in ((self._measured, measured), (self._model, predicted)):
            if math.isfinite(depth):
                sunk = max(depth, 0.0)
                profile = worn_profile(sunk, joint.pin_radius_mm, joint.bushing_radius_mm)
                curve.setData(ANGLES_DEG, profile)
                deepest = max(deepest, depth)
            else:
                curve.setData([], [])
        if self._range.update(0.0, deepest) and self._range.range is not None:
            self.plot.setYRange(*self._range.range, padding=0.0)
        self._show_legend(measured, predicted)

    def _show_legend(self, measured: float, predicted: float) -> None:
        def text(name: str, depth: float) -> str:
            return f"{name} {depth:.4f} mm" if math.isfinite(depth) else f"{name}: not known"

        self.legend.show_entries(
            (
                LegendEntry(text("measured", measured), measured_pen(self._theme, "max")),
                LegendEntry(text("model", predicted), model_pen(self._theme, width=2.0)),
                LegendEntry("pin's circle sunk into the bushing", line_pen(self._theme.base)),
            )
        )
