"""Check at start that the GUI library counts references correctly.

Some builds of PySide6 drop a reference to ``None`` at every paint call; the process then aborts
without a Python exception after some hundred repaints. Such a build must not run a test.
"""

from __future__ import annotations

import platform
import sys
from collections.abc import Callable

import PySide6
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import (
    QBrush,
    QColor,
    QFont,
    QGuiApplication,
    QImage,
    QPainter,
    QPainterPath,
    QPen,
    QTransform,
)
from PySide6.QtWidgets import QApplication, QGraphicsRectItem

CALLS = 1000  # some milliseconds of painting
ALLOWED = 50  # other threads change the count of None slightly; a fault changes it by CALLS

BAD_VERSIONS = {
    "6.9.1": "cannot be used with pyqtgraph",
    "6.9.2": "crashes on Python 3.12 and 3.13",
}


def run_self_test() -> list[str]:
    """Return the problems found, one sentence each; an empty list is a pass.

    Takes some milliseconds. Creates an application object when there is none.
    """
    problems = []
    version = PySide6.__version__
    if version in BAD_VERSIONS:
        problems.append(
            f"PySide6 {version} {BAD_VERSIONS[version]}; install PySide6-Essentials 6.11.3."
        )
    if QGuiApplication.instance() is None:
        _keep.append(QApplication(sys.argv[:1]))
    for name, drift in reference_drifts().items():
        if abs(drift) > ALLOWED:
            problems.append(
                f"PySide6 {version} on Python {platform.python_version()} miscounts references:"
                f" {CALLS} calls of {name} change the count of None by {drift}; the window would"
                " abort. Install PySide6-Essentials 6.11.3."
            )
    return problems


_keep: list[QApplication] = []


def reference_drifts(count: Callable[[], int] | None = None) -> dict[str, int]:
    """Return the change of the reference count of None by 1000 calls of each common paint call."""
    counted = count or (lambda: sys.getrefcount(None))
    image = QImage(64, 64, QImage.Format.Format_ARGB32_Premultiplied)
    image.fill(QColor("white"))
    painter = QPainter(image)
    try:
        return {name: _drift(call, counted) for name, call in _calls(painter).items()}
    finally:
        painter.end()


def _drift(call: Callable[[], object], count: Callable[[], int]) -> int:
    call()
    before = count()
    for _ in range(CALLS):
        call()
    return count() - before


def _calls(painter: QPainter) -> dict[str, Callable[[], object]]:
    pen, brush, font = QPen(QColor("black")), QBrush(QColor("grey")), QFont()
    line, rectangle = QLineF(0.0, 0.0, 60.0, 60.0), QRectF(4.0, 4.0, 20.0, 20.0)
    path = QPainterPath()
    path.addEllipse(rectangle)
    item = QGraphicsRectItem(rectangle)
    transform = QTransform()

    def save_and_restore() -> None:
        painter.save()
        painter.restore()

    return {
        "setPen(QPen)": lambda: painter.setPen(pen),
        "setPen(QColor)": lambda: painter.setPen(QColor("black")),
        "setPen(PenStyle)": lambda: painter.setPen(Qt.PenStyle.SolidLine),
        "setBrush": lambda: painter.setBrush(brush),
        "setFont": lambda: painter.setFont(font),
        "drawLine": lambda: painter.drawLine(line),
        "drawText": lambda: painter.drawText(QPointF(2.0, 20.0), "0"),
        "drawRect": lambda: painter.drawRect(rectangle),
        "drawPath": lambda: painter.drawPath(path),
        "setTransform": lambda: painter.setTransform(transform),
        "setClipRect": lambda: painter.setClipRect(rectangle),
        "save and restore": save_and_restore,
        "item update": lambda: item.update(),
    }


def main() -> int:
    """Print the problems; exit status 1 where there are any."""
    problems = run_self_test()
    print("; ".join(problems))
    return bool(problems)


if __name__ == "__main__":
    sys.exit(main())
