"""Make the pictures of the guide: a real window on a virtual screen, driven by real keys.

python docs/make_pictures.py; needs Xvfb, openbox, xdotool and ImageMagick's import.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
IMAGES = ROOT / "docs" / "images"
DISPLAY = ":93"
TABS = ("overview", "cycle", "trends", "alarms", "prepare", "devices", "log", "results", "faults")
REVOLUTIONS = 150


def main() -> int:
    """Start a test in the window and take a picture of every tab while it runs."""
    with tempfile.TemporaryDirectory() as folder:
        os.environ.update(
            DISPLAY=DISPLAY,
            QT_QPA_PLATFORM="xcb",
            RIGAPP_RUNTIME_DIR=f"{folder}/run",
            XDG_CONFIG_HOME=f"{folder}/config",
        )
        screen = subprocess.Popen(["Xvfb", DISPLAY, "-screen", "0", "1400x900x24", "-nolisten", "tcp"])
        time.sleep(1.0)
        manager = subprocess.Popen(["openbox"])
        window = subprocess.Popen(
            [sys.executable, "-m", "rigapp", "gui", "--rig", ROOT / "examples/simulated.toml",
             "--test", ROOT / "examples/quick.toml", "--start"],
            cwd=folder,
        )  # fmt: skip
        try:
            _take_all()
        finally:
            for process in (window, manager, screen):
                process.terminate()
                process.wait()
            _end_engine()
    return 0


def _take_all() -> None:
    from rigapp.service.launch import attach

    found = subprocess.run(
        ["xdotool", "search", "--sync", "--onlyvisible", "--name", "rigapp"],
        check=True, capture_output=True, text=True, timeout=60,
    )  # fmt: skip
    identity = found.stdout.split()[-1]
    client = attach(ROOT / "examples/simulated.toml")
    deadline = time.monotonic() + 120.0
    while client.request("status").result["revolution"] < REVOLUTIONS:
        if time.monotonic() > deadline:
            raise TimeoutError(f"{REVOLUTIONS} revolutions were not made in 120 s")
        time.sleep(0.2)
    for number, name in enumerate(TABS, 1):
        subprocess.run(["xdotool", "key", "--window", identity, f"ctrl+{number}"], check=True)
        time.sleep(1.5)
        _shoot(f"guide-{name}.png")
    client.request("note", {"text": "picture for the guide"})
    client.request("stop", {"reason": "pictures are taken"})
    client.close()


def _shoot(name: str) -> None:
    subprocess.run(["import", "-window", "root", "-depth", "8", "-colors", "128", IMAGES / name], check=True)


def _end_engine() -> None:
    from rigapp.service.client import Client
    from rigapp.service.registry import running_engines

    for entry in running_engines():
        client = Client(entry)
        client.request("shutdown")
        client.close()


if __name__ == "__main__":
    sys.exit(main())
