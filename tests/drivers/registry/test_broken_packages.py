"""A package that fails to load, whatever it raises, is one sentence that names it."""

from __future__ import annotations

import dataclasses
import itertools
import sys
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest

from rigapp_drivers import registry
from rigapp_drivers.api import DeviceError, DriverFailed, DriverInfo, DriverKind, Probe
from rigapp_drivers.discovery import ask
from rigapp_drivers.edge import make_driver

RAISES = {
    "ImportError": "import no_such_package_at_all",
    "SyntaxError": "def broken(:",
    "ValueError": "raise ValueError('two\\nlines')",
    "struct.error": "import struct; struct.unpack('<i', b'')",
    "RuntimeError": "raise RuntimeError('no licence')",
    "SystemExit": "import sys; sys.exit('needs Windows')",
    "CancelledError": "import asyncio; raise asyncio.CancelledError",
    "AttributeError": "import os; os.no_such_name",
}
NUMBERS = itertools.count()


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """A module of its own for each test, found like that of an installed package."""
    name = f"acme_driver_{next(NUMBERS)}"
    monkeypatch.syspath_prepend(tmp_path)
    entry = EntryPoint(name="acme", value=f"{name}:DRIVER", group=registry.GROUP)
    monkeypatch.setattr(registry, "entry_points", lambda group: (entry,))
    yield_path = tmp_path / f"{name}.py"
    yield_path.write_text("")
    return name


@pytest.mark.parametrize("words", RAISES.values(), ids=RAISES.keys())
def test_a_driver_whose_import_fails(package: str, tmp_path: Path, words: str) -> None:
    (tmp_path / f"{package}.py").write_text(words)
    with pytest.raises(registry.DriverBroken) as caught:
        registry.load_driver("acme")
    sentence = str(caught.value)
    assert 'The driver "acme"' in sentence
    assert f"reinstall or update the package {package}." in sentence
    assert "\n" not in sentence
    assert caught.value.__cause__ is not None


@pytest.mark.parametrize("words", RAISES.values(), ids=RAISES.keys())
def test_a_simulator_whose_import_fails(package: str, tmp_path: Path, words: str) -> None:
    (tmp_path / f"{package}.py").write_text(words)
    with pytest.raises(registry.DriverBroken) as caught:
        registry.load_simulator(dataclasses.replace(INFO, simulator=f"{package}:Simulator"))
    assert 'The simulator of driver "acme"' in str(caught.value)
    assert f"the package {package}." in str(caught.value)


INFO = DriverInfo("acme", "Acme box", DriverKind.SLOW_SOURCE, lambda *made: None)  # type: ignore[arg-type,return-value]


def test_the_package_is_named_as_it_was_installed() -> None:
    assert registry.package_of("gsv8") == "rigapp"
    assert registry.package_of("no such driver") == "no such driver"
    assert registry.package_of("acme") not in sys.modules


@pytest.mark.parametrize("error", [KeyError("x"), SystemExit(2)], ids=["KeyError", "SystemExit"])
def test_a_question_that_fails_does_not_end_the_search(
    error: BaseException, unused_line: str
) -> None:
    def asks(line: object, timeout_s: float) -> None:
        raise error

    infos = [dataclasses.replace(INFO, title=title, probe=Probe(asks)) for title in ("one", "two")]
    inquiry = ask(unused_line, infos, 0.01)
    assert inquiry.tried == ("one", "two")
    assert inquiry.problem.count("its driver acme failed while it was identified") == 2


@pytest.fixture
def unused_line() -> str:
    return "loop://"


def test_a_driver_that_cannot_be_made_names_device_and_port() -> None:
    def fails(name: str, port: str, settings: object) -> None:
        sys.exit("no licence")

    with pytest.raises(DriverFailed) as caught:
        make_driver(dataclasses.replace(INFO, factory=fails), "box", "/dev/ttyX", {})  # type: ignore[arg-type]
    assert isinstance(caught.value, DeviceError)
    assert (caught.value.device, caught.value.port) == ("box", "/dev/ttyX")
    assert isinstance(caught.value.__cause__, SystemExit)
