"""Lines are recorded for a report of an error; what is packed tells much and nothing private."""

from __future__ import annotations

import json
import time
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from patience import PATIENCE_S
from stories import until

from rigapp.commands.status import shown
from rigapp.config.loading import read_rig, read_test
from rigapp.process import logs
from rigapp.publishing.private import without_private
from rigapp.schema.messages import Reply, Request, RunState
from rigapp.service.host import EngineHost
from rigapp.testing.traces import check_trace
from rigapp_drivers.wire.trace import RecordKind, read_trace

EXAMPLES = Path(__file__).parents[2] / "examples"
OPERATOR = "Wilhelmine Musterfrau"
COMPUTER = "musterstadt-lab-7"  # a short name would occur in the bytes of a line by chance
SECRETS = (
    OPERATOR, "Musterfrau", COMPUTER, "hooks.example.org", "T0P-S3CRET",
    "wilhelmine@example.org", "/home/musterfrau", "Ask Wilhelmine", "192.0.2.7",
)  # fmt: skip
PRIVATE = """
# Ask Wilhelmine before you change this.
[[notify]]
name = "Wilhelmine"
command = ["true", "/home/musterfrau", "wilhelmine@example.org", "T0P-S3CRET"]
when = ["critical"]
"""


@pytest.fixture
def host(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[EngineHost]:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    monkeypatch.setattr("socket.gethostname", lambda: COMPUTER)
    rig = tmp_path / "rig.toml"
    rig.write_text((EXAMPLES / "simulated.toml").read_text("utf-8") + PRIVATE, "utf-8")
    host = EngineHost(read_rig(rig), 1.0)
    yield host
    host.close()


def ask(host: EngineHost, verb: str, **arguments: object) -> Reply:
    return host.handle(Request(verb=verb, arguments=arguments, operator=OPERATOR, client="c"))


def members(package: Path) -> dict[str, bytes]:
    with zipfile.ZipFile(package) as opened:
        return {name: opened.read(name) for name in opened.namelist()}


def said_in(package: Path) -> str:
    """Return all bytes of a package, the texts of its recordings decoded, as one text."""
    return "\n".join(data.decode("utf-8", "replace") for data in members(package).values())


def test_a_report_has_the_set_up_of_the_devices_and_nothing_private(
    host: EngineHost, tmp_path: Path
) -> None:
    file = tmp_path / "reports" / "a.zip"
    reply = ask(host, "report_begin", file=str(file), reconnect=True)
    assert reply.ok, reply.sentence
    assert "daq, drive" in reply.sentence
    ask(host, "note", text="wilhelmine@example.org called from 192.0.2.7")
    host.engine.log("device", f"{OPERATOR} at http://hooks.example.org/T0P-S3CRET", OPERATOR)
    logger = logs.logging.getLogger("rigapp.test")
    logger.info("%s on %s said: /home/musterfrau/labor.key", OPERATOR, COMPUTER)
    drive = host.reports._folder / "drive.wire"
    until(lambda: drive.exists() and len(read_trace(drive).records) > 30, "the drive is polled")
    assert ask(host, "report_end").ok
    found = members(file)
    assert set(found) == {
        "report.txt", "rig.toml", "status.json", "versions.json", "log.txt", "daq.wire",
        "drive.wire",
    }  # fmt: skip
    told = said_in(file)
    for secret in SECRETS:
        assert secret.casefold() not in told.casefold(), secret
    assert "[name] on [name] said: [home]/labor.key" in found["log.txt"].decode()
    rig = tmp_path / "packed.toml"
    rig.write_bytes(found["rig.toml"])
    assert read_rig(rig).record.devices.keys() == {"daq", "drive"}
    assert json.loads(found["versions.json"])["pyserial"]
    serial_numbers = [one["identity"] for one in json.loads(found["status.json"])["devices"]]
    assert any("20123456" in one for one in serial_numbers)
    for device in ("daq", "drive"):
        path = tmp_path / f"{device}.wire"
        path.write_bytes(found[f"{device}.wire"])
        trace = read_trace(path)
        assert not trace.problem
        kinds = {one.kind for one in trace.records}
        assert kinds == set(RecordKind), "sent, received, and who answered"
        assert len(list(shown(trace))) > 10
    check_trace(tmp_path / "drive.wire")


@pytest.mark.long
def test_one_device_in_a_test_is_recorded_until_it_is_ended(
    host: EngineHost, tmp_path: Path
) -> None:
    file = tmp_path / "b.zip"
    document = read_test(EXAMPLES / "quick.toml")
    host.start(document, tmp_path / "t.h5", OPERATOR, resume=False)
    host.engine.wait((RunState.RUNNING,), PATIENCE_S)
    assert ask(host, "report_begin", file=str(file), devices=["drive"]).ok
    again = ask(host, "report_begin", file=str(tmp_path / "c.zip"))
    assert "being recorded already" in again.sentence
    time.sleep(0.5)
    assert host.engine.state is RunState.RUNNING
    assert host.snapshot().status.engine.line_report is not None
    ended = ask(host, "report_end")
    assert ended.ok, ended.sentence
    assert ended.result == str(file)
    assert host.engine.state is RunState.RUNNING
    found = members(file)
    assert "drive.wire" in found
    assert "daq.wire" not in found
    path = tmp_path / "drive.wire"
    path.write_bytes(found["drive.wire"])
    polled = [one for one in read_trace(path).records if one.kind is RecordKind.SENT]
    assert len(polled) >= 2
    assert OPERATOR not in said_in(file)
    assert "t.h5" not in found["status.json"].decode()
    assert not ask(host, "report_end").ok
    timed = tmp_path / "timed.zip"
    assert ask(host, "report_begin", file=str(timed), duration_s=0.2).ok
    until(lambda: host.reports.shown and host.reports.shown.sentence, "its time is up")
    assert {"daq.wire", "drive.wire"} <= set(members(timed))


def test_what_cannot_be_written_or_is_not_there_is_refused(
    host: EngineHost, tmp_path: Path
) -> None:
    (tmp_path / "there.zip").write_text("mine")
    for words, arguments in (
        ("is not overwritten", {"file": str(tmp_path / "there.zip")}),
        ("there is no device", {"file": str(tmp_path / "d.zip"), "devices": ["oil"]}),
        ("with the ending .zip", {"file": str(tmp_path / "d.toml")}),
        ("full path", {"file": "d.zip"}),
    ):
        reply = ask(host, "report_begin", **arguments)
        assert not reply.ok
        assert words in reply.sentence
    assert host.reports.shown is None


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("on /dev/serial/by-id/usb-ME_GSV-8_20123456", None),
        ("socket://127.0.0.1:4711 and wire://daq.wire stay", None),
        ("socket://moxa.lab.example:4001 goes", "socket://[address] goes"),
        ("firmware 1.56, 24 V, -7.4 A", None),
        ("C:\\Users\\ada\\rig.toml", "[home]\\rig.toml"),
        ("ADA turned Adam's crank", "[name] turned Adam's crank"),
    ],
)
def test_what_is_private_goes_and_what_matters_stays(text: str, expected: str | None) -> None:
    assert without_private(text, ["Ada"]) == (text if expected is None else expected)
