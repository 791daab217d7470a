"""The page on engines that are served for real: what it shows, and that it only looks."""

from __future__ import annotations

import json
import os
import random
import re
import select
import selectors
import shutil
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Callable
from contextlib import ExitStack, suppress
from importlib import resources
from pathlib import Path

import pytest
from page.doubles import OpenPage, ServedEngine, eventually, heard
from patience import PATIENCE_S
from snapshots import ALARM, write_recorded

from rigapp.page import access, serving
from rigapp.schema.messages import HowEnded, RunState

Serve = Callable[..., ServedEngine]
Show = Callable[..., OpenPage]

ATTACHED = "the engine speaks"


def test_state_tiles_plots_alarms_and_notes_of_a_test_are_shown(
    rig: Path, serve: Serve, show: Show, tmp_path: Path
) -> None:
    file = tmp_path / "quick-20270101-080000.h5"
    write_recorded(file)
    serve(rig, file=str(file), alarms=(ALARM,))
    page = show([rig])
    page.shows("oil added")
    page.shows("Force over the crank angle, revolution 1233")
    _, headers, text = page.get("/")
    for word in ("running", "The paper&#39;s wear test", "Force is high", "|F| maximum"):
        assert word in text
    for title in ("|F| maximum", "Wear depth", "Measured − model"):
        assert f"<figcaption>{title}" in text
    assert 'class="ribbon first"' in text, "the measured depth has its band"
    assert headers["content-security-policy"].startswith("default-src 'none'; script-src 'self';")
    assert "unsafe" not in headers["content-security-policy"]


def test_the_page_says_state_and_next_step_as_the_window_does(
    rig: Path, serve: Serve, show: Show
) -> None:
    resting = {"resting": True, "rest_left_s": 11.2, "step": 3, "steps": 5}
    served = serve(rig, state=RunState.PAUSED, **resting)
    page = show([rig])
    page.shows("Resting, 12 s left, step 3 of 5. The test resumes by itself.")
    assert '<span class="state paused">Resting</span>' in page.get("/")[2]
    served.say(state=RunState.STOPPED, resting=False, reason="as asked", outcome=HowEnded.OPERATOR)
    page.shows("Stopped: as asked")
    served.say(outcome=HowEnded.COMPLETE)
    page.shows("Complete: as asked")
    (one,) = page.rigs()
    assert (one["state"], one["state_word"]) == ("stopped", "Complete")
    served.say(state=RunState.RUNNING, reason="", outcome=None, alarms=(ALARM,))
    page.shows(f"Running. {ALARM.title}: {ALARM.cause}")


def test_words_of_an_engine_are_never_elements_of_the_page(
    rig: Path, serve: Serve, show: Show
) -> None:
    serve(rig, test="<script>alert(1)</script>", reason="<img src=x onerror=alert(1)>")
    page = show([rig])
    page.shows("&lt;script&gt;alert(1)")
    assert "<script>alert" not in page.get("/")[2]
    assert "<img" not in page.get("/")[2]


def test_every_asset_comes_from_this_program() -> None:
    folder = resources.files("rigapp.page")
    texts = [
        one.read_text("utf-8")
        for name in ("assets", "templates")
        for one in (folder / name).iterdir()
    ]
    addresses = [found for text in texts for found in re.findall(r"\w+://[^\"' ]+", text)]
    assert set(addresses) <= {"http://www.w3.org/2000/svg"}, "a name of a format, never fetched"


def test_two_rigs_stand_on_one_page_and_one_that_starts_later_joins(
    rig: Path, serve: Serve, show: Show
) -> None:
    second = Path(shutil.copy(rig, rig.with_name("right.toml")))
    serve(rig, alarms=(ALARM,))
    page = show([])
    page.sees(
        lambda rigs: [one["name"] for one in rigs if one["line"] == "attached"] == ["left"], "one"
    )
    serve(second)
    page.sees(lambda rigs: {one["name"] for one in rigs} == {"left", "right"}, "two rigs")
    page.sees(lambda rigs: all(one["line"] == "attached" for one in rigs), "both speak")
    text = page.get("/")[2]
    assert 'data-rigs="rig1 rig2"' in text
    assert [len(one["alarms"]) for one in page.rigs()] == [1, 0]


def test_an_engine_that_is_started_anew_is_shown_again_and_said(
    rig: Path, serve: Serve, show: Show
) -> None:
    first = serve(rig)
    page = show([rig])
    page.sees(lambda rigs: rigs and rigs[0]["line"] == "attached", ATTACHED)
    assert "started anew" not in page.get("/")[2]
    first.close()
    page.shows("What is shown is old")
    page.sees(lambda rigs: rigs[0]["line"] == "lost", "the engine is missed")
    serve(rig, test="Another test")
    page.shows("Another test")
    page.shows("The engine was started anew")
    assert page.rigs()[0]["restarts"] == 1


def test_a_page_without_an_engine_says_so(rig: Path, show: Show) -> None:
    page = show([])
    page.shows("No engine runs here")
    named = show([rig])
    named.shows("no engine runs for left.toml")


def test_many_pages_are_one_viewer_that_asks_nothing(
    rig: Path, serve: Serve, show: Show, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Small enough that a page that does not read is behind within seconds.
    monkeypatch.setattr(serving, "SEND_BYTES", 4096)
    monkeypatch.setattr(serving, "READ_S", 2.0)
    engine = serve(rig, in_command="Ann")
    page = show([rig])
    page.sees(lambda rigs: rigs and rigs[0]["line"] == "attached", ATTACHED)
    with Audience(page, 40) as audience:
        deaf = [page.open_events(receive_bytes=2048) for _ in range(10)]
        eventually(lambda: all(map(hung_up, deaf)), "whoever does not read is dropped")
        audience.hears_a_beat()
        assert engine.viewers == 1
        for line in deaf:
            line.close()
    assert engine.requests == [], "whoever asks nothing commands nothing"
    eventually(
        lambda: "rigapp_page_readers 0.0" in page.get("/metrics")[2], "every page is let go of"
    )


class Audience:
    """Pages that read, and come back when they are dropped, as browsers do."""

    def __init__(self, page: OpenPage, size: int) -> None:
        self._page, self._size = page, size
        self._beats = [0] * size
        self._leave = threading.Event()
        self._thread = threading.Thread(target=self._read, name="audience")

    def __enter__(self) -> Audience:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._leave.set()
        self._thread.join(PATIENCE_S)

    def hears_a_beat(self) -> None:
        """Wait until each page has heard of the server once more."""
        before = list(self._beats)
        eventually(
            lambda: all(now > then for now, then in zip(self._beats, before, strict=True)),
            "every page that reads is told the news",
        )

    def _read(self) -> None:
        with selectors.DefaultSelector() as selector:
            for number in range(self._size):
                selector.register(self._page.open_events(), selectors.EVENT_READ, number)
            while not self._leave.is_set():
                for key, _ in selector.select(0.1):
                    self._take(selector, key)
            for key in list(selector.get_map().values()):
                key.fileobj.close()  # type: ignore[union-attr]

    def _take(self, selector: selectors.BaseSelector, key: selectors.SelectorKey) -> None:
        line = key.fileobj
        assert isinstance(line, socket.socket)
        try:
            got = line.recv(1 << 16)
        except ConnectionResetError:
            got = b""
        self._beats[key.data] += got.count(b"event: beat")
        if not got:
            selector.unregister(line)
            line.close()
            selector.register(self._page.open_events(), selectors.EVENT_READ, key.data)


def hung_up(line: socket.socket) -> bool:
    """Tell whether the other end has given a connection up, without reading from it."""
    poll = select.poll()
    poll.register(line, 0)
    return bool(poll.poll(0))


def test_a_page_that_was_away_gets_the_newest_and_not_what_it_missed(
    rig: Path, serve: Serve, show: Show
) -> None:
    engine = serve(rig, reason="the first word")
    page = show([rig])
    page.shows("the first word")
    for number in range(20):
        engine.say(reason=f"word {number}")
    page.shows("word 19")
    line = page.open_events()
    first = heard(line, b"event: beat")
    assert first.count(b'"place":"rig1-head"') == 1
    assert b"word 19" in first
    line.close()


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE"])
def test_nothing_but_looking_is_possible(rig: Path, show: Show, method: str) -> None:
    page = show([rig])
    status, headers, _ = page.get("/api/status", method)
    assert status == 405
    assert headers["allow"] == "GET, HEAD"


def test_too_much_is_refused_by_what_is_too_much(rig: Path, show: Show) -> None:
    page = show([rig])
    assert page.get("/", **{f"x-{n}": "1" for n in range(70)})[0] == 431
    assert page.get("/", x="1" * 20_000)[0] in (400, 431)
    assert page.get("/" + "a" * 2000)[0] == 414
    assert page.get("/", **{"Content-Length": "5"})[0] == 413
    assert page.get("/", **{"Transfer-Encoding": "chunked"})[0] == 413
    assert page.get("/", Host="elsewhere.example")[0] == 421
    assert page.get("/nothing")[0] == 404
    assert page.get("/assets/..%2f..%2fserving.py")[0] == 404
    assert page.get("/", "HEAD")[0] == 200
    assert page.get("/events", "HEAD")[0] == 200


def test_connections_are_bounded(rig: Path, show: Show, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(access, "MOST_CONNECTIONS", 8)
    monkeypatch.setattr(serving, "REQUEST_S", 2.0)
    page = show([rig])
    with ExitStack() as at_the_end:
        held = []
        for _ in range(30):
            with suppress(ConnectionResetError):  # one too many, closed before it was open here
                line = socket.create_connection(("127.0.0.1", page.port), PATIENCE_S)
                held.append(at_the_end.enter_context(line))
        assert len(held) >= access.MOST_CONNECTIONS
        for line in held[::2]:
            with suppress(ConnectionError):  # closed already: one too many
                line.sendall(b"GET / HTTP/1.1\r\nHost: loc")
        for line in held:
            assert closed(line), "one too many at once, one that says nothing in time"
    assert page.get("/healthz")[0] == 200


def closed(line: socket.socket) -> bool:
    """Tell whether the other end closes a connection, without an answer."""
    try:
        return line.recv(1) == b""
    except ConnectionResetError:
        return True


SEEDS = (
    b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n",
    b"GET /api/status HTTP/1.1\r\nHost: localhost\r\nContent-Length: 3\r\n\r\nabc",
    b"GET /events HTTP/1.0\r\n\r\n",
    b"POST / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n0\r\n",
    b"GET /metrics HTTP/1.1\r\nHost: localhost\r\nAuthorization: Basic %%%\r\n\r\n",
    b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03",
    b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
)


def malformed(source: random.Random) -> bytes:
    """Return a request that no browser sends: never a whole one that is well formed."""
    text = bytearray(source.choice(SEEDS))
    for _ in range(source.randint(1, 6)):
        place = source.randrange(len(text) + 1)
        match source.randrange(4):
            case 0:
                text[place : place + 1] = source.randbytes(1)
            case 1:
                del text[place : place + source.randint(1, 9)]
            case 2:
                text[place:place] = source.randbytes(source.randint(1, 40))
            case _:
                text[place:place] = b"\x00" * source.randint(1, 4)
    # A line that no grammar of HTTP has: what else was changed cannot make it right again.
    text[0:0] = source.choice((b"\x00", b"G\xff T ", b"GET\t/ ", b"get / http ", b" "))
    return bytes(text)


def answer_to(port: int, request: bytes) -> bytes:
    """Send a request, say that no more comes, return the answer."""
    with socket.create_connection(("127.0.0.1", port), PATIENCE_S) as line:
        try:
            line.sendall(request)
            line.shutdown(socket.SHUT_WR)
            answer = b""
            while more := line.recv(65536):
                answer += more
        except (ConnectionResetError, BrokenPipeError):
            return b""
        return answer


def ask_wrongly(page: OpenPage, count: int) -> None:
    """Send malformed requests; each is refused or dropped, and the page stays alive."""
    source = random.Random(15)
    for number in range(count):
        request = malformed(source)
        answer = answer_to(page.port, request)
        assert re.match(rb"HTTP/1\.1 4\d\d |$", answer), (number, request, answer[:200])
    assert page.get("/healthz")[2] == "ok\n"


def test_no_malformed_request_is_answered_wrongly(rig: Path, serve: Serve, show: Show) -> None:
    engine = serve(rig)
    page = show([rig])
    page.sees(lambda rigs: rigs and rigs[0]["line"] == "attached", ATTACHED)
    ask_wrongly(page, 500)
    assert page.rigs()[0]["line"] == "attached"
    assert engine.requests == []


@pytest.mark.soak
@pytest.mark.timeout(7200)
def test_a_hundred_thousand_malformed_requests_leave_the_page_alive(
    rig: Path, serve: Serve, show: Show
) -> None:
    engine = serve(rig)
    page = show([rig])
    page.sees(lambda rigs: rigs and rigs[0]["line"] == "attached", ATTACHED)
    ask_wrongly(page, 100_000)
    assert page.rigs()[0]["line"] == "attached"
    assert engine.requests == []


class Running:
    """`rigapp page` as a program."""

    def __init__(self, *arguments: str) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-m", "rigapp", "page", *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def close(self) -> None:
        """End it whatever it does."""
        self.process.kill()
        self.process.communicate()


@pytest.mark.sampled
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM"])
def test_the_program_says_its_address_and_ends_when_asked(
    rig: Path, running: Callable[..., Running], name: str
) -> None:
    one = running("--rig", str(rig), "--bind", "127.0.0.1:0")
    assert one.process.stdout is not None
    line = one.process.stdout.readline()
    port = int(re.fullmatch(r"The page is at http://127\.0\.0\.1:(\d+)/\n", line)[1])  # type: ignore[index]
    with socket.create_connection(("127.0.0.1", port), PATIENCE_S) as stream:
        stream.sendall(b"GET /events HTTP/1.1\r\nHost: localhost\r\n\r\n")
        heard(stream, b"event: beat")
        os.kill(one.process.pid, getattr(signal, name))
        _, words = one.process.communicate(timeout=PATIENCE_S)
    assert one.process.returncode == 0
    assert words in ("", "rigapp: WARNING: No engine: no engine runs for left.toml\n")


def test_the_status_is_json_without_numbers_that_are_none(
    rig: Path, serve: Serve, show: Show
) -> None:
    serve(rig)
    page = show([rig])
    page.sees(lambda rigs: rigs and rigs[0]["line"] == "attached", ATTACHED)
    text = page.get("/api/status")[2]
    shown = json.loads(text, parse_constant=lambda word: pytest.fail(f"{word} is no JSON"))["rigs"]
    assert shown[0]["state"] == "running"
    assert shown[0]["values"]["force_max"] > 50.0
    assert shown[0]["process"]["pid"] > 0
