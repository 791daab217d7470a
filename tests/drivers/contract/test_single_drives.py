"""What one drive alone does, and what no drive is asked, in front of the simulators."""

from __future__ import annotations

import time
from collections.abc import Callable

import pytest

from rigapp.testing.bench import COUNTS, WATCHDOG_S, SpindleBench, wait_until
from rigapp.testing.contracts import read_contracts
from rigapp_drivers.api import DriveRequest

Make = Callable[..., SpindleBench]


@pytest.mark.parametrize("gear_ratio", [0.0, -2.0, float("nan"), float("inf")])
def test_a_gear_that_turns_nothing_is_refused(gear_ratio: float) -> None:
    with pytest.raises(ValueError, match="gear_ratio"):
        DriveRequest(COUNTS, 1, 12.0, WATCHDOG_S, gear_ratio=gear_ratio)


def test_a_cut_can_frame_is_counted_and_not_taken(bench: Make) -> None:
    b = bench(next(c for c in read_contracts() if c.info.name == "cia402"))
    b.connect(watchdog_s=5.0)
    b.turn()
    before = b.driver.status().crc_errors
    for line in (b"t38160000\r", b"t081831220000\r"):  # a velocity and an emergency, both cut
        with b.port._lock:
            b.port.wire.send(line, time.monotonic(), droppable=False)
    wait_until(lambda: b.driver.status().crc_errors >= before + 2, "the cut frames to be counted")
    status = b.driver.status()
    assert not status.faults
    assert status.speed_rev_per_s == pytest.approx(2.0, abs=0.05)
