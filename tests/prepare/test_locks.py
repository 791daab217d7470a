"""The lock files agree with each other, and hold every package that an extra names."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parents[2]
LOCKS = ("constraints.txt", "constraints-test.txt", "constraints-bench.txt")
PIN = re.compile(r"^([A-Za-z0-9._-]+)(==\S+(?: ; [^\\]+)?)", re.MULTILINE)


def pins(name: str) -> set[tuple[str, str]]:
    """Return the packages of a lock file and their versions, with the marker of each."""
    text = (REPOSITORY / name).read_text(encoding="utf-8")
    return {(package.lower(), version.strip()) for package, version in PIN.findall(text)}


@pytest.mark.parametrize(("smaller", "larger"), [LOCKS[:2], LOCKS[1:]])
def test_a_larger_lock_keeps_the_versions_of_the_smaller(smaller: str, larger: str) -> None:
    assert pins(smaller) <= pins(larger)


@pytest.mark.parametrize(
    ("lock", "extras"),
    [
        (LOCKS[0], ("gui", "notify", "page", "build")),
        (LOCKS[1], ("gui", "notify", "page", "build", "test")),
        (LOCKS[2], ("gui", "notify", "page", "build", "test", "bench")),
    ],
)
def test_a_lock_holds_every_package_of_its_extras(lock: str, extras: tuple[str, ...]) -> None:
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    wanted = [*project["dependencies"]]
    for extra in extras:
        wanted += project["optional-dependencies"][extra]
    names = {re.split(r"[<>=!~;\[ ]", one)[0].lower().replace("_", "-") for one in wanted}
    assert names <= {package for package, _ in pins(lock)}


@pytest.mark.parametrize("lock", [*LOCKS, "constraints-docs.txt", "constraints-single.txt"])
def test_a_lock_has_hashes_and_no_addresses(lock: str) -> None:
    text = (REPOSITORY / lock).read_text(encoding="utf-8")
    assert "://" not in text
    assert all("--hash=sha256:" in block for block in re.split(r"\n(?=\S)", text.strip()))
