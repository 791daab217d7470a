"""PINs for limits: hashed, wanted by the rig file alone, slow to guess."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, read_rig
from rigapp.config.rig import OperatorsSection, RigFile
from rigapp.schema.messages import Request
from rigapp.schema.states import Refused
from rigapp.service.host import EngineHost
from rigapp.service.pins import PinCheck, fits, pins_in, set_pin

RIG = Path(__file__).parents[2] / "examples" / "simulated.toml"


def rig_with_pins(folder: Path) -> Document[RigFile]:
    """Return the simulated rig with a file of operators in a folder."""
    document = read_rig(RIG)
    record = msgspec.structs.replace(document.record, operators=OperatorsSection("operators.toml"))
    return Document(folder / "rig.toml", document.text, record)


def test_a_pin_is_kept_as_a_salted_hash_alone(tmp_path: Path) -> None:
    file = tmp_path / "operators.toml"
    set_pin(file, "Ada", "2718", "")
    set_pin(file, "Ben", "2718", "2718")
    pins = pins_in(file)
    assert set(pins) == {"Ada", "Ben"}
    assert pins["Ada"] != pins["Ben"]
    assert "2718" not in {part for kept in pins.values() for part in kept.split(":")}
    assert file.stat().st_mode & 0o077 == 0
    assert fits("2718", pins["Ada"])
    assert not fits("2719", pins["Ada"])


@pytest.mark.parametrize("kept", ["", "2718", "md5:1:1:1:00:00", "scrypt:2:8:1:00:00", "scrypt:x"])
def test_another_form_of_hash_fits_no_pin(kept: str) -> None:
    assert not fits("2718", kept)
    assert not fits("", kept)


def test_a_pin_is_set_by_somebody_who_has_one(tmp_path: Path) -> None:
    file = tmp_path / "operators.toml"
    set_pin(file, "Ada", "2718", "")
    for name, pin, by_pin, why in (
        ("Ben", "1234", "", "operator who has one"),
        ("Ben", "1234", "1234", "operator who has one"),
        ("Ben", "123", "2718", "4 characters"),
        (" ", "1234", "2718", "name"),
    ):
        with pytest.raises(UnusableInput, match=why):
            set_pin(file, name, pin, by_pin)
    assert set(pins_in(file)) == {"Ada"}


def test_wrong_pins_wait_longer_each_time(tmp_path: Path) -> None:
    set_pin(tmp_path / "operators.toml", "Ada", "2718", "")
    now = [0.0]
    check = PinCheck(rig_with_pins(tmp_path), lambda: now[0])
    for _ in range(3):
        with pytest.raises(Refused, match="not the PIN of Ada"):
            check.check("Ada", "0000")
    with pytest.raises(Refused, match="2 s"):
        check.check("Ada", "2718")  # right, but too soon
    now[0] += 2.1
    with pytest.raises(Refused, match="not the PIN"):
        check.check("Ada", "0000")
    with pytest.raises(Refused, match="4 s"):
        check.check("Ada", "2718")
    now[0] += 4.1
    check.check("Ada", "2718")
    with pytest.raises(Refused, match="Ben has no PIN"):
        check.check("Ben", "2718")


def test_a_rig_file_without_operators_wants_no_pin() -> None:
    check = PinCheck(read_rig(RIG))
    assert not check.wanted
    check.check("anybody", "")


def test_the_engine_changes_no_limit_without_the_pin(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    set_pin(tmp_path / "operators.toml", "Ada", "2718", "")
    host = EngineHost(rig_with_pins(tmp_path), 20.0)
    try:
        assert host.with_service(host.engine.status()).rig.limits_need_pin

        def ask(verb: str, pin: str, **arguments: object) -> str:
            asked = {**arguments, "reason": "more", "pin": pin}
            return host.handle(Request(verb=verb, arguments=asked, operator="Ada")).sentence

        for verb, arguments in (
            ("set_limit", {"name": "overload_N", "value": 90.0}),
            ("extend", {"revolutions": 900}),
        ):
            assert "not the PIN of Ada" in ask(verb, "0000", **arguments)
            # With the PIN it is the engine that refuses: no test is under way.
            assert "PIN" not in ask(verb, "2718", **arguments)
    finally:
        host.close()
