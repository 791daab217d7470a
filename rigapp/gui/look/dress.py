"""Dress the application in a theme: style, palette, font and the plots' defaults.

The style sheet is set by each part of the window on itself (``dress_part``), and its dialogs have
it from there. On the whole window it would hold up everything for a quarter of a second at each
change, on the application for up to half a second.
"""

from __future__ import annotations

import pyqtgraph as pg
from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QApplication, QWidget

from rigapp.gui.look.fonts import FAMILY, window_font
from rigapp.gui.look.sheet import style_sheet
from rigapp.presentation.tokens import Theme


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
        role.Button: theme.base,
        role.ButtonText: theme.text,
        role.BrightText: theme.critical,
        role.ToolTipBase: theme.base,
        role.ToolTipText: theme.text,
        role.Highlight: theme.highlight,
        role.HighlightedText: theme.highlighted_text,
        role.Link: theme.highlight,
        role.Light: theme.alternate,
        role.Midlight: theme.hairline,
        role.Mid: theme.strong,
        role.Dark: theme.border,
    }
    for key, colour in colours.items():
        palette.setColor(key, QColor(colour))
    disabled = QPalette.ColorGroup.Disabled
    for key in (role.WindowText, role.Text, role.ButtonText):
        palette.setColor(disabled, key, QColor(theme.muted))
    return palette


def apply_theme(application: QApplication, theme: Theme) -> None:
    """Dress the application and the plots made from now on.

    Style and font are set once: setting them again polishes every widget again.
    """
    if application.style().objectName() != "fusion":
        application.setStyle("Fusion")
    if application.font().family() != FAMILY:
        application.setFont(window_font())
    application.setPalette(qt_palette(theme))
    pg.setConfigOptions(
        antialias=False, useOpenGL=False, background=theme.base, foreground=theme.text
    )


def dress_part(part: QWidget, theme: Theme, own: str = "") -> None:
    """Give a part of the window, and all that is on it, the style sheet of a theme.

    own: rules of this part alone, in the language of style sheets.
    """
    sheet = style_sheet(theme) + own
    if part.styleSheet() != sheet:
        part.setStyleSheet(sheet)
