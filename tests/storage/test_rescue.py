"""A file deleted, moved or replaced while it is written keeps everything and gets a name again."""

from __future__ import annotations

import os
import shutil
import tempfile
import threading
from collections.abc import Callable
from pathlib import Path

import pytest
from storage_samples import PLAN, check, new_test, write

from rigapp.schema.messages import Event, PathReport
from rigapp.storage import StorageFailed, TestWriter, compact_test, open_test, reopen_test
from rigapp.storage.filesystem import rescue
from rigapp.storage.filesystem.system import FILES

Deed = Callable[[Path], object]


def _delete(path: Path) -> None:
    path.unlink()


def _move(path: Path) -> None:
    path.rename(path.with_name("elsewhere.h5"))


def _move_folder(path: Path) -> None:
    path.parent.rename(path.parent.with_name("old"))


def _delete_folder(path: Path) -> None:
    shutil.rmtree(path.parent)


def _replace(path: Path) -> None:
    other = path.with_name("other")
    other.write_bytes(b"something else")
    other.replace(path)


def _move_and_replace(path: Path) -> None:
    _move(path)
    path.write_bytes(b"something else")


DEEDS = {
    "deleted": _delete,
    "moved": _move,
    "folder moved": _move_folder,
    "folder deleted": _delete_folder,
    "replaced": _replace,
    "moved and replaced": _move_and_replace,
}


@pytest.fixture(autouse=True)
def home(quick_folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Give the last resorts folders of their own."""
    folder = quick_folder / "home"
    folder.mkdir()
    monkeypatch.setenv("HOME", str(folder))
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    return folder


def begun(folder: Path) -> TestWriter:
    """Return the writer of a test with rows that are committed, handed over and buffered."""
    folder.mkdir(exist_ok=True)
    writer = new_test(folder)
    write(writer, 1, 100)
    writer.commit()
    write(writer, 101, 130)
    writer.place()
    write(writer, 131, 140)
    return writer


def saved(found: PathReport | None) -> str:
    """Return the sentence of a file that was saved."""
    assert found is not None
    assert found.saved, found.sentence
    return found.sentence


@pytest.mark.parametrize(
    "deed",
    [pytest.param(one, marks=pytest.mark.long if at else ()) for at, one in enumerate(DEEDS)],
)
def test_nothing_is_lost_and_the_test_goes_on(quick_folder: Path, deed: str) -> None:
    path = quick_folder / "results" / "test.h5"
    with begun(path.parent) as writer:
        assert writer.watch_path() is None
        DEEDS[deed](path)
        sentence = saved(writer.watch_path())
        assert str(path) in sentence
        assert str(writer.path) in sentence
        assert writer.watch_path() is None
        assert FILES.is_held(writer.path, "")
        with open_test(writer.path) as reader:
            assert reader.summary()["status"] == "running"
            assert check(reader) == 100
        write(writer, 141, 300)
        writer.finish("complete", "complete", "done")
        final = writer.path
    assert ("replaced" in deed) == (final != path)
    if "replaced" in deed:
        assert path.read_bytes() == b"something else"
        assert final.name == "test-saved-1.h5"
    with open_test(final) as reader:
        assert check(reader) == 300
        assert reader.summary()["status"] == "complete"
        assert reader.committed("cycles") == 30
    assert compact_test(final)
    with open_test(final) as reader:
        assert check(reader) == 300
    assert not list(quick_folder.rglob(".*"))


def test_writing_while_the_file_is_copied_is_not_lost(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rigapp.storage.writing.backlog.SOFT_LIMIT", 4096)
    path = quick_folder / "results" / "test.h5"
    inside, go_on = threading.Event(), threading.Event()
    copy = rescue.copy_content

    def slowly(source: int, target: int) -> None:
        copy(source, target)
        inside.set()
        assert go_on.wait(60.0)

    monkeypatch.setattr(rescue, "copy_content", slowly)
    with begun(path.parent) as writer:
        path.unlink()
        found: list[PathReport | None] = []
        told: list[str] = []
        looking = threading.Thread(target=lambda: found.append(writer.watch_path(told.append)))
        looking.start()
        assert inside.wait(60.0)
        assert told == [
            f"{path} was deleted while the test writes it; everything in it is being saved."
        ]
        write(writer, 141, 220)
        writer.append_event(Event(1.0, 220, "note", "Ann", "while it was copied"))
        assert writer.commit() == 220
        write(writer, 221, 230)
        go_on.set()
        looking.join(60.0)
        saved(found[0])
        with open_test(path) as reader:
            assert check(reader) == 220
        write(writer, 231, 300)
        writer.finish("complete", "complete", "done")
    with open_test(path) as reader:
        assert check(reader) == 300
        assert [one.text for one in reader.events()] == ["while it was copied"]
        assert reader.first_altered_event() is None


def test_the_room_of_the_test_is_reserved_again(quick_folder: Path) -> None:
    with begun(quick_folder / "results") as writer:
        before = os.stat(writer.path).st_blocks
        writer.path.unlink()
        saved(writer.watch_path())
        assert os.stat(writer.path).st_blocks >= before
        assert writer.path.stat().st_mode & 0o777 == 0o444


def test_an_interrupted_test_goes_on_in_the_saved_file(quick_folder: Path) -> None:
    writer = begun(quick_folder / "results")
    path = writer.path
    path.unlink()
    saved(writer.watch_path())
    os.close(writer._disk.fd)
    with reopen_test(path) as again:
        assert again.revolutions == 100
        write(again, 101, PLAN.revolutions)
        again.finish("complete", "complete", "done")
    with open_test(path) as reader:
        assert check(reader) == PLAN.revolutions


def test_where_a_file_was_moved_is_told_where_the_kernel_knows(quick_folder: Path) -> None:
    with begun(quick_folder / "results") as writer:
        path = writer.path
        _move(path)
        assert "(deleted)" not in saved(writer.watch_path())
        path.with_name("elsewhere.h5").unlink()
    with reopen_test(path) as writer:
        _move(path)
        assert f"{path} was moved to {path.with_name('elsewhere.h5')}" in saved(writer.watch_path())


def test_a_file_deleted_just_before_the_end_is_there_after_it(quick_folder: Path) -> None:
    with begun(quick_folder / "results") as writer:
        path = writer.path
        path.unlink()
        writer.finish("stopped", "operator", "stopped")
    with open_test(path) as reader:
        assert check(reader) == 140
        assert reader.summary()["status"] == "stopped"


def test_without_its_folder_the_file_is_saved_at_home(quick_folder: Path, home: Path) -> None:
    path = quick_folder / "results" / "test.h5"
    with begun(path.parent) as writer:
        shutil.rmtree(path.parent)
        path.parent.write_text("a file where the folder was")
        sentence = saved(writer.watch_path())
        assert writer.path == home / "test.h5"
        assert str(home / "test.h5") in sentence
        writer.finish("stopped", "operator", "stopped")
    with open_test(home / "test.h5") as reader:
        assert check(reader) == 140


def test_what_cannot_be_saved_is_told_and_tried_again(quick_folder: Path, home: Path) -> None:
    path = quick_folder / "results" / "test.h5"
    with begun(path.parent) as writer:
        shutil.rmtree(path.parent)
        home.rmdir()
        for place in (path.parent, home):
            place.write_text("a file where the folder was")
        found = writer.watch_path()
        assert found is not None
        assert not found.saved
        assert str(path) in found.sentence
        write(writer, 141, 150)
        assert writer.commit() == 150
        path.parent.unlink()
        saved(writer.watch_path())
        with open_test(path) as reader:
            assert check(reader) == 150


def test_a_file_that_is_cut_short_is_told(quick_folder: Path) -> None:
    with begun(quick_folder / "results") as writer:
        os.ftruncate(writer._disk.fd, 100_000)
        with pytest.raises(StorageFailed, match="truncated the file"):
            writer.watch_path()
