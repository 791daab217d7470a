"""Where the example files stand: beside the source, or where the installed package put them."""

from __future__ import annotations

from importlib import metadata
from pathlib import Path

from rigapp.config.errors import UnusableInput

RIG = "simulated.toml"
TEST = "quick.toml"
SHARED = f"share/rigapp/examples/{RIG}"
"""Where ``pyproject.toml`` lets an installation put the rig file, below its prefix."""


def examples_folder() -> Path:
    """Return the folder of the shipped rig, test and calibration files; raise UnusableInput."""
    source = Path(__file__).resolve().parents[2]
    # Some other package may have put a folder "examples" beside an installed rigapp.
    if (source / "pyproject.toml").is_file() and (source / "examples" / RIG).is_file():
        return source / "examples"
    for one in _installed():
        if one.is_file():
            return one.parent
    raise UnusableInput(
        f"The shipped examples are neither in {source / 'examples'} nor where rigapp is installed;"
        " install it again, or name files of your own."
    )


def _installed() -> list[Path]:
    """Return where the installation says that it put the rig file."""
    try:
        files = metadata.files("rigapp") or []
    except metadata.PackageNotFoundError:
        return []
    return [Path(str(one.locate())).resolve() for one in files if str(one).endswith(SHARED)]
