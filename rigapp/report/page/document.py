"""Parts of a document, and conversion of the document to HTML and plain values."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from rigapp.presentation.translation import language, tr

Row = tuple[str, ...]

PNG = b"\x89PNG\r\n"
JPEG = b"\xff\xd8\xff"


@dataclass(frozen=True, slots=True)
class Text:
    """A paragraph; ``strong`` for important ones."""

    text: str
    strong: bool = False


@dataclass(frozen=True, slots=True)
class Table:
    """A table; without a header its first column has the names of the values beside it."""

    title: str
    rows: tuple[Row, ...]
    header: Row = ()


@dataclass(frozen=True, slots=True)
class Figure:
    """A drawing, with a text alternative.

    draw: returns it as "svg", "pdf" or "png" with reproducible bytes, in its own width or a given
    one in mm. "svg with text" has letters instead of their outlines: the reader needs the font.
    """

    title: str
    draw: Callable[..., bytes]
    words: str
    caption: str = ""


@dataclass(frozen=True, slots=True)
class Listing:
    """A text shown unchanged, line by line."""

    title: str
    text: str


Block = Text | Table | Figure | Listing


@dataclass(frozen=True, slots=True)
class Section:
    """A section of a document; without a title its blocks follow the document's heading."""

    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True, slots=True)
class Cover:
    """The first page of a document: results, their subject and customer.

    letterhead: lines of the laboratory, the first one strong. logo: PNG or JPEG, empty without one.
    facts: names and values. results: name, value and a remark. warnings: important remarks. note:
    small print below the results. figures: of the whole test, the first one in the width of the
    page, the second beside the texts, each of them with a bold heading.
    """

    subtitle: str
    facts: tuple[Row, ...]
    results: tuple[Row, ...]
    letterhead: tuple[str, ...] = ()
    logo: bytes = b""
    warnings: tuple[str, ...] = ()
    note: str = ""
    figures: tuple[Figure, ...] = ()
    texts: tuple[Row, ...] = ()


@dataclass(frozen=True, slots=True)
class Manuscript:
    """A document. footer: of every page. closing: small print at the end.

    mark: on every page, such as that of a draft. statement: beside the footer. made_at: date of the
    document, seconds since 1970; 0: none.
    """

    title: str
    footer: str
    sections: tuple[Section, ...]
    closing: str = ""
    signatures: tuple[str, ...] = ("Operator, date", "Reviewer, date")
    mark: str = ""
    cover: Cover | None = None
    statement: str = ""
    made_at: float = 0.0

    def figures(self) -> list[Figure]:
        """Return all figures, in the order of their numbers."""
        first = list(self.cover.figures) if self.cover is not None else []
        blocks = [block for section in self.sections for block in section.blocks]
        return first + [block for block in blocks if isinstance(block, Figure)]

    def labels(self) -> dict[int, str]:
        """Return "Figure 1", "Table 1" and so on, by the identity of each; tables with a title."""
        result = {id(figure): tr("Figure {}", n) for n, figure in enumerate(self.figures(), 1)}
        blocks = [block for section in self.sections for block in section.blocks]
        tables = [block for block in blocks if isinstance(block, Table) and block.title]
        return result | {id(table): tr("Table {}", n) for n, table in enumerate(tables, 1)}


def is_number(text: str) -> bool:
    """Return whether a cell holds a number, optionally with unit and thin spaces, or a dash."""
    bare = text.replace("\u202f", "").strip()
    if bare in ("", "–", tr("unknown"), tr("none")):
        return True
    try:
        float(bare.partition(" ")[0].rstrip("*%°"))
    except ValueError:
        return False
    return True


def numeric_columns(table: Table) -> frozenset[int]:
    """Return the indices of the purely numeric columns of a table with a header."""
    if not table.header or not table.rows:
        return frozenset()
    return frozenset(
        index
        for index in range(len(table.header))
        if all(is_number(row[index]) for row in table.rows)
        and any(row[index] not in ("", "–") for row in table.rows)
    )


def as_html(document: Manuscript) -> bytes:
    """Return the document as one HTML file with its pictures inside."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader("rigapp.report.page", "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    template = environment.get_template("document.html")
    labels = document.labels()
    return template.render(
        document=document,
        kind_of=_kind,
        data_of=_data,
        logo=_logo(document),
        numeric=numeric_columns,
        language=language(),
        result_word=tr("Result"),
        page_words=tr("page {} of {}").split("{}"),
        label_of=lambda block: labels.get(id(block), ""),
    ).encode(errors="replace")


def _logo(document: Manuscript) -> str:
    logo = document.cover.logo if document.cover is not None else b""
    kind = "png" if logo.startswith(PNG) else "jpeg"
    return f"data:image/{kind};base64,{b64encode(logo).decode()}" if logo else ""


def _kind(block: Block) -> str:
    return type(block).__name__.lower()


def _data(figure: Figure) -> str:
    return f"data:image/svg+xml;base64,{b64encode(figure.draw('svg')).decode()}"


def plain(document: Manuscript) -> dict[str, Any]:
    """Return title, sections and blocks of a document as plain values; cells as printed."""
    sections = [
        {"title": section.title, "blocks": [_plain_block(block) for block in section.blocks]}
        for section in document.sections
    ]
    cover = document.cover
    return {
        "title": document.title,
        "facts": {row[0]: row[1] for row in cover.facts} if cover is not None else {},
        "results": [
            dict(zip(_RESULT, row, strict=True)) for row in (cover.results if cover else ())
        ],
        "mark": document.mark,
        "sections": sections,
        "closing": document.closing,
    }


_RESULT = ("name", "value", "remark")
_FIELDS = {
    Text: ("text", "strong"),
    Table: ("title", "header", "rows"),
    Figure: ("title", "words", "caption"),
    Listing: ("title", "text"),
}


def _plain_block(block: Block) -> dict[str, Any]:
    return {"kind": _kind(block), **{name: getattr(block, name) for name in _FIELDS[type(block)]}}
