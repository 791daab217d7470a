"""Folders of examples and guides: beside the source, or of the installed package."""

from __future__ import annotations

from importlib import metadata
from pathlib import Path

from rigapp.config.errors import UnusableInput

RIG = "simulated.toml"
TEST = "quick.toml"
GUIDE = "operator.md"
TROUBLESHOOTING = "troubleshooting.md"
SHARED = Path("share/rigapp")
"""Common folder of both in an installation, relative to its prefix (see ``pyproject.toml``)."""


def examples_folder() -> Path:
    """Return the folder of the shipped rig, test and calibration files; raises UnusableInput."""
    return _shipped("examples", RIG)


def guides_folder() -> Path:
    """Return the folder of the guides with their pictures; raises UnusableInput."""
    return _shipped("docs", GUIDE)


def _shipped(folder: str, file: str) -> Path:
    """Return the folder of a shipped file."""
    source = Path(__file__).resolve().parents[2]
    # Another package may have installed a folder "examples" beside rigapp.
    if (source / "pyproject.toml").is_file() and (source / folder / file).is_file():
        return source / folder
    for path in _installed((SHARED / folder / file).as_posix()):
        if path.is_file():
            return path.parent
    raise UnusableInput(
        "The shipped {} are neither in {} nor where rigapp is installed; install it"
        " again, or name files of your own.",
        folder,
        source / folder,
    )


def _installed(shared: str) -> list[Path]:
    """Return the paths of a file from the record of the installation."""
    try:
        files = metadata.files("rigapp") or []
    except metadata.PackageNotFoundError:
        return []
    return [Path(str(file.locate())).resolve() for file in files if str(file).endswith(shared)]
