"""The page in a real browser, on a telephone and on a wall, light and dark.

RIGAPP_PAGE_PICTURES names a folder that keeps the pictures.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest
from page.browser import Browser
from page.doubles import OpenPage, ServedEngine
from snapshots import ALARM, write_recorded

CHROMIUM = shutil.which("chromium") or ""
pytestmark = pytest.mark.skipif(
    not CHROMIUM, reason="needs chromium: python rigapp/prepare/system_libraries.py --test"
)

SIZES = {"telephone": (360, 740), "wall": (1920, 1080)}
SMALLEST_TEXT_PX = 10.0
"""Of an axis on a telephone: as small as a map's names, which people read at arm's length."""


@pytest.fixture(scope="module")
def chromium(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    browser = Browser(CHROMIUM, tmp_path_factory.mktemp("chromium"))
    yield browser
    browser.close()


@pytest.fixture
def page(
    rig: Path,
    serve: Callable[..., ServedEngine],
    show: Callable[..., OpenPage],
    tmp_path: Path,
    ending: ExitStack,
) -> OpenPage:
    """Return a page with a test that has a file, and a rig whose engine is not there."""
    second = Path(shutil.copy(rig, rig.with_name("right.toml")))
    file = tmp_path / "quick-20270101-080000.h5"
    write_recorded(file)
    serve(rig, file=str(file), alarms=(ALARM,), rig="Left rig")
    serve(second, rig="The rig at the window")
    page = show([rig, second])
    page.sees(lambda rigs: all(one["line"] == "attached" for one in rigs), "both engines speak")
    page.shows("oil added")
    return page


@pytest.mark.sampled
@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", SIZES)
def test_the_page_fits_its_screen_and_is_live(
    chromium: Browser, page: OpenPage, size: str, scheme: str
) -> None:
    width, height = SIZES[size]
    chromium.open(f"http://127.0.0.1:{page.port}/", width, height, scheme)
    chromium.eventually("document.getElementById('server')?.textContent", lambda t: t == "live")
    assert chromium.value("document.documentElement.scrollWidth") <= width
    dark = "getComputedStyle(document.documentElement).backgroundColor"
    brightness = sum(int(one) for one in chromium.value(dark)[4:-1].split(","))
    assert (brightness < 200) == (scheme == "dark")
    text = "document.querySelector('svg text').getBoundingClientRect().height"
    assert chromium.value(text) >= SMALLEST_TEXT_PX
    asked = [
        one["params"]["request"]["url"]
        for one in chromium.events
        if one.get("method") == "Network.requestWillBeSent"
    ]
    assert len(asked) >= 3
    assert {url.split("/")[2] for url in asked} == {f"127.0.0.1:{page.port}"}
    complaints = [one for one in chromium.events if one.get("method") == "Log.entryAdded"]
    assert complaints == [], "nothing is against the page's own policy"
    if folder := os.environ.get("RIGAPP_PAGE_PICTURES"):
        chromium.picture(Path(folder) / f"page-{size}-{scheme}.png")


def test_the_switch_turns_the_colours_whatever_the_system_says(
    chromium: Browser, page: OpenPage
) -> None:
    chromium.open(f"http://127.0.0.1:{page.port}/", 360, 740, "light")
    theme = "document.documentElement.dataset.theme || 'auto'"
    chromium.eventually("document.getElementById('server')?.textContent", lambda t: t == "live")
    assert chromium.value(theme) == "auto"
    colours = []
    for expected in ("light", "dark", "auto"):
        chromium.value("document.getElementById('theme').click()")
        assert chromium.value(theme) == expected
        colours.append(chromium.value("getComputedStyle(document.body).color"))
    assert colours[0] == colours[2] != colours[1]


@pytest.mark.long
def test_a_page_that_loses_its_server_says_so_and_comes_back(
    chromium: Browser, page: OpenPage, show: Callable[..., OpenPage], rig: Path
) -> None:
    words = "document.getElementById('server')?.textContent"
    chromium.open(f"http://127.0.0.1:{page.port}/", 1920, 1080, "light")
    chromium.eventually(words, lambda text: text == "live")
    page.close()
    chromium.eventually(words, lambda text: text and "what is shown is old" in text)
    show([rig], f"127.0.0.1:{page.port}")
    chromium.eventually(words, lambda text: text == "live")
    chromium.eventually("document.querySelectorAll('.rig').length", lambda count: count == 1)
