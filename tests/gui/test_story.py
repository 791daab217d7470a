"""A test from start to stop by the keyboard alone, on a real display with a window manager."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from patience import PATIENCE_S

TOOLS = ("Xvfb", "openbox", "xdotool")
APP = Path(__file__).with_name("story_app.py")

pytestmark = [
    pytest.mark.xserver,
    pytest.mark.skipif(
        any(shutil.which(tool) is None for tool in TOOLS), reason=f"needs {', '.join(TOOLS)}"
    ),
]


def wait_for(condition: Callable[[], Any], what: str, seconds: float = 90.0) -> Any:
    """Return the first true value of a condition; fail with what was waited for."""
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        value = condition()
        if value:
            return value
        time.sleep(0.05)
    raise AssertionError(f"{what} did not come within {seconds:g} s")


@pytest.fixture
def display(tmp_path: Path) -> Iterator[dict[str, str]]:
    """Return the environment of a display of its own, with a window manager."""
    read, write = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", "1400x900x24", "-nolisten", "tcp"],
        pass_fds=(write,),
        stderr=subprocess.DEVNULL,
    )
    os.close(write)
    with os.fdopen(read) as file:
        number = file.readline().strip()
    environment = {
        **os.environ,
        "DISPLAY": f":{number}",
        "QT_QPA_PLATFORM": "xcb",
        "XDG_CONFIG_HOME": str(tmp_path / "config"),
    }
    place = ["xdotool", "getmouselocation"]  # the number is known a moment before it is served

    def served() -> bool:
        done = subprocess.run(place, env=environment, capture_output=True, check=False)
        return done.returncode == 0

    wait_for(served, "a display")
    manager = subprocess.Popen(["openbox"], env=environment, stderr=subprocess.DEVNULL)
    yield environment
    for process in (manager, server):
        process.terminate()
        process.wait(timeout=PATIENCE_S)


@pytest.mark.long
def test_start_note_pause_resume_acknowledge_stop_power_off_without_a_mouse(
    display: dict[str, str], tmp_path: Path
) -> None:
    heard = tmp_path / "requests"
    with heard.open("wb") as output:
        app = subprocess.Popen(
            [sys.executable, str(APP), str(tmp_path)],
            env=display,
            stdout=output,
            stderr=subprocess.PIPE,
        )

    def requests() -> list[tuple[str, dict[str, Any]]]:
        return [tuple(json.loads(line)) for line in heard.read_text().splitlines()]

    def asked(verb: str) -> dict[str, Any] | None:
        return next((arguments for one, arguments in requests() if one == verb), None)

    def tool(*arguments: str) -> str:
        done = subprocess.run(
            ["xdotool", *arguments], env=display, capture_output=True, text=True, check=False
        )
        return done.stdout.strip()

    def hear(verb: str, *keys: str) -> dict[str, Any]:
        """Press keys until the engine has heard a verb."""
        deadline = time.monotonic() + 90.0
        while time.monotonic() < deadline:
            tool("key", "--delay", "60", *keys)
            limit = time.monotonic() + 2.0
            while time.monotonic() < limit:
                arguments = next((a for one, a in requests() if one == verb), None)
                if arguments is not None:
                    return arguments
                time.sleep(0.05)
        raise AssertionError(f"{verb} was not heard after {keys}")

    try:
        found = wait_for(
            lambda: tool("search", "--onlyvisible", "--name", "– rigapp$"), "the window"
        )
        tool("windowactivate", "--sync", found.splitlines()[-1])
        start = hear("start", "F5", "Return")
        assert start["test"].endswith("quick.toml")
        assert start["out"].startswith(str(tmp_path))
        tool("key", "F8")
        tool("type", "--delay", "20", "oil added")
        assert hear("note", "Return")["text"] == "oil added"
        assert hear("acknowledge", "alt+k") == {"key": "force_max_high"}
        assert hear("pause", "alt+p") == {"reason": ""}
        assert hear("resume", "alt+r") == {}
        tool("key", "F8")
        tool("type", "--delay", "20", "trial over")
        assert hear("stop", "alt+t") == {"reason": "trial over"}
        assert hear("drive_off", "ctrl+6", "alt+e") == {}
        wait_for(lambda: tool("key", "alt+F4") or app.poll() is not None, "the end", 90.0)
        assert app.wait() == 0
    finally:
        if app.poll() is None:
            app.kill()
        _, errors = app.communicate()
    assert "Traceback" not in errors.decode()
