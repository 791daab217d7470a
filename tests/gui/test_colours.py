"""The palette for eyes that see colours differently: simulated, measured, and never alone.

Simulation: the matrices of Machado, Oliveira and Fernandes (2009) for a complete lack of one cone,
in linear RGB. Difference: CIE 1976 L*a*b*, where 2.3 is just noticeable; thin lines need far more.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPen

from rigapp.gui.panels.alarms import MARKS
from rigapp.gui.panels.compare import COLOURS
from rigapp.gui.plots.palette import MODEL, STALE_CURVE, LinePen
from rigapp.gui.window.controls import BUTTONS, RANKS, icon_colour
from rigapp.gui.window.headline import _OUTCOME_SHAPES, _SHAPES, StateShape
from rigapp.presentation.states import OUTCOMES, STATES
from rigapp.presentation.tokens import DARK, LIGHT, Theme
from rigapp.schema.messages import HowEnded, RunState, Severity

SEEN_BY = {
    "full colour": np.eye(3),
    "protanopia": np.array(
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ]
    ),
    "deuteranopia": np.array(
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.011820, 0.042940, 0.968881],
        ]
    ),
    "tritanopia": np.array(
        [
            [1.255528, -0.076749, -0.178779],
            [-0.078411, 0.930809, 0.147602],
            [0.004733, 0.691367, 0.303900],
        ]
    ),
}
LEAST_DIFFERENCE = 15.0
"""Between curves of one plot that have the same line style."""

LEAST_WITH_DASHES = 10.0
"""Between a solid and a dashed curve, which names at the curves tell apart too."""

LEAST_CONTRAST = 3.0
"""Between an icon or a curve and its background (WCAG 2.2, graphics)."""

LEAST_OF_TEXT = 4.5
"""Between a text and its background (WCAG 2.2, text): curves carry names in their colour."""

THEMES = pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])
EYES = pytest.mark.parametrize("eyes", list(SEEN_BY))

PLOTS = (("main", "first", "second", "model", "frozen"),)
"""Roles that stand in one plot; ``model`` is dashed, all others are solid."""


def linear(colour: str) -> np.ndarray:
    """Return the linear RGB of a colour, 0 .. 1."""
    value = QColor(colour)
    srgb = np.array([value.redF(), value.greenF(), value.blueF()])
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def lab(colour: str, eyes: str) -> np.ndarray:
    """Return L*a*b* (D65) of a colour as some eyes see it."""
    seen = np.clip(SEEN_BY[eyes] @ linear(colour), 0.0, 1.0)
    to_xyz = np.array(
        [
            [0.4124564, 0.3575761, 0.1804375],
            [0.2126729, 0.7151522, 0.0721750],
            [0.0193339, 0.1191920, 0.9503041],
        ]
    )
    x, y, z = to_xyz @ seen / np.array([0.95047, 1.0, 1.08883])
    fx, fy, fz = (v ** (1 / 3) if v > 0.008856 else 7.787 * v + 16 / 116 for v in (x, y, z))
    return np.array([116.0 * fy - 16.0, 500.0 * (fx - fy), 200.0 * (fy - fz)])


def difference(one: str, other: str, eyes: str) -> float:
    """Return the colour difference that some eyes see."""
    return float(np.linalg.norm(lab(one, eyes) - lab(other, eyes)))


def contrast(one: str, other: str) -> float:
    """Return the ratio of luminances of two colours, 1 .. 21."""
    weights = np.array([0.2126, 0.7152, 0.0722])
    bright, dim = sorted((float(weights @ linear(c)) for c in (one, other)), reverse=True)
    return (bright + 0.05) / (dim + 0.05)


def test_the_simulation_knows_which_colours_are_confused() -> None:
    assert difference("#000000", "#ffffff", "full colour") == pytest.approx(100.0, abs=0.1)
    red, green = "#c04040", "#5f7a1f"
    assert difference(red, green, "full colour") > 50.0
    assert difference(red, green, "deuteranopia") < 0.5 * difference(red, green, "full colour")
    for eyes in SEEN_BY:
        assert difference("#808080", "#808080", eyes) == 0.0
        assert np.allclose(lab("#808080", eyes)[1:], 0.0, atol=1.0)


@THEMES
@EYES
@pytest.mark.parametrize("roles", PLOTS)
def test_curves_of_one_plot_are_told_apart(theme: Theme, eyes: str, roles: tuple[str, ...]) -> None:
    for one, other in itertools.combinations(roles, 2):
        found = difference(theme.curves[one], theme.curves[other], eyes)
        dashed = "model" in (one, other)
        least = LEAST_WITH_DASHES if dashed else LEAST_DIFFERENCE
        assert found > least, (one, other, round(found, 1))


@THEMES
@EYES
def test_alarm_colours_are_told_from_each_other_and_from_a_calm_screen(
    theme: Theme, eyes: str
) -> None:
    for one, other in itertools.combinations((theme.window, theme.warning, theme.critical), 2):
        found = difference(one, other, eyes)
        assert found > LEAST_DIFFERENCE, (one, other, round(found, 1))


@THEMES
@EYES
def test_runs_that_are_compared_are_told_apart(theme: Theme, eyes: str) -> None:
    for one, other in itertools.combinations(COLOURS[theme.name], 2):
        found = difference(one, other, eyes)
        assert found > LEAST_DIFFERENCE, (one, other, round(found, 1))


GUIDE = Path(__file__).parents[2] / "docs" / "contrast.md"
HEADING = "| what | on | least | light | dark |"


def pairs(theme: Theme) -> Iterator[tuple[str, str, float, float]]:
    """Yield what is seen, on what, the least contrast, and the contrast in a theme."""
    cards = {"window": theme.window, "card": theme.base, "sunk": theme.alternate}
    grounds = {
        "accent": theme.highlight,
        "accent tint": theme.tint,
        "warning": theme.warning,
        "warning tint": theme.warning_tint,
        "critical": theme.critical,
        "critical tint": theme.critical_tint,
    }
    for name, inks in (
        ("window", ("text", "secondary", "muted", "critical", "highlight")),
        ("card", ("text", "secondary", "muted", "critical", "warning_text", "highlight")),
        ("sunk", ("text", "secondary", "muted", "critical")),
        ("accent", ("highlighted_text",)),
        ("accent tint", ("text", "highlight")),
        ("warning", ("on_signal",)),
        ("warning tint", ("text", "warning_text")),
        ("critical", ("on_critical",)),
        ("critical tint", ("text", "critical")),
    ):
        for ink in inks:
            back = {**cards, **grounds}[name]
            what = f"text, {ink.replace('_', ' ')}"
            yield what, name, LEAST_OF_TEXT, contrast(getattr(theme, ink), back)
    for role, colour in theme.curves.items():
        yield f"curve and its name, {role}", "card", LEAST_OF_TEXT, contrast(colour, theme.base)
    for number, colour in enumerate(COLOURS[theme.name], 1):
        yield (
            f"curve and its name, compared test {number}",
            "card",
            LEAST_OF_TEXT,
            contrast(colour, theme.base),
        )
    for spec in BUTTONS:
        back = "accent" if RANKS.get(spec.verb) == "primary" else "card"
        found = contrast(icon_colour(spec.verb, theme), {**cards, **grounds}[back])
        yield f"icon, {spec.verb}", back, LEAST_CONTRAST, found
    for name in ("window", "card"):
        yield "edge of a control", name, LEAST_CONTRAST, contrast(theme.border, cards[name])
    yield "bar", "card", LEAST_CONTRAST, contrast(theme.bar, theme.base)


def contrast_table() -> str:
    """Return the table of the guide."""
    lines = [HEADING, "| --- | --- | --- | --- | --- |"]
    for (what, on, least, light), (*_, dark) in zip(pairs(LIGHT), pairs(DARK), strict=True):
        lines.append(f"| {what} | {on} | {least:g} | {light:.1f} | {dark:.1f} |")
    return "\n".join(lines) + "\n"


@THEMES
def test_text_curves_icons_and_edges_stand_out_from_their_background(theme: Theme) -> None:
    for what, on, least, found in pairs(theme):
        assert found >= least, (what, on)


def test_the_guide_has_the_contrast_of_these_colours() -> None:
    _, heading, table = GUIDE.read_text("utf-8").partition(HEADING)
    assert heading + table == contrast_table(), "run: python tests/gui/test_colours.py"


@THEMES
def test_measured_and_model_differ_in_their_line_too(theme: Theme) -> None:
    def dashed(pen: QPen) -> bool:
        return pen.style() is not Qt.PenStyle.SolidLine

    for role in theme.curves:
        if role != "model":
            assert not dashed(LinePen(role).of(theme)), role
    assert dashed(MODEL.of(theme))
    assert dashed(STALE_CURVE.of(theme))


def test_states_and_alarms_have_words_and_shapes_beside_colour() -> None:
    assert set(STATES) == set(RunState)
    assert set(OUTCOMES) == set(HowEnded)
    for words in (STATES, OUTCOMES):
        assert len(set(words.values())) == len(words)
    abnormal = {state for state, shape in _SHAPES.items() if shape is StateShape.DIAMOND}
    assert abnormal == {RunState.FAULT}
    tripped = {one for one, shape in _OUTCOME_SHAPES.items() if shape is StateShape.DIAMOND}
    assert tripped == {HowEnded.TRIPPED}
    marks = {MARKS[severity].split()[0] for severity in Severity}
    assert len(marks) == len(Severity)


if __name__ == "__main__":
    before = GUIDE.read_text("utf-8").partition(HEADING)[0]
    GUIDE.write_text(before + contrast_table(), "utf-8")
