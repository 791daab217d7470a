"""What a column says of itself beyond unit and sentence: times and flags as CF has them, and the
detector that it comes from as NeXus has it."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from rigapp.engine.messages import Flag
from rigapp.storage.layout import DETECTORS, Field, Stream

UTC = {
    "units": "seconds since 1970-01-01 00:00:00",
    "standard_name": "time",
    "calendar": "standard",
}
"""CF: UTC seconds; other programs make dates of it."""

_UTC_COLUMNS = frozenset({("revolutions", "host_time"), ("events", "time")})

_MEASURED = frozenset({"revolutions", "samples", "unfinished_samples"})
"""Streams whose columns come from a detector."""

_SOURCES = (
    (re.compile(r"(raw_)?force(_|$)"), "load_cell"),
    (re.compile(r"(raw_)?probe_"), "probes"),
    (re.compile(r"angle$|speed|raw_count$"), "encoder"),
)


def conventions(stream: Stream, field: Field) -> dict[str, Any]:
    """Return further attributes of a column."""
    found: dict[str, Any] = {}
    if (stream.name, field.name) in _UTC_COLUMNS:
        found |= UTC
    if field.name == "quality":
        found |= _flags(field.dtype)
    source = next((name for pattern, name in _SOURCES if pattern.match(field.name)), "")
    if source and stream.name in _MEASURED:
        found["detector"] = f"{DETECTORS}/{source}"
    return found


def _flags(dtype: str) -> dict[str, Any]:
    return {
        "flag_masks": np.array([flag.value for flag in Flag], dtype),
        "flag_meanings": " ".join(str(flag.name).lower() for flag in Flag),
    }
