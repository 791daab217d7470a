"""Whatever a device error says leads to a section of docs/troubleshooting.md that exists."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from rigapp.commands import doctor
from rigapp_drivers.api import HELP, DeviceError, SettingsLost, help_of

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "troubleshooting.md").read_text("utf-8")


def anchors(page: str) -> set[str]:
    """Return the anchors of the headings of a page, as its site and its host make them."""
    titles = re.findall(r"^##+ (.+)$", page, re.MULTILINE)
    return {re.sub(r"[^a-z0-9 -]", "", title.lower()).replace(" ", "-") for title in titles}


def kinds(of: type[DeviceError] = DeviceError) -> Iterator[type[DeviceError]]:
    """Yield the kinds of errors that a driver raises."""
    for one in of.__subclasses__():
        if one.__module__.startswith("rigapp"):
            yield one
            yield from kinds(one)


def test_each_kind_of_error_leads_to_a_section_that_exists() -> None:
    found = set(kinds())
    assert found >= set(HELP)
    for one in found:
        assert help_of(one("daq", "/dev/ttyACM0", "what it says")) in anchors(PAGE), one.__name__
    assert len(set(HELP.values())) == len(HELP)
    assert help_of(SettingsLost("daq", "port", "x")) == "the-device-has-restarted"


def test_the_sections_that_doctor_names_exist() -> None:
    assert {doctor.NO_PERMISSION, doctor.IN_USE, doctor.SILENT} <= anchors(PAGE)


def test_what_the_page_quotes_is_said_somewhere() -> None:
    """A quoted sentence that no source says any more is out of date."""
    folders = (ROOT / "drivers", ROOT / "rigapp")
    sources = [path.read_text("utf-8") for folder in folders for path in folder.rglob("*.py")]
    said = re.sub(r'"\s*\n\s*f?"', "", "\n".join(sources))
    quoted = re.findall(r"(?<![*\w])\*([a-z][^*\n]{6,})\*", PAGE)
    assert len(quoted) > 20
    for words in quoted:
        parts = [part.strip() for part in re.split(r"\.\.\.|\ba GSV-8\b|\b\d+\b", words)]
        for part in filter(None, parts):
            assert part in said, words
