"""What is safe of a study: whole rows, of this study alone, by one process at a time."""

from __future__ import annotations

from pathlib import Path

import pytest

from rigapp.config.errors import UnusableInput
from rigapp.study.journal import ROWS, StudyIdentity, StudyJournal
from rigapp.study.points import StudyRow

IDENTITY = StudyIdentity("study", "parameters", "1")
DONE = [StudyRow(0, {"a": 1.5}), StudyRow(3, problem="it cannot be")]


def test_rows_come_back_whatever_a_kill_left_of_the_last(tmp_path: Path) -> None:
    with StudyJournal(tmp_path, IDENTITY) as journal:
        journal.append(DONE)
    whole = (tmp_path / ROWS).read_bytes()
    for cut in range(len(whole) + 1):
        (tmp_path / ROWS).write_bytes(whole[:cut])
        with StudyJournal(tmp_path, IDENTITY) as journal:
            lines = whole[:cut].count(b"\n")
            assert list(journal.rows.values()) == DONE[:lines]
            journal.append(DONE[lines:])
        assert (tmp_path / ROWS).read_bytes() == whole


def test_a_folder_of_another_study_is_refused_and_left_alone(tmp_path: Path) -> None:
    with StudyJournal(tmp_path, IDENTITY) as journal:
        journal.append(DONE)
    for other, words in (
        (StudyIdentity("another", "parameters", "1"), "another study"),
        (StudyIdentity("study", "others", "1"), "another study"),
        (StudyIdentity("study", "parameters", "2"), "begun by rigapp 1"),
    ):
        with pytest.raises(UnusableInput, match=words):
            StudyJournal(tmp_path, other)
    with StudyJournal(tmp_path, IDENTITY) as journal:
        assert len(journal.rows) == 2
        with pytest.raises(UnusableInput, match="another process works on this study"):
            StudyJournal(tmp_path, IDENTITY)


def test_damage_is_told(tmp_path: Path) -> None:
    with StudyJournal(tmp_path, IDENTITY):
        pass
    (tmp_path / ROWS).write_bytes(b"{not json}\n")
    with pytest.raises(UnusableInput, match=r"rows\.jsonl: is damaged"):
        StudyJournal(tmp_path, IDENTITY)
    (tmp_path / "file").write_bytes(b"")
    with pytest.raises(UnusableInput, match="cannot be written"):
        StudyJournal(tmp_path / "file", IDENTITY)
