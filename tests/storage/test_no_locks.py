"""Files are made, read, resumed and closed on a file system without locks."""

from __future__ import annotations

import errno
import fcntl
import os
import subprocess
import sys
from pathlib import Path

import pytest
from storage_samples import check, new_test, write

from rigapp.config.errors import UnusableInput
from rigapp.storage import close_test, compact_test, open_test, reopen_test

WITHOUT = """
import errno, fcntl, sys
def refuse(*_):
    raise OSError({number}, "no locks")
fcntl.fcntl = fcntl.flock = fcntl.lockf = refuse
"""


@pytest.fixture(params=[errno.ENOLCK, errno.EOPNOTSUPP, errno.ENOSYS, 524])
def no_locks(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> int:
    """Let the system refuse every lock of this process as such a file system does."""

    def refuse(*_: object) -> None:
        raise OSError(request.param, "no locks")

    for name in ("fcntl", "flock", "lockf"):
        monkeypatch.setattr(fcntl, name, refuse)
    return int(request.param)


@pytest.mark.sampled
def test_a_test_is_made_resumed_and_closed_without_locks(quick_folder: Path, no_locks: int) -> None:
    with new_test(quick_folder) as writer:
        write(writer, 1, 20)
        writer.commit()
        with open_test(writer.path) as reader:
            assert reader.summary()["status"] == "running"
        with pytest.raises(UnusableInput, match="another process is writing"):
            reopen_test(writer.path)
    path = quick_folder / "test.h5"
    with open_test(path) as reader:
        assert reader.summary()["status"] == "interrupted"
    with reopen_test(path) as writer:
        write(writer, 21, 40)
    assert close_test(path) == 40
    compact_test(path)
    with open_test(path) as reader:
        assert check(reader) == 40


@pytest.mark.long
def test_another_process_is_found_without_locks(quick_folder: Path, no_locks: int) -> None:
    code = WITHOUT.format(number=no_locks) + (
        "from pathlib import Path; from storage_samples import new_test, write\n"
        "w = new_test(Path(sys.argv[1])); write(w, 1, 20); w.commit(); print('on', flush=True)\n"
        "input()"
    )
    folder = os.fspath(Path(__file__).parent)
    paths = os.pathsep.join((folder, os.environ.get("PYTHONPATH", "")))
    with subprocess.Popen(
        [sys.executable, "-c", code, quick_folder],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env={**os.environ, "PYTHONPATH": paths},
    ) as other:
        assert other.stdout is not None
        assert other.stdout.readline() == b"on\n"
        path = quick_folder / "test.h5"
        with open_test(path) as reader:
            assert reader.summary()["status"] == "running"
        with pytest.raises(UnusableInput, match="another process is writing"):
            close_test(path)
        other.kill()
    assert close_test(path) == 20


def test_who_may_only_read_keeps_nobody_out_of_an_ended_file(quick_folder: Path) -> None:
    with new_test(quick_folder) as writer:
        write(writer, 1, 20)
        writer.finish("stopped", "operator", "done")
    path = quick_folder / "test.h5"
    code = (
        "import fcntl, os, struct, sys\n"
        "fd = os.open(sys.argv[1], os.O_RDONLY)\n"
        "lock = struct.pack('hhqqi0q', fcntl.F_RDLCK, os.SEEK_SET, 1 << 62, 1, 0)\n"
        "fcntl.fcntl(fd, fcntl.F_OFD_SETLK, lock); fcntl.flock(fd, fcntl.LOCK_EX)\n"
        "print('on', flush=True); input()"
    )
    with subprocess.Popen(
        [sys.executable, "-c", code, path], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as stranger:
        assert stranger.stdout is not None
        assert stranger.stdout.readline() == b"on\n"
        with reopen_test(path) as writer:
            write(writer, 21, 30)
            with open_test(path) as reader:
                assert reader.summary()["status"] == "running"
            writer.finish("stopped", "operator", "done")
        assert compact_test(path)
        stranger.kill()
    with open_test(path) as reader:
        assert check(reader) == 30
