"""What the calibration says of the uncertainty of a force, U(F) = constant + part of the force."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from calibration.records import RecordError, unseal

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class ForceUncertainty:
    """The expanded uncertainty of one force: constant_N + per_N |F|; ``source`` says so."""

    constant_N: float
    per_N: float
    factor: float
    source: str

    def at(self, force: NDArray[Any]) -> Floats:
        """Return the expanded uncertainty of forces, N."""
        return self.constant_N + self.per_N * np.abs(np.asarray(force, dtype=np.float64))

    @property
    def words(self) -> str:
        """Return the line as it is printed."""
        line = f"{self.constant_N:.2f} N + {self.per_N:.5f} |F|"
        return f"U(F) = {line}, k = {self.factor:.2f} ({self.source})"


def force_uncertainty(
    calibration: Mapping[str, Any], configuration: Mapping[str, Any]
) -> ForceUncertainty | None:
    """Return the uncertainty that a file states, or None.

    By the calibration record of the load cell, else by ``uncertainty_N`` of the rig file.
    """
    return _of_record(calibration) or _of_rig(str(configuration.get("rig", "")))


def _of_rig(text: str) -> ForceUncertainty | None:
    try:
        constant, share = tomllib.loads(text)["load_cell"]["uncertainty_N"]
        found = ForceUncertainty(float(constant), float(share), 2.0, "rig file")
    except (tomllib.TOMLDecodeError, KeyError, TypeError, ValueError):
        return None
    return found if np.isfinite([found.constant_N, found.per_N]).all() else None


def _of_record(calibration: Mapping[str, Any]) -> ForceUncertainty | None:
    kept = calibration.get("record_load_cell")
    text = kept.get("record", "") if isinstance(kept, Mapping) else ""
    try:
        record = unseal(str(text).encode())
        result = record.content["result"]
        line = result["uncertainty_line_N"]
        found = ForceUncertainty(
            float(line["constant_N"]),
            float(line["per_N"]),
            float(result["coverage_factor"]),
            f"record {record.number}",
        )
    except (RecordError, KeyError, TypeError, ValueError):
        return None
    return found if np.isfinite([found.constant_N, found.per_N, found.factor]).all() else None
