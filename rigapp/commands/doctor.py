"""`rigapp doctor`: is this machine ready for a rig and for the window?"""

from __future__ import annotations

import grp
import importlib.metadata
import os
import platform
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

PACKAGES = (
    "rigapp",
    "numpy",
    "scipy",
    "numba",
    "h5py",
    "pyserial",
    "python-can",
    "canopen",
    "pyzmq",
    "msgspec",
    "PySide6-Essentials",
    "pyqtgraph",
)


@dataclass(frozen=True, slots=True)
class Finding:
    """One line of the examination: good, or what to do."""

    subject: str
    text: str
    good: bool = True


def examine() -> int:
    """Print every finding; status 1 when one needs action."""
    from rich.console import Console
    from rich.table import Table

    findings = [*_versions(), *_folders(), *_ports(), *_can_interfaces(), *_window()]
    table = Table(show_header=False, box=None, pad_edge=False)
    for finding in findings:
        table.add_row("ok" if finding.good else "ACT", finding.subject, finding.text)
    Console(soft_wrap=True).print(table)
    return 0 if all(finding.good for finding in findings) else 1


def _versions() -> Iterator[Finding]:
    yield Finding("Python", f"{platform.python_version()} on {platform.platform()}")
    for package in PACKAGES:
        try:
            version = importlib.metadata.version(package)
        except importlib.metadata.PackageNotFoundError:
            yield Finding(package, "is not installed; run make run, or pip install it.", False)
            continue
        bad = package == "PySide6-Essentials" and version.startswith("6.12.")
        if bad and sys.version_info < (3, 12):
            yield Finding(package, f"{version} aborts Python 3.11; install 6.11.3.", False)
        else:
            yield Finding(package, version)


def _folders() -> Iterator[Finding]:
    from rigapp.config.errors import UnusableInput
    from rigapp.service.registry import running_engines, runtime_folder

    try:
        yield Finding("Runtime folder", str(runtime_folder()))
    except UnusableInput as error:
        yield Finding("Runtime folder", str(error), False)
        return
    engines = running_engines()
    words = ", ".join(f"process {entry.pid} on {entry.rig}" for entry in engines)
    yield Finding("Running engines", words or "none")


def _ports() -> Iterator[Finding]:
    from serial.tools import list_ports

    from drivers.registry import available_drivers, load_driver

    drivers = [load_driver(name) for name in available_drivers()]
    yield Finding("Drivers", ", ".join(f"{info.name} ({info.title})" for info in drivers))
    ports = sorted(list_ports.comports())
    if not ports:
        yield Finding("Serial ports", "none found; simulated rigs need none")
    for port in ports:
        makers = [
            info.title
            for info in drivers
            for vendor, product in info.usb_ids
            if port.vid == vendor and product in (None, port.pid)
        ]
        text = " / ".join(makers) or port.description or "unknown device"
        if not os.access(port.device, os.R_OK | os.W_OK):
            yield Finding(port.device, f"{text}: {_permission_advice(port.device)}", False)
            continue
        yield Finding(port.device, text)
        yield from _latency_timer(Path(port.device).name)


def _permission_advice(device: str) -> str:
    try:
        group = grp.getgrgid(os.stat(device).st_gid).gr_name
    except (OSError, KeyError):
        return "no permission to open it."
    return f"no permission; run 'sudo usermod -aG {group} $USER' and log in again."


def _latency_timer(name: str) -> Iterator[Finding]:
    timer = Path(f"/sys/bus/usb-serial/devices/{name}/latency_timer")
    if timer.exists():
        milliseconds = int(timer.read_text())
        yield Finding(
            f"{name} latency",
            f"{milliseconds} ms"
            + ("" if milliseconds <= 2 else f"; write 1 to {timer} for prompt replies."),
            milliseconds <= 2,
        )


def _can_interfaces() -> Iterator[Finding]:
    folder = Path("/sys/class/net")
    names = [
        path.name
        for path in (folder.iterdir() if folder.is_dir() else ())
        if (path / "type").exists() and (path / "type").read_text().strip() == "280"
    ]
    yield Finding("CAN interfaces", ", ".join(sorted(names)) or "none found")


def _window() -> Iterator[Finding]:
    """Test the window's libraries in a process of its own: a broken Qt may abort."""
    script = (
        "import sys\n"
        "from rigapp.gui.selftest import run_self_test\n"
        "problems = run_self_test()\n"
        "print('; '.join(problems))\n"
        "sys.exit(bool(problems))\n"
    )
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
    try:
        done = subprocess.run(
            [sys.executable, "-c", script],
            env=environment,
            capture_output=True,
            text=True,
            timeout=120,
            check=False,
        )
    except subprocess.TimeoutExpired:
        yield Finding("Window self test", "did not end within 120 s.", False)
        return
    if done.returncode == 0:
        yield Finding("Window self test", "passed")
        return
    last = (done.stdout.strip() or done.stderr.strip() or "aborted").splitlines()[-1]
    yield Finding("Window self test", f"failed: {last}", False)
