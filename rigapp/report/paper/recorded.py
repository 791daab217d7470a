"""The paper's Figs 20 and 21 from a recorded test: measured and modelled forces and profile."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rigapp.config.errors import UnusableInput
from rigapp.report.paper.kinematics import COLOURS, DEGREES
from rigapp.report.paper.pages import Chapter
from rigapp.report.testreport.model_facts import CyclePicture, cycles_of
from rigapp.report.testreport.worn import CURVES, worn_of
from rigapp.schema.messages import NOT_STEADY
from rigapp.storage import TestReader, open_test

COMPONENTS = {"force_1": "component 1", "force_2": "component 2", "force": "magnitude"}
EXTREMA = ("max", "rms", "min")
MOST_ROWS = 2000
"""Maximum number of rows of the table of extrema; more revolutions are grouped, peaks kept."""


def recorded_chapters(path: Path) -> Iterator[Chapter]:
    """Yield those of Figs 20 and 21 possible for a test file; raises UnusableInput without any."""
    with open_test(path) as reader:
        drawn = [draw(reader) for draw in (force_of_a_cycle, extrema, profile)]
    chapters = [chapter for chapter in drawn if chapter is not None]
    if not chapters:
        raise UnusableInput("{}: it holds no complete revolution; give a test with data.", path)
    yield from chapters


def force_of_a_cycle(reader: TestReader) -> Chapter | None:
    """Return Fig. 20 as in the paper's text: components and |F| over the crank angle, or None."""
    pictures = [
        cycle for cycle in cycles_of(reader) if cycle.model and set(COMPONENTS) <= set(cycle.model)
    ]
    if not pictures:
        return None
    last = pictures[-1]
    degrees = np.arange(360.0)
    columns = {"crank_angle_deg": degrees}
    for name in COMPONENTS:
        columns[f"{name}_measured_N"] = _on(degrees, last.columns["angle"], last.columns[name])
        columns[f"{name}_model_N"] = _on(degrees, last.model["angle"], last.model[name])

    def draw(axes: Sequence[Any]) -> None:
        for panel, (name, words) in zip(axes, COMPONENTS.items(), strict=True):
            panel.plot(degrees, columns[f"{name}_measured_N"], color=COLOURS[1], label="measured")
            panel.plot(degrees, columns[f"{name}_model_N"], "--", color=COLOURS[4], label="model")
            panel.set_title(words, loc="left")
            panel.set_ylabel("force, N")
        axes[0].legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
        axes[-1].set_xlabel(DEGREES)

    return Chapter(
        name="fig20_force",
        title=f"Fig. 20: force in revolution {last.revolution:,}, measured and by the model",
        columns=columns,
        sentences=(
            "Components in the frame of the crank, in which the load cell measures; the model's"
            f" curve is that of revolution {last.model_revolution:,}, from the measured angle.",
            _agreement(last),
        ),
        draw=draw,
        words="both components and the magnitude of the joint force over the crank angle,"
        " measured and by the model",
        panels=3,
    )


def _on(degrees: np.ndarray, angle: np.ndarray, values: np.ndarray) -> np.ndarray:
    return np.asarray(np.interp(degrees, angle, values, period=360.0))


def _agreement(picture: CyclePicture) -> str:
    """Return the deviation of the model, and the shift along the angle that fits best, as text."""
    degrees = np.arange(0.0, 360.0, 0.1)
    parts, shifts = [], []
    for name, words in COMPONENTS.items():
        measured = _on(degrees, picture.columns["angle"], picture.columns[name])
        model = _on(degrees, picture.model["angle"], picture.model[name])
        share = np.sqrt(np.mean(np.square(measured - model)) / np.mean(np.square(measured)))
        parts.append(f"{100.0 * share:.1f} % for {words}")
        swing = [curve - curve.mean() for curve in (measured, model)]
        match = np.fft.irfft(np.fft.rfft(swing[0]) * np.conj(np.fft.rfft(swing[1])))
        shift = 0.1 * float(np.argmax(match))
        shifts.append(f"{(shift + 180.0) % 360.0 - 180.0:+.1f}°")
    return (
        f"Root mean square of the difference, of that of the measured force: {', '.join(parts)}."
        f" Shifted along the crank angle the model fits best by {', '.join(shifts)}, in the same"
        " order: the paper saw a slight shift in the components and none in the magnitude."
    )


def extrema(reader: TestReader) -> Chapter | None:
    """Return Fig. 20 as in its caption: extrema of the force over the cycles, or None."""
    known = reader.column_units()
    count = reader.committed()
    names = [f"force_{statistic}" for statistic in EXTREMA if f"force_{statistic}" in known]
    if not names or not count:
        return None
    starts = np.unique(np.linspace(0, count, min(count, MOST_ROWS), endpoint=False).astype(int))
    columns = {"revolution": reader.column("revolution", 0, count)[starts].astype(float)}
    unsteady = reader.column("quality", 0, count).astype(np.int64) & NOT_STEADY != 0
    for name in names:
        values = np.where(unsteady, np.nan, reader.column(name, 0, count))
        columns[f"{name}_N"] = _gathered(name, values, starts)

    def draw(axes: Sequence[Any]) -> None:
        for colour, name in zip((COLOURS[1], COLOURS[0], COLOURS[2]), names, strict=False):
            label = {"max": "maximum", "rms": "RMS", "min": "minimum"}[name.split("_")[1]]
            axes[0].plot(columns["revolution"], columns[f"{name}_N"], color=colour, label=label)
        axes[0].set_xlabel("revolution")
        axes[0].set_ylabel("|F|, N")
        axes[0].legend(loc="center left", bbox_to_anchor=(1.0, 0.5))

    return Chapter(
        name="fig20_extrema",
        title="Fig. 20: extrema of the force over the cycles",
        columns=columns,
        sentences=(_scatter(columns["force_max_N"]),) if "force_max_N" in columns else (),
        draw=draw,
        words="largest, root mean square and smallest force of each revolution over the test",
    )


def _gathered(name: str, values: np.ndarray, starts: np.ndarray) -> np.ndarray:
    """Return a statistic of groups of revolutions from that of the revolutions."""
    if name.endswith("max"):
        return np.fmax.reduceat(values, starts)
    if name.endswith("min"):
        return np.fmin.reduceat(values, starts)
    known = np.isfinite(values)
    sums = np.add.reduceat(np.where(known, np.square(values), 0.0), starts)
    numbers = np.add.reduceat(known.astype(float), starts)
    return np.sqrt(sums / np.where(numbers > 0.0, numbers, np.nan))


def _scatter(largest: np.ndarray) -> str:
    """Return the scatter of the maximum early and late in the test, at steady speed, as text."""
    known = largest[np.isfinite(largest)]
    tenth = max(len(known) // 10, 2)
    if len(known) < 2 * tenth:
        return "Too few revolutions are at steady speed to tell how their maximum varies."
    first, last = (float(np.std(part)) for part in (known[:tenth], known[-tenth:]))
    return (
        f"At steady speed the maximum of a revolution varies by {first:.3g} N (standard deviation)"
        f" in the first tenth of the test and by {last:.3g} N in the last; the paper's grows."
    )


def profile(reader: TestReader) -> Chapter | None:
    """Return Fig. 21, the worn profile from the probes and from the model, or None."""
    result = worn_of(reader)
    if result is None:
        return None
    columns = {"angle_deg": result.angle}
    columns |= {f"depth_{name}_mm": curve for name, curve in result.curves.items()}
    columns["uncertainty_mm"] = result.uncertainty

    def draw(axes: Sequence[Any]) -> None:
        measured, uncertainty = result.curves["measured"], result.uncertainty
        axes[0].fill_between(
            result.angle,
            np.maximum(measured - uncertainty, 0.0),
            measured + uncertainty,
            color=COLOURS[1],
            alpha=0.2,
            lw=0,
        )
        for colour, style, (name, words) in zip(
            (COLOURS[1], COLOURS[4], COLOURS[5]), ("-", "--", "-."), CURVES.items(), strict=True
        ):
            axes[0].plot(result.angle, result.curves[name], style, color=colour, label=words)
        axes[0].set_xlim(-120.0, 120.0)
        axes[0].set_ylim(bottom=0.0)
        axes[0].set_xlabel("angle from the initial contact point, °, follower frame")
        axes[0].set_ylabel("depth, mm")
        axes[0].legend(loc="upper center", bbox_to_anchor=(0.5, -0.25), ncols=2)

    depths = ", ".join(
        f"{result.extents[name].depth:.4g} mm {words}"
        for name, words in CURVES.items()
        if np.isfinite(result.extents[name].depth)
    )
    return Chapter(
        name="fig21_recorded",
        title=f"Fig. 21: worn profile after revolution {result.revolution:,} of a recorded test",
        columns=columns,
        sentences=(
            f"Largest depth: {depths}. Shaded: the expanded uncertainty (k = 2) of the measured"
            " one. Where the pin never was nothing is known, and nothing is drawn.",
        ),
        draw=draw,
        words="measured worn profile with its uncertainty, and the model's",
    )
