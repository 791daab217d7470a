"""The computer is kept awake by a holder that ends with the test, and with the program."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from patience import PATIENCE_S

from rigapp.commands.check import computer_checks
from rigapp.process import awake
from rigapp.process.awake import StayAwake, kept_awake

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="systemd is of Linux")


def eventually(condition: Callable[[], object], what: str) -> None:
    """Wait for a condition."""
    deadline = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < deadline, what
        time.sleep(0.01)


INHIBIT = """#!/bin/sh
echo "$1" >> {log}
case "$1" in *{refused}*) exit 1;; esac
while [ "$1" != cat ]; do shift; done
echo begin $$ >> {log}
exec cat
"""


@pytest.fixture
def logind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], Path]:
    """Put a systemd-inhibit on the path that refuses some kinds; return its log."""

    def make(refused: str = "nothing") -> Path:
        log = tmp_path / "log"
        program = tmp_path / awake.HOLDER
        program.write_text(INHIBIT.format(log=log, refused=refused))
        program.chmod(0o755)
        monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
        return log

    return make


def holders(log: Path) -> list[int]:
    """Return the processes that hold now."""
    begun = [line.split() for line in log.read_text().splitlines() if line.startswith("begin")]
    return [int(pid) for _, pid in begun if Path(f"/proc/{pid}").exists()]


def test_it_is_held_from_begin_to_end(logind: Callable[[str], Path]) -> None:
    log = logind("nothing")
    one = StayAwake()
    one.begin()
    eventually(lambda: log.exists() and bool(holders(log)), "the holder")
    one.end()
    eventually(lambda: not holders(log), "its end")
    one.end()


def test_what_may_not_be_held_is_left_out(logind: Callable[[str], Path]) -> None:
    log = logind("lid")
    assert kept_awake() == "sleep:idle"
    assert not holders(log)
    assert [check.sentence for check in computer_checks(log.parent / "none")] == [
        "held off while a test runs, but not the lid's switch"
    ]


def test_where_nothing_holds_it_says_so_and_names_updates(
    logind: Callable[[str], Path], tmp_path: Path
) -> None:
    logind("sleep")
    settings = tmp_path / "apt.conf.d"
    settings.mkdir()
    (settings / "50unattended-upgrades").write_text(
        'Unattended-Upgrade::Automatic-Reboot "true";\n', "utf-8"
    )
    sleep, updates = computer_checks(settings)
    assert "nothing keeps this computer awake" in sleep.sentence
    assert "may restart this computer" in updates.sentence


def test_the_holder_ends_with_a_program_that_is_killed(logind: Callable[[str], Path]) -> None:
    log = logind("nothing")
    code = "import time; from rigapp.process.awake import StayAwake; s = StayAwake(); s.hold();"
    code = code.replace("s.hold()", "s._wanted = True; s.hold()") + "time.sleep(600)"
    program = subprocess.Popen([sys.executable, "-c", code])
    try:
        eventually(lambda: log.exists() and bool(holders(log)), "the holder")
    finally:
        program.send_signal(signal.SIGKILL)
        program.wait()
    eventually(lambda: not holders(log), "its end")
