"""The runtime folder is ours alone, and what others put into it leads nobody anywhere."""

from __future__ import annotations

import os
import shutil
import stat
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import msgspec
import pytest
import zmq
from stories import until

from rigapp.config.errors import UnusableInput
from rigapp.process.children import KEY, bind_link, connect_link, link_address
from rigapp.process.private import SMALL_BYTES
from rigapp.process.stale_files import pid_exists, remove_left_behind
from rigapp.service.registry import (
    EngineEntry,
    announce,
    lasting_folder,
    running_engines,
    runtime_folder,
)
from rigapp.service.security import viewer_keys

pytestmark = pytest.mark.skipif(not hasattr(os, "getuid"), reason="needs owners of files")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "run"
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(folder))
    return folder


def mode(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


def test_folder_is_made_for_us_alone_whatever_the_umask(folder: Path) -> None:
    before = os.umask(0)
    try:
        assert runtime_folder() == folder
    finally:
        os.umask(before)
    assert mode(folder) == 0o700


@pytest.mark.parametrize("readable", [0o755, 0o750, 0o711])
def test_folder_that_others_can_read_is_closed_to_them(folder: Path, readable: int) -> None:
    folder.mkdir()
    folder.chmod(readable)
    runtime_folder()
    assert mode(folder) == 0o700


@pytest.mark.parametrize("writable", [0o777, 0o1777, 0o770, 0o702])
def test_folder_into_which_others_can_write_is_refused(folder: Path, writable: int) -> None:
    folder.mkdir()
    folder.chmod(writable)
    with pytest.raises(UnusableInput, match=r"run: others can write .* RIGAPP_RUNTIME_DIR"):
        runtime_folder()
    assert mode(folder) == writable


def test_link_is_refused(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir(mode=0o700)
    folder.symlink_to(tmp_path / "elsewhere")
    with pytest.raises(UnusableInput, match="run: is a link"):
        runtime_folder()
    folder.unlink()
    folder.symlink_to(tmp_path / "nowhere")
    with pytest.raises(UnusableInput, match="run: cannot be made"):
        runtime_folder()
    folder.unlink()
    folder.write_text("a file")
    with pytest.raises(UnusableInput, match="run: cannot be made"):
        runtime_folder()


def test_folder_of_somebody_else_is_refused(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    runtime_folder()
    monkeypatch.setattr(os, "getuid", lambda: folder.stat().st_uid + 1)
    with pytest.raises(UnusableInput, match="run: belongs to another user"):
        runtime_folder()


def test_keys_folder_that_is_a_link_is_refused(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    (runtime_folder() / "keys").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(UnusableInput, match="keys: is a link"):
        viewer_keys(folder)


def entry_text() -> bytes:
    return msgspec.json.encode(EngineEntry(os.getpid(), "ipc://a", "ipc://b", "rig.toml", 1.0))


def as_link(path: Path) -> None:
    target = path.parent.parent / "planted.json"
    target.write_bytes(entry_text())
    path.symlink_to(target)


def as_huge(path: Path) -> None:
    path.write_bytes(entry_text() + b" " * SMALL_BYTES)


def as_words(path: Path) -> None:
    path.write_bytes(b"\xff not an entry")


@pytest.mark.parametrize("plant", [as_link, as_huge, as_words, os.mkfifo, Path.mkdir])
def test_planted_entry_is_not_believed(folder: Path, plant: Callable[[Path], None]) -> None:
    runtime_folder()
    plant(folder / f"engine-{os.getpid()}.json")
    assert running_engines() == []


def test_entry_of_another_owner_is_not_believed(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    announce(EngineEntry(os.getpid(), "ipc://a", "ipc://b", "rig.toml", 1.0))
    assert len(running_engines()) == 1
    honest = os.fstat

    def foreign(descriptor: int) -> os.stat_result:
        found = list(honest(descriptor))
        found[stat.ST_UID] += 1
        return os.stat_result(found)

    monkeypatch.setattr("rigapp.process.private.os.fstat", foreign)
    assert running_engines() == []


def test_sockets_and_entries_of_the_dead_are_removed_those_of_the_living_stay(folder: Path) -> None:
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait()
    runtime_folder()
    names = ("engine-{}.json", "engine-{}.part", "{}.commands", "{}.snapshots", "twin-{}-7fa0")
    for pid in (ended.pid, os.getpid()):
        for name in names:
            (folder / name.format(pid)).touch()
    (folder / "engine-20260101-000000.log").touch()
    running_engines()
    assert sorted(path.name for path in folder.iterdir()) == sorted(
        [name.format(os.getpid()) for name in names] + ["engine-20260101-000000.log"]
    )


def test_a_process_that_only_has_the_number_of_the_owner_is_not_the_owner(tmp_path: Path) -> None:
    own = tmp_path / f"x-{os.getpid()}"
    own.touch()
    other = subprocess.Popen(["sleep", "1000"])
    try:
        (tmp_path / f"x-{other.pid}").touch()
        until(lambda: not pid_exists(other.pid), "the other program has taken over its process")
        removed = remove_left_behind(tmp_path, r"x-(?P<pid>\d+)")
        assert [path.name for path in removed] == [f"x-{other.pid}"]
    finally:
        other.kill()
        other.wait()
    assert list(tmp_path.iterdir()) == [own]


def test_keys_outlive_a_restart_and_those_of_before_come_along(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("RIGAPP_RUNTIME_DIR", raising=False)
    for name, folder in (("XDG_RUNTIME_DIR", "run"), ("XDG_DATA_HOME", "data")):
        (tmp_path / folder).mkdir()
        monkeypatch.setenv(name, str(tmp_path / folder))
    before = viewer_keys(runtime_folder())
    lasting = lasting_folder()
    assert lasting == tmp_path / "data" / "rigapp"
    assert viewer_keys(lasting) == before
    assert (lasting / "keys" / "viewer.key_secret").stat().st_mode & 0o077 == 0
    assert not (runtime_folder() / "keys").exists()
    shutil.rmtree(tmp_path / "run" / "rigapp")
    assert viewer_keys(lasting_folder()) == before


def test_a_link_at_a_port_lets_only_the_process_in_that_has_its_key(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    context = zmq.Context()
    try:
        ours, stranger, child = (context.socket(zmq.PAIR) for _ in range(3))
        endpoint, environment = bind_link(ours, link_address(tmp_path, "n" * 100))
        assert endpoint.startswith("tcp://127.0.0.1:")
        monkeypatch.delenv(KEY, raising=False)
        connect_link(stranger, endpoint)
        stranger.send(b"junk")
        assert not ours.poll(300)
        monkeypatch.setenv(KEY, environment[KEY])
        connect_link(child, endpoint)
        assert KEY not in os.environ
        child.send(b"answer")
        assert ours.poll(10_000)
        assert ours.recv() == b"answer"
    finally:
        context.destroy(linger=0)
