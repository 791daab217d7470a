"""Room for every word: at each scale and size of the screen, in both themes and all languages."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import product
from typing import Any

import pytest

from rigapp.gui.language import speak_language
from rigapp.gui.results.results_index import ResultsIndex
from rigapp.gui.window.tabs import NUMBERS
from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import THEMES
from rigapp.presentation.translation import ENGLISH
from rigapp.schema.alarms import make_alarm
from rigapp.schema.messages import Alarm, Recovery, Remedy, RunState, Severity
from tests.gui.roominess import LONGEST_FIRST, SCALES, SIZES, cut_texts
from tests.patience import PATIENCE_MS


@pytest.fixture(autouse=True)
def _english_afterwards(qapp: Any) -> Iterator[None]:
    yield
    speak_language(qapp, ENGLISH)


@pytest.fixture(autouse=True)
def _unread(monkeypatch: pytest.MonkeyPatch) -> None:
    """Start no process to read a test's result each time that one ends: its page is not seen."""
    monkeypatch.setattr(ResultsIndex, "ask", lambda *_: None)


def tripped() -> dict[str, Any]:
    """Return the status after an overload, which asks for the longest words of the shell."""
    cause = make_alarm("overload", force_N=391.04, limit_N=380.0)
    alarm = Alarm(
        cause.key,
        Severity.CRITICAL,
        cause.title,
        cause.sentence,
        cause.kind.consequence,
        cause.kind.action,
        1.8e9,
        1200,
        first_out=True,
    )
    step = 'Acknowledge "Overload": confirm that you have seen it.'
    left = (Remedy.ACKNOWLEDGE, Remedy.RESET, Remedy.RESUME)
    told = Recovery(Remedy.ACKNOWLEDGE, "acknowledge", step, left)
    return {
        "state": RunState.FAULT, "reason": cause.sentence, "alarms": (alarm,), "recovery": told
    }  # fmt: skip


@pytest.mark.long
@pytest.mark.parametrize("language", LONGEST_FIRST)
def test_no_text_is_cut_at_any_scale_size_and_theme(
    language: str, qapp: Any, qtbot: Any, engine: Any, request: pytest.FixtureRequest
) -> None:
    """Try all twelve at which one may look; a scale leaves so many fewer pixels to the window."""
    speak_language(qapp, language)
    window: MainWindow = request.getfixturevalue("window")
    attach: Callable[[], None] = request.getfixturevalue("attach")

    def wait_until_dressed() -> None:
        qtbot.waitUntil(lambda: not window.dressing.isActive(), timeout=PATIENCE_MS)

    window.tabs.setCurrentIndex(NUMBERS["log"])  # of the place with the side column; draws little
    cut = set()
    for number, (theme, scale, size) in enumerate(product(THEMES.values(), SCALES, SIZES)):
        if theme is not window.theme:
            window.dress(theme)
            wait_until_dressed()
        window.resize(int(size[0] / scale), int(size[1] / scale))
        for turn, situation in enumerate(({}, tripped(), {"state": RunState.CONNECTING})):
            engine.say(first=3 * number + turn + 1, count=1, curves=False, **situation)
            attach()
            qapp.processEvents()
            assert (window.width(), window.height()) == (int(size[0] / scale), int(size[1] / scale))
            shell = (window.header, window.messages, window.controls, window.side, window.rail)
            for part in (*shell, window.page_bar):
                edge = part.mapTo(window, part.rect().bottomRight())
                assert edge.x() < window.width()
                assert edge.y() < window.height()
                cut |= {f"{scale:g} {size[0]} {theme.name}: {one}" for one in cut_texts(part)}
    assert sorted(cut) == []
