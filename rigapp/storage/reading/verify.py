"""Find the parts of a test file that changed since they were written, by checksums and digests."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.storage.reading.reader import TestReader, open_test
from rigapp.storage.reading.streams import StreamReader
from rigapp.storage.structure.checksum import cycle_checksum, row_checksums
from rigapp.storage.structure.hdf import refuse_damage
from rigapp.texts import joined, say, sentence_of_error

ROWS_AT_ONCE = 1 << 14
"""Rows that are read and checked in one piece, 5 MB."""

RAGGED = {"cycles": "samples", "unfinished": "unfinished_samples"}
"""Stream of cycles -> that of its samples."""


def damage_of(path: str | os.PathLike[str]) -> list[str]:
    """Return a sentence for each part of a file that a checksum does not confirm.

    Raises UnusableInput where the file cannot be read at all.
    """
    with open_test(Path(path)) as reader:
        return list(find_damage(reader))


NEWEST_BYTES = 128 << 20
"""Bytes of each stream to check where a whole file would take minutes: 400,000 rows, 700 cycles."""


def find_damage(reader: TestReader, newest_bytes: int | None = None) -> Iterator[str]:
    """Yield a sentence for each part of an open file that a checksum does not confirm.

    newest_bytes: bytes to check at the end of each stream, None: all. Parts of an older file that
    have no checksum are skipped.
    """
    if reader.plan.checksums:
        # Any error of HDF5 here indicates damage: the tree itself may be damaged.
        try:
            same = reader.settings_confirmed()
        except UnusableInput as error:
            yield sentence_of_error(error)
        else:
            if not same:
                yield say("The configuration has changed since the test began.")
    for name in ("revolutions", "cycles", "unfinished", "prediction", "curves", "profiles"):
        if not (reader.has(name) and reader.has_checksum(name)):
            continue
        try:
            rows = reader.committed(name)
            newest = rows if newest_bytes is None else newest_bytes // reader.row_bytes(name)
            first = max(0, rows - newest)
            wrong = wrong_rows(reader, name, first, rows)
        except UnusableInput as error:
            yield sentence_of_error(error)
            continue
        if wrong.size:
            yield say(
                "{} of {} rows of {} are damaged: {}.", wrong.size, rows, _NAMES[name], _few(wrong)
            )
    try:
        altered = reader.first_altered_event()
    except UnusableInput as error:
        yield sentence_of_error(error)
        return
    if altered is not None:
        yield say("The log is damaged from its row {} on.", altered)


_NAMES = {
    "revolutions": say("the revolutions"),
    "cycles": say("the complete cycles"),
    "unfinished": say("the unfinished revolutions"),
    "prediction": say("the prediction"),
    "curves": say("the predicted curves"),
    "profiles": say("the worn profiles"),
}


def _few(rows: NDArray[np.int64]) -> str:
    """Return the first of many rows as text, counted from 0."""
    shown = joined(", ", [str(row) for row in rows[:8]])
    return shown if rows.size <= 8 else say("{} and others", shown)


def wrong_rows(reader: StreamReader, stream: str, first: int, stop: int) -> NDArray[np.int64]:
    """Return the rows ``first`` .. ``stop`` of a stream that their checksum does not confirm."""
    if stream in RAGGED:
        return np.flatnonzero(~_confirmed_cycles(reader, stream, first, stop)) + first
    result = [np.empty(0, np.int64)]
    for start in range(first, stop, ROWS_AT_ONCE):
        end = min(stop, start + ROWS_AT_ONCE)
        columns, stored = reader.raw_rows(stream, start, end)
        with refuse_damage(reader.path, say("its plan")):  # columns may contradict it
            crcs = row_checksums(reader.fields(stream), columns, end - start)
        result.append(np.flatnonzero(crcs != stored) + start)
    return np.concatenate(result)


def _confirmed_cycles(
    reader: StreamReader, stream: str, first: int, stop: int
) -> NDArray[np.bool_]:
    result = np.zeros(stop - first, bool)
    fields = reader.fields(stream)
    columns, stored = reader.raw_rows(stream, first, stop)
    for i, values in enumerate(zip(*columns, strict=True)):
        row = {field.name: value for field, value in zip(fields, values, strict=True)}
        start, count = int(row["first"]), int(row["count"])
        if start < 0 or count < 0:
            continue
        try:
            samples, _ = reader.raw_rows(RAGGED[stream], start, start + count)
        except UnusableInput:
            continue
        result[i] = cycle_checksum(samples, fields, row) == stored[i]
    return result
