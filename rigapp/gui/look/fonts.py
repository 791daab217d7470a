"""The font of the window: Inter, with figures of one width, so that a changing number stands.

The package has Inter as one file of all weights, of which a style sheet reaches none but the usual
one (Qt 6.11). Its semi-bold therefore stands here as a file of its own (OFL 1.1), made by
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
    """Return the font of the window in its usual size; the desktop's own where Inter fails."""
    font = QFont()
    if FAMILY in QFontDatabase.families() or _loaded():
        font.setFamily(FAMILY)
    font.setPointSizeF(BODY_PT)
    return tabular(font)


def tabular(font: QFont) -> QFont:
    """Return a font whose figures are all of one width."""
    made = QFont(font)
    made.setFeature(QFont.Tag("tnum"), 1)
    return made


def sized(font: QFont, points: float, weight: QFont.Weight = QFont.Weight.Normal) -> QFont:
    """Return a font in one of the sizes of ``tokens``."""
    made = tabular(font)
    made.setPointSizeF(points)
    made.setWeight(weight)
    made.setVariableAxis(QFont.Tag("wght"), float(weight.value))
    return made


def _loaded() -> bool:
    files = (fontpkg.path(FAMILY), SEMI_BOLD)
    return all(QFontDatabase.addApplicationFont(str(one)) >= 0 for one in files)
