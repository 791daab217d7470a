"""`rigapp package`: tests as they are published, after a look for what is private."""

from __future__ import annotations

import socket
import sys
from collections.abc import Sequence
from pathlib import Path

from rigapp.commands.progress import bar
from rigapp.publishing.package import private_in, published, refuse_target, write_package

SHORTEST_NAME = 4
"""Shorter names of computers stand in many words by chance."""


def package_tests(
    paths: Sequence[Path], to: Path, authors: Sequence[str], licence: str, *, allow_private: bool
) -> int:
    """Write the package of tests; return the exit status, 1 when something private is in them.

    Raises UnusableInput for a test that runs, no author, an unknown licence, an existing target.
    """
    refuse_target(to)
    given = published(paths, authors, licence)
    found = private_in(given, _this_computer())
    for one in found:
        print(f"{'note' if allow_private else 'rigapp'}: {one.sentence}", file=sys.stderr)
    if found and not allow_private:
        print(
            "rigapp: nothing is written. Name people as authors (--author 'Family, Given'), or"
            " publish it all the same (--allow-private); the test files stay as they are.",
            file=sys.stderr,
        )
        return 1
    with bar("Package") as progress:
        files = write_package(given, to, progress)
    names = "; ".join(one.name for one in given.authors)
    print(f"The package is {to}: {len(files)} files, by {names}, {given.licence.identifier}.")
    return 0


def _this_computer() -> frozenset[str]:
    """Return the names of this computer by which it can be told from others."""
    name = socket.gethostname()
    names = {name, name.partition(".")[0]}
    return frozenset(one for one in names if len(one) >= SHORTEST_NAME and one != "localhost")
