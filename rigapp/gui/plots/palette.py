"""Colours of the window: a calm grey screen, and colours that eyes without one cone tell apart.

Data and alarms after Okabe and Ito, shifted where a simulation of such eyes confuses two of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPalette, QPen
from PySide6.QtWidgets import QApplication


@dataclass(frozen=True, slots=True)
class Theme:
    """Name every colour that the window uses; ``curves`` maps the role of a line to its colour."""

    name: str
    window: str
    base: str
    alternate: str
    text: str
    muted: str
    button: str
    border: str
    highlight: str
    highlighted_text: str
    grid: str
    band: str
    warning: str
    critical: str
    on_signal: str
    on_critical: str
    curves: Mapping[str, str]

    def mark(self, *, critical: bool) -> tuple[str, str]:
        """Return background and ink of what is not normal."""
        return (self.critical, self.on_critical) if critical else (self.warning, self.on_signal)


LIGHT = Theme(
    name="light",
    window="#e6e6e6",
    base="#ffffff",
    alternate="#f2f2f2",
    text="#1a1a1a",
    muted="#555555",
    button="#dcdcdc",
    border="#8c8c8c",
    highlight="#0072b2",
    highlighted_text="#ffffff",
    grid="#c8c8c8",
    band="#dde3e8",
    warning="#e69f00",
    critical="#a84300",
    on_signal="#000000",
    on_critical="#ffffff",
    curves=MappingProxyType(
        {
            "first": "#0072b2",
            "main": "#000000",
            "second": "#2ca25f",
            "model": "#d55e00",
            "frozen": "#767676",
            "other": "#a8497b",
        }
    ),
)

DARK = Theme(
    name="dark",
    window="#2b2b2b",
    base="#1c1c1c",
    alternate="#242424",
    text="#ececec",
    muted="#b0b0b0",
    button="#3a3a3a",
    border="#777777",
    highlight="#56b4e9",
    highlighted_text="#000000",
    grid="#444444",
    band="#2c3338",
    warning="#e69f00",
    critical="#ff6b4a",
    on_signal="#000000",
    on_critical="#000000",
    curves=MappingProxyType(
        {
            "first": "#3f9be0",
            "main": "#ffffff",
            "second": "#7fe0b0",
            "model": "#f0a050",
            "frozen": "#8c8c8c",
            "other": "#cc79a7",
        }
    ),
)

THEMES = {theme.name: theme for theme in (LIGHT, DARK)}


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


def qt_palette(theme: Theme) -> QPalette:
    """Return the palette of the Fusion style for a theme, every role set by hand."""
    palette = QPalette()
    role = QPalette.ColorRole
    colours = {
        role.Window: theme.window,
        role.WindowText: theme.text,
        role.Base: theme.base,
        role.AlternateBase: theme.alternate,
        role.Text: theme.text,
        role.PlaceholderText: theme.muted,
        role.Button: theme.button,
        role.ButtonText: theme.text,
        role.BrightText: theme.critical,
        role.ToolTipBase: theme.base,
        role.ToolTipText: theme.text,
        role.Highlight: theme.highlight,
        role.HighlightedText: theme.highlighted_text,
        role.Link: theme.highlight,
        role.Light: theme.alternate,
        role.Midlight: theme.button,
        role.Mid: theme.border,
        role.Dark: theme.border,
    }
    for key, colour in colours.items():
        palette.setColor(key, QColor(colour))
    disabled = QPalette.ColorGroup.Disabled
    for key in (role.WindowText, role.Text, role.ButtonText):
        palette.setColor(disabled, key, QColor(theme.border))
    return palette


def apply_theme(application: QApplication, theme: Theme) -> None:
    """Dress the application and the plots made from now on.

    The style is set once: setting it again polishes every widget again, for half a second.
    """
    if application.style().objectName() != "fusion":
        application.setStyle("Fusion")
    application.setPalette(qt_palette(theme))
    pg.setConfigOptions(
        antialias=False, useOpenGL=False, background=theme.base, foreground=theme.text
    )
