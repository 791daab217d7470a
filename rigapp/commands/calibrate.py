"""`rigapp calibrate`: fit recorded readings, judge them, keep an immutable record."""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Mapping, Sequence
from importlib import metadata
from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from calibration.load_cell import LoadCellCalibration, calibrate_load_cell
from calibration.problems import Problem
from calibration.readings import ReadingsError, parse_load_cell
from calibration.records import seal
from calibration.settings import LoadCellSettings
from rigapp.config.calibration_settings import (
    LoadCellFile,
    ProbeFile,
    RunOutFile,
    read_load_cell_settings,
)
from rigapp.config.errors import UnusableInput
from rigapp.config.reading import read_text


def calibrate_cell(readings: Path, settings: Path, to: Path, *, as_json: bool) -> int:
    """Fit load-cell readings; keep a record when they are good; return the exit status."""
    given, meaning = read_load_cell_settings(settings)
    text = read_text(readings)
    try:
        taken = parse_load_cell(text)
    except ReadingsError as error:
        raise UnusableInput(f"{readings}: {error}.") from error
    refuse_existing(to)
    found = calibrate_load_cell(taken, meaning)
    result = load_cell_result(found, meaning)
    if found.accepted:
        keep_record(to, "load cell", text, given, result)
    say_result(result, to, as_json=as_json, lines=cell_lines(found, meaning))
    return 0 if found.accepted else 1


def load_cell_result(found: LoadCellCalibration, settings: LoadCellSettings) -> dict[str, Any]:
    """Return what ``--json`` prints and the record keeps, units in the keys."""
    fit, traits, budget = found.fit, found.traits, found.budget
    result: dict[str, Any] = {
        "accepted": found.accepted,
        "problems": _problems(found.problems),
        "classification": found.classification,
        "full_scale_N": settings.cell.full_scale,
    }
    if fit is None or traits is None or budget is None or found.covariance is None:
        return {
            **result,
            "matrix_N_per_unit": None,
            "zero": None,
            "residual_std_N": None,
            "expanded_uncertainty_N": None,
            "coverage_factor": None,
        }
    line = found.expanded_line or (budget.expanded, 0.0)
    return {
        **result,
        "terms": found.terms,
        "matrix_N_per_unit": fit.matrix.tolist(),
        "matrix_covariance": found.covariance.tolist(),
        "matrix_standard_uncertainty_N_per_unit": np.sqrt(np.diag(found.covariance))
        .reshape(2, 2)
        .tolist(),
        "zero": fit.zero.tolist(),
        "sensitivity_unit_per_N": fit.sensitivity.tolist(),
        "quadratic_unit_per_N2": None if fit.quadratic is None else fit.quadratic.tolist(),
        "residual_std_N": fit.residual_std,
        "expanded_uncertainty_N": budget.expanded,
        "coverage_factor": budget.coverage_factor,
        "uncertainty_line_N": {"constant_N": line[0], "per_N": line[1]},
        "budget": [
            {"name": one.name, "standard_uncertainty_N": one.uncertainty}
            for one in budget.contributions
        ],
        "characteristics_percent": {
            "reproducibility_b": traits.reproducibility,
            "repeatability_b_prime": traits.repeatability,
            "interpolation_fc": traits.interpolation,
            "zero_return_f0": traits.zero_return,
            "reversibility_v": traits.reversibility,
            "creep_c": None,
        },
        "zero_drift_N": traits.drift,
        "applied_N": found.applied.tolist(),
        "residual_N": fit.residual.tolist(),
    }


def _problems(problems: Sequence[Problem]) -> list[dict[str, Any]]:
    return [{"code": one.code, "sentence": one.sentence, "blocks": one.blocks} for one in problems]


def refuse_existing(to: Path) -> None:
    """Refuse a record that exists or has no folder; raise UnusableInput."""
    if os.path.lexists(to):
        raise UnusableInput(f"{to}: exists; records are never overwritten, name another file.")
    if not to.parent.is_dir():
        raise UnusableInput(f"{to}: the folder {to.parent} does not exist; make it first.")


def keep_record(
    to: Path,
    kind: str,
    readings: str,
    settings: LoadCellFile | ProbeFile | RunOutFile,
    result: Mapping[str, Any],
    taken: Mapping[str, Any] | None = None,
) -> None:
    """Write the record so that it is there whole or not at all, and read-only.

    taken: how the readings were taken, for those that the program took itself.
    """
    now = int(time.time())
    content = {
        "kind": kind,
        "calibrated_at": _day(now),
        "due_at": _day(now + 86400 * settings.paperwork.valid_days),
        "software": f"rigapp {metadata.version('rigapp')}",
        "settings": msgspec.to_builtins(settings),
        "readings_csv": readings,
        "result": dict(result),
    }
    if taken is not None:
        content["taken"] = dict(taken)
    part = to.with_name(f".{to.name}.part-{os.getpid()}")
    try:
        with part.open("xb") as stream:
            stream.write(seal(content))
            stream.flush()
            os.fsync(stream.fileno())
        part.chmod(0o444)
        os.link(part, to)
    except OSError as error:
        raise UnusableInput(f"{to}: cannot be written ({error}).") from error
    finally:
        part.unlink(missing_ok=True)


def _day(seconds: int) -> str:
    return time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(seconds))


def say_result(result: Mapping[str, Any], to: Path, *, as_json: bool, lines: Sequence[str]) -> None:
    """Print a result and its problems."""
    if as_json:
        print(json.dumps(result))
    else:
        for line in lines:
            print(line)
    for problem in result["problems"]:
        if not as_json:
            mark = "" if problem["blocks"] else "note: "
            print(f"rigapp: {mark}{problem['sentence']}", file=sys.stderr)
    if not result["accepted"]:
        print("rigapp: the calibration is refused, nothing was saved.", file=sys.stderr)
    elif not as_json:
        print(f"The record is {to}.")


def cell_lines(found: LoadCellCalibration, settings: LoadCellSettings) -> list[str]:
    """Return the result in words and numbers, a line each."""
    if found.fit is None or found.budget is None or found.expanded_line is None:
        return [found.classification]
    unit = settings.cell.signal_unit
    rows = [
        "    " + "  ".join(f"{value:12.5f}" for value in row) for row in found.fit.matrix.tolist()
    ]
    zero = ", ".join(f"{value:.6f}" for value in found.fit.zero)
    constant, slope = found.expanded_line
    return [
        f"Force on the pin = matrix (signal - zero), pin frame; matrix in N per {unit}:",
        *rows,
        f"Zero: {zero} {unit}.  Model: {found.terms}.",
        f"Residual standard deviation: {found.fit.residual_std:.3f} N.",
        f"Expanded uncertainty at {found.budget.force:g} N: {found.budget.expanded:.2f} N"
        f" (k = {found.budget.coverage_factor:.2f}); U(F) = {constant:.2f} N + {slope:.5f} F.",
        found.classification,
    ]


def write_certificate(record: Path, to: Path) -> int:
    """Write the certificate of a record as PDF or HTML; return the exit status."""
    from calibration.records import RecordError, unseal
    from rigapp.report.certificate import certificate_of
    from rigapp.report.html import as_html
    from rigapp.report.pdf import as_pdf

    writers = {".pdf": as_pdf, ".html": as_html}
    writer = writers.get(to.suffix.lower())
    if writer is None:
        raise UnusableInput(f"{to}: a certificate is .pdf or .html; name it so.")
    try:
        sealed = unseal(record.read_bytes())
    except FileNotFoundError as error:
        raise UnusableInput(f"{record}: there is no such record; check the name.") from error
    except (OSError, RecordError) as error:
        raise UnusableInput(f"{record}: {error}.") from error
    try:
        to.write_bytes(writer(certificate_of(sealed)))
    except OSError as error:
        raise UnusableInput(f"{to}: cannot be written ({error}).") from error
    print(f"The certificate is {to}.")
    return 0
