"""Let the contract suite share its bench, and run every test on every driver it is about."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

sys.path.insert(0, str(Path(__file__).parent))

import contract_bench
from contract_table import Contract, read_contracts

from drivers.api import DriverKind


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Give a test the drivers, or the drivers with their faults, that its argument names."""
    wanted = {
        "source": (DriverKind.DATA_SOURCE, False),
        "source_fault": (DriverKind.DATA_SOURCE, True),
        "spindle": (DriverKind.SPINDLE, False),
        "spindle_fault": (DriverKind.SPINDLE, True),
        "slow": (DriverKind.SLOW_SOURCE, False),
        "slow_fault": (DriverKind.SLOW_SOURCE, True),
        "contract": (None, False),
    }
    for argument, (kind, faults) in wanted.items():
        if argument not in metafunc.fixturenames:
            continue
        contracts = [c for c in read_contracts() if kind in (None, c.info.kind)]
        if faults:
            pairs = [(c, fault) for c in contracts for fault in c.faults]
            ids = [f"{c.info.name}-{fault.name}" for c, fault in pairs]
            metafunc.parametrize(argument, pairs, ids=ids)
        else:
            metafunc.parametrize(argument, contracts, ids=[c.info.name for c in contracts])


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Callable[..., Any]]:
    """Make benches: ``bench(contract, **settings)``; all are closed at the end."""
    made: list[Any] = []

    def make(contract: Contract, **settings: Any) -> Any:
        kinds = {
            DriverKind.DATA_SOURCE: contract_bench.SourceBench,
            DriverKind.SPINDLE: contract_bench.SpindleBench,
            DriverKind.SLOW_SOURCE: contract_bench.SlowBench,
        }
        one = kinds[contract.info.kind](contract, tmp_path / f"port{len(made)}", settings)
        made.append(one)
        return one

    yield make
    for one in made:
        one.close()
