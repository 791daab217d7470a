"""The queue of an engine at its edges: what the disk refuses, and the end of the engine."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from stories import until

from rigapp.config.errors import UnusableInput
from rigapp.queue.items import Queue, added, halted
from rigapp.queue.store import QueueStore
from rigapp.queue.worker import QueueActions
from rigapp.schema.messages import FinishReason
from rigapp.schema.notices import Finished
from rigapp.schema.queue import ItemState
from rigapp.service import rigqueue
from rigapp.service.registry import kept_of
from rigapp.service.rigqueue import RigQueue

RIG = Path("rig.toml")


class Notices:
    """Hand out the ends that a test puts in."""

    def __init__(self) -> None:
        self.waiting: queue.Queue[object] = queue.Queue()

    def get(self, timeout_s: float) -> object | None:
        try:
            return self.waiting.get(timeout=timeout_s) if timeout_s else self.waiting.get_nowait()
        except queue.Empty:
            return None


class Desk:
    """What the engine does for the queue, on paper."""

    def __init__(self) -> None:
        self.begun: list[Path] = []
        self.told: list[str] = []
        self.ends = Notices()

    def begin(self, test: Path, file: Path, operator: str) -> Finished | None:
        self.begun.append(file)
        return None

    def end(self, status: str) -> None:
        """Let the test that was begun last end."""
        reason = FinishReason.COMPLETE if status == "complete" else FinishReason.OPERATOR
        file = str(self.begun[-1])
        self.ends.waiting.put(Finished(reason, f"It is {status}.", status, 6, file))

    def queue(self) -> RigQueue:
        return RigQueue(
            RIG, QueueActions(self.begin, (UnusableInput,), self.told.append), self.ends
        )


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    monkeypatch.setattr(rigqueue, "TRY_AGAIN_S", 0.01)
    return tmp_path


@pytest.fixture
def store(folder: Path) -> QueueStore:
    store = QueueStore(kept_of(RIG, "queues"), RIG)
    store.change(lambda queue: added(queue, ["a.toml", "b.toml", "c.toml"], str(folder)))
    return store


@pytest.fixture
def desk() -> Desk:
    return Desk()


@pytest.fixture
def opened(desk: Desk) -> Iterator[Callable[[], RigQueue]]:
    """Return the maker of queues that are closed at the end."""
    made: list[RigQueue] = []

    def make() -> RigQueue:
        made.append(desk.queue())
        return made[-1]

    yield make
    for one in made:
        one.close()


def states(store: QueueStore) -> list[ItemState]:
    return [one.state for one in store.read().items]


def test_a_queue_that_cannot_be_read_is_told_of_and_leaves_the_engine_alone(
    store: QueueStore, desk: Desk, opened: Callable[[], RigQueue]
) -> None:
    kept_of(RIG, "queues").write_bytes(b"{")
    one = opened()
    assert "cannot be read" in desk.told[0]
    assert "move the file away" in desk.told[0]
    assert one.view() == Queue(rig=str(RIG.resolve()))
    with pytest.raises(UnusableInput, match="cannot be read"):
        one.start("Ada")
    assert desk.begun == []


def test_an_end_that_the_disk_does_not_take_is_noted_when_it_does(
    store: QueueStore,
    desk: Desk,
    opened: Callable[[], RigQueue],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    one = opened()
    one.start("Ada")
    full = threading.Event()
    full.set()
    change = one.store.change

    def refusing(how: Callable[[Queue], Queue]) -> Queue:
        if full.is_set():
            raise UnusableInput("no space left on the device")
        return change(how)

    monkeypatch.setattr(one.store, "change", refusing)
    desk.end("complete")
    until(lambda: "no space left on the device" in desk.told, "it is told")
    assert states(store)[0] is ItemState.RUNNING
    full.clear()
    until(lambda: states(store)[:2] == ["done", "running"], "the next one is begun")


def test_the_end_of_the_engine_is_noted_and_begins_nothing(
    store: QueueStore, desk: Desk, opened: Callable[[], RigQueue]
) -> None:
    one = opened()
    one.start("Ada")
    one.halt()
    desk.end("complete")
    one.close()
    assert states(store) == ["done", "waiting", "waiting"]
    assert len(desk.begun) == 1
    again = opened()
    assert desk.told[-1] == "the engine ended between two tests; 2 more wait."
    again.start("Ada")
    desk.end("stopped")
    until(lambda: states(store)[1] is ItemState.STOPPED, "the end is noted")
    again.close()
    desk.told.clear()
    opened()
    assert desk.told == ["test 2, b.toml: It is stopped. 1 more wait."]


def test_a_queue_that_stands_is_no_news(
    store: QueueStore, desk: Desk, opened: Callable[[], RigQueue]
) -> None:
    store.change(halted)
    opened()
    assert desk.told == []


def test_what_lasts_is_kept_for_this_run_where_the_folder_for_data_is_closed(
    folder: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    (folder / "file").touch()
    monkeypatch.delenv("RIGAPP_RUNTIME_DIR")
    (folder / "session").mkdir()
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(folder / "session"))
    monkeypatch.setenv("XDG_DATA_HOME", str(folder / "file"))
    kept = kept_of(RIG, "queues")
    assert kept.parent == folder / "session" / "rigapp" / "queues"
    assert "until the computer is started again" in caplog.text
