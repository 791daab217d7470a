"""Whole cycles that waited in memory are there after a kill."""

from __future__ import annotations

import os
import signal
from pathlib import Path

import numpy as np
import pytest
from storage_samples import PLAN, cycle, new_test, prediction, row

from rigapp.storage import close_test, open_test, reopen_test


def killed_writer(folder: Path, last: int, ready: int) -> None:
    """Write revolutions, hold each cycle, commit, and wait to be killed."""
    writer = new_test(folder)
    for revolution in range(1, last + 1):
        if revolution % 10 == 0 and revolution <= last - 2:
            writer.append_cycle(revolution, cycle(revolution))
        why = "scheduled" if revolution % 10 == 0 else ""
        writer.append_prediction(prediction(revolution))
        writer.append_row(row(revolution))
        writer.hold_cycle(revolution, cycle(revolution), why, 0)
        writer.place()
        if revolution == last - 12:
            writer.commit()
    # The rows are committed, the cycle counter stays behind, as a kill between the two has it.
    writer._rows.hand_over_pending()
    writer.place()
    counted = writer._counts.cycles
    writer._counts.cycles -= 1
    writer.commit()
    writer._counts.cycles = counted
    os.write(ready, b"x")
    signal.pause()


@pytest.mark.sampled
@pytest.mark.parametrize("last", [31, 40])
def test_after_a_kill_the_cycles_before_it_are_there(quick_folder: Path, last: int) -> None:
    ready, told = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            killed_writer(quick_folder, last, told)
        finally:
            os._exit(1)
    assert os.read(ready, 1) == b"x"
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    path = quick_folder / "test.h5"
    assert close_test(path) == last
    with open_test(path) as reader:
        newest = range(last - PLAN.waiting_cycles + 1, last + 1)
        scheduled = range(10, last + 1, 10)
        found = [one.revolution for one in reader.cycles()]
        assert found == sorted({*scheduled, *newest})
        for stored in reader.cycles():
            for values, wanted in zip(
                stored.columns.values(), cycle(stored.revolution), strict=True
            ):
                np.testing.assert_array_equal(values, wanted.astype(values.dtype))


def test_a_torn_slot_is_left_out(quick_folder: Path) -> None:
    import h5py

    with new_test(quick_folder) as writer:
        for revolution in range(1, 9):
            writer.append_row(row(revolution))
            writer.hold_cycle(revolution, cycle(revolution), "", 0)
    path = quick_folder / "test.h5"
    path.chmod(0o644)
    with h5py.File(path, "r+") as file:
        slot = list(file["/entry/waiting/revolution"]).index(7)
        file["/entry/waiting/force"][slot, 3] += 1.0
    with reopen_test(path):
        pass
    with open_test(path) as reader:
        assert reader.cycle_revolutions().tolist() == [5, 6, 8]


def test_a_test_that_ended_in_order_takes_nothing_over(quick_folder: Path) -> None:
    with new_test(quick_folder) as writer:
        for revolution in range(1, 9):
            writer.append_row(row(revolution))
            writer.hold_cycle(revolution, cycle(revolution), "", 0)
        writer.finish("stopped", "operator", "done")
    with reopen_test(quick_folder / "test.h5"):
        pass
    with open_test(quick_folder / "test.h5") as reader:
        assert reader.cycle_revolutions().size == 0
