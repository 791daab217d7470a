"""Draw the wiring of the two rigs of the first day: python docs/wiring_pictures.py.

The connections are a table; the drawing has a column of terminals for each box, with their wires.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import escape

IMAGES = Path(__file__).resolve().parent / "images"
WIDTH, ROW, HEAD, GAP = 900, 26, 34, 22
LEFT, BOX, SENSOR = 520, 300, 300
"""Left edge and width of the boxes, and width of the parts on the left."""
SIGNAL, POWER, STOP, LINK = "#0068A8", "#B3211C", "#B85400", "#4A535F"
"""Colours of wires for signals, motor power, emergency stop, and links to the computer."""


@dataclass(frozen=True, slots=True)
class Terminal:
    """One wire: the connected part, the terminal of the box, and the colour."""

    part: str
    terminal: str
    colour: str = SIGNAL


@dataclass(frozen=True, slots=True)
class Box:
    """One box with its terminals."""

    title: str
    terminals: tuple[Terminal, ...]


GSV8_ROBOCLAW = (
    Box(
        "GSV-8 (data acquisition)",
        (
            Terminal("Bridge along the crank", "analog 1: excitation, signal"),
            Terminal("Bridge across the crank", "analog 2: excitation, signal"),
            Terminal("Probe along the follower, ±10 V", "analog 3: voltage, ground"),
            Terminal("Probe across the follower, ±10 V", "analog 4: voltage, ground"),
            Terminal("Crank encoder, line A (5 V TTL)", "DIO 11 (counter 1, A)"),
            Terminal("Crank encoder, line B", "DIO 12 (counter 1, B)"),
            Terminal("Crank encoder, index", "DIO 13 (counter 1, I)"),
            Terminal("Crank encoder, supply", "5 V, GND (20 mA)"),
            Terminal("Computer", "USB, no hub", LINK),
        ),
    ),
    Box(
        "RoboClaw (drive)",
        (
            Terminal("Supply, fuse, emergency-stop contactor", "+ and - of the battery", POWER),
            Terminal("Motor", "M1A, M1B", POWER),
            Terminal("Motor encoder, lines A and B", "EN1 A, EN1 B, 5 V, GND"),
            Terminal("Emergency stop, second contact", "S3, GND (latching)", STOP),
            Terminal("Computer", "USB, packet serial", LINK),
        ),
    ),
)
DATAQ_CIA402 = (
    Box(
        "DATAQ DI-4108 or DI-2108 (data acquisition)",
        (
            Terminal("Bridge along the crank, its amplifier", "analog 1"),
            Terminal("Bridge across the crank, its amplifier", "analog 2"),
            Terminal("Probe along the follower", "analog 3"),
            Terminal("Probe across the follower", "analog 4"),
            Terminal("Crank encoder, line A (5 V TTL)", "D3 (counter), D2 (rate)"),
            Terminal('Line A, with clock = "encoder"', "D6 (scan clock), too"),
            Terminal('Line B, with clock = "encoder"', "direction_line, such as D0"),
            Terminal('Index, with clock = "encoder"', "index_line, such as D1"),
            Terminal("Computer", "USB, CDC mode (yellow)", LINK),
        ),
    ),
    Box(
        "CiA 402 drive, such as EPOS4",
        (
            Terminal("Supply, fuse, emergency-stop contactor", "power supply + and -", POWER),
            Terminal("Motor", "motor windings", POWER),
            Terminal("Motor encoder, hall sensors", "encoder, hall inputs"),
            Terminal("Emergency stop, second contact", "safe torque off (STO) inputs", STOP),
            Terminal("CAN adapter, 120 Ω at each end", "CAN high, low, ground", LINK),
        ),
    ),
)


def pictures() -> dict[str, str]:
    """Return the pictures by file name."""
    return {
        "wiring-gsv8-roboclaw.svg": drawn(GSV8_ROBOCLAW),
        "wiring-dataq-cia402.svg": drawn(DATAQ_CIA402),
    }


def drawn(boxes: Sequence[Box]) -> str:
    """Return boxes and wires as SVG."""
    heights = [HEAD + ROW * len(box.terminals) for box in boxes]
    total = sum(heights) + GAP * (len(boxes) + 1)
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{total}"'
        f' viewBox="0 0 {WIDTH} {total}" font-family="sans-serif" font-size="14">',
        f'<rect width="{WIDTH}" height="{total}" fill="#FFFFFF"/>',
    ]
    top = GAP
    for box, height in zip(boxes, heights, strict=True):
        lines += _box(box, top, height)
        top += height + GAP
    return "\n".join([*lines, "</svg>", ""])


def _box(box: Box, top: int, height: int) -> Iterator[str]:
    yield (
        f'<rect x="{LEFT}" y="{top}" width="{BOX + 60}" height="{height}" rx="8"'
        ' fill="#F1F3F5" stroke="#868F9B"/>'
    )
    yield _text(LEFT + 14, top + 22, box.title, "#171B21", weight="bold")
    for number, terminal in enumerate(box.terminals):
        middle = top + HEAD + ROW * number + ROW // 2 - 3
        yield (
            f'<rect x="20" y="{middle - 10}" width="{SENSOR}" height="20" rx="4"'
            ' fill="#FFFFFF" stroke="#C3C9D1"/>'
        )
        yield _text(28, middle + 5, terminal.part, "#171B21")
        yield (
            f'<path d="M {20 + SENSOR} {middle} H {LEFT}" stroke="{terminal.colour}"'
            ' stroke-width="2" fill="none"/>'
        )
        yield f'<circle cx="{LEFT}" cy="{middle}" r="4" fill="{terminal.colour}"/>'
        yield _text(LEFT + 14, middle + 5, terminal.terminal, "#4A535F")


def _text(left: int, base: int, words: str, colour: str, weight: str = "normal") -> str:
    return (
        f'<text x="{left}" y="{base}" fill="{colour}" font-weight="{weight}">{escape(words)}</text>'
    )


if __name__ == "__main__":
    for name, text in pictures().items():
        (IMAGES / name).write_text(text, "utf-8")
