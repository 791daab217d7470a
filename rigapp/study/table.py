"""The table of a study, and its pictures."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray
from numpy.typing import NDArray

from rigapp.config.writing import whole_file
from rigapp.report.page.figures import MODEL, in_style
from rigapp.report.testreport.formatting import symbol
from rigapp.report.testreport.plots import COLOURS
from rigapp.schema.units import stem_of, unit_of_key
from rigapp.study.design import Design, Spread, StudyFile, Value, Varied
from rigapp.study.folder import CSV, NOT_COMPUTED, SENSITIVITY, TABLE
from rigapp.study.journal import StudyIdentity
from rigapp.study.kinds import KINDS, Result
from rigapp.study.points import StudyRow
from rigapp.study.sensitivity import Indices, indices_of


def write_tables(
    folder: Path,
    study: StudyFile,
    design: Design,
    identity: StudyIdentity,
    rows: Mapping[int, StudyRow],
    known: Mapping[str, Indices],
) -> list[Path]:
    """Write ``table.nc`` and ``table.csv``, in place of older ones; return their paths.

    known: ``sensitivities``.
    """
    table = dataset(study, design, rows, known)
    table.attrs = {
        "title": f"study: {study.kind}",
        "study": identity.study,
        "parameters": identity.parameters,
        "source": f"rigapp {identity.version}",
    }
    files = [folder / TABLE, folder / CSV]
    for path, write in zip(files, (_netcdf, _csv), strict=True):
        with whole_file(path) as part:
            write(table, part)
    return files


def dataset(
    study: StudyFile, design: Design, rows: Mapping[int, StudyRow], known: Mapping[str, Indices]
) -> xarray.Dataset:
    """Return a row for each point over ``point``, and the sensitivities over ``parameter``.

    Points that are not computed yet, and those without a result, are NaN; ``problem`` says why.
    ``notes`` has the remarks on a result.
    """
    keys = list(design.points[0].values) if design.points else []
    columns: dict[str, Any] = {}
    for key in keys:
        values = np.array([point.values[key] for point in design.points])
        unit = unit_of_key(key).words if values.dtype.kind == "f" else ""
        columns[key] = ("point", values, {"units": unit or "1", "role": "parameter"})
    for quantity in KINDS[study.kind].results:
        about = {"units": quantity.unit, "long_name": str(quantity.words), "role": "result"}
        columns[quantity.name] = ("point", result(quantity.name, design, rows), about)
    problems = [str(_problem(rows.get(point.number))) for point in design.points]
    about = {"long_name": "why there is no result", "role": "problem"}
    columns["problem"] = ("point", np.array(problems, dtype=object), about)
    notes = [row.notes if row else "" for row in map(rows.get, (p.number for p in design.points))]
    about = {"long_name": "what must be known about the results", "role": "notes"}
    columns["notes"] = ("point", np.array(notes, dtype=object), about)
    table = xarray.Dataset(columns, {"point": [point.number for point in design.points]})
    return table.merge(_sensitivity_columns(keys, known)) if known else table


def _problem(row: StudyRow | None) -> str:
    return NOT_COMPUTED if row is None else row.problem


def result(name: str, design: Design, rows: Mapping[int, StudyRow]) -> NDArray[np.float64]:
    """Return a result at each point, NaN where there is none."""
    known_rows = (rows.get(point.number) for point in design.points)
    return np.array([row.numbers.get(name, math.nan) if row else math.nan for row in known_rows])


def sensitivities(
    study: StudyFile, design: Design, rows: Mapping[int, StudyRow]
) -> dict[str, Indices]:
    """Return the sensitivities of each result by name; none where the design has no blocks."""
    keys = len(design.points[0].values) if design.points else 0
    if not design.blocks:
        return {}
    known = {}
    for quantity in KINDS[study.kind].results:
        values = result(quantity.name, design, rows)[: design.blocks * (keys + 2)]
        indices = indices_of(values.reshape(keys + 2, design.blocks), study.design.seed)
        if indices is not None:
            known[quantity.name] = indices
    return known


def _sensitivity_columns(keys: list[str], known: Mapping[str, Indices]) -> xarray.Dataset:
    words = {
        "first_order": "share of the variance by the parameter alone",
        "first_order_low": "lower 95 % limit of it",
        "first_order_high": "upper 95 % limit of it",
        "total": "share of the variance by the parameter with all others",
        "total_low": "lower 95 % limit of it",
        "total_high": "upper 95 % limit of it",
    }
    columns = {
        f"{SENSITIVITY}{name}": (
            ("result", "parameter"),
            np.array([getattr(indices, name) for indices in known.values()]),
            {"units": "1", "long_name": text, "role": "sensitivity"},
        )
        for name, text in words.items()
    }
    return xarray.Dataset(columns, {"result": list(known), "parameter": keys})


def _netcdf(table: xarray.Dataset, path: Path) -> None:
    table.to_netcdf(path, engine="h5netcdf")


def _csv(table: xarray.Dataset, path: Path) -> None:
    columns_of_points = (n for n, c in table.data_vars.items() if c.dims == ("point",))
    names = ["point", *columns_of_points]
    columns: list[list[Value]] = [table[name].values.tolist() for name in names]
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(names)
        writer.writerows(zip(*columns, strict=True))


MOST_SHOWN = 6
"""Parameters and results side by side; more are unreadable."""
DPI = 160
DECADE = 10.0
_AMBIGUOUS = ("youngs_modulus", "poissons_ratio")
"""Keys that are ambiguous without their section: pin and bushing have both."""


def draw_study(
    folder: Path,
    study: StudyFile,
    design: Design,
    rows: Mapping[int, StudyRow],
    known: Mapping[str, Indices],
) -> list[Path]:
    """Draw ``results.png``, and ``sensitivities.png`` where any are known; return them."""
    keys = list(design.points[0].values)[:MOST_SHOWN] if design.points else []
    results = KINDS[study.kind].results
    names = [result.name for result in results if _varies(result.name, design, rows)]
    files = []
    titles = {result.name: _title(result) for result in results}
    if keys and names:
        shown = {name: titles[name] for name in names[:MOST_SHOWN]}
        logarithmic = {key for key in keys if is_logarithmic(study.vary.get(key))}

        def scatter(canvas: Any) -> None:
            _scatter(canvas, keys, shown, design, rows, logarithmic)

        files.append(_saved(folder / "results.png", (2.4 * len(keys), 1.8 * len(shown)), scatter))
    if known:
        labels = [label_of(key, unit=False) for key in design.points[0].values]

        def bars(canvas: Any) -> None:
            panels = canvas.subplots(1, len(known), squeeze=False, sharey=True)[0]
            places = np.arange(len(next(iter(known.values())).total))
            for axes, (name, indices) in zip(panels, known.items(), strict=True):
                for shift, what, colour in (
                    (-0.18, "first_order", COLOURS["force_1"]),
                    (0.18, "total", MODEL),
                ):
                    middle, low, high = (
                        getattr(indices, f"{what}{end}") for end in ("", "_low", "_high")
                    )
                    reach = np.maximum([middle - low, high - middle], 0.0)
                    label = what.replace("_", " ")
                    axes.barh(places + shift, middle, 0.34, xerr=reach, color=colour, label=label)
                axes.set_title(titles[name], loc="left")
                axes.set_xlabel("share of the variance")
            panels[0].set_yticks(places, labels)
            panels[0].invert_yaxis()
            canvas.legend(*panels[0].get_legend_handles_labels(), loc="outside upper right")

        size = (1.5 + 2.2 * len(known), 1.2 + 0.4 * len(design.points[0].values))
        files.append(_saved(folder / "sensitivities.png", size, bars))
    return files


def _varies(name: str, design: Design, rows: Mapping[int, StudyRow]) -> bool:
    values = result(name, design, rows)
    known = values[np.isfinite(values)]
    return bool(known.size and np.ptp(known) > 0.0)


def label_of(key: str, *, unit: bool = True) -> str:
    """Return a dotted key in words, with its unit, as an axis label."""
    section, _, name = key.rpartition(".")
    words = stem_of(name).replace("_", " ")
    if name.startswith(_AMBIGUOUS):
        words = f"{words}, {section.rpartition('.')[2]}"
    shown = unit_of_key(name).words if unit else ""
    return f"{words}, {_printed(shown)}" if shown else words


def is_logarithmic(varied: Varied | None) -> bool:
    """Return whether a parameter was varied in the logarithm, or listed over a decade and more."""
    if isinstance(varied, Spread):
        return varied.scale == "log"
    numbers = [value for value in varied or [] if isinstance(value, int | float)]
    return len(numbers) > 1 and min(numbers) > 0.0 and max(numbers) >= DECADE * min(numbers)


def _printed(unit: str) -> str:
    return symbol(unit).replace("^2", "²").replace("^3", "³")


def _title(result: Result) -> str:
    words = stem_of(result.name).replace("_", " ")
    return words if result.unit in ("", "1") else f"{words}, {_printed(result.unit)}"


def _scatter(
    canvas: Any,
    keys: list[str],
    names: Mapping[str, str],
    design: Design,
    rows: Mapping[int, StudyRow],
    logarithmic: Collection[str],
) -> None:
    """Draw results (name to title) over parameters; some of these in the logarithm."""
    grid = canvas.subplots(len(names), len(keys), squeeze=False, sharex="col", sharey="row")
    for name, line in zip(names, grid, strict=True):
        values = result(name, design, rows)
        for key, axes in zip(keys, line, strict=True):
            varied = [point.values[key] for point in design.points]
            axes.plot(varied, values, ".", ms=2.0, color=COLOURS["force_1"])
        line[0].set_ylabel(names[name])
    for key, axes in zip(keys, grid[-1], strict=True):
        axes.set_xlabel(label_of(key))
        if key in logarithmic:
            axes.set_xscale("log")


def _saved(path: Path, size_in: tuple[float, float], draw: Callable[[Any], None]) -> Path:
    from matplotlib.figure import Figure as Canvas

    with in_style():
        width, height = size_in
        canvas = Canvas(figsize=(max(width, 5.0), max(height, 2.4)), layout="constrained")
        draw(canvas)
        canvas.savefig(path, dpi=DPI, metadata={"Software": None})
    return path
