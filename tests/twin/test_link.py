"""The twin's process: it answers, is started again when it dies, and never blocks the engine."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from rigapp.config.loading import read_parameter_file
from rigapp.engine.messages import Prediction, RevolutionMeasured
from rigapp.twin.link import MAILBOX, TwinLink
from rigapp.twin.worker import TwinSetup

SETUP = TwinSetup(
    parameters=read_parameter_file(
        Path(__file__).parents[2] / "examples" / "parameters.toml"
    ).record,
    joint="continuous",
)


def revolution(number: int) -> RevolutionMeasured:
    time_s = np.linspace(0.0, 2.0, 500, endpoint=False)
    zeros = np.zeros(500)
    arrays = (time_s, np.pi * time_s, zeros, zeros, zeros, zeros)
    return RevolutionMeasured(number, *(a.astype("<f8").tobytes() for a in arrays))


class Inbox:
    """Collect predictions."""

    def __init__(self) -> None:
        self.numbers: list[int] = []
        self._condition = threading.Condition()

    def __call__(self, prediction: Prediction) -> None:
        with self._condition:
            self.numbers.append(prediction.revolution)
            self._condition.notify_all()

    def wait(self, condition: Callable[[], bool], seconds: float = 30.0) -> None:
        with self._condition:
            assert self._condition.wait_for(condition, seconds), self.numbers


@pytest.fixture
def inbox() -> Inbox:
    return Inbox()


@pytest.fixture
def link(tmp_path: Path, inbox: Inbox) -> Iterator[TwinLink]:
    link = TwinLink(SETUP, inbox, tmp_path)
    yield link
    link.close()
    assert link.worker_pid == 0


def test_every_revolution_is_predicted_in_order(link: TwinLink, inbox: Inbox) -> None:
    assert link.wait_ready(60.0)
    for number in range(1, 21):
        link.offer(revolution(number))
    inbox.wait(lambda: len(inbox.numbers) == 20)
    assert inbox.numbers == list(range(1, 21))
    assert link.dropped == 0


def test_killed_worker_is_started_again(link: TwinLink, inbox: Inbox) -> None:
    assert link.wait_ready(60.0)
    os.kill(link.worker_pid, signal.SIGKILL)
    deadline = time.monotonic() + 60.0
    while link.restarts < 1 or 99 not in inbox.numbers:
        assert time.monotonic() < deadline
        link.offer(revolution(99))
        time.sleep(0.05)
    assert link.restarts == 1


def test_stalled_worker_drops_the_oldest_and_blocks_nobody(link: TwinLink, inbox: Inbox) -> None:
    assert link.wait_ready(60.0)
    os.kill(link.worker_pid, signal.SIGSTOP)
    for number in range(MAILBOX + 30):
        link.offer(revolution(number))
    assert link.dropped >= 29
    os.kill(link.worker_pid, signal.SIGCONT)
    inbox.wait(lambda: MAILBOX + 29 in inbox.numbers)
