"""Remarks of the program: their level, the terminal, the file log_beside the results."""

from __future__ import annotations

import logging
import os
import threading
from pathlib import Path
from unittest.mock import patch

import pytest
from commandline import Done, program

from rigapp.config.errors import UnusableInput
from rigapp.process.logs import (
    LARGEST_FILE,
    LEVEL_VARIABLE,
    MOST_WAITING,
    BoundedQueueHandler,
    chosen_level,
    in_file,
    log_beside,
    on_terminal,
)

EXAMPLES = Path(__file__).parents[2] / "examples"
log = logging.getLogger("rigapp.test_logs")


def rigapp(folder: Path, *arguments: str | Path) -> Done:
    with patch.dict(os.environ, RIGAPP_RUNTIME_DIR=str(folder / "run")):
        return program(*arguments)


@pytest.fixture(autouse=True)
def _no_level(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(LEVEL_VARIABLE, "warning")


def test_a_file_takes_more_than_the_terminal(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "t.log"
    level = logging.getLogger().level
    with on_terminal("warning"), in_file(path):
        assert not path.exists()
        log.debug("not even kept")
        log.info("only kept, %d times", 1)
        log.warning("kept and shown")
    text = path.read_text()
    assert "INFO    rigapp.test_logs: only kept, 1 times" in text
    assert "kept and shown" in text
    assert "not even kept" not in text
    assert capsys.readouterr().err == "rigapp: WARNING: kept and shown\n"
    assert logging.getLogger().level == level


def test_a_lower_level_holds_for_terminal_file_and_processes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with on_terminal("debug"), in_file(tmp_path / "t.log"):
        log.debug("a detail")
        logging.getLogger("h5py").debug("a detail of others")
        assert chosen_level(None) == "debug"
    shown = capsys.readouterr().err
    assert "a detail\n" in shown
    assert "of others" not in shown
    assert "a detail\n" in (tmp_path / "t.log").read_text()


def test_files_may_end_in_any_order(tmp_path: Path) -> None:
    first, second = in_file(tmp_path / "a.log"), in_file(tmp_path / "b.log")
    first.__enter__()
    second.__enter__()
    first.__exit__(None, None, None)
    log.info("to the second")
    second.__exit__(None, None, None)
    assert not (tmp_path / "a.log").exists()
    assert "to the second" in (tmp_path / "b.log").read_text()


def test_who_writes_never_waits_for_a_disk_that_hangs() -> None:
    go_on, taken = threading.Event(), []

    class Hanging(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            go_on.wait(60.0)
            taken.append(record.getMessage())

    outlet = BoundedQueueHandler(Hanging(), "a disk that hangs")
    for number in range(3 * MOST_WAITING):
        outlet.handle(logging.LogRecord("rigapp", 20, "", 0, "%d", (number,), None))
    go_on.set()
    outlet.close()
    assert taken[:3] == ["0", "1", "2"]
    assert MOST_WAITING - 1 <= len(taken) <= MOST_WAITING + 1


def test_a_file_is_bounded_and_one_that_cannot_be_written_harms_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "t.log"
    for _ in range(3):
        with in_file(path):
            for _ in range(500):
                log.info("x" * 1000)
    sizes = [one.stat().st_size for one in tmp_path.iterdir()]
    assert len(sizes) == 2
    assert max(sizes) <= LARGEST_FILE
    with in_file(tmp_path / "nowhere" / "t.log"):
        log.warning("lost")
    assert capsys.readouterr().err == ""


def test_an_unknown_level_is_unusable_input(tmp_path: Path) -> None:
    with pytest.raises(UnusableInput, match="--log-level loud: choose debug, info, warning or err"):
        chosen_level("loud")
    done = rigapp(tmp_path, "--log-level", "loud", "info", tmp_path / "t.h5")
    assert done.returncode == 2
    assert done.stderr.startswith("rigapp: --log-level loud: choose")
    assert len(done.stderr.splitlines()) == 1


@pytest.mark.long
def test_a_test_has_its_log_beside_its_file(tmp_path: Path) -> None:
    out = tmp_path / "t.h5"
    rig, plan = EXAMPLES / "simulated.toml", tmp_path / "plan.toml"
    text = (EXAMPLES / "quick.toml").read_text("utf-8")
    plan.write_text(text.replace("[prediction]", "[prediction]\nenabled = false"), "utf-8")
    run = ["run", plan, "--rig", rig, "--out", out, "--revolutions", "3", "--speed", "max"]
    done = rigapp(tmp_path, *run)
    assert done.returncode == 0, done.stderr
    # Beside the end a busy computer may bring a warning of a late answer, and nothing else.
    said = [line for line in done.stderr.splitlines() if "WARNING: drive" not in line]
    assert len(said) == 1, done.stderr
    text = log_beside(out).read_text()
    assert log_beside(out) == tmp_path / "t.log"
    assert "started by" in text
    assert "INFO" in text
    again = rigapp(tmp_path, "--log-level", "info", "run", *run[1:5], tmp_path / "u.h5", *run[6:])
    assert again.returncode == 0, again.stderr
    assert "rigapp: INFO: revolution" in again.stderr
