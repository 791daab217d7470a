"""A document as plain values, as JSON holds them: texts and tables, and of a picture its words."""

from __future__ import annotations

from typing import Any

from rigapp.report.page.manuscript import Block, Figure, Listing, Manuscript, Table, Text


def plain(document: Manuscript) -> dict[str, Any]:
    """Return title, sections and blocks of a document; cells stay the words that are printed."""
    sections = [
        {"title": section.title, "blocks": [_block(one) for one in section.blocks]}
        for section in document.sections
    ]
    return {
        "title": document.title,
        "mark": document.mark,
        "sections": sections,
        "closing": document.closing,
    }


def _block(block: Block) -> dict[str, Any]:
    match block:
        case Text():
            return {"kind": "text", "text": block.text, "strong": block.strong}
        case Table():
            return {
                "kind": "table",
                "title": block.title,
                "header": block.header,
                "rows": block.rows,
            }
        case Figure():
            return {
                "kind": "figure",
                "title": block.title,
                "words": block.words,
                "caption": block.caption,
            }
        case Listing():
            return {"kind": "listing", "title": block.title, "text": block.text}
