"""Before a test goes on: what is there, what differs, what needs a reason, what refuses."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest
from msgspec import structs
from stories import NEVER_OVER, RIG, end_soon, log, numbers, recipe, summary, until

from rigapp.config.channels import channel_table
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, parse_rig, read_rig
from rigapp.config.rig import ChannelSection, RigFile
from rigapp.engine.recording.store import calibration_record
from rigapp.engine.values.calibrate import Calibration, calibration_of
from rigapp.schema.loglines import RestSignals
from rigapp.schema.messages import Reply, Request, RunState
from rigapp.schema.states import ENDED, Refused
from rigapp.service.host import EngineHost, read_test
from rigapp.service.resumption import Fit, Past, Resumption, compare, remarks
from rigapp.service.simulated import parse_speed
from rigapp.storage import open_test
from rigapp_drivers.api import ChannelSpec, StreamSetup

INPUTS = ("analog_1", "analog_2", "analog_3", "analog_4", "analog_5")


def calibration(rig: RigFile) -> Calibration:
    channels = [ChannelSpec(name, "mV/V" if name < "analog_3" else "V") for name in INPUTS]
    return calibration_of(rig, StreamSetup((*channels, ChannelSpec("counter_1", "count")), 960, {}))


@pytest.fixture
def rig() -> RigFile:
    return parse_rig(RIG.read_text(encoding="utf-8"), "rig.toml")


@pytest.fixture
def past(rig: RigFile) -> Past:
    return Past(
        path=Path("t.h5"),
        summary={"status": "interrupted", "reason": "", "revolutions": 9, "last_revolution": 9},
        title="Test",
        planned=100,
        last_at=1000.0,
        calibration={**calibration_record(calibration(rig)), "device_daq": {"filter_Hz": 100.0}},
        rig=rig,
        channels=channel_table(rig),
        rest=RestSignals(0.1, 0.0, crank_angle_deg=359.0),
        new_position_um=(500.0, 0.0),
        worn=None,
    )


def judged(past: Past, rig: RigFile, **changes: Any) -> Resumption:
    arguments: dict[str, Any] = {
        "calibration": calibration(rig),
        "devices": {"daq": {"filter_Hz": 100.0}},
        "rest": RestSignals(0.1, 0.0, crank_angle_deg=2.0),
        "blocking": {},
        "now": 1000.0 + 3 * 86400.0,
    }
    return compare(past, rig, **{**arguments, **changes})


def fits(found: Resumption) -> dict[str, Fit]:
    return {one.what: one.fit for one in found.findings if one.fit is not Fit.GOOD}


def test_the_same_rig_goes_on_and_the_time_between_is_told(past: Past, rig: RigFile) -> None:
    found = judged(past, rig)
    assert fits(found) == {}
    (first, *others) = remarks(found, "Ada", "")
    assert others == []
    assert first.who == "Ada"
    assert "resuming after 3.0 days; the test was interrupted" in first.text


def test_other_devices_and_another_encoder_refuse_even_with_a_reason(
    past: Past, rig: RigFile
) -> None:
    other = structs.replace(
        rig,
        devices={**rig.devices, "drive": structs.replace(rig.devices["drive"], driver="cia402")},
        encoder=structs.replace(rig.encoder, direction=-1),
    )
    found = judged(past, other)
    assert fits(found) == {"Drive": Fit.BLOCKS, "Encoder": Fit.BLOCKS}
    with pytest.raises(Refused, match="made with a roboclaw, this rig has a cia402"):
        remarks(found, "Ada", "it will do")
    real = structs.replace(rig.devices["drive"], port="/dev/ttyACM0")
    mixed = structs.replace(rig, devices={**rig.devices, "drive": real})
    found = judged(past, mixed)
    assert fits(found) == {"Kind of device": Fit.BLOCKS}
    with pytest.raises(Refused, match="Drive: simulated in the test, real in this rig"):
        remarks(found, "Ada", "it will do")
    leftover = structs.replace(rig, simulation=None)
    assert fits(judged(past, leftover)) == {}
    expired = judged(past, rig, blocking={"load_cell": "the record 7 expired"})
    assert expired.blocked.startswith("the record 7 expired. Calibrate again")


@pytest.mark.parametrize(
    ("section", "change", "what"),
    [
        ("load_cell", {"matrix_N_per_mV_per_V": ((201.0, 0.0), (0.0, 200.0))}, "load cell"),
        ("load_cell", {"latency_ms": (2.0, 1.0)}, "load cell"),
        ("probes", {"sensitivity_um_per_V": (100.0, 101.0)}, "probes"),
    ],
)
def test_another_calibration_needs_a_reason_that_is_recorded(
    past: Past, rig: RigFile, section: str, change: dict[str, Any], what: str
) -> None:
    other = structs.replace(rig, **{section: structs.replace(getattr(rig, section), **change)})
    found = judged(past, other)
    assert fits(found) == {f"Calibration of the {what}": Fit.REASON}
    with pytest.raises(Refused, match=f"{what} is not that of the test"):
        remarks(found, "Ada", " ")
    with pytest.raises(Refused, match="the reason has 2,001 characters; shorten it to 2,000"):
        remarks(found, "Ada", "r" * 2001)
    (_, changed) = remarks(found, "Ada", "calibrated on Monday")
    assert changed.text.endswith("accepted: calibrated on Monday")
    assert changed.before != changed.after
    assert next(iter(change)) in changed.before


@pytest.mark.parametrize(
    ("zero", "rest", "tare", "what"),
    [
        ((0.0, 0.0), (0.1, 0.035), (0.0, 0.0), None),
        ((0.0, 0.0), (0.1, 0.045), (0.0, 0.0), "Load cell at rest"),
        ((0.03, -0.03), (0.1, 0.0), (0.0, 0.0), "Zero of the load cell"),
        ((0.0, 0.0), (0.1, 0.0), (0.05, 0.0), "Zero of the load cell"),
        ((0.0, 0.0), (math.nan, 0.0), (0.0, 0.0), "Load cell at rest"),
    ],
)
def test_a_zero_beyond_the_share_needs_a_reason(
    past: Past,
    rig: RigFile,
    zero: tuple[float, float],
    rest: tuple[float, float],
    tare: tuple[float, float],
    what: str | None,
) -> None:
    """400 N full scale, 200 N per mV/V: 2 % are 0.04 mV/V."""
    cell = structs.replace(rig.load_cell, zero_mV_per_V=zero)
    present = calibration(structs.replace(rig, load_cell=cell)).with_tare(tare)
    seen = RestSignals(*rest, crank_angle_deg=2.0)
    found = judged(past, rig, calibration=present, rest=seen)
    needed = {k for k, fit in fits(found).items() if fit is Fit.REASON}
    assert needed - {"Calibration of the load cell"} == ({what} if what else set())


@pytest.mark.parametrize(("then", "now"), [(359.0, 5.0), (359.0, None), (None, 2.0), (None, None)])
def test_a_load_at_rest_is_compared_at_the_same_crank_angle_alone(
    past: Past, rig: RigFile, then: float | None, now: float | None
) -> None:
    """A spring presses by 118 N more at the other dead centre: no reason is to be given for it."""
    before = RestSignals(0.1, 0.0, crank_angle_deg=then)
    found = judged(
        replace(past, rest=before), rig, rest=RestSignals(-0.49, 0.0, crank_angle_deg=now)
    )
    assert fits(found) == {"Load cell at rest": Fit.NOTED}
    assert not found.asks_reason
    (_, noted) = remarks(found, "Ada", "")
    assert "not compared" in noted.text
    assert noted.before == ("crank angle not known" if then is None else "crank at 359 deg")


def test_another_clock_of_the_samples_refuses(past: Past, rig: RigFile) -> None:
    acquisition = {**past.calibration["acquisition"], "clock": "encoder"}
    other = replace(past, calibration={**past.calibration, "acquisition": acquisition})
    found = judged(other, rig)
    assert fits(found) == {"Sample clock": Fit.BLOCKS}
    assert "sampled by encoder" in found.blocked


def test_what_an_older_program_did_not_write_counts_as_zeros(past: Past, rig: RigFile) -> None:
    cell = {k: v for k, v in past.calibration["load_cell"].items() if k != "bend_per_N"}
    older = replace(past, calibration={**past.calibration, "load_cell": cell})
    assert fits(judged(older, rig)) == {}
    bent = {**cell, "bend_per_N": [[1e-5, 0.0, 0.0], [0.0, 0.0, 0.0]], "more": [0.5]}
    other = judged(replace(past, calibration={**past.calibration, "load_cell": bent}), rig)
    assert "(bend_per_N, more)" in other.asks_reason


def test_tables_in_a_calibration_are_compared_key_by_key(past: Past, rig: RigFile) -> None:
    probes = {**past.calibration["probes"], "latency_ms": {"a": [1.0, 2.0]}}
    other = replace(past, calibration={**past.calibration, "probes": probes})
    assert fits(judged(other, rig)) == {"Calibration of the probes": Fit.REASON}


def test_what_cannot_be_compared_is_noted(past: Past, rig: RigFile) -> None:
    found = judged(past, rig, rest=None, devices={"daq": {"filter_Hz": 50.0}})
    assert fits(found) == {"Load cell at rest": Fit.NOTED, "Settings of daq": Fit.NOTED}
    assert [one.before for one in remarks(found, "", "")][1:] == ["filter_Hz 100.0", ""]
    unread = judged(replace(past, rig=None, rest=None), rig)
    assert set(fits(unread)) == {"Rig", "Load cell at rest"}


# --- a whole story on the simulated rig -----------------------------------------------------------


@pytest.fixture
def host(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[EngineHost]:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    document = read_rig(RIG)
    host = EngineHost(document, parse_speed("max", document))
    yield host
    host.close()


def ask(host: EngineHost, verb: str, **arguments: Any) -> Reply:
    return host.handle(Request(verb=verb, arguments=arguments, operator="Ada"))


@pytest.mark.long
def test_a_stopped_test_goes_on_with_its_own_bushing(
    host: EngineHost, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "t.h5"
    test = read_test(recipe(tmp_path, NEVER_OVER, twin=True, every=1000))
    host.connect(test.record)
    zeroed = host.engine.zero(operator="Ada", reason="as the daily check says")["load_cell"]
    assert math.hypot(*zeroed) > 0.01
    host.start(test, out, "Ada", resume=False)
    until(lambda: host.engine.status().test.committed >= 60, "60 revolutions are safe")
    host.engine.stop("Ada", "until Monday")
    host.engine.wait(ENDED, 60.0)
    stopped_at = int(numbers(out)[-1])
    # a fresh simulated rig, and a cell that was calibrated again since
    host.engine.shutdown()
    host.simulated.close()
    text = host.records.rig.text
    cell = structs.replace(
        host.records.rig.record.load_cell, matrix_N_per_mV_per_V=((202.0, 0.0), (0.0, 200.0))
    )
    other = structs.replace(host.records.rig.record, load_cell=cell)
    host.records = replace(host.records, rig=Document(RIG, text, other))
    host.engine._core.rig = host.records.rig

    looked = ask(host, "examine_file", file=str(out))
    assert looked.ok, looked.sentence
    assert looked.result["last_revolution"] == stopped_at
    asked = [one for one in looked.result["findings"] if one["fit"] == "needs a reason"]
    assert [one["what"] for one in asked] == ["Calibration of the load cell"]
    assert host.engine.state is RunState.READY
    refused = ask(host, "resume_file", file=str(out))
    assert not refused.ok
    assert "needs a reason because" in refused.sentence
    done = ask(host, "resume_file", file=str(out), reason="new certificate")
    assert done.ok, done.sentence
    assert host.engine._connection is not None
    assert host.engine._connection.rig.processor.calibration.load_cell.tare == pytest.approx(zeroed)
    planned = end_soon(RIG)
    host.engine.wait(ENDED, 90.0)

    assert summary(out)["status"] == "complete"
    assert np.array_equal(numbers(out), np.arange(1, planned + 1))
    told = [one for one in log(out) if one.kind == "resumed"]
    assert "until Monday" in told[0].text
    assert told[1].text.endswith("accepted: new certificate")
    assert "202" in told[1].after
    assert len([one for one in log(out) if one.kind == "rest"]) == 2
    with open_test(out) as reader:
        way = np.hypot(reader.column("probe_1_mean"), reader.column("probe_2_mean"))
    before = way[stopped_at - 6 : stopped_at - 1].mean()
    after = way[stopped_at + 2 : stopped_at + 7].mean()
    # The pin has moved by wear less what the approach falls by; a new bushing would be back there.
    assert before - way[3:8].mean() > 1.0
    # The cell was zeroed under the spring's load, so that the forces tell little of the approach.
    assert abs(after - before) < 1.5
    with pytest.raises(UnusableInput, match="complete"):
        host.start(test, out, "Ada", resume=True)


def test_other_channels_than_those_of_the_file(past: Past, rig: RigFile) -> None:
    """One that is gone blocks, one that is new is noted, another line needs a reason."""
    free = ChannelSection(device="daq", input="analog_5", unit="degC", scale=100.0)
    warm = msgspec.structs.replace(rig, channels={"bushing": free})
    noted = judged(past, warm, calibration=calibration(warm))
    assert fits(noted) == {"Channel bushing": Fit.NOTED}
    kept = {**calibration_record(calibration(warm)), "device_daq": {"filter_Hz": 100.0}}
    before = replace(past, channels=channel_table(warm), calibration=kept)
    blocked = judged(before, rig)
    assert fits(blocked) == {"Channels": Fit.BLOCKS}
    assert "the file keeps bushing" in blocked.blocked
    other = {"bushing": msgspec.structs.replace(free, scale=99.0)}
    changed = msgspec.structs.replace(rig, channels=other)
    asked = judged(before, changed, calibration=calibration(changed))
    assert fits(asked) == {"Line of bushing": Fit.REASON}
    assert not fits(judged(before, warm, calibration=calibration(warm)))
