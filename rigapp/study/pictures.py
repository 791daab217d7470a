"""Pictures of a study: results against what was varied, and what the results depend on."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from rigapp.report.testreport.plots import COLOURS, MODEL, STYLE
from rigapp.study.design import Design
from rigapp.study.file import StudyFile
from rigapp.study.kinds import KINDS
from rigapp.study.points import StudyRow
from rigapp.study.sensitivity import Indices
from rigapp.study.table import result

MOST_SHOWN = 6
"""Parameters and results beside each other; more cannot be read."""
DPI = 160


def draw_study(
    folder: Path,
    study: StudyFile,
    design: Design,
    rows: Mapping[int, StudyRow],
    known: Mapping[str, Indices],
) -> list[Path]:
    """Draw ``results.png``, and ``sensitivities.png`` where any are known; return them."""
    keys = list(design.points[0].values)[:MOST_SHOWN] if design.points else []
    names = [one.name for one in KINDS[study.kind].results if _varies(one.name, design, rows)]
    files = []
    if keys and names:
        shown = names[:MOST_SHOWN]

        def scatter(canvas: Any) -> None:
            _scatter(canvas, keys, shown, design, rows)

        files.append(_saved(folder / "results.png", (2.4 * len(keys), 1.8 * len(shown)), scatter))
    if known:

        def bars(canvas: Any) -> None:
            panels = canvas.subplots(1, len(known), squeeze=False, sharey=True)[0]
            places = np.arange(len(next(iter(known.values())).total))
            for axes, (name, one) in zip(panels, known.items(), strict=True):
                for shift, what, colour in (
                    (-0.18, "first_order", COLOURS["force_1"]),
                    (0.18, "total", MODEL),
                ):
                    middle, low, high = (
                        getattr(one, f"{what}{end}") for end in ("", "_low", "_high")
                    )
                    reach = np.maximum([middle - low, high - middle], 0.0)
                    label = what.replace("_", " ")
                    axes.barh(places + shift, middle, 0.34, xerr=reach, color=colour, label=label)
                axes.set_title(name, loc="left")
                axes.set_xlabel("share of the variance")
            panels[0].set_yticks(places, list(design.points[0].values))
            panels[0].invert_yaxis()
            canvas.legend(*panels[0].get_legend_handles_labels(), loc="outside upper right")

        size = (1.5 + 2.2 * len(known), 1.2 + 0.4 * len(design.points[0].values))
        files.append(_saved(folder / "sensitivities.png", size, bars))
    return files


def _varies(name: str, design: Design, rows: Mapping[int, StudyRow]) -> bool:
    values = result(name, design, rows)
    known = values[np.isfinite(values)]
    return bool(known.size and np.ptp(known) > 0.0)


def _scatter(
    canvas: Any, keys: list[str], names: list[str], design: Design, rows: Mapping[int, StudyRow]
) -> None:
    grid = canvas.subplots(len(names), len(keys), squeeze=False, sharex="col", sharey="row")
    for name, line in zip(names, grid, strict=True):
        values = result(name, design, rows)
        for key, axes in zip(keys, line, strict=True):
            varied = [one.values[key] for one in design.points]
            axes.plot(varied, values, ".", ms=2.0, color=COLOURS["force_1"])
        line[0].set_ylabel(name)
    for key, axes in zip(keys, grid[-1], strict=True):
        axes.set_xlabel(key)


def _saved(path: Path, size_in: tuple[float, float], draw: Callable[[Any], None]) -> Path:
    import matplotlib
    from matplotlib.figure import Figure as Canvas

    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(STYLE)
        width, height = size_in
        canvas = Canvas(figsize=(max(width, 5.0), max(height, 2.4)), layout="constrained")
        draw(canvas)
        canvas.savefig(path, dpi=DPI, metadata={"Software": None})
    return path
