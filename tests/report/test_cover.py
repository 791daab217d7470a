"""The first page of a report, its settings, and its figures as a laboratory passes them on."""

from __future__ import annotations

import io
import re
import shutil
from datetime import datetime
from pathlib import Path
from typing import Any

import pytest
from pypdf import PdfReader
from pypdf.generic import NullObject
from reportpage import Page

from rigapp.commands.files import draw_figure, write_report
from rigapp.config.errors import UnusableInput
from rigapp.presentation.tokens import LIGHT
from rigapp.report.page.document import Listing, Manuscript, Section, Table, Text
from rigapp.report.page.pdf import as_pdf
from rigapp.storage import open_test

SETTINGS = """schema = 1
[laboratory]
name = "Laboratory of Tribology"
address = "Street 1\\n12345 Town"
logo = "logo.png"
[report]
number = "W-{date}-{specimen}"
customer = "Example & Sons"
statement = "Results relate to the specimen tested."
signatures = ["Head of laboratory"]
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory, eventful_file: Path) -> Path:
    """Return a folder with a test and the settings of a laboratory beside it."""
    from matplotlib.image import imsave

    path = tmp_path_factory.mktemp("laboratory")
    shutil.copy(eventful_file, path / "test.h5")
    imsave(path / "logo.png", [[0.0, 1.0]], dpi=72)
    (path / "report.toml").write_text(SETTINGS)
    return path


@pytest.fixture(scope="module")
def document(folder: Path) -> PdfReader:
    """Return the report as PDF."""
    assert write_report(folder / "test.h5", folder / "report.pdf") == 0
    return PdfReader(folder / "report.pdf")


def test_the_first_page_says_who_what_and_what_came_out(document: PdfReader) -> None:
    text = document.pages[0].extract_text()
    for words in (
        "Laboratory of Tribology", "12345 Town", "Example & Sons", "W-2027-01-15-PTFE 1",
        "Wear depth", "7.50 ± 0.40 µm", "Wear coefficient", "Largest force", "Measured − model",
        "End of the test", "295 revolutions", "Figure 1. Wear depth.",
    ):  # fmt: skip
        assert words in text, words
    assert "Summary" not in text
    last = "".join(page.extract_text() for page in document.pages[-2:])
    assert "Results relate to the specimen tested." in last
    assert "Head of laboratory" in last


def test_figures_are_lines_and_text_with_embedded_fonts(document: PdfReader) -> None:
    resources = [page["/Resources"] for page in document.pages]
    pixels = []
    for part in resources:
        for one in (part.get("/XObject") or {}).values():
            if one["/Subtype"] == "/Form":
                resources.append(one["/Resources"])
            else:
                pixels.append(one)
        for font in (part.get("/Font") or {}).values():
            (inner,) = font.get("/DescendantFonts") or [font]
            assert "/FontFile2" in inner.get_object()["/FontDescriptor"]
    assert len(pixels) == 1, "the logo"
    text = "".join(page.extract_text() for page in document.pages)
    for words in ("wear depth (µm)", "force_1 (N)", "revolution"):
        assert words in text


def test_it_is_tagged_for_programs_that_read_it_aloud(document: PdfReader) -> None:
    tags: list[tuple[str, str]] = []

    def walk(node: Any) -> None:
        node = node.get_object()
        if isinstance(node, list):
            for one in node:
                walk(one)
        elif isinstance(node, dict):
            if "/S" in node:
                tags.append((node["/S"], str(node.get("/Alt", ""))))
            walk(node.get("/K", NullObject()))

    walk(document.trailer["/Root"]["/StructTreeRoot"])
    assert document.trailer["/Root"]["/MarkInfo"]["/Marked"]
    names = [name for name, _ in tags]
    assert names[0] == "/Document"
    headings = [one["/Title"] for one in document.outline if isinstance(one, dict)]
    assert names.count("/H1") == len(headings) > 10
    assert {"/Title", "/P", "/Caption", "/Table", "/TR", "/TH", "/TD", "/Code"} <= set(names)
    texts = [text for name, text in tags if name == "/Figure"]
    assert len(texts) == 6, "five figures and the logo"
    assert all(texts)
    assert texts[0] == "Laboratory of Tribology"


@pytest.mark.parametrize(
    "note", ["株式会社 \U0001f600 \U000e0fff", "\x00 \ud800 #set page() $x$ [*"]
)
def test_a_text_that_no_font_has_does_not_stop_a_report(note: str) -> None:
    blocks = (Text(note), Table("", ((note, note),)), Listing(note, note))
    data = as_pdf(Manuscript("title", "footer", (Section(note, blocks),)))
    (page,) = PdfReader(io.BytesIO(data)).pages
    assert "page 1 of 1" in page.extract_text()
    assert as_pdf(Manuscript("title", "footer", (Section(note, blocks),))) == data


def test_the_date_of_the_document_is_that_of_the_test(folder: Path, document: PdfReader) -> None:
    with open_test(folder / "test.h5") as reader:
        ended = datetime.fromisoformat(str(reader.metadata()["ended"]))
    assert document.metadata is not None
    assert document.metadata.creation_date == ended.replace(microsecond=0)
    assert document.trailer["/Root"]["/Lang"] == "en"
    assert document.trailer["/Root"]["/ViewerPreferences"]["/DisplayDocTitle"]


def test_no_text_is_smaller_than_8_points(document: PdfReader) -> None:
    sizes: set[float] = set()

    def note(text: str, _: object, matrix: list[float], font: object, size: float) -> None:
        if text.strip():
            sizes.add(round(size * abs(matrix[3]), 1))

    for page in document.pages:
        page.extract_text(visitor_text=note)
    assert min(sizes) >= 7.5, "figures have ticks of 7.5"
    assert 8.0 in sizes


def test_figures_and_tables_are_numbered_without_a_hole(document: PdfReader) -> None:
    text = "\n".join(page.extract_text() for page in document.pages)
    for what in ("Figure", "Table"):
        numbers = [int(one) for one in re.findall(rf"^{what} (\d+)\.", text, re.MULTILINE)]
        assert sorted(numbers) == list(range(1, len(numbers) + 1))
        assert len(numbers) > 3
    assert "nan" not in text.split()


def test_html_has_the_same_first_page(folder: Path) -> None:
    assert write_report(folder / "test.h5", folder / "report.html") == 0
    page = Page()
    page.feed((folder / "report.html").read_text())
    assert "Example & Sons" in page.text
    assert page.images[0]["src"].startswith("data:image/png;base64,")
    assert [row[0] for row in page.rows("Result")][:2] == ["Wear depth", "Wear coefficient"]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("{specimen}", "{operator}"), "names something else"),
        (("logo.png", "../secret.png"), "there is no such file beside it"),
        (("logo.png", "report.toml"), "neither PNG nor JPEG"),
        (("logo.png", "missing.png"), "missing.png"),
        (("customer", "custumer"), "custumer is not a known key"),
    ],
)
def test_settings_that_cannot_be_used_are_refused(
    folder: Path, change: tuple[str, str], words: str
) -> None:
    settings = folder / "other.toml"
    settings.write_text(SETTINGS.replace(*change))
    with pytest.raises(UnusableInput, match=words):
        write_report(folder / "test.h5", folder / "r.pdf", settings=settings)


@pytest.mark.parametrize("width_mm", [86.0, 178.0])
def test_a_figure_is_as_wide_as_a_column(folder: Path, width_mm: float) -> None:
    target = folder / "figure.pdf"
    assert draw_figure(folder / "test.h5", target, "forces", width_mm) == 0
    (page,) = PdfReader(io.BytesIO(target.read_bytes())).pages
    assert float(page.mediabox.width) == pytest.approx(width_mm / 25.4 * 72.0, abs=0.01)
    assert "joint force" in page.extract_text()
    draw_figure(folder / "test.h5", folder / "figure.svg", "", width_mm)
    assert LIGHT.curves["model"] in (folder / "figure.svg").read_text()


def test_a_figure_that_is_not_there_is_named(folder: Path) -> None:
    with pytest.raises(UnusableInput, match="is none of wear, forces"):
        draw_figure(folder / "test.h5", folder / "x.svg", "heat", 86.0)
    with pytest.raises(UnusableInput, match="no data for the figure trip"):
        draw_figure(folder / "test.h5", folder / "x.svg", "trip", 86.0)
    with pytest.raises(UnusableInput, match=r"a figure is \.svg, \.pdf or \.png"):
        draw_figure(folder / "test.h5", folder / "x.gif", "wear", 86.0)
    assert not (folder / "x.svg").exists()
