"""The portable way of writing a test file loses as little: the suites of crashes run on it too."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import psutil
import pytest
from patience import PATIENCE_S
from storage_samples import check, ended

from rigapp.storage import open_test
from rigapp.storage.filesystem.portable import PortableFiles
from rigapp.storage.upkeep import compact, resume

HERE = Path(__file__).parent
SUITES = ("test_crash.py", "test_resume.py", "test_roundtrip.py", "test_whole.py")
NOT_PORTABLE = ("test_a_resumed_file_is_write_protected_again",)
HOST = os.uname().nodename


@pytest.mark.long
@pytest.mark.parametrize("suite", SUITES)
def test_what_holds_of_files_holds_of_portable_ones(suite: str) -> None:
    others = [f"not {name}" for name in NOT_PORTABLE]
    asked = ["-m", "not soak", "-k", " and ".join(others), "-p", "no:cacheprovider"]
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", *asked, str(HERE / suite)],
        cwd=HERE.parents[1],
        env={**os.environ, "RIGAPP_FILES": "portable"},
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
    assert done.returncode == 0, done.stdout


def test_bytes_go_where_they_belong(tmp_path: Path) -> None:
    files = PortableFiles()
    with (tmp_path / "f").open("w+b") as file:
        fd = file.fileno()
        files.reserve(fd, 0, 10)
        assert os.fstat(fd).st_size == 10
        assert files.write_at(fd, (b"a", b"bc"), 4) == 3
        files.reserve(fd, 0, 8)
        files.sync(fd)
        assert files.read_at(fd, 20, 2) == b"\0\0abc\0\0\0"
        assert list(files.data_ranges(fd, 10)) == [(0, 10)]


def test_a_file_gets_its_name_and_never_another_ones(tmp_path: Path) -> None:
    files, hidden, path = PortableFiles(), tmp_path / ".new", tmp_path / "t.h5"
    fd = os.open(hidden, os.O_RDWR | os.O_CREAT)
    try:
        path.write_bytes(b"first")
        with pytest.raises(FileExistsError):
            files.settle(fd, hidden, path)
        path.unlink()
        files.settle(fd, hidden, path)
        files.write_at(fd, (b"second",), 0)
    finally:
        os.close(fd)
    assert path.read_bytes() == b"second"
    assert not hidden.exists()


def test_a_file_is_not_open_while_another_one_takes_its_place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = ended(tmp_path)
    replace, opened = os.replace, []

    def watched(old: Path, new: Path) -> None:
        opened.extend(one.path for one in psutil.Process().open_files())
        replace(old, new)

    files = PortableFiles()
    for module in (compact, resume):
        monkeypatch.setattr(module, "FILES", files)
    monkeypatch.setattr(os, "replace", watched)
    assert compact.compact_test(path)
    assert str(path) not in opened
    with open_test(path) as reader:
        assert reader.compressed
        assert check(reader) == 150
    with path.open("rb") as file:
        assert files.hold(file.fileno())


def test_a_writer_is_known_while_it_lives(tmp_path: Path) -> None:
    files, path = PortableFiles(), tmp_path / "t.h5"
    with path.open("w+b") as file:
        assert files.hold(file.fileno())
        assert not files.hold(file.fileno())
        assert files.is_held(path, "")
        files.release(file.fileno())
        assert not files.is_held(path, f"process {os.getpid()} on {HOST}")
    with subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE) as other:
        named = f"process {other.pid} on {HOST}"
        begun_s = psutil.Process(other.pid).create_time()
        os.utime(path, (begun_s + 1.0, begun_s + 1.0))
        assert files.is_held(path, named)
        assert files.is_taken(path, named)
        assert not files.is_held(path, f"process {other.pid} on elsewhere")
        os.utime(path, (begun_s - 60.0, begun_s - 60.0))
        assert not files.is_held(path, named), "a process that began later has not written it"
        os.utime(path, (begun_s + 1.0, begun_s + 1.0))
        other.communicate(b"\n")
    assert not files.is_held(path, named)
