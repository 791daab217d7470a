"""Lay out a document on pages by Typst, as tagged PDF (PDF/UA-1, ISO 14289-1).

Nothing comes from the clock or the machine, so that the bytes repeat.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any, Final

import typst

from rigapp.presentation.translation import language, tr
from rigapp.report.page.document import (
    Block,
    Cover,
    Figure,
    Listing,
    Manuscript,
    Table,
    Text,
    numeric_columns,
)

PLAIN, BOLD = "DejaVuSans", "DejaVuSans-Bold"
MM: Final = 72.0 / 25.4
WIDTH: Final = 178.0 * MM
"""Between the margins, pt; the lengths of this module are in points."""
CELL_SIZE = 8.0
CELL_PADDING = 8.0
NAME_WIDTH = 55 * MM
FACT_WIDTH = WIDTH / 4
FOOTER_SIZE = 8.0
PAGE_NUMBER_WIDTH = 40 * MM
LISTING_COLUMNS = 100
KEPT_ROWS = 14
"""A table of so few rows is kept on one page with its title."""
BREAK_HERE = "\u200b"  # zero-width space
UNKNOWN = "\ufffd"
NEVER_SHOWN: Final = dict.fromkeys(
    (*range(9), 11, 12, *range(14, 32), *range(0x7F, 0xA0), *range(0xD800, 0xE000)), UNKNOWN
)
"""Control characters and halves of surrogate pairs: a note may have them, no font does."""


def as_pdf(document: Manuscript) -> bytes:
    """Return the document as PDF; its date is ``made_at``.

    Characters that the fonts lack are taken from the fonts of the computer, or replaced.
    """
    names = {id(one): f"figure-{n}.svg" for n, one in enumerate(document.figures(), 1)}
    content = _content(document, names)
    main = (files("rigapp.report.page") / "templates" / "document.typ").read_bytes()
    pictures = {names[id(one)]: one.draw("svg with text") for one in document.figures()}

    def compile_text(text: str, *, own_fonts_only: bool) -> bytes:
        result = typst.compile(  # type: ignore[call-overload]  # its stub lacks files by name
            {"main.typ": main, "document.json": text.encode(), **pictures},
            format="pdf",
            font_paths=[str(_font_folder())],
            ignore_system_fonts=own_fonts_only,
            pdf_standards=["ua-1"],
            timestamp=int(document.made_at),
        )
        assert isinstance(result, bytes)
        return result

    text = json.dumps(_replaced(content, NEVER_SHOWN), ensure_ascii=False)
    missing = [letter for letter in set(text) if ord(letter) not in _letters()]
    if not missing:
        return compile_text(text, own_fonts_only=True)
    try:
        return compile_text(text, own_fonts_only=False)
    except typst.TypstError:
        # PDF/UA-1 forbids a character without a glyph, and no font of this computer has it.
        known = text.translate(dict.fromkeys(map(ord, missing), UNKNOWN))
        return compile_text(known, own_fonts_only=True)


def _content(document: Manuscript, names: Mapping[int, str]) -> dict[str, Any]:
    """Return what the template reads, as plain values."""
    labels = document.labels()

    def drawing(figure: Figure) -> dict[str, Any]:
        return {
            "kind": "figure",
            "name": names[id(figure)],
            "label": labels[id(figure)],
            "title": figure.title,
            "words": figure.words,
            "caption": figure.caption,
        }

    def content_of(block: Block) -> dict[str, Any]:
        if isinstance(block, Figure):
            return drawing(block)
        if isinstance(block, Text):
            return {"kind": "text", "text": _broken(block.text, WIDTH), "strong": block.strong}
        if isinstance(block, Listing):
            return {"kind": "listing", "title": block.title, "text": _in_columns(block.text)}
        label = labels.get(id(block), "")
        return _table(block, f"{label}. {block.title}" if label else block.title)

    return {
        "title": document.title,
        "footer": document.footer,
        "footer-shown": _shortened(document.footer, WIDTH - PAGE_NUMBER_WIDTH),
        "page-words": tr("page {} of {}").split("{}"),
        "result-word": tr("Result"),
        "language": language(),
        "date": _date(document.made_at),
        "mark": document.mark,
        "cover": _cover(document.cover, drawing) if document.cover is not None else None,
        "sections": [
            {"title": section.title, "blocks": [content_of(block) for block in section.blocks]}
            for section in document.sections
        ],
        "statement": document.statement,
        "signatures": document.signatures,
        "closing": _broken(document.closing, WIDTH),
    }


def _replaced(value: Any, table: Mapping[int, str]) -> Any:
    """Return a plain value with letters of its texts replaced."""
    if isinstance(value, str):
        return value.translate(table)
    if isinstance(value, dict):
        return {name: _replaced(part, table) for name, part in value.items()}
    return [_replaced(part, table) for part in value] if isinstance(value, list | tuple) else value


def _date(seconds: float) -> dict[str, int] | None:
    """Return the parts of a date, UTC; None for 0."""
    if not seconds > 0.0:
        return None
    moment = datetime.fromtimestamp(seconds, UTC)
    return {
        part: getattr(moment, part) for part in ("year", "month", "day", "hour", "minute", "second")
    }


def _cover(cover: Cover, drawing: Any) -> dict[str, Any]:
    return {
        "subtitle": cover.subtitle,
        "warnings": cover.warnings,
        "letterhead": cover.letterhead,
        "logo": list(cover.logo),
        "logo-words": cover.letterhead[0] if cover.letterhead else "Logo",
        "facts": [[name, _broken(value, FACT_WIDTH)] for name, value in cover.facts],
        "results": cover.results,
        "note": cover.note,
        "texts": cover.texts,
        "figures": [drawing(figure) for figure in cover.figures],
    }


def _table(table: Table, title: str) -> dict[str, Any]:
    if table.header:
        widths = _widths(table)
    else:
        columns = max((len(row) for row in table.rows), default=2) - 1
        widths = [NAME_WIDTH, *[(WIDTH - NAME_WIDTH) / columns] * columns]

    def breakable(row: Sequence[str]) -> list[str]:
        cells = [
            _broken(value, width - CELL_PADDING) for value, width in zip(row, widths, strict=False)
        ]
        return cells + [""] * (len(widths) - len(cells))

    return {
        "kind": "table",
        "title": title,
        "header": breakable(table.header) if table.header else [],
        "rows": [breakable(row) for row in table.rows],
        "numbers": sorted(numeric_columns(table)),
        "widths": widths,
        "kept": len(table.rows) <= KEPT_ROWS,
    }


def _in_columns(text: str) -> str:
    """Return a listing whose long lines go on in further ones, indented."""
    lines: list[str] = []
    for line in text.expandtabs(4).splitlines() or [""]:
        lines.append(line[:LISTING_COLUMNS])
        step = LISTING_COLUMNS - 2
        lines += [f"  {line[at : at + step]}" for at in range(LISTING_COLUMNS, len(line), step)]
    return "\n".join(lines)


@cache
def _font_folder() -> Path:
    """Return the fonts of matplotlib: more than Western European letters, on every computer."""
    import matplotlib

    return Path(matplotlib.get_data_path()) / "fonts" / "ttf"


@cache
def _font(name: str) -> Any:
    from matplotlib.ft2font import FT2Font

    return FT2Font(str(_font_folder() / f"{name}.ttf"))


@cache
def _letters() -> frozenset[int]:
    return frozenset(_font(PLAIN).get_charmap())


@cache
def _advance(letter: str, font: str) -> float:
    """Return the width of a letter in units of the font's size."""
    from matplotlib.ft2font import LoadFlags

    glyph = _font(font).load_char(ord(letter), flags=LoadFlags.NO_SCALE)
    return float(glyph.horiAdvance / _font(font).units_per_EM)


def _width(text: str, font: str = PLAIN, size: float = CELL_SIZE) -> float:
    return size * sum(_advance(letter, font) for letter in text)


def _broken(text: str, width: float) -> str:
    """Return a text whose words may be broken anywhere where they are wider than a line."""
    if len(text) * 0.3 * CELL_SIZE < width:
        return text
    return "\n".join(
        " ".join(
            word if _width(word) <= width else BREAK_HERE.join(word) for word in line.split(" ")
        )
        for line in text.split("\n")
    )


def _shortened(text: str, width: float) -> str:
    shown = text
    while len(shown) > 1 and _width(shown, PLAIN, FOOTER_SIZE) > width:
        shown = shown[:-2].rstrip() + "…"
    return shown


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
    return max(_width(line, font) for line in text.split("\n")) + CELL_PADDING + 1


def _longest_word(text: str, font: str) -> float:
    return max((_needed(word, font) for word in text.split(" ")), default=0.0)
