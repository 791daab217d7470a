"""No committed row is lost and the file always opens: kills, cuts at every write, power losses."""

from __future__ import annotations

import random
import threading
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import pytest
from crash_writer import Writer
from storage_samples import PLAN, check, new_test, write

from rigapp.schema.channels import BASE
from rigapp.schema.columns import prediction_columns
from rigapp.schema.messages import Event
from rigapp.storage import FilePlan, StorageFailed, open_test, reopen_test
from rigapp.storage.filesystem.disk import Disk
from rigapp.storage.filesystem.system import FILES

PAGE = 4096
SMALL = FilePlan(
    revolutions=80,
    cycles=9,
    samples_per_cycle=40,
    events=80,
    revolution_columns=BASE.revolution_columns[:12],
    cycle_columns=BASE.cycle_columns[:4],
    prediction_columns=prediction_columns()[:5],
    prediction_points=30,
)


# ------------------------------------------------------------------------------------------- kills


def kill_one_writer(
    folder: Path, chance: random.Random, number: int, *, ends: bool = False
) -> None:
    """Start a writer, kill it at a random moment, check the file, resume it, kill that, check.

    ends: it ends the test again and again.
    """
    path = folder / f"kill-{number}.h5"
    announced = 0
    for _ in range(2):
        before = announced
        writer = Writer(path, ends)
        time.sleep(chance.uniform(0.0, 0.08))
        announced = max(announced, *writer.kill(), 0)
        assert not FILES.is_held(path, "")
        with open_test(path) as reader:
            number_safe = check(reader)
            assert number_safe >= announced >= before
            assert reader.summary()["status"] in ("interrupted", "stopped" if ends else "")
            assert reader.first_altered_event() is None
            announced = number_safe
    path.unlink()


@pytest.mark.parametrize("kills", [3, pytest.param(8, marks=pytest.mark.long)])
def test_killed_writers_lose_no_committed_row(quick_folder: Path, kills: int) -> None:
    def kill(number: int) -> None:
        kill_one_writer(quick_folder, random.Random(number), number)

    with ThreadPoolExecutor(2) as pool:
        assert len(list(pool.map(kill, range(kills)))) == kills


@pytest.mark.parametrize("kills", [2, pytest.param(4, marks=pytest.mark.long)])
def test_kills_while_a_file_is_ended_and_gives_room_back_lose_no_row(
    quick_folder: Path, kills: int
) -> None:
    def kill(number: int) -> None:
        kill_one_writer(quick_folder, random.Random(number), number, ends=True)

    with ThreadPoolExecutor(2) as pool:
        assert len(list(pool.map(kill, range(kills)))) == kills


@pytest.mark.soak
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("ends", [False, True], ids=["writing", "ending"])
def test_many_killed_writers_lose_no_committed_row(tmp_path: Path, ends: bool) -> None:
    chance = random.Random(time.time_ns())
    for number in range(200):
        kill_one_writer(tmp_path, chance, number, ends=ends)


# ------------------------------------------------------------------------- cuts and power failures


@dataclass
class Recording:
    """Remember each write, each sync and each announced commit of a test, in their order."""

    path: Path
    start: bytes
    steps: list[tuple[str, int, bytes]] = field(default_factory=list)

    def announce(self, revolutions: int) -> None:
        """Note that so many revolutions were announced as safe."""
        self.steps.append(("safe", revolutions, b""))


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Recording:
    """Record a test that is written, committed, resumed and finished."""
    folder = tmp_path_factory.mktemp("recording")
    writer = new_test(folder, SMALL)
    path = folder / "test.h5"
    found = Recording(path, path.read_bytes())
    honest_write, honest_sync = Disk.write_parts, Disk.sync
    honest_give_back = Disk.give_back

    def write_and_note(disk: Disk, parts: Sequence[bytes | memoryview], offset: int) -> None:
        honest_write(disk, parts, offset)
        found.steps.append(("write", offset, b"".join(parts)))

    def sync_and_note(disk: Disk) -> None:
        honest_sync(disk)
        found.steps.append(("sync", 0, b""))

    def give_back_and_note(disk: Disk, offset: int, length: int) -> None:
        honest_give_back(disk, offset, length)
        found.steps.append(("write", offset, bytes(length)))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Disk, "write_parts", write_and_note)
        patch.setattr(Disk, "give_back", give_back_and_note)
        patch.setattr(Disk, "sync", sync_and_note)
        for last in (7, 23, 60):
            write(writer, writer.revolutions + 1, last)
            writer.append_event(Event(1.0, last, "note", "operator", "a note"))
            found.announce(writer.commit())
        writer.finish("stopped", "operator", "enough for today")
        writer.close()
        writer = reopen_test(path)
        write(writer, 61, 75)
        found.announce(writer.commit())
        writer.finish("complete", "complete", "done")
        writer.close()
    return found


def examine(image: bytes, folder: Path, announced: int) -> None:
    """Assert that a file as left by a crash opens and holds everything announced."""
    path = folder / "crashed.h5"
    path.write_bytes(image)
    with open_test(path) as reader:
        assert check(reader) >= announced
        assert reader.summary()["status"] in ("interrupted", "stopped", "complete")
        assert reader.first_altered_event() is None
        assert len(reader.summary()["started"]) == 32
    with h5py.File(path) as file:
        assert file["/entry/revolutions/committed"][()] >= announced


@pytest.mark.parametrize("every", [20, pytest.param(1, marks=pytest.mark.long)])
def test_cut_at_every_write_loses_no_committed_row(
    recording: Recording, quick_folder: Path, every: int
) -> None:
    image = bytearray(recording.start)
    announced = points = 0
    for kind, number, data in recording.steps:
        if kind == "safe":
            announced = number
        elif kind == "write":
            half = len(data) // 2
            image[number : number + half] = data[:half]
            if points % (7 * every) == 0 and len(data) > 8:
                examine(image, quick_folder, announced)
            image[number : number + len(data)] = data
            if points % every == 0:
                examine(image, quick_folder, announced)
            points += 1
    assert announced == 75
    assert points > 200


def power_losses(recording: Recording, folder: Path, chance: random.Random, chances: float) -> int:
    """Cut the power at random steps: synced pages are there, later ones by chance; count them."""
    durable = bytearray(recording.start)
    cache = bytearray(recording.start)
    dirty: set[int] = set()
    announced = losses = 0
    for kind, number, data in recording.steps:
        if kind == "safe":
            announced = number
        elif kind == "sync":
            for page in dirty:
                durable[page * PAGE : (page + 1) * PAGE] = cache[page * PAGE : (page + 1) * PAGE]
            dirty.clear()
        else:
            cache[number : number + len(data)] = data
            dirty.update(range(number // PAGE, (number + len(data) - 1) // PAGE + 1))
        if chance.random() < chances:
            image = bytearray(durable)
            for page in dirty:
                if chance.random() < 0.5:
                    image[page * PAGE : (page + 1) * PAGE] = cache[page * PAGE : (page + 1) * PAGE]
            examine(image, folder, announced)
            losses += 1
    return losses


def test_power_loss_loses_no_announced_row(recording: Recording, quick_folder: Path) -> None:
    assert power_losses(recording, quick_folder, random.Random(2), 0.05) > 5


@pytest.mark.soak
@pytest.mark.timeout(3600)
def test_many_power_losses(recording: Recording, quick_folder: Path) -> None:
    chance = random.Random(time.time_ns())
    assert sum(power_losses(recording, quick_folder, chance, 1.0) for _ in range(24)) > 10_000


# --------------------------------------------------------------------------------------- slow disk


def test_a_disk_that_stalls_two_seconds_delays_no_row(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    stalled, go_on = threading.Event(), threading.Event()
    honest = Disk.sync

    def stall(disk: Disk) -> None:
        stalled.set()
        assert go_on.wait(30.0)
        honest(disk)

    with new_test(quick_folder) as writer:
        write(writer, 1, 20)
        monkeypatch.setattr(Disk, "sync", stall)
        committer = threading.Thread(target=writer.commit, name="committer")
        committer.start()
        assert stalled.wait(30.0)
        write(writer, 21, 300)
        assert writer.revolutions == 300
        assert writer.revolutions_committed == 0
        assert committer.is_alive()
        with open_test(quick_folder / "test.h5") as reader:
            assert reader.committed() == 0
        go_on.set()
        committer.join(30.0)
        assert writer.revolutions_committed == 20
        assert writer.commit() == 300
        with open_test(quick_folder / "test.h5") as reader:
            assert check(reader) == 300


def test_a_disk_that_stalls_while_placing_delays_no_row(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    stalled, go_on = threading.Event(), threading.Event()
    honest = Disk.write_parts

    def stall(disk: Disk, parts: Sequence[bytes | memoryview], offset: int) -> None:
        stalled.set()
        assert go_on.wait(30.0)
        honest(disk, parts, offset)

    with new_test(quick_folder) as writer:
        monkeypatch.setattr(Disk, "write_parts", stall)
        write(writer, 1, 10)
        committer = threading.Thread(target=writer.commit, name="committer")
        committer.start()
        assert stalled.wait(30.0)
        write(writer, 11, 300)
        go_on.set()
        committer.join(30.0)
        assert writer.revolutions_committed == 10
        assert writer.commit() == 300
        with open_test(quick_folder / "test.h5") as reader:
            assert check(reader) == 300


def test_a_failing_disk_is_reported_for_good_and_costs_nothing_committed(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    writer = new_test(quick_folder)
    write(writer, 1, 20)
    assert writer.commit() == 20
    write(writer, 21, 30)

    def fail(fd: int) -> None:
        raise OSError(5, "Input/output error")

    monkeypatch.setattr(FILES, "sync", fail)
    with pytest.raises(StorageFailed, match=r"test\.h5: syncing failed \(Input/output error\)"):
        writer.commit()
    monkeypatch.undo()
    with pytest.raises(StorageFailed, match="syncing failed"):
        writer.commit()
    with pytest.raises(StorageFailed, match="syncing failed"):
        writer.append_event(Event(0.0, 0, "k", "s", "t"))
    with pytest.raises(StorageFailed, match="syncing failed"):
        writer.close()
    with open_test(quick_folder / "test.h5") as reader:
        assert check(reader) == 20
        assert reader.summary()["status"] == "interrupted"
    with reopen_test(quick_folder / "test.h5") as again:
        assert again.revolutions == 20


def test_many_threads_append_while_one_commits(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rigapp.storage.writing.backlog.SOFT_LIMIT", 4096)
    monkeypatch.setattr("rigapp.storage.writing.backlog.HARD_LIMIT", 16384)
    done = threading.Event()
    safe: list[int] = []
    with new_test(quick_folder) as writer:

        def commit_often() -> None:
            while not done.is_set():
                safe.append(writer.commit())

        def log() -> None:
            for i in range(150):
                writer.append_event(Event(float(i), i, "state", "engine", "n" * i))

        threads = [
            threading.Thread(target=commit_often, name="committer"),
            threading.Thread(target=log, name="log"),
        ]
        for thread in threads:
            thread.start()
        write(writer, 1, 300)
        threads[1].join(60.0)
        done.set()
        threads[0].join(60.0)
        assert safe == sorted(safe)
        assert writer.commit() == PLAN.revolutions
        with open_test(quick_folder / "test.h5") as reader:
            assert check(reader) == 300
            assert [one.revolution for one in reader.events()] == list(range(150))
            assert reader.first_altered_event() is None
