"""The number of revolutions of one test is the same in every place that shows it."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from stories import RIG, recipe

from rigapp.commands.files import print_info
from rigapp.commands.status import _lines, _state_words
from rigapp.config.loading import read_rig, read_test
from rigapp.engine.engine import Engine
from rigapp.gui.window.headline import NewestMeasured, headline
from rigapp.page.view import _tiles
from rigapp.presentation.results import origin_of
from rigapp.report.results import result_of
from rigapp.report.testreport.compose import report_of
from rigapp.schema.messages import RunState, Status
from rigapp.schema.notices import Finished
from rigapp.schema.states import ENDED
from rigapp.service.simulated import SimulatedDevices, parse_speed
from rigapp.storage import open_test
from rigapp.viewer.connection import ConnectionState
from rigapp.viewer.news import News
from tests.engine.engine_doubles import eventually

PLANNED = 5000


def live_figures(status: Status) -> dict[str, int]:
    """Return the revolutions that strip, page and terminal say are done."""
    head = headline(status, ConnectionState.ATTACHED, "", NewestMeasured())
    tile = next(one for one in _tiles(News(status)) if one.title == "Revolution")
    shown = {**status.tree(), **_state_words(status.tree()), "pid": 1, "rig_file": "rig.toml"}
    line = next(one for one in _lines(shown) if ": revolution " in one)
    texts = {"strip": head.cycle.value, "page": tile.value, "terminal": line.rpartition(": ")[2]}
    numbers = {
        place: re.findall(r"\d+", re.sub(r"(?<=\d)\W(?=\d)", "", text))
        for place, text in texts.items()
    }
    saved = {
        "strip, saved": re.findall(r"(\d+) saved", head.cycle.detail)[0],
        "terminal, safe": re.findall(r"(\d+) safe", line)[0],
    }
    done = {place: int(found[0]) for place, found in numbers.items()}
    assert set(done.values()) == {status.test.revolution}
    assert {int(one) for one in saved.values()} == {status.test.committed}
    return done


def ended_figures(path: Path, capsys: pytest.CaptureFixture[str]) -> dict[str, int]:
    """Return the revolutions that everything that reads the file says are in it."""
    result = result_of(path)
    print_info(path, as_json=True)
    info = json.loads(capsys.readouterr().out)
    with open_test(path) as test:
        rows, last = len(test.column("revolution")), int(test.column("revolution")[-1])
    card = re.findall(r"([\d\u202f]+) of", origin_of(result))[0]
    return {
        "rows": rows,
        "last row": last,
        "info": info["revolutions"],
        "info, last": info["last_revolution"],
        "result": result.revolutions,
        "card": int(card.replace("\u202f", "")),
        "report": in_report(path),
    }


def in_report(path: Path) -> int:
    """Return the number of revolutions in the summary of the report."""
    text = repr(report_of(path, False)).replace("\\u202f", "").replace("\u202f", "")
    (found,) = set(re.findall(r"(\d+) of \d+ planned", text))
    return int(found)


@pytest.mark.parametrize("end", [pytest.param("stop", marks=pytest.mark.long), "trip"])
def test_every_place_shows_the_same_number_of_revolutions(
    end: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = RIG.read_text("utf-8")
    rig_file = tmp_path / "rig.toml"
    # Nothing here is about the watchdog, and a busy computer may be late by more than 0.5 s.
    rig_file.write_text(text.replace("watchdog_timeout_s = 0.5", "watchdog_timeout_s = 20.0"))
    rig, test = read_rig(rig_file), read_test(recipe(tmp_path, PLANNED, twin=False))
    devices = SimulatedDevices(rig, parse_speed("5", rig))
    path = tmp_path / "t.h5"
    try:
        engine = Engine(rig, ports=devices.ports(test.record.model))
        engine.connect()
        notices = engine.watch()
        engine.start(test, path, operator="Ada")
        engine.wait({RunState.RUNNING}, 60.0)
        eventually(lambda: engine.status().test.revolution >= 3)
        live_figures(engine.status())
        if end == "stop":
            engine.stop("Ada")
        else:
            engine.set_limit("overload_N", 20.0, "Ada", "to trip")
        engine.wait(ENDED, 60.0)
        status = engine.status()
        done = live_figures(status)
        finished = None
        while (notice := notices.get(0.0)) is not None:
            finished = notice if isinstance(notice, Finished) else finished
        engine.shutdown()
    finally:
        devices.close()
    assert finished is not None
    found = {**done, "finished": finished.revolutions, **ended_figures(path, capsys)}
    assert set(found.values()) == {status.test.committed}, found
    assert status.test.outcome is not None
