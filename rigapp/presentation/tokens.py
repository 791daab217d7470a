"""Colours and sizes of the window, light and dark.

Colour means that something is not normal, the accent that something is chosen or comes next; in the
normal state only Stop is red. Curves can be told apart with any colour blindness.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Final


@dataclass(frozen=True, slots=True)
class Theme:
    """Every colour of the window; ``curves`` maps the role of a line to its colour.

    window, base, alternate: background, cards, areas in cards. hairline, strong: thin and strong
    dividing lines; border: edge of what can be pressed or typed into. text, secondary, muted: ink
    by importance. highlight: the accent, with its tint and the ink on it. warning, critical: with
    tint, ink on the tint (critical: itself), and ink on them.
    """

    name: str
    window: str
    base: str
    alternate: str
    hairline: str
    strong: str
    border: str
    text: str
    secondary: str
    muted: str
    highlight: str
    tint: str
    highlighted_text: str
    grid: str
    band: str
    bar: str
    track: str
    warning: str
    warning_tint: str
    warning_text: str
    critical: str
    critical_tint: str
    on_signal: str
    on_critical: str
    curves: Mapping[str, str] = field(hash=False)

    def ink(self, level: int, normal: str = "") -> str:
        """Return the ink of a level: 0 normal (by default the text's), 1 warning, 2 critical."""
        return (normal or self.text, self.warning_text, self.critical)[level]

    def mark(self, *, critical: bool) -> tuple[str, str]:
        """Return background and ink of what is not normal."""
        return (self.critical, self.on_critical) if critical else (self.warning, self.on_signal)


LIGHT: Final = Theme(
    name="light",
    window="#f1f3f5",
    base="#ffffff",
    alternate="#f7f8f9",
    hairline="#dde1e6",
    strong="#c3c9d1",
    border="#828b97",
    text="#171b21",
    secondary="#4a535f",
    muted="#626b77",
    highlight="#2b5c8a",
    tint="#e6eef5",
    highlighted_text="#ffffff",
    grid="#eceef1",
    band="#e6eef5",
    bar="#5b6673",
    track="#dde1e6",
    warning="#f0a818",
    warning_tint="#fff5dd",
    warning_text="#7a4b00",
    critical="#b3211c",
    critical_tint="#fbebea",
    on_signal="#171b21",
    on_critical="#ffffff",
    curves=MappingProxyType(
        {
            "first": "#0068a8",
            "main": "#171b21",
            "second": "#008214",
            "model": "#ad5000",
            "frozen": "#6b7480",
            "other": "#a8497b",
        }
    ),
)

DARK: Final = Theme(
    name="dark",
    window="#101419",
    base="#181d23",
    alternate="#13181d",
    hairline="#2a313a",
    strong="#3d4753",
    border="#6f7b89",
    text="#e8ecf0",
    secondary="#b0b9c4",
    muted="#8e99a6",
    highlight="#7db1de",
    tint="#1d2c3a",
    highlighted_text="#0e1317",
    grid="#232a32",
    band="#1d2c3a",
    bar="#9aa5b1",
    track="#2f3842",
    warning="#f5b73d",
    warning_tint="#35290f",
    warning_text="#f5c768",
    critical="#ff6b61",
    critical_tint="#3a1b1a",
    on_signal="#171b21",
    on_critical="#190605",
    curves=MappingProxyType(
        {
            "first": "#3f9be0",
            "main": "#f1f4f7",
            "second": "#7fe0b0",
            "model": "#f0a050",
            "frozen": "#8c8c8c",
            "other": "#cc79a7",
        }
    ),
)

THEMES: Final = {theme.name: theme for theme in (LIGHT, DARK)}

CAPTION_PT: Final = 9.0
BODY_PT: Final = 10.5
VALUE_PT: Final = 15.0
LARGE_PT: Final = 30.0
"""The four sizes of text: 12, 14, 20 and 40 pixels at 96 dots per inch. Points, so that they
follow the screen and the user's scale."""

STEP: Final = 8
"""The grid of all sizes, in pixels that follow the scale of the screen."""
GAP: Final = 12
MARGIN: Final = 16
MESSAGE_LINES: Final = 3
"""Lines of text in the line of messages."""
TIGHT_WIDTH: Final = 1200
TIGHT_HEIGHT: Final = 600
"""A narrower or lower window (a small screen at a scale of 150 or 200 %) shows only what is needed:
bars without their keys, fewer tiles, the side column during a recovery."""
RADIUS: Final = 6
CARD_RADIUS: Final = 8
