"""Calibration as a library: readings and settings in, fits with their uncertainty out.

These names stay; what stands in ``calibration`` itself may change from version to version.
``docs/calibration.md`` says what is fitted and what is judged.
"""

from __future__ import annotations

import os
from pathlib import Path

from rigapp.calibrating.verification import Verification, verify
from rigapp.config.calibration_settings import (
    LoadCellFile,
    ProbeFile,
    load_cell_meaning,
    probe_meaning,
)
from rigapp.config.loading import read_document
from rigapp_calibration.load_cell.calibrate import LoadCellCalibration, calibrate_load_cell
from rigapp_calibration.load_cell.force_uncertainty import ForceUncertainty, force_uncertainty
from rigapp_calibration.load_cell.readings import LoadCellReadings, parse_load_cell
from rigapp_calibration.load_cell.settings import LoadCellSettings
from rigapp_calibration.probes.calibrate import ProbeCalibration, calibrate_probe
from rigapp_calibration.probes.readings import ProbeReadings, ProbeSettings, parse_probe
from rigapp_calibration.records import Record, RecordError, unseal
from rigapp_calibration.taking.readings import ReadingsError

__all__ = [
    "ForceUncertainty",
    "LoadCellCalibration",
    "LoadCellReadings",
    "LoadCellSettings",
    "ProbeCalibration",
    "ProbeReadings",
    "ProbeSettings",
    "ReadingsError",
    "Record",
    "RecordError",
    "Verification",
    "calibrate_load_cell",
    "calibrate_probe",
    "force_uncertainty",
    "load_cell_settings",
    "parse_load_cell",
    "parse_probe",
    "probe_settings",
    "unseal",
    "verify",
]


def load_cell_settings(path: str | os.PathLike[str]) -> LoadCellSettings:
    """Read the settings of a load cell's calibration; raise UnusableInput."""
    return load_cell_meaning(read_document(Path(path), LoadCellFile).record, str(path))


def probe_settings(path: str | os.PathLike[str]) -> ProbeSettings:
    """Read the settings of a probe's calibration; raise UnusableInput."""
    return probe_meaning(read_document(Path(path), ProbeFile).record)
