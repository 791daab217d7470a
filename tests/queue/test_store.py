"""The queue on the disk: whole or not at all, one process after the other."""

from __future__ import annotations

import stat
import threading
from pathlib import Path

import pytest

from rigapp.config.errors import UnusableInput
from rigapp.process.locks import taken
from rigapp.queue import store as stores
from rigapp.queue.items import added
from rigapp.queue.store import QueueStore


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "queue.json"


def test_what_is_changed_is_read_again_by_another_program(path: Path, tmp_path: Path) -> None:
    rig = tmp_path / "rig.toml"
    assert QueueStore(path, rig).read().rig == str(rig.resolve())
    changed = QueueStore(path, rig).change(lambda queue: added(queue, ["a.toml"], "results"))
    assert QueueStore(path, rig).read() == changed
    assert stat.S_IMODE(path.stat().st_mode) == 0o600


def test_changes_at_once_are_all_kept(path: Path) -> None:
    def add() -> None:
        for _ in range(10):
            QueueStore(path, path).change(lambda queue: added(queue, ["a.toml"], "r"))

    threads = [threading.Thread(target=add) for _ in range(4)]
    for one in threads:
        one.start()
    for one in threads:
        one.join(60.0)
    items = QueueStore(path, path).read().items
    assert [one.number for one in items] == list(range(1, 41))


def test_a_change_that_is_refused_leaves_the_queue_as_it_was(path: Path) -> None:
    store = QueueStore(path, path)
    before = store.change(lambda queue: added(queue, ["a.toml"], "r"))

    def refuse(queue: object) -> object:
        raise UnusableInput("no")

    with pytest.raises(UnusableInput, match="no"):
        store.change(refuse)  # type: ignore[arg-type]
    assert store.read() == before


def test_a_file_that_is_no_queue_is_named_and_kept(path: Path) -> None:
    path.write_text("not json", "utf-8")
    with pytest.raises(UnusableInput, match=r"queue\.json: the queue cannot be read.*move"):
        QueueStore(path, path).read()
    with pytest.raises(UnusableInput):
        QueueStore(path, path).change(lambda queue: queue)
    assert path.read_text("utf-8") == "not json"


def test_a_lock_that_is_not_given_back_is_named(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(stores, "LOCK_S", 0.1)
    with path.with_suffix(".lock").open("ab") as file:
        assert taken(file.fileno())
        with pytest.raises(UnusableInput, match="another program has been changing the queue"):
            QueueStore(path, path).change(lambda queue: queue)
    QueueStore(path, path).change(lambda queue: queue)
