"""`rigapp init`: a folder with files to start from, which work as they stand."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from pathlib import Path

from rigapp.config.errors import UnusableInput
from rigapp.config.reading import read_text
from rigapp.config.writing import whole_file
from rigapp.prepare.kernels import compile_kernels
from rigapp.prepare.shipped import RIG, TEST, examples_folder

NEW_NAMES = {RIG: "rig.toml", TEST: "test.toml"}
"""What the examples are called where they are somebody's own, also inside of the other files."""

ABOUT = {
    "rig.toml": "the rig: the simulated one",
    "test.toml": "a short wear test",
    "parameters.toml": "the mechanism, for rigapp model",
}
NEXT = (
    "rigapp check rig.toml test.toml",
    "rigapp run test.toml --rig rig.toml --out test.h5 --speed max",
    "rigapp calibrate load-cell --settings calibration/load_cell.toml"
    " --readings calibration/load_cell.csv --to cell.json",
)


@dataclass(frozen=True, slots=True)
class StartingFile:
    """One file to start from: its place below the new folder, and its text."""

    place: Path
    text: str


def prepare_folder(folder: Path) -> int:
    """Write the files to start from, and compile what a first test would wait for; exit status.

    Raises UnusableInput as ``start_folder``.
    """
    start_folder(folder)
    print("Numerical kernels are compiled once, so that no test waits for them:")
    compile_kernels()
    print("Try next:" if folder.resolve() == Path.cwd() else f"Try next, in {folder}:")
    for command in NEXT:
        print(f"  {command}")
    return 0


def start_folder(folder: Path) -> None:
    """Write the files to start from into a folder, all or none, and list them.

    Raises UnusableInput, and writes nothing, when one of them is there already.
    """
    fill_folder(folder, list(starting_files(examples_folder())), ABOUT)


def fill_folder(folder: Path, files: list[StartingFile], about: Mapping[str, str]) -> None:
    """Write files into a folder, all or none, and list them; about: place -> what it is.

    Raises UnusableInput, and writes nothing, when one of them is there already.
    """
    _refuse_existing(folder, files)
    _write(folder, files)
    print(f"{folder} holds now:")
    width = max(len(str(one.place)) for one in files)
    for one in files:
        print(f"  {one.place!s:<{width}}  {about.get(str(one.place), '')}".rstrip())


def starting_files(examples: Path) -> Iterator[StartingFile]:
    """Yield the files that a folder starts with, their names and what they call each other new."""
    for source in _sources(examples):
        place = source.relative_to(examples)
        text = read_text(source)
        for old, new in NEW_NAMES.items():
            text = text.replace(old, new)
        yield StartingFile(place.with_name(NEW_NAMES.get(place.name, place.name)), text)


def _sources(examples: Path) -> list[Path]:
    calibration = (one for one in (examples / "calibration").iterdir() if one.is_file())
    return [
        *(examples / name for name in (RIG, TEST, "parameters.toml")),
        *sorted(calibration),
        *sorted((examples / "notebooks").glob("*.ipynb")),
    ]


def _refuse_existing(folder: Path, files: list[StartingFile]) -> None:
    """Refuse a folder that has one of the files, or whose name is that of a file."""
    for place in (folder, *(folder / name for name in ("calibration", "notebooks"))):
        if os.path.lexists(place) and not place.is_dir():
            raise UnusableInput(f"{place}: is no folder; nothing is written, name another folder.")
    there = [str(one.place) for one in files if os.path.lexists(folder / one.place)]
    if there:
        verb = "exists" if len(there) == 1 else "exist"
        raise UnusableInput(
            f"{folder}: {', '.join(there)} {verb} already; nothing is written, as nothing is"
            " overwritten. Name another folder, or move what is there."
        )


def _write(folder: Path, files: list[StartingFile]) -> None:
    """Write all files, or take back what was written."""
    with ExitStack() as undo:
        for one in files:
            target = folder / one.place
            _make_folder(target.parent, undo)
            with whole_file(target, new=True) as part:
                part.write_text(one.text, encoding="utf-8")
            undo.callback(target.unlink, missing_ok=True)
        undo.pop_all()


def _make_folder(folder: Path, undo: ExitStack) -> None:
    """Make a folder with those above it; remember to remove them, where they are empty then."""
    missing = [one for one in (folder, *folder.parents) if not one.exists()]
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UnusableInput(f"{folder}: the folder cannot be made ({error.strerror}).") from error
    for one in reversed(missing):
        undo.callback(_remove_empty, one)


def _remove_empty(folder: Path) -> None:
    with suppress(OSError):
        folder.rmdir()
