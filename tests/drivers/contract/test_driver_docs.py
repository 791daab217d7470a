"""docs/drivers.md tells the settings as they are, and its example is the one that runs."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from rigapp.testing.contracts import Contract, read_contracts
from rigapp_drivers.registry import available_drivers, load_driver

pytestmark = pytest.mark.rigapp_contract

ROOT = Path(__file__).parents[3]
PAGE = (ROOT / "docs" / "drivers.md").read_text("utf-8")


def test_every_setting_of_a_shipped_driver_is_in_its_table() -> None:
    for name in available_drivers():
        info = load_driver(name)
        if not info.factory.__module__.startswith("rigapp_drivers."):
            continue
        section = PAGE.split(f"### `{name}`", 1)[1].split("\n#", 1)[0]
        rows = dict(re.findall(r"^\| `(\w+)` \| (.*)$", section, re.MULTILINE))
        assert set(rows) == set(info.settings), name
        for key, spec in info.settings.items():
            default, told = rows[key].split(" |", 1)
            assert spec.sentence in told, f"{name}.{key}"
            assert default == _shown(spec.default), f"{name}.{key}"


def _shown(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return f'"{value}"'
    return str(value)


def test_the_snippet_is_a_part_of_the_example() -> None:
    source = (ROOT / "examples" / "driver_example" / "simple_adc.py").read_text("utf-8")
    snippet = PAGE.split("### The example", 1)[1].split("```python\n", 1)[1].split("```", 1)[0]
    code = "".join(f"    {line}" if line.strip() else line for line in snippet.splitlines(True))
    assert code in source


def test_every_driver_tells_how_it_is_recognised(contract: Contract) -> None:
    assert contract.info.probe is not None
    if contract.info.factory.__module__.startswith("rigapp_drivers."):
        assert f"| `{contract.info.name}` |" in PAGE.split("## Finding devices", 1)[1]


def test_every_shipped_driver_with_a_simulator_is_in_the_contract() -> None:
    shipped = {
        name
        for name in available_drivers()
        if (info := load_driver(name)).simulator is not None
        and info.factory.__module__.startswith("rigapp_drivers.")
    }
    assert shipped == {one.info.name for one in read_contracts()}


def test_a_contract_for_a_driver_that_is_not_there_is_refused(tmp_path: Path) -> None:
    table = tmp_path / "contract.toml"
    table.write_text("[driver.nobody]\n", "utf-8")
    with pytest.raises(ValueError, match="no such driver is installed: nobody"):
        read_contracts([table])
