"""Each recipe of CONTRIBUTING.md works as it stands there, in no more files than it may."""

from __future__ import annotations

from pathlib import Path

import pytest
from house.recipes import TOP, copy_of_the_source, files, follow, headings, inside

EXAMPLES = TOP / "examples"
MOST_FILES = {
    "A driver": 2,
    "A joint technique": 2,
    "A stop criterion": 2,
    "A verb": 2,
}
"""What a change may cost; beyond it a list is written in one place too many."""

OF_ITS_OWN = ("A driver",)
"""Recipes that change nothing of the source."""


def test_no_recipe_touches_more_files_than_it_may() -> None:
    assert {title: len(files(title)) for title in headings()} == MOST_FILES


@pytest.fixture(scope="module")
def changed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a copy of the source in which all recipes were followed."""
    folder = copy_of_the_source(tmp_path_factory.mktemp("changed"))
    for title in MOST_FILES:
        if title not in OF_ITS_OWN:
            follow(title, folder)
    return folder


def run(folder: Path, code: str) -> str:
    """Run a few lines in a changed copy; return what they print."""
    done = inside(folder, "-c", code)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_a_technique_is_solved_predicted_and_named_by_the_help(changed: Path) -> None:
    where = ("--rpm", "30", "--clearance-mm", "0.5", "--to")
    for joint in ("fixed", "continuous"):
        asked = ("model", "forces", EXAMPLES / "parameters.toml", "--joint", joint, *where)
        done = inside(changed, "-m", "rigapp", *asked, f"{joint}.csv")
        assert done.returncode == 0, done.stderr
    assert (changed / "fixed.csv").read_text() == (changed / "continuous.csv").read_text()
    shown = inside(changed, "-m", "rigapp", "model", "wear", "--help").stdout
    assert "fixed" in shown


def test_a_criterion_ends_a_test_and_says_so(changed: Path) -> None:
    text = (EXAMPLES / "quick.toml").read_text("utf-8")
    text = text.replace('joint = "continuous"', 'joint = "fixed"')
    test = changed / "test.toml"
    test.write_text(text + "\n[stop]\nforce_rms_N = 5.0\nforce_revolutions = 3\n", "utf-8")
    where = ("--rig", EXAMPLES / "simulated.toml", "--out", changed / "t.h5", "--speed", "max")
    done = inside(changed, "-m", "rigapp", "run", test, *where)
    assert done.returncode == 1, done.stderr
    assert (
        "The RMS of |F| was at or above 5 N in 3 revolutions in a row" in done.stdout + done.stderr
    )


def test_a_verb_is_carried_out_for_who_may(changed: Path) -> None:
    said = run(
        changed,
        "from pathlib import Path\n"
        "from rigapp.config.loading import read_rig\n"
        "from rigapp.schema.messages import Request\n"
        "from rigapp.service.host import EngineHost\n"
        f"host = EngineHost(read_rig(Path({str(EXAMPLES / 'simulated.toml')!r})), 1.0)\n"
        "try:\n"
        "    heard = host.engine.subscribe()\n"
        "    print(host.handle(Request('oiled', {'reason': 'It squeaked.'}, operator='Ada')).ok)\n"
        "    print(host.handle(Request('oiled', {'reason': 1})).sentence)\n"
        "    print([(one.source, one.text) for one in heard.take().events])\n"
        "finally:\n"
        "    host.close()\n",
    )
    done, refused, events = said.splitlines()
    assert done == "True"
    assert "reason" in refused
    assert events == "[('Ada', 'The guide was oiled. It squeaked.')]"


def test_a_driver_is_found_and_reads(tmp_path: Path) -> None:
    package = tmp_path / "package"
    package.mkdir()
    follow("A driver", package)
    site = tmp_path / "site"
    install = ("-m", "pip", "install", "--no-deps", "--no-build-isolation", "--no-index", "--quiet")
    done = inside(package, *install, "--target", site, package)
    assert done.returncode == 0, done.stderr
    said = run(
        site,
        "import os, pty, threading, tty\n"
        "from drivers.api import SlowRequest\n"
        "from drivers.registry import load_driver\n"
        "device, port = pty.openpty()\n"
        "tty.setraw(device)\n"
        "def answer():\n"
        "    while os.read(device, 16):\n"
        "        os.write(device, b'21.5\\n')\n"
        "threading.Thread(target=answer, daemon=True).start()\n"
        "found = load_driver('line_thermometer')\n"
        "one = found.factory('room', os.ttyname(port), {})\n"
        "one.open()\n"
        "one.configure(SlowRequest(found.quantities))\n"
        "print(one.read())\n"
        "one.close()\n",
    )
    assert said.strip() == "{'temperature_C': 21.5}"
