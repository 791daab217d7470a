"""Pens of the lines of plots in any theme."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPen

from rigapp.presentation.tokens import Theme


@dataclass(frozen=True, slots=True)
class LinePen:
    """Style of a line in any theme.

    colour: a role of ``Theme.curves``, a field of ``Theme``, or a colour (``#rrggbb``). Every line
    is one pixel wide and opaque: wider ones take four times as long to paint.
    """

    colour: str
    dashed: bool = False

    def of(self, theme: Theme) -> QPen:
        """Return the pen in a theme."""
        pen = line_pen(self._colour(theme))
        if self.dashed:
            pen.setStyle(Qt.PenStyle.CustomDashLine)
            pen.setDashPattern(list(DASHES))
        return pen

    def ink(self, theme: Theme) -> QColor:
        """Return the colour of texts about the line in a theme."""
        return QColor(self._colour(theme))

    def _colour(self, theme: Theme) -> str:
        return str(theme.curves.get(self.colour) or getattr(theme, self.colour, self.colour))


MODEL = LinePen("model", dashed=True)
STALE_CURVE = LinePen("frozen", dashed=True)
"""Pen of a predicted line that is older than the measured lines."""

DASHES = (8.0, 4.0)
"""Dash and gap in pixels: long enough to be visible through the noise of a measured line."""


def line_pen(colour: str, *, dotted: bool = False) -> QPen:
    """Return the pen of a line of one pixel."""
    pen = QPen(QColor(colour))
    pen.setWidthF(1.0)
    pen.setCosmetic(True)
    pen.setStyle(Qt.PenStyle.DotLine if dotted else Qt.PenStyle.SolidLine)
    return pen
