"""Whoever starts a verb may have closed its output: the work is done all the same."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from patience import PATIENCE_S

PARAMETERS = Path(__file__).parents[2] / "examples" / "parameters.toml"


@pytest.mark.parametrize(
    "closed",
    ["<&- >&- 2>&-", *(pytest.param(one, marks=pytest.mark.long) for one in (">&-", "2>&-"))],
)
def test_a_closed_output_is_no_fault(closed: str, tmp_path: Path) -> None:
    table = tmp_path / "pressure.csv"
    verb = ["model", "pressure", str(PARAMETERS), "--force-N", "10", "--to", str(table)]
    done = subprocess.run(
        ["sh", "-c", f'"$@" {closed}', "sh", sys.executable, "-m", "rigapp", *verb],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert table.is_file()
