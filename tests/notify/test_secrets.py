"""Secrets come from a private file or the keyring, and go nowhere but to the server."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import keyring
import pytest
from receivers import Receiver

from rigapp.config.errors import UnusableInput
from rigapp.notify import delivery as attempt_module
from rigapp.notify.channels import attempt
from rigapp.notify.delivery import (
    AttemptRequest,
    attempted,
    filled,
    looked_up,
    read_secrets,
    redacted,
)

SECRET = "s3cret/p:ss@w?rd"  # noqa: S105 - of these tests


def secrets_file(folder: Path, mode: int = 0o600, text: str = f'password = "{SECRET}"\n') -> Path:
    path = folder / "secrets.toml"
    path.write_text(text, encoding="utf-8")
    path.chmod(mode)
    return path


def test_a_private_file_is_read(tmp_path: Path) -> None:
    assert looked_up(["password"], secrets_file(tmp_path)) == {"password": SECRET}


@pytest.mark.parametrize("mode", [0o644, 0o640, 0o604, 0o660])
def test_a_file_that_others_can_read_is_refused(tmp_path: Path, mode: int) -> None:
    with pytest.raises(UnusableInput, match=r"others can read it.*chmod 600"):
        read_secrets(secrets_file(tmp_path, mode))


@pytest.mark.parametrize("text", [f"password = {SECRET}", f'"{SECRET}', 'a = ""', "a = 5"])
def test_a_file_that_is_no_table_of_texts_is_refused_without_its_words(
    tmp_path: Path, text: str
) -> None:
    with pytest.raises(UnusableInput) as caught:
        read_secrets(secrets_file(tmp_path, text=text))
    assert SECRET not in str(caught.value)
    assert caught.value.__cause__ is None


def test_a_secret_that_is_nowhere_is_named_with_what_to_do(tmp_path: Path) -> None:
    with pytest.raises(
        UnusableInput, match=r"the secret token is not in .*keyring set rigapp token"
    ):
        looked_up(["token"], tmp_path / "none.toml")


def test_the_keyring_is_asked_for_what_the_file_lacks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[tuple[str, str]] = []

    def get_password(service: str, name: str) -> str:
        asked.append((service, name))
        return "from the keyring"

    monkeypatch.setattr(keyring, "get_password", get_password)
    found = looked_up(["password", "token"], secrets_file(tmp_path))
    assert found == {"password": SECRET, "token": "from the keyring"}
    assert asked == [("rigapp", "token")]


def test_a_secret_is_quoted_in_its_place_and_is_the_whole_url_as_it_stands() -> None:
    secrets = {"password": SECRET, "all": "tgram://1:a/2"}
    url = filled("mailtos://me:{password}@host", secrets)
    assert url == "mailtos://me:s3cret%2Fp%3Ass%40w%3Frd@host"
    assert filled("{all}", secrets) == "tgram://1:a/2"
    assert redacted(f"{url} failed, {SECRET}", [SECRET]) == "mailtos://me:***@host failed, ***"


@pytest.mark.sampled
@pytest.mark.parametrize(
    ("url", "good"),
    [
        ("json://127.0.0.1:8080/hook", True),
        ("jsons://me:{password}@127.0.0.1/hook", True),
        ("{whole}", True),
        ("mailto://127.0.0.1:25?from=a@example.org&to=b@example.org", True),
        ("discord://{webhook}/{token}", True),
        ("discord://4174216298/JHMHI8qBe7bk2ZwO5U711o3dV_js", False),
        ("tgram://123456789:abcdefg_hijklmnop/12315544", False),
    ],
)
def test_a_url_with_a_secret_of_its_own_is_refused(tmp_path: Path, url: str, good: bool) -> None:
    secrets = secrets_file(
        tmp_path,
        text=f'password = "{SECRET}"\nwhole = "tgram://123456789:abcdefg_hijklmnop/1"\n'
        'webhook = "4174216298"\ntoken = "JHMHI8qBe7bk2ZwO5U711o3dV_js"\n',
    )
    found = attempt(AttemptRequest("inspect", url, str(secrets)))
    assert found.ok is good, found.reason
    assert good or "write {NAME} in its place" in found.reason
    assert "JHMHI8" not in found.reason
    assert "abcdefg" not in found.reason


@pytest.mark.parametrize("answer", [200, 500, pytest.param(404, marks=pytest.mark.long)])
def test_a_secret_arrives_and_no_reason_repeats_it(
    tmp_path: Path, receiver: Receiver, answer: int
) -> None:
    receiver.answer = answer
    secrets = secrets_file(tmp_path, text='token = "topsecrettoken"\n')
    url = f"json://me:{{token}}@127.0.0.1:{receiver.port}/hook/{{token}}"
    found = attempt(AttemptRequest("send", url, str(secrets), "Title", "Text"))
    assert found.ok is (answer == 200)
    assert "topsecrettoken" not in found.reason
    if answer == 200:
        assert "/hook/topsecrettoken" in receiver.heads[0]
    else:
        assert str(answer) in found.reason


def test_what_a_library_raises_is_told_by_its_kind_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: Any) -> None:
        raise RuntimeError(f"cannot open https://me:{SECRET}@host")

    monkeypatch.setattr(attempt_module, "_by_apprise", fail)
    found = attempted(AttemptRequest("send", "json://{password}", str(secrets_file(tmp_path))))
    assert (found.ok, found.reason) == (False, "it failed ‹RuntimeError›")


def test_the_engine_and_its_notifier_never_load_what_knows_secrets() -> None:
    import subprocess

    code = (
        "import sys, rigapp.notify.notifier, rigapp.notify.link;"
        "sys.exit(bool({'apprise', 'keyring', 'requests'} & set(sys.modules)))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
