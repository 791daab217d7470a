"""Whole cycles around alarms, limits and notes, and what the end of a test cut off, in its file."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
from engine_doubles import COUNTS, RATE, MemoryRig, eventually

from rigapp.config.loading import Document, parse_test
from rigapp.config.recipe import TestFile
from rigapp.engine.recording.fileplan import file_plan
from rigapp.engine.recording.store import open_file
from rigapp.schema.messages import Flag
from rigapp.schema.states import ENDED
from rigapp.storage import TestReader, compact_test, open_test, reserved_bytes, streams_of

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
    eventually(lambda: rig.engine.status().revolution >= 6, 60.0)
    rig.engine.note("a squeak")
    noted = rig.engine.status().revolution
    eventually(lambda: rig.engine.status().revolution >= noted + 8, 60.0)
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
    eventually(lambda: rig.engine.status().revolution >= 8, 60.0)
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
    with h5py.File(path) as file:
        group = file["/entry/unfinished"]
        assert group["committed"][()] == 1
        assert group["force"].attrs["units"] == "N"
        assert file["/entry/cycles/why"].asstr()[0] == "before"
    assert compact_test(path)
    with open_test(path) as reader:
        assert whys(reader) == found
        np.testing.assert_array_equal(reader.unfinished()[0].columns["force"], force)


def test_a_resumed_test_keeps_what_was_cut_off(rig: MemoryRig, tmp_path: Path) -> None:
    path = tmp_path / "test.h5"
    rig.engine.connect()
    rig.engine.start(document(60), path)
    eventually(lambda: rig.engine.status().revolution >= 5, 60.0)
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


def test_a_used_up_room_is_told_once(rig: MemoryRig, tmp_path: Path) -> None:
    path = tmp_path / "test.h5"
    rig.engine.connect()
    rig.engine.start(document(1000, "before_alarm = 0\nafter_alarm = 1"), path)
    for number in range(2, 60, 3):
        eventually(lambda n=number: rig.engine.status().revolution >= n, 60.0)
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


def test_samples_beyond_a_part_are_not_those_of_the_part(rig: MemoryRig, tmp_path: Path) -> None:
    """The part ends where the crank stands, not where the memory behind it ends."""
    path = tmp_path / "test.h5"
    rig.engine.connect()
    rig.engine.start(document(500), path)
    eventually(lambda: rig.engine.status().revolution >= 3, 60.0)
    rig.engine.stop("Ada")
    rig.engine.wait(ENDED, 60.0)
    rig.engine.shutdown()
    with open_test(path) as reader:
        for part in reader.unfinished():
            count = part.columns["raw_count"]
            assert count.max() < COUNTS
            np.testing.assert_allclose(part.columns["force"], 50.0, rtol=1e-4)
            np.testing.assert_allclose(np.diff(part.columns["time"]), 1 / RATE, rtol=1e-6)
