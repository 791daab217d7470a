"""The worn profile of a test file: facts, section and figure (the paper's Fig. 21)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp.presentation.numbers import grouped
from rigapp.presentation.translation import Text as Words
from rigapp.presentation.translation import tr
from rigapp.report.page.document import Block, Figure, Table, Text
from rigapp.report.page.figures import MODEL_LINE, canvas_of, saved
from rigapp.report.testreport import plots
from rigapp.report.testreport.formatting import UNKNOWN, number
from rigapp.storage import TestReader

Floats = NDArray[np.float64]

STAGES = 4
"""Number of earlier profiles drawn as thin lines, spaced evenly in log revolutions."""
CURVES: dict[str, Words] = {
    "measured": "measured (probes)",
    "predicted": "predicted (model)",
    "driven": "model driven by the measured forces",
}


@dataclass(frozen=True, slots=True)
class Extent:
    """Key figures of a profile: largest depth and its angle, limits of the worn arc, area, mass.

    mm, degrees, mm^2, mg; NaN when unknown.
    """

    depth: float
    angle: float
    low: float
    high: float
    area: float
    mass: float


@dataclass(frozen=True, slots=True, eq=False)
class Worn:
    """The newest worn profile, its curves in mm at ``angle`` (deg), and the stages before it.

    centred: whether the probes' zero determined the direction; approach_change, run_out: um;
    corrected: whether the change of the approach was removed, which is not so in older files.
    """

    revolution: int
    averaged: int
    angle: Floats
    curves: Mapping[str, Floats]
    uncertainty: Floats
    extents: Mapping[str, Extent]
    stages: tuple[tuple[int, Floats], ...]
    approach_change: float
    run_out: float
    centred: bool
    corrected: bool


def worn_of(reader: TestReader) -> Worn | None:
    """Return the worn profile of a file, None when none is recorded."""
    table = reader.profiles()
    revolutions = table["revolution"]
    if revolutions.size == 0:
        return None
    parameters = reader.configuration().get("parameters", {})
    curves = {name: np.asarray(table[name][-1], dtype=np.float64) for name in CURVES}
    return Worn(
        revolution=int(revolutions[-1]),
        averaged=int(table["revolutions"][-1]),
        angle=table["angle"],
        curves=curves,
        uncertainty=np.asarray(table["uncertainty"][-1], dtype=np.float64),
        extents={
            name: extent_of(table["angle"], curve, parameters) for name, curve in curves.items()
        },
        stages=_stages(revolutions, table["measured"]),
        approach_change=float(table["approach_change"][-1]),
        run_out=float(table["run_out"][-1]),
        centred=bool(table["centred"][-1]),
        corrected=any(
            column.name == "measured_wear_depth_uncertainty"
            for column in reader.plan.prediction_columns
        ),
    )


def extent_of(angle: Floats, depth: Floats, parameters: Mapping[str, Any]) -> Extent:
    """Return the key figures of a profile (mm at deg); parameters: radius, width and density."""
    known = np.isfinite(depth)
    unknown = float("nan")
    if not known.any():
        return Extent(unknown, unknown, unknown, unknown, unknown, unknown)
    deep = np.where(known, depth, 0.0)
    worn = np.flatnonzero(deep > max(1e-4, 0.01 * float(deep.max())))
    deepest = int(np.argmax(deep))
    low, high = (float(angle[worn[0]]), float(angle[worn[-1]])) if worn.size else (unknown, unknown)
    area = mass = unknown
    try:
        radius = float(parameters["joint"]["bushing_radius_mm"])
        width = float(parameters["joint"]["bushing_width_mm"])
        density = float(parameters["bushing"]["density_g_per_cm3"])
        area = 0.5 * float(np.trapezoid((radius + deep) ** 2 - radius**2, np.radians(angle)))
        mass = area * width * density
    except (KeyError, TypeError, ValueError):
        pass
    return Extent(float(deep[deepest]), float(angle[deepest]), low, high, area, mass)


def _stages(revolutions: NDArray[Any], measured: NDArray[Any]) -> tuple[tuple[int, Floats], ...]:
    seen = [i for i in range(revolutions.size - 1) if np.isfinite(measured[i]).any()]
    if not seen:
        return ()
    numbers = revolutions[seen].astype(np.float64)
    wanted = np.geomspace(max(numbers[-1] / 100.0, numbers[0]), revolutions[-1], STAGES + 1)[:-1]
    indices = sorted({seen[int(np.argmin(np.abs(np.log(numbers / number))))] for number in wanted})
    return tuple((int(revolutions[i]), np.asarray(measured[i], dtype=np.float64)) for i in indices)


def profile_blocks(worn: Worn | None) -> list[Block]:
    """Return table, text and figure of the worn profile."""
    if worn is None:
        return [Text(tr("No worn profile is recorded in the file."))]
    header = (
        tr("worn profile"),
        tr("largest depth, µm"),
        tr("at, °"),
        tr("from, °"),
        tr("to, °"),
        tr("area, mm²"),
        tr("mass, mg"),
    )
    rows = tuple((tr(words), *_cells(worn, name)) for name, words in CURVES.items())
    title = tr("Worn profile after revolution {}", grouped(worn.revolution))
    return [Table(title, rows, header), Text(_sentence(worn)), picture(worn)]


def _cells(worn: Worn, name: str) -> tuple[str, ...]:
    extent = worn.extents[name]
    depth = number(1e3 * extent.depth, "um", 2)
    if name == "measured" and np.isfinite(extent.depth):
        index = int(np.argmin(np.abs(worn.angle - extent.angle)))
        depth += f" ± {number(1e3 * float(worn.uncertainty[index]), 'um', 2)}"
    degrees = (number(value, "deg", 0) for value in (extent.angle, extent.low, extent.high))
    return (depth, *degrees, number(extent.area, "mm", 4), number(extent.mass, "1", 3))


def _sentence(worn: Worn) -> str:
    text = tr(
        (
            "Measured from the pin's positions over {} {}: the envelope of the pin's circle,"
            " against the same bushing when it was new. The uncertainty (k = 2) holds noise,"
            " wear before the reference and elastic indentation, not that of the probes'"
            " calibration. Angles that the pin never reached are unknown and not drawn. Depth,"
            " area and mass cover what was reached. 0° is the initial contact point, in the"
            " follower's frame."
        ),
        worn.averaged,
        tr("revolution" if worn.averaged == 1 else "revolutions"),
    )
    if np.isfinite(worn.run_out):
        text += tr(" A run-out of {} µm was taken out.", number(worn.run_out, "um", 1))
    if np.isfinite(worn.approach_change):
        change = number(worn.approach_change, "um", 1)
        note = tr("this was taken out") if worn.corrected else tr("this was left in")
        text += tr(" By the model the elastic approach has changed by {} µm; {}.", change, note)
    if not worn.centred and np.isfinite(worn.run_out):
        text += tr(
            " The zero of the probes is not at the bushing's centre, so the direction comes"
            " from the forces: the flanks are less certain."
        )
    return text


def picture(worn: Worn) -> Figure:
    """Draw the worn profile: measured with its uncertainty, and modelled."""
    with canvas_of(3.0) as canvas:
        axes = canvas.subplots()
        shades = np.linspace(0.78, 0.5, max(len(worn.stages), 1))
        for shade, (revolution, depth) in zip(shades, worn.stages, strict=False):
            axes.plot(worn.angle, 1e3 * depth, color=str(shade), lw=0.8, label=grouped(revolution))
        measured = 1e3 * worn.curves["measured"]
        uncertainty = 1e3 * worn.uncertainty
        axes.fill_between(
            worn.angle, np.maximum(measured - uncertainty, 0.0), measured + uncertainty,
            color=plots.COLOURS["force"], alpha=0.15, lw=0,
        )  # fmt: skip
        axes.plot(worn.angle, measured, color=plots.COLOURS["force"], label="measured")
        axes.plot(worn.angle, 1e3 * worn.curves["predicted"], **MODEL_LINE, label="model")
        axes.plot(
            worn.angle, 1e3 * worn.curves["driven"], color=plots.DRIVEN, ls="-.", lw=1.1,
            label=tr("model by\nmeasured\nforces"),
        )  # fmt: skip
        reach = _extent(worn)
        axes.set_xlim(-reach, reach)
        axes.set_ylim(bottom=0.0)
        axes.set_xlabel(tr("angle from the initial contact point (°), follower frame"))
        axes.set_ylabel(tr("depth of wear (µm)"))
        axes.set_title(tr("after revolution {}", grouped(worn.revolution)), loc="left")
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
        words = tr("Worn profile: ") + " ".join(
            tr("{} at most {} at {}°.", tr(CURVES[name]), _depth(e), number(e.angle, "deg", 0))
            for name, e in worn.extents.items()
        )
        caption = tr(
            "Measured (solid) with its uncertainty (shaded, k = 2), by the model "
            "(dashed), by the model from the measured forces (dash-dotted); grey: "
            "measured earlier, after the revolution named."
        )
        return saved(canvas, tr("Worn profile of the bushing"), words, caption)


def _depth(extent: Extent) -> str:
    text = number(1e3 * extent.depth, "um", 2)
    return text if text == tr(UNKNOWN) else f"{text} µm"


def _extent(profile: Worn) -> float:
    """Return the angle, in steps of 30 degrees, that includes the visible wear."""
    depth = np.fmax.reduce([np.nan_to_num(curve) for curve in profile.curves.values()])
    worn = np.flatnonzero(depth > 0.005 * max(float(depth.max()), 1e-12))
    furthest = float(np.abs(profile.angle[worn]).max(initial=0.0))
    return float(min(180.0, 30.0 * np.ceil((furthest + 5.0) / 30.0)))
