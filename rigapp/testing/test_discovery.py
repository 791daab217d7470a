"""Contract tests of discovery: probes find the device, and move or change nothing."""

from __future__ import annotations

import copy
import dataclasses
import threading
from collections.abc import Callable, Sequence
from typing import Any

import pytest

from rigapp.testing.bench import SourceBench, SpindleBench
from rigapp.testing.contracts import Contract
from rigapp_drivers.api import DriverInfo
from rigapp_drivers.discovery import Answer, ask

pytestmark = pytest.mark.rigapp_contract

Make = Callable[..., Any]
Drivers = Sequence[DriverInfo]


def answer_at(port: str, drivers: Drivers) -> Answer:
    """Probe a port, with retries as by a user on a busy computer; return the result."""
    inquiries = (ask(port, drivers) for _ in range(10))
    answer = next((inquiry.answer for inquiry in inquiries if inquiry.answer is not None), None)
    assert answer is not None
    return answer


def test_the_device_is_found_among_all_others(
    contract: Contract, bench: Make, known_drivers: Drivers
) -> None:
    b = bench(contract)
    answer = answer_at(b.port.url, known_drivers)
    assert answer.driver == contract.info.name
    assert answer.identity.port == b.port.url
    b.driver.open()  # the port was released
    b.driver.close()


def test_what_answers_is_what_the_driver_identifies(source: Contract, bench: Make) -> None:
    b = bench(source)
    probed, known = answer_at(b.port.url, (source.info,)).identity, b.driver.open()
    assert (probed.maker, probed.model) == (known.maker, known.model)
    assert (probed.firmware, probed.serial_number) == (known.firmware, known.serial_number)


def test_a_data_source_goes_on_as_it_was(
    source: Contract, bench: Make, known_drivers: Drivers
) -> None:
    b: SourceBench = bench(source)
    before = b.simulator.streaming
    settings = getattr(b.simulator, "settings", None)
    kept = copy.deepcopy(settings)
    ask(b.port.url, known_drivers, 0.1)
    assert b.simulator.streaming == before
    if dataclasses.is_dataclass(settings):
        assert settings == kept


def test_no_question_turns_a_motor_that_stands(
    spindle: Contract, bench: Make, known_drivers: Drivers
) -> None:
    b: SpindleBench = bench(spindle)
    moved = threading.Event()
    produce = b.motor.__call__

    def watched(now_s: float) -> bytes:
        data = produce(now_s)
        if not b.is_safe():
            moved.set()
        return data

    b.port._produce = watched
    ask(b.port.url, [info for info in known_drivers if info is not spindle.info], 0.1)
    ask(b.port.url, [spindle.info], 0.1)
    assert not moved.is_set()


def test_a_motor_that_turns_is_left_alone(
    spindle: Contract, bench: Make, known_drivers: Drivers
) -> None:
    b: SpindleBench = bench(spindle)
    b.connect(5.0)
    b.turn()
    sent = len(b.port.received)
    inquiry = ask(b.port.url, known_drivers)
    assert inquiry.answer is None
    assert "in use" in inquiry.problem
    assert len(b.port.received) == sent
    b.turn()
