"""Certificates of a pair of probes and of a run-out map: whole, and the same bytes each time."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rigapp.calibrating.certificate import certificate_of
from rigapp.calibrating.probe_result import pair_result, probe_result
from rigapp.calibrating.records import keep_record
from rigapp.calibrating.run_out import harmonics_csv, run_out_lines, run_out_result
from rigapp.config.calibration_settings import ProbeFile, ProbeSection, RunOutFile, RunOutPinSection
from rigapp.report.page.document import as_html
from rigapp.report.page.pdf import as_pdf
from rigapp.twin.predict import DOUBTS
from rigapp_calibration.probes.calibrate import calibrate_pair, calibrate_probe
from rigapp_calibration.probes.readings import ProbeReadings, ProbeSettings
from rigapp_calibration.records import Record, unseal
from rigapp_calibration.turning.run_out import Roll, SlowRevolution, evaluate, make_map

POSITION = np.concatenate((np.linspace(-800e-6, 800e-6, 6), np.linspace(480e-6, -800e-6, 5)))

ANGLE = np.linspace(0.0, 6.2, 120)


def readings(probe: int) -> ProbeReadings:
    rng = np.random.default_rng(probe)
    own = POSITION / 100e-6 + rng.normal(0.0, 1e-3, 11)
    other = 0.02 * POSITION / 100e-6 + rng.normal(0.0, 1e-3, 11)
    return ProbeReadings((f"{probe}.1",) * 11, np.arange(1, 12), POSITION, own, other)


def csv_of(*tables: ProbeReadings) -> str:
    lines = ["series,step,position_um,signal_V,other_signal_V"]
    for one in tables:
        assert one.other is not None
        lines += [
            f"{one.series[i]},{one.step[i]},{1e6 * one.position[i]:.9g},{one.signal[i]:.9g},"
            f"{one.other[i]:.9g}"
            for i in range(11)
        ]
    return "\n".join(lines) + "\n"


def record(folder: Path, kind: str, text: str, given: Any, result: Any, taken: Any) -> Record:
    folder.mkdir(exist_ok=True)
    path = folder / "record.json"
    keep_record(path, kind, text, given, result, taken)
    return unseal(path.read_bytes())


def run_out(folder: Path, speeds: tuple[float, ...], elastic: Any = None) -> Record:
    rng = np.random.default_rng(1)
    rolls = []
    for speed in speeds:
        turns = tuple(
            SlowRevolution(i, ANGLE, evaluate(np.array([[3e-6, 0.0], [0.0, 3e-6]]), ANGLE)
                 + rng.normal(0.0, 1e-7, (2, 120)), elastic=elastic)
            for i in range(10)
        )  # fmt: skip
        rolls.append(Roll("roll", speed, turns))
    found = make_map(rolls, 1, elastic_doubts=DOUBTS)
    assert len(run_out_lines(found)) == (3 if elastic is None else 4)
    files = [
        {
            "name": "a.h5",
            "speed_rpm": one * 30.0 / np.pi,
            "revolutions": 10,
            "sha256_of_samples": "ab" * 32,
        }
        for one in speeds
    ]
    taken = {"rig": "rig", "files": files, "orders": 1}
    given = RunOutFile(schema=1, pin=RunOutPinSection("Pin 7"))
    result = run_out_result(found)
    return record(folder, "run-out map", harmonics_csv(found), given, result, taken)


def test_run_out_certificate_is_whole_and_reproducible(tmp_path: Path) -> None:
    one = run_out(tmp_path, (0.3, 0.6))
    html, pdf = as_html(certificate_of(one)), as_pdf(certificate_of(one))
    assert html == as_html(certificate_of(one))
    assert pdf == as_pdf(certificate_of(one))
    assert pdf.startswith(b"%PDF")
    text = html.decode() if isinstance(html, bytes) else html
    for words in (
        "Certificate of calibration: Pin 7",
        one.number,
        "extrapolated to speed 0",
        "direction of the load was the same",
        "abababababababab",
        "Run-out over the crank angle",
    ):
        assert words in text


def test_run_out_of_one_speed_says_what_it_does_not_know(tmp_path: Path) -> None:
    html = as_html(certificate_of(run_out(tmp_path, (0.3,))))
    text = html.decode() if isinstance(html, bytes) else html
    assert "a motion of the pin by inertia is contained in the map" in text
    assert "Elasticity moves the pin" not in text
    known = run_out(tmp_path / "known", (0.3,), np.outer([8e-6, 0.0], np.cos(ANGLE)))
    html = as_html(certificate_of(known))
    text = html.decode() if isinstance(html, bytes) else html
    assert (
        "model of the unworn bushing this motion, up to 8.000 µm about its mean, was taken" in text
    )


@pytest.mark.sampled
@pytest.mark.parametrize("kind", ["probe", "probe pair"])
def test_probe_certificates_are_whole_and_reproducible(tmp_path: Path, kind: str) -> None:
    settings = ProbeSettings("Probe", 10.0, 0.5e-6)
    given = ProbeFile(schema=1, probe=ProbeSection(name="Lion 3"))
    taken = {
        "rig": "rig", "simulated": True, "operator": "E. Sample", "probes": [1], "positions": 6,
        "runs": 1, "events": [{"event": "reject"}],
    }  # fmt: skip
    if kind == "probe":
        text = csv_of(readings(1))
        result = probe_result(calibrate_probe(readings(1), settings))
    else:
        text = csv_of(readings(1), readings(2))
        pair = calibrate_pair((readings(1), readings(2)), (settings, settings))
        assert pair.accepted, pair.problems
        result = pair_result(pair)
    one = record(tmp_path, kind, text, given, result, taken)
    html = as_html(certificate_of(one))
    assert html == as_html(certificate_of(one))
    words = html.decode() if isinstance(html, bytes) else html
    assert "Certificate of calibration: Lion 3" in words
    assert "SIMULATED rig" in words
    assert "1 series rejected and repeated" in words
    assert "its size in use was not stated" in words
    assert ("Alignment: the target was moved" in words) == (kind == "probe pair")
