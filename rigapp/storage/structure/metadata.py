"""The metadata of a test file, gathered before the first sample."""

from __future__ import annotations

import importlib.metadata
import platform
import re
import sys
import uuid
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from typing import Any

from rigapp.schema.units import unit_of_key

_RATE = re.compile(r"(?:^|_)([A-Za-z]+)_per$")
"""A key without its last unit, which divides another: ``speed_limit_count_per`` (``_s``)."""


@dataclass(frozen=True, slots=True)
class TestMetadata:
    """The texts, records and names of a test.

    rig_text, test_text: the TOML files unchanged. parameters: the model's, units in the keys.
    calibration: record name -> nested mapping of numbers, lists and texts, frozen for the test.
    detectors: the same for ``load_cell``, ``probes``, ``encoder``.
    started: UTC seconds since 1970-01-01, 0 for now.
    """

    __test__ = False

    title: str
    rig_text: str
    test_text: str
    parameters: Mapping[str, Any] = field(default_factory=dict)
    calibration: Mapping[str, Any] = field(default_factory=dict)
    detectors: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    rig_name: str = ""
    operator: str = ""
    specimen: str = ""
    bushing: str = ""
    notes: str = ""
    simulated: bool = False
    started: float = 0.0
    identifier: str = field(default_factory=lambda: str(uuid.uuid4()))


def versions() -> dict[str, str]:
    """Return the versions of the software that writes the file."""
    result = {"python": platform.python_version(), "platform": platform.platform()}
    for name in ("rigapp", "numpy", "h5py", "numba", "msgspec"):
        try:
            result[name] = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            result[name] = "unknown"
    result["executable"] = sys.implementation.name
    return result


def file_unit(key: str) -> str:
    """Return the unit at the end of a key of the configuration, "1" without one."""
    unit = unit_of_key(key)
    words = unit.words if unit.file is None else unit.file
    rate = _RATE.search(key.removesuffix(unit.ending)) if unit.ending else None
    return f"{rate[1]}/{words}" if words and rate is not None else words or "1"


def name_and_unit(key: str) -> tuple[str, str]:
    """Split a key into name and unit; an unknown unit stays in the name."""
    unit = file_unit(key)
    places = [i for i, letter in enumerate(key) if letter == "_" and file_unit(key[i:]) == unit]
    if unit == "1" or not places or key[: places[-1]].endswith("_per"):
        return key, "1"
    return key[: places[-1]], unit


def unit_suffix(unit: str) -> str:
    """Return a unit as the suffix of a column's name: ``_mV_per_V``, empty for "1"."""
    if unit in ("", "1"):
        return ""
    return "_" + unit.replace("/", "_per_").replace(" ", "").replace("%", "percent")


def iso_time(seconds: float) -> str:
    """Return UTC seconds since 1970-01-01 as ISO 8601 with microseconds and ``+00:00``."""
    return datetime.fromtimestamp(seconds, UTC).isoformat(timespec="microseconds")
