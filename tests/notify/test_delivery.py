"""Messages arrive by real servers, through every kind of outage, once each."""

from __future__ import annotations

import json
import os
import random
import signal
import stat
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import msgspec
import pytest
from patience import PATIENCE_S
from receivers import MailServer, Receiver, free_port, until

from rigapp.config.notify import NotifySection, PingSection
from rigapp.notify import channels, outbox
from rigapp.notify.facts import Fact, Heartbeat, NotifierSetup, Observation
from rigapp.notify.notifier import Notifier
from rigapp.notify.store import state_file
from rigapp.schema.messages import Alarm, RunState, Severity, Status
from rigapp.schema.notices import AlarmChanged

pytestmark = pytest.mark.skipif(not hasattr(os, "killpg"), reason="needs groups of processes")

RUNNING = Heartbeat(
    Status.of_flat(
        {"state": RunState.RUNNING, "rig": "Rig", "test": "Long test", "revolution": 420}
    )
)


def changed(
    key: str, *, active: bool = True, severity: Severity = Severity.WARNING
) -> AlarmChanged:
    title = f"Trouble {key}"
    return AlarmChanged(
        Alarm(key, severity, title, "Cause.", "Effect.", "Act.", 0.0, 7, active=active)
    )


class Post:
    """A notifier that is stepped by the test, with a number for each fact."""

    def __init__(self, folder: Path, *told: NotifySection, ping: PingSection | None = None) -> None:
        self.setup = NotifierSetup("/rigs/rig.toml", told, ping, str(folder), "", "run 1", "Rig")
        self.notifier = Notifier(self.setup)
        self.said: list[str] = []
        self.wrong = ""
        self._number = 0

    def update(self, *seen: Observation) -> None:
        facts = []
        for one in seen:
            self._number += 1
            facts.append(Fact(time.time(), one, self._number))
        self.step(facts)

    def step(self, facts: Sequence[Fact] = ()) -> None:
        answer = self.notifier.step(facts)
        if answer is not None:
            self.said += answer.remarks
            self.wrong = self.wrong if answer.wrong is None else answer.wrong

    def until(self, condition: Callable[[], Any], what: str) -> None:
        until(lambda: [self.step(), condition()][-1], f"{what}; said: {self.said}")

    @property
    def file(self) -> Path:
        return state_file(Path(self.setup.folder), self.setup.rig)


@pytest.fixture(autouse=True)
def _impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a failed attempt be followed by another soon."""
    monkeypatch.setattr(outbox, "FIRST_WAIT_S", 0.2)
    monkeypatch.setattr(outbox, "LONGEST_WAIT_S", 0.5)


def way(url: str, name: str = "a way", **more: Any) -> NotifySection:
    when = ("critical", "warning", "end", "silence")
    return NotifySection(url=url, name=name, when=when, recovered_after_s=0.0, **more)


def hook(receiver: Receiver, **more: Any) -> NotifySection:
    return way(f"json://127.0.0.1:{receiver.port}/hook", "hook", **more)


def test_a_mail_says_what_happened_and_another_that_it_is_over(
    tmp_path: Path, mail: MailServer
) -> None:
    post = Post(tmp_path, way(mail.url, "mail"))
    post.update(RUNNING, changed("a"))
    post.until(lambda: mail.subjects, "the mail has come")
    post.update(changed("a"), changed("a", active=False))
    post.until(lambda: len(mail.subjects) == 2, "it is told to be over")
    assert mail.subjects == ["Rig: WARNING: Trouble a", "Rig: OVER: Trouble a"]
    assert "Cause. At revolution 7." in mail.bodies[0]
    assert "What to do: Act." in mail.bodies[0]
    post.until(lambda: post.notifier.idle, "all is sent")
    where = "told by mail, mailto://127.0.0.1"
    assert post.said == [f"{where}: Trouble a (raised)", f"{where}: Trouble a (recovered)"]


@pytest.mark.long
def test_a_server_that_is_down_costs_no_message_and_the_log_tells_it_once(
    tmp_path: Path, mail: MailServer
) -> None:
    mail.down()
    post = Post(tmp_path, way(mail.url, "mail"))
    post.update(RUNNING, changed("a"), changed("b"))
    post.until(lambda: post.said, "the failure is told")
    post.update(changed("c"))
    (one,) = post.notifier.state.ways.values()
    post.until(
        lambda: next(iter(post.notifier.state.ways.values())).outbox.failures >= 3, "it is tried"
    )
    mail.up()
    post.until(lambda: len(mail.subjects) == 3, "all have come")
    post.until(lambda: post.notifier.idle, "all is sent")
    assert mail.subjects == [f"Rig: WARNING: Trouble {key}" for key in "abc"]
    assert len(post.said) == 4
    assert "could not be told: Trouble a (raised)" in post.said[0]
    assert "at attempt" in post.said[1]
    assert one.outbox.waiting


def test_a_server_that_refuses_is_asked_again(tmp_path: Path, mail: MailServer) -> None:
    mail.refuses = True
    post = Post(tmp_path, way(mail.url, "mail"))
    post.update(RUNNING, changed("a"))
    post.until(lambda: post.said, "the refusal is told")
    mail.refuses = False
    post.until(lambda: mail.subjects == ["Rig: WARNING: Trouble a"], "it is taken")


@pytest.mark.long
def test_a_server_that_hangs_holds_up_no_other_way_and_is_let_go(
    tmp_path: Path, mail: MailServer, receiver: Receiver, monkeypatch: pytest.MonkeyPatch
) -> None:
    receiver.answer = "hang"
    hanging = msgspec.structs.replace(
        hook(receiver), url=f"json://127.0.0.1:{receiver.port}/hook?rto=10000&cto=10000"
    )
    post = Post(tmp_path, hanging, way(mail.url, "mail"))
    post.update(RUNNING, changed("a"))
    post.until(lambda: receiver.tries and mail.subjects, "the other way has told it")
    assert not receiver.bodies
    monkeypatch.setattr(channels, "ATTEMPT_S", 3.0)
    receiver.answer = 500
    fresh = Post(tmp_path / "fresh", hanging)
    (tmp_path / "fresh").mkdir()
    receiver.answer = "hang"
    fresh.update(RUNNING, changed("a"))
    fresh.until(lambda: fresh.said, "the attempt is given up")
    assert "no answer within 3 s" in fresh.said[0]
    monkeypatch.setattr(channels, "ATTEMPT_S", PATIENCE_S)
    receiver.answer = 200
    fresh.until(lambda: receiver.bodies, "it arrives in the end")
    assert receiver.titles[0] == "Rig: WARNING: Trouble a"


def test_what_waits_survives_the_notifier_and_comes_in_pairs(
    tmp_path: Path, receiver: Receiver
) -> None:
    receiver.answer = 503
    first = Post(tmp_path, hook(receiver))
    first.update(RUNNING, changed("a"), changed("b"))
    first.until(lambda: first.said, "it fails")
    first.until(lambda: not first.notifier.busy, "nothing is on its way")
    assert stat.S_IMODE(first.file.stat().st_mode) == 0o600
    receiver.answer = 200
    second = Post(tmp_path, hook(receiver))
    second.update(*[RUNNING] * 4, changed("a"), changed("a", active=False))
    second.until(lambda: len(receiver.bodies) == 4, "all have come")
    second.until(lambda: second.notifier.idle, "all is sent")
    assert sorted(receiver.titles) == [
        "Rig: OVER: Trouble a", "Rig: OVER: Trouble b",
        "Rig: WARNING: Trouble a", "Rig: WARNING: Trouble b",
    ]  # fmt: skip


def test_what_waits_for_a_way_goes_by_no_other(tmp_path: Path, receiver: Receiver) -> None:
    receiver.answer = 503
    first = Post(tmp_path, hook(receiver))
    first.update(changed("a"))
    first.until(lambda: first.said, "it fails")
    receiver.answer = 200
    other = Post(tmp_path, way(hook(receiver).url, "another"))
    other.step()
    assert other.said == ["1 messages waited for a way that is set up no more; they are dropped"]
    assert other.notifier.idle


def test_a_fact_that_is_handed_over_twice_counts_once(tmp_path: Path, receiver: Receiver) -> None:
    post = Post(tmp_path, hook(receiver))
    facts = [Fact(0.0, changed("a"), 1), Fact(0.0, changed("a", active=False), 2)]
    post.step(facts)
    post.until(lambda: len(receiver.bodies) == 2 and post.notifier.idle, "both have come")
    again = Post(tmp_path, hook(receiver))
    again.step(facts)
    assert again.notifier.idle


def test_a_state_that_is_damaged_is_set_aside(tmp_path: Path, receiver: Receiver) -> None:
    post = Post(tmp_path, hook(receiver))
    post.file.write_bytes(b"\x81nonsense")
    post = Post(tmp_path, hook(receiver))
    post.update(changed("a"))
    post.until(lambda: receiver.bodies, "it is told")
    assert post.file.with_suffix(".unreadable").exists()


def test_a_disk_that_takes_nothing_keeps_no_message_back(
    tmp_path: Path, receiver: Receiver
) -> None:
    post = Post(tmp_path / "missing", hook(receiver))
    post.update(changed("a"))
    post.until(lambda: receiver.bodies, "it is told")
    assert "cannot be written" in post.wrong


@pytest.mark.long
def test_trouble_at_random_with_outages_is_told_once_each_in_pairs(
    tmp_path: Path, mail: MailServer
) -> None:
    chance = random.Random(15)
    post = Post(tmp_path, way(mail.url, "mail", most_per_hour=1000))
    active: set[str] = set()
    expected: list[str] = []
    for step in range(16):
        if step == 5:  # not in the midst of an attempt, which would be made twice
            post.until(lambda: post.notifier.idle, "all is sent")
            mail.down()
        if step == 11:
            mail.up()
        key = chance.choice("abc")
        active ^= {key}
        word = "WARNING" if key in active else "OVER"
        expected.append(f"Rig: {word}: Trouble {key}")
        post.update(RUNNING if not active else changed(key, active=key in active))
        post.step()
    post.until(lambda: len(mail.subjects) >= len(expected), "all have come")
    post.until(lambda: post.notifier.idle, "all is sent")
    assert sorted(mail.subjects) == sorted(expected)
    for key in "abc":
        own = [one for one in mail.subjects if one.endswith(key)]
        assert own == [
            f"Rig: {('WARNING', 'OVER')[place % 2]}: Trouble {key}" for place in range(len(own))
        ]


def test_of_a_flood_no_more_are_sent_than_wanted_and_none_is_left_out(
    tmp_path: Path, receiver: Receiver
) -> None:
    post = Post(tmp_path, hook(receiver, most_per_hour=3))
    post.update(RUNNING, *[changed(str(number)) for number in range(12)])
    post.until(lambda: post.notifier.idle, "all is sent")
    assert len(receiver.bodies) <= 3
    text = json.dumps(receiver.bodies)
    assert all(text.count(f"Trouble {number}\\n") <= 1 for number in range(12))
    assert all(f"Trouble {number}" in text for number in range(12))


def test_a_way_that_fails_for_long_is_an_alarm_until_it_works(
    tmp_path: Path, receiver: Receiver, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rigapp.notify.notifier.FAILING_S", 0.1)
    receiver.answer = 500
    post = Post(tmp_path, hook(receiver))
    post.update(changed("a"))
    post.until(lambda: post.wrong, "the engine is told")
    assert post.wrong.startswith("hook has failed since")
    receiver.answer = 200
    post.until(lambda: not post.wrong, "it works again")


def test_the_ping_comes_while_all_is_well_and_only_then(tmp_path: Path, receiver: Receiver) -> None:
    ping = PingSection(f"http://127.0.0.1:{receiver.port}/ping", interval_s=0.1)
    post = Post(tmp_path, ping=ping)
    post.update(RUNNING)
    post.until(lambda: len(receiver.pings) >= 2, "two pings have come")
    bad = changed("x", severity=Severity.CRITICAL).alarm
    post.update(Heartbeat(Status.of_flat(RUNNING.status.flat() | {"alarms": (bad,)})))
    post.until(lambda: post.notifier._ping is None, "the last one is through")
    number = len(receiver.pings)
    for _ in range(20):
        post.step()
    assert post.notifier._ping is None
    assert len(receiver.pings) == number
    post.update(RUNNING)
    post.until(lambda: len(receiver.pings) > number, "it comes again")
    receiver.answer = 500
    post.until(lambda: post.said, "its failure is told")
    assert "does not arrive: the server answered 500" in post.said[0]


KEEP = """
import json, sys
told = json.load(sys.stdin)
with open(sys.argv[1], "a") as file:
    print(told["title"], told["level"], len(told["messages"]), file=file)
"""


def test_a_command_takes_the_message_from_its_input(tmp_path: Path) -> None:
    out = tmp_path / "told.txt"
    command = (sys.executable, "-c", KEEP, str(out))
    post = Post(tmp_path, NotifySection(command=command, name="own", when=("warning",)))
    post.update(RUNNING, changed("a"))
    post.until(lambda: post.notifier.idle, "it is told")
    assert out.read_text() == "Rig: WARNING: Trouble a warning 1\n"


def test_a_command_that_fails_or_hangs_is_ended_and_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(channels, "ATTEMPT_S", 2.0)
    for code, words in (("import sys; sys.exit(3)", "ended with status 3"),
                        ("import time; time.sleep(1000)", "took longer than 2 s")):  # fmt: skip
        folder = tmp_path / words.replace(" ", "")
        folder.mkdir()
        command = (sys.executable, "-c", code)
        post = Post(folder, NotifySection(command=command, name="own", when=("warning",)))
        post.update(changed("a"))
        post.until(lambda post=post: post.said, "the failure is told")
        assert words in post.said[0]


ENGINE = """
import queue, sys, time
from pathlib import Path
import msgspec
from rigapp.notify.facts import NotifierSetup
from rigapp.notify.link import NotifierLink
from rigapp.schema.messages import RunState, Status

class Nothing:
    def get(self, timeout_s):
        time.sleep(min(timeout_s, 0.05))

setup = msgspec.json.decode(Path(sys.argv[1]).read_bytes(), type=NotifierSetup)
status = Status.of_flat(dict(state=RunState.RUNNING, rig="Rig", test="Long test", revolution=420))
link = NotifierLink(setup, Nothing(), lambda: status, print, print, Path(sys.argv[2]))
while True:
    print(link.notifier_pid, link._processed, flush=True)
    time.sleep(0.1)
"""


@pytest.fixture
def engine(tmp_path: Path, receiver: Receiver) -> Any:
    """A process with a link, as an engine has one."""
    folder = tmp_path / "messages"
    folder.mkdir()
    setup = NotifierSetup(
        "/rigs/rig.toml", (hook(receiver),), None, str(folder), "", "run 1", "Rig"
    )
    (tmp_path / "setup.json").write_bytes(msgspec.json.encode(setup))
    process = subprocess.Popen(
        [sys.executable, "-c", ENGINE, str(tmp_path / "setup.json"), str(tmp_path)],
        stdout=subprocess.PIPE,
        text=True,
    )
    yield process
    process.kill()
    process.communicate()


def heard(engine: Any, other_than: int = 0) -> int:
    """Wait until a notifier has heard something; return its process."""
    deadline = time.monotonic() + PATIENCE_S
    while time.monotonic() < deadline:
        pid, _, number = engine.stdout.readline().partition(" ")
        if pid.isdigit() and int(pid) not in (0, other_than) and int(number) > 0:
            return int(pid)
    raise AssertionError("no notifier heard anything")


def test_a_killed_engine_is_told_by_its_notifier(engine: Any, receiver: Receiver) -> None:
    heard(engine)
    engine.kill()
    until(lambda: receiver.bodies, "the silence is told")
    assert receiver.titles == ["Rig: CRITICAL: No sign of life"]
    assert "process has ended" in receiver.bodies[0]["message"]
    assert "Long test at revolution 420" in receiver.bodies[0]["message"]


def test_a_killed_notifier_is_started_again(engine: Any, receiver: Receiver) -> None:
    first = heard(engine)
    os.kill(first, signal.SIGKILL)
    assert heard(engine, other_than=first) != first
    assert receiver.bodies == []


@pytest.mark.long
def test_a_stopped_engine_is_told_and_that_it_is_heard_again(
    tmp_path: Path, receiver: Receiver
) -> None:
    post = Post(tmp_path, hook(receiver, silent_after_s=5.0))
    post.update(RUNNING)
    post.until(lambda: receiver.bodies, "the silence is told")
    post.update(RUNNING)
    post.until(lambda: len(receiver.bodies) == 2, "it is told to be over")
    assert receiver.titles == ["Rig: CRITICAL: No sign of life", "Rig: OVER: No sign of life"]


def test_a_port_where_nobody_listens_is_told_without_a_traceback(tmp_path: Path) -> None:
    post = Post(tmp_path, way(f"json://127.0.0.1:{free_port()}", "nobody"))
    post.update(changed("a"))
    post.until(lambda: post.said, "the failure is told")
    assert "Traceback" not in post.said[0]
    assert post.said[0].startswith("nobody, json://127.0.0.1, could not be told")
