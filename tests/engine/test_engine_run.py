"""A test from start to end on the rig in memory."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from engine_doubles import MemoryRig, a_test, eventually

from rigapp.engine.messages import FinishReason, Flag, RunState
from rigapp.engine.run import ENDED


@pytest.fixture
def rig() -> Iterator[MemoryRig]:
    memory = MemoryRig()
    memory.engine.connect()
    yield memory
    memory.spindle.hang = None
    memory.engine.shutdown(20.0)
    assert memory.stands


def test_a_complete_test_has_exactly_the_planned_revolutions(rig: MemoryRig) -> None:
    notices = rig.engine.watch()
    rig.start(a_test(revolutions=20))
    assert rig.engine.wait(ENDED, 20.0) is RunState.STOPPED
    outcome = rig.engine.outcome
    assert outcome is not None
    assert outcome.reason is FinishReason.COMPLETE
    assert rig.store.ending is not None
    assert rig.store.ending[0] == "complete"
    assert rig.store.closed
    np.testing.assert_array_equal(rig.store.column("revolution"), np.arange(1, 21))
    assert rig.stands
    assert rig.spindle.commands[-1][0] == "off"
    kinds = []
    while (notice := notices.get(0.0)) is not None:
        kinds.append(type(notice).__name__)
    assert kinds[-1] == "Finished"
    assert "Committed" in kinds
