"""An interrupted test goes on in the same file; nobody else may write it meanwhile."""

from __future__ import annotations

import shutil
import stat
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from patience import PATIENCE_S
from storage_samples import PLAN, check, curves, cycle, new_test, prediction, row, write

from rigapp.config.errors import UnusableInput
from rigapp.schema.columns import prediction_columns
from rigapp.schema.messages import Event
from rigapp.storage import FilePlan, open_test, reopen_test


def test_resumed_test_goes_on_after_its_committed_rows(quick_folder: Path) -> None:
    path = quick_folder / "test.h5"
    with new_test(quick_folder) as writer:
        writer.append_event(Event(1.0, 0, "started", "operator", "go"))
        write(writer, 1, 57)
        writer.commit()
        writer.append_event(Event(2.0, 57, "note", "operator", "committed when closed"))
    with reopen_test(path) as writer:
        assert writer.revolutions == 57
        assert writer.revolutions_committed == 57
        with open_test(path) as reader:
            assert reader.summary()["status"] == "running"
        write(writer, 58, 120)
        writer.finish("complete", "complete", "done")
    with open_test(path) as reader:
        assert check(reader) == 120
        assert reader.summary()["gaps"] == 1
        assert reader.state("resumed") == 1
        assert [one.kind for one in reader.events()] == ["started", "note", "gap"]
        assert "after revolution 57" in reader.events()[-1].text
        assert reader.first_altered_event() is None
        assert reader.cycle_revolutions().tolist() == list(range(10, 121, 10))


def test_a_resumed_file_is_write_protected_again(quick_folder: Path) -> None:
    with new_test(quick_folder) as writer:
        write(writer, 1, 5)
    path = quick_folder / "test.h5"
    with reopen_test(path):
        assert stat.S_IMODE(path.stat().st_mode) == 0o444


def test_what_belongs_to_no_committed_revolution_is_measured_anew(quick_folder: Path) -> None:
    path = quick_folder / "test.h5"
    with new_test(quick_folder) as writer:
        write(writer, 1, 19)
        writer.append_cycle(20, cycle(20))
        writer.append_prediction(prediction(20), curves(20))
    with open_test(path) as reader:
        assert reader.cycle_revolutions().tolist() == [10, 20]
    with reopen_test(path) as writer:
        with open_test(path) as reader:
            assert reader.cycle_revolutions().tolist() == [10]
            assert reader.predictions()["revolution"].tolist() == list(range(1, 20))
            assert reader.predicted_curve(20) is None
        write(writer, 20, 40)
    with open_test(path) as reader:
        assert check(reader) == 40
        assert reader.cycle_revolutions().tolist() == [10, 20, 30, 40]


def test_resuming_an_empty_test_counts_no_gap(quick_folder: Path) -> None:
    new_test(quick_folder).close()
    with reopen_test(quick_folder / "test.h5") as writer:
        writer.commit()
    with open_test(quick_folder / "test.h5") as reader:
        assert reader.summary()["gaps"] == 0
        assert [one.kind for one in reader.events()] == ["resumed"]


def test_stopped_test_may_be_resumed_and_is_running_again(quick_folder: Path) -> None:
    path = quick_folder / "test.h5"
    with new_test(quick_folder) as writer:
        write(writer, 1, 5)
        writer.finish("fault", "device", "cable pulled")
    with reopen_test(path), open_test(path) as reader:
        summary = reader.summary()
        assert (summary["status"], summary["reason"]) == ("running", "")
        assert reader.metadata()["ended"] == ""


def test_complete_test_is_not_resumed(quick_folder: Path) -> None:
    with new_test(quick_folder) as writer:
        write(writer, 1, 5)
        writer.finish("complete", "complete", "done")
    with pytest.raises(UnusableInput, match=r"test\.h5: the test is complete with 5 revolutions"):
        reopen_test(quick_folder / "test.h5")


def test_second_writer_is_refused_in_this_and_in_another_process(quick_folder: Path) -> None:
    path = quick_folder / "test.h5"
    code = (
        "import sys; from rigapp.config.errors import UnusableInput\n"
        "from rigapp.storage import reopen_test\n"
        "try: reopen_test(sys.argv[1])\n"
        "except UnusableInput as error: print(error)"
    )
    with new_test(quick_folder) as writer:
        with pytest.raises(UnusableInput, match="another process is writing this test"):
            reopen_test(path)
        done = subprocess.run(
            [sys.executable, "-c", code, path], capture_output=True, text=True, timeout=PATIENCE_S
        )
        assert "another process is writing this test" in done.stdout
        write(writer, 1, 3)
        assert writer.commit() == 3
    reopen_test(path).close()


def test_a_copy_that_lost_its_reserved_room_is_resumed(quick_folder: Path) -> None:
    with new_test(quick_folder) as writer:
        write(writer, 1, 50)
    copy = quick_folder / "copy.h5"
    subprocess.run(["cp", "--sparse=always", quick_folder / "test.h5", copy], check=True)
    with reopen_test(copy) as writer:
        write(writer, 51, 60)
    with open_test(copy) as reader:
        assert check(reader) == 60


def test_extension_goes_on_in_the_same_columns(quick_folder: Path) -> None:
    path = quick_folder / "test.h5"
    with new_test(quick_folder) as writer:
        write(writer, 1, 300)
        writer.extend(700)
        assert writer.planned_revolutions == 700
        write(writer, 301, 500)
        writer.commit()
    with reopen_test(path) as writer:
        assert writer.planned_revolutions == 700
        write(writer, 501, 700)
        writer.finish("complete", "complete", "done")
    with open_test(path) as reader:
        assert check(reader) == 700
        assert reader.committed("cycles") == 70
        event = next(one for one in reader.events() if one.kind == "extended")
        assert (event.before, event.after) == ("300", "700")
        assert reader.state("planned_revolutions") == 700


def test_extension_beyond_the_files_room_is_refused_and_changes_nothing(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with new_test(quick_folder) as writer:
        with pytest.raises(UnusableInput, match="room for 1536 revolutions, not 5000"):
            writer.extend(5000)
        disk = shutil.disk_usage(quick_folder)
        monkeypatch.setattr("rigapp.storage.filesystem.folder.SPACE_MARGIN", disk.total)
        with pytest.raises(UnusableInput, match="MB are missing"):
            writer.extend(600)
        assert writer.planned_revolutions == 300
        write(writer, 1, 20)
        assert writer.commit() == 20


def test_unplanned_samples_grow_into_declared_room(quick_folder: Path) -> None:
    plan = FilePlan(revolutions=300, cycles=30, samples_per_cycle=10, events=100)
    long = FilePlan(revolutions=300, cycles=30, samples_per_cycle=30, events=100)
    with new_test(quick_folder, plan) as writer:
        for revolution in range(10, 301, 10):
            values = [[float(revolution)] * 30] * len(long.cycle_columns)
            assert writer.append_cycle(revolution, dict(zip(
                [one.name for one in plan.cycle_columns], values, strict=True)))  # fmt: skip
        writer.append_row(row(1, plan))
        writer.commit()
        with open_test(quick_folder / "test.h5") as reader:
            assert [one.columns["force"][0] for one in reader.cycles()] == list(range(10, 301, 10))


def test_missing_file_is_named(quick_folder: Path) -> None:
    with pytest.raises(UnusableInput, match=r"none\.h5: there is no such file"):
        reopen_test(quick_folder / "none.h5")


def test_a_file_with_fewer_columns_takes_what_it_knows(
    quick_folder: Path,
) -> None:
    old = tuple(c for c in prediction_columns() if c.name != "measured_wear_depth_uncertainty")
    path = quick_folder / "test.h5"
    with new_test(quick_folder, replace(PLAN, prediction_columns=old)) as writer:
        write(writer, 1, 5)
    with reopen_test(path) as writer:
        writer.append_row(row(6, writer.plan))
        values = np.arange(float(len(prediction_columns())))
        values[0] = 6.0
        writer.append_prediction(values)
        writer.finish("stopped", "user", "")
    with open_test(path) as reader:
        found = reader.predictions()
    assert "measured_wear_depth_uncertainty" not in found
    assert found["revolution"].tolist()[-1] == 6
    for place, one in enumerate(prediction_columns()[1:], 1):
        if one.name in found:
            assert found[one.name][-1] == place
