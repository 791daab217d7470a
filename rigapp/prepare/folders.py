"""Folders with starting files: written completely or not at all, nothing overwritten."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from pathlib import Path

from rigapp.config.errors import UnusableInput
from rigapp.config.reading import read_text
from rigapp.config.writing import whole_file
from rigapp.prepare.shipped import RIG, TEST
from rigapp.texts import joined, say

NEW_NAMES = {RIG: "rig.toml", TEST: "test.toml"}
"""New names of the examples in a user's folder, also within the other files."""

ABOUT = {
    "rig.toml": "the rig: the simulated one",
    "test.toml": "a short wear test",
    "parameters.toml": "the mechanism, for rigapp model",
}


@dataclass(frozen=True, slots=True)
class StartingFile:
    """A starting file: its path in the new folder, and its text."""

    path: Path
    text: str


def write_files(folder: Path, files: list[StartingFile]) -> None:
    """Write files into a folder, all or none.

    Raises UnusableInput, and writes nothing, when one of them exists.
    """
    _refuse_existing(folder, files)
    _write(folder, files)


def starting_files(examples: Path) -> Iterator[StartingFile]:
    """Yield the files of a new folder, with the new names also in the texts."""
    for source in _sources(examples):
        path = source.relative_to(examples)
        text = read_text(source)
        for old, new in NEW_NAMES.items():
            text = text.replace(old, new)
        yield StartingFile(path.with_name(NEW_NAMES.get(path.name, path.name)), text)


def _sources(examples: Path) -> list[Path]:
    calibration = (path for path in (examples / "calibration").iterdir() if path.is_file())
    return [
        *(examples / name for name in (RIG, TEST, "parameters.toml")),
        *sorted(calibration),
        *sorted((examples / "notebooks").glob("*.ipynb")),
    ]


def _refuse_existing(folder: Path, files: list[StartingFile]) -> None:
    """Refuse a folder that contains one of the files, or a path that is a file."""
    for path in (folder, *(folder / name for name in ("calibration", "notebooks"))):
        if os.path.lexists(path) and not path.is_dir():
            raise UnusableInput(
                "{}: is not a folder; nothing was written. Name another folder.", path
            )
    existing = [str(file.path) for file in files if os.path.lexists(folder / file.path)]
    if existing:
        names = joined(", ", existing)
        raise UnusableInput(
            (
                "{}: {} already; nothing was written or overwritten. Name another folder, or"
                " move the present one."
            ),
            folder,
            say("{} exists", names) if len(existing) == 1 else say("{} exist", names),
        )


def _write(folder: Path, files: list[StartingFile]) -> None:
    """Write all files, or remove those already written."""
    with ExitStack() as undo:
        for file in files:
            target = folder / file.path
            _make_folder(target.parent, undo)
            with whole_file(target, new=True) as part:
                part.write_text(file.text, encoding="utf-8")
            undo.callback(target.unlink, missing_ok=True)
        undo.pop_all()


def _make_folder(folder: Path, undo: ExitStack) -> None:
    """Create a folder with its parents; on failure they are removed again, if empty."""
    missing = [path for path in (folder, *folder.parents) if not path.exists()]
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UnusableInput(
            "{}: the folder cannot be made ‹{}›; name another folder.", folder, error.strerror
        ) from error
    for path in reversed(missing):
        undo.callback(_remove_empty, path)


def _remove_empty(folder: Path) -> None:
    with suppress(OSError):
        folder.rmdir()
