"""A test file as an xarray backend: its groups as datasets, cut to committed rows, read on demand.

``xarray.open_dataset(file, engine="rigapp", group="revolutions")`` does it for xarray's own users.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray
from numpy.typing import NDArray
from xarray.backends import BackendArray, BackendEntrypoint
from xarray.core import indexing

from rigapp.config.errors import UnusableInput
from rigapp.schema.wire import json_bytes
from rigapp.storage import PROFILE_ANGLE, StoredVariable, TestReader, open_test

ROWS = {
    "revolutions": "revolution",
    "cycles": "sample",
    "prediction": "revolution",
    "events": "event",
    "profiles": "revolution",
}
"""Groups of a test, each with the dimension along which it grows."""

_PROFILE = "profile_"
"""Prefix of the columns of worn profiles in the file, which share a group with the prediction."""


class StoredArray(BackendArray):  # type: ignore[misc]
    """Read a column of a file in pieces; each piece opens the file separately."""

    def __init__(self, path: Path, variable: StoredVariable) -> None:
        self._path, self._variable = path, variable
        self.shape, self.dtype = variable.shape, variable.dtype

    def __getitem__(self, key: indexing.ExplicitIndexer) -> Any:
        return indexing.explicit_indexing_adapter(
            key, self.shape, indexing.IndexingSupport.BASIC, self._read
        )

    def _read(self, key: tuple[Any, ...]) -> Any:
        rows, rest = key[0], key[1:]
        known = self._variable
        with open_test(self._path) as reader:
            if isinstance(rows, slice):
                first, stop, step = rows.indices(self.shape[0])
                values = reader.column(known.name, first, stop, known.stream)[::step]
                return values[(slice(None), *rest)]
            row = int(rows) % self.shape[0]
            return reader.column(known.name, row, row + 1, known.stream)[(0, *rest)]


class RigappBackend(BackendEntrypoint):  # type: ignore[misc]
    """Let xarray open a group of a test file."""

    description = "tests of rigapp, cut to what is safe"
    url = "https://docs.xarray.dev/en/stable/internals/how-to-add-new-backend.html"
    open_dataset_parameters = ("filename_or_obj", "drop_variables", "group")

    def open_dataset(
        self,
        filename_or_obj: str | os.PathLike[str],
        *,
        drop_variables: str | Iterable[str] | None = None,
        group: str = "revolutions",
    ) -> xarray.Dataset:
        """Return a group of a test: revolutions, cycles, prediction, events or profiles.

        Raises UnusableInput for another group, and for a file that is no test.
        """
        if group not in _GROUPS:
            raise UnusableInput(f"group {group!r}: there is no such group; {', '.join(_GROUPS)}")
        path = Path(filename_or_obj)
        with open_test(path) as reader:
            result = _GROUPS[group](reader, path)
        dropped = [drop_variables] if isinstance(drop_variables, str) else drop_variables or ()
        result = result.drop_vars(dropped, errors="ignore")
        return xarray.decode_cf(
            result, mask_and_scale=False, decode_coords=False, decode_timedelta=False
        )

    def guess_can_open(self, filename_or_obj: object) -> bool:
        """Return False: files belong to their formats' engines unless this one is requested."""
        return False


def _variable(path: Path, stored: StoredVariable, dims: tuple[str, ...]) -> xarray.Variable:
    """Return a column that is read on demand; short texts are read at once."""
    values: Any = indexing.LazilyIndexedArray(StoredArray(path, stored))
    if stored.dtype.kind == "S":
        with open_test(path) as reader:
            values = np.char.decode(
                reader.column(stored.name, stream=stored.stream), "utf-8", "replace"
            )
    return xarray.Variable(dims, values, stored.attributes)


def _columns(
    reader: TestReader, path: Path, stream: str, *dims: str, prefix: str = ""
) -> dict[str, xarray.Variable]:
    """Return the columns of a stream by name, one dimension per axis."""
    if not reader.has(stream):
        return {}
    return {
        variable.name.removeprefix(prefix): _variable(path, variable, dims[: len(variable.shape)])
        for variable in reader.variables(stream)
    }


def _angle(values: NDArray[np.float64], words: str) -> xarray.Variable:
    return xarray.Variable("angle", values, {"units": "deg", "long_name": words})


def _revolutions(reader: TestReader, path: Path) -> xarray.Dataset:
    result = _columns(reader, path, "revolutions", "revolution")
    return xarray.Dataset(result).set_coords([name for name in ("host_time",) if name in result])


def _cycles(reader: TestReader, path: Path) -> xarray.Dataset:
    """Return whole cycles as a contiguous ragged array: ``first`` and ``count`` cut it."""
    samples = _columns(reader, path, "samples", "sample")
    revolution = np.repeat(
        reader.cycle_revolutions(), reader.column("count", stream="cycles").astype(np.int64)
    )
    about = {"units": "1", "long_name": "number of the revolution of the sample"}
    samples["sample_revolution"] = xarray.Variable("sample", revolution, about)
    index = _columns(reader, path, "cycles", "revolution")
    index["count"].attrs["sample_dimension"] = "sample"  # CF, chapter 9.3.3
    return xarray.Dataset(samples | index).set_coords(["sample_revolution", "angle"])


def _prediction(reader: TestReader, path: Path) -> xarray.Dataset:
    result = _columns(reader, path, "prediction", "revolution")
    result |= _columns(reader, path, "curves", "curve_revolution", "angle")
    if any("angle" in column.dims for column in result.values()):
        result["angle"] = _angle(reader.angles(), "crank angle")
    return xarray.Dataset(result)


def _events(reader: TestReader, path: Path) -> xarray.Dataset:
    """Return the log, one line per event, regardless of its rows in the file."""
    events = reader.events()
    attributes = reader.attributes("events")
    columns: Mapping[str, Callable[[Any], Any]] = {
        "data": lambda event: json_bytes(event.data).decode() if event.data else "",
    }
    names = ("time", "revolution", "kind", "source", "text", "before", "after", "key", "level")
    result = {}
    for name in (*names, "data"):
        value = columns.get(name, lambda event, name=name: getattr(event, name))
        kind = {"time": "f8", "revolution": "i8"}.get(name, "U")
        values = np.array([value(event) for event in events], dtype=kind)
        result[name] = xarray.Variable("event", values, attributes[name])
    return xarray.Dataset(result).set_coords("time")


def _profiles(reader: TestReader, path: Path) -> xarray.Dataset:
    result = _columns(reader, path, "profiles", "revolution", "angle", prefix=_PROFILE)
    if not result:  # an older file, or a test without a twin
        empty = reader.profiles()
        del empty["angle"]
        dims, about = ("revolution", "angle"), reader.attributes("profiles")
        result = {
            name: xarray.Variable(dims[: values.ndim], values, about[f"{_PROFILE}{name}"])
            for name, values in empty.items()
        }
    result["angle"] = _angle(np.asarray(reader.profiles()["angle"]), PROFILE_ANGLE)
    return xarray.Dataset(result)


_GROUPS: Mapping[str, Callable[[TestReader, Path], xarray.Dataset]] = {
    "revolutions": _revolutions,
    "cycles": _cycles,
    "prediction": _prediction,
    "events": _events,
    "profiles": _profiles,
}
