"""Delay of a revolution and of the window on the screen; idle load, and stalls.

Run with ``python benchmarks/bench_screen.py``; needs Xvfb and xdotool.

Revolution: from the end of a revolution (``host_time`` of its row: the engine's stamp of the block
that carries the last sample) to the end of the paint that shows it, in the overview of a real
window on a virtual screen; engine, twin and window in processes of their own, over wire bytes, the
rig in real time at 120 rpm.

Window: from the start of ``rigapp gui`` until the window is mapped.

Idle: processor time of the window's process while no test runs.

Stall: largest delay of the event loop while the test was followed; and afterwards, with the share
of the window's own work: in a walk through every page, the first time and the second, when the
choice of a calibration opens, when that calibration opens, and in two changes of the theme.
"""

from __future__ import annotations

import math
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from budgets import measured, size, skipped

ROOT = Path(__file__).parents[1]
RPM = 120.0
SECONDS = float(size(45, 12))
LEFT_OUT = 6
"""Number of first revolutions left out: the ramp, and first-time loading."""

IDLE_S = float(size(20, 2))
STARTS = size(3, 1)
BEAT_S = 0.002
SETTLE_S = 1.5
"""Wait after a step, until all of its effects are drawn."""


def main() -> None:
    """Print the times beside their budgets."""
    if any(shutil.which(tool) is None for tool in ("Xvfb", "xdotool")):
        skipped("the window on a screen", "Xvfb or xdotool is not installed")
        return
    read, write = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", "1920x1080x24", "-noreset"],
        pass_fds=(write,),
        stderr=subprocess.DEVNULL,
    )
    os.close(write)
    with os.fdopen(read) as file:
        os.environ.update(DISPLAY=f":{file.readline().strip()}", QT_QPA_PLATFORM="xcb")
    try:
        with tempfile.TemporaryDirectory() as folder:
            os.environ["RIGAPP_RUNTIME_DIR"] = f"{folder}/run"
            os.environ["XDG_CONFIG_HOME"] = f"{folder}/config"
            starts = [window_s(folder) for _ in range(STARTS)]
            followed = revolution_ms(Path(folder))
    finally:
        server.terminate()
        server.wait()
    report(followed, starts)


class Followed(NamedTuple):
    """Result of a window: ages of revolutions in ms, idle per cent, stalls and own work in ms."""

    ages: list[float]
    idle: float
    stalls: dict[str, tuple[float, float]]


def report(followed: Followed, starts: list[float]) -> None:
    """Print the table."""
    import numpy as np

    ages, idle = followed.ages, followed.idle
    p99 = float(np.percentile(ages, 99))
    start = statistics.median(starts)
    print(f"end of revolution to screen: median {statistics.median(ages):.1f} ms, n = {len(ages)}")
    measured("screen", p99)
    measured("window", start)
    print(f"  longest start {max(starts):.2f} s, n = {len(starts)}")
    measured("idle", idle)
    for name, (stall, own) in followed.stalls.items():
        print(f"  longest stall, {name}: {stall:.1f} ms, of it own work {own:.1f} ms")
    measured("stall", next(iter(followed.stalls.values()))[0])


def window_s(folder: str) -> float:
    """Return the time from the start of the program to its window on the screen."""
    begin = time.perf_counter()
    process = subprocess.Popen(
        [sys.executable, "-P", "-m", "rigapp", "gui"], cwd=folder, stderr=subprocess.DEVNULL
    )
    try:
        while time.perf_counter() - begin < 60.0:
            windows = subprocess.run(
                ["xdotool", "search", "--onlyvisible", "--name", "rigapp"],
                capture_output=True,
                check=False,
            )
            if windows.stdout.strip():
                return time.perf_counter() - begin
            time.sleep(0.02)
        raise TimeoutError("no window within 60 s")
    finally:
        process.terminate()
        process.wait()
        end_engines()


def end_engines() -> None:
    """Shut down the engines that a window has started."""
    from rigapp.service.client import Client
    from rigapp.service.registry import running_engines

    for entry in running_engines():
        client = Client(entry)
        client.request("shutdown")
        client.close()


def long_test(folder: Path) -> Path:
    """Write a test at ``RPM`` that is longer than the measurement."""
    text = (ROOT / "examples" / "quick.toml").read_text(encoding="utf-8")
    for old, new in (
        ("revolutions = 500", "revolutions = 5000"),
        ("speed_rpm = 60.0", f"speed_rpm = {RPM}"),
        ("acceleration_rpm_per_s = 60.0", "acceleration_rpm_per_s = 240.0"),
        ("overspeed_rpm = 90.0", "overspeed_rpm = 180.0"),
    ):
        text = text.replace(old, new, 1)
    path = folder / "long.toml"
    path.write_text(text, encoding="utf-8")
    return path


def revolution_ms(folder: Path) -> Followed:
    """Follow a test in a window of this process."""
    import logging

    from PySide6.QtCore import QTimer
    from PySide6.QtWidgets import QApplication

    from rigapp.gui.look.dress import apply_theme
    from rigapp.gui.window.app import LOADED_MS
    from rigapp.gui.window.window import MainWindow
    from rigapp.presentation.tokens import LIGHT
    from rigapp.process.memory import end_of_loading
    from rigapp.schema.messages import RunState
    from rigapp.service.launch import attach
    from rigapp.viewer.connection import EngineConnection
    from rigapp.viewer.showntest import ShownTest

    text = (ROOT / "examples" / "simulated.toml").read_text(encoding="utf-8")
    rig = folder / "rig.toml"
    rig.write_text(text.replace("speed = 20.0", "speed = 1.0", 1), encoding="utf-8")
    logging.disable(logging.WARNING)
    application = QApplication([])
    apply_theme(application, LIGHT)
    test = long_test(folder)
    window = MainWindow(
        EngineConnection(lambda: attach(rig, "benchmark")),
        ShownTest(),
        LIGHT,
        tests=[test],
        results_folder=folder,
    )
    window.show()
    window.start()
    window.start_when_idle(test)
    QTimer.singleShot(LOADED_MS, window, end_of_loading)
    ages = painted(application, window)
    stalls = {"in a test": (1000.0 * window.watchdog.worst_s, math.nan)}
    window.controls.send("stop", {"reason": "measured"})
    wait_until(lambda: window.news.status.engine.state is RunState.STOPPED)
    wait_s(SETTLE_S)
    idle = idle_percent()
    pages = range(window.tabs.count())
    walk = [
        partial(window.tabs.setCurrentIndex, at) for at in pages if window.tabs.isTabVisible(at)
    ]
    for name, calls in (
        ("first walk through the pages", walk),
        ("second walk", walk),
        ("what to calibrate", [window.guide.open]),
        ("a calibration opens", [partial(window.guide.choose, "load cell")]),
        ("two new themes", [window.switch_theme, window.switch_theme]),
    ):
        stalls[name] = max(stall_of(call) for call in calls)
    window.pulse.stop()
    window.close()
    end_engines()
    return Followed(ages, idle, stalls)


def stall_of(call: Callable[[], object]) -> tuple[float, float]:
    """Return the largest delay of the event loop after a call, and its own work then, ms."""
    from PySide6.QtCore import Qt, QTimer

    worst = (0.0, 0.0)
    last = (time.perf_counter(), time.thread_time())

    def beat() -> None:
        nonlocal worst, last
        now = (time.perf_counter(), time.thread_time())
        worst = max(worst, (now[0] - last[0] - BEAT_S, now[1] - last[1]))
        last = now

    timer = QTimer()
    timer.setTimerType(Qt.TimerType.PreciseTimer)
    timer.timeout.connect(beat)
    timer.start(round(1000 * BEAT_S))
    QTimer.singleShot(0, call)
    wait_s(SETTLE_S)
    timer.stop()
    return 1000.0 * worst[0], 1000.0 * worst[1]


def wait_until(so: Callable[[], bool]) -> None:
    """Run the event loop until a condition holds; at most a minute."""
    deadline = time.monotonic() + 60.0
    while not so() and time.monotonic() < deadline:
        wait_s(0.05)


def wait_s(seconds: float) -> None:
    """Run the event loop for some time."""
    from PySide6.QtCore import QEventLoop, QTimer

    loop = QEventLoop()
    QTimer.singleShot(int(1000 * seconds), loop.quit)
    loop.exec()


def idle_percent() -> float:
    """Return the idle processor time of this process, in per cent of a core."""
    start, own = time.monotonic(), time.process_time()
    wait_s(IDLE_S)
    return 100.0 * (time.process_time() - own) / (time.monotonic() - start)


def painted(application: Any, window: Any) -> list[float]:
    """Return the age of each revolution when it was first painted, ms."""
    from PySide6.QtCore import QEvent, QObject

    overlay = window.tabs.panels["overview"]
    seen: dict[int, float] = {}

    class Painted(QObject):
        def eventFilter(self, watched: QObject, event: QEvent) -> bool:
            if event.type() is QEvent.Type.UpdateRequest and overlay.shown is not None:
                pending.add(overlay.shown.measured_revolution)
            return False

    pending: set[int] = set()
    spy = Painted()
    window.installEventFilter(spy)
    end = time.monotonic() + SECONDS + 30.0
    running_since: float | None = None
    while time.monotonic() < end:
        application.processEvents()
        now = time.time()
        for number in pending - seen.keys():
            seen[number] = now
        pending.clear()
        if running_since is None and seen:
            running_since = time.monotonic()
            window.watchdog.worst_s = 0.0
        if running_since is not None and time.monotonic() - running_since > SECONDS:
            break
        time.sleep(0.0005)
    ends = ends_of(window._test.path)
    numbers = sorted(seen)[LEFT_OUT:]
    return [1000.0 * (seen[number] - ends[number]) for number in numbers if number in ends]


def ends_of(path: Path) -> dict[int, float]:
    """Return the end of every revolution of a test's file, UTC seconds."""
    from rigapp.storage import open_test

    with open_test(path) as test:
        rows = test.rows()
    return dict(zip(rows["revolution"].tolist(), rows["host_time"].tolist(), strict=True))


if __name__ == "__main__":
    main()
