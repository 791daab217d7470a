"""The command line, in this process or as a program of its own: what it says and its status."""

from __future__ import annotations

import io
import os
import subprocess
import sys
from contextlib import chdir, redirect_stderr, redirect_stdout
from pathlib import Path
from unittest.mock import patch

import pytest
from patience import PATIENCE_S

from rigapp.cli import main

Done = subprocess.CompletedProcess[str]


def rigapp(*arguments: str | Path, folder: Path | None = None) -> Done:
    """Carry out a verb in this process, in a folder (the present one by default).

    For what needs no process of its own: no signal, no kill, no stream that ends. Environment,
    arguments and streams are afterwards what they were before.
    """
    words = ["rigapp", *map(str, arguments)]
    with (
        patch.dict(os.environ),
        patch.object(sys, "argv", words),
        chdir(folder or Path.cwd()),
        redirect_stdout(io.StringIO()) as said,
        redirect_stderr(io.StringIO()) as complained,
        pytest.raises(SystemExit) as ended,
    ):
        main()
    code = ended.value.code
    assert isinstance(code, int)
    return subprocess.CompletedProcess(words, code, said.getvalue(), complained.getvalue())


def program(*arguments: str | Path, folder: Path | None = None) -> Done:
    """Run the program as a person starts it; a second or two go by before it does anything."""
    return subprocess.run(
        [sys.executable, "-m", "rigapp", *map(str, arguments)],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
