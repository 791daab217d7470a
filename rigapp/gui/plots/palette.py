"""The lines of plots: how each is drawn in any theme."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPen

from rigapp.gui.look.tokens import Theme


@dataclass(frozen=True, slots=True)
class LinePen:
    """How a line is drawn in any theme.

    colour: a role of ``Theme.curves``, a field of ``Theme``, or a colour itself (``#rrggbb``).
    A measured line is solid, one pixel, opaque (the fast path of the plots); width: more than one
    pixel only for curves of few points.
    """

    colour: str
    dashed: bool = False
    width: float = 1.0

    def of(self, theme: Theme) -> QPen:
        """Return the pen in a theme."""
        known = theme.curves.get(self.colour) or getattr(theme, self.colour, self.colour)
        pen = line_pen(str(known))
        if self.dashed:
            pen.setStyle(Qt.PenStyle.CustomDashLine)
            pen.setWidthF(self.width)
            pen.setDashPattern([6.0 / self.width + 2.0, 4.0 / self.width + 2.0])
        return pen


MODEL = LinePen("model", dashed=True)
"""A predicted line of many points."""

MODEL_CURVE = LinePen("model", dashed=True, width=2.0)
STALE_CURVE = LinePen("frozen", dashed=True, width=2.0)
"""A predicted curve, and one that is older than what it stands beside."""


def line_pen(colour: str, *, dotted: bool = False) -> QPen:
    """Return the pen of a line of one pixel."""
    pen = QPen(QColor(colour))
    pen.setWidthF(1.0)
    pen.setCosmetic(True)
    pen.setStyle(Qt.PenStyle.DotLine if dotted else Qt.PenStyle.SolidLine)
    return pen
