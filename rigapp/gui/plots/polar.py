"""The force vector over one revolution, drawn where it points."""

from __future__ import annotations

from typing import Final

import numpy as np

from rigapp.gui.data.channels import COMPONENTS, SIZE
from rigapp.gui.data.comparison import RevolutionCurves
from rigapp.gui.data.frames import COMPONENT_NAMES, ForceFrame
from rigapp.gui.data.ranges import nice_step
from rigapp.gui.look.tokens import Theme
from rigapp.gui.plots.curves import clear
from rigapp.gui.plots.palette import MODEL, LinePen
from rigapp.gui.plots.plotting import PlotPanel, QuietPlot, plot_heading
from rigapp.gui.widgets.build import column
from rigapp.presentation.translation import Text, tr

CIRCLE = np.linspace(0.0, 2.0 * np.pi, 91)
POINTS = 720
WAITING: Final[Text] = "No revolution measured yet: the force is drawn here where it points."


class PolarPanel(PlotPanel):
    """Draw both components against each other with circles of equal force."""

    def __init__(self, prefix: str, theme: Theme) -> None:
        super().__init__(f"{prefix}_polar_panel", "Force vector over one revolution")
        self._drawn: RevolutionCurves | None = None
        self._radius = 0.0
        self.plot = QuietPlot(f"{prefix}_polar_plot", "Force vector, polar", theme)
        self.plot.setAspectLocked(True)
        self._circles = [self.plot.curve(LinePen("grid")) for _ in range(2)]
        self.plot.empty(WAITING)
        self._measured = self.plot.curve(LinePen("main"))
        self._model = self.plot.curve(MODEL)
        column(plot_heading("Force vector"), (self.plot, 1), on=self)

    def refresh(self, shown: RevolutionCurves | None, frame: ForceFrame) -> None:
        """Draw the revolution that the overlay shows."""
        if shown is self._drawn:
            return
        self._drawn = shown
        if shown is None:
            clear(self._measured, self._model)
            self.plot.empty(WAITING)
            return
        self.plot.empty("")
        first, second = map(tr, COMPONENT_NAMES[frame])
        self.plot.label("bottom", tr("Force {} (N)", first))
        self.plot.label("left", tr("Force {} (N)", second))
        step = max(1, len(shown.angle_deg) // POINTS)
        self._measured.setData(*(shown.measured[name][::step] for name in COMPONENTS))
        if shown.model is not None:
            self._model.setData(*(shown.model[name] for name in COMPONENTS))
        else:
            clear(self._model)
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
