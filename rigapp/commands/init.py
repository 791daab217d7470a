"""`rigapp init` and `rigapp schema`: starting files, and the schema of a file."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from rigapp.config.errors import UnusableInput
from rigapp.prepare.folders import ABOUT, StartingFile, starting_files, write_files
from rigapp.prepare.kernels import compile_kernels
from rigapp.prepare.real_rig import (
    ABOUT_REAL,
    ROLES,
    Box,
    FoundPort,
    drivers_of,
    real_files,
    search_ports,
)
from rigapp.prepare.schemas import schema_text
from rigapp.prepare.shipped import examples_folder
from rigapp_drivers.api import DriverInfo

NEXT = (
    "rigapp check rig.toml test.toml",
    "rigapp run test.toml --rig rig.toml --out test.h5 --speed max",
    "rigapp calibrate load-cell --settings calibration/load_cell.toml"
    " --readings calibration/load_cell.csv --to cell.json",
)
NEXT_REAL = (
    "rigapp doctor",
    "rigapp check rig.toml test.toml",
    "rigapp calibrate load-cell --rig rig.toml --settings calibration/load_cell.toml"
    " --to cell.json",
    "rigapp gui --rig rig.toml",
)


def prepare_folder(folder: Path) -> int:
    """Write the starting files, compile the kernels of a first test; return the exit status.

    Raises UnusableInput as ``write_files``.
    """
    start_folder(folder)
    print("Numerical kernels are compiled once, so that no test waits for them:")
    compile_kernels()
    _print_next(folder, NEXT)
    return 0


def start_folder(folder: Path) -> None:
    """Write the starting files into a folder, all or none, and list them.

    Raises UnusableInput, and writes nothing, when one of them exists.
    """
    _fill(folder, list(starting_files(examples_folder())), ABOUT)


def prepare_real_folder(folder: Path, named: Mapping[str, tuple[str, str]]) -> int:
    """Write the files of a real rig into a folder; return the exit status.

    named: name of a device -> driver and port from options, empty where not given. Missing values
    are entered on a terminal. Raises UnusableInput for an unknown driver, for a missing one without
    a terminal, and when a file exists.
    """
    ports = search_ports() if not all(port for _, port in named.values()) else []
    if ports and sys.stdin.isatty():
        print("Ports of this computer:")
        for port in ports:
            print(f"  {port.name}  {port.words}")
    boxes = [_box(name, *named[name], ports) for name in ROLES]
    _fill(folder, real_files(boxes), ABOUT_REAL)
    for box in boxes:
        if not box.port:
            print(
                f"No {box.driver.title} answers on a port; write its port at [devices.{box.name}]"
                " in rig.toml. rigapp doctor lists the ports."
            )
    _print_next(folder, NEXT_REAL)
    return 0


def print_schema(kind: str) -> int:
    """Print the JSON Schema of a kind of file; raises UnusableInput for an unknown kind."""
    print(schema_text(kind), end="")
    return 0


def _fill(folder: Path, files: list[StartingFile], about: Mapping[str, str]) -> None:
    """Write files into a folder and list them; about: path -> description."""
    write_files(folder, files)
    print(f"{folder} holds now:")
    width = max(len(str(file.path)) for file in files)
    for file in files:
        print(f"  {file.path!s:<{width}}  {about.get(str(file.path), '')}".rstrip())


def _print_next(folder: Path, commands: Sequence[str]) -> None:
    print("Try next:" if folder.resolve() == Path.cwd() else f"Try next, in {folder}:")
    for command in commands:
        print(f"  {command}")
    print(
        "More examples, which the guides call examples/ (a study, steps, messages, monitoring, a"
        f" driver): {examples_folder()}"
    )


def _box(name: str, driver: str, port: str, ports: Sequence[FoundPort]) -> Box:
    """Return a device from its option, the search, or an answer on the terminal."""
    words, fitting = ROLES[name].words, drivers_of(name)
    answering = {other.driver: other for other in reversed(ports) if other.driver in fitting}
    if not driver:
        driver = _choose(
            f"Which {words}", list(fitting), next(iter(answering), ""), option=f"--{name}"
        )
    info = fitting.get(driver)
    if info is None:
        raise UnusableInput(
            f"--{name} {driver}: is no driver of a {words}; say {' or '.join(fitting)}."
        )
    return Box(name, info, port or _port_of(info, ports))


def _port_of(info: DriverInfo, ports: Sequence[FoundPort]) -> str:
    """Return the port of a device: the one that answers, or a typed one; may be empty."""
    answering = [port.name for port in ports if port.driver == info.name]
    if len(answering) == 1:
        print(f"{info.title}: found on {answering[0]}.")
        return answering[0]
    if not sys.stdin.isatty():
        return ""
    if answering:
        return _choose(f"Port of the {info.title}", answering, answering[0])
    print(f"{info.title}: answers on no port that may be asked.")
    return _typed(f"Port of the {info.title} (Enter: leave open): ")


def _choose(question: str, choices: Sequence[str], first: str, option: str = "") -> str:
    """Return one of the choices, typed as its number or text."""
    if not sys.stdin.isatty():
        raise UnusableInput(f"Say {option} {' or '.join(choices)}; there is no terminal to ask on.")
    for number, choice in enumerate(choices, 1):
        print(f"  {number}  {choice}")
    first = first or choices[0]
    while True:
        answer = _typed(f"{question}? [{first}] ") or first
        if answer.isdecimal() and 1 <= int(answer) <= len(choices):
            return choices[int(answer) - 1]
        if answer in choices:
            return answer
        print(f"{answer} is none of these.")


def _typed(question: str) -> str:
    try:
        return input(question).strip()
    except EOFError:
        raise UnusableInput("The questions were not answered; nothing is written.") from None
