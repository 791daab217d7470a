"""Set a document on pages with reportlab, without a time stamp, so that the bytes repeat."""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape

from reportlab import rl_config
from reportlab.lib import colors
from reportlab.lib.pagesizes import A4
from reportlab.lib.styles import ParagraphStyle
from reportlab.lib.units import mm
from reportlab.lib.utils import ImageReader
from reportlab.pdfbase import pdfmetrics
from reportlab.pdfbase.ttfonts import TTFont
from reportlab.pdfgen.canvas import Canvas
from reportlab.platypus import (
    CondPageBreak,
    Flowable,
    Image,
    KeepTogether,
    Paragraph,
    Preformatted,
    SimpleDocTemplate,
    Spacer,
)
from reportlab.platypus import Table as Grid

from rigapp.report.page.manuscript import (
    Block,
    Figure,
    Listing,
    Manuscript,
    Table,
    Text,
    numeric_columns,
)

PLAIN, BOLD, FIXED = "DejaVuSans", "DejaVuSans-Bold", "DejaVuSansMono"
WIDTH = 174 * mm
CELL_SIZE = 7.0
CELL_PADDING = 8.0
NAME_WIDTH = 55 * mm
LISTING_COLUMNS = 112
HEADING_ROOM = 45 * mm
ORANGE = colors.HexColor("#D55E00")
MARK_SIZE = 9.0
KEPT_ROWS = 14
"""A table of so few rows is kept on one page with its title."""

LINE = [
    ("TOPPADDING", (0, 0), (-1, -1), 1.2),
    ("BOTTOMPADDING", (0, 0), (-1, -1), 1.8),
    ("LEFTPADDING", (0, 0), (-1, -1), 0),
    ("RIGHTPADDING", (0, 0), (-1, -1), CELL_PADDING),
    ("LINEBELOW", (0, 0), (-1, -1), 0.25, colors.grey),
    ("VALIGN", (0, 0), (-1, -1), "TOP"),
]


def set_pages(document: Manuscript) -> bytes:
    """Return the PDF; two passes, since every page names the number of pages."""
    _prepare()
    pages = _build(document, 0)[1]
    return _build(document, pages)[0]


as_pdf = set_pages


@cache
def _prepare() -> None:
    """Take fonts that know more than Western European letters; matplotlib brings them."""
    import matplotlib

    rl_config.useA85 = 0  # binary streams: its encoding as text is slow and a quarter larger

    folder = Path(matplotlib.get_data_path()) / "fonts" / "ttf"
    for name in (PLAIN, BOLD, FIXED):
        pdfmetrics.registerFont(TTFont(name, str(folder / f"{name}.ttf")))
    pdfmetrics.registerFontFamily(PLAIN, normal=PLAIN, bold=BOLD, italic=PLAIN, boldItalic=BOLD)


def _build(document: Manuscript, pages: int) -> tuple[bytes, int]:
    """Set the pages; without their number only to count them, with room for the pictures."""
    stream = io.BytesIO()
    template = SimpleDocTemplate(
        stream,
        pagesize=A4,
        invariant=1,
        title=document.footer,
        author="",
        lang="en",
        leftMargin=18 * mm,
        rightMargin=18 * mm,
        topMargin=16 * mm,
        bottomMargin=18 * mm,
    )
    footer = _footer(document, pages)
    template.build(_story(document, draft=pages == 0), onFirstPage=footer, onLaterPages=footer)
    return stream.getvalue(), template.page


def _footer(document: Manuscript, pages: int) -> Callable[[Canvas, Any], None]:
    number_width = 40 * mm
    text = _shortened(document.footer, PLAIN, 7.5, WIDTH - number_width)
    mark = _shortened(document.mark, BOLD, MARK_SIZE, WIDTH)

    def draw(canvas: Canvas, template: Any) -> None:
        if mark:
            canvas.setFont(BOLD, MARK_SIZE)
            canvas.setFillColor(ORANGE)
            canvas.drawCentredString(105 * mm, 286 * mm, mark)
            canvas.setFillColor(colors.black)
        canvas.setFont(PLAIN, 7.5)
        canvas.drawString(18 * mm, 10 * mm, text)
        canvas.drawRightString(192 * mm, 10 * mm, f"page {template.page} of {pages}")

    return draw


def _shortened(text: str, font: str, size: float, width: float) -> str:
    shown = text
    while len(shown) > 1 and pdfmetrics.stringWidth(shown, font, size) > width:
        shown = shown[:-2].rstrip() + "…"
    return shown


def _style(name: str, size: float, bold: bool = False, **more: Any) -> ParagraphStyle:
    font = BOLD if bold else PLAIN
    more = {"leading": size * 1.32, **more}
    return ParagraphStyle(name, fontName=font, fontSize=size, splitLongWords=1, **more)


BODY = _style("body", 8.5, spaceAfter=3)
STRONG = _style(
    "strong", 8.5, bold=True, spaceAfter=7, leftIndent=8, borderPadding=(2, 2, 3, 6),
    borderColor=ORANGE, borderWidth=0.8, spaceBefore=6,
)  # fmt: skip
CELL = _style("cell", CELL_SIZE)
NUMBER = _style("number", CELL_SIZE, alignment=2)
HEAD = _style("head", CELL_SIZE, bold=True)
HEAD_NUMBER = _style("head number", CELL_SIZE, bold=True, alignment=2)
SMALL = _style("small", 7.0, textColor=colors.HexColor("#444444"))
TITLE = _style("title", 15, bold=True, spaceAfter=8)
HEADING = _style("heading", 11, bold=True, spaceBefore=11, spaceAfter=4)
CAPTION = _style("caption", 8.5, bold=True, spaceBefore=6, spaceAfter=2)
FIXED_STYLE = ParagraphStyle("fixed", fontName=FIXED, fontSize=6.5, leading=8.2)


class _Heading(Paragraph):  # type: ignore[misc, unused-ignore]
    """A heading that also stands in the outline of the PDF."""

    def draw(self) -> None:
        """Draw the heading and mark its place."""
        key = self.getPlainText()
        self.canv.bookmarkPage(key)
        self.canv.addOutlineEntry(key, key, 0)
        super().draw()


def _story(document: Manuscript, draft: bool) -> list[Flowable]:
    story: list[Flowable] = [Paragraph(escape(document.title), TITLE)]
    for section in document.sections:
        heading = [_Heading(escape(section.title), HEADING)] if section.title else []
        for place, block in enumerate(section.blocks):
            story += _flowables(block, heading if place == 0 else [], draft)
    if document.signatures:
        story.append(_signatures(document.signatures))
    if document.closing:
        story += [Spacer(0, 4 * mm), Paragraph(escape(document.closing), SMALL)]
    return story


def _flowables(block: Block, heading: list[Flowable], draft: bool) -> list[Flowable]:
    """Set a block below its heading, which is never left alone at the foot of a page."""
    if isinstance(block, Figure):
        return [KeepTogether([*heading, *_figure(block, draft)])]
    if isinstance(block, Text):
        paragraph = Paragraph(escape(block.text), STRONG if block.strong else BODY)
        return [CondPageBreak(HEADING_ROOM), *heading, paragraph] if heading else [paragraph]
    title = [Paragraph(escape(block.title), CAPTION)] if block.title else []
    if isinstance(block, Listing):
        text = block.text.expandtabs(4) or " "
        listing = Preformatted(text, FIXED_STYLE, maxLineLength=LISTING_COLUMNS, newLineChars="  ")
        return [CondPageBreak(HEADING_ROOM), *heading, *title, listing]
    parts = [*heading, *title, _grid(block), Spacer(0, 2 * mm)]
    if len(block.rows) <= KEPT_ROWS:
        return [KeepTogether(parts)]
    return [CondPageBreak(HEADING_ROOM), *parts]


def _figure(figure: Figure, draft: bool) -> list[Flowable]:
    width, height = ImageReader(io.BytesIO(figure.image)).getSize()
    caption = f"<b>{escape(figure.title)}.</b> {escape(figure.caption)}"
    drawn = WIDTH, WIDTH * height / width
    return [
        Spacer(0, 3 * mm),
        Spacer(*drawn) if draft else Image(io.BytesIO(figure.image), *drawn),
        Paragraph(caption, SMALL),
        Spacer(0, 2 * mm),
    ]


def _grid(table: Table) -> Grid:
    if not table.header:
        rows = [
            [Paragraph(escape(name), SMALL), *(Paragraph(_cell(one), CELL) for one in values)]
            for name, *values in table.rows
        ]
        columns = max((len(row) for row in table.rows), default=2) - 1
        widths = [NAME_WIDTH, *[(WIDTH - NAME_WIDTH) / columns] * columns]
        return Grid(rows, colWidths=widths, style=LINE, hAlign="LEFT", splitInRow=1)
    numbers = numeric_columns(table)

    def cells(values: Sequence[str], text: ParagraphStyle, number: ParagraphStyle) -> list[Any]:
        return [
            Paragraph(_cell(value), number if place in numbers else text)
            for place, value in enumerate(values)
        ]

    rows = [cells(table.header, HEAD, HEAD_NUMBER)]
    rows += [cells(row, CELL, NUMBER) for row in table.rows]
    widths = _widths(table)
    return Grid(rows, colWidths=widths, style=LINE, repeatRows=1, hAlign="LEFT", splitInRow=1)


def _cell(text: str) -> str:
    return escape(text).replace("\n", "<br/>")


def _widths(table: Table) -> list[float]:
    """Share the page's width: narrow columns get what they need, wide ones share the rest."""
    wanted = [
        min(WIDTH, max(_needed(name, BOLD), *(_needed(row[i], PLAIN) for row in table.rows)))
        if table.rows
        else _needed(name, BOLD)
        for i, name in enumerate(table.header)
    ]
    least = [
        max(_longest_word(name, BOLD), *(_longest_word(row[i], PLAIN) for row in table.rows))
        if table.rows
        else 0.0
        for i, name in enumerate(table.header)
    ]
    if sum(wanted) <= WIDTH:
        return wanted
    least = [min(one, WIDTH / len(wanted)) for one in least]
    open_places, rest = set(range(len(wanted))), WIDTH
    widths = [0.0] * len(wanted)
    while open_places:
        share = rest / len(open_places)
        fitting = {i for i in open_places if max(wanted[i], 0.0) <= share}
        if not fitting:
            for i in open_places:
                widths[i] = share
            break
        for i in fitting:
            widths[i] = wanted[i]
            rest -= wanted[i]
        open_places -= fitting
    return _with_words_whole(widths, least)


def _with_words_whole(widths: list[float], least: list[float]) -> list[float]:
    """Widen columns that would break words, at the cost of the widest."""
    found = list(widths)
    for i, width in enumerate(widths):
        missing = least[i] - width
        if missing <= 0:
            continue
        widest = max(range(len(found)), key=lambda k: found[k] - least[k])
        given = min(missing, max(0.0, found[widest] - least[widest]))
        found[i] += given
        found[widest] -= given
    return found


def _needed(text: str, font: str) -> float:
    lines = text.split("\n")
    width = max(float(pdfmetrics.stringWidth(one, font, CELL_SIZE)) for one in lines)
    return width + CELL_PADDING + 1


def _longest_word(text: str, font: str) -> float:
    return max((_needed(word, font) for word in text.split(" ")), default=0.0)


def _signatures(names: Sequence[str]) -> KeepTogether:
    grid = Grid(
        [[part for name in names for part in (Paragraph(escape(name), CELL), "")][:-1]],
        colWidths=[part for _ in names for part in (70 * mm, 20 * mm)][:-1],
        hAlign="LEFT",
    )
    grid.setStyle(
        [("LINEABOVE", (2 * i, 0), (2 * i, 0), 0.5, colors.black) for i in range(len(names))]
    )
    return KeepTogether([Spacer(0, 18 * mm), grid])
