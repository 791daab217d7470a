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


@dataclass(frozen=True, slots=True)
class PositionUncertainty:
    """The expanded uncertainty of one position of each probe, um."""

    probe_1_um: float
    probe_2_um: float

    def of(self, channel: str) -> float | None:
        """Return that of a channel, um; None for what is no probe."""
        return {"probe_1": self.probe_1_um, "probe_2": self.probe_2_um}.get(channel)

    @property
    def words(self) -> str:
        """Return both as they are printed."""
        return f"± {self.probe_1_um:.2f} µm (probe 1), ± {self.probe_2_um:.2f} µm (probe 2)"


def position_uncertainty(calibration: Mapping[str, Any]) -> PositionUncertainty | None:
    """Return the uncertainty of positions that a file states, or None."""
    probes = calibration.get("probes")
    stated = probes.get("uncertainty_um") if isinstance(probes, Mapping) else None
    try:
        one, two = (float(value) for value in stated)  # type: ignore[union-attr]
    except (TypeError, ValueError):
        return None
    return PositionUncertainty(one, two) if np.isfinite([one, two]).all() else None


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
