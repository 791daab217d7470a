"""The twin's process: it answers, is started again when it dies, and never blocks the engine."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import msgspec
import numpy as np
import pytest

from rigapp.config.loading import read_parameter_file
from rigapp.schema.columns import prediction_columns
from rigapp.schema.messages import Prediction, RevolutionMeasured, as_array
from rigapp.twin.checkpoint import Checkpoint
from rigapp.twin.link import MAILBOX, TwinLink, TwinSetup

SETUP = TwinSetup(
    parameters=read_parameter_file(
        Path(__file__).parents[2] / "examples" / "parameters.toml"
    ).record,
    joint="continuous",
)

DEPTH = [one.name for one in prediction_columns()].index("wear_depth")


def revolution(number: int, speed: float = np.pi, force_N: float = 0.0) -> RevolutionMeasured:
    time_s = np.linspace(0.0, 2.0, 500, endpoint=False)
    zeros = np.zeros(500)
    arrays = (time_s, speed * time_s, zeros + force_N, zeros, zeros, zeros)
    return RevolutionMeasured(number, *(a.astype("<f8").tobytes() for a in arrays))


class Inbox:
    """Collect predictions."""

    def __init__(self) -> None:
        self.numbers: list[int] = []
        self.depths: dict[int, float] = {}
        self.checkpoint = b""
        self._condition = threading.Condition()

    def __call__(self, prediction: Prediction) -> None:
        with self._condition:
            self.numbers.append(prediction.revolution)
            self.depths[prediction.revolution] = float(as_array(prediction.values, "<f8")[DEPTH])
            self.checkpoint = prediction.checkpoint or self.checkpoint
            self._condition.notify_all()

    def wait(self, condition: Callable[[], bool], seconds: float = 90.0) -> None:
        with self._condition:
            assert self._condition.wait_for(condition, seconds), self.numbers


@pytest.fixture
def inbox() -> Inbox:
    return Inbox()


@pytest.fixture
def reports() -> list[str]:
    return []


@pytest.fixture
def link(tmp_path: Path, inbox: Inbox, reports: list[str]) -> Iterator[TwinLink]:
    link = TwinLink(SETUP, inbox, tmp_path, reports.append)
    yield link
    link.close()
    assert link.worker_pid == 0


@pytest.mark.long
def test_a_worker_is_reached_through_a_port_where_the_folder_has_a_long_name(
    tmp_path: Path, inbox: Inbox
) -> None:
    link = TwinLink(SETUP, inbox, tmp_path / ("long" * 25))
    try:
        link.offer(revolution(1))
        inbox.wait(lambda: inbox.numbers == [1])
    finally:
        link.close()


@pytest.mark.long  # in order before and after a restart, which the next one proves, too
def test_every_revolution_is_predicted_in_order(link: TwinLink, inbox: Inbox) -> None:
    assert link.wait_ready(60.0)
    for number in range(1, 21):
        link.offer(revolution(number))
    inbox.wait(lambda: len(inbox.numbers) == 20)
    assert inbox.numbers == list(range(1, 21))
    assert link.dropped == 0


def test_killed_worker_is_started_again_and_goes_on(
    link: TwinLink, inbox: Inbox, reports: list[str]
) -> None:
    assert link.wait_ready(60.0)
    for number in range(1, 41):
        link.offer(revolution(number))
    inbox.wait(lambda: 40 in inbox.numbers)
    before = inbox.depths[40]
    os.kill(link.worker_pid, signal.SIGKILL)
    link.offer(revolution(41))
    inbox.wait(lambda: 41 in inbox.numbers, 90.0)
    assert link.restarts >= 1
    assert inbox.numbers == list(range(1, 42))
    assert before < inbox.depths[41] < 1.05 * before
    assert link.dropped == 0
    assert any("after revolution 40" in text for text in reports)


@pytest.mark.long
def test_a_new_link_goes_on_from_a_checkpoint(link: TwinLink, inbox: Inbox, tmp_path: Path) -> None:
    assert link.wait_ready(60.0)
    for number in range(1, 31):
        link.offer(revolution(number))
    inbox.wait(lambda: 30 in inbox.numbers)
    setup = msgspec.structs.replace(SETUP, checkpoint=inbox.checkpoint)
    assert msgspec.msgpack.decode(inbox.checkpoint, type=Checkpoint).newest == 30
    second = Inbox()
    other = TwinLink(setup, second, tmp_path)
    try:
        for number in (31, 32):
            other.offer(revolution(number))
            link.offer(revolution(number))
        second.wait(lambda: 32 in second.numbers, 90.0)
        inbox.wait(lambda: 32 in inbox.numbers)
    finally:
        other.close()
    assert second.depths[32] == pytest.approx(inbox.depths[32], rel=1e-3)


def test_stalled_worker_drops_the_oldest_and_blocks_nobody(
    link: TwinLink, inbox: Inbox, reports: list[str]
) -> None:
    assert link.wait_ready(60.0)
    os.kill(link.worker_pid, signal.SIGSTOP)
    for number in range(MAILBOX + 30):
        link.offer(revolution(number))
    assert link.dropped >= 29
    os.kill(link.worker_pid, signal.SIGCONT)
    inbox.wait(lambda: MAILBOX + 29 in inbox.numbers)
    assert any(text.startswith("revolutions ") and "not predicted" in text for text in reports)


@pytest.mark.long
def test_revolutions_that_cannot_be_predicted_are_told_and_nobody_dies(
    link: TwinLink, inbox: Inbox, reports: list[str], capfd: pytest.CaptureFixture[str]
) -> None:
    assert link.wait_ready(60.0)
    link.offer(revolution(1))
    for number, speed in ((2, -np.pi), (3, 0.0), (4, np.nan), (5, -np.nan)):
        link.offer(revolution(number, speed=speed))
    link.offer(revolution(6, force_N=np.nan))
    link.offer(revolution(7))
    inbox.wait(lambda: 7 in inbox.numbers)
    link.close()
    assert inbox.numbers == [1, 7]
    assert link.restarts == 0
    assert any(
        "revolution 2: 1 not predicted, the crank did not turn forward" in r for r in reports
    )
    assert any(
        "revolutions 3 to 6: 4 not predicted" in r and "not all numbers" in r for r in reports
    )
    assert capfd.readouterr().err == ""


@pytest.mark.long
def test_a_model_that_no_twin_can_use_is_told_once(
    inbox: Inbox, reports: list[str], tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    joint = msgspec.structs.replace(SETUP.parameters.joint, bushing_outer_radius_mm=1.0)
    parameters = msgspec.structs.replace(SETUP.parameters, joint=joint)
    link = TwinLink(
        msgspec.structs.replace(SETUP, parameters=parameters), inbox, tmp_path, reports.append
    )
    try:
        assert not link.wait_ready(60.0)
        link.offer(revolution(1))
    finally:
        link.close()
    assert len(reports) == 1, reports
    assert "joint.bushing_outer_radius_mm = 1.0" in reports[0]
    assert reports[0].endswith("there will be no more predictions in this test")
    assert capfd.readouterr().err == ""
