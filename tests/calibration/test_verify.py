"""A record follows from its own readings, or it is found out: before use, certificate, by hand."""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rigapp.calibrating.certificate import write_certificate
from rigapp.calibrating.load_cell_result import fit_load_cell
from rigapp.calibrating.records import keep_record
from rigapp.calibrating.records_in_use import with_records
from rigapp.calibrating.running_check import running_result, runs_csv
from rigapp.calibrating.subjects import SUBJECTS
from rigapp.calibrating.verification import verified, verify
from rigapp.commands.calibrate import make_key, sign_record, verify_record
from rigapp.config.calibration_settings import (
    CellSection,
    LoadCellFile,
    PlaceSection,
    ProbeFile,
)
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp_calibration.load_cell.readings import LOAD_CELL_COLUMNS
from rigapp_calibration.records import seal, unseal
from rigapp_calibration.taking.readings import read_table
from rigapp_calibration.turning.running_check import Known, SpeedRun, running_check
from tests.calibration.pinned import FOLDER
from tests.calibration.simulated_cell import Cell, take
from tests.calibration.test_commands import as_csv
from tests.calibration.test_probe_certificates import ANGLE, csv_of, run_out
from tests.calibration.test_probe_certificates import readings as probe_readings

RIG = Path(__file__).parents[2] / "examples" / "simulated.toml"
GIVEN = LoadCellFile(
    schema=1, cell=CellSection(name="pin load cell"), place=PlaceSection(gravity_m_s2=9.8123)
)


@pytest.fixture(scope="module")
def sealed(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """Return the record of a good calibration."""
    text = as_csv(take(Cell(), np.random.default_rng(4), angles=4))
    outcome = fit_load_cell(read_table(text, LOAD_CELL_COLUMNS), GIVEN, "here")
    path = tmp_path_factory.mktemp("sealed") / "record.json"
    keep_record(path, outcome.kind, text, GIVEN, outcome.result)
    return path.read_bytes()


def changed(sealed: bytes, change: Callable[[dict[str, Any]], None]) -> bytes:
    """Return a record whose content was changed and sealed again, as a forger would."""
    content = json.loads(sealed)
    content = {key: content[key] for key in content if key not in ("digest", "number", "schema")}
    change(content)
    return seal(content)


def kept(folder: Path, data: bytes) -> Path:
    (folder / "record.json").write_bytes(data)
    return folder / "record.json"


def gain(content: dict[str, Any], factor: float) -> None:
    matrix = content["result"]["matrix_N_per_unit"]
    matrix[0][0] *= factor


def forge_matrix(content: dict[str, Any]) -> None:
    gain(content, 1.01)


def forge_uncertainty(content: dict[str, Any]) -> None:
    content["result"]["uncertainty_line_N"]["constant_N"] = 0.01


def forge_reading(content: dict[str, Any]) -> None:
    lines = content["readings_csv"].splitlines()
    lines[5] = lines[5].replace(",1,", ",1,").rpartition(",")[0] + ",0.001"
    content["readings_csv"] = "\n".join(lines) + "\n"


def test_an_honest_record_agrees_in_every_number(sealed: bytes) -> None:
    found = verified(sealed)
    assert found.compared > 20
    assert found.differences == found.unverified == ()
    assert verified(sealed) is found  # each record is fitted once


@pytest.mark.parametrize(
    ("forge", "named"),
    [
        (forge_matrix, "matrix_N_per_unit: the record states"),
        (forge_uncertainty, "uncertainty_line_N.constant_N: the record states 0.01"),
        (forge_reading, "residual_N"),
    ],
)
def test_a_record_that_was_sealed_again_is_found_out(
    sealed: bytes, tmp_path: Path, capsys: pytest.CaptureFixture[str], forge: Any, named: str
) -> None:
    path = kept(tmp_path, changed(sealed, forge))
    assert verify_record(path, as_json=False) == 1
    assert named in capsys.readouterr().err
    with pytest.raises(UnusableInput, match="there is no certificate of it"):
        write_certificate(path, tmp_path / "c.html")
    assert not (tmp_path / "c.html").exists()
    (tmp_path / "rig.toml").write_text(
        RIG.read_text().replace("[probes]", 'calibration = "record.json"\n[probes]')
    )
    blocking = with_records(read_rig(tmp_path / "rig.toml")).blocking["load_cell"]
    assert "does not follow from its readings" in blocking
    assert named in blocking


def test_a_record_that_was_only_edited_is_told_from_one_that_is_none(
    sealed: bytes, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = kept(tmp_path, sealed.replace(b'"N"', b'"M"').replace(b"pin load cell", b"new cell", 1))
    assert verify_record(path, as_json=False) == 1
    assert "was changed after it was made" in capsys.readouterr().err
    path.write_text("{}")
    with pytest.raises(UnusableInput, match="not a calibration record"):
        verify_record(path, as_json=False)


def test_a_record_of_an_older_evaluation_is_used_and_says_what_is_not_verified(
    tmp_path: Path,
) -> None:
    sealed = (FOLDER / "2" / "load_cell.json").read_bytes()

    def older(content: dict[str, Any]) -> None:
        del content["evaluation"]
        content["result"]["uncertainty_line_N"]["constant_N"] = 0.9
        content["result"]["expanded_uncertainty_N"] = 1.25

    found = verify(unseal(changed(sealed, older)))
    assert found.differences == ()
    assert found.compared == 3
    assert "the uncertainty cannot be verified: it states U = 1.25 N" in found.unverified[0]
    kept(tmp_path, changed(sealed, older))
    (tmp_path / "rig.toml").write_text(
        RIG.read_text().replace("[probes]", 'calibration = "record.json"\n[probes]')
    )
    used = with_records(read_rig(tmp_path / "rig.toml"))
    assert not used.blocking
    assert "it states U = 1.25 N" in used.remarks["load_cell"]
    assert used.rig.record.load_cell.uncertainty_N[0] == 0.9

    def older_and_untrue(content: dict[str, Any]) -> None:
        older(content)
        gain(content, 1.005)

    assert "matrix_N_per_unit" in verify(unseal(changed(sealed, older_and_untrue))).differences[0]


def test_a_record_without_its_readings_says_so(sealed: bytes) -> None:
    found = verify(unseal(changed(sealed, lambda content: content.pop("readings_csv"))))
    assert found.unverified == ("The record holds no readings: its result cannot be verified.",)


@pytest.mark.parametrize(("days", "refused"), [(0.9, False), (1.1, True), (400.0, True)])
def test_a_record_of_the_future_is_refused(
    sealed: bytes, tmp_path: Path, capsys: pytest.CaptureFixture[str], days: float, refused: bool
) -> None:
    def later(content: dict[str, Any]) -> None:
        when = time.gmtime(time.time() + 86400.0 * days)
        content["calibrated_at"] = time.strftime("%Y-%m-%dT%H:%M:%SZ", when)

    path = kept(tmp_path, changed(sealed, later))
    assert verify_record(path, as_json=True) == int(refused)
    told = json.loads(capsys.readouterr().out)
    assert told["verified"] is not refused
    (tmp_path / "rig.toml").write_text(
        RIG.read_text().replace("[probes]", 'calibration = "record.json"\n[probes]')
    )
    blocking = with_records(read_rig(tmp_path / "rig.toml")).blocking
    assert ("in the future" in str(blocking)) is refused


@pytest.mark.parametrize("which", ["1", "both"])
def test_records_of_probes_are_fitted_again(tmp_path: Path, which: str) -> None:
    given = ProbeFile(schema=1)
    tables = [probe_readings(1)] if which == "1" else [probe_readings(1), probe_readings(2)]
    text = csv_of(*tables)
    fit = SUBJECTS["probes"].fit
    assert fit is not None
    outcome = fit(text, given, "here", which)
    keep_record(tmp_path / "probe.json", outcome.kind, text, given, outcome.result)
    data = (tmp_path / "probe.json").read_bytes()
    found = verified(data)
    assert found.compared > 5
    assert found.differences == ()

    def forge(content: dict[str, Any]) -> None:
        result = content["result"]
        result.get("probes", [result])[-1]["sensitivity_um_per_V"] *= 1.001

    assert (
        "sensitivity_um_per_V: the record states" in verified(changed(data, forge)).differences[0]
    )


def test_a_laboratory_signs_and_anyone_can_see_whose_signature_it_is(
    sealed: bytes, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, signed = kept(tmp_path, sealed), tmp_path / "signed.json"
    key, public = tmp_path / "lab.key", tmp_path / "lab.pub"
    assert make_key(key) == 0
    assert key.stat().st_mode & 0o777 == 0o600
    assert sign_record(path, key, signed) == 0
    assert path.read_bytes() == sealed
    assert unseal(signed.read_bytes()).number == unseal(sealed).number
    assert verify_record(signed, public, as_json=False) == 0
    assert "It is signed by the key" in capsys.readouterr().out
    # Another laboratory's key, no signature, a signature of another record.
    assert make_key(tmp_path / "other.key") == 0
    assert verify_record(signed, tmp_path / "other.pub", as_json=False) == 1
    assert "signed by another key" in capsys.readouterr().err
    assert verify_record(path, as_json=False) == 0
    assert "note: It is not signed" in capsys.readouterr().out
    assert verify_record(path, public, as_json=False) == 1
    (tmp_path / "moved.json").write_bytes(
        seal({**unseal(sealed).content, "software": "other"}, unseal(signed.read_bytes()).signature)
    )
    capsys.readouterr()
    assert verify_record(tmp_path / "moved.json", public, as_json=False) == 1
    assert "signature does not hold" in capsys.readouterr().err


def test_nothing_untrue_is_signed_and_a_key_that_others_read_is_refused(
    sealed: bytes, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    key, signed = tmp_path / "lab.key", tmp_path / "signed.json"
    make_key(key)
    with pytest.raises(UnusableInput, match="never overwritten"):
        make_key(key)
    assert sign_record(kept(tmp_path, changed(sealed, forge_matrix)), key, signed) == 1
    assert "it is not signed: matrix_N_per_unit" in capsys.readouterr().err
    key.chmod(0o640)
    with pytest.raises(UnusableInput, match="chmod 600"):
        sign_record(kept(tmp_path, sealed), key, signed)
    key.chmod(0o600)
    key.write_text("no key")
    with pytest.raises(UnusableInput, match=r"lab\.key: it is no private key"):
        sign_record(kept(tmp_path, sealed), key, signed)
    assert not signed.exists()


@pytest.mark.parametrize("moved", [None, np.outer([8e-6, 1e-6], np.cos(ANGLE))])
def test_a_run_out_map_follows_from_its_revolutions(tmp_path: Path, moved: Any) -> None:
    record = run_out(tmp_path, (0.3, 0.6), moved)
    found = verify(record)
    assert found.differences == found.unverified == ()
    assert found.compared > 10
    content = json.loads(json.dumps(record.content))
    content["result"]["cos_um"][0][0] += 0.01
    assert "cos_um: the record states" in verify(unseal(seal(content))).differences[0]
    # A record of before does not tell the elastic motion: its map is compared, not its U.
    content = json.loads(json.dumps(record.content))
    del content["evaluation"]
    lines = [",".join(line.split(",")[:6]) for line in content["readings_csv"].splitlines()]
    content["readings_csv"] = "\n".join(lines) + "\n"
    old = verify(unseal(seal(content)))
    assert old.differences == ()
    assert "the uncertainty cannot be verified" in old.unverified[0]


def test_a_running_check_follows_from_its_revolutions(tmp_path: Path) -> None:
    known = Known(0.05 * 0.0762, 0.01, 2.0, 0.005)
    rng = np.random.default_rng(3)
    runs = []
    for rpm in (30.0, 240.0):
        speed = np.full(10, rpm * np.pi / 30.0)
        force = np.column_stack((-known.moment * speed**2, np.zeros(10)))
        runs.append(SpeedRun(speed, force + rng.normal(0.0, 0.02, (10, 2)), 0.7))
    result = running_result(running_check(runs, known), known, runs)
    assert result["accepted"]
    keep_record(tmp_path / "check.json", "running check", runs_csv(runs), GIVEN, result)
    data = (tmp_path / "check.json").read_bytes()
    assert verified(data).differences == ()
    assert verified(data).compared > 5

    def forge(content: dict[str, Any]) -> None:
        content["result"]["measured_mass_times_radius_kg_m"] *= 1.01

    assert "measured_mass" in verified(changed(data, forge)).differences[0]
