"""The probe wizard's residual plot over the position."""

from __future__ import annotations

import numpy as np
from PySide6.QtWidgets import QWidget

from rigapp.calibrating.live_probes import LiveProbeSession
from rigapp.gui.plots.palette import Theme
from rigapp.gui.wizard.parts import ScatterNames, residual_scatter

LEAST_UM = 1.0


class ProbeResidualPlot(QWidget):
    """Show how far each reading lies from the line of all readings so far, µm over position."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.plot, self._points, self.words = residual_scatter(
            self,
            theme,
            ScatterNames("probe_residual", "Residuals so far, micrometres", "µm", "Position (µm)"),
            ("probe_1", "probe_2"),
        )
        self.show_session(None)

    def show_session(self, session: LiveProbeSession | None) -> None:
        """Show what the lines of the readings so far leave."""
        found = session.preliminary() if session is not None else None
        reach = 1e6 * session.procedure.plan.reach if session is not None else 1000.0
        self.plot.setXRange(-1.1 * reach, 1.1 * reach, padding=0.0)
        if found is None:
            for item in self._points:
                item.setData([], [])
            self.plot.setYRange(-LEAST_UM, LEAST_UM, padding=0.0)
            self.words.setText("Residuals are shown from the third position on.")
            return
        position, residual, which = found
        um = 1e6 * residual
        for number, item in enumerate(self._points, 1):
            item.setData(1e6 * position[which == number], um[which == number])
        high = max(LEAST_UM, 1.2 * float(np.abs(um).max()))
        self.plot.setYRange(-high, high, padding=0.0)
        worst = int(np.abs(um).argmax())
        self.words.setText(
            f"Circle: probe 1, triangle: probe 2. Last {um[-1]:+.2f} µm; largest {um[worst]:+.2f}"
            f" µm at {1e6 * position[worst]:g} µm of probe {which[worst]}."
        )
