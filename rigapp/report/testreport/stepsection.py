"""The section of a report about the steps of a test: what was measured in each of them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rigapp.presentation.numbers import grouped
from rigapp.report.page.manuscript import Section, Table, Text
from rigapp.report.steps import sequence_of, step_numbers
from rigapp.report.testreport.facts import mean
from rigapp.report.testreport.wording import number
from rigapp.schema.messages import NOT_STEADY
from rigapp.storage import TestReader

HEADER = (
    "step", "set speed, rpm", "revolutions", "judged", "speed, rpm", "largest |F|, N",
    "mean of the maxima of |F|, N", "mean RMS of |F|, N", "mean residual, RMS, N",
)  # fmt: skip


def step_section(reader: TestReader) -> list[Section]:
    """Return the table of the steps, nothing for a test without them."""
    sequence, rows = sequence_of(reader), reader.committed()
    if sequence is None or not rows:
        return []
    revolutions = reader.column("revolution", 0, rows).astype(np.int64)
    judged = (reader.column("quality", 0, rows).astype(np.int64) & NOT_STEADY) == 0
    of = step_numbers(sequence, revolutions)
    columns = {
        name: reader.column(name, 0, rows).astype(float)
        for name in ("speed", "force_max", "force_rms")
    }
    columns["residual"] = _residuals(reader, revolutions)
    table = []
    for step in range(1, sequence.count + 1):
        mine = of == step
        if not mine.any():
            continue
        good = mine & judged
        stage = sequence.at(int(revolutions[mine][0]))
        peak = float(columns["force_max"][good].max()) if good.any() else float("nan")
        table.append(
            (
                f"{step} {stage.name}".rstrip(),
                number(stage.speed_rpm),
                grouped(int(np.count_nonzero(mine))),
                grouped(int(np.count_nonzero(good))),
                number(mean(columns["speed"][good])),
                number(peak),
                *(
                    number(mean(columns[one][good]))
                    for one in ("force_max", "force_rms", "residual")
                ),
            )
        )
    told = "Judged are revolutions at a steady speed, between the ramps and without a pause."
    return [Section("Steps", (Table("", tuple(table), HEADER), Text(told)))]


def _residuals(reader: TestReader, revolutions: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the RMS of measured minus predicted |F| of each revolution, NaN where none is."""
    found = np.full(len(revolutions), np.nan)
    table = reader.predictions()
    if "residual_rms" in table:
        places = np.searchsorted(revolutions, table["revolution"].astype(np.int64))
        inside = places < len(revolutions)
        same = inside.copy()
        same[inside] = revolutions[places[inside]] == table["revolution"][inside]
        found[places[same]] = table["residual_rms"][same]
    return found
