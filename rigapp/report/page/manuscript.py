"""What a certificate or a report says, before it is set as a page: sections of plain blocks."""

from __future__ import annotations

from dataclasses import dataclass

Row = tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Text:
    """A paragraph; ``strong`` for what must not be overlooked."""

    text: str
    strong: bool = False


@dataclass(frozen=True, slots=True)
class Table:
    """A table; without a header its first column names what stands beside it."""

    title: str
    rows: tuple[Row, ...]
    header: Row = ()


@dataclass(frozen=True, slots=True)
class Figure:
    """A picture as PNG or SVG bytes, with the words for who cannot see it."""

    title: str
    image: bytes
    words: str
    mime: str = "image/png"
    caption: str = ""


@dataclass(frozen=True, slots=True)
class Listing:
    """A text shown as it is, line by line."""

    title: str
    text: str


Block = Text | Table | Figure | Listing


@dataclass(frozen=True, slots=True)
class Section:
    """A part of a document; without a title its blocks follow the heading of the document."""

    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True, slots=True)
class Manuscript:
    """A whole document. footer: at the foot of every page. closing: small print at the end.

    mark: what must be read on every page, as that it is a draft.
    """

    title: str
    footer: str
    sections: tuple[Section, ...]
    closing: str = ""
    signatures: tuple[str, ...] = ("Operator, date", "Reviewer, date")
    mark: str = ""


def is_number(text: str) -> bool:
    """Tell whether a cell holds a number, perhaps with a unit or thin spaces, or its absence."""
    bare = text.replace("\u202f", "").strip()
    if bare in ("", "–", "unknown", "none"):
        return True
    try:
        float(bare.partition(" ")[0].rstrip("*%°"))
    except ValueError:
        return False
    return True


def numeric_columns(table: Table) -> frozenset[int]:
    """Return the places of the columns of a table with a header that hold numbers only."""
    if not table.header or not table.rows:
        return frozenset()
    return frozenset(
        place
        for place in range(len(table.header))
        if all(is_number(row[place]) for row in table.rows)
        and any(row[place] not in ("", "–") for row in table.rows)
    )
