"""Somebody deletes or moves the file of a running test; the test ends as if nobody had."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from stories import NEVER_OVER, RIG, Running, end_soon, recipe

from rigapp.storage import open_test


@pytest.fixture(autouse=True)
def _own_runtime_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))


@pytest.mark.long
def test_deleted_and_moved_the_file_holds_every_revolution(
    tmp_path: Path, running: Callable[..., Running]
) -> None:
    folder = tmp_path / "results"
    folder.mkdir()
    out = folder / "t.h5"
    test = running("run", recipe(tmp_path, NEVER_OVER, twin=True), "--rig", RIG, "--out", out)
    test.wait_for(lambda: test.committed >= 20, "revolutions are committed")
    out.unlink()
    test.wait_for(out.exists, "the deleted file is there again")
    before = test.committed
    test.wait_for(lambda: test.committed >= before + 10, "the test continues")
    out.rename(folder / "moved.h5")
    test.wait_for(out.exists, "the moved file has its name again")
    planned = end_soon(RIG)
    end = test.end()
    assert (end["reason"], end["revolutions"], end["file"]) == ("complete", planned, str(out))
    with open_test(out) as reader:
        assert reader.summary()["status"] == "complete"
        np.testing.assert_array_equal(reader.column("revolution"), np.arange(1, planned + 1))
        told = [one for one in reader.events() if one.key == "file_moved"]
        assert [one.data["what"] for one in told] == ["raised", "cleared"] * 2
        assert "was deleted" in told[0].text
        assert "was moved" in told[2].text
        assert reader.first_altered_event() is None
