"""A comparison with the paper, and the pages with all comparisons."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from rigapp.config.writing import whole_file
from rigapp.report.page.document import Block, Figure, Manuscript, Section, Table, Text, as_html
from rigapp.report.page.figures import in_style, saved
from rigapp.report.tables import write_table


@dataclass(frozen=True, slots=True)
class Chapter:
    """A comparison. name: stem of its files; columns: of the CSV table.

    draw: draws on matplotlib axes, ``panels`` of them; words: text alternative of the picture;
    table: a small one for the page, with its header first.
    """

    name: str
    title: str
    columns: Mapping[str, np.ndarray]
    sentences: Sequence[str]
    draw: Callable[[Sequence[Any]], None]
    words: str
    panels: int = 1
    table: Sequence[tuple[str, ...]] = field(default_factory=tuple)
    warning: str = ""


def largest_difference(a: np.ndarray, b: np.ndarray) -> float:
    """Return the largest difference of two curves relative to the first one's magnitude."""
    return float(np.abs(a - b).max() / max(np.abs(a).max(), 1e-300))


TITLE = "The paper's comparisons, computed again"
INTRODUCTION = (
    "Dynamic modeling of a slider-crank mechanism under joint wear: its Figs 6 to 10, 13, 15 and"
    " 21, its three techniques side by side and its Table 2 from the parameter files listed at the"
    " end, with where every value comes from; Figs 20 and 21 from a recorded test where one is"
    " given. Each picture has its numbers in the CSV table of the same name."
)
_ENTRY = re.compile(r"^(\w+)\s*=\s*(.+?)\s+#\s*(.+)$")


def write_chapter(folder: Path, chapter: Chapter) -> tuple[list[Path], Section]:
    """Write a chapter's table and picture; return their paths and its section of the page."""
    table = folder / f"{chapter.name}.csv"
    write_table("--to", table, chapter.columns)
    figure = picture(chapter)
    drawn = folder / f"{chapter.name}.png"
    save(drawn, figure.draw("png"))
    blocks: list[Block] = [Text(sentence) for sentence in chapter.sentences]
    if chapter.warning:
        blocks.append(Text(chapter.warning, strong=True))
    if chapter.table:
        header, *rows = chapter.table
        blocks.append(Table("", tuple(rows), header))
    blocks.append(figure)
    return [table, drawn], Section(chapter.title, tuple(blocks))


def size_in(panels: int) -> tuple[float, float]:
    """Return width and height of a picture with a number of panels, inches."""
    return 7.2, 1.0 + 1.9 * panels


def picture(chapter: Chapter) -> Figure:
    """Return the figure of a chapter."""
    from matplotlib.figure import Figure as Canvas

    with in_style():
        canvas = Canvas(figsize=size_in(chapter.panels), layout="constrained")
        axes = canvas.subplots(chapter.panels, 1, squeeze=False)[:, 0]
        chapter.draw(list(axes))
    return saved(canvas, chapter.title, chapter.words, f"Numbers: {chapter.name}.csv.")


def provenance(path: Path) -> Section:
    """Return a parameter file as a table: every value with its source."""
    table, rows = "", []
    first, *lines = path.read_text(encoding="utf-8").splitlines()
    for line in lines:
        if line.startswith("["):
            table = line.strip("[]")
        elif entry := _ENTRY.match(line):
            rows.append((f"{table}.{entry[1]}", entry[2], entry[3]))
    header = ("key", "value", "where from")
    blocks = (Text(first.lstrip("# ")), Table("", tuple(rows), header))
    return Section(f"Parameters: {path.name}", blocks)


def write_pages(folder: Path, sections: Sequence[Section]) -> list[Path]:
    """Write the page as HTML and as Markdown, with the same text."""
    document = Manuscript(
        title=TITLE,
        footer=TITLE,
        sections=(Section("", (Text(INTRODUCTION),)), *sections),
        signatures=(),
    )
    html, markdown = folder / "index.html", folder / "index.md"
    save(html, as_html(document))
    save(markdown, _as_markdown(document).encode())
    return [html, markdown]


def _as_markdown(document: Manuscript) -> str:
    """Return the document as Markdown; its pictures are the files beside it."""
    parts = [f"# {document.title}"]
    for section in document.sections:
        if section.title:
            parts.append(f"## {section.title}")
        parts += [_block(block) for block in section.blocks]
    return "\n\n".join(parts) + "\n"


def _block(block: Block) -> str:
    if isinstance(block, Text):
        return f"**{block.text}**" if block.strong else block.text
    if isinstance(block, Table):
        lines = [block.header, tuple("---" for _ in block.header), *block.rows]
        return "\n".join("| " + " | ".join(line) + " |" for line in lines)
    if isinstance(block, Figure):
        name = block.caption.removeprefix("Numbers: ").removesuffix(".csv.")
        return f"![{block.words}]({name}.png)\n\n{block.caption}"
    return block.text


def save(path: Path, content: bytes) -> None:
    """Write a file; raises UnusableInput on failure."""
    with whole_file(path, f"--to {path}") as part:
        part.write_bytes(content)
