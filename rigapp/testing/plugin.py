"""pytest plug-in: run every test of the suite with every driver to which it applies."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from rigapp.testing.bench import SlowBench, SourceBench, SpindleBench
from rigapp.testing.contracts import Contract, read_contracts
from rigapp_drivers.api import DriverInfo, DriverKind

OPTION = "--rigapp-contract"
MARK = "rigapp_contract"
BENCHES = {
    DriverKind.DATA_SOURCE: SourceBench,
    DriverKind.SPINDLE: SpindleBench,
    DriverKind.SLOW_SOURCE: SlowBench,
}
ARGUMENTS = {
    "source": (DriverKind.DATA_SOURCE, False),
    "source_fault": (DriverKind.DATA_SOURCE, True),
    "spindle": (DriverKind.SPINDLE, False),
    "spindle_fault": (DriverKind.SPINDLE, True),
    "slow": (DriverKind.SLOW_SOURCE, False),
    "slow_fault": (DriverKind.SLOW_SOURCE, True),
    "contract": (None, False),
}
"""Arguments of the suite's tests: drivers of a kind, or each with each of its faults."""
CONTRACTS = pytest.StashKey[list[Contract]]()


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option for contract tables of other packages."""
    parser.addoption(
        OPTION,
        action="append",
        default=[],
        type=Path,
        metavar="CONTRACT.toml",
        help="table of a driver that rigapp does not ship: settings, inputs, faults; repeatable",
    )


def pytest_configure(config: pytest.Config) -> None:
    """Register the marks of the suite's tests."""
    config.addinivalue_line("markers", f"{MARK}: runs on every driver that a contract names")
    config.addinivalue_line("markers", "sampled: rigapp's default suite runs a part of its cases")


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Parametrise a test of the suite with drivers, or with drivers and their faults."""
    if metafunc.definition.get_closest_marker(MARK) is None:
        return
    contracts = _contracts(metafunc.config)
    requested = {name: ARGUMENTS[name] for name in ARGUMENTS if name in metafunc.fixturenames}
    for argument, (kind, with_faults) in requested.items():
        chosen = [contract for contract in contracts if kind in (None, contract.info.kind)]
        if with_faults:
            pairs = [(contract, fault) for contract in chosen for fault in contract.faults]
            ids = [f"{contract.info.name}-{fault.name}" for contract, fault in pairs]
            metafunc.parametrize(argument, pairs, ids=ids)
        else:
            metafunc.parametrize(argument, chosen, ids=[contract.info.name for contract in chosen])


def _contracts(config: pytest.Config) -> list[Contract]:
    # Cached: every test of the suite needs them, and each reading scans all installed packages.
    contracts = config.stash.get(CONTRACTS, None)
    if contracts is None:
        try:
            contracts = read_contracts(config.getoption(OPTION))
        except (OSError, ValueError) as error:
            raise pytest.UsageError(f"{OPTION}: {error}") from error
        config.stash[CONTRACTS] = contracts
    return contracts


@pytest.fixture
def known_drivers(pytestconfig: pytest.Config) -> tuple[DriverInfo, ...]:
    """Return the drivers of all contracts."""
    return tuple(contract.info for contract in _contracts(pytestconfig))


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Callable[..., Any]]:
    """Return the factory of benches, ``bench(contract, **settings)``; closes all at the end."""
    made: list[Any] = []

    def make(contract: Contract, **settings: Any) -> Any:
        kind = BENCHES[contract.info.kind]
        made.append(kind(contract, tmp_path / f"port{len(made)}", settings))
        return made[-1]

    yield make
    for bench in made:
        bench.close()
