"""Results of ``rigapp.open`` and ``rigapp.open_many``: a recorded test, and many in one table."""

from __future__ import annotations

import datetime
import glob
import importlib
import os
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import xarray
from numpy.typing import NDArray

from rigapp.analysis.backend import ROWS, RigappBackend
from rigapp.config.errors import UnusableInput, from_extra
from rigapp.report.results import result_of
from rigapp.schema.results import NOT_READABLE
from rigapp.storage import open_test

if TYPE_CHECKING:
    from rigapp.analysis.pictures import Pictures

Method = Literal["linear", "band-limited"]
Paths = str | os.PathLike[str] | Iterable[str | os.PathLike[str]]


class RecordedTest:
    """A test file, running, interrupted or ended; each access returns the present content.

    Each dataset holds the committed rows, with ``units`` and ``long_name``, dates as
    ``datetime64``. Columns are read on demand; of a running test a dataset keeps its
    length, and the next one has the newer rows too. No file is held open.
    """

    def __init__(self, path: str | os.PathLike[str], chunks: int | None = None) -> None:
        """Open a test; raise UnusableInput for another file, and for chunks without Dask."""
        self.path = Path(path)
        self._chunks = chunks
        self._held: dict[str, tuple[object, xarray.Dataset]] = {}
        if chunks is not None:
            _require_dask(chunks)
        with open_test(self.path) as reader:
            self._title = str(reader.metadata()["title"])

    def __repr__(self) -> str:
        return f"<rigapp test {self._title!r}: {self.path}, {self.status}>"

    @property
    def revolutions(self) -> xarray.Dataset:
        """Return maximum, minimum, RMS, mean of every channel over ``revolution``."""
        return self._dataset("revolutions")

    @property
    def cycles(self) -> xarray.Dataset:
        """Return the samples of the whole cycles over ``sample``, and an index over ``revolution``.

        A contiguous ragged array, as in the file; ``cycle`` and ``even_cycles`` split it.
        """
        return self._dataset("cycles")

    @property
    def prediction(self) -> xarray.Dataset:
        """Return the twin's predictions over ``revolution``, curves over ``curve_revolution``."""
        return self._dataset("prediction")

    @property
    def events(self) -> xarray.Dataset:
        """Return the log over ``event``; ``data`` is JSON."""
        return self._dataset("events")

    @property
    def profiles(self) -> xarray.Dataset:
        """Return the worn profiles in mm over ``revolution`` and ``angle``."""
        return self._dataset("profiles")

    @property
    def configuration(self) -> dict[str, Any]:
        """Return the texts ``rig`` and ``test``, ``parameters`` and ``versions``."""
        with open_test(self.path) as reader:
            return reader.configuration()

    @property
    def calibration(self) -> dict[str, Any]:
        """Return the calibration records of the test."""
        with open_test(self.path) as reader:
            return reader.calibration()

    @property
    def status(self) -> str:
        """Return running, complete, stopped or interrupted."""
        return str(self.info["status"])

    @property
    def info(self) -> dict[str, Any]:
        """Return the output of ``rigapp info``, and title, people, specimen and times."""
        with open_test(self.path) as reader:
            return {**reader.metadata(), **reader.summary()}

    @property
    def plot(self) -> Pictures:
        """Return the plots of the test."""
        from rigapp.analysis.pictures import Pictures

        return Pictures(self.path)

    def cycle(self, revolution: int) -> xarray.Dataset:
        """Return one whole cycle over its ``sample``; raise UnusableInput when it is not stored."""
        cycles = self.cycles
        places = np.flatnonzero(cycles["revolution"].values == revolution)
        if places.size == 0:
            raise UnusableInput(
                f"{self.path}: of revolution {revolution} no whole cycle is kept;"
                " test.cycles.revolution tells which are"
            )
        cycle = cycles.isel(revolution=int(places[-1]))
        first = int(cycle["first"])
        return cycle.isel(sample=slice(first, first + int(cycle["count"])))

    def even_cycles(self, points: int = 360, method: Method = "linear") -> xarray.Dataset:
        """Return the whole cycles over ``revolution`` and ``angle``, with ``points`` angles a turn.

        method: linear, or band-limited for spectra and differences. ``force`` is |F| of the
        components on these angles; raw signals and sample times are left out. Raises ValueError for
        fewer than 2 points.
        """
        source = self.cycles
        with open_test(self.path) as reader:
            cycles = [cycle.resampled(points, method).columns for cycle in reader.cycles()]
            revolutions = reader.cycle_revolutions()
        count = min(len(cycles), source.sizes["revolution"])
        names = [name for name in (cycles[0] if cycles else {}) if name != "angle"]
        result = {
            name: (
                ("revolution", "angle"),
                np.stack([cycle[name] for cycle in cycles[:count]]),
                source[name].attrs,
            )
            for name in names
        }
        angle = 360.0 / points * np.arange(points)
        about = {"units": "deg", "long_name": "crank angle"}
        return xarray.Dataset(
            result, {"revolution": revolutions[:count], "angle": ("angle", angle, about)}
        )

    def _dataset(self, group: str) -> xarray.Dataset:
        with open_test(self.path) as reader:
            streams = ("revolutions", "cycles", "prediction", "curves", "events", "profiles")
            rows = tuple(reader.committed(stream) for stream in streams if reader.has(stream))
        held = self._held.get(group)
        if held is not None and held[0] == rows:
            return held[1]
        chunks = None if self._chunks is None or group == "events" else {ROWS[group]: self._chunks}
        result = xarray.open_dataset(self.path, engine=RigappBackend, group=group, chunks=chunks)
        self._held[group] = (rows, result)
        return result


class RecordedTests(Sequence[RecordedTest]):
    """Test files in the order of their names; ``table`` holds their results.

    Datasets are the concatenated ones of all tests; the coordinate ``test`` names the file of
    each row. Unreadable files are only in the table, with the reason.
    """

    def __init__(self, paths: Paths, chunks: int | None = None) -> None:
        """Open tests by a pattern or paths; raise UnusableInput if there are none."""
        self.paths = _files(paths)
        self._results = [result_of(path) for path in self.paths]
        self._tests = [
            RecordedTest(path, chunks)
            for path, result in zip(self.paths, self._results, strict=True)
            if result.status != NOT_READABLE
        ]

    def __repr__(self) -> str:
        return f"<{len(self)} rigapp tests of {len(self.paths)} files>"

    def __len__(self) -> int:
        return len(self._tests)

    def __getitem__(self, index: Any) -> Any:
        return self._tests[index]

    def __iter__(self) -> Iterator[RecordedTest]:
        return iter(self._tests)

    @property
    def table(self) -> xarray.Dataset:
        """Return one row per file over ``test``: status, specimen, largest force, wear, etc."""
        columns = {
            name: (
                "test",
                _column([getattr(result, field) for result in self._results], name),
                {"long_name": words, **({"units": unit} if unit else {})},
            )
            for name, field, unit, words in _TABLE
        }
        return xarray.Dataset(columns, {"test": [path.stem for path in self.paths]})

    @property
    def revolutions(self) -> xarray.Dataset:
        """Return the revolutions of all tests."""
        return self._joined("revolutions")

    @property
    def cycles(self) -> xarray.Dataset:
        """Return the samples of the whole cycles of all tests, over ``sample``."""
        return self._joined("cycles")

    @property
    def prediction(self) -> xarray.Dataset:
        """Return the predictions of the twins of all tests, over ``revolution``."""
        return self._joined("prediction")

    @property
    def events(self) -> xarray.Dataset:
        """Return the logs of all tests."""
        return self._joined("events")

    @property
    def profiles(self) -> xarray.Dataset:
        """Return the worn profiles of all tests."""
        return self._joined("profiles")

    @property
    def configuration(self) -> dict[str, dict[str, Any]]:
        """Return the configuration of each test by the name of its file."""
        return {test.path.stem: test.configuration for test in self}

    @property
    def status(self) -> dict[str, str]:
        """Return the status of each file by its name."""
        results = zip(self.paths, self._results, strict=True)
        return {path.stem: result.status for path, result in results}

    def _joined(self, group: str) -> xarray.Dataset:
        """Return the concatenated datasets of a group of all tests."""
        rows = ROWS[group]
        parts = []
        for test in self:
            data: xarray.Dataset = getattr(test, group)
            data = data.drop_dims([name for name in data.dims if name not in (rows, "angle")])
            parts.append(data.assign_coords(test=(rows, [test.path.stem] * data.sizes[rows])))
        if not parts:
            return xarray.Dataset()
        return xarray.concat(
            parts, rows, data_vars="all", coords="minimal", compat="override", join="outer"
        )


_TABLE = (
    ("status", "status", "", "running, complete, stopped, interrupted or not readable"),
    ("reason", "reason", "", "why it ended, or why it cannot be read"),
    ("title", "title", "", "title of the test"),
    ("specimen", "specimen", "", "name of the specimen"),
    ("operator", "operator", "", "who ran it"),
    ("simulated", "simulated", "", "whether the rig was simulated"),
    ("started", "started", "", "beginning, UTC"),
    ("ended", "ended", "", "end, UTC"),
    ("planned", "planned", "1", "revolutions that were planned"),
    ("revolutions", "revolutions", "1", "revolutions that are safe"),
    ("flagged", "flagged", "1", "revolutions with a fault in the data"),
    ("gaps", "gaps", "1", "interruptions"),
    ("cycles_saved", "cycles_saved", "1", "whole cycles kept"),
    ("force_max", "force_max_N", "N", "largest |F| of the test"),
    ("wear_depth", "depth_um", "um", "last measured wear depth"),
    ("wear_depth_uncertainty", "depth_uncertainty_um", "um", "its expanded uncertainty (k = 2)"),
    ("wear_coefficient", "coefficient", "mm^3/(N m)", "wear coefficient"),
    ("wear_coefficient_low", "coefficient_low", "mm^3/(N m)", "lower 95 % limit of it"),
    ("wear_coefficient_high", "coefficient_high", "mm^3/(N m)", "upper 95 % limit of it"),
    ("residual_rms", "residual_rms_N", "N", "RMS of measured minus predicted |F|"),
)
"""Columns of a table of tests: name, field of its result, unit and description."""

_TIMES = ("started", "ended")


def _column(values: list[Any], name: str) -> NDArray[Any]:
    """Return a column of a table; moments as UTC dates, unknown ones as NaT."""
    if name not in _TIMES:
        return np.array(values)
    utc = [
        datetime.datetime.fromisoformat(value).astimezone(datetime.UTC).replace(tzinfo=None)
        if value
        else "NaT"
        for value in values
    ]
    return np.array(utc, dtype="datetime64[us]").astype("datetime64[ns]")


def _files(paths: Paths) -> tuple[Path, ...]:
    """Return the files of a pattern or a folder, or the given ones; raise UnusableInput."""
    if not isinstance(paths, (str, os.PathLike)):
        result = tuple(Path(path) for path in paths)
    elif Path(paths).is_dir():
        result = tuple(sorted(Path(paths).glob("*.h5")))
    else:
        result = tuple(Path(path) for path in sorted(glob.glob(os.fspath(paths), recursive=True)))
    if not result:
        raise UnusableInput(f"{paths}: there are no such files")
    return result


def _require_dask(chunks: int) -> None:
    if chunks < 1:
        raise UnusableInput(f"chunks = {chunks}: give the rows of a piece, 1 or more")
    with from_extra("analysis", f"chunks = {chunks}"):
        importlib.import_module("dask.array")
