"""Any value of a record may be wrong: it is used, or refused by a sentence, never an accident."""

from __future__ import annotations

import contextlib
import io
import json
import random
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from rigapp.calibrating.certificate import write_certificate
from rigapp.calibrating.records_in_use import with_records
from rigapp.commands.calibrate import show_trend
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp_calibration.records import EVALUATION, seal
from tests.calibration.pinned import FOLDER

RIG = (Path(__file__).parents[2] / "examples" / "simulated.toml").read_text()
NAMED = {
    "load_cell": 'calibration = "record.json"\n[probes]',
    "probe": '[probes]\ncalibration = ["record.json", "record.json"]',
    "probes": '[probes]\ncalibration = "record.json"',
    "run_out": '[probes]\nrun_out = "record.json"',
    "channel": "[probes]",
    "running_check": "[probes]",
}
"""By kind of record: what names it in a rig file in the place of [probes]."""
WRONG = (None, "x", -1, [], {}, True, 1e308, ...)
"""What a careless or hostile hand may write; the last one takes the key out."""


def places_in(value: Any, before: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Yield the way to every value, of a list to the first one only."""
    inner = value.items() if isinstance(value, dict) else enumerate(value[:1])
    for key, one in inner:
        yield (*before, key)
        if isinstance(one, dict | list):
            yield from places_in(one, (*before, key))


def with_value(content: dict[str, Any], way: tuple[Any, ...], value: Any) -> bytes:
    content = json.loads(json.dumps(content))
    inner: Any = content
    for key in way[:-1]:
        inner = inner[key]
    if value is ...:
        del inner[way[-1]]
    else:
        inner[way[-1]] = value
    return seal(content)


def try_each(folder: Path, kind: str, share: float) -> None:
    """Put wrong values in a share of the places; the record is used and printed, or refused."""
    sealed = json.loads((FOLDER / str(EVALUATION) / f"{kind}.json").read_text())
    content = {key: sealed[key] for key in sealed if key not in ("digest", "number", "schema")}
    rig, record, page = folder / "rig.toml", folder / "record.json", folder / "c.html"
    rig.write_text(RIG.replace("[probes]", NAMED[kind]))
    (folder / "former.json").write_bytes(seal(content))
    choose = random.Random(kind)
    for way in places_in(content):
        for value in WRONG:
            if choose.random() > share:
                continue
            record.write_bytes(with_value(content, way, value))
            with contextlib.suppress(UnusableInput):
                with_records(read_rig(rig))
            page.unlink(missing_ok=True)
            with contextlib.suppress(UnusableInput):
                write_certificate(record, page)
            with contextlib.suppress(UnusableInput), contextlib.redirect_stdout(io.StringIO()):
                show_trend(folder, None, as_json=False)


@pytest.mark.filterwarnings("ignore:.*:RuntimeWarning")  # sums of 1e308 overflow
@pytest.mark.parametrize("kind", NAMED)
def test_a_wrong_value_is_refused_by_a_sentence(tmp_path: Path, kind: str) -> None:
    try_each(tmp_path, kind, 0.004)


@pytest.mark.long
@pytest.mark.timeout(1200)
@pytest.mark.filterwarnings("ignore:.*:RuntimeWarning")
@pytest.mark.parametrize("kind", NAMED)
def test_every_wrong_value_is_refused_by_a_sentence(tmp_path: Path, kind: str) -> None:
    try_each(tmp_path, kind, 1.0)


@pytest.mark.parametrize("kind", NAMED)
def test_the_record_without_a_wrong_value_is_used(tmp_path: Path, kind: str) -> None:
    data = (FOLDER / str(EVALUATION) / f"{kind}.json").read_bytes()
    (tmp_path / "record.json").write_bytes(data)
    (tmp_path / "rig.toml").write_text(RIG.replace("[probes]", NAMED[kind]))
    with_records(read_rig(tmp_path / "rig.toml"))
    write_certificate(tmp_path / "record.json", tmp_path / "c.html")
    (tmp_path / "again.json").write_bytes(data)
    assert show_trend(tmp_path, None, as_json=True) == 0
    assert (tmp_path / "c.html").stat().st_size > 1000
