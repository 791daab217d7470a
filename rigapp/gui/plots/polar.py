"""The force vector over one revolution, drawn where it points."""

from __future__ import annotations

import numpy as np
from PySide6.QtWidgets import QWidget

from rigapp.gui.data.channels import COMPONENTS, SIZE
from rigapp.gui.data.comparison import RevolutionCurves
from rigapp.gui.data.frames import COMPONENT_NAMES, ForceFrame
from rigapp.gui.data.ranges import nice_step
from rigapp.gui.plots.palette import Theme, line_pen, measured_pen, model_pen
from rigapp.gui.plots.plotting import QuietPlot
from rigapp.gui.widgets.build import column, named

CIRCLE = np.linspace(0.0, 2.0 * np.pi, 91)
POINTS = 720


class PolarPanel(QWidget):
    """Draw both components against each other with circles of equal force."""

    def __init__(self, prefix: str, theme: Theme) -> None:
        super().__init__()
        self._drawn: RevolutionCurves | None = None
        self._radius = 0.0
        named(self, f"{prefix}_polar_panel", "Force vector over one revolution")
        self.plot = QuietPlot(f"{prefix}_polar_plot", "Force vector, polar", theme)
        self.plot.setAspectLocked(True)
        self._circles = [self.plot.curve(line_pen(theme.grid)) for _ in range(2)]
        self.plot.guide(0.0, horizontal=True, theme=theme)
        self.plot.guide(0.0, horizontal=False, theme=theme)
        self._measured = self.plot.curve(measured_pen(theme, "main"))
        self._model = self.plot.curve(model_pen(theme, width=2.0))
        column(self.plot, on=self)

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self.plot.dress(theme)
        for circle in self._circles:
            circle.setPen(line_pen(theme.grid))
        self._measured.setPen(measured_pen(theme, "main"))
        self._model.setPen(model_pen(theme, width=2.0))

    def refresh(self, shown: RevolutionCurves | None, frame: ForceFrame) -> None:
        """Draw the revolution that the overlay shows."""
        if shown is self._drawn:
            return
        self._drawn = shown
        if shown is None:
            self._measured.setData([], [])
            self._model.setData([], [])
            return
        first, second = COMPONENT_NAMES[frame]
        self.plot.label("bottom", f"Force {first} (N)")
        self.plot.label("left", f"Force {second} (N)")
        step = max(1, len(shown.angle_deg) // POINTS)
        self._measured.setData(*(shown.measured[name][::step] for name in COMPONENTS))
        if shown.model is not None:
            self._model.setData(*(shown.model[name] for name in COMPONENTS))
        else:
            self._model.setData([], [])
        self._place_circles(float(shown.measured[SIZE].max()))

    def _place_circles(self, largest: float) -> None:
        step = nice_step(largest, 2)
        radius = step * np.ceil(largest / step)
        if radius == self._radius:
            return
        self._radius = radius
        for circle, part in zip(self._circles, (0.5, 1.0), strict=True):
            circle.setData(part * radius * np.cos(CIRCLE), part * radius * np.sin(CIRCLE))
        bound = 1.05 * radius
        self.plot.setRange(xRange=(-bound, bound), yRange=(-bound, bound), padding=0.0)
