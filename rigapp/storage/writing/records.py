"""Append records of single revolutions: complete cycles, and the predictions of the twin."""

from __future__ import annotations

import threading
import zlib
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.schema.columns import PROFILE_CURVES, prediction_columns, profile_columns
from rigapp.storage.filesystem.disk import Disk
from rigapp.storage.filesystem.system import FILES
from rigapp.storage.structure.checksum import cycle_checksum
from rigapp.storage.structure.layout import (
    CHECKPOINT_BYTES,
    WAITING_FIELDS,
    FilePlan,
    FileStream,
)
from rigapp.storage.writing.backlog import Backlog
from rigapp.storage.writing.create import (
    Places,
)
from rigapp.storage.writing.streams import (
    Counts,
    RecordPlacer,
    RowBuffer,
)
from rigapp.texts import joined, say


class CycleWriter:
    """Append complete, waiting and unfinished cycles; any thread may call.

    records: of each stream but ``revolutions`` and ``prediction``. counting: held while counts
    change.
    """

    def __init__(
        self,
        backlog: Backlog,
        streams: Mapping[str, FileStream],
        records: Mapping[str, RecordPlacer],
        counts: Counts,
        counting: threading.Lock,
    ) -> None:
        self._backlog = backlog
        self._streams = streams
        self._records = records
        self._counts = counts
        self._count_lock = counting
        self._lock = threading.Lock()
        self._held = 0

    def append(
        self,
        revolution: int,
        columns: Mapping[str, ArrayLike] | NDArray[Any],
        why: str = "scheduled",
        quality: int = 0,
    ) -> bool:
        """Append the samples of a complete cycle; False when there is no reserved space for it.

        columns: name -> (samples,) array, or an array (columns, samples) in the plan's order; must
        not change afterwards, since it is copied only when placed. why, quality: stored where the
        plan has ``cycle_reason``.
        """
        kept = self._append_ragged("cycles", "samples", revolution, columns, why, quality)
        if not kept:
            with self._count_lock:
                self._counts.cycles_refused += 1
        return kept

    def hold(
        self, revolution: int, columns: Mapping[str, ArrayLike], why: str = "", quality: int = 0
    ) -> None:
        """Write a waiting cycle, which may still be stored, over the oldest waiting one.

        It is used only after a crash: see ``rigapp.storage.upkeep.resume``. A cycle longer than
        its slot is skipped. columns: see ``append``. why: the present reason, empty without one.
        """
        stream = self._streams.get("waiting")
        if stream is None:
            return
        values = self._cycle_values(columns)
        number = len(next(iter(values.values())))
        row: dict[str, ArrayLike] = {
            "revolution": [revolution],
            "count": [number],
            "quality": [quality],
            "why": [why],
        }
        sampled = [field for field in stream.fields if field.shape]
        if number > sampled[0].shape[0]:
            return
        with self._lock:
            slot = self._held % stream.capacity
            self._held += 1
            self._backlog.put_later(_size(values), partial(self._place_waiting, slot, values, row))
        self._backlog.assist(2)

    def _place_waiting(
        self, slot: int, values: Mapping[str, NDArray[Any]], row: dict[str, ArrayLike]
    ) -> None:
        stream = self._streams["waiting"]
        samples = {
            field.name: np.ascontiguousarray(values[field.name], field.dtype)
            for field in stream.fields
            if field.shape
        }
        if stream.checksum is not None:
            row[stream.checksum.name] = [cycle_checksum(samples.values(), WAITING_FIELDS, row)]
        self._records["waiting"].place(slot, 1, {**row, **samples}, over=True)

    def append_unfinished(
        self, revolution: int, columns: Mapping[str, ArrayLike], quality: int
    ) -> bool:
        """Append a revolution that was cut off; False when the file has no space for it."""
        if "unfinished" not in self._streams:
            return False
        return self._append_ragged(
            "unfinished", "unfinished_samples", revolution, columns, "", quality
        )

    def _append_ragged(
        self,
        index_name: str,
        samples_name: str,
        revolution: int,
        columns: Mapping[str, ArrayLike] | NDArray[Any],
        why: str,
        quality: int,
    ) -> bool:
        values = self._cycle_values(columns)
        with self._lock:
            counts = self._counts
            first, row = getattr(counts, samples_name), getattr(counts, index_name)
            number = len(next(iter(values.values())))
            samples, index = self._records[samples_name], self._records[index_name]
            if not (samples.holds(first + number) and index.holds(row + 1)):
                return False
            entry: dict[str, list[Any]] = {
                "revolution": [revolution],
                "first": [first],
                "count": [number],
                "quality": [quality],
                "why": [why],
            }
            self._backlog.put_later(
                _size(values),
                partial(self._place_ragged, index_name, samples_name, row, values, entry),
            )
            with self._count_lock:
                setattr(counts, samples_name, first + number)
                setattr(counts, index_name, row + 1)
        self._backlog.assist(2)
        return True

    def _place_ragged(
        self,
        index_name: str,
        samples_name: str,
        row: int,
        values: Mapping[str, NDArray[Any]],
        entry: dict[str, list[Any]],
    ) -> None:
        stored = {
            field.name: np.ascontiguousarray(values[field.name], field.dtype)
            for field in self._streams[samples_name].fields
        }
        self._records[samples_name].place(entry["first"][0], entry["count"][0], stored)
        stream = self._streams[index_name]
        if stream.checksum is not None:
            crc = cycle_checksum(stored.values(), stream.fields, entry)
            entry[stream.checksum.name] = [crc]
        self._records[index_name].place(row, 1, entry)

    def _cycle_values(
        self, columns: Mapping[str, ArrayLike] | NDArray[Any]
    ) -> dict[str, NDArray[Any]]:
        names = [field.name for field in self._streams["samples"].fields]
        if isinstance(columns, Mapping):
            if set(columns) != set(names):
                odd = joined(", ", sorted(set(columns) ^ set(names)))
                raise ValueError(
                    say("a cycle needs exactly the columns of the plan; check {}", odd)
                )
            values = {name: np.asarray(columns[name]) for name in names}
        else:
            values = dict(zip(names, columns, strict=True))
        if len({value.shape for value in values.values()}) != 1:
            raise ValueError(say("the columns of a cycle differ in length"))
        return values


def _size(values: Mapping[str, NDArray[Any]]) -> int:
    return sum(value.nbytes for value in values.values())


class PredictionWriter:
    """Append predictions, curves, worn profiles and checkpoints of the twin; any thread may call.

    rows: buffer of the predictions. For the others see ``CycleWriter``.
    """

    def __init__(
        self,
        plan: FilePlan,
        rows: RowBuffer,
        streams: Mapping[str, FileStream],
        records: Mapping[str, RecordPlacer],
        counts: Counts,
        counting: threading.Lock,
        disk: Disk,
        places: Places,
    ) -> None:
        self._disk = disk
        self._places = places
        self._plan = plan
        self.rows = rows
        self._streams = streams
        self._records = records
        self._counts = counts
        self._count_lock = counting
        known = [column.name for column in prediction_columns()]
        stored = (column.name for column in plan.prediction_columns)
        self._stored = [known.index(name) for name in stored if name in known]
        self._lock = threading.Lock()
        self._checkpoint: tuple[int, bytes] | None = None
        self._slot: int | None = None

    def append(
        self,
        values: NDArray[np.float64] | Sequence[float],
        curves: Mapping[str, ArrayLike] | NDArray[Any] | None = None,
    ) -> bool:
        """Append the twin's prediction of one revolution; False when there is no space.

        values: float64, in the order of the plan's prediction columns, the revolution first; a file
        of an older version stores those of ``prediction_columns`` that it has.
        curves: name -> (points,) array, or (curves, points) in the plan's order, or None.
        """
        kept = curves is None or self.append_curves(int(values[0]), curves)
        if len(values) != len(self._plan.prediction_columns):
            values = np.asarray(values)[self._stored]
        return self.rows.append(values) and kept

    def append_curves(
        self, revolution: int, curves: Mapping[str, ArrayLike] | NDArray[Any]
    ) -> bool:
        """Append the predicted curves of a revolution; False when there is no space."""
        names = self._plan.predicted_curves
        if not isinstance(curves, Mapping):
            curves = dict(zip(names, np.asarray(curves), strict=True))
        values: dict[str, ArrayLike] = {f"curve_{name}": curves[name] for name in names}
        values["curve_revolution"] = [revolution]
        return self._append_record("curves", values)

    def append_profile(
        self, values: NDArray[np.float64] | Sequence[float], curves: Mapping[str, ArrayLike]
    ) -> bool:
        """Append a worn profile; False when there is no space for it, or the file has none.

        values: float64, in the order of ``profile_columns``; curves: mm, by PROFILE_CURVES.
        """
        if "profiles" not in self._streams:
            return False
        names = [column.name for column in profile_columns()]
        columns: dict[str, ArrayLike] = {
            f"profile_{name}": [value] for name, value in zip(names, values, strict=True)
        }
        columns |= {f"profile_{name}": curves[name] for name in PROFILE_CURVES}
        return self._append_record("profiles", columns)

    def _append_record(self, stream: str, values: Mapping[str, ArrayLike]) -> bool:
        """Append a row to a stream of the twin; False when there is no space for it."""
        with self._lock:
            row = getattr(self._counts, stream)
            if not self._records[stream].holds(row + 1):
                return False
            self._records[stream].place(row, 1, values)
            with self._count_lock:
                setattr(self._counts, stream, row + 1)
        return True

    def keep_checkpoint(self, revolution: int, state: bytes) -> None:
        """Take the twin's checkpoint; the next commit writes the newest one to the older slot."""
        if "checkpoints" in self._streams and len(state) <= CHECKPOINT_BYTES:
            with self._lock:
                self._checkpoint = (revolution, state)

    def take_checkpoint(self) -> tuple[int, bytes] | None:
        """Return the checkpoint received since the last call, None without a new one."""
        with self._lock:
            checkpoint, self._checkpoint = self._checkpoint, None
        return checkpoint

    def place_checkpoint(self, checkpoint: tuple[int, bytes]) -> None:
        """Write a checkpoint over the older slot."""
        revolution, state = checkpoint
        values: dict[str, ArrayLike] = {
            "checkpoint_revolution": [revolution],
            "checkpoint_length": [len(state)],
            "checkpoint_crc": [zlib.crc32(state)],
            "checkpoint_state": np.frombuffer(state.ljust(CHECKPOINT_BYTES, b"\0"), np.uint8),
        }
        if self._slot is None:
            offset = self._places["/entry/prediction/checkpoint_revolution"][0]
            first, second = np.frombuffer(FILES.read_at(self._disk.fd, 16, offset), "<i8")
            self._slot = 0 if first <= second else 1
        self._records["checkpoints"].place(self._slot, 1, values, over=True)
        self._slot = 1 - self._slot
