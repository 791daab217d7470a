"""Three hours of a test at twenty times its speed, with faults at random and the mail down for one.

The long form of the stories: every alarm is told once, in time, and the test takes no notice of it.
"""

from __future__ import annotations

import os
import random
import threading
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from receivers import MailServer, Receiver, until

from rigapp.config.loading import read_rig, read_test
from rigapp.schema.messages import Alarm, FinishReason, Flag, Remedy, Request, RunState, Severity
from rigapp.schema.notices import AlarmChanged
from rigapp.schema.states import ACTIVE, ENDED
from rigapp.service.faults import FaultChoice, fault_choices
from rigapp.service.host import EngineHost
from rigapp.service.simulated import parse_speed
from rigapp.storage import open_test

EXAMPLES = Path(__file__).parents[2] / "examples"
RIG_NAME = "Simulated slider-crank"
HOURS = float(os.environ.get("RIGAPP_SOAK_HOURS", "3"))
PACE = 20.0
REVOLUTIONS = round(3600 * HOURS)
TOLD_S = 10.0
SEEN_S = 4.0
BETWEEN_S = (4.0, 20.0)
CHOICES = fault_choices((("daq", "gsv8"), ("drive", "roboclaw")))


@dataclass(frozen=True, slots=True)
class Observation:
    """A title and when it was there."""

    title: str
    at_s: float


class Witness(threading.Thread):
    """Write down when an alarm rose in the engine and when a message came."""

    def __init__(self, host: EngineHost, receiver: Receiver) -> None:
        super().__init__(daemon=True)
        self._notices, self._receiver = host.engine.watch(), receiver
        self.raised: list[Observation] = []
        self.told: list[Observation] = []
        self._active: set[str] = set()
        self.halted = threading.Event()

    def run(self) -> None:
        while not self.halted.is_set():
            notice = self._notices.get(0.02)
            while notice is not None:
                if isinstance(notice, AlarmChanged):
                    self._note(notice.alarm)
                notice = self._notices.get(0.0)
            for title in self._receiver.titles[len(self.told) :]:
                self.told.append(Observation(title, time.monotonic()))

    def _note(self, alarm: Alarm) -> None:
        if not alarm.active:
            self._active.discard(alarm.key)
        elif alarm.key not in self._active:
            self._active.add(alarm.key)
            if alarm.severity in (Severity.WARNING, Severity.CRITICAL):
                word = alarm.severity.value.upper()
                self.raised.append(
                    Observation(f"{RIG_NAME}: {word}: {alarm.title}", time.monotonic())
                )

    def alarms_told(self) -> list[Observation]:
        """Return the messages about alarms that rose, not those about the end of a test."""
        known = (f"{RIG_NAME}: WARNING: ", f"{RIG_NAME}: CRITICAL: ")
        return [
            one for one in self.told if one.title.startswith(known) and ": Test " not in one.title
        ]


def ask(host: EngineHost, verb: str, **arguments: object) -> str:
    """Ask as a window does; return the sentence of a refusal."""
    reply = host.handle(Request(verb=verb, arguments=dict(arguments), operator="Ada"))
    return "" if reply.ok else reply.sentence


def recover(host: EngineHost) -> None:
    """Do what the engine names as next until a test can go on."""
    engine = host.engine

    def ready() -> bool:
        told = engine.status().recovery
        going_on = told.step is Remedy.RESUME
        if not (going_on and engine.state is RunState.READY) and told.step is not Remedy.CAUSE:
            verb = "reset" if going_on else told.verb
            if verb:
                ask(host, verb)
        return going_on and engine.state is RunState.READY

    until(ready, "the way out leads to Ready")


@contextmanager
def hosted(folder: Path, receiver: Receiver, mail: MailServer) -> Iterator[EngineHost]:
    ways = "".join(
        f'\n[[notify]]\nname = "{name}"\nurl = "{url}"\nwhen = ["critical", "warning", "end"]\n'
        "recovered_after_s = 0.0\nmost_per_hour = 1000\n"
        for name, url in (
            ("hook", f"json://127.0.0.1:{receiver.port}/hook"),
            ("mail", mail.url),
        )
    )
    rig = folder / "rig.toml"
    rig.write_text((EXAMPLES / "simulated.toml").read_text("utf-8") + ways, "utf-8")
    document = read_rig(rig)
    host = EngineHost(document, parse_speed(str(PACE), document))
    try:
        yield host
    finally:
        host.close()


def a_test(folder: Path) -> Path:
    text = (EXAMPLES / "quick.toml").read_text("utf-8")
    path = folder / "test.toml"
    path.write_text(text.replace("revolutions = 500", f"revolutions = {REVOLUTIONS}", 1), "utf-8")
    return path


def disturb(host: EngineHost, choice: FaultChoice, file: Path) -> None:
    """Let a fault happen, mend it, and go on with the test."""
    engine = host.engine
    where = {"channel": "force_1"} if choice.where == "signal" else {"device": choice.where}
    refused = ask(host, "inject_fault", kind=choice.kind, **where)
    assert not refused, refused
    with suppress(TimeoutError):
        engine.wait(ENDED, SEEN_S)
    ask(host, "clear_fault", kind=choice.kind)
    if engine.state in ENDED and not complete(host):
        recover(host)
        refused = ask(host, "resume_file", file=str(file), reason="the fault is mended")
        assert not refused, (choice, refused)
    until(lambda: engine.state in (*ENDED, RunState.RUNNING), f"it goes on after {choice}")


def complete(host: EngineHost) -> bool:
    outcome = host.engine.outcome
    return outcome is not None and outcome.reason is FinishReason.COMPLETE


@pytest.mark.soak
@pytest.mark.timeout(7200)
def test_each_fault_of_three_hours_is_told_once_in_time_and_by_mail_after_its_outage(
    tmp_path: Path, receiver: Receiver, mail: MailServer
) -> None:
    seed = int(os.environ.get("RIGAPP_SOAK_SEED", "15"))
    chance, file = random.Random(seed), tmp_path / "t.h5"
    begun = time.monotonic()
    down = (begun + 3600 * HOURS / PACE / 3, begun + 3600 * HOURS / PACE * 2 / 3)
    kinds: Counter[str] = Counter()
    with hosted(tmp_path, receiver, mail) as host:
        witness = Witness(host, receiver)
        witness.start()
        host.start(read_test(a_test(tmp_path)), file, "Ada", resume=False)
        is_down = False
        while host.engine.state in ACTIVE or not complete(host):
            if not is_down and down[0] < time.monotonic() < down[1]:
                mail.down()
                is_down = True
            elif is_down and time.monotonic() > down[1]:
                mail.up()
                is_down = False
            with suppress(TimeoutError):
                host.engine.wait(ENDED, chance.uniform(*BETWEEN_S))
            if complete(host):
                break
            choice = chance.choice(CHOICES)
            kinds[f"{choice.where} {choice.kind}"] += 1
            disturb(host, choice, file)
        if is_down:
            mail.up()
        until(lambda: len(witness.alarms_told()) >= len(witness.raised), "all is told")
        until(lambda: Counter(mail.subjects) == Counter(receiver.titles), "the mail has it all")
        witness.halted.set()
        witness.join()
    assert Counter(one.title for one in witness.alarms_told()) == Counter(
        one.title for one in witness.raised
    )
    waits = []
    left = witness.alarms_told()
    for one in witness.raised:
        message = next(two for two in left if two.title == one.title)
        left.remove(message)
        waits.append(message.at_s - one.at_s)
    print(f"seed {seed}: {sum(kinds.values())} faults of {len(kinds)} kinds, {len(waits)} alarms")
    print(f"alarm to message: median {np.median(waits):.2f} s, longest {max(waits):.2f} s")
    print(f"ends told: {sum('Test' in one.title for one in witness.told)}")
    assert max(waits) < TOLD_S
    with open_test(file) as reader:
        number = reader.column("revolution").astype(int)
        quality = reader.column("quality").astype(int)
        print(f"{len(number)} of {REVOLUTIONS} rows, gaps {reader.summary()['gaps']}")
        print({one.name: int(np.count_nonzero(quality & one)) for one in Flag})
    assert number[-1] == REVOLUTIONS
    assert np.all(np.diff(number) >= 1)
