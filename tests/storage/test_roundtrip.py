"""What is written comes back, while the test runs and after it."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from storage_samples import (
    FULL,
    METADATA,
    PLAN,
    check,
    curves,
    cycle,
    new_test,
    prediction,
    row,
    write,
)

from rigapp.schema.messages import Event
from rigapp.storage import DiskFull, FilePlan, StorageFailed, open_test, row_numbers
from rigapp.storage.reading import blocks as blocks_module

PLAIN = replace(PLAN, prediction=False)
"""With half as many columns, a file is made in half the time."""


def test_rows_cycles_predictions_and_curves_come_back(quick_folder: Path) -> None:
    with new_test(quick_folder) as writer:
        write(writer, 1, 300)
        assert writer.commit() == 300
        with open_test(quick_folder / "test.h5") as reader:
            assert check(reader) == 300
            assert reader.cycle_revolutions().tolist() == list(range(10, 301, 10))
            assert reader.cycle(-1).revolution == 300
            assert reader.predicted_curve(11) is None
            assert len(reader.predictions()["revolution"]) == 300
            with pytest.raises(IndexError, match="no saved cycle 30"):
                reader.cycle(30)


def test_only_committed_rows_are_data(quick_folder: Path) -> None:
    with new_test(quick_folder) as writer:
        write(writer, 1, 40)
        with open_test(quick_folder / "test.h5") as reader:
            assert reader.committed() == 0
            assert reader.rows()["revolution"].size == 0
            assert reader.committed("cycles") == 0
            writer.commit()
            write(writer, 41, 50)
            assert reader.committed() == 40
            assert reader.column("revolution", 38).tolist() == [39, 40]
            assert check(reader) == 40


def test_summary_has_the_promised_keys(quick_folder: Path) -> None:
    writer = new_test(quick_folder)
    path = quick_folder / "test.h5"
    with open_test(path) as reader:
        empty = reader.summary()
    assert list(empty) == [
        "status", "reason", "revolutions", "first_revolution", "last_revolution", "gaps",
        "cycles_saved", "started", "schema",
    ]  # fmt: skip
    assert (empty["status"], empty["revolutions"]) == ("running", 0)
    assert empty["first_revolution"] is None
    write(writer, 1, 20)
    writer.note_gap(Event(1.0, 20, "gap", "test", "a gap"))
    writer.finish("complete", "complete", "all revolutions done")
    writer.close()
    with open_test(path) as reader:
        assert reader.summary() == {
            "status": "complete",
            "reason": "all revolutions done",
            "revolutions": 20,
            "first_revolution": 1,
            "last_revolution": 20,
            "gaps": 1,
            "cycles_saved": 2,
            "started": "2027-01-15T08:00:00.000000+00:00",
            "schema": 1,
        }
        assert reader.metadata()["ended"].endswith("+00:00")


@pytest.mark.sampled(every=2)
@pytest.mark.parametrize(
    ("stored", "shown"), [("complete", "complete"), ("stopped", "stopped"), ("fault", "stopped")]
)
def test_final_status_is_one_of_four_words(quick_folder: Path, stored: str, shown: str) -> None:
    writer = new_test(quick_folder)
    writer.finish(stored, "device", "cable pulled")
    writer.close()
    with open_test(quick_folder / "test.h5") as reader:
        assert reader.summary()["status"] == shown
        assert reader.summary()["reason"] == "cable pulled"
        assert reader.stored_status() == stored
        assert reader.reason_code() == "device"


def test_a_closed_file_without_status_is_interrupted(quick_folder: Path) -> None:
    with new_test(quick_folder) as writer:
        write(writer, 1, 7)
    with open_test(quick_folder / "test.h5") as reader:
        summary = reader.summary()
    assert summary["status"] == "interrupted"
    assert summary["revolutions"] == 7
    assert "7 revolutions are safe" in summary["reason"]


def test_unknown_final_status_and_use_after_close_are_refused(quick_folder: Path) -> None:
    writer = new_test(quick_folder)
    with pytest.raises(ValueError, match="status 'done'"):
        writer.finish("done", "", "")
    write(writer, 1, 3)
    writer.close()
    writer.close()
    assert writer.commit() == 3
    with pytest.raises(StorageFailed, match="closed"):
        writer.append_row(row(4))
    with pytest.raises(StorageFailed, match="closed"):
        writer.append_cycle(4, cycle(4))
    with pytest.raises(StorageFailed, match="closed"):
        writer.finish("complete", "complete", "")


def test_configuration_calibration_and_metadata_come_back(quick_folder: Path) -> None:
    new_test(quick_folder).close()
    with open_test(quick_folder / "test.h5") as reader:
        configuration = reader.configuration()
        assert configuration["rig"] == METADATA.rig_text
        assert configuration["test"] == METADATA.test_text
        assert configuration["parameters"] == {"mechanism": {"crank_radius_mm": 76.2}}
        assert configuration["versions"]["h5py"] == h5py.version.version
        assert reader.calibration() == METADATA.calibration
        metadata = reader.metadata()
    assert metadata["operator"] == "Ann"
    assert metadata["planned_revolutions"] == 300
    with h5py.File(quick_folder / "test.h5") as file:
        radius = file["/entry/configuration/parameters/mechanism/crank_radius_mm"]
        assert radius.attrs["units"] == "mm"
        matrix = file["/entry/calibration/load_cell/matrix_N_per_mV_per_V"]
        assert matrix.attrs["units"] == "N/(mV/V)"


def test_every_number_has_a_unit_and_a_name(quick_folder: Path) -> None:
    new_test(quick_folder, FULL).close()

    def has_unit(name: str, item: object) -> None:
        if not isinstance(item, h5py.Dataset) or item.dtype.kind not in "fi":
            return
        if item.attrs.get("NAME", b"").startswith(b"This is a netCDF dimension"):
            return
        assert item.attrs.get("units"), name

    with h5py.File(quick_folder / "test.h5") as file:
        file.visititems(has_unit)


def test_cycle_may_be_given_by_name_and_wrong_columns_are_refused(quick_folder: Path) -> None:
    names = [one.name for one in PLAN.cycle_columns]
    values = dict(zip(names, cycle(10), strict=True))
    with new_test(quick_folder) as writer:
        assert writer.append_cycle(10, values)
        with pytest.raises(ValueError, match="check raw_count"):
            writer.append_cycle(20, {name: values[name] for name in names if name != "raw_count"})
        with pytest.raises(ValueError, match="differ in length"):
            writer.append_cycle(20, {**values, "force": values["force"][:-1]})
        with pytest.raises(ValueError, match="values"):
            writer.append_prediction(prediction(20), curves(20)[:, :-1])
        writer.commit()
        with open_test(quick_folder / "test.h5") as reader:
            assert reader.cycle_revolutions().tolist() == [10]
            check(reader)


def test_a_full_file_says_so_and_keeps_its_data(quick_folder: Path) -> None:
    plan = FilePlan(revolutions=5, cycles=1, samples_per_cycle=4, events=80, prediction=False)
    with new_test(quick_folder, plan) as writer:
        for revolution in range(1, 1025):
            writer.append_row(row(revolution, plan))
        with pytest.raises(DiskFull, match="begin a new test"):
            writer.append_row(row(1025, plan))
        kept = [writer.append_cycle(i, cycle(i, plan)) for i in range(1, 600)]
        assert kept.count(False) == writer.cycles_refused > 0
        texts = [writer.append_event(Event(0.0, i, "k", "s", "t")) for i in range(100)]
        assert texts.count(False) == 84
        assert writer.commit() == 1024
        with open_test(quick_folder / "test.h5") as reader:
            assert check(reader, every=1) == 1024
            assert reader.state("cycles_refused") == kept.count(False)
            assert reader.state("events_refused") == 84


texts = st.text(max_size=700)


@settings(
    max_examples=5,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(
    found=st.lists(
        st.builds(
            Event, st.floats(0, 2e9), st.integers(0, 10**9), st.sampled_from(["a", "b"]),
            st.just("operator"), texts, texts, texts,
        ),
        max_size=8,
    )
)  # fmt: skip
def test_events_come_back_whatever_their_texts(quick_folder: Path, found: list[Event]) -> None:
    folder = Path(tempfile.mkdtemp(dir=quick_folder))
    with new_test(folder, PLAIN) as writer:
        for event in found:
            assert writer.append_event(event)
        writer.commit()
        with open_test(folder / "test.h5") as reader:
            stored = reader.events()
            assert reader.first_altered_event() is None

    def clean(event: Event) -> tuple[object, ...]:
        texts = (event.text, event.before, event.after)
        return event.time, event.revolution, *(one.replace("\0", " ") for one in texts)

    assert [clean(one) for one in stored] == [clean(one) for one in found]


def test_an_altered_event_shows(quick_folder: Path) -> None:
    with new_test(quick_folder) as writer:
        for i in range(5):
            writer.append_event(Event(float(i), i, "setpoint", "operator", "speed", "30", "60"))
        writer.commit()
    path = quick_folder / "test.h5"
    path.chmod(0o644)
    with h5py.File(path, "r+") as file:
        file["/entry/events/after"][2] = b"90"
    with open_test(path) as reader:
        assert reader.first_altered_event() == 2


@settings(
    max_examples=5,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(
    steps=st.lists(
        st.tuples(st.sampled_from(["rows", "cycle", "commit", "event"]), st.integers(1, 90)),
        max_size=25,
    )
)
def test_any_order_of_calls_reads_back(quick_folder: Path, steps: list[tuple[str, int]]) -> None:
    folder = Path(tempfile.mkdtemp(dir=quick_folder))
    rows = cycles = 0
    with new_test(folder, PLAIN) as writer:
        for step, number in steps:
            if step == "rows":
                for _ in range(number):
                    rows += 1
                    writer.append_row(row(rows, PLAIN))
            elif step == "cycle":
                cycles += writer.append_cycle(number * 10, cycle(number * 10, PLAIN))
            elif step == "event":
                writer.append_event(Event(0.0, number, "k", "s", "t" * number))
            else:
                assert writer.commit() == rows
        assert writer.commit() == rows
        with open_test(folder / "test.h5") as reader:
            assert check(reader) == rows
            assert reader.committed("cycles") == cycles
            np.testing.assert_array_equal(
                np.diff([*reader._file["/entry/cycles/first"][:cycles]]),
                reader._file["/entry/cycles/count"][: max(0, cycles - 1)],
            )


def test_numbers_of_rows_are_found_with_their_gaps(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(blocks_module, "BLOCK_ROWS", 16)
    numbers = [*range(1, 100), *range(104, 180), 200, *range(210, 260)]
    with new_test(quick_folder) as writer:
        for number in numbers:
            writer.append_row(row(number))
        writer.commit()
        with open_test(writer.path) as reader:
            found = row_numbers(reader)
            assert found[:].tolist() == numbers
            assert [found.searchsorted(one, "right") for one in (0, 99, 102, 104, 259, 300)] == [
                0, 99, 99, 100, len(numbers), len(numbers),
            ]  # fmt: skip
