"""`rigapp doctor`: examine this computer, its ports and the GUI libraries."""

from __future__ import annotations

import importlib.metadata
import json
import os
import platform
import subprocess
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rigapp.process.children import module_command

if TYPE_CHECKING:
    from rigapp_drivers.api import DriverInfo
    from rigapp_drivers.discovery import Inquiry

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
)
WINDOW_PACKAGES = ("PySide6-Essentials", "pyqtgraph")
PROMPT_LATENCY_MS = 2
WINDOW_TEST_S = 120  # start of the GUI libraries on a slow disk
CAN_LISTEN_S = 1.0  # heartbeats come several times a second
NETWORKS = Path("/sys/class/net")
USB_SERIAL = Path("/sys/bus/usb-serial/devices")
NO_PERMISSION, IN_USE = "the-port-may-not-be-opened", "the-port-is-in-use"
SILENT = "nothing-answers"
RULES_NAME = "60-rigapp.rules"
RULES_FOLDERS = (Path("/etc/udev/rules.d"), Path("/usr/lib/udev/rules.d"))
INSTALL_RULES = (
    f"rigapp doctor --rules | sudo tee {RULES_FOLDERS[0] / RULES_NAME}, then "
    "sudo udevadm control --reload, then plug the boxes in again"
)
PORT_RULES = """\
# {name}: serial ports of a test rig, by rigapp.
# The user at the computer may open them. ModemManager leaves them alone: it would send text to each
# new one, which a motor controller may take for a speed. Delete its lines where a modem is needed.
# An FTDI adapter gives short replies at once, not after 16 ms.
ACTION=="remove", GOTO="rigapp_end"
{known}SUBSYSTEM=="tty", KERNEL=="ttyACM[0-9]*|ttyUSB[0-9]*", TAG+="uaccess"
SUBSYSTEM=="tty", KERNEL=="ttyACM[0-9]*|ttyUSB[0-9]*", ENV{{ID_MM_PORT_IGNORE}}="1"
SUBSYSTEM=="usb-serial", DRIVER=="ftdi_sio", ATTR{{latency_timer}}="1"
LABEL="rigapp_end"
"""
_SUBJECT_WIDTH = 19


@dataclass(frozen=True, slots=True)
class Observation:
    """One finding: good, or with an action; help: a section of troubleshooting.md."""

    subject: str
    text: str
    good: bool = True
    help: str = ""


def examine(port: str | None = None, *, as_json: bool = False) -> int:
    """Print all findings; return 1 when one needs action. port: examine only this port."""
    findings = _all() if port is None else ask_port(port)
    return _as_json(tuple(findings)) if as_json else _report(findings)


def _all() -> Iterator[Observation]:
    yield Observation("Python", f"{platform.python_version()} on {platform.platform()}")
    yield from _versions(PACKAGES)
    yield from _shipped_folders()
    yield from _folders()
    yield from ports()
    yield from can_interfaces()
    if any(_version(package) for package in WINDOW_PACKAGES):
        yield from _versions(WINDOW_PACKAGES)
        yield from _window()
    else:
        yield Observation("Window", "not installed; to have one: pip install 'rigapp[gui]'")


def print_rules() -> int:
    """Print the udev rules; return the exit status."""
    print(port_rules(installed_drivers([])), end="")
    return 0


def _as_json(findings: Sequence[Observation]) -> int:
    good = all(finding.good for finding in findings)
    tree = [
        {key: value for key, value in asdict(finding).items() if key != "help" or value}
        for finding in findings
    ]
    print(json.dumps({"good": good, "findings": tree}, indent=2))
    return 0 if good else 1


def _report(findings: Iterable[Observation]) -> int:
    """Print each finding immediately, since a port may take seconds to answer."""
    good = True
    for finding in findings:
        good &= finding.good
        mark = "ok" if finding.good else "ACT"
        see = f" (troubleshooting.md#{finding.help})" if finding.help else ""
        print(f"{mark:<3}  {finding.subject:<{_SUBJECT_WIDTH}}  {finding.text}{see}", flush=True)
    return 0 if good else 1


# --- the machine ------------------------------------------------------------------------------


def _versions(packages: Sequence[str]) -> Iterator[Observation]:
    for package in packages:
        version = _version(package)
        if not version:
            yield Observation(package, "is not installed; run make run, or pip install it.", False)
            continue
        bad = package == "PySide6-Essentials" and version.startswith("6.12.")
        if bad and sys.version_info < (3, 12):
            yield Observation(package, f"{version} aborts Python 3.11; install 6.11.3.", False)
        else:
            yield Observation(package, version)


def _version(package: str) -> str:
    """Return the installed version, empty without one."""
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return ""


def _shipped_folders() -> Iterator[Observation]:
    from rigapp.config.errors import UnusableInput
    from rigapp.prepare.shipped import examples_folder, guides_folder

    for subject, folder in (("Examples", examples_folder), ("Guides", guides_folder)):
        try:
            yield Observation(subject, str(folder()))
        except UnusableInput as error:
            yield Observation(subject, str(error), False)


def _folders() -> Iterator[Observation]:
    from rigapp.config.errors import UnusableInput
    from rigapp.service.registry import running_engines, runtime_folder

    try:
        yield Observation("Runtime folder", str(runtime_folder()))
    except UnusableInput as error:
        yield Observation("Runtime folder", str(error), False)
        return
    engines = running_engines()
    words = ", ".join(f"process {entry.pid} on {entry.rig}" for entry in engines)
    yield Observation("Running engines", words or "none")


# --- serial ports -----------------------------------------------------------------------------


def installed_drivers(findings: list[Observation]) -> list[DriverInfo]:
    """Return the loadable drivers; add a finding for each broken one."""
    from rigapp_drivers.registry import DriverNotFound, available_drivers, load_driver

    drivers = []
    for name in available_drivers():
        try:
            drivers.append(load_driver(name))
        except DriverNotFound as error:
            findings.append(Observation(f"Driver {name}", str(error), False))
    return drivers


def ports() -> Iterator[Observation]:
    """Identify the devices on the serial ports by USB id, and by an inquiry where that is safe."""
    from serial.tools import list_ports

    broken: list[Observation] = []
    drivers = installed_drivers(broken)
    yield Observation("Drivers", ", ".join(f"{info.name} ({info.title})" for info in drivers))
    yield from broken
    from rigapp_drivers.wire.ports import stable_name

    serial_ports = sorted(list_ports.comports())
    if serial_ports:
        yield from rules_advice()
    else:
        yield Observation("Serial ports", "none found; simulated rigs need none")
    for port in serial_ports:
        stable = stable_name(port.device)
        if stable:
            number = f', or port = "serial:{port.serial_number}"' if port.serial_number else ""
            yield Observation(stable, f"is {port.device} now; for a rig file: this name{number}")
        yield from _port(port, drivers)


def _port(port: Any, drivers: Sequence[DriverInfo]) -> Iterator[Observation]:
    from rigapp_drivers.discovery import ask, drivers_of_usb_id, may_be_probed

    known = drivers_of_usb_id(port.vid, port.pid, drivers)
    described = "" if port.description in (None, "n/a") else port.description
    label = " / ".join(info.title for info in known) or described or "serial port"
    if not os.access(port.device, os.R_OK | os.W_OK):
        advice = f"{label}: {permission_advice(port.device)}"
        yield Observation(port.device, advice, False, NO_PERMISSION)
    elif may_be_probed(port.device, known):
        others = [info for info in drivers if info not in known]
        yield from _inquiry_finding(ask(port.device, [*known, *others]), label, bool(known))
    else:
        yield Observation(
            port.device,
            f"{label}: not asked, because a motor controller behind it could take any byte for a "
            f"speed; when that is safe: rigapp doctor --port {port.device}",
        )
    yield from latency_timer(Path(port.device).name)


def _inquiry_finding(inquiry: Inquiry, label: str, known: bool) -> Iterator[Observation]:
    """Yield the finding of a port not named by the user, where an unknown device is no fault."""
    if inquiry.answer is not None:
        yield Observation(inquiry.port, identity_words(inquiry))
    elif inquiry.problem:
        in_use = "in use" in inquiry.problem
        text = f"{label}: {inquiry.problem}"
        yield Observation(inquiry.port, text, in_use or not known, IN_USE if in_use else SILENT)
    elif known:
        yield Observation(
            inquiry.port,
            f"{label} by its USB id, but it does not answer; switch it off and on, and check its "
            "mode (DATAQ: CDC, yellow; RoboClaw: packet serial).",
            False,
            SILENT,
        )
    else:
        yield Observation(inquiry.port, f"{label}: none of the known devices answers")


def ask_port(port: str) -> Iterator[Observation]:
    """Examine one port named by the user."""
    from rigapp_drivers.discovery import ask

    broken: list[Observation] = []
    drivers = installed_drivers(broken)
    yield from broken
    if port.startswith("/") and os.path.exists(port) and not os.access(port, os.R_OK | os.W_OK):
        yield Observation(port, permission_advice(port), False, NO_PERMISSION)
        return
    inquiry = ask(port, drivers)
    if inquiry.answer is not None:
        yield Observation(port, identity_words(inquiry))
        yield Observation("In the rig file", f'driver = "{inquiry.answer.driver}", port = "{port}"')
    elif inquiry.problem:
        in_use = "in use" in inquiry.problem
        yield Observation(port, inquiry.problem, False, IN_USE if in_use else SILENT)
    else:
        yield Observation(
            port,
            f"nothing that is known answers (asked for: {', '.join(inquiry.tried)}); check power, "
            "cable and, on a UART, the device's baud rate.",
            False,
            SILENT,
        )
    yield from latency_timer(Path(port).name)


def identity_words(inquiry: Inquiry) -> str:
    """Return the identity of the device, with the values for a rig file."""
    answer = inquiry.answer
    assert answer is not None
    identity = answer.identity
    words = [" ".join(part for part in (identity.maker, identity.model) if part)]
    words += [f"firmware {identity.firmware}"] if identity.firmware else []
    words += [f"serial number {identity.serial_number}"] if identity.serial_number else []
    words += [f"{key.replace('_', ' ')} {value}" for key, value in identity.details.items()]
    words += [f"{answer.baud_rate} baud"] if answer.baud_rate is not None else []
    return f"{', '.join(words)} (driver {answer.driver})"


def permission_advice(device: str) -> str:
    """Return the remedy for a port that this user may not open."""
    if sys.platform == "win32":
        return "no permission to open it."
    try:
        import grp

        group = grp.getgrgid(os.stat(device).st_gid).gr_name
    except (ImportError, OSError, KeyError):
        return "no permission to open it."
    return f"no permission; run 'sudo usermod -aG {group} $USER' and log in again."


def latency_timer(name: str, folder: Path = USB_SERIAL) -> Iterator[Observation]:
    """Yield a finding about the latency timer of an FTDI adapter; nothing for other ports."""
    timer = folder / name / "latency_timer"
    try:
        milliseconds = int(timer.read_text())
    except (OSError, ValueError):
        return
    prompt = milliseconds <= PROMPT_LATENCY_MS
    advice = (
        ""
        if prompt
        else "; the adapter holds short replies back for so long. rigapp asks for the low-latency "
        f"mode when it opens the port; if replies stay late: echo 1 | sudo tee {timer}"
    )
    yield Observation(f"{name} latency timer", f"{milliseconds} ms{advice}")


# --- rules for ports ---------------------------------------------------------------------------


def port_rules(drivers: Iterable[DriverInfo]) -> str:
    """Return udev rules that open the ports to the local user, but not to ModemManager.

    They cover devices whose USB id is in a driver.
    """
    known = "".join(
        f'SUBSYSTEM=="usb", ENV{{DEVTYPE}}=="usb_device", ATTR{{idVendor}}=="{vendor:04x}", '
        f'ENV{{ID_MM_DEVICE_IGNORE}}="1"\n'
        for vendor in sorted({vendor for info in drivers for vendor, _ in info.usb_ids})
    )
    return PORT_RULES.format(name=RULES_NAME, known=known)


def rules_advice(folders: Sequence[Path] = RULES_FOLDERS) -> Iterator[Observation]:
    """Yield whether the udev rules are installed, or how to install them, on systems with udev."""
    if any((folder / RULES_NAME).exists() for folder in folders):
        yield Observation("Rules for ports", "installed")
    elif folders[0].is_dir():
        yield Observation(
            "Rules for ports",
            "not installed: ModemManager may write to a box, and its port may be closed to you; "
            f"{INSTALL_RULES}",
        )


# --- CAN --------------------------------------------------------------------------------------


def can_interfaces(folder: Path = NETWORKS) -> Iterator[Observation]:
    """List the CAN interfaces with the nodes whose heartbeat is received."""
    from rigapp.prepare.real_rig import can_networks

    names = can_networks(folder)
    if not names:
        yield Observation("CAN interfaces", "none found; slcan adapters are serial ports")
    for name in names:
        if _text(folder / name / "operstate") == "down":
            yield Observation(
                name,
                "CAN interface, down; to use it: "
                f"sudo ip link set {name} up type can bitrate 500000",
            )
        else:
            yield _can_nodes(name)


def _can_nodes(name: str) -> Observation:
    from rigapp_drivers.api import DeviceError
    from rigapp_drivers.cia402.probe import listen, node_words

    try:
        nodes = listen("socketcan", name, CAN_LISTEN_S)
    except DeviceError as error:
        return Observation(name, f"CAN interface: {error.sentence}", False)
    silence = "" if nodes else "; a drive is silent until its object 1017 is set or its power comes"
    return Observation(name, f"CAN interface, {node_words(nodes)}{silence}")


def _text(path: Path) -> str:
    try:
        return path.read_text("utf-8").strip()
    except (OSError, UnicodeDecodeError):
        return ""


# --- the window -------------------------------------------------------------------------------


def _window() -> Iterator[Observation]:
    """Test the GUI libraries in a separate process, since a broken Qt may abort."""
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
    try:
        done = subprocess.run(
            module_command("rigapp.gui.window.selftest"),
            env=environment,
            capture_output=True,
            text=True,
            timeout=WINDOW_TEST_S,
            check=False,
        )
    except subprocess.TimeoutExpired:
        yield Observation("Window self test", "did not end within 120 s.", False)
        return
    except OSError as error:
        yield Observation("Window self test", f"could not be started ‹{error}›.", False)
        return
    if done.returncode == 0:
        yield Observation("Window self test", "passed")
        return
    last = (done.stdout.strip() or done.stderr.strip() or "aborted").splitlines()[-1]
    yield Observation("Window self test", f"failed: {last}", False)
