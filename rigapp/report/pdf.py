"""Set a certificate on pages with reportlab, without a time stamp, so that the bytes repeat."""

from __future__ import annotations

import io
from collections.abc import Callable
from typing import Any
from xml.sax.saxutils import escape

from reportlab.lib import colors
from reportlab.lib.pagesizes import A4
from reportlab.lib.styles import ParagraphStyle, getSampleStyleSheet
from reportlab.lib.units import mm
from reportlab.pdfgen.canvas import Canvas
from reportlab.platypus import Image, Paragraph, SimpleDocTemplate, Spacer
from reportlab.platypus import Table as Grid

from rigapp.report.certificate import Certificate, Table

LINE = [
    ("FONTSIZE", (0, 0), (-1, -1), 7.5),
    ("LEADING", (0, 0), (-1, -1), 9.5),
    ("TOPPADDING", (0, 0), (-1, -1), 1),
    ("BOTTOMPADDING", (0, 0), (-1, -1), 1),
    ("LINEBELOW", (0, 0), (-1, -1), 0.25, colors.grey),
    ("VALIGN", (0, 0), (-1, -1), "TOP"),
]


def set_pages(certificate: Certificate) -> bytes:
    """Return the PDF; two passes, since every page names the number of pages."""
    pages = _build(certificate, 0)[1]
    return _build(certificate, pages)[0]


def _build(certificate: Certificate, pages: int) -> tuple[bytes, int]:
    stream = io.BytesIO()
    document = SimpleDocTemplate(
        stream,
        pagesize=A4,
        invariant=1,
        title=f"{certificate.title} {certificate.number}",
        author="",
        leftMargin=18 * mm,
        rightMargin=18 * mm,
        topMargin=16 * mm,
        bottomMargin=18 * mm,
    )
    footer = _footer(certificate, pages)
    document.build(_story(certificate), onFirstPage=footer, onLaterPages=footer)
    return stream.getvalue(), document.page


def _footer(certificate: Certificate, pages: int) -> Callable[[Canvas, Any], None]:
    def draw(canvas: Canvas, document: Any) -> None:
        canvas.setFont("Helvetica", 8)
        canvas.drawString(18 * mm, 10 * mm, f"Certificate {certificate.number}")
        canvas.drawRightString(192 * mm, 10 * mm, f"page {document.page} of {pages}")

    return draw


def _story(certificate: Certificate) -> list[Any]:
    styles = getSampleStyleSheet()
    body = ParagraphStyle("body", parent=styles["BodyText"], fontSize=9, leading=12)
    story: list[Any] = [Paragraph(escape(certificate.title), styles["Title"])]
    story += [Paragraph(escape(text), body) for text in certificate.paragraphs]
    for table in certificate.tables:
        story += [Paragraph(escape(table.title), styles["Heading3"]), _grid(table, body)]
    for figure in certificate.figures:
        story += [Spacer(0, 4 * mm), Image(io.BytesIO(figure.png), 165 * mm, 71.5 * mm)]
    signs = Grid([["Operator, date", "", "Reviewer, date"]], colWidths=[70 * mm, 30 * mm, 70 * mm])
    signs.setStyle(
        [("LINEABOVE", (0, 0), (0, 0), 0.5, colors.black),
         ("LINEABOVE", (2, 0), (2, 0), 0.5, colors.black),
         ("FONTSIZE", (0, 0), (-1, -1), 8)]
    )  # fmt: skip
    return [
        *story,
        Spacer(0, 18 * mm),
        signs,
        Spacer(0, 4 * mm),
        Paragraph(escape(certificate.digest_note), body),
    ]


def _grid(table: Table, body: ParagraphStyle) -> Grid:
    small = ParagraphStyle("small", parent=body, fontSize=7.5, leading=9.5)
    if not table.header:
        rows = [[name, Paragraph(escape(value), small)] for name, value in table.rows]
        return Grid(rows, colWidths=[55 * mm, 115 * mm], style=LINE, hAlign="LEFT")
    rows = [list(table.header), *(list(row) for row in table.rows)]
    return Grid(rows, style=LINE, repeatRows=1, hAlign="LEFT", spaceAfter=2 * mm)
