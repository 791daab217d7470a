"""What a column says of itself beyond unit and sentence.

Times and flags as CF has them, and the detector that it comes from as NeXus has it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from rigapp.schema.channels import ChannelTable
from rigapp.schema.messages import Flag
from rigapp.storage.structure.layout import DETECTORS, FORCE_UNCERTAINTY, FileColumn, FileStream

UTC = {
    "units": "seconds since 1970-01-01 00:00:00",
    "standard_name": "time",
    "calendar": "standard",
}
"""CF: UTC seconds; other programs make dates of it."""

_UTC_COLUMNS = frozenset({("revolutions", "host_time"), ("events", "time")})

_MEASURED = frozenset({"revolutions", "samples", "unfinished_samples"})
"""Streams whose columns come from a detector."""

_OF_ENCODER = ("angle", "raw_count", "speed", "speed_max", "speed_min", "speed_rms")

_FORCE = re.compile(r"force(?P<component>_[12])?(_(?P<statistic>max|min|mean|rms))?")


def detectors(table: ChannelTable) -> dict[str, str]:
    """Return column -> the detector that it comes from: an instrument, or a free channel's own."""
    found = dict.fromkeys(_OF_ENCODER, "encoder")
    for one in table.channels:
        names = (one.name, f"raw_{one.name}", *(column.name for column in one.columns))
        found |= dict.fromkeys(names, one.instrument or one.name)
    return found


def conventions(
    stream: FileStream, field: FileColumn, sources: Mapping[str, str], uncertain: bool = False
) -> dict[str, Any]:
    """Return further attributes of a column.

    sources: ``detectors`` of the file. uncertain: it states the uncertainty of its forces.
    """
    found: dict[str, Any] = {}
    if (stream.name, field.name) in _UTC_COLUMNS:
        found |= UTC
    if field.name == "quality":
        found |= _flags(field.dtype)
    source = sources.get(field.name)
    if source and stream.name in _MEASURED:
        found["detector"] = f"{DETECTORS}/{source}"
    if uncertain and stream.name in _MEASURED:
        found |= _uncertainty(field.name)
    return found


def _uncertainty(name: str) -> dict[str, str]:
    """Return where the uncertainty of a measured force stands, and of what it is."""
    match = _FORCE.fullmatch(name)
    if match is None:
        return {}
    mean = match["statistic"] in ("mean", "rms")
    what = "one component" if match["component"] else "|F|"
    return {
        "uncertainty": FORCE_UNCERTAINTY,
        "uncertainty_of": f"{'a mean of n samples' if mean else 'one sample'} of {what}",
        "uncertainty_samples": "samples" if mean else "1",
    }


def _flags(dtype: str) -> dict[str, Any]:
    return {
        "flag_masks": np.array([flag.value for flag in Flag], dtype),
        "flag_meanings": " ".join(str(flag.name).lower() for flag in Flag),
    }
