"""One operator in command among several viewers: who may do what, and how command changes hands."""

from __future__ import annotations

from pathlib import Path

import pytest
from patience import PATIENCE_S

from rigapp.schema.messages import Reply, Request
from rigapp.schema.states import Refused
from rigapp.service.requests import ASLEEP_S, CONTROL_TIMEOUT_S, ControlLock

ADA = {"operator": "Ada", "client": "a"}
BOB = {"operator": "Bob", "client": "b"}


class Clock:
    """A clock that is set by hand."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


class Desk:
    """A ControlLock with its clock and its log."""

    def __init__(self) -> None:
        self.clock = Clock()
        self.log: list[tuple[str, str, str, str]] = []
        self.command = ControlLock(lambda *event: self.log.append(event), self.clock)

    def ask(self, verb: str, who: dict[str, str], **arguments: object) -> object:
        request = Request(verb, arguments, **who)  # type: ignore[arg-type]
        self.command.check(request)
        if verb == "take_command":
            return self.command.take(request, force=arguments.get("force") is True)
        verbs = {"release_command": self.command.release, "present": self.command.present}
        return verbs.get(verb, lambda _: "done")(request)

    def pass_time(self, seconds: float) -> None:
        """Let time pass with a look every second, as the engine does more often."""
        for _ in range(round(seconds)):
            self.clock.now += 1.0
            self.command.look()


@pytest.fixture
def desk() -> Desk:
    return Desk()


def test_without_anybody_in_command_everybody_may_do_everything(desk: Desk) -> None:
    for who in (ADA, BOB, {"operator": "", "client": ""}):
        assert desk.ask("start", who) == "done"
    assert desk.command.holder == ""
    assert desk.log == []


def test_others_are_refused_by_name_but_may_make_the_rig_safe(desk: Desk) -> None:
    desk.ask("take_command", ADA)
    assert desk.ask("start", ADA) == "done"
    for verb in ("start", "pause", "resume", "set_limit", "zero", "reset", "shutdown", "note"):
        with pytest.raises(Refused, match=r"Ada has control .*" + verb):
            desk.ask(verb, BOB)
        with pytest.raises(Refused, match="Ada has control"):
            desk.ask(verb, {"operator": "Ada", "client": ""})
    for verb in ("stop", "drive_off", "acknowledge", "status", "signals", "hello"):
        assert desk.ask(verb, BOB) == "done"


def test_command_is_given_back_and_taken_by_another(desk: Desk) -> None:
    desk.ask("take_command", ADA)
    with pytest.raises(Refused, match="you do not control this rig; Ada does"):
        desk.ask("release_command", BOB)
    desk.ask("release_command", ADA)
    assert desk.ask("take_command", BOB) == {"in_command": "Bob"}
    with pytest.raises(Refused, match="Bob has control"):
        desk.ask("start", ADA)
    assert [event[2:] for event in desk.log] == [("", "Ada"), ("Ada", ""), ("", "Bob")]


def test_command_is_taken_over_only_by_force_and_that_is_recorded(desk: Desk) -> None:
    desk.ask("take_command", ADA)
    for harmless in ({}, {"force": False}):
        with pytest.raises(Refused, match="Ada has control"):
            desk.ask("take_command", BOB, **harmless)
    desk.ask("take_command", BOB, force=True)
    assert desk.log[-1] == ("took control by force from Ada", "Bob", "Ada", "Bob")
    assert desk.ask("present", ADA) == {"in_command": False}
    with pytest.raises(Refused, match="Bob has control"):
        desk.ask("start", ADA)


def test_command_taken_twice_is_one_event(desk: Desk) -> None:
    desk.ask("take_command", ADA)
    desk.ask("take_command", ADA)
    assert len(desk.log) == 1


def test_command_is_free_when_its_holder_is_gone(desk: Desk) -> None:
    desk.ask("take_command", ADA)
    desk.pass_time(CONTROL_TIMEOUT_S)
    assert desk.command.holder == "Ada"
    desk.pass_time(1)
    assert desk.command.holder == ""
    assert desk.log[-1][1:] == ("engine", "Ada", "")
    assert "no message from Ada" in desk.log[-1][0]
    assert desk.ask("start", BOB) == "done"


def test_any_request_of_the_holder_shows_that_it_is_there(desk: Desk) -> None:
    desk.ask("take_command", ADA)
    for verb in ("present", "status", "pause"):
        desk.pass_time(CONTROL_TIMEOUT_S)
        desk.ask(verb, ADA)
        desk.ask("status", BOB)
    desk.pass_time(CONTROL_TIMEOUT_S)
    assert desk.command.holder == "Ada"


def test_own_sleep_is_not_held_against_the_holder(desk: Desk) -> None:
    desk.ask("take_command", ADA)
    desk.pass_time(3)
    desk.clock.now += CONTROL_TIMEOUT_S + ASLEEP_S
    desk.command.look()
    assert desk.command.holder == "Ada"
    desk.pass_time(CONTROL_TIMEOUT_S)
    assert desk.command.holder == ""


def test_viewer_without_identity_cannot_take_command(desk: Desk) -> None:
    with pytest.raises(Refused, match="identity"):
        desk.ask("take_command", {"operator": "Ada", "client": ""})


def test_two_viewers_of_one_engine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The same over the wire: two clients, one engine, the name in the status."""
    from rigapp.config.loading import read_rig
    from rigapp.service.client import Client
    from rigapp.service.host import EngineHost
    from rigapp.service.registry import running_engines

    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path))
    host = EngineHost(read_rig(Path(__file__).parents[2] / "examples" / "simulated.toml"), "max")
    core, told = host.engine._core, []
    write = core._write
    monkeypatch.setattr(core, "_write", lambda event: told.append(event) or write(event))
    entry = running_engines()[-1]
    ada, bob = Client(entry, "Ada"), Client(entry, "Bob")
    try:
        assert bob.request("note", {"text": "nobody has control"}).ok
        assert not ada.request("take_command", {"force": "yes"}).ok
        assert ada.request("take_command").ok
        assert ada.request("note", {"text": "mine"}).ok
        refused = bob.request("note", {"text": "mine too"})
        assert not refused.ok
        assert refused.sentence.startswith("Ada has control of this rig")
        assert bob.request("status").result["in_command"] == "Ada"
        stopped: Reply = bob.request("stop")
        assert "in command" not in stopped.sentence  # refused by the state alone: nothing runs
        assert bob.request("take_command", {"force": True}).ok
        assert ada.request("note", {"text": "lost it"}).sentence.startswith("Bob has control")
        assert bob.request("release_command").ok
        assert ada.request("note", {"text": "again"}).ok
        kinds = [event.after for event in told if event.kind == "command"]
        assert kinds == ["Ada", "Bob", ""]
    finally:
        ada.close()
        bob.close()
        host.close()


def test_client_in_command_stays_present_until_it_is_closed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import threading

    from rigapp.service.client import Client
    from rigapp.service.registry import EngineEntry
    from rigapp.service.server import Server

    monkeypatch.setattr("rigapp.service.client.HEARTBEAT_S", 0.05)
    seen = threading.Semaphore(0)

    def handler(request: Request) -> Reply:
        if request.verb == "present":
            seen.release()
        return Reply(ok=True, result={"in_command": True})

    from test_server import Rows

    server = Server(handler, Rows(), f"ipc://{tmp_path}/c", f"ipc://{tmp_path}/s")
    server.start()
    client = Client(EngineEntry(1, server.commands, server.stream, "rig.toml", 0.0), "Ada")
    try:
        assert client.request("take_command").ok
        assert all(seen.acquire(timeout=PATIENCE_S) for _ in range(3))
    finally:
        client.close()
        server.close()
    assert not any(thread.name == "in-command" for thread in threading.enumerate())
