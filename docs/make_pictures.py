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
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
IMAGES = ROOT / "docs" / "images"
TABS = ("overview", "cycle", "trends", "alarms", "prepare", "devices", "log", "results", "faults")
REVOLUTIONS = 150


def main() -> int:
    """Start a test in the window and take a picture of every tab while it runs."""
    with tempfile.TemporaryDirectory() as folder:
        screen, display = _screen()
        os.environ.update(
            DISPLAY=display,
            QT_QPA_PLATFORM="xcb",
            RIGAPP_RUNTIME_DIR=f"{folder}/run",
            XDG_CONFIG_HOME=f"{folder}/config",
        )
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


def _screen() -> tuple[subprocess.Popen[bytes], str]:
    """Start a virtual screen on a display that nobody else has."""
    read, write = os.pipe()
    screen = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", "1400x900x24", "-nolisten", "tcp"],
        pass_fds=(write,),
    )
    os.close(write)
    with os.fdopen(read) as file:
        return screen, f":{file.readline().strip()}"


def _take_all() -> None:
    from rigapp.service.launch import attach

    found = subprocess.run(
        ["xdotool", "search", "--sync", "--onlyvisible", "--name", "rigapp"],
        check=True, capture_output=True, text=True, timeout=200,
    )  # fmt: skip
    identity = found.stdout.split()[-1]
    client = attach(ROOT / "examples/simulated.toml")
    deadline = time.monotonic() + 400.0
    while client.request("status").result["revolution"] < REVOLUTIONS:
        if time.monotonic() > deadline:
            raise TimeoutError(f"{REVOLUTIONS} revolutions were not made in 400 s")
        time.sleep(0.2)
    for number, name in enumerate(TABS, 1):
        before = _tab_bar()
        subprocess.run(["xdotool", "key", "--window", identity, f"ctrl+{number}"], check=True)
        deadline = time.monotonic() + 60.0
        while number > 1 and _tab_bar() == before and time.monotonic() < deadline:
            time.sleep(0.1)
        time.sleep(2.0)
        _shoot(f"guide-{name}.png")
    client.request("note", {"text": "picture for the guide"})
    _viewer(identity)
    client.request("stop", {"reason": "pictures are taken"})
    client.close()


def _tab_bar() -> bytes:
    """Return how the row of tabs looks, to know when another one is in front."""
    area = ["-crop", "800x30+0+175", "+repage", "-depth", "8", "rgb:-"]
    return subprocess.run(["import", "-window", "root", *area], check=True, capture_output=True).stdout


def _viewer(identity: str) -> None:
    """Let a colleague take command, and look at what the window says then."""
    client = attach_first()
    client.request("take_command")
    time.sleep(1.5)
    subprocess.run(["xdotool", "key", "--window", identity, "ctrl+1"], check=True)
    time.sleep(2.0)
    _shoot("guide-viewer.png")
    client.request("release_command")
    client.close()


def attach_first() -> Any:
    """Return another viewer of the engine, as a colleague's window would be."""
    from rigapp.service.launch import attach

    return attach(ROOT / "examples/simulated.toml", "Ann")


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
