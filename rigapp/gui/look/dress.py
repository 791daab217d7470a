"""Apply a theme to the application: style, palette, font and the plots' defaults.

Each part of the window sets the style sheet on itself (``dress_part``), and its dialogs inherit it.
Setting it on the whole window would block for a quarter of a second at each change, on the
application for up to half a second.
"""

from __future__ import annotations

from functools import cache
from string import Template

import pyqtgraph as pg
from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QApplication, QWidget

from rigapp.gui.look.fonts import FAMILY, window_font
from rigapp.presentation.tokens import CAPTION_PT, CARD_RADIUS, RADIUS, VALUE_PT, Theme

# The style sheet selects widgets by properties: ``rank`` of a button (primary, ordinary, dangerous,
# quiet), ``role`` of a frame or label (card, caption, value).

_SHEET = Template(
    """
QToolTip { background: $base; color: $text; border: 1px solid $strong; padding: 4px; }

QPushButton {
    background: $base; color: $text; border: 1px solid $border; border-radius: ${radius}px;
    padding: 0 12px; min-height: 28px;
}
QPushButton:hover { background: $alternate; }
QPushButton:pressed, QPushButton:checked {
    background: $tint; border-color: $highlight; color: $highlight; font-weight: 600;
}
QPushButton:focus { border: 2px solid $highlight; padding: 0 11px; }
QPushButton:disabled { color: $muted; border-color: $hairline; background: $alternate; }
QPushButton[rank="primary"] {
    background: $highlight; color: $highlighted_text; border-color: $highlight; font-weight: 600;
}
QPushButton[rank="primary"]:focus { border: 2px solid $text; }
QPushButton[rank="primary"]:disabled {
    background: $alternate; color: $muted; border-color: $hairline;
}
QPushButton[rank="dangerous"] {
    border: 2px solid $critical; color: $critical; font-weight: 600; padding: 0 11px;
}
QPushButton[rank="dangerous"]:pressed { background: $critical; color: $on_critical; }
QPushButton[rank="dangerous"]:focus { border: 3px solid $critical; padding: 0 10px; }
QPushButton[rank="dangerous"]:disabled { color: $muted; border-color: $hairline; }
QPushButton[large="true"] { min-height: 46px; font-size: ${value}pt; }
QPushButton[rank="quiet"] { border: 0; background: transparent; padding: 0 8px; }
QPushButton[rank="quiet"]:hover { background: $tint; }
QPushButton[rank="quiet"]:focus { border: 2px solid $highlight; padding: 0 6px; }

QLineEdit, QPlainTextEdit, QTextEdit {
    background: $base; color: $text; border: 1px solid $border; border-radius: ${radius}px;
    padding: 0 8px; min-height: 28px; selection-background-color: $highlight;
    selection-color: $highlighted_text;
}
QLineEdit:focus, QPlainTextEdit:focus, QTextEdit:focus { border: 2px solid $highlight; }
QLineEdit:disabled { background: $alternate; color: $muted; border-color: $hairline; }
QLineEdit[wrong="true"] { border: 2px solid $critical; padding: 0 7px; }

QComboBox, QAbstractSpinBox {
    background: $base; color: $text; border: 1px solid $border; border-radius: ${radius}px;
    padding: 0 7px; min-height: 28px; selection-background-color: $highlight;
    selection-color: $highlighted_text;
}
QComboBox:focus, QAbstractSpinBox:focus { border: 2px solid $highlight; padding: 0 6px; }
QAbstractSpinBox { min-height: 25px; padding: 0; }
QAbstractSpinBox:focus { padding: 0; }
QComboBox:disabled, QAbstractSpinBox:disabled {
    background: $alternate; color: $muted; border-color: $hairline;
}
QComboBox::drop-down { border: 0; width: 20px; }
QAbstractSpinBox::up-button, QAbstractSpinBox::down-button { border: 0; width: 18px; }
QComboBox::down-arrow, QAbstractSpinBox::down-arrow, QAbstractSpinBox::up-arrow {
    width: 0; height: 0; border-left: 4px solid $clear; border-right: 4px solid $clear;
}
QComboBox::down-arrow, QAbstractSpinBox::down-arrow { border-top: 5px solid $secondary; }
QAbstractSpinBox::up-arrow { border-bottom: 5px solid $secondary; }

QTableView {
    background: $base; alternate-background-color: $alternate; border: 1px solid $hairline;
    border-radius: ${card}px; gridline-color: $hairline; selection-background-color: $tint;
    selection-color: $text; padding: 1px;
}
QTableView:focus { border: 2px solid $highlight; padding: 0; }
QHeaderView { background: $alternate; }
QHeaderView::section {
    background: $alternate; color: $secondary; border: 0; border-bottom: 1px solid $hairline;
    padding: 6px 8px; font-size: ${caption}pt;
}
QTableCornerButton::section { background: $alternate; border: 0; }

QGroupBox {
    background: $base; border: 1px solid $hairline; border-radius: ${card}px; margin-top: 0;
    padding-top: 28px;
}
QGroupBox::title {
    subcontrol-origin: border; subcontrol-position: top left; left: 12px; top: 8px;
    color: $text; font-weight: 600;
}
QProgressBar { background: $track; border: 0; border-radius: 3px; }
QProgressBar::chunk { background: $bar; border-radius: 3px; }
QSplitter::handle { background: transparent; }
QSplitter::handle:hover { background: $strong; }
QScrollBar:vertical { background: transparent; width: 12px; margin: 0; }
QScrollBar:horizontal { background: transparent; height: 12px; margin: 0; }
QScrollBar::handle { background: $strong; border-radius: 4px; margin: 2px; min-height: 24px; }
QScrollBar::handle:hover { background: $border; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }

QWidget[role="card"] {
    background: $base; border: 1px solid $hairline; border-radius: ${card}px;
}
QWidget[role="draft"] {
    background: $alternate; border: 1px dashed $border; border-radius: ${card}px;
}
QWidget[role="attention"] {
    background: $warning_tint; border: 1px solid $warning; border-radius: ${card}px;
}
QWidget[role="critical"] {
    background: $critical_tint; border: 2px solid $critical; border-radius: ${card}px;
}
QFrame[chosen="true"] { border: 3px solid $highlight; }
QLabel[chip] { border-radius: 4px; padding: 1px 8px; font-weight: 600; }
QLabel[chip="critical"] { background: $critical; color: $on_critical; }
QLabel[chip="attention"] { background: $warning; color: $on_signal; }
QLabel[chip="calm"] { background: $track; color: $text; }
QPushButton[rank="step"] {
    border: 0; border-radius: 0; background: transparent; padding: 0; min-height: 54px;
}
QPushButton[rank="step"]:hover { background: $alternate; }
QPushButton[rank="step"]:checked { background: $tint; border-bottom: 2px solid $highlight; }
QPushButton[rank="step"]:focus { border: 2px solid $highlight; }
QLabel[mark] {
    border-radius: 12px; font-weight: 600; min-width: 22px; max-width: 22px; min-height: 22px;
    max-height: 22px; border: 1px solid $border; color: $muted;
}
QLabel[mark="done"] { background: $secondary; border-color: $secondary; color: $base; }
QLabel[mark="now"] {
    background: $highlight; border-color: $highlight; color: $highlighted_text;
}
QLabel[mark="wrong"] { background: $critical; border-color: $critical; color: $on_critical; }
QCheckBox { border: 2px solid transparent; border-radius: 4px; padding: 2px; }
QCheckBox:focus { border-color: $highlight; }
QLabel[role="error"] { color: $critical; font-size: ${caption}pt; font-weight: 600; }
QLabel[role="caution"] { color: $warning_text; font-size: ${caption}pt; }
QLabel[role="title"] { font-weight: 600; }
QLabel[role="caption"] { color: $muted; font-size: ${caption}pt; }
QLabel[role="secondary"] { color: $secondary; }
"""
)


OUTLINE_DARKER = 140
"""Percent by which Fusion darkens check-box outlines, which would vanish in a dark theme."""


@cache
def style_sheet(theme: Theme) -> str:
    """Return the style sheet of a theme."""
    colours = {
        name: getattr(theme, name) for name in Theme.__dataclass_fields__ if name != "curves"
    }
    return _SHEET.substitute(
        colours,
        clear="#00ffffff",
        radius=RADIUS,
        card=CARD_RADIUS,
        caption=CAPTION_PT,
        value=VALUE_PT,
    )


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
    """Apply a theme to the application and to plots made later.

    Style and font are set only once, since each setting polishes every widget.
    """
    if application.style().objectName() != "fusion":
        application.setStyle("Fusion")
    if application.font().family() != FAMILY:
        application.setFont(window_font())
    application.setPalette(qt_palette(theme))
    boxes = qt_palette(theme)
    boxes.setColor(QPalette.ColorRole.Window, QColor(theme.border).lighter(OUTLINE_DARKER))
    application.setPalette(boxes, "QCheckBox")  # type: ignore[arg-type]  # the stubs say bytes
    pg.setConfigOptions(
        antialias=False, useOpenGL=False, background=theme.base, foreground=theme.text
    )


def dress_part(part: QWidget, theme: Theme, own: str = "") -> None:
    """Set the style sheet of a theme on a part of the window and its children.

    own: additional rules of this part alone.
    """
    sheet = style_sheet(theme) + own
    if part.styleSheet() != sheet:
        part.setStyleSheet(sheet)
