"""Contract tests of every data source with its simulator, including the contract's faults."""

from __future__ import annotations

import re
import threading
from collections.abc import Callable

import numpy as np
import pytest

from rigapp.testing.bench import PATIENCE, SourceBench, wait_until
from rigapp.testing.contracts import Contract, ExpectedFault
from rigapp_drivers.api import (
    Block,
    ConnectionFailed,
    DeviceError,
    DeviceLost,
    InputSupervision,
    LineCounters,
    Quality,
)

pytestmark = pytest.mark.rigapp_contract

Make = Callable[..., SourceBench]
SILENCE_S = 0.7


def test_open_configure_stream_stop_close_reopen_twice(source: Contract, bench: Make) -> None:
    b = bench(source)
    for _ in range(3):
        b.connect()
        blocks = b.blocks(100)
        b.judge(blocks)
        assert not np.concatenate([block.quality for block in blocks]).any()
        assert [block.sequence for block in blocks] == list(range(len(blocks)))
        assert blocks[0].first_sample == 0
        _counts(b)
        ends = [block.first_sample + block.values.shape[1] for block in blocks]
        assert [block.first_sample for block in blocks[1:]] == ends[:-1]
        times = [block.host_time_ns for block in blocks]
        assert times == sorted(times)
        b.driver.stop()
        b.driver.stop()
        wait_until(lambda: not b.simulator.streaming, "the stream to stop")
        b.driver.start()
        again = b.blocks(20)
        assert (again[0].sequence, again[0].first_sample) == (0, 0)
        b.driver.close()
        b.driver.close()
        wait_until(lambda: not b.simulator.streaming, "the stream to stop")
        b.driver = b.make()


def _counts(b: SourceBench) -> None:
    """Check that a driver with counters has counted bytes, and no errors."""
    if isinstance(b.driver, LineCounters):
        counters = dict(b.driver.counters())
        assert counters.pop("bytes_received") > 0
        assert counters.pop("bytes_sent") > 0
        assert not any(counters.values()), counters


def test_a_port_in_use_is_refused_and_the_first_user_notices_nothing(
    source: Contract, bench: Make
) -> None:
    b = bench(source)
    b.connect()
    b.blocks(20)
    second = b.make()
    with pytest.raises(ConnectionFailed, match="in use by another program"):
        second.open()
    second.close()
    b.judge(b.blocks(50))


def test_close_from_another_thread_ends_a_waiting_read(source: Contract, bench: Make) -> None:
    b = bench(source)
    b.connect()
    b.blocks(20)
    outcome: list[BaseException] = []
    began = threading.Event()

    stopped = threading.Event()

    def read_until_stopped() -> None:
        try:
            while not stopped.is_set():
                began.set()
                b.driver.read(5.0)
        except BaseException as error:
            outcome.append(error)

    reader = threading.Thread(target=read_until_stopped, name="reader", daemon=True)
    reader.start()
    assert began.wait(60.0)
    b.driver.close()
    stopped.set()
    reader.join(60.0)
    assert not reader.is_alive(), "the reader hangs after close"
    assert all(isinstance(error, DeviceLost) for error in outcome), outcome
    b.driver = b.make()
    b.connect()
    b.judge(b.blocks(20))


@pytest.mark.sampled(every=2)
def test_fault_is_told_in_time_and_no_wrong_sample_is_good(
    source_fault: tuple[Contract, ExpectedFault], bench: Make, caplog: pytest.LogCaptureFixture
) -> None:
    source, fault = source_fault
    b = bench(source, **fault.settings)
    b.connect()
    b.judge(b.blocks(100))
    b.port.start_fault(fault)
    blocks, reported, words = _read_until_reported(b, fault, caplog)
    b.judge(blocks, gaps=fault.unnumbered)
    assert reported in fault.tells, f"{fault.name}: told {reported}: {words}"
    assert re.search(fault.words, words), words
    b.port.stop_fault(fault)
    if reported.startswith("flag") or reported in ("nothing", "log"):
        if reported == "flag SENSOR_FAULT":
            b.driver.stop()
            b.driver.start()  # until then the flag stays
        _continues(b)
    else:
        b.driver.close()
        _reconnects(b)


def _read_until_reported(
    b: SourceBench, fault: ExpectedFault, log: pytest.LogCaptureFixture
) -> tuple[list[Block], str, str]:
    """Return the samples until a report, the kind of the report, and its text."""
    blocks: list[Block] = []
    patience = 1.0 if "nothing" in fault.tells else PATIENCE
    deadline = b.port.time_s + patience * fault.within_s
    last = b.port.time_s
    flags = {tells.removeprefix("flag ") for tells in fault.tells if tells.startswith("flag")}
    while b.port.time_s < deadline:
        if "log" in fault.tells and re.search(fault.words, log.text):
            return blocks, "log", log.text
        try:
            block = b.driver.read(0.05)
        except DeviceError as error:
            return blocks, *_named(error, b)
        if block is not None:
            blocks.append(block)
            last = b.port.time_s
            seen = Quality(int(np.bitwise_or.reduce(block.quality)))
            for name in flags:
                if seen & Quality[name]:
                    return blocks, f"flag {name}", _words(b)
        elif "silence" in fault.tells and b.port.time_s - last > SILENCE_S:
            return blocks, "silence", ""
    return blocks, "nothing", ""


def _named(error: DeviceError, b: SourceBench) -> tuple[str, str]:
    assert str(error).startswith(f"daq on {b.port.url}: ")
    return type(error).__name__, error.sentence


def _words(b: SourceBench) -> str:
    """Return the driver's input faults in words."""
    if not isinstance(b.driver, InputSupervision):
        return ""
    return ", ".join(fault.words for fault in b.driver.input_faults())


def _continues(b: SourceBench) -> None:
    """Check that good samples arrive again without a new connection."""

    def good() -> bool:
        blocks = b.blocks(50)
        b.judge(blocks)
        return not np.concatenate([block.quality for block in blocks]).any()

    wait_until(good, "good samples after the fault")


def _reconnects(b: SourceBench) -> None:
    """Reopen until it succeeds, as the engine does; then the samples are good."""
    b.driver = b.make()

    def connected() -> bool:
        try:
            b.connect()
        except DeviceError:
            b.driver.close()
            return False
        return True

    wait_until(connected, "the device to be there again")
    b.judge(b.blocks(100))
