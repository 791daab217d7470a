"""What waits for the disk goes there in few calls, and later writes lie over earlier ones."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from rigapp.storage.filesystem.calls import Bytes
from rigapp.storage.filesystem.disk import Disk
from rigapp.storage.filesystem.system import FILES
from rigapp.storage.writing.backlog import RUN_BYTES, Backlog

COLUMNS = (0, 1 << 20)
"""Where two columns begin."""


@pytest.fixture
def disk(tmp_path: Path) -> Iterator[Disk]:
    path = tmp_path / "file"
    fd = os.open(path, os.O_RDWR | os.O_CREAT)
    yield Disk(fd, path)
    os.close(fd)


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> list[tuple[int, int]]:
    """Return offset and length of each write of the system, as they come."""
    found: list[tuple[int, int]] = []
    honest = FILES.write_at

    def write_at(fd: int, parts: Sequence[Bytes], offset: int) -> int:
        found.append((offset, sum(map(len, parts))))
        return honest(fd, parts, offset)

    monkeypatch.setattr(FILES, "write_at", write_at)
    return found


def part(text: bytes) -> memoryview:
    return memoryview(text)


def test_parts_of_a_column_that_follow_each_other_are_one_call(
    disk: Disk, calls: list[tuple[int, int]]
) -> None:
    backlog = Backlog(disk)
    for cycle in range(5):
        backlog.put([(part(b"%d" % cycle * 8), start + 8 * cycle) for start in COLUMNS])
    assert backlog.bytes == 80
    backlog.drain()
    assert calls == [(start, 40) for start in COLUMNS]
    assert backlog.bytes == 0
    backlog.put([(part(b"5" * 8), 40)])
    backlog.drain()
    for start, cycles in zip(COLUMNS, (6, 5), strict=True):
        assert os.pread(disk.fd, 64, start)[: 8 * cycles] == b"".join(
            b"%d" % cycle * 8 for cycle in range(cycles)
        )


def test_no_call_is_longer_than_a_run(disk: Disk, calls: list[tuple[int, int]]) -> None:
    backlog, size = Backlog(disk), RUN_BYTES // 4
    for cycle in range(10):
        backlog.put([(part(b"%d" % cycle * size), cycle * size)])
    backlog.drain()
    assert [length for _, length in calls] == [RUN_BYTES, RUN_BYTES, RUN_BYTES // 2]
    assert os.pread(disk.fd, 1 << 22, 0) == b"".join(b"%d" % cycle * size for cycle in range(10))


def test_what_lies_over_others_keeps_its_turn(disk: Disk) -> None:
    backlog = Backlog(disk)
    backlog.put([(part(b"row 1..."), 0)])
    backlog.put_over([(part(b"nothing." * 4), 8)])
    backlog.put([(part(b"row 2..."), 8)])
    backlog.put_over([(part(b"nothing." * 2), 24)])
    backlog.put([(part(b"row 3..."), 16)])
    backlog.drain()
    assert os.pread(disk.fd, 64, 0) == b"row 1...row 2...row 3...nothing.nothing."


def test_a_call_that_writes_a_part_only_is_gone_on_with(
    disk: Disk, monkeypatch: pytest.MonkeyPatch
) -> None:
    honest = FILES.write_at
    monkeypatch.setattr(
        FILES, "write_at", lambda fd, parts, offset: honest(fd, (b"".join(parts)[:5],), offset)
    )
    disk.write_parts((b"abcd", b"efgh", b"ijkl"), 2)
    assert os.pread(disk.fd, 20, 0) == b"\0\0abcdefghijkl"
