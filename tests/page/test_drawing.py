"""Drawings: lines break where nothing is known, words are words, axes keep still."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import numpy as np

from rigapp.page.plots import Curve, Drawing, Ribbon, svg
from rigapp.viewer.ranges import SteadyRange

X = np.arange(6.0)


def elements(text: str) -> ElementTree.Element:
    return ElementTree.fromstring(text)  # noqa: S314 - our own


def paths(text: str, role: str) -> list[str]:
    return re.findall(rf'<path class="{role}" d="([^"]*)"', text)


def drawn(*curves: Curve, ribbons: tuple[Ribbon, ...] = (), low: float = 0.0) -> str:
    drawing = Drawing(
        "Force & <more>", "Angle (°)", "Force (N)", (0.0, 5.0), low, 10.0, curves, ribbons
    )
    return svg(drawing, SteadyRange(1.0))


def test_a_line_breaks_where_nothing_is_known() -> None:
    y = np.array([1.0, 2.0, np.nan, 4.0, np.inf, 6.0])
    (path,) = paths(drawn(Curve(X, y, "main")), "curve main")
    assert path.count("M") == 3
    assert path.count("L") == 1
    assert "nan" not in path


def test_a_ribbon_is_closed_around_each_known_stretch() -> None:
    low = np.array([1.0, 2.0, np.nan, 4.0, 4.0, 4.0])
    (path,) = paths(
        drawn(ribbons=(Ribbon(X, low, low + np.where(X < 5, 1.0, np.inf), "first"),)),
        "ribbon first",
    )
    assert path.count("Z") == 2
    assert path.count("M") == 2


def test_values_stand_where_the_axis_says() -> None:
    (path,) = paths(drawn(Curve(X, 2.0 * X, "main")), "curve main")
    points = np.array(re.findall(r"([\d.]+) ([\d.]+)", path), dtype=float)
    assert np.all(np.diff(points[:, 0]) > 0.0)
    assert np.all(np.diff(points[:, 1]) < 0.0), "larger values stand higher"
    assert np.allclose(np.diff(points, 2, axis=0), 0.0, atol=0.2)


def test_words_are_escaped_and_the_whole_is_well_formed() -> None:
    text = drawn(Curve(X, X, "main"))
    assert elements(text).get("aria-label") == "Force & <more>"
    assert "style=" not in text, "the page's policy allows no style but its sheet"


def test_nothing_known_is_an_empty_drawing() -> None:
    text = drawn(Curve(X, np.full(6, np.nan), "main"), low=np.nan)
    assert paths(text, "curve main") == [""]
    elements(text)
