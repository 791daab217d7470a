"""Up to where the measured wear depth of a test is believed."""

from __future__ import annotations

import numpy as np

from rigapp.schema.alarms import UNBELIEVED
from rigapp.schema.loglines import alarm_change
from rigapp.storage.reading.reader import TestReader


def believed_until(reader: TestReader) -> int | None:
    """Return the last revolution whose measured wear depth is believed, None where all are.

    The alarm comes some revolutions later: the twin lags. What lies nearer to the depth of the
    alarm than to the last believed one is not believed.
    """
    for event in reader.events():
        change = alarm_change(event)
        if change is None or change.what != "raised" or event.key not in UNBELIEVED:
            continue
        table = reader.predictions()
        number, depth = table["revolution"], 1e3 * table["measured_wear_depth"]
        known = np.flatnonzero(np.isfinite(depth) & (number <= event.revolution))
        if change.value is None or not known.size:
            return 0
        near = np.abs(depth[known] - change.value) <= np.abs(depth[known] - depth[known[-1]])
        believed = known[near]
        return int(number[believed[-1]]) if believed.size else 0
    return None
