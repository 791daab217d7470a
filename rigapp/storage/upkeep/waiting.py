"""Find the whole cycles that a killed writer left: those that waited, and those not yet counted."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rigapp.storage.reading.reader import StoredCycle, TestReader
from rigapp.storage.reading.verify import wrong_rows
from rigapp.storage.structure.checksum import cycle_checksum
from rigapp.storage.structure.layout import WAITING_FIELDS

LAST, BEFORE = "last", "before"
"""Why a cycle is kept that nothing wanted yet: it is the last whole one, or came before the end."""


def left_cycles(reader: TestReader, cycles: int, last: int) -> list[StoredCycle]:
    """Return the confirmed cycles after the first ``cycles`` ones, in order.

    last: the last committed revolution; later ones are measured anew. Files of before have none.
    """
    if not reader.plan.checksums:
        return []
    newest = int(reader.cycle_revolutions()[cycles - 1]) if cycles else 0
    found = {one.revolution: one for one in _waiting(reader)}
    found |= {one.revolution: one for one in _uncounted(reader, cycles)}
    return [found[number] for number in sorted(found) if newest < number <= last]


def _waiting(reader: TestReader) -> Iterator[StoredCycle]:
    """Yield the confirmed cycles that waited in the file, in any order."""
    if not reader.has("waiting"):
        return
    fields = reader.fields("waiting")
    columns, checksums = reader.raw_rows("waiting", 0, reader.plan.waiting_cycles)
    newest = max((int(one) for one in columns[0]), default=0)
    for slot, checksum in enumerate(checksums):
        values = {one.name: column[slot] for one, column in zip(fields, columns, strict=True)}
        count = int(values["count"])
        samples = {one.name: values[one.name][:count] for one in fields if one.shape}
        if count <= 0 or cycle_checksum(samples.values(), WAITING_FIELDS, values) != checksum:
            continue
        number, why = int(values["revolution"]), bytes(values["why"]).decode("ascii", "replace")
        why = why or (LAST if number == newest else BEFORE)
        yield StoredCycle(number, samples, why, int(values["quality"]), reader.plan.table)


def _uncounted(reader: TestReader, cycles: int) -> Iterator[StoredCycle]:
    """Yield the confirmed cycles that follow the counted ones without a gap."""
    names = [one.name for one in reader.fields("cycles")]
    samples = [one.name for one in reader.fields("samples")]
    first, capacity = reader.first_free_sample(cycles), reader.declared("cycles")
    for index in range(cycles, capacity):
        columns, _ = reader.raw_rows("cycles", index, index + 1)
        row = {name: column[0] for name, column in zip(names, columns, strict=True)}
        if int(row["first"]) != first or wrong_rows(reader, "cycles", index, index + 1).size:
            return
        first += int(row["count"])
        values, _ = reader.raw_rows("samples", int(row["first"]), first)
        yield StoredCycle(
            int(row["revolution"]),
            dict(zip(samples, (np.array(one) for one in values), strict=True)),
            bytes(row.get("why", b"scheduled")).decode("ascii", "replace"),
            int(row.get("quality", 0)),
            reader.plan.table,
        )
