"""The one table of what can be calibrated."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest

from rigapp.calibrating.certificate import write_certificate
from rigapp.calibrating.records_in_use import PLACES
from rigapp.calibrating.session import LiveSession
from rigapp.calibrating.subjects import SUBJECTS, Subject, subject_of
from rigapp.config.calibration_settings import CalibrationFile
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp_calibration.records import seal

RIG = Path(__file__).parents[2] / "examples" / "simulated.toml"
ALL = list(SUBJECTS.values())


def test_each_kind_of_record_is_of_one_subject() -> None:
    kinds = Counter(kind for one in ALL for kind in one.kinds)
    assert set(kinds.values()) == {1}
    assert all(subject_of(kind) in ALL for kind in kinds)


def test_the_certificate_of_a_record_of_an_unknown_kind_is_refused(tmp_path: Path) -> None:
    record = tmp_path / "record.json"
    record.write_bytes(seal({"kind": "thermometer", "schema": 1}))
    with pytest.raises(UnusableInput, match=r"record\.json: .*kind 'thermometer', .* only load"):
        write_certificate(record, tmp_path / "c.pdf")
    assert not (tmp_path / "c.pdf").exists()


def test_each_place_for_records_in_a_rig_file_is_of_a_subject() -> None:
    rig = read_rig(RIG).record
    assert {one.place for one in ALL} - {None} == set(PLACES)
    for place in PLACES:
        section = getattr(rig, place.section)
        assert hasattr(section, place.key)
        assert hasattr(section, f"{place.key}_override")


@pytest.mark.parametrize("subject", ALL, ids=lambda one: one.name)
def test_a_subject_says_all_that_its_faces_ask(subject: Subject) -> None:
    assert issubclass(subject.settings, CalibrationFile)
    if subject.session is not None:
        assert issubclass(subject.session, LiveSession)
        assert subject.session.columns[: len(subject.columns)] == subject.columns
        none, *mistakes = subject.session.practice.mistakes
        assert none == "none"
        assert mistakes
        assert subject.fit is not None
