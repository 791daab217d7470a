"""Start what ``make run`` promises: a wear test on the simulated rig, with the model over the data.

With a display it opens the window and starts the quick test; without one it runs the same test with
a progress bar and draws a picture of the result.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

from rigapp.process.children import module_command

ROOT = Path(__file__).resolve().parents[1]
RIG = ROOT / "examples" / "simulated.toml"
TEST = ROOT / "examples" / "quick.toml"
RESULTS = ROOT / "results"


def has_display() -> bool:
    """Return whether a window can be shown here."""
    if sys.platform in ("win32", "darwin"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def rigapp(*arguments: str) -> int:
    """Run one command of rigapp and return its exit status."""
    return subprocess.run(module_command("rigapp", *arguments), check=False).returncode


def main() -> int:
    """Open the window, or run headless."""
    RESULTS.mkdir(exist_ok=True)
    if has_display():
        return rigapp("gui", "--rig", str(RIG), "--test", str(TEST), "--start")
    print("No display here: the same test runs without a window.", flush=True)
    stem = f"quick-{time.strftime('%Y%m%d-%H%M%S')}"
    file, picture = RESULTS / f"{stem}.h5", RESULTS / f"{stem}.png"
    status = rigapp("run", str(TEST), "--rig", str(RIG), "--out", str(file))
    if status == 0:
        status = rigapp("picture", str(file), "--to", str(picture))
    if status == 0:
        print(f"The file:    {file}\nThe picture: {picture}")
    return status


if __name__ == "__main__":
    sys.exit(main())
