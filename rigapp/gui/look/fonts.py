"""The font of the window: Inter, with tabular figures, so that a changing number does not move.

The package has Inter as a variable font, of which a style sheet can select only the normal weight
(Qt 6.11). The semi-bold weight is therefore a file beside this module (OFL 1.1), made by
``fonttools varLib.instancer "Inter[opsz,wght].ttf" wght=600 opsz=14`` and ``fonttools subset``.
"""

from __future__ import annotations

from pathlib import Path

import fontpkg
from PySide6.QtGui import QFont, QFontDatabase

from rigapp.presentation.tokens import BODY_PT

FAMILY = "Inter"
SEMI_BOLD = Path(__file__).with_name("Inter-SemiBold.ttf")


def window_font() -> QFont:
    """Return the font of the window in its usual size; the desktop's own where Inter is missing."""
    font = QFont()
    if FAMILY in QFontDatabase.families() or _loaded():
        font.setFamily(FAMILY)
    font.setPointSizeF(BODY_PT)
    return tabular(font)


def tabular(font: QFont) -> QFont:
    """Return a font with tabular figures."""
    copy = QFont(font)
    copy.setFeature(QFont.Tag("tnum"), 1)
    return copy


def sized(font: QFont, points: float, weight: QFont.Weight = QFont.Weight.Normal) -> QFont:
    """Return a font in one of the sizes of ``tokens``."""
    copy = tabular(font)
    copy.setPointSizeF(points)
    copy.setWeight(weight)
    copy.setVariableAxis(QFont.Tag("wght"), float(weight.value))
    return copy


def _loaded() -> bool:
    files = (fontpkg.path(FAMILY), SEMI_BOLD)
    return all(QFontDatabase.addApplicationFont(str(file)) >= 0 for file in files)
