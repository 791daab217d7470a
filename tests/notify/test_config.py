"""A way that cannot be used is refused by a sentence that repeats no secret."""

from __future__ import annotations

from pathlib import Path

import pytest

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_document, read_rig
from rigapp.config.notify import NotifyFile

EXAMPLES = Path(__file__).parents[2] / "examples"
DOCS = Path(__file__).parents[2] / "docs"


@pytest.mark.parametrize(
    ("lines", "words"),
    [
        ('when = ["end"]', "notify 1 needs either url or command"),
        ('url = "json://a"\ncommand = ["b"]', "notify 1 needs either url or command"),
        ('url = "mailtos://me:hidden@example.org"', "notify 1 url holds a password; write {NAME}"),
        ('url = "hidden"', "notify 1 url begins with no scheme"),
        ('url = "json://a"\nwhen = []', "notify 1 when is empty; choose of critical"),
        ('url = "json://a"\nwhen = ["sometimes"]', "allowed are critical, warning, end"),
        ('url = "json://a"\ndaily_at = "7 am"', "is no time of the day; write it as 07:00"),
        ('url = "json://a"\nmost_per_hour = 0', "is outside 1 to 1000 messages"),
        ('url = "json://a"\nsilent_after_s = 1.0', "is outside 5 to 86400 s"),
        ('url = "json://a"\nevery_s = 5', "every_s is not a known key"),
        ('url = "json://a"\nname = "x\\u0007"', "control character"),
        ('command = [" "]', "notify 1 the command names no program"),
        ('url = "json://a"\n[ping]\nurl = "ftp://hidden"', "ping.url begins neither with http://"),
        ('url = "json://a"\n[ping]\nurl = "http://a:hidden@b"', "ping.url holds a password"),
    ],
)
def test_what_is_wrong_is_said_with_its_key(tmp_path: Path, lines: str, words: str) -> None:
    path = tmp_path / "notify.toml"
    path.write_text(f"schema = 1\n[[notify]]\n{lines}\n", "utf-8")
    with pytest.raises(UnusableInput) as caught:
        read_document(path, NotifyFile)
    assert words in str(caught.value)
    assert "hidden" not in str(caught.value)


def test_a_rig_file_takes_ways_and_judges_them(tmp_path: Path) -> None:
    path = tmp_path / "rig.toml"
    text = (EXAMPLES / "simulated.toml").read_text("utf-8")
    path.write_text(f'{text}\n[[notify]]\nurl = "json://127.0.0.1:8080/hook"\n', "utf-8")
    assert read_rig(path).record.notify[0].when == ("critical", "end", "pause", "silence", "disk")
    path.write_text(f"{text}\n[[notify]]\nnear_percent = 5\n", "utf-8")
    with pytest.raises(UnusableInput, match="notify 1 needs either url or command"):
        read_rig(path)


def test_the_example_can_be_read() -> None:
    found = read_document(EXAMPLES / "notify.toml", NotifyFile).record
    assert len(found.notify) >= 2
    assert found.ping is not None


def test_every_key_stands_in_the_manual() -> None:
    from rigapp.config.notify import NotifySection, PingSection

    manual = (DOCS / "rig.md").read_text("utf-8")
    for key in (*NotifySection.__struct_fields__, *PingSection.__struct_fields__):
        assert f"`{key}`" in manual, key
