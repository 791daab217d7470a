"""Who may attach: to a port, that of loopback too, only with an authorised key."""

from __future__ import annotations

import stat
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
import zmq
from test_server import Handler, Rows, until

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.schema.messages import PROTOCOL_VERSION
from rigapp.service.client import Client, EngineUnreachable
from rigapp.service.host import EngineHost
from rigapp.service.launch import attach
from rigapp.service.registry import EngineEntry, announce, local_endpoints, running_engines
from rigapp.service.security import (
    Bind,
    authorise_own_viewer,
    authorised_folder,
    parse_bind,
    server_keys,
    viewer_keys,
)
from rigapp.service.server import Server

RIG = Path(__file__).parents[2] / "examples" / "simulated.toml"
ELSEWHERE = Bind("127.0.0.1", 0, remote=True)
"""Loopback that stands for another computer."""


@pytest.fixture
def engine_folder(tmp_path: Path) -> Path:
    folder = tmp_path / "engine"
    folder.mkdir()
    return folder


@pytest.fixture
def viewer_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "viewer"
    folder.mkdir()
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(folder))
    return folder


@pytest.fixture
def entry(engine_folder: Path) -> Iterator[EngineEntry]:
    server = Server(Handler(), Rows(), *ELSEWHERE.endpoints(), engine_folder)
    server.start()
    yield EngineEntry(1, server.commands, server.stream, str(RIG.resolve()), 0.0, server.public_key)
    server.close()
    assert server.failure is None


@pytest.fixture
def client_of() -> Iterator[Callable[[EngineEntry], Client]]:
    clients: list[Client] = []

    def make(entry: EngineEntry) -> Client:
        clients.append(Client(entry, "Ada"))
        return clients[-1]

    yield make
    for client in clients:
        client.close()


def authorise(viewer_folder: Path, engine_folder: Path) -> Path:
    viewer_keys(viewer_folder)
    path = authorised_folder(engine_folder) / "ada.key"
    path.write_bytes((viewer_folder / "keys" / "viewer.key").read_bytes())
    return path


@pytest.mark.parametrize(
    ("text", "address", "port", "remote"),
    [
        ("tcp://127.0.0.1:5000", "127.0.0.1", 5000, False),
        ("tcp://localhost:0", "127.0.0.1", 0, False),
        ("tcp://[::1]:5000", "::1", 5000, False),
        ("tcp://192.168.1.7:5000", "192.168.1.7", 5000, True),
        ("tcp://[fe80::1]:5000", "fe80::1", 5000, True),
    ],
)
def test_every_address_but_loopback_expects_viewers_of_other_computers(
    text: str, address: str, port: int, remote: bool
) -> None:
    assert parse_bind(text) == Bind(address, port, remote)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("tcp://0.0.0.0:5000", "one interface"),
        ("tcp://[::]:5000", "one interface"),
        ("tcp://*:5000", "not an IP address"),
        ("tcp://lab-pc:5000", "not an IP address"),
        ("tcp://127.0.0.1", "tcp://ADDRESS:PORT"),
        ("udp://127.0.0.1:1", "tcp://ADDRESS:PORT"),
        ("tcp://127.0.0.1:65535", "65534"),
    ],
)
def test_unusable_addresses_are_refused(text: str, words: str) -> None:
    with pytest.raises(UnusableInput, match=words):
        parse_bind(text)


def test_default_is_private_to_this_computer() -> None:
    for endpoint in (
        *local_endpoints(Path("/run/short"), 1),
        *local_endpoints(Path("/" + "x" * 99), 1),
    ):
        assert endpoint.startswith(("ipc:///run/short/", "tcp://127.0.0.1:"))


def test_authorised_viewer_attaches(
    entry: EngineEntry,
    viewer_folder: Path,
    engine_folder: Path,
    client_of: Callable[[EngineEntry], Client],
) -> None:
    authorise(viewer_folder, engine_folder)
    client = client_of(entry)
    client.hello()
    until(lambda: client.poll() is not None)


def test_viewer_with_another_key_cannot_attach_until_it_is_authorised(
    entry: EngineEntry,
    viewer_folder: Path,
    engine_folder: Path,
    client_of: Callable[[EngineEntry], Client],
) -> None:
    stranger = client_of(entry)
    with pytest.raises(EngineUnreachable, match="not among its authorised viewers"):
        stranger.request("drive_off", timeout_s=0.5)
    assert stranger.poll() is None
    path = authorise(viewer_folder, engine_folder)
    client_of(entry).hello()
    path.unlink()
    with pytest.raises(EngineUnreachable):
        client_of(entry).hello(0.5)


def test_viewer_without_a_key_cannot_attach(entry: EngineEntry) -> None:
    refuses_strangers(entry)


@pytest.mark.parametrize("bind", [None, "tcp://127.0.0.1:0"], ids=["long folder", "--bind"])
def test_a_port_of_this_computer_demands_keys(
    bind: str | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / ("run" if bind else "long" * 25)
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(folder))
    host = EngineHost(read_rig(RIG), "max", parse_bind(bind) if bind else None)
    try:
        client = attach(RIG)
        assert client.entry.commands.startswith("tcp://127.0.0.1:")
        assert client.request("status").result["state"] == "idle"
        client.close()
        refuses_strangers(client.entry)
    finally:
        host.close()


def refuses_strangers(entry: EngineEntry) -> None:
    context = zmq.Context()
    asks, looks = context.socket(zmq.REQ), context.socket(zmq.DEALER)
    try:
        asks.setsockopt(zmq.IMMEDIATE, 1)
        asks.setsockopt(zmq.SNDTIMEO, 500)
        asks.connect(entry.commands)
        looks.setsockopt(zmq.PROBE_ROUTER, 1)
        looks.connect(entry.snapshots)
        with pytest.raises(zmq.Again):
            asks.send(b"anything")
        assert not looks.poll(500)
    finally:
        context.destroy(linger=0)


def test_engine_with_another_key_is_not_believed(
    entry: EngineEntry,
    viewer_folder: Path,
    engine_folder: Path,
    tmp_path: Path,
    client_of: Callable[[EngineEntry], Client],
) -> None:
    authorise(viewer_folder, engine_folder)
    public, _ = zmq.curve_keypair()
    import msgspec

    impostor = msgspec.structs.replace(entry, server_key=public.decode())
    with pytest.raises(EngineUnreachable, match="its own key has changed"):
        client_of(impostor).hello(0.5)


def test_secret_keys_are_private_and_stay_the_same(engine_folder: Path) -> None:
    keys = server_keys(engine_folder)
    path = engine_folder / "keys" / "server.key_secret"
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    assert stat.S_IMODE(path.parent.stat().st_mode) == 0o700
    assert server_keys(engine_folder) == keys
    assert keys.secret.decode() not in (engine_folder / "keys" / "server.key").read_text()
    path.chmod(0o644)
    with pytest.raises(UnusableInput, match="others can read"):
        server_keys(engine_folder)
    path.chmod(0o600)
    path.write_text("no key")
    with pytest.raises(UnusableInput, match=r"server\.key_secret"):
        server_keys(engine_folder)


def test_engine_elsewhere_is_refused_until_a_viewer_is_authorised(
    viewer_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rig = read_rig(RIG)
    with pytest.raises(UnusableInput, match="authorised"):
        EngineHost(rig, "max", ELSEWHERE)
    assert running_engines() == []
    # What belongs to this computer does not count as a viewer elsewhere.
    authorise_own_viewer(viewer_folder)
    with pytest.raises(UnusableInput, match="authorised"):
        EngineHost(rig, "max", ELSEWHERE)
    public, _ = zmq.curve_keypair()
    key = authorised_folder(viewer_folder) / "colleague.key"
    key.write_text(f'metadata\ncurve\n    public-key = "{public.decode()}"\n')
    host = EngineHost(rig, "max", ELSEWHERE)
    try:
        client = attach(RIG)
        assert client.entry.commands.startswith("tcp://127.0.0.1:")
        assert client.entry.server_key == server_keys(viewer_folder).public.decode()
        assert client.request("status").result["state"] == "idle"
        client.close()
    finally:
        host.close()


def test_entry_of_an_engine_elsewhere_is_named_by_the_environment(
    entry: EngineEntry,
    viewer_folder: Path,
    engine_folder: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    import msgspec

    authorise(viewer_folder, engine_folder)
    path = tmp_path / "copied.json"
    monkeypatch.setenv("RIGAPP_ENGINE", str(path))
    with pytest.raises(UnusableInput, match=r"copied\.json"):
        attach(RIG)
    path.write_bytes(msgspec.json.encode(entry))
    client = attach(RIG)
    assert client.entry == entry
    client.close()


def test_engine_of_another_version_is_not_attached_to(
    viewer_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import os

    rig = str(RIG.resolve())
    announce(EngineEntry(os.getpid(), "ipc://a", "ipc://b", rig, 1.0, "", PROTOCOL_VERSION + 1))
    with pytest.raises(EngineUnreachable, match=f"version {PROTOCOL_VERSION + 1} of the protocol"):
        attach(RIG)


def test_address_in_use_is_told(engine_folder: Path) -> None:
    first = Server(Handler(), Rows(), "tcp://127.0.0.1:*", "tcp://127.0.0.1:*")
    try:
        with pytest.raises(UnusableInput, match=r"cannot listen at tcp://127\.0\.0\.1"):
            Server(Handler(), Rows(), first.commands, "tcp://127.0.0.1:*", engine_folder)
    finally:
        first.close()
