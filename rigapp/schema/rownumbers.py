"""Revolution numbers of the rows of a test: nearly always consecutive, so stored as runs."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, overload

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Places = NDArray[np.int64]


class RowNumbers:
    """The ascending revolution numbers of rows as runs, two numbers each.

    It reads as an array of float64 (n,): 10^7 rows of a test that was never interrupted need one
    run in place of 80 MB. limit: number of visible rows; None: all.
    """

    def __init__(self) -> None:
        self._rows: Places = np.zeros(0, np.int64)
        self._numbers: Floats = np.zeros(0)
        self._size = 0
        self.limit: int | None = None

    def extend(self, numbers: NDArray[np.generic]) -> None:
        """Append the numbers of further rows, (n,)."""
        values = np.asarray(numbers, dtype=np.float64)
        if not len(values):
            return
        before = self._last() if self._size else values[0] - 2.0
        breaks = np.flatnonzero(np.diff(values, prepend=before) != 1.0)
        if breaks.size:
            self._rows = np.append(self._rows, self._size + breaks)
            self._numbers = np.append(self._numbers, values[breaks])
        self._size += len(values)

    def follow(self, first: float, count: int) -> None:
        """Append ``count`` rows with consecutive numbers from ``first`` on."""
        self.extend(np.array([first]))
        self._size += count - 1

    @property
    def breaks(self) -> Places:
        """Return the rows whose number does not follow the previous one, the first row included."""
        return self._rows

    def _last(self) -> float:
        return float(self._numbers[-1] + (self._size - 1 - self._rows[-1]))

    def __len__(self) -> int:
        return self._size if self.limit is None else min(self.limit, self._size)

    @overload
    def __getitem__(self, rows: int) -> float: ...

    @overload
    def __getitem__(self, rows: NDArray[Any] | slice | list[int]) -> Floats: ...

    def __getitem__(self, rows: Any) -> Any:
        size = len(self)
        if isinstance(rows, slice):
            return self._at(np.arange(*rows.indices(size), dtype=np.int64))
        places = np.asarray(rows)
        if places.dtype == bool:
            places = np.flatnonzero(places)
        places = np.where(places < 0, places + size, places).astype(np.int64)
        if places.size and not 0 <= int(places.min()) <= int(places.max()) < size:
            raise IndexError(rows)
        result = self._at(places)
        return result if result.ndim else float(result)

    def _at(self, places: Places) -> Floats:
        run = np.searchsorted(self._rows, places, side="right") - 1
        return np.asarray(self._numbers[run] + (places - self._rows[run]), dtype=np.float64)

    def __iter__(self) -> Iterator[float]:
        return iter(self[:].tolist())

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        return self[:].astype(dtype or np.float64, copy=False)

    def searchsorted(self, number: float, side: str = "left") -> int:
        """Return the row before which a number belongs, like ``numpy.searchsorted``."""
        run = int(np.searchsorted(self._numbers, number, side="right")) - 1
        if run < 0 or not len(self):
            return 0
        first = int(self._rows[run])
        end = int(self._rows[run + 1]) if run + 1 < len(self._rows) else self._size
        into = float(number) - float(self._numbers[run])
        rows = np.ceil(into) if side == "left" else np.floor(into) + 1.0
        return int(min(first + min(rows, end - first), len(self)))
