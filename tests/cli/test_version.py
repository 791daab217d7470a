"""`rigapp --version`: at once, and without what only other verbs need."""

from __future__ import annotations

import subprocess
import sys
from importlib.metadata import version

from patience import PATIENCE_S


def test_it_says_name_and_version_and_loads_little() -> None:
    code = (
        "import sys\n"
        "from rigapp.cli import main\n"
        "sys.argv[1:] = ['--version']\n"
        "try:\n"
        "    main()\n"
        "finally:\n"
        "    print({'numpy', 'h5py', 'msgspec'} & set(sys.modules), file=sys.stderr)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
    assert (done.returncode, done.stdout) == (0, f"rigapp {version('rigapp')}\n")
    assert done.stderr == "set()\n"
