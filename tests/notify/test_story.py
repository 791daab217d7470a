"""A fault of the simulated rig is told once, its end once; secrets stay out of all that is kept."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from commandline import program, rigapp
from receivers import MailServer, Receiver, until

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig, read_test
from rigapp.schema.messages import Request
from rigapp.schema.states import ENDED
from rigapp.service.host import EngineHost
from rigapp.service.simulated import parse_speed
from rigapp.storage import open_test

EXAMPLES = Path(__file__).parents[2] / "examples"
TOKEN = "topsecrettoken"  # noqa: S105 - of this test


RIG_NAME = "Simulated slider-crank"
RAISED = f"{RIG_NAME}: WARNING: Input saturated: probe_1"
OVER = f"{RIG_NAME}: OVER: Input saturated: probe_1"
ENDED_TITLE = f"{RIG_NAME}: Test stopped"


def rig_file(folder: Path, notify: str) -> Path:
    path = folder / "rig.toml"
    path.write_text(f"{(EXAMPLES / 'simulated.toml').read_text('utf-8')}\n{notify}", "utf-8")
    return path


def keep_secret(folder: Path, mode: int = 0o600) -> Path:
    path = folder / "config" / "rigapp" / "secrets.toml"
    path.parent.mkdir(parents=True)
    path.write_text(f'token = "{TOKEN}"\n', "utf-8")
    path.chmod(mode)
    return path


def told(receiver: Receiver, name: str = "hook") -> str:
    return (
        f'[[notify]]\nname = "{name}"\n'
        f'url = "json://rig:{{token}}@127.0.0.1:{receiver.port}/hook"\n'
        'when = ["critical", "warning", "end"]\nrecovered_after_s = 0.0\n'
    )


def logged(out: Path) -> list[str]:
    with open_test(out) as reader:
        return [one.text for one in reader.events() if one.kind == "message"]


@contextmanager
def hosted(rig: Path) -> Iterator[EngineHost]:
    document = read_rig(rig)
    host = EngineHost(document, parse_speed("1", document))
    try:
        yield host
    finally:
        host.close()


@pytest.mark.long
def test_a_fault_is_told_once_and_its_end_once_and_so_is_the_end_of_the_test(
    tmp_path: Path, receiver: Receiver
) -> None:
    keep_secret(tmp_path)
    rig = rig_file(tmp_path, told(receiver))
    plan, out = read_test(EXAMPLES / "quick.toml"), tmp_path / "t.h5"
    with hosted(rig) as host:
        host.start(plan, out, "Ada", resume=False)
        saturated = {"kind": "saturated_input", "channel": "probe_1"}
        assert host.handle(Request(verb="inject_fault", arguments=saturated)).ok
        until(lambda: RAISED in receiver.titles, "the fault is told")
        cleared = {"kind": "saturated_input"}
        assert host.handle(Request(verb="clear_fault", arguments=cleared)).ok
        until(lambda: OVER in receiver.titles, "its end is told")
        line = "told by hook, json://127.0.0.1"
        until(lambda: any(one.startswith(line) for one in logged(out)), "it is logged")
        host.engine.stop("Ada", "enough")
        host.engine.wait(ENDED, 60.0)
        until(lambda: ENDED_TITLE in receiver.titles, "the end is told")
    for title in (RAISED, OVER, ENDED_TITLE):
        assert receiver.titles.count(title) == 1
    end = receiver.bodies[receiver.titles.index(ENDED_TITLE)]
    assert "Ada stopped the test: enough" in end["message"]
    for path in tmp_path.rglob("*"):
        if path.is_file() and path.name != "secrets.toml":
            assert TOKEN.encode() not in path.read_bytes(), path


def test_a_secret_that_others_can_read_ends_it_before_a_device_is_opened(
    tmp_path: Path, receiver: Receiver
) -> None:
    path = keep_secret(tmp_path, 0o644)
    rig = rig_file(tmp_path, told(receiver))
    with pytest.raises(UnusableInput, match=f"hook: {path}: others can read it"):
        EngineHost(read_rig(rig), None)
    assert receiver.tries == 0


@pytest.mark.long
def test_the_command_tries_every_way_and_says_what_became_of_it(
    tmp_path: Path, receiver: Receiver, mail: MailServer
) -> None:
    keep_secret(tmp_path)
    ping = f'[ping]\nurl = "http://127.0.0.1:{receiver.port}/ping/{{token}}"\n'
    both = f'{told(receiver)}\n[[notify]]\nname = "mail"\nurl = "{mail.url}"\n'
    rig = rig_file(tmp_path, both + ping)
    done = program("notify", "--rig", rig, "--test")
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == [
        "hook, json://127.0.0.1: sent.",
        "mail, mailto://127.0.0.1: sent.",
        "ping, http://127.0.0.1: sent.",
    ]
    title = "Simulated slider-crank: Test of the messages"
    assert receiver.titles == mail.subjects == [title]
    mail.down()
    failed = rigapp("notify", "--rig", rig, "--test")
    assert failed.returncode == 1
    assert "mail, mailto://127.0.0.1: NOT SENT: " in failed.stdout
    listed = rigapp("notify", "--rig", rig)
    assert listed.returncode == 0
    assert "hook, json://127.0.0.1: critical, warning, end." in listed.stdout
    assert TOKEN not in "".join((done.stdout, failed.stdout, failed.stderr, listed.stdout))


def test_without_a_way_it_says_what_to_write(tmp_path: Path) -> None:
    done = rigapp("notify", "--test")
    assert done.returncode == 2
    assert "No way is set up: write [[notify]]" in done.stderr
