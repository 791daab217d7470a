"""The link: who reads, which answer belongs to what, and what happens to samples meanwhile."""

from __future__ import annotations

import threading
from collections import deque
from typing import Any

import numpy as np
import pytest

from rigapp_drivers.api import DeviceLost, ProtocolError, ReplyTimeout, SettingRefused
from rigapp_drivers.gsv8 import link as link_module
from rigapp_drivers.gsv8.frames import FrameLayout, Response, Run, encode_frames, encode_response
from rigapp_drivers.gsv8.link import Link, TimedRun
from rigapp_drivers.gsv8.protocol import Command, request, u8
from rigapp_drivers.gsv8.stream import BlockMaker

LAYOUT = FrameLayout(2)


class ScriptedPort:
    """A port that answers each request with the next piece of a script."""

    device, port, is_open = "daq", "script", True

    def __init__(self, *script: bytes) -> None:
        self.sent: list[bytes] = []
        self._script = deque(script)
        self._input: deque[bytes] = deque()
        self._there = threading.Condition()

    def open(self) -> None:
        """Do nothing."""

    def close(self) -> None:
        """Do nothing."""

    def drain(self) -> bytes:
        """Return nothing."""
        return b""

    def feed(self, data: bytes) -> None:
        """Let bytes arrive."""
        with self._there:
            self._input.append(data)
            self._there.notify_all()

    def write(self, data: bytes) -> None:
        """Take a request and let the next piece of the script arrive."""
        self.sent.append(data)
        if self._script:
            self.feed(self._script.popleft())

    def read_some(self, maximum: int, timeout_s: float) -> bytes:
        """Return a piece, as it came."""
        with self._there:
            if not self._input:
                self._there.wait(timeout_s)
            return self._input.popleft() if self._input else b""


def _ok(data: bytes = b"", status: int = 0) -> bytes:
    return encode_response(Response(status, data))


def _frames(count: int) -> bytes:
    return encode_frames(np.ones((2, count)), LAYOUT).tobytes()


def _link(*script: bytes) -> tuple[Link, ScriptedPort]:
    port = ScriptedPort(*script)
    return Link(port, 0.1), port


def test_samples_around_an_answer_are_kept() -> None:
    link, _ = _link(_frames(3) + _ok(b"\x01\x02\x03\x04") + _frames(2))
    link.expect(LAYOUT)
    assert link.command(Command.READ_DATA_RATE, reply=4) == b"\x01\x02\x03\x04"
    assert sum(timed.run.values.shape[1] for timed in link.take()) == 5
    assert link.take() == []


def test_refusals_are_said_in_words() -> None:
    link, _ = _link(_ok(status=0x71))
    with pytest.raises(SettingRefused, match=r"set zero ‹command 0C› was refused: writing is"):
        link.command(Command.SET_ZERO, u8(1))


@pytest.mark.parametrize("status", [0x43, 0x92, 0x5A, 0x99])
def test_a_request_spoilt_on_the_way_is_repeated(status: int) -> None:
    link, port = _link(_ok(status=status), _ok(b"\x00\x05"))
    assert link.command(Command.GET_TX_MAPPING, u8(0), reply=2) == b"\x00\x05"
    assert port.sent == [request(Command.GET_TX_MAPPING, u8(0))] * 2


def test_changed_with_it_is_done_for_a_write_and_no_answer_for_a_read() -> None:
    link, _ = _link(_ok(status=1), _ok(status=1))
    assert link.command(Command.SET_MODE, bytes(4)) == b""
    with pytest.raises(SettingRefused, match="other parameters changed"):
        link.command(Command.GET_MODE, reply=4)


def test_answers_of_another_length_belong_to_someone_else() -> None:
    link, _ = _link(_ok(b"\x00\x00\x00\x00") + _ok())
    link.command(Command.STOP_TRANSMISSION)
    assert link.late_replies == 1
    wrong, _ = _link(*[_ok(b"\x00")] * 3)
    with pytest.raises(ProtocolError, match="wrong length"):
        wrong.command(Command.STOP_TRANSMISSION)


def test_a_late_answer_after_a_retry_is_let_pass() -> None:
    link, port = _link(b"", _ok(b"\x00\x05"), _ok(b"\x00\x07"))
    link.reply_timeout_s = 0.4
    late = threading.Timer(0.9, port.feed, [_ok(b"\x00\x05")])
    late.start()
    assert link.command(Command.GET_TX_MAPPING, u8(0), reply=2) == b"\x00\x05"
    late.join()
    assert link.command(Command.GET_TX_MODE, u8(1), reply=2) == b"\x00\x07"
    assert link.late_replies == 1


def test_no_answer_is_a_time_out_that_names_the_command() -> None:
    link, port = _link()
    with pytest.raises(ReplyTimeout, match=r"read data rate ‹command 8A› within 0.1 s"):
        link.command(Command.READ_DATA_RATE, reply=4)
    assert len(port.sent) == 2


def test_an_answer_behind_a_frame_that_never_ends() -> None:
    link, _ = _link(bytes.fromhex("AA5E00") + _ok(b"\x00\x05"))
    assert link.command(Command.GET_TX_MAPPING, u8(0), reply=2, tries=1) == b"\x00\x05"


def test_a_command_waits_for_a_posted_question() -> None:
    link, port = _link()
    posted = link.post(Command.GET_LAST_PROTOCOL_ERROR, u8(1), reply=4)
    assert posted is not None
    assert link.post(Command.RESET_STATUS) is None
    port.feed(_ok(b"\x00\x00\x00\x91"))
    port._script.append(_ok())
    link.command(Command.STOP_TRANSMISSION)
    assert posted.answered.is_set()
    assert posted.response == Response(0, b"\x00\x00\x00\x91")


def test_an_abandoned_question_blocks_nothing() -> None:
    link, _ = _link(b"", _ok())
    posted = link.post(Command.GET_LAST_PROTOCOL_ERROR, u8(1), reply=4)
    assert posted is not None
    link.abandon(posted)
    link.command(Command.STOP_TRANSMISSION)
    assert not posted.answered.is_set()


def test_the_reading_thread_hands_an_answer_to_its_command() -> None:
    link, port = _link()
    link.reply_timeout_s = 5.0
    link.expect(LAYOUT)
    stop = threading.Event()

    def read() -> None:
        while not stop.is_set():
            link.read(0.02)

    reader = threading.Thread(target=read, name="reader")
    reader.start()
    port._script.append(_frames(1) + _ok(b"\x00\x02"))
    assert link.command(Command.GET_TX_MAPPING, u8(0), reply=2) == b"\x00\x02"
    stop.set()
    reader.join(60.0)
    assert not reader.is_alive()
    assert len(link.take()) == 1


def test_samples_that_nobody_fetches_are_bounded_and_counted(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(link_module, "_MOST_KEPT_SAMPLES", 10)
    link, port = _link()
    link.expect(LAYOUT)
    for _ in range(5):
        port.feed(_frames(4))
        link.read(0.1)
    runs = [timed.run for timed in link.take()]
    assert sum(run.values.shape[1] for run in runs) == 8
    assert [run.lost_before for run in runs] == [12, 0]


def test_one_measured_value_on_request() -> None:
    link, _ = _link(_frames(1))
    assert link.one_frame(LAYOUT).values.tolist() == [[1.0], [1.0]]
    silent, _ = _link()
    with pytest.raises(ReplyTimeout, match="no measured value"):
        silent.one_frame(LAYOUT)


def test_a_lost_device_is_lost_for_the_command() -> None:
    class Broken(ScriptedPort):
        def read_some(self, maximum: int, timeout_s: float) -> bytes:
            raise DeviceLost("daq", "script", "the connection broke.")

    link = Link(Broken(), 0.1)
    with pytest.raises(DeviceLost):
        link.command(Command.STOP_TRANSMISSION)


# --- blocks -----------------------------------------------------------------------------------


def _timed(count: int, lost: int = 0, time_ns: int = 0) -> TimedRun:
    values = np.arange(2 * count, dtype=np.float32).reshape(2, count)
    return TimedRun(Run(values, np.zeros(count, np.uint8), lost), time_ns)


def test_blocks_end_where_samples_were_lost() -> None:
    maker = BlockMaker("daq", 1000.0, [0, 1], 0.02)
    maker.add([_timed(5), _timed(6), _timed(4, lost=3), _timed(1)])
    blocks: list[Any] = [maker.make(), maker.make()]
    assert maker.make() is None
    assert [block.values.shape for block in blocks] == [(2, 11), (2, 5)]
    assert [block.first_sample for block in blocks] == [0, 14]
    assert [block.lost_before for block in blocks] == [0, 3]
    assert blocks[1].quality.tolist() == [2, 0, 0, 0, 0]


def test_a_block_is_ready_when_full_or_old() -> None:
    maker = BlockMaker("daq", 1000.0, [1, 0], 0.02)
    assert not maker.ready(0)
    maker.add([_timed(19, time_ns=1_000_000)])
    assert not maker.ready(20_000_000)
    assert maker.ready(21_000_000)
    maker.add([_timed(1)])
    assert maker.ready(2_000_000)
    block = maker.make()
    assert block is not None
    assert block.values[:, 0].tolist() == [19.0, 0.0]
    assert not maker.ready(99_000_000_000)


def test_a_reported_loss_flags_the_next_block_once() -> None:
    maker = BlockMaker("daq", 1000.0, [0], 0.02)
    maker.flag_loss()
    maker.add([_timed(2)])
    block = maker.make()
    assert block is not None
    assert block.quality.tolist() == [2, 0]
    maker.add([_timed(2)])
    after = maker.make()
    assert after is not None
    assert after.quality.tolist() == [0, 0]
    assert (after.sequence, after.first_sample) == (1, 2)
