"""Control, record and understand slider-crank joint wear tests.

For analysts: ``test = rigapp.open("t.h5")`` and ``rigapp.open_many("results/*.h5")``, see
``rigapp.analysis.recorded``; ``rigapp.model`` and ``rigapp.calibration`` are libraries for scripts,
``rigapp.drivers`` is what a driver of your own is written with. What is not named here may change
from version to version.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import os

    from rigapp.analysis.recorded import Paths, RecordedTest, RecordedTests

__all__ = ["__version__", "calibration", "drivers", "model", "open", "open_many"]


def open(path: str | os.PathLike[str], *, chunks: int | None = None) -> RecordedTest:
    """Open a test file, running or ended.

    chunks: rows of a piece; datasets hold Dask arrays then, to be computed piece by piece. Raises
    UnusableInput for a file that is no test, and where the packages of the extra `analysis` are
    not installed.
    """
    from rigapp.config.errors import from_extra

    with from_extra("analysis", "rigapp.open"):
        from rigapp.analysis.recorded import RecordedTest

    return RecordedTest(path, chunks)


def open_many(paths: Paths, *, chunks: int | None = None) -> RecordedTests:
    """Open the test files of a pattern, of a folder or of a list; raise UnusableInput for none.

    chunks: as of ``open``.
    """
    from rigapp.config.errors import from_extra

    with from_extra("analysis", "rigapp.open_many"):
        from rigapp.analysis.recorded import RecordedTests

    return RecordedTests(paths, chunks)


def __getattr__(name: str) -> Any:
    """Load what is asked for: the command line need not wait for what it does not use."""
    if name == "__version__":
        from importlib.metadata import version

        return version("rigapp")
    if name in ("model", "calibration", "drivers"):
        return importlib.import_module(f"rigapp.{name}")
    raise AttributeError(f"module 'rigapp' has no attribute {name!r}")
