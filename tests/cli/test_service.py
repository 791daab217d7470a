"""`rigapp service`: what is written for systemd, what is asked of it, whose unit it is."""

from __future__ import annotations

import shlex
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from rigapp.commands import unattended
from rigapp.commands.doctor import RULES_NAME
from rigapp.config.errors import UnusableInput

EXAMPLE = Path(__file__).parents[2] / "examples" / "simulated.toml"


@pytest.fixture
def rig(tmp_path: Path) -> Path:
    path = tmp_path / 'rig "A" 100% $HOME.toml'
    shutil.copy(EXAMPLE, path)
    return path


@pytest.fixture
def asked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[], list[str]]:
    """Put programs in the way of systemd's that note what they are asked; return their notes."""
    notes = tmp_path / "asked"
    notes.touch()
    programs = tmp_path / "programs"
    programs.mkdir()
    for name, answer in (("systemctl", ""), ("loginctl", "echo no")):
        path = programs / name
        path.write_text(f'#!/bin/sh\necho "{name} $*" >> "{notes}"\n{answer}\n', "utf-8")
        path.chmod(0o755)
    monkeypatch.setenv("PATH", f"{programs}:/usr/bin:/bin")
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    # The tests may run as root, and the computer's own rules are no business of theirs.
    monkeypatch.setattr(unattended, "rules_folder", lambda: tmp_path / "no udev")
    return lambda: notes.read_text("utf-8").splitlines()


def value(text: str, key: str) -> str:
    (line,) = [one for one in text.splitlines() if one.startswith(f"{key}=")]
    return line.removeprefix(f"{key}=")


def test_an_engines_unit_stays_and_is_stopped_alone(rig: Path) -> None:
    unit = unattended.engine_unit(rig)
    assert unit.name == "rigapp-engine-rig-A-100-HOME.service"
    words = shlex.split(value(unit.text, "ExecStart").replace("%%", "%").replace("$$", "$"))
    assert words[1:] == ["-P", "-m", "rigapp", "engine", str(rig), "--stay"]
    assert '\\"A\\" 100%% $$HOME' in value(unit.text, "ExecStart")
    assert value(unit.text, "KillMode") == "mixed"
    assert int(value(unit.text, "TimeoutStopSec")) > 120
    assert value(unit.text, "Description") == "rigapp engine of Simulated slider-crank"


def test_the_pages_unit_names_its_files_wherever_it_is_started(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    unit = unattended.page_unit("10.0.0.7:8750", Path("token"), Path("c.pem"), Path("k.pem"))
    words = shlex.split(value(unit.text, "ExecStart"))
    assert words[4:7] == ["page", "--bind", "10.0.0.7:8750"]
    assert words[7:] == [
        "--token", str(tmp_path / "token"), "--certificate", str(tmp_path / "c.pem"), "--key",
        str(tmp_path / "k.pem"),
    ]  # fmt: skip


def test_units_are_enabled_and_taken_away_again(
    rig: Path, asked: Callable[[], list[str]], capsys: pytest.CaptureFixture[str]
) -> None:
    engine, page = unattended.engine_unit(rig), unattended.page_unit("127.0.0.1:8750")
    assert unattended.install_units([engine, page]) == 0
    assert unattended.install_units([engine, page]) == 0  # once more changes nothing
    for unit in (engine, page):
        assert (unattended.units_folder() / unit.name).read_text("utf-8") == unit.text
    assert asked()[:3] == [
        "systemctl --user daemon-reload",
        f"systemctl --user enable --now {engine.name} {page.name}",
        "loginctl show-user --property=Linger --value",
    ]
    assert "loginctl enable-linger" in capsys.readouterr().out
    assert unattended.remove_units([rig]) == 0
    assert asked()[-2:] == [
        f"systemctl --user disable --now {engine.name}",
        "systemctl --user daemon-reload",
    ]
    assert [one.name for one in unattended.units_folder().iterdir()] == [page.name]
    assert unattended.remove_units([]) == 0
    with pytest.raises(UnusableInput, match="nothing of rigapp's"):
        unattended.remove_units([])


def test_the_rules_for_ports_are_written_once_where_one_may(
    tmp_path: Path,
    asked: Callable[[], list[str]],
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    folder = tmp_path / "rules.d"
    assert unattended.install_rules(folder) == 0
    assert "no udev" in capsys.readouterr().out
    folder.mkdir()
    udevadm = tmp_path / "programs" / "udevadm"
    shutil.copy(tmp_path / "programs" / "systemctl", udevadm)
    assert unattended.install_rules(folder) == 0
    path = folder / RULES_NAME
    assert "ID_MM_PORT_IGNORE" in path.read_text("utf-8")
    assert len(asked()) == 2
    assert unattended.install_rules(folder) == 0
    assert "up to date" in capsys.readouterr().out
    assert len(asked()) == 2, "nothing is asked twice"
    path.write_text("# of an older version\n", "utf-8")
    monkeypatch.setattr("os.access", lambda *_: False)
    assert unattended.install_rules(folder) == 1
    told = capsys.readouterr().out
    assert "Run once: sudo" in told
    assert shlex.split(told.partition("sudo ")[2])[1:] == [
        "-P", "-m", "rigapp", "service", "install", "--rules",
    ]  # fmt: skip
    monkeypatch.undo()
    assert unattended.install_rules(folder) == 0
    assert path.read_text("utf-8").startswith(f"# {RULES_NAME}")


def test_the_unit_of_another_rig_is_never_overwritten(
    rig: Path, tmp_path: Path, asked: Callable[[], list[str]]
) -> None:
    unattended.install_units([unattended.engine_unit(rig)])
    other = tmp_path / "elsewhere" / rig.name
    other.parent.mkdir()
    shutil.copy(rig, other)
    before = asked()
    with pytest.raises(UnusableInput, match="give one of the two rig files another name"):
        unattended.install_units(
            [unattended.page_unit("127.0.0.1:1"), unattended.engine_unit(other)]
        )
    assert asked() == before
    assert len(list(unattended.units_folder().iterdir())) == 1


def test_without_systemd_it_says_so(
    rig: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    assert unattended.install_units([unattended.engine_unit(rig)]) == 1
    assert "no systemctl" in capsys.readouterr().err


def test_a_rig_file_that_is_not_usable_is_refused_before_anything_is_written(
    tmp_path: Path,
) -> None:
    path = tmp_path / "rig.toml"
    path.write_text("schema = 1\n", "utf-8")
    with pytest.raises(UnusableInput, match=r"rig\.toml"):
        unattended.engine_unit(path)
