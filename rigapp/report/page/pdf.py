"""Lay out a document on pages with reportlab; pypdf inserts the figures as lines and text.

Nothing comes from the clock or the machine, so that the bytes repeat.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping, Sequence
from datetime import UTC, datetime
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
    PageBreak,
    Paragraph,
    Preformatted,
    SimpleDocTemplate,
    Spacer,
)
from reportlab.platypus import Table as Grid

from rigapp.presentation.translation import language, tr
from rigapp.report.page.document import (
    Block,
    Cover,
    Figure,
    Listing,
    Manuscript,
    Row,
    Table,
    Text,
    numeric_columns,
)

PLAIN, BOLD, FIXED = "DejaVuSans", "DejaVuSans-Bold", "DejaVuSansMono"
MARGIN = 16 * mm
FRAME_PADDING = 6.0  # of reportlab, on each side of what is set
WIDTH = 178 * mm
CELL_SIZE = 8.0
CELL_PADDING = 8.0
NAME_WIDTH = 55 * mm
LISTING_COLUMNS = 100
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


def as_pdf(document: Manuscript) -> bytes:
    """Return the PDF; two passes, since every page names the number of pages."""
    _prepare()
    drawings = {id(figure): _Drawing(figure.draw("pdf")) for figure in document.figures()}
    pages = _build(document, 0, drawings)[1]
    data = _build(document, pages, drawings)[0]
    return _finished(data, list(drawings.values()), document.made_at)


@cache
def _prepare() -> None:
    """Register fonts with more than Western European letters, those of matplotlib."""
    import matplotlib

    rl_config.useA85 = 0  # binary streams: its encoding as text is slow and a quarter larger

    folder = Path(matplotlib.get_data_path()) / "fonts" / "ttf"
    for name in (PLAIN, BOLD, FIXED):
        pdfmetrics.registerFont(TTFont(name, str(folder / f"{name}.ttf")))
    pdfmetrics.registerFontFamily(PLAIN, normal=PLAIN, bold=BOLD, italic=PLAIN, boldItalic=BOLD)


class _Drawing(Flowable):  # type: ignore[misc, unused-ignore]
    """The place of a figure, as wide as the page; the figure itself is inserted at the end.

    data: a PDF of one page. at: page, and the place of the lower left corner on it.
    """

    def __init__(self, data: bytes) -> None:
        from pypdf import PdfReader

        super().__init__()
        self.page = PdfReader(io.BytesIO(data)).pages[0]
        self.scale = min(1.0, WIDTH / float(self.page.mediabox.width))
        self.width = self.scale * float(self.page.mediabox.width)
        self.height = self.scale * float(self.page.mediabox.height)
        self.at = (0, 0.0, 0.0)

    def draw(self) -> None:
        """Note where the figure belongs."""
        self.at = (self.canv.getPageNumber() - 1, *self.canv.absolutePosition(0, 0))


def _finished(data: bytes, drawings: Sequence[_Drawing], made_at: float) -> bytes:
    """Return a PDF with its date, and each figure in its place as a form drawn on the page."""
    from pypdf import PdfReader, PdfWriter
    from pypdf.generic import (
        ArrayObject,
        BooleanObject,
        DictionaryObject,
        NameObject,
        StreamObject,
    )

    writer = PdfWriter(clone_from=PdfReader(io.BytesIO(data)))
    for number, drawing in enumerate(drawings, 1):
        page_index, left, bottom = drawing.at
        page, name = writer.pages[page_index], NameObject(f"/Figure{number}")
        form = StreamObject()
        contents = drawing.page.get_contents()
        form.set_data(contents.get_data() if contents is not None else b"")
        form[NameObject("/Type")] = NameObject("/XObject")
        form[NameObject("/Subtype")] = NameObject("/Form")
        form[NameObject("/BBox")] = ArrayObject(drawing.page.mediabox)
        resources = drawing.page["/Resources"].get_object()
        assert isinstance(resources, DictionaryObject)
        form[NameObject("/Resources")] = resources.clone(writer)
        own = page["/Resources"].get_object()
        assert isinstance(own, DictionaryObject)
        forms = own.setdefault(NameObject("/XObject"), DictionaryObject()).get_object()
        forms[name] = writer._add_object(form.flate_encode())
        put = (
            f"q {drawing.scale:.6f} 0 0 {drawing.scale:.6f} {left:.3f} {bottom:.3f} cm {name} Do Q"
        )
        before = page.get_contents()
        stream = StreamObject()
        stream.set_data((before.get_data() if before is not None else b"") + b"\n" + put.encode())
        page[NameObject("/Contents")] = writer._add_object(stream.flate_encode())
    facts = {"/Producer": "rigapp"}
    if made_at > 0.0:
        date = f"D:{datetime.fromtimestamp(made_at, UTC):%Y%m%d%H%M%S}Z"
        facts |= {"/CreationDate": date, "/ModDate": date}
    writer.add_metadata(facts)
    # A reader, and a screen reader, begin with the title in place of the file's name.
    preferences = DictionaryObject({NameObject("/DisplayDocTitle"): BooleanObject(True)})
    writer.root_object[NameObject("/ViewerPreferences")] = preferences
    stream_out = io.BytesIO()
    writer.write(stream_out)
    return stream_out.getvalue()


def _build(document: Manuscript, pages: int, drawings: Mapping[int, _Drawing]) -> tuple[bytes, int]:
    """Set the pages; without their number only to count them."""
    stream = io.BytesIO()
    template = SimpleDocTemplate(
        stream,
        pagesize=A4,
        invariant=1,
        title=document.footer,
        author="",
        lang=language(),
        leftMargin=MARGIN - FRAME_PADDING,
        rightMargin=MARGIN - FRAME_PADDING,
        topMargin=16 * mm,
        bottomMargin=18 * mm,
    )
    footer = _footer(document, pages)
    template.build(_story(document, drawings), onFirstPage=footer, onLaterPages=footer)
    return stream.getvalue(), template.page


def _footer(document: Manuscript, pages: int) -> Callable[[Canvas, Any], None]:
    number_width = 40 * mm
    text = _shortened(document.footer, PLAIN, 8.0, WIDTH - number_width)
    mark = _shortened(document.mark, BOLD, MARK_SIZE, WIDTH)

    def draw(canvas: Canvas, template: Any) -> None:
        if mark:
            canvas.setFont(BOLD, MARK_SIZE)
            canvas.setFillColor(ORANGE)
            canvas.drawCentredString(105 * mm, 286 * mm, mark)
            canvas.setFillColor(colors.black)
        canvas.setFont(PLAIN, 8.0)
        canvas.drawString(MARGIN, 10 * mm, text)
        canvas.drawRightString(MARGIN + WIDTH, 10 * mm, tr("page {} of {}", template.page, pages))

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
SMALL = _style("small", 8.0, textColor=colors.HexColor("#444444"))
TITLE = _style("title", 15, bold=True, spaceAfter=8)
HEADING = _style("heading", 11, bold=True, spaceBefore=11, spaceAfter=4)
CAPTION = _style("caption", 8.5, bold=True, spaceBefore=6, spaceAfter=2)
FIXED_STYLE = ParagraphStyle("fixed", fontName=FIXED, fontSize=8.0, leading=10.0)


COVER_TITLE = _style("cover title", 17, bold=True, spaceAfter=3)
SUBTITLE = _style("subtitle", 9.5, textColor=colors.HexColor("#4a535f"), spaceAfter=2)
HEAD_RIGHT = _style("laboratory", 9.5, bold=True, alignment=2)
LINE_RIGHT = _style("address", 8.5, alignment=2, textColor=colors.HexColor("#4a535f"))
RESULT_STYLES = (
    _style("result name", 10.5, textColor=colors.HexColor("#4a535f")),
    _style("result value", 10.5, bold=True),
    _style("result remark", 8.0, textColor=colors.HexColor("#4a535f")),
)
FACTS_BESIDE = 4
RULE = colors.HexColor("#c3c9d1")
BARE = [
    ("LEFTPADDING", (0, 0), (-1, -1), 0),
    ("RIGHTPADDING", (0, 0), (-1, -1), CELL_PADDING),
    ("VALIGN", (0, 0), (-1, -1), "TOP"),
]
LETTERHEAD = [*BARE, ("LINEBELOW", (0, 0), (-1, -1), 1.0, colors.black),
              ("RIGHTPADDING", (0, 0), (-1, -1), 0)]  # fmt: skip
FACTS_LINE = [
    *BARE,
    ("LINEABOVE", (0, 0), (-1, -1), 0.4, RULE),
    ("TOPPADDING", (0, 0), (-1, -1), 2),
]
RESULT_LINE = [
    *BARE,
    ("LINEBELOW", (0, 0), (-1, -1), 0.4, RULE),
    ("VALIGN", (0, 0), (-1, -1), "MIDDLE"),
    ("TOPPADDING", (0, 0), (-1, -1), 4),
    ("BOTTOMPADDING", (0, 0), (-1, -1), 5),
]


class _Heading(Paragraph):  # type: ignore[misc, unused-ignore]
    """A heading that is also in the outline of the PDF."""

    def draw(self) -> None:
        """Draw the heading and mark its place."""
        key = self.getPlainText()
        self.canv.bookmarkPage(key)
        self.canv.addOutlineEntry(key, key, 0)
        super().draw()


def _story(document: Manuscript, drawings: Mapping[int, _Drawing]) -> list[Flowable]:
    labels = document.labels()
    story: list[Flowable] = []
    if document.cover is not None:
        story += _cover(document, document.cover, drawings, labels)
    else:
        story.append(Paragraph(escape(document.title), TITLE))
    for section in document.sections:
        heading = [_Heading(escape(section.title), HEADING)] if section.title else []
        for index, block in enumerate(section.blocks):
            story += _flowables(block, heading if index == 0 else [], drawings, labels)
    if document.statement:
        story += [Spacer(0, 4 * mm), Paragraph(escape(document.statement), BODY)]
    if document.signatures:
        story.append(_signatures(document.signatures))
    if document.closing:
        story += [Spacer(0, 4 * mm), Paragraph(escape(document.closing), SMALL)]
    return story


def _cover(
    document: Manuscript,
    cover: Cover,
    drawings: Mapping[int, _Drawing],
    labels: Mapping[int, str],
) -> list[Flowable]:
    """Set the first page; the sections begin on the next one."""
    story: list[Flowable] = []
    if cover.letterhead or cover.logo:
        story += [_letterhead(cover), Spacer(0, 7 * mm)]
    story.append(Paragraph(escape(document.title), COVER_TITLE))
    story.append(Paragraph(escape(cover.subtitle), SUBTITLE))
    story += [Paragraph(escape(warning), STRONG) for warning in cover.warnings]
    story += [Spacer(0, 3 * mm), _facts(cover.facts), _Heading(tr("Result"), HEADING)]
    rows = [
        [Paragraph(_cell(text), style) for text, style in zip(row, RESULT_STYLES, strict=True)]
        for row in cover.results
    ]
    widths = [42 * mm, 62 * mm, WIDTH - 104 * mm]
    story += [Grid(rows, colWidths=widths, style=RESULT_LINE), Spacer(0, 1 * mm)]
    story += [Paragraph(escape(cover.note), SMALL), Spacer(0, 3 * mm)]
    paragraphs = [
        Paragraph(f"<b>{escape(lead)}</b> {escape(text)}", BODY) for lead, text in cover.texts
    ]
    for index, figure in enumerate(cover.figures):
        parts = _figure(figure, drawings[id(figure)], labels[id(figure)])
        if index == 0 and len(cover.figures) > 1:
            story.append(KeepTogether(parts))
        else:
            story.append(Grid([[parts, paragraphs]], colWidths=[WIDTH / 2, WIDTH / 2], style=BARE))
            paragraphs = []
    return [*story, *paragraphs, PageBreak()]


def _letterhead(cover: Cover) -> Grid:
    logo: list[Any] = []
    if cover.logo:
        wide, high = ImageReader(io.BytesIO(cover.logo)).getSize()
        scale = min(60 * mm / wide, 18 * mm / high)
        logo = [Image(io.BytesIO(cover.logo), scale * wide, scale * high, hAlign="LEFT")]
    styles = [HEAD_RIGHT, *[LINE_RIGHT] * len(cover.letterhead)]
    lines = [
        Paragraph(escape(line), style)
        for line, style in zip(cover.letterhead, styles, strict=False)
    ]
    return Grid([[logo, lines]], colWidths=[WIDTH / 2, WIDTH / 2], style=LETTERHEAD)


def _facts(facts: Sequence[Row]) -> Grid:
    """Set facts in columns, each below its name."""
    cells = [
        [Paragraph(escape(name), SMALL), Paragraph(_cell(value), BODY)] for name, value in facts
    ]
    cells += [[]] * (-len(cells) % FACTS_BESIDE)
    rows = [cells[at : at + FACTS_BESIDE] for at in range(0, len(cells), FACTS_BESIDE)]
    return Grid(rows, colWidths=[WIDTH / FACTS_BESIDE] * FACTS_BESIDE, style=FACTS_LINE)


def _flowables(
    block: Block,
    heading: list[Flowable],
    drawings: Mapping[int, _Drawing],
    labels: Mapping[int, str],
) -> list[Flowable]:
    """Set a block below its heading, which is never left alone at the foot of a page."""
    if isinstance(block, Figure):
        return [KeepTogether([*heading, *_figure(block, drawings[id(block)], labels[id(block)])])]
    if isinstance(block, Text):
        paragraph = Paragraph(escape(block.text), STRONG if block.strong else BODY)
        return [CondPageBreak(HEADING_ROOM), *heading, paragraph] if heading else [paragraph]
    label = labels.get(id(block), "")
    named = f"{label}. {block.title}" if label else block.title
    title = [Paragraph(escape(named), CAPTION)] if named else []
    if isinstance(block, Listing):
        text = block.text.expandtabs(4) or " "
        listing = Preformatted(text, FIXED_STYLE, maxLineLength=LISTING_COLUMNS, newLineChars="  ")
        return [CondPageBreak(HEADING_ROOM), *heading, *title, listing]
    parts = [*heading, *title, _grid(block), Spacer(0, 2 * mm)]
    if len(block.rows) <= KEPT_ROWS:
        return [KeepTogether(parts)]
    return [CondPageBreak(HEADING_ROOM), *parts]


def _figure(figure: Figure, drawing: _Drawing, label: str) -> list[Flowable]:
    caption = f"<b>{label}. {escape(figure.title)}.</b> {escape(figure.caption)}"
    return [
        Spacer(0, 3 * mm),
        drawing,
        Paragraph(caption, SMALL),
        Spacer(0, 2 * mm),
    ]


def _grid(table: Table) -> Grid:
    if not table.header:
        rows = [
            [Paragraph(escape(name), SMALL), *(Paragraph(_cell(value), CELL) for value in values)]
            for name, *values in table.rows
        ]
        columns = max((len(row) for row in table.rows), default=2) - 1
        widths = [NAME_WIDTH, *[(WIDTH - NAME_WIDTH) / columns] * columns]
        return Grid(rows, colWidths=widths, style=LINE, hAlign="LEFT", splitInRow=1)
    numbers = numeric_columns(table)

    def cells(values: Sequence[str], text: ParagraphStyle, number: ParagraphStyle) -> list[Any]:
        return [
            Paragraph(_cell(value), number if index in numbers else text)
            for index, value in enumerate(values)
        ]

    rows = [cells(table.header, HEAD, HEAD_NUMBER)]
    rows += [cells(row, CELL, NUMBER) for row in table.rows]
    widths = _widths(table)
    return Grid(rows, colWidths=widths, style=LINE, repeatRows=1, hAlign="LEFT", splitInRow=1)


def _cell(text: str) -> str:
    return escape(text).replace("\n", "<br/>")


def _widths(table: Table) -> list[float]:
    """Share the page's width: narrow columns get what they need, wide ones share the rest."""
    columns = [
        [(name, BOLD), *((row[i], PLAIN) for row in table.rows)]
        for i, name in enumerate(table.header)
    ]
    wanted = [min(WIDTH, max(_needed(*cell) for cell in column)) for column in columns]
    if sum(wanted) <= WIDTH:
        return wanted
    # The narrowest first: each takes at most an equal share of what those before it have left.
    widths, rest = [0.0] * len(wanted), WIDTH
    for done, i in enumerate(sorted(range(len(wanted)), key=wanted.__getitem__)):
        widths[i] = min(wanted[i], rest / (len(wanted) - done))
        rest -= widths[i]
    even = WIDTH / len(wanted)
    least = [min(even, max(_longest_word(*cell) for cell in column)) for column in columns]
    return _with_words_whole(widths, least)


def _with_words_whole(widths: list[float], least: list[float]) -> list[float]:
    """Widen columns that would break words, at the cost of the widest."""
    result = list(widths)
    for i, width in enumerate(widths):
        missing = least[i] - width
        if missing <= 0:
            continue
        widest = max(range(len(result)), key=lambda k: result[k] - least[k])
        widening = min(missing, max(0.0, result[widest] - least[widest]))
        result[i] += widening
        result[widest] -= widening
    return result


def _needed(text: str, font: str) -> float:
    lines = text.split("\n")
    width = max(float(pdfmetrics.stringWidth(line, font, CELL_SIZE)) for line in lines)
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
