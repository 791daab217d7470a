"""Contract tests of every slow source with its simulator, including the contract's faults."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest

from rigapp.testing.bench import PATIENCE, SlowBench, wait_until
from rigapp.testing.contracts import Contract, ExpectedFault
from rigapp_drivers.api import ConnectionFailed, DeviceError, SettingRefused, SlowRequest

pytestmark = pytest.mark.rigapp_contract

Make = Callable[..., SlowBench]


def test_open_configure_read_close_reopen_twice(slow: Contract, bench: Make) -> None:
    b = bench(slow)
    for _ in range(3):
        b.connect()
        assert b.driver.read() == pytest.approx(b.truth)
        b.simulator.observe(dict.fromkeys(b.truth, 33.0))
        assert b.driver.read() == pytest.approx(dict.fromkeys(b.truth, 33.0))
        b.simulator.observe(b.truth)
        b.driver.close()
        b.driver.close()
        b.driver = b.make()


def test_one_quantity_alone_is_told_and_an_unknown_one_refused(slow: Contract, bench: Make) -> None:
    b = bench(slow)
    b.connect()
    name, value = list(b.truth.items())[-1]
    b.driver.configure(SlowRequest((name,), settings=b.settings))
    assert b.driver.read()[name] == pytest.approx(value)
    with pytest.raises(SettingRefused, match=name):
        b.driver.configure(SlowRequest(("colour_nm",), settings=b.settings))


def test_a_port_in_use_is_refused_and_the_first_user_notices_nothing(
    slow: Contract, bench: Make
) -> None:
    b = bench(slow)
    b.connect()
    second = b.make()
    with pytest.raises(ConnectionFailed, match="in use by another program"):
        second.open()
    second.close()
    assert b.driver.read() == pytest.approx(b.truth)


@pytest.mark.sampled(every=2)
def test_fault_is_told_in_time_and_no_wrong_value_is_told(
    slow_fault: tuple[Contract, ExpectedFault], bench: Make
) -> None:
    slow, fault = slow_fault
    b = bench(slow, **fault.settings)
    b.connect()
    b.port.start_fault(fault)
    reported, words = _read_until_reported(b, fault)
    assert reported in fault.tells, f"{fault.name}: told {reported}: {words}"
    assert re.search(fault.words, words), words
    b.port.stop_fault(fault)
    if reported != "DeviceLost":
        wait_until(lambda: _reads_again(b), "the values to come again")
    b.driver.close()
    wait_until(lambda: _reconnects(b), "the device to be found again")


def _read_until_reported(b: SlowBench, fault: ExpectedFault) -> tuple[str, str]:
    deadline = b.port.time_s + (1.0 if fault.tells == ("nothing",) else PATIENCE) * fault.within_s
    while b.port.time_s < deadline:
        try:
            assert b.driver.read() == pytest.approx(b.truth)
        except DeviceError as error:
            return type(error).__name__, str(error)
    return "nothing", ""


def _reads_again(b: SlowBench) -> bool:
    try:
        return b.driver.read() == pytest.approx(b.truth)
    except DeviceError:
        return False


def _reconnects(b: SlowBench) -> bool:
    b.driver = b.make()
    try:
        b.connect()
    except DeviceError:
        return False
    return b.driver.read() == pytest.approx(b.truth)
