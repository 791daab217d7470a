"""The helper for child processes keeps its contract for every kind of child of the program."""

from __future__ import annotations

import io
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from patience import PATIENCE_S

from rigapp.process import children
from rigapp.process.children import Child, MessageChild, Restarts, read_frames, write_frame
from rigapp.process.stale_files import process_alive

EXAMPLES = Path(__file__).parents[2] / "examples"
pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="needs signals")


def messenger(module: str) -> Callable[[Path], Child]:
    return lambda folder: MessageChild(module, folder, "child")


KINDS: dict[str, Callable[[Path], Child]] = {
    "twin": messenger("rigapp.twin.worker"),
    "notifier": messenger("rigapp.notify.notifier"),
    "results reader": lambda folder: Child("rigapp.report.results", pipes=True),
    "simulated rig": lambda folder: Child(
        "rigapp.simulation.process", EXAMPLES / "simulated.toml", "--exit-with-parent", pipes=True
    ),
    "engine": lambda folder: Child(
        "rigapp", "engine", EXAMPLES / "simulated.toml", log=folder / "engine.log"
    ),
}


@pytest.fixture(params=KINDS.values(), ids=KINDS.keys())
def child(
    request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Child]:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    process = request.param(tmp_path)
    yield process
    process.close()


def until(condition: Callable[[], bool]) -> None:
    deadline = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.02)


def test_a_child_runs_apart_and_its_kill_is_noticed(child: Child) -> None:
    assert child.running
    assert os.getsid(child.pid) == child.pid
    os.kill(child.pid, signal.SIGKILL)
    assert child.wait(PATIENCE_S) == -signal.SIGKILL
    assert not child.running
    assert "Traceback" not in child.messages()


def test_a_child_is_ended_by_its_parent_for_sure(child: Child, tmp_path: Path) -> None:
    os.kill(child.pid, signal.SIGSTOP)
    child.close(0.1)
    child.close()
    assert not process_alive(child.pid)
    assert not [path for path in tmp_path.iterdir() if path.name.startswith("child-")]


PARENT = """
import sys, time
from pathlib import Path
from rigapp.process.children import Child, MessageChild
kind, *arguments = sys.argv[1:]
if kind == "messages":
    child = MessageChild(arguments[0], Path(arguments[1]), "child")
else:
    child = Child(*arguments, pipes=True)
print(child.pid, flush=True)
time.sleep(1000)
"""


@pytest.mark.parametrize(
    "arguments",
    [
        ("messages", "rigapp.twin.worker"),
        ("messages", "rigapp.notify.notifier"),
        ("pipes", "rigapp.report.results"),
        (
            "pipes",
            "rigapp.simulation.process",
            str(EXAMPLES / "simulated.toml"),
            "--exit-with-parent",
        ),
    ],
    ids=["twin", "notifier", "results reader", "simulated rig"],
)
def test_a_child_ends_with_a_parent_that_is_killed(
    arguments: tuple[str, ...], tmp_path: Path
) -> None:
    folder = (str(tmp_path),) if arguments[0] == "messages" else ()
    command = [sys.executable, "-c", PARENT, *arguments, *folder]
    with subprocess.Popen(command, stdout=subprocess.PIPE) as parent:
        assert parent.stdout is not None
        pid = int(parent.stdout.readline())
        parent.kill()
    until(lambda: not process_alive(pid))


def test_the_reason_of_a_failure_is_kept() -> None:
    child = Child("rigapp.simulation.process", "missing.toml", pipes=True)
    assert child.wait(PATIENCE_S) == 2
    assert "missing.toml" in child.last_words()
    child.close()


def test_the_pause_between_restarts_grows_until_a_child_succeeds() -> None:
    restarts = Restarts(1.0, attempts=8)
    pauses = []
    while not restarts.exhausted:
        restarts.started()
        pauses.append(restarts.pause_s)
    assert pauses == [2.0, 4.0, 8.0, 16.0, 32.0, 60.0, 60.0, 60.0]
    restarts.succeeded()
    assert restarts.pause_s == 1.0
    assert not restarts.exhausted


def test_a_frame_that_is_too_long_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = io.BytesIO()
    for data in (b"", b"one", b"four"):
        write_frame(stream, data)
    stream.seek(0)
    assert list(read_frames(stream)) == [b"", b"one", b"four"]
    monkeypatch.setattr(children, "LONGEST_MESSAGE", 3)
    stream.seek(0)
    with pytest.raises(ValueError, match="4 bytes; the maximum is 3"):
        list(read_frames(stream))
