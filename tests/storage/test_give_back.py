"""An ended test gives the room back that it did not need, and never a byte that it did."""

from __future__ import annotations

import os
import stat
import subprocess
import sys
from pathlib import Path

import pytest
from storage_samples import PLAN, check, new_test, write

from rigapp.schema.messages import Event
from rigapp.storage import FilePlan, compact_test, open_test, reopen_test
from rigapp.storage.filesystem.disk import Disk
from rigapp.storage.filesystem.folder import hidden_name, remove_stale
from rigapp.storage.filesystem.posix import punch_hole

MEGABYTE = 1 << 20


class Killed(BaseException):
    """Stands for the end of the process."""


def allocated(path: Path) -> int:
    return path.stat().st_blocks * 512


@pytest.fixture(autouse=True)
def _needs_holes(tmp_path: Path) -> None:
    with (tmp_path / "probe").open("wb+") as file:
        file.write(bytes(MEGABYTE))
        file.flush()
        if not punch_hole(file.fileno(), 0, MEGABYTE):
            pytest.skip("this file system gives no space back")


def test_a_long_test_that_was_stopped_early_takes_little_room(tmp_path: Path) -> None:
    plan = FilePlan(revolutions=90_000, cycles=1000, samples_per_cycle=3600, events=8192)
    writer = new_test(tmp_path, plan)
    path = tmp_path / "test.h5"
    before = allocated(path)
    assert before > 200 * MEGABYTE
    write(writer, 1, 44)
    writer.finish("stopped", "operator", "enough")
    writer.close()
    assert allocated(path) < 6 * MEGABYTE
    with open_test(path) as reader:
        assert check(reader) == 44
        assert reader.summary()["status"] == "stopped"
    again = reopen_test(path)
    assert allocated(path) >= 0.9 * before
    write(again, 45, 60)
    assert again.commit() == 60
    again.finish("stopped", "operator", "enough")
    again.close()
    assert allocated(path) < 6 * MEGABYTE
    with open_test(path) as reader:
        assert check(reader) == 60
        assert reader.first_altered_event() is None
    assert compact_test(path)
    with open_test(path) as reader:
        assert check(reader) == 60


@pytest.mark.long
def test_a_kill_at_any_moment_of_the_giving_back_costs_nothing(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    honest, left = Disk.give_back, [0]

    def killed(disk: Disk, offset: int, length: int) -> None:
        if left[0] == 0:
            raise Killed
        left[0] -= 1
        honest(disk, offset, length)

    monkeypatch.setattr(Disk, "give_back", killed)
    kills = 0
    while True:
        writer = new_test(quick_folder)
        writer.append_event(Event(1.0, 0, "note", "Ann", "a note"))
        write(writer, 1, 33)
        left[0] = kills
        try:
            writer.finish("stopped", "operator", "enough")
            break
        except Killed:
            os.close(writer._disk.fd)
        path = quick_folder / "test.h5"
        with open_test(path) as reader:
            assert check(reader) == 33
            assert reader.summary()["status"] == "stopped"
            assert reader.first_altered_event() is None
        if kills % 10 == 0:
            left[0] = 10_000
            with reopen_test(path) as again:
                write(again, 34, PLAN.revolutions)
                assert again.commit() == PLAN.revolutions
        path.unlink()
        kills += 9
    writer.close()
    assert kills > 60


def test_a_file_system_that_gives_nothing_back_is_no_fault(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rigapp.storage.filesystem.posix._fallocate", lambda: None)
    writer = new_test(quick_folder)
    write(writer, 1, 5)
    writer.finish("stopped", "operator", "enough")
    writer.close()
    with open_test(quick_folder / "test.h5") as reader:
        assert check(reader) == 5


def test_what_killed_processes_leave_is_cleaned_when_the_next_test_begins(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait()
    with new_test(quick_folder, name="old.h5") as writer:
        write(writer, 1, 5)
    old = quick_folder / "old.h5"
    with monkeypatch.context() as patch:
        patch.setattr(os, "getpid", lambda: ended.pid)
        left = [hidden_name(quick_folder / "gone.h5", what) for what in ("new", "packed")]
        left.append(hidden_name(old, "opened"))
    own = hidden_name(quick_folder / "mine.h5")
    for path in (*left, own):
        path.touch()
    old.chmod(0o644)
    with new_test(quick_folder):
        assert not any(path.exists() for path in left)
        assert own.exists()
        assert stat.S_IMODE(old.stat().st_mode) == 0o444


def test_a_kill_between_opening_and_protecting_is_mended(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with new_test(quick_folder) as writer:
        write(writer, 1, 5)
    path = quick_folder / "test.h5"
    program = (
        "import os, sys\n"
        "from rigapp.storage.upkeep import resume\n"
        "os.access = lambda *_: False\n"
        "resume.FILES.protect = lambda fd: os._exit(9)\n"
        "resume.reopen_test(sys.argv[1])\n"
    )
    assert subprocess.run([sys.executable, "-c", program, path], check=False).returncode == 9
    assert stat.S_IMODE(path.stat().st_mode) == 0o644
    remove_stale(quick_folder)
    assert stat.S_IMODE(path.stat().st_mode) == 0o444
    assert [one.name for one in quick_folder.iterdir()] == ["test.h5"]
