"""Make all pictures of README and guides: real windows on a virtual screen, operated by keys.

make pictures; needs Xvfb, openbox, xdotool and ImageMagick's import.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from calibration_pictures import take_calibrations

ROOT = Path(__file__).resolve().parents[1]
IMAGES = ROOT / "docs" / "images"
TABS = {
    "overview": "ctrl+1",
    "cycle": "ctrl+2",
    "trends": "ctrl+3",
    "alarms": "ctrl+4",
    "prepare": "ctrl+5",
    "devices": "ctrl+6",
    "log": "ctrl+7",
    "results": "ctrl+8",
    "faults": "ctrl+9",
    "studies": "ctrl+d",
}
"""Pages and their keys."""
REVOLUTIONS = 250
PLANNED = 20_000
"""Planned revolutions; the test lasts longer than the pictures take on any computer."""


def main() -> int:
    """Take a picture of every tab during a test, of a fault, and of the calibrations."""
    with tempfile.TemporaryDirectory(prefix="rigapp-guide-") as folder:
        screen, display = _screen()
        os.environ.update(
            DISPLAY=display,
            QT_QPA_PLATFORM="xcb",
            RIGAPP_RUNTIME_DIR=f"{folder}/run",
            XDG_CONFIG_HOME=f"{folder}/config",
        )
        test = Path(folder) / "quick.toml"
        text = (ROOT / "examples/quick.toml").read_text("utf-8")
        test.write_text(text.replace("revolutions = 500", f"revolutions = {PLANNED}"), "utf-8")
        _study(Path(folder))
        manager = subprocess.Popen(["openbox"])
        window = subprocess.Popen(
            [sys.executable, "-P", "-m", "rigapp", "gui", "--rig", ROOT / "examples/simulated.toml",
             "--test", test, "--start"],
            cwd=folder,
        )  # fmt: skip
        try:
            _take_all()
            _end(window)
            _end_engine()
            take_calibrations(Path(folder), ROOT / "examples/simulated.toml", IMAGES)
        finally:
            for process in (window, manager, screen):
                _end(process)
            _end_engine()
    return 0


def _study(folder: Path) -> None:
    """Compute the example's study into the results folder."""
    subprocess.run(
        [sys.executable, "-P", "-m", "rigapp", "study", ROOT / "examples/study.toml",
         "--to", folder / "results" / "study"],
        check=True, timeout=1200,
    )  # fmt: skip


def _end(process: subprocess.Popen[bytes]) -> None:
    if process.poll() is None:
        process.terminate()
        process.wait()


def _screen() -> tuple[subprocess.Popen[bytes], str]:
    """Start a virtual screen on an unused display."""
    read, write = os.pipe()
    screen = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", "1440x940x24", "-nolisten", "tcp"],
        pass_fds=(write,),
    )
    os.close(write)
    with os.fdopen(read) as file:
        return screen, f":{file.readline().strip()}"


def _take_all() -> None:
    from rigapp.service.launch import attach

    result = subprocess.run(
        ["xdotool", "search", "--sync", "--onlyvisible", "--name", "rigapp"],
        check=True, capture_output=True, text=True, timeout=200,
    )  # fmt: skip
    identity = result.stdout.split()[-1]
    client = attach(ROOT / "examples/simulated.toml")
    deadline = time.monotonic() + 400.0
    while client.request("status").result["revolution"] < REVOLUTIONS:
        if time.monotonic() > deadline:
            raise TimeoutError(f"{REVOLUTIONS} revolutions were not made in 400 s")
        time.sleep(0.2)
    for number, (name, key) in enumerate(TABS.items(), 1):
        before = _tab_bar()
        subprocess.run(["xdotool", "key", "--window", identity, key], check=True)
        deadline = time.monotonic() + 60.0
        while number > 1 and _tab_bar() == before and time.monotonic() < deadline:
            time.sleep(0.1)
        time.sleep(2.0)
        _shoot(f"guide-{name}.png")
    client.request("note", {"text": "picture for the guide"})
    _viewer(identity)
    _fault(client, identity)
    client.close()


def _tab_bar() -> bytes:
    """Return a picture of the row of pages, to detect the change to another page."""
    area = ["-crop", "1000x60+0+180", "+repage", "-depth", "8", "rgb:-"]
    return subprocess.run(
        ["import", "-window", "root", *area], check=True, capture_output=True
    ).stdout


def _viewer(identity: str) -> None:
    """Take control as another viewer, and take a picture of the window."""
    client = attach_first()
    client.request("take_command")
    time.sleep(1.5)
    subprocess.run(["xdotool", "key", "--window", identity, "ctrl+1"], check=True)
    time.sleep(2.0)
    _shoot("guide-viewer.png")
    client.request("release_command")
    client.close()


def _fault(client: Any, identity: str) -> None:
    """Press the emergency stop, and take pictures of the recovery."""
    client.request("take_command")
    reply = client.request("inject_fault", {"kind": "emergency_stop", "device": "drive"})
    assert reply.ok, reply.sentence
    deadline = time.monotonic() + 60.0
    while client.request("status").result["state"] != "fault" and time.monotonic() < deadline:
        time.sleep(0.2)
    client.request("clear_fault", {"kind": "emergency_stop"})
    client.request("release_command")
    subprocess.run(["xdotool", "key", "--window", identity, "F2"], check=True)
    time.sleep(3.0)
    _shoot("guide-recover.png")


def attach_first() -> Any:
    """Return a second viewer of the engine."""
    from rigapp.service.launch import attach

    return attach(ROOT / "examples/simulated.toml", "Ann")


def _shoot(name: str) -> None:
    subprocess.run(
        ["import", "-window", "root", "-trim", "+repage", "-depth", "8", "-colors", "128",
         IMAGES / name],
        check=True,
    )  # fmt: skip


def _end_engine() -> None:
    from rigapp.service.client import Client
    from rigapp.service.registry import running_engines

    for entry in running_engines():
        client = Client(entry)
        client.request("stop", {"reason": "pictures are taken"})
        deadline = time.monotonic() + 60.0
        while not client.request("shutdown").ok and time.monotonic() < deadline:
            time.sleep(0.5)
        client.close()


if __name__ == "__main__":
    sys.exit(main())
