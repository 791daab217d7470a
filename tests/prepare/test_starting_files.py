"""`rigapp init`: a folder to start from works as it stands, and nothing is overwritten."""

from __future__ import annotations

import os
import subprocess
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest
from patience import PATIENCE_S

from rigapp.commands.init import NEXT, start_folder
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig, read_test
from rigapp.prepare import folders, shipped
from rigapp.prepare.folders import starting_files

TOP = Path(__file__).parents[2]
EXAMPLES = TOP / "examples"


def files_below(folder: Path) -> dict[str, bytes]:
    return {
        str(one.relative_to(folder)): one.read_bytes() for one in folder.rglob("*") if one.is_file()
    }


def test_the_files_are_there_and_can_be_read(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "new" / "rig 7"
    start_folder(folder)
    assert {"rig.toml", "test.toml", "parameters.toml"} < set(files_below(folder))
    assert (folder / "rig.toml").read_text() == (EXAMPLES / "simulated.toml").read_text()
    assert read_rig(folder / "rig.toml").record.simulation is not None
    assert read_test(folder / "test.toml").record.run.revolutions > 0
    said = capsys.readouterr().out
    assert all(name in said for name in files_below(folder))


def test_every_file_that_a_file_names_is_there(tmp_path: Path) -> None:
    start_folder(tmp_path)
    for name, data in files_below(tmp_path).items():
        text = data.decode()
        assert "simulated.toml" not in text, name
        assert "quick.toml" not in text, name
    words = (tmp_path / "calibration" / "run_out.toml").read_text().split()
    assert (tmp_path / "calibration" / words[words.index("--rig") + 1]).is_file()


@pytest.mark.parametrize("there", ["test.toml", "calibration/probes.csv"])
def test_nothing_is_written_where_one_of_the_files_exists(tmp_path: Path, there: str) -> None:
    (tmp_path / there).parent.mkdir(exist_ok=True)
    (tmp_path / there).write_text("mine")
    with pytest.raises(UnusableInput, match=f"{there} exists already; nothing was written"):
        start_folder(tmp_path)
    assert files_below(tmp_path) == {there: b"mine"}


def test_other_files_stay_as_they_are(tmp_path: Path) -> None:
    (tmp_path / "calibration").mkdir()
    (tmp_path / "calibration" / "mine.csv").write_text("1,2")
    start_folder(tmp_path)
    assert (tmp_path / "calibration" / "mine.csv").read_text() == "1,2"


def test_a_link_to_nowhere_counts_as_a_file(tmp_path: Path) -> None:
    (tmp_path / "rig.toml").symlink_to("elsewhere.toml")
    with pytest.raises(UnusableInput, match=r"rig\.toml exists already"):
        start_folder(tmp_path)
    assert not (tmp_path / "elsewhere.toml").exists()


@pytest.mark.parametrize("name", ["folder", "folder/calibration"])
def test_a_file_in_the_place_of_a_folder_is_named(tmp_path: Path, name: str) -> None:
    place = tmp_path / name
    place.parent.mkdir(exist_ok=True)
    place.write_text("")
    with pytest.raises(UnusableInput, match=f"{place}: is not a folder"):
        start_folder(tmp_path / "folder")
    assert set(files_below(tmp_path)) == {name}


def test_what_was_written_is_taken_back_when_the_disk_refuses(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    written = []

    def until_the_third(*arguments: object, **options: object) -> object:
        written.append(arguments[0])
        if len(written) == 3:
            raise UnusableInput("no space left")
        return whole_file(*arguments, **options)

    whole_file = folders.whole_file
    monkeypatch.setattr(folders, "whole_file", until_the_third)
    with pytest.raises(UnusableInput, match="no space"):
        start_folder(tmp_path / "a" / "b")
    assert list(tmp_path.iterdir()) == []


def test_notebooks_are_copied_too(tmp_path: Path) -> None:
    source = tmp_path / "examples"
    for one in starting_files(EXAMPLES):
        target = source / one.path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(one.text)
    (source / "rig.toml").rename(source / "simulated.toml")
    (source / "test.toml").rename(source / "quick.toml")
    (source / "notebooks").mkdir(exist_ok=True)
    (source / "notebooks" / "look.ipynb").write_text('{"cells": ["run ../quick.toml"]}')
    found = {str(one.path): one.text for one in starting_files(source)}
    assert found["notebooks/look.ipynb"] == '{"cells": ["run ../test.toml"]}'


def rigapp(*arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run a command in a folder, with the source of this test."""
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join([str(TOP), os.environ.get("PYTHONPATH", "")]),
        "RIGAPP_RUNTIME_DIR": str(folder / "run"),
    }
    return subprocess.run(
        [sys.executable, "-m", "rigapp", *arguments],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )


@pytest.mark.long
def test_the_commands_that_it_offers_work_in_the_folder(tmp_path: Path) -> None:
    done = rigapp("init", folder=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert "Numerical kernels are compiled once" in done.stdout
    *_, examples = lines = done.stdout.splitlines()
    assert lines[-1 - len(NEXT) : -1] == [f"  {command}" for command in NEXT]
    assert Path(examples.rpartition(": ")[2]).is_dir()
    for command in NEXT:
        short = ("--revolutions", "5") if command.startswith("rigapp run") else ()
        done = rigapp(*command.split()[1:], *short, folder=tmp_path)
        assert done.returncode == 0, done.stderr
    assert (tmp_path / "test.h5").is_file()
    assert (tmp_path / "cell.json").is_file()
    again = rigapp("init", folder=tmp_path)
    assert again.returncode == 2
    assert "rig.toml, test.toml" in again.stderr


def test_an_installation_holds_every_file() -> None:
    project = tomllib.loads((TOP / "pyproject.toml").read_text())
    held = {
        Path(place).relative_to(shipped.SHARED) / one.name
        for place, patterns in project["tool"]["setuptools"]["data-files"].items()
        for pattern in patterns
        for one in TOP.glob(pattern)
    }
    old = {new: one for one, new in folders.NEW_NAMES.items()}
    for one in starting_files(EXAMPLES):
        assert Path("examples") / one.path.with_name(old.get(one.path.name, one.path.name)) in held
    guides = TOP / "docs"
    for one in [*guides.glob("*.md"), *(guides / "images").iterdir()]:
        assert one.relative_to(TOP) in held


@pytest.mark.parametrize(
    ("folder", "file", "find"),
    [
        ("examples", shipped.RIG, shipped.examples_folder),
        ("docs", shipped.GUIDE, shipped.guides_folder),
    ],
)
def test_what_is_shipped_is_found_where_an_installation_put_it(
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    folder: str,
    file: str,
    find: Callable[[], Path],
) -> None:
    site = tmp_path / "lib" / "site-packages"
    monkeypatch.setattr(shipped, "__file__", str(site / "rigapp" / "prepare" / "shipped.py"))
    (site / folder).mkdir(parents=True)
    (site / folder / file).write_text("of another package")
    shared = tmp_path / shipped.SHARED / folder / file
    monkeypatch.setattr(shipped.metadata, "files", lambda _: [_Installed(shared)])
    with pytest.raises(UnusableInput, match="install it again"):
        find()
    shared.parent.mkdir(parents=True)
    shared.write_text("")
    assert find() == shared.parent


class _Installed:
    """A line of an installation's list of files."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def __str__(self) -> str:
        return f"../../{self.path.relative_to(self.path.parents[3]).as_posix()}"

    def locate(self) -> Path:
        return self.path
