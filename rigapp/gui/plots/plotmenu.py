"""The menu of a plot: copy or save its picture, save the data of its curves."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Final

from PySide6.QtCore import QMarginsF, QPoint, QRectF, Qt
from PySide6.QtGui import QGuiApplication, QImage, QPageSize, QPaintDevice, QPainter, QPdfWriter
from PySide6.QtSvg import QSvgGenerator
from PySide6.QtWidgets import QFileDialog, QMenu, QWidget

from rigapp.config.errors import UnusableInput
from rigapp.config.writing import harmless, whole_file
from rigapp.gui.plots.plotting import QuietPlot
from rigapp.presentation.translation import Text, tr
from rigapp.schema.details import error_text

PICTURES: Final = (".png", ".svg", ".pdf")
PIXELS_EACH: Final = 3
"""Pixels of a PNG for each pixel of the screen: 300 per printed inch."""
COPY: Final[Text] = "Copy picture"
SAVE_PICTURE: Final[Text] = "Save picture…"
SAVE_DATA: Final[Text] = "Save data…"
MM_PER_INCH: Final = 25.4

Write = Callable[[QuietPlot, Path], None]


def offer_menus(page: QWidget, say: Callable[[str, bool], None]) -> None:
    """Attach a menu to every plot on a page, opened by mouse or menu key.

    say: shows the result, and whether it is a success.
    """
    for plot in page.findChildren(QuietPlot):
        plot.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        plot.customContextMenuRequested.connect(partial(open_menu, plot))
        plot.reported.connect(say)


def open_menu(plot: QuietPlot, at: QPoint) -> None:
    """Show the menu of a plot at a position in it."""
    menu = QMenu(plot)
    menu.setObjectName("plot_menu")
    for text, call in (
        (COPY, partial(copy_picture, plot)),
        (SAVE_PICTURE, partial(_choose, plot, SAVE_PICTURE, save_picture, PICTURES)),
        (SAVE_DATA, partial(_choose, plot, SAVE_DATA, save_data, (".csv",))),
    ):
        menu.addAction(tr(text)).triggered.connect(lambda _=False, call=call: call())
    placed = bool(plot.cursors.places)
    cursors = menu.addAction(tr("Remove the cursors") if placed else tr("Two cursors"))
    cursors.setEnabled(not plot.instead)
    cursors.triggered.connect(lambda _=False: plot.show_cursors(both=not placed))
    back = menu.addAction(tr("Show all again"))
    back.setEnabled(plot.zoomed)
    back.triggered.connect(lambda _=False: plot.zoom_back())
    menu.aboutToHide.connect(menu.deleteLater)
    menu.popup(plot.mapToGlobal(at))


def copy_picture(plot: QuietPlot) -> None:
    """Copy the picture of a plot to the clipboard."""
    QGuiApplication.clipboard().setPixmap(plot.grab())


def save_picture(plot: QuietPlot, path: Path) -> None:
    """Write the picture of a plot in the format of the suffix; raises UnusableInput on failure."""
    with whole_file(path) as part:
        ending = path.suffix.lower()
        if ending == ".png":
            _painted(plot, part)
        elif ending == ".pdf":
            writer = QPdfWriter(str(part))
            millimetres = QRectF(plot.rect()).size() * (MM_PER_INCH / plot.logicalDpiX())
            writer.setPageSize(QPageSize(millimetres, QPageSize.Unit.Millimeter))
            writer.setPageMargins(QMarginsF())
            _render(plot, writer, QRectF(0, 0, writer.width(), writer.height()))
        else:
            generator = QSvgGenerator()
            generator.setFileName(str(part))
            generator.setSize(plot.size())
            generator.setViewBox(plot.rect())
            generator.setTitle(plot.accessibleName())
            _render(plot, generator, QRectF(plot.rect()))


def _painted(plot: QuietPlot, path: Path) -> None:
    image = QImage(plot.size() * PIXELS_EACH, QImage.Format.Format_RGB32)
    image.setDevicePixelRatio(PIXELS_EACH)
    image.fill(plot.theme.base)
    _render(plot, image, QRectF(plot.rect()))
    if not image.save(str(path), "PNG"):  # type: ignore[call-overload]
        raise OSError(f"{path}: the picture cannot be written; check folder and space.")


def _render(plot: QuietPlot, device: QPaintDevice, target: QRectF) -> None:
    painter = QPainter(device)
    try:
        plot.render(painter, target, plot.viewport().rect())
    finally:
        painter.end()


def save_data(plot: QuietPlot, path: Path) -> None:
    """Write the curves of a plot as CSV, one row for each point: curve, x, value."""
    with whole_file(path) as part, part.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(data_rows(plot))


def data_rows(plot: QuietPlot) -> Iterator[tuple[str, ...]]:
    """Yield the rows of a table of all points of the drawn curves; the header first."""
    yield tr("Curve"), *plot.captions()
    for name, trace in plot.curves():
        for x, y in zip(trace.x.tolist(), trace.y.tolist(), strict=True):
            yield harmless(name), f"{x:.9g}", "" if math.isnan(y) else f"{y:.9g}"


def _choose(plot: QuietPlot, title: Text, write: Write, endings: tuple[str, ...]) -> None:
    """Show a dialog for a file name, not modal, so that Stop can be pressed."""
    kinds = ";;".join(f"{ending[1:].upper()} (*{ending})" for ending in endings)
    dialog = QFileDialog(plot.window(), tr(title), f"{plot.objectName()}{endings[0]}", kinds)
    dialog.setObjectName("plot_file")
    dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
    dialog.setDefaultSuffix(endings[0][1:])
    dialog.fileSelected.connect(partial(_write, plot, write))
    dialog.finished.connect(dialog.deleteLater)
    dialog.setModal(False)
    dialog.show()


def _write(plot: QuietPlot, write: Write, path: str) -> None:
    try:
        write(plot, Path(path))
    except (UnusableInput, OSError) as error:
        plot.reported.emit(error_text(error, "The file cannot be written."), False)
    else:
        plot.reported.emit(tr("Saved: {}", path), True)
