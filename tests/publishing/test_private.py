"""What is private is found wherever it stands, said in one sentence, and refused."""

from __future__ import annotations

import zipfile
from collections.abc import Sequence
from pathlib import Path

import h5py
import pytest
from commandline import program, rigapp
from publishing_samples import ADA, RIG_TEXT, event, recorded

from rigapp.commands.files import package_tests
from rigapp.publishing.findings import RIG, Passage, found_in
from rigapp.publishing.package import private_in, published
from rigapp.storage import open_test
from rigapp_calibration.records import seal

ROOT = "/root"

NOBODY: frozenset[str] = frozenset()


def found(text: str, path: str = "/entry/notes", key: str = "") -> list[str]:
    return list(found_in(Passage("here", path, key, text), NOBODY, NOBODY))


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("ask ada.l+rig@example.org.", "the e-mail address ada.l+rig@example.org"),
        ('calibration = "/home/ada/cell.json"', "the home folder of ada (/home/ada)"),
        ("/Users/ada l/x", "the home folder of ada (/Users/ada)"),
        (r'path = "C:\\Users\\Ada\\x"', r"the home folder of Ada (C:\\Users\\Ada)"),
        (r"D:\Users\Ada\x", r"the home folder of Ada (D:\Users\Ada)"),
        ("on /media/ada/stick", "the home folder of ada (/media/ada)"),
        (f"in {ROOT}/cell.json", f"a path in the home folder of root ({ROOT})"),
        ('port = "192.168.0.17:502"', "the IP address 192.168.0.17"),
        ("reached at 10.0.0.1.", "the IP address 10.0.0.1"),
        ("tcp://[fe80::1:2]:5000", "the IP address fe80::1:2"),
        ('port = "socket://rig-pc:4001"', "the host name rig-pc"),
        ('port = "rfc2217://moxa.lab.example.org:4001"', "the host name moxa.lab.example.org"),
        ("see http://wiki/rig", "the host name wiki"),
        ("on lab7.local today", "the host name lab7.local"),
    ],
)
def test_each_kind_is_found(text: str, what: str) -> None:
    assert found(text) == [what]


@pytest.mark.parametrize(
    "text",
    [
        'port = "/dev/ttyUSB0"',
        "tcp://127.0.0.1:5000",
        "tcp://0.0.0.0:5000 and [::1] and ::",
        "socket://localhost:4001",
        "hwgrep://0403:6001",
        "https://creativecommons.org/licenses/by/4.0/ or https://doi.org/10.1000/1.2.3",
        "at 12:30:45 and 2027-01-15T08:00:00+00:00",
        "Linux-5.15.153.1-microsoft-standard-WSL2-x86_64",
        "matrix = [[200.0, 1.5], [-0.8, 199.2]]",
        "00:80:41:ae:fd:7e",
        "version 1.2.3 of analog_1.input_type",
        "the locals are friendly; local.time",
    ],
)
def test_what_looks_alike_is_left(text: str) -> None:
    assert found(text) == []


def test_four_numbers_of_a_version_are_no_address() -> None:
    assert found("4.1.34.0", key="firmware") == []


@pytest.mark.parametrize(
    ("key", "line", "secret"),
    [
        ("notify.url", 'url = "ntfys://{ntfy_token}@ntfy.sh/rig"', "ntfy_token"),
        ("ping.url", 'url = "{ping}"', "ping"),
        ("notify.command", 'command = ["lamp"]', ""),
    ],
)
def test_who_is_told_is_found_with_the_name_of_the_secret(key: str, line: str, secret: str) -> None:
    said = f", with the secret named {secret}" if secret else ""
    assert f"whom messages are sent to{said}" in found(line, RIG, key)


def test_known_computers_and_people_are_found_as_words() -> None:
    one = Passage("here", "", "", "Ann and Planner met Lab7 at lab77, by max force")
    said = list(found_in(one, frozenset({"lab7"}), frozenset({"Ann", "Max"})))
    assert said == ["the host name lab7", "the name of Ann, who is not among the authors"]


def sentences(path: Path, authors: Sequence[str] = (ADA,)) -> list[str]:
    return [one.sentence for one in private_in(published([path], authors, "CC-BY-4.0"), NOBODY)]


def test_a_test_that_has_ended_holds_nothing_private_of_itself(clean_file: Path) -> None:
    assert sentences(clean_file) == []


def test_an_interrupted_one_holds_the_computer_s_name(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("socket.gethostname", lambda: "lab7")
    path = recorded(folder / "t.h5", closed=False)
    assert sentences(path) == ["t.h5: /entry/state/writer holds the host name lab7."]
    whole = recorded(folder / "whole.h5")
    assert sentences(whole) == []


def test_a_line_of_the_rig_file_is_named_with_its_key(folder: Path) -> None:
    rig = RIG_TEXT + '\n[[notify]]\nname = "mail"\nurl = "{mail}"   # to ada@example.org\n'
    path = recorded(folder / "t.h5", rig=rig)
    where = "t.h5: rig file line 10 (notify.url) holds"
    assert sentences(path) == [
        f"{where} the e-mail address ada@example.org.",
        f"{where} whom messages are sent to, with the secret named mail.",
    ]


def test_events_are_named_by_their_number(folder: Path) -> None:
    events = [event("note", "Eve", "a squeak"), event("limit", "limits", "as eve@lab.org said")]
    path = recorded(folder / "t.h5", events=events)
    assert sentences(path) == [
        "t.h5: event 2 holds the name of Eve, who is not among the authors.",
        "t.h5: event 3 holds the e-mail address eve@lab.org.",
    ]
    assert sentences(path, ["Eve", ADA]) == ["t.h5: event 3 holds the e-mail address eve@lab.org."]


def test_many_places_of_one_finding_are_one_sentence(folder: Path) -> None:
    path = recorded(folder / "t.h5", events=[event("note", "Eve", "again")] * 20)
    (one,) = sentences(path)
    assert "event 2, event 3, event 4, event 5, event 6, event 7 and 14 more hold the name" in one


def test_an_operator_who_is_no_author_is_found_wherever_named(folder: Path) -> None:
    path = recorded(folder / "Bob 1.h5", operator="Bob")
    (one,) = sentences(path)
    assert one == (
        "Bob 1.h5: its name, /@file_name, /entry/user/name and event 1 hold the name of Bob,"
        " who is not among the authors."
    )
    assert sentences(path, []) == []


def test_people_of_a_calibration_are_found(folder: Path) -> None:
    content = {"kind": "load cell", "settings": {"paperwork": {"reviewer": "Grace Hopper"}}}
    path = recorded(folder / "t.h5")
    with h5py.File(path, "r+") as file:
        del file["/entry/calibration/record_load_cell/record"]
        file["/entry/calibration/record_load_cell/record"] = seal(content).decode()
    (one,) = sentences(path)
    assert "/record_load_cell/record (settings.paperwork.reviewer) holds the name of Grace" in one


def test_a_text_at_any_place_of_the_file_is_looked_at(folder: Path) -> None:
    path = recorded(folder / "t.h5")
    with h5py.File(path, "r+") as file:
        file["/entry/instrument"].attrs["made"] = "by eve@lab.org"
        file["/entry/instrument/more"] = ["10.1.2.3", "nothing"]
    assert sorted(sentences(path)) == [
        "t.h5: /entry/instrument/more holds the IP address 10.1.2.3.",
        "t.h5: /entry/instrument@made holds the e-mail address eve@lab.org.",
    ]


@pytest.mark.long
def test_the_verb_refuses_and_says_what_to_do(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(folder / "run"))
    path = recorded(folder / "t.h5", events=[event("note", "Eve", "a squeak")])
    before, to = path.read_bytes(), folder / "p.zip"
    asked = ("package", path, "--to", to)
    refused = rigapp(*asked)
    assert refused.returncode == 1
    assert "rigapp: t.h5: event 2 holds the name of Eve" in refused.stderr
    assert "--allow-private" in refused.stderr
    assert not to.exists()
    done = program(*asked, "--allow-private", "--author", ADA)
    assert done.returncode == 0, done.stderr
    assert "note: t.h5: event 2 holds the name of Eve" in done.stderr
    assert "by Ada Lovelace, CC-BY-4.0" in done.stdout
    assert path.read_bytes() == before
    with (
        zipfile.ZipFile(to) as archive,
        h5py.File(archive.open("t/t.h5")) as copy,
        open_test(path) as reader,
    ):
        packed = copy["/entry/revolutions/force_max"][:]
        assert packed.tolist() == reader.column("force_max").tolist() != []
    again = rigapp(*asked, "--allow-private")
    assert again.returncode == 2
    assert "not overwritten" in again.stderr


@pytest.mark.usefixtures("no_report")
def test_naming_people_as_authors_is_enough(folder: Path) -> None:
    path = recorded(folder / "t.h5", events=[event("note", "Eve Fox", "a squeak")])
    to = folder / "p.zip"
    assert package_tests([path], to, [ADA, "Fox, Eve"], "CC-BY-4.0", allow_private=False) == 0
