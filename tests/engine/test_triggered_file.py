"""Whole cycles around alarms, limits and notes, and what the end of a test cut off, in its file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
import pytest

from rigapp.config.loading import Document, parse_test
from rigapp.config.recipe import TestFile
from rigapp.engine.recording.fileplan import file_plan
from rigapp.engine.recording.store import open_file
from rigapp.replay.client import ReplayClient
from rigapp.report.results import result_of
from rigapp.report.testreport.compose import report_of
from rigapp.schema.messages import Flag
from rigapp.schema.results import HowEnded
from rigapp.schema.states import ENDED
from rigapp.storage import (
    TestReader,
    compact_test,
    largest_force,
    open_test,
    reserved_bytes,
    streams_of,
    trip_capture,
    trip_of,
)
from rigapp.viewer.recording import load_trip
from tests.engine.engine_doubles import COUNTS, RATE, MemoryRig, eventually

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


@pytest.fixture
def rig() -> MemoryRig:
    return MemoryRig(open_store=open_file)


def document(revolutions: int, extra: str = "") -> Document[TestFile]:
    text = (EXAMPLES / "quick.toml").read_text(encoding="utf-8")
    for old, new in (
        ("revolutions = 500", f"revolutions = {revolutions}"),
        ("speed_rpm = 60.0", "speed_rpm = 120.0"),
        ("acceleration_rpm_per_s = 60.0", "acceleration_rpm_per_s = 600.0"),
        ("overspeed_rpm = 90.0", "overspeed_rpm = 180.0"),
        ("every_revolutions = 10", "every_revolutions = 1000\n" + extra),
    ):
        assert old in text, old
        text = text.replace(old, new, 1)
    return Document(Path("quick.toml"), text, parse_test(text, "quick.toml"))


def whys(reader: TestReader) -> dict[int, str]:
    return dict(zip(reader.cycle_revolutions().tolist(), reader.cycle_reasons(), strict=True))


def test_a_note_keeps_the_cycles_around_it(rig: MemoryRig, tmp_path: Path) -> None:
    path = tmp_path / "test.h5"
    rig.engine.connect()
    rig.engine.start(document(2000, "before_alarm = 2\nafter_alarm = 3"), path)
    eventually(lambda: rig.engine.status().test.revolution >= 6, 60.0)
    rig.engine.note("a squeak")
    noted = rig.engine.status().test.revolution
    eventually(lambda: rig.engine.status().test.revolution >= noted + 8, 60.0)
    rig.engine.stop("Ada")
    rig.engine.wait(ENDED, 60.0)
    rig.engine.shutdown()
    with open_test(path) as reader:
        found = whys(reader)
        trigger = next(number for number, why in found.items() if why == "trigger")
        assert trigger >= 6
        around = {number: why for number, why in found.items() if number < trigger + 4}
        assert around == {
            trigger - 2: "before",
            trigger - 1: "before",
            trigger: "trigger",
            trigger + 1: "after",
            trigger + 2: "after",
            trigger + 3: "after",
        }
        assert list(found.values())[-1] == "last"
        for stored in reader.cycles():
            row = stored.revolution - 1
            assert len(stored.columns["angle"]) == reader.column("samples")[row]
            assert stored.quality == reader.column("quality")[row]
            assert stored.columns["force"].max() == pytest.approx(
                reader.column("force_max")[row], rel=1e-5
            )


def test_an_overload_leaves_its_history_and_the_revolution_it_cut_off(
    rig: MemoryRig, tmp_path: Path
) -> None:
    path = tmp_path / "test.h5"
    rig.engine.connect()
    rig.engine.start(document(2000, "before_alarm = 4\nafter_alarm = 4"), path)
    eventually(lambda: rig.engine.status().test.revolution >= 8, 60.0)
    rig.source.force_N = 500.0
    rig.engine.wait(ENDED, 60.0)
    rig.engine.shutdown()
    with open_test(path) as reader:
        last = reader.summary()["last_revolution"]
        found = whys(reader)
        (cut_off,) = reader.unfinished()
        assert cut_off.revolution == last + 1
        assert cut_off.quality & Flag.PARTIAL
        angle, force = cut_off.columns["angle"], cut_off.columns["force"]
        assert np.all(np.diff(angle) >= 0)
        assert 0 < angle[-1] < 360.0
        highest = max([force.max(), *(one.columns["force"].max() for one in reader.cycles())])
        assert highest == pytest.approx(500.0, rel=1e-3)
        assert cut_off.columns["time"][0] >= reader.column("time")[last - 1] - 1.0 / RATE
        numbers = list(found)
        assert numbers == list(range(numbers[0], last + 1))
        assert set(found.values()) <= {"before", "trigger", "after"}
        assert len(found) >= 4
        largest, trip = largest_force(reader), trip_of(reader)
        assert largest is not None
        assert trip is not None
        assert trip.before is not None
        assert (largest.value_N, largest.sign) == (pytest.approx(500.0, rel=1e-3), "")
        assert trip.before.revolution == trip.revolution - 1
        assert trip.before.columns["force"].max() < 100.0
        capture = trip_capture(reader)
        assert capture is not None
        before, cycle = capture.pieces[:2]
        assert (before.before, cycle.before) == (True, False)
        assert before.time_s[-1] < cycle.time_s[0] <= 0.0
        # The force that tripped is the first one that large.
        assert cycle.values["force"][cycle.time_s < 0.0].max() < 480.0
        assert np.interp(0.0, cycle.time_s, cycle.values["force"]) == pytest.approx(500.0, rel=0.01)
        assert np.nanmedian(before.values["speed"]) > 0.0
        assert capture.turned_s >= 0.0
        assert capture.stood_s >= 0.0
        assert abs(capture.happened - reader.events()[-1].time) < 60.0
    with h5py.File(path) as file:
        group = file["/entry/unfinished"]
        assert group["committed"][()] == 1
        assert group["force"].attrs["units"] == "N"
        assert file["/entry/cycles/why"].asstr()[0] == "before"
    assert compact_test(path)
    with open_test(path) as reader:
        assert whys(reader) == found
        np.testing.assert_array_equal(reader.unfinished()[0].columns["force"], force)


JAM_N = 735.0
"""The first bridge at 1.05 times 3.5 mV/V by 200 N, where the second shows next to nothing."""


@pytest.mark.long
def test_a_jam_beyond_the_range_is_told_alike_by_file_result_report_and_replay(
    rig: MemoryRig, tmp_path: Path
) -> None:
    path = tmp_path / "test.h5"
    rig.engine.connect()
    rig.engine.start(document(2000), path)
    eventually(lambda: rig.engine.status().test.revolution >= 8, 60.0)
    rig.source.jam_at = 20
    rig.engine.wait(ENDED, 60.0)
    (alarm,) = rig.engine.status().alarms
    rig.engine.shutdown()
    with open_test(path) as reader:
        largest, trip = largest_force(reader), trip_of(reader)
    assert largest is not None
    assert trip is not None
    assert trip.cycle is not None
    assert trip.peak == largest
    assert trip.revolution == largest.revolution == alarm.revolution + 1
    assert trip.before is not None
    assert trip.before.revolution == alarm.revolution
    assert (largest.value_N, largest.sign) == (pytest.approx(alarm.value), "≥ ")
    assert largest.value_N == pytest.approx(JAM_N, abs=10.0)
    assert trip.cycle.columns["force"].max() > 380.0
    result = result_of(path)
    assert result.force_max_N == largest.value_N
    assert result.force_lower_bound
    assert result.outcome is HowEnded.TRIPPED
    written = str(report_of(path))
    assert f"≥ {largest.value_N:.1f}" in written
    assert "The revolution in which the test tripped" in written
    assert trip.trigger_N == alarm.value
    with open_test(path) as reader:
        capture = trip_capture(reader)
    assert capture is not None
    assert 0.0 <= capture.turned_s < 10.0
    shown = load_trip(path)
    assert shown is not None
    assert shown.cycle is not None
    assert shown.peak == largest


@pytest.mark.long
def test_a_jam_in_the_first_revolution_is_all_that_there_is(
    rig: MemoryRig, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, turn = tmp_path / "test.h5", rig.spindle.set_speed

    def jams(speed: float, acceleration: float) -> None:
        turn(speed, acceleration)
        rig.source.jam_at = 300  # between the first index, after 230 samples, and the second

    rig.engine.connect()
    monkeypatch.setattr(rig.spindle, "set_speed", jams)
    rig.engine.start(document(2000), path)
    rig.engine.wait(ENDED, 60.0)
    rig.engine.shutdown()
    with open_test(path) as reader:
        trip = trip_of(reader)
        assert reader.committed() == 0
    assert trip is not None
    assert trip.cycle is not None
    assert (trip.revolution, trip.before) == (1, None)
    result = result_of(path)
    assert (result.force_max_revolution, result.force_lower_bound) == (1, True)
    assert result.force_max_N == pytest.approx(JAM_N, abs=10.0)
    assert f"≥ {result.force_max_N:.1f}" in str(report_of(path))
    replay = ReplayClient(path)
    try:
        eventually(lambda: replay.poll() is not None)
    finally:
        replay.close()


def test_what_a_broken_cable_shows_is_no_force(rig: MemoryRig, tmp_path: Path) -> None:
    path = tmp_path / "test.h5"
    rig.engine.connect()
    rig.engine.start(document(2000), path)
    eventually(lambda: rig.engine.status().test.revolution >= 8, 60.0)
    rig.source.saturated = 0
    rig.engine.wait(ENDED, 60.0)
    rig.engine.shutdown()
    with open_test(path) as reader:
        trip = trip_of(reader)
    assert trip is not None
    assert trip.peak is None
    assert result_of(path).force_max_N == pytest.approx(50.0, rel=1e-3)


def test_a_trip_by_a_rule_is_of_the_whole_revolution_that_was_judged(
    rig: MemoryRig, tmp_path: Path
) -> None:
    path = tmp_path / "test.h5"
    rule = '[[limits.rule]]\nquantity = "force_max"\ncritical_above = 100.0\n[prediction]'
    base = document(2000, "before_alarm = 2\nafter_alarm = 0")
    text = base.text.replace("[prediction]", rule)
    rig.engine.connect()
    rig.engine.start(replace(base, text=text, record=parse_test(text, "quick.toml")), path)
    eventually(lambda: rig.engine.status().test.revolution >= 8, 60.0)
    rig.source.force_N = 200.0
    rig.engine.wait(ENDED, 60.0)
    rig.engine.shutdown()
    with open_test(path) as reader:
        trip = trip_of(reader)
        force = reader.column("force_max")
    assert trip is not None
    assert trip.cycle is not None
    assert trip.before is not None
    assert trip.revolution == trip.cycle.revolution == np.flatnonzero(force > 100.0)[0] + 1
    assert trip.before.revolution == trip.revolution - 1


@pytest.mark.long
def test_a_resumed_test_keeps_what_was_cut_off(rig: MemoryRig, tmp_path: Path) -> None:
    path = tmp_path / "test.h5"
    rig.engine.connect()
    rig.engine.start(document(60), path)
    eventually(lambda: rig.engine.status().test.revolution >= 5, 60.0)
    rig.engine.stop("Ada")
    rig.engine.wait(ENDED, 60.0)
    with open_test(path) as reader:
        before = reader.unfinished()
        saved = whys(reader)
    rig.engine.start(document(60), path, resume=True)
    rig.engine.wait(ENDED, 60.0)
    rig.engine.shutdown()
    with open_test(path) as reader:
        after = reader.unfinished()
        assert len(after) == len(before) <= 1
        for one, other in zip(before, after, strict=True):
            np.testing.assert_array_equal(one.columns["angle"], other.columns["angle"])
        assert list(whys(reader).items())[: len(saved)] == list(saved.items())
        assert whys(reader)[60] == "scheduled"
        assert reader.summary()["cycles_saved"] == len(whys(reader))


@pytest.mark.long
def test_a_used_up_room_is_told_once(rig: MemoryRig, tmp_path: Path) -> None:
    path = tmp_path / "test.h5"
    rig.engine.connect()
    rig.engine.start(document(1000, "before_alarm = 0\nafter_alarm = 1"), path)
    for number in range(2, 60, 3):
        eventually(lambda n=number: rig.engine.status().test.revolution >= n, 60.0)
        rig.engine.note(f"note {number}")
    eventually(lambda: any(e.kind == "cycles" for e in logged(path)), 60.0)
    rig.engine.stop("Ada")
    rig.engine.wait(ENDED, 60.0)
    rig.engine.shutdown()
    assert sum(event.kind == "cycles" for event in logged(path)) == 1


def logged(path: Path) -> list[object]:
    with open_test(path) as reader:
        return list(reader.events())


def test_the_plan_counts_what_triggers_keep() -> None:
    test = document(500).record
    alone = document(500, "before_alarm = 0\nafter_alarm = 0").record
    more = file_plan(test, RATE)
    less = file_plan(alone, RATE)
    assert more.cycles - less.cycles == 110
    assert less.cycles == 1
    size = reserved_bytes(streams_of(more).values()) - reserved_bytes(streams_of(less).values())
    assert size > 110 * RATE / 2 * 50


@pytest.mark.long
def test_samples_beyond_a_part_are_not_those_of_the_part(rig: MemoryRig, tmp_path: Path) -> None:
    """The part ends where the crank is stationary, not where the memory behind it ends."""
    path = tmp_path / "test.h5"
    rig.engine.connect()
    rig.engine.start(document(500), path)
    eventually(lambda: rig.engine.status().test.revolution >= 3, 60.0)
    rig.engine.stop("Ada")
    rig.engine.wait(ENDED, 60.0)
    rig.engine.shutdown()
    with open_test(path) as reader:
        for part in reader.unfinished():
            count = part.columns["raw_count"]
            assert count.max() < COUNTS
            np.testing.assert_allclose(part.columns["force"], 50.0, rtol=1e-4)
            np.testing.assert_allclose(np.diff(part.columns["time"]), 1 / RATE, rtol=1e-6)
