"""The certificate says what ISO/IEC 17025, 7.8, asks for; what is missing makes it a draft."""

from __future__ import annotations

import datetime
import io
import json
from dataclasses import replace
from pathlib import Path

import msgspec
import numpy as np
import pytest
from pypdf import PdfReader

from rigapp.calibrating.certificate import certificate_of, write_certificate
from rigapp.calibrating.records import keep_record
from rigapp.calibrating.subjects import SUBJECTS
from rigapp.config.calibration_settings import (
    CellSection,
    LoadCellFile,
    PaperworkSection,
    PlaceSection,
    Standard,
    WeightPiece,
    WeightsSection,
)
from rigapp.config.errors import UnusableInput
from rigapp.report.page.document import as_html
from rigapp.report.page.pdf import as_pdf
from rigapp_calibration.load_cell.budget import classification
from rigapp_calibration.records import seal, unseal
from tests.calibration.independent_coverage import PLAIN, readings_of
from tests.calibration.pinned import FOLDER
from tests.calibration.simulated_cell import SETTINGS, Cell, take
from tests.calibration.test_commands import as_csv
from tests.calibration.test_verify import GIVEN
from tests.calibration.time_domain_cell import Course, TimeCell
from tests.calibration.time_domain_cell import take as take_in_time

PIECE = WeightPiece("A1", 5.0, "M-2026-0417", datetime.date(2027, 4, 30), 0.4)
WHOLE = msgspec.structs.replace(
    GIVEN,
    weights=WeightsSection(piece=(PIECE,)),
    place=PlaceSection(
        gravity_m_s2=9.8123,
        temperature_degC=21.4,
        temperature_at_end_degC=22.0,
        humidity_percent=45.0,
    ),
    standard=(Standard("spirit level", "L-77", datetime.date(2026, 1, 31), "0.02 deg"),),
    paperwork=PaperworkSection(
        laboratory="Laboratory of Tribology",
        serial_number="PLC 0007",
        condition_as_received="clean, cable renewed",
        calibrated_on=datetime.date(2026, 3, 2),
    ),
)


def made(folder: Path, given: LoadCellFile, heaviest: float = 40.0, angles: int = 4) -> Path:
    """Return the record of a calibration up to a mass, kg."""
    text = as_csv(take(Cell(), np.random.default_rng(4), angles=angles, heaviest=heaviest))
    fit = SUBJECTS["load cell"].fit
    assert fit is not None
    outcome = fit(text, given, "here", "")
    assert outcome.accepted, outcome.result["problems"]
    keep_record(folder / "record.json", outcome.kind, text, given, outcome.result)
    return folder / "record.json"


def words_of(record: Path) -> str:
    return as_html(certificate_of(unseal(record.read_bytes()))).decode()


def test_a_whole_certificate_says_what_an_assessor_asks_for(tmp_path: Path) -> None:
    record = made(tmp_path, WHOLE, heaviest=25.0)
    words = words_of(record)
    for needed in (
        "Laboratory of Tribology", "PLC 0007", "2026-03-02",
        "21.4 °C at the beginning, 22 °C at the end", "45 %", "clean, cable renewed",
        "v, reversibility (hysteresis)",
        "A1, 5 kg", "M-2026-0417", "2027-04-30", "U = 0.4 g (k = 2)", "L-77",
        "Calibrated range: 0.0 N to 245.3 N, 6 loads at 4 pin angles",
        "Results by load", "Uncertainty of the zero", "degrees of freedom", "rectangular",
        "not signed", "Above 245 N it is extrapolated",
        "The certificate L-77 of spirit level had expired on 2026-01-31, before the calibration.",
    ):  # fmt: skip
        assert needed in words, needed
    assert "DRAFT" not in words
    result = json.loads(record.read_bytes())["result"]
    notes = [one["sentence"] for one in result["problems"]]
    assert notes  # 245 N of 400 N: a note says so
    html = words.replace("&#39;", "'")
    assert all(f"Note: {one}" in html for one in notes)
    # Full scale was not reached: its row of the results, of U by load, and its budget say so.
    assert words.count(">extrapolated") >= 3
    for what in ("a component in its worst direction", "|F|"):
        assert f"Budget of one reading of {what} at 400 N EXTRAPOLATED" in words
    assert "creep" in words


def test_u_of_the_calibration_and_u_in_use_are_two_statements(tmp_path: Path) -> None:
    record = made(tmp_path, WHOLE)
    words, result = words_of(record), json.loads(record.read_bytes())["result"]
    own = result["of_calibration"]
    for needed in (
        "The expanded uncertainty of the calibration, of one reading at the time",
        "The expanded uncertainty in use is U(F) =",
        "Calibration: Budget of one reading of |F| at 392",
        "In use: Budget of one reading of |F| at 400 N",
        "Expanded uncertainty of the calibration by load",
        "Expanded uncertainty in use by load",
        "Changes that U in use holds",
    ):
        assert needed in words, needed
    assert (
        own["magnitude"]["expanded_uncertainty_N"] < result["magnitude"]["expanded_uncertainty_N"]
    )
    later = {"creep", "temperature, gain", "change until the next calibration"}
    for of, there in ((own, False), (result, True)):
        sizes = {one["name"]: one["standard_uncertainty_N"] for one in of["magnitude"]["budget"]}
        assert all((sizes[name] > 0.0) is there for name in later), sizes


@pytest.mark.parametrize(("full", "step", "shown"), [(5.0, 5e-5, "0.00005 N"), (2e4, 0.2, "0.2 N")])
def test_the_sentence_on_the_class_has_numbers_without_exponents(
    full: float, step: float, shown: str
) -> None:
    sentence = classification(
        replace(SETTINGS, cell=replace(SETTINGS.cell, full_scale=full, resolution=step)), 1e-4
    )
    assert shown in sentence
    assert "e-" not in sentence
    coarse = replace(SETTINGS.cell, full_scale=full, resolution=0.01 * full)
    assert f"{0.2 * full:g} N upward" in classification(replace(SETTINGS, cell=coarse), 1e-4)


def test_the_results_by_load_are_those_of_the_readings(tmp_path: Path) -> None:
    record = made(tmp_path, WHOLE)
    (table,) = (
        block
        for section in certificate_of(unseal(record.read_bytes())).sections
        for block in section.blocks
        if getattr(block, "title", "").startswith("Results by load")
    )
    rows = {row[0]: row for row in table.rows}
    assert list(rows) == ["0.00", "78.49", "156.97", "235.46", "313.95", "392.43", "400.00"]
    for applied, count, indicated, error, across, largest, expanded, mark in table.rows[:-1]:
        assert int(count) == (4 if applied == "392.43" else 8)
        assert float(indicated) - float(applied) == pytest.approx(float(error), abs=0.105)
        assert abs(float(across)) < float(expanded)
        assert float(largest) < 2.0 * float(expanded)
        assert mark == ""
    assert rows["400.00"][1:6] == ("–",) * 5
    assert rows["400.00"][7] == "extrapolated, U in use"


@pytest.mark.sampled
@pytest.mark.parametrize(
    ("change", "mark"),
    [
        ({"laboratory": ""}, "DRAFT, the laboratory not stated"),
        ({"serial_number": ""}, "DRAFT, the serial number not stated"),
        ({}, ""),
    ],
)
def test_every_page_of_a_draft_says_so(tmp_path: Path, change: dict[str, str], mark: str) -> None:
    paper = msgspec.structs.replace(WHOLE.paperwork, **change)
    record = made(tmp_path, msgspec.structs.replace(WHOLE, paperwork=paper))
    data = as_pdf(certificate_of(unseal(record.read_bytes())))
    pages = PdfReader(io.BytesIO(data)).pages
    for number, page in enumerate(pages, 1):
        text = page.extract_text()
        assert f"page {number} of {len(pages)}" in text
        assert ("DRAFT" in text) == bool(mark)
        assert mark in text
    assert write_certificate(record, tmp_path / "c.html") == mark


def test_the_date_of_issue_is_the_records_or_is_given(tmp_path: Path) -> None:
    record = made(tmp_path, WHOLE)
    write_certificate(record, tmp_path / "c.html", datetime.date(2026, 4, 1))
    assert "<td>2026-04-01</td>" in (tmp_path / "c.html").read_text()
    with pytest.raises(UnusableInput, match="the calibration is of 2026-03-02"):
        write_certificate(record, tmp_path / "c.html", datetime.date(2026, 3, 1))
    with pytest.raises(UnusableInput, match="in the future"):
        write_certificate(record, tmp_path / "c.html", datetime.date(2999, 1, 1))


def test_a_date_of_calibration_in_the_future_is_refused(tmp_path: Path) -> None:
    paper = msgspec.structs.replace(WHOLE.paperwork, calibrated_on=datetime.date(2999, 1, 1))
    with pytest.raises(UnusableInput, match="calibrated_on = 2999-01-01 is in the future"):
        made(tmp_path, msgspec.structs.replace(WHOLE, paperwork=paper))


def test_the_worst_piece_counts_unless_the_set_is_stated() -> None:
    assert WeightsSection().relative_uncertainty == 5e-5
    better = WeightPiece("B1", 1.0, "M-2", datetime.date(2027, 1, 1), 0.01)
    assert WeightsSection(piece=(PIECE, better)).relative_uncertainty == pytest.approx(4e-5)
    stated = WeightsSection(piece=(PIECE,), relative_standard_uncertainty=1e-4)
    assert stated.relative_uncertainty == 1e-4


def test_an_uncertainty_that_says_nothing_is_refused(tmp_path: Path) -> None:
    given = msgspec.structs.replace(
        GIVEN, angle=msgspec.structs.replace(GIVEN.angle, standard_uncertainty_deg=9.9)
    )
    text = as_csv(take(Cell(), np.random.default_rng(4), angles=4))
    fit = SUBJECTS["load cell"].fit
    assert fit is not None
    outcome = fit(text, given, "here", "")
    assert not outcome.accepted
    (problem,) = (one for one in outcome.result["problems"] if one["code"] == "too_uncertain")
    assert "The largest part is angle reference" in problem["sentence"]


def test_the_certificate_of_a_record_of_before_is_made(tmp_path: Path) -> None:
    content = json.loads((FOLDER / "2" / "load_cell.json").read_bytes())
    for key in ("digest", "number", "schema", "evaluation", "recorded_at"):
        del content[key]
    settings, result = content["settings"], content["result"]
    settings["weights"] = {
        "mass_kind": "conventional", "density_kg_per_m3": 8000.0, "hanger_mass_kg": 0.0,
        "density_standard_uncertainty_kg_per_m3": 100.0, "relative_standard_uncertainty": 5e-5,
    }  # fmt: skip
    del settings["standard"]
    for key in ("address", "customer", "calibrated_on"):
        del settings["paperwork"][key]
    result["budget"] = [
        {"name": "fit", "standard_uncertainty_N": result["expanded_uncertainty_N"] / 2.0}
    ]
    for key in [one for one in result if one.startswith("zero_exp")] + ["uncertainty_by_load"]:
        del result[key]
    old = tmp_path / "old.json"
    old.write_bytes(seal(content))
    write_certificate(old, tmp_path / "c.html")
    words = (tmp_path / "c.html").read_text()
    assert "made by evaluation 1" in words
    assert "the uncertainty cannot be verified" in words


@pytest.mark.sampled
@pytest.mark.parametrize(("full", "decimals"), [(5.0, 3), (400.0, 2), (20e3, 0)])
def test_numbers_are_rounded_by_u_whatever_the_cell_bears(
    tmp_path: Path, full: float, decimals: int
) -> None:
    """A pin of 0.2 % of full scale: no error of any load, U in two figures."""
    nature = replace(PLAIN, full_scale=full, noise=4e-4, pin=0.002)
    cell = TimeCell(nature, np.random.default_rng(3))
    text = as_csv(readings_of(take_in_time(cell, Course())))
    section = CellSection("cell", full, max(1e-6, 1e-5 * full))
    given = msgspec.structs.replace(WHOLE, cell=section)
    fit = SUBJECTS["load cell"].fit
    assert fit is not None
    outcome = fit(text, given, "here", "")
    assert outcome.accepted, outcome.result["problems"]
    keep_record(tmp_path / "record.json", outcome.kind, text, given, outcome.result)
    (table,) = (
        block
        for section in certificate_of(unseal((tmp_path / "record.json").read_bytes())).sections
        for block in section.blocks
        if getattr(block, "title", "").startswith("Results by load")
    )
    for row in table.rows[:-1]:
        error, across, largest, expanded = map(str, row[3:7])
        assert len(expanded.replace(".", "").lstrip("0")) == 2, expanded
        assert abs(float(error)) < float(expanded)
        assert abs(float(across)) < float(expanded)
        assert float(largest) < 2.0 * float(expanded)
    assert len(table.rows[-1][6].partition(".")[2]) == decimals
    words = words_of(tmp_path / "record.json")
    assert "Weight that turns with the pin, taken out of the indications" in words
    assert "agreed" not in words
    assert "counter(page)" in words


def test_an_angle_that_nobody_referred_to_is_said_to_be_outside_of_u(tmp_path: Path) -> None:
    words = words_of(made(tmp_path, WHOLE))
    stated = WHOLE.angle.offset_deg is not None
    assert ("U holds it by the uncertainty of the angle reference" in words) is stated
    assert ("no angle reference was taken: U does not hold it" in words) is not stated
