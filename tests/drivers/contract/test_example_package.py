"""A driver of another package appears and keeps the contract, without a change in the program."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
EXAMPLE = ROOT / "examples" / "driver_example"


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Mapping[str, str]:
    """Build and install the example package beside the program; return the environment."""
    folder = tmp_path_factory.mktemp("third_party")
    source = folder / "source"
    shutil.copytree(EXAMPLE, source)
    site = folder / "site"
    options = ["--no-deps", "--no-build-isolation", "--no-index", "--quiet", "--target", str(site)]
    pip = [sys.executable, "-m", "pip", "install", "--disable-pip-version-check"]
    done = run(pip + options + [str(source)])
    assert done.returncode == 0, done.stderr
    path = os.pathsep.join([str(site), os.environ.get("PYTHONPATH", "")]).strip(os.pathsep)
    return {**os.environ, "PYTHONPATH": path}


def run(
    command: list[str], environment: Mapping[str, str] | None = None
) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        command,
        env=environment,
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=500,
        check=False,
    )


def test_it_is_listed_beside_the_shipped_drivers(installed: Mapping[str, str]) -> None:
    script = (
        "from rigapp_drivers.registry import *\n"
        "info = load_driver('simple_adc')\n"
        "print(available_drivers(), info.title, load_simulator(info).__name__)\n"
        "print(check_settings(info, {'block_s': 0.1}, 'rig'))\n"
    )
    done = run([sys.executable, "-c", script], installed)
    assert done.returncode == 0, done.stderr
    assert "'simple_adc'" in done.stdout
    assert "'gsv8'" in done.stdout
    assert "Acme SimpleADC (imaginary) SimpleAdcSimulator" in done.stdout
    assert "'block_s': 0.1" in done.stdout


@pytest.mark.long
def test_it_keeps_the_contract_of_data_sources(installed: Mapping[str, str]) -> None:
    suite = ["--pyargs", "rigapp.testing", "--rigapp-contract", str(EXAMPLE / "contract.toml")]
    options = ["-q", "-p", "no:cacheprovider", "-p", "rigapp.testing.plugin", "-k", "simple_adc"]
    done = run([sys.executable, "-m", "pytest", *options, *suite], installed)
    assert done.returncode == 0, done.stdout
    summary = done.stdout.strip().splitlines()[-1]
    passed = int(summary.split(" passed")[0].split()[-1])
    assert passed >= 11, "three life cycles, six faults of the wire, discovery"
    assert "failed" not in summary
