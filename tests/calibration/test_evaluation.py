"""What the fits, checks and budgets make of stored readings does not change unnoticed.

Records that an evaluation made stand in ``evaluations``. A change by which the present one would
make other numbers fails here until ``EVALUATION`` is raised and ``tests.calibration.pinned`` has
kept records of the new one: else records in laboratories would no longer follow from their own
readings.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from rigapp.calibrating.verification import KINDS, verify
from rigapp_calibration.load_cell import zeros
from rigapp_calibration.records import EVALUATION, unseal
from tests.calibration import pinned

RECORDS = sorted(pinned.FOLDER.glob("*/*.json"))
RAISE = (
    "the same readings give another result: raise rigapp_calibration.records.EVALUATION, then keep"
    " its records with python -m tests.calibration.pinned"
)


@pytest.mark.parametrize("path", RECORDS, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_readings_give_what_their_evaluation_made_of_them(path: Path) -> None:
    record = unseal(path.read_bytes())
    assert record.evaluation == int(path.parent.name)
    found = verify(record)
    assert found.compared > 0
    assert found.differences == (), RAISE
    if record.evaluation == EVALUATION:
        assert found.unverified == ()


def test_the_present_evaluation_has_a_record_of_every_kind() -> None:
    folder = pinned.FOLDER / str(EVALUATION)
    kinds = {json.loads(path.read_bytes())["kind"] for path in folder.glob("*.json")}
    assert kinds == set(KINDS), RAISE


def test_a_changed_fit_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    record = unseal((pinned.FOLDER / str(EVALUATION) / "load_cell.json").read_bytes())
    monkeypatch.setattr(zeros, "HUBER", 0.5)  # other zeros are believed
    assert any(one.startswith("zero") for one in verify(record).differences)


def test_records_that_are_kept_are_not_made_again(capsys: pytest.CaptureFixture[str]) -> None:
    assert pinned.main() == 1
    assert "raise rigapp_calibration.records.EVALUATION" in capsys.readouterr().err
