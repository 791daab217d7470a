"""Read a report as a person or a screen reader does: its texts, tables and pictures."""

from __future__ import annotations

import base64
from dataclasses import dataclass, field
from html.parser import HTMLParser


@dataclass
class Page(HTMLParser):
    """Collect what an HTML report shows. tables: caption or heading -> rows of cell texts."""

    text: str = ""
    headings: list[str] = field(default_factory=list)
    tables: list[tuple[str, list[list[str]]]] = field(default_factory=list)
    images: list[dict[str, str]] = field(default_factory=list)
    links: list[str] = field(default_factory=list)
    header_cells: int = 0
    language: str = ""

    def __post_init__(self) -> None:
        super().__init__()
        self._open: list[str] = []

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        named = {name: value or "" for name, value in attributes}
        self.links += [named[one] for one in ("src", "href") if one in named]
        if tag == "html":
            self.language = named.get("lang", "")
        if tag == "img":
            self.images.append(named)
            return
        if tag in ("meta", "link"):
            return
        self._open.append(tag)
        if tag == "table":
            self.tables.append((self.headings[-1] if self.headings else "", []))
        elif tag == "tr":
            self.tables[-1][1].append([])
        elif tag in ("td", "th"):
            self.tables[-1][1][-1].append("")
            self.header_cells += named.get("scope") in ("col", "row")
        elif tag in ("h1", "h2"):
            self.headings.append("")

    def handle_endtag(self, tag: str) -> None:
        if tag in self._open:
            while self._open.pop() != tag:
                pass

    def handle_data(self, data: str) -> None:
        if "style" in self._open:
            return
        self.text += data
        if not self._open:
            return
        if self._open[-1] in ("td", "th"):
            self.tables[-1][1][-1][-1] += data
        elif self._open[-1] in ("h1", "h2"):
            self.headings[-1] += data

    def rows(self, heading: str) -> list[list[str]]:
        """Return the rows of all tables below a heading."""
        return [row for name, rows in self.tables for row in rows if name == heading]

    def value(self, heading: str, name: str) -> str:
        """Return the cell beside a name."""
        return next(row[1] for row in self.rows(heading) if row[0] == name)

    def picture(self, place: int) -> bytes:
        """Return the bytes of a picture."""
        return base64.b64decode(self.images[place]["src"].partition("base64,")[2])


def read(data: bytes) -> Page:
    """Read an HTML report."""
    page = Page()
    page.feed(data.decode())
    return page
