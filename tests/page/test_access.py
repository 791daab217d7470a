"""Who may ask: loopback freely, elsewhere with a token and TLS only; what is refused, and how."""

from __future__ import annotations

import subprocess
import sys
from base64 import b64encode
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from page.doubles import TOKEN, OpenPage

from rigapp.config.errors import UnusableInput
from rigapp.page.access import Access, access_to


def refused(*given: Any) -> str:
    with pytest.raises(UnusableInput) as caught:
        access_to(*given)
    return str(caught.value)


def test_loopback_is_free_and_elsewhere_takes_a_token_and_tls(
    token: Path, pair: tuple[Path, Path]
) -> None:
    assert access_to("127.0.0.1:0", None, None, None).loopback
    assert access_to("[::1]:8750", None, None, None).address == "::1"
    assert access_to("localhost:8750", None, None, None).loopback
    for given in ((None, None, None), (token, None, None), (None, *pair)):
        assert "only with a token and over TLS" in refused("192.168.1.20:8750", *given)
    assert not access_to("192.168.1.20:8750", token, *pair).loopback


@pytest.mark.parametrize(
    ("bind", "words"),
    [
        ("8750", "give ADDRESS:PORT"),
        ("127.0.0.1:70000", "give ADDRESS:PORT"),
        ("0.0.0.0:8750", "name the address of one interface"),
        ("[::]:8750", "name the address of one interface"),
        ("rig.example:8750", "is not an IP address"),
    ],
)
def test_an_address_that_is_none_is_refused_by_its_words(bind: str, words: str) -> None:
    assert words in refused(bind, None, None, None)


def test_a_token_is_a_file_that_its_owner_alone_can_read(tmp_path: Path, token: Path) -> None:
    token.chmod(0o640)
    assert "others can read" in refused("127.0.0.1:0", token, None, None)
    token.chmod(0o600)
    link = tmp_path / "link"
    link.symlink_to(token)
    assert "a link is not followed" in refused("127.0.0.1:0", link, None, None)
    token.write_text("too short")
    sentence = refused("127.0.0.1:0", token, None, None)
    assert "at least 24" in sentence
    assert "too short" not in sentence, "what stands in it is said to nobody"


def test_certificate_and_key_belong_together_and_the_key_is_private(
    tmp_path: Path, pair: tuple[Path, Path]
) -> None:
    certificate, key = pair
    assert "give both" in refused("127.0.0.1:0", None, certificate, None)
    other = tmp_path / "other.key"
    other.touch(mode=0o600)
    assert "cannot be used" in refused("127.0.0.1:0", None, certificate, other)
    key.chmod(0o644)
    assert "others can read" in refused("127.0.0.1:0", None, certificate, key)


def scope(*headers: tuple[bytes, bytes]) -> dict[str, Any]:
    return {"method": "GET", "raw_path": b"/", "query_string": b"", "headers": list(headers)}


@pytest.mark.parametrize(
    "shown",
    [
        f"Bearer {TOKEN}".encode(),
        f"bearer {TOKEN}".encode(),
        b"Basic " + b64encode(f"anybody:{TOKEN}".encode()),
        b"Basic " + b64encode(f":{TOKEN}".encode()),
    ],
)
def test_the_token_opens_as_bearer_and_as_password(shown: bytes) -> None:
    access = Access("10.0.0.1", 1, loopback=False, token=TOKEN.encode())
    assert access.refusal(scope((b"authorization", shown))) is None


@pytest.mark.parametrize(
    "shown",
    [
        b"",
        b"Bearer",
        b"Bearer ",
        f"Bearer {TOKEN[:-1]}".encode(),
        f"Bearer {TOKEN} ".encode(),
        f"Digest {TOKEN}".encode(),
        b"Basic " + b64encode(TOKEN.encode()),
        b"Basic \xff\xfe",
        b"Basic ====",
    ],
)
def test_nothing_else_opens(shown: bytes) -> None:
    access = Access("10.0.0.1", 1, loopback=False, token=TOKEN.encode())
    refusal = access.refusal(scope((b"authorization", shown)))
    assert refusal is not None
    assert refusal.status == 401
    assert TOKEN not in refusal.sentence


@pytest.mark.parametrize("host", [b"localhost", b"127.0.0.1:8750", b"[::1]:1", b"LOCALHOST:80"])
def test_a_loopback_page_answers_to_its_own_names(host: bytes) -> None:
    assert Access("127.0.0.1", 1, loopback=True).refusal(scope((b"host", host))) is None


@pytest.mark.parametrize("host", [b"rebound.example", b"127.0.0.1.example", b"localhost.example:1"])
def test_a_loopback_page_answers_to_no_name_of_elsewhere(host: bytes) -> None:
    refusal = Access("127.0.0.1", 1, loopback=True).refusal(scope((b"host", host)))
    assert refusal is not None
    assert refusal.status == 421


def test_over_tls_every_path_asks_for_the_token(
    rig: Path, token: Path, pair: tuple[Path, Path], show: Callable[..., OpenPage]
) -> None:
    page = show([rig], "127.0.0.1:0", token, *pair)
    assert page.server.address.startswith("https://")
    for path in ("/", "/api/status", "/events", "/metrics", "/healthz", "/assets/page.js"):
        status, headers, _ = page.get(path)
        assert status == 401, path
        assert headers["www-authenticate"].startswith("Basic ")
    assert page.get("/healthz", Authorization=f"Bearer {TOKEN}")[2] == "ok\n"


def test_the_program_refuses_to_be_open_to_others(rig: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "rigapp", "page", "--rig", str(rig), "--bind", "192.0.2.1:8750"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert "only with a token and over TLS" in done.stderr
