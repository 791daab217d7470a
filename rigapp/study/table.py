"""The results of a study as a table: netCDF that xarray opens, and CSV."""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray
from numpy.typing import NDArray

from rigapp.config.writing import whole_file
from rigapp.schema.units import unit_of_key
from rigapp.study.design import Design, Value
from rigapp.study.file import StudyFile
from rigapp.study.folder import CSV, NOT_COMPUTED, SENSITIVITY, TABLE
from rigapp.study.journal import StudyIdentity
from rigapp.study.kinds import KINDS
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
    """Write ``table.nc`` and ``table.csv``, in place of those of before; return their paths.

    known: ``sensitivities``.
    """
    table = dataset(study, design, rows, known)
    table.attrs = {
        "title": f"study: {study.kind}",
        "study": identity.study,
        "parameters": identity.parameters,
        "source": f"rigapp {identity.version}",
    }
    found = [folder / TABLE, folder / CSV]
    for path, write in zip(found, (_netcdf, _csv), strict=True):
        with whole_file(path) as part:
            write(table, part)
    return found


def dataset(
    study: StudyFile, design: Design, rows: Mapping[int, StudyRow], known: Mapping[str, Indices]
) -> xarray.Dataset:
    """Return a row a point over ``point``, and what the results depend on over ``parameter``.

    Points that are not computed yet, and those without a result, are NaN; ``problem`` says why.
    """
    keys = list(design.points[0].values) if design.points else []
    columns: dict[str, Any] = {}
    for key in keys:
        values = np.array([one.values[key] for one in design.points])
        unit = unit_of_key(key).words if values.dtype.kind == "f" else ""
        columns[key] = ("point", values, {"units": unit or "1", "role": "parameter"})
    for one in KINDS[study.kind].results:
        about = {"units": one.unit, "long_name": one.words, "role": "result"}
        columns[one.name] = ("point", result(one.name, design, rows), about)
    problems = [_problem(rows.get(one.number)) for one in design.points]
    about = {"long_name": "why there is no result", "role": "problem"}
    columns["problem"] = ("point", np.array(problems, dtype=object), about)
    table = xarray.Dataset(columns, {"point": [one.number for one in design.points]})
    return table.merge(_sensitivity_columns(keys, known)) if known else table


def _problem(row: StudyRow | None) -> str:
    return NOT_COMPUTED if row is None else row.problem


def result(name: str, design: Design, rows: Mapping[int, StudyRow]) -> NDArray[np.float64]:
    """Return a result at each point, NaN where there is none."""
    found = (rows.get(one.number) for one in design.points)
    return np.array([row.numbers.get(name, math.nan) if row else math.nan for row in found])


def sensitivities(
    study: StudyFile, design: Design, rows: Mapping[int, StudyRow]
) -> dict[str, Indices]:
    """Return what each result depends on, by its name; nothing where the design does not tell."""
    keys = len(design.points[0].values) if design.points else 0
    if not design.blocks:
        return {}
    found = {}
    for one in KINDS[study.kind].results:
        values = result(one.name, design, rows)[: design.blocks * (keys + 2)]
        indices = indices_of(values.reshape(keys + 2, design.blocks), study.design.seed)
        if indices is not None:
            found[one.name] = indices
    return found


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
            np.array([getattr(one, name) for one in known.values()]),
            {"units": "1", "long_name": text, "role": "sensitivity"},
        )
        for name, text in words.items()
    }
    return xarray.Dataset(columns, {"result": list(known), "parameter": keys})


def _netcdf(table: xarray.Dataset, path: Path) -> None:
    table.to_netcdf(path, engine="h5netcdf")


def _csv(table: xarray.Dataset, path: Path) -> None:
    names = ["point", *(name for name, one in table.data_vars.items() if one.dims == ("point",))]
    columns: list[list[Value]] = [table[name].values.tolist() for name in names]
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(names)
        writer.writerows(zip(*columns, strict=True))
