"""What is known of the wear afterwards, from files as the twin left them: the same numbers."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import h5py
import msgspec
import numpy as np
import pytest
from plant_revolutions import EXAMPLES
from recorded_plants import RECORDED, REVOLUTIONS, record

from rigapp.commands.files import identify_tests
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_test
from rigapp.report.testreport.identified import identified_test, identified_tests
from rigapp.schema.messages import Flag
from rigapp.storage import open_test
from rigapp.twin.link import IdentificationTarget

TRUE = 5.05e-4


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with a test whose probes have a record, and one whose have none."""
    folder = tmp_path_factory.mktemp("kept")
    record(folder / "first.h5", 1.1, RECORDED)
    record(folder / "bare.h5", 1.1, IdentificationTarget(planned=400.0), 10)
    return folder


@pytest.fixture(scope="module")
def two(folder: Path) -> Path:
    """Return the folder with a test of a second specimen whose probes have a record."""
    record(folder / "second.h5", 0.8, RECORDED, 100)
    return folder


@pytest.mark.parametrize(
    "after", [*(pytest.param(one, marks=pytest.mark.long) for one in (None, 60)), 100]
)
def test_the_numbers_are_those_that_were_told_while_it_ran(folder: Path, after: int | None) -> None:
    found = identified_test(folder / "first.h5", after)
    with open_test(folder / "first.h5") as reader:
        table = reader.predictions()
    last = REVOLUTIONS - 1 if after is None else after - 1
    known, left = found.known, found.left
    assert known is not None
    assert left is not None
    assert left.revolutions is not None
    for name, told, factor in (
        ("wear_coefficient", known.coefficient, 1e9),
        ("remaining_revolutions", left.revolutions, 1.0),
    ):
        if after is not None and name != "wear_coefficient":
            continue  # the life may not have reached the depth yet, as it does now
        again = [factor * one for one in (told.median, told.low, told.high)]
        live = [float(table[f"{name}{end}"][last]) for end in ("", "_low", "_high")]
        # Of a moment before the end, the life has gone on since, and bends otherwise at its end:
        # the more, the earlier.
        exact = {None: 1e-9, 100: 1e-5, 60: 5e-3}[after]
        assert again == pytest.approx(live, rel=exact), name
    assert known.best.weight == pytest.approx(float(table["wear_model_weight"][last]), rel=1e-5)
    assert found.course["wear_coefficient"][-1] == table["wear_coefficient"][last]
    assert np.all(np.diff(found.course["revolution"]) > 0)


def test_the_early_band_holds_what_came(folder: Path) -> None:
    found = identified_test(folder / "first.h5")
    bands = [one.band for one in found.bands]
    assert found.known is not None
    readings = found.known.readings
    early = found.bands[0]
    later = readings.revolution > early.after
    low, high = (np.interp(readings.revolution[later], bands[0].revolution, one)
                 for one in (bands[0].low, bands[0].high))  # fmt: skip
    assert later.any()
    inside = (low < readings.depth[later]) & (readings.depth[later] < high)
    assert inside.mean() > 0.8


@pytest.mark.long
def test_a_second_test_of_a_specimen_has_the_readings_of_the_first(tmp_path: Path) -> None:
    whole = record(tmp_path / "whole.h5", 1.1, RECORDED, 100)
    first = record(tmp_path / "first.h5", 1.1, RECORDED, 60)
    second = record(tmp_path / "second.h5", 1.1, RECORDED, 40, after=first, made=60)
    unbroken, found = identified_test(whole), identified_test(second)
    assert unbroken.known is not None
    assert found.known is not None
    assert found.before == 60
    assert "60 before this test" in found.said
    both = [(one.low, one.median, one.high) for one in
            (unbroken.known.coefficient, found.known.coefficient)]  # fmt: skip
    assert both[1] == pytest.approx(both[0], rel=1e-2)
    with open_test(second) as reader:
        live = reader.predictions()["wear_coefficient"][-1]
    assert 1e9 * both[1][1] == pytest.approx(live, rel=1e-6)
    together = identified_tests([first, second])
    assert [one.path for one in together.counted] == [second]
    assert "its readings are among those of second.h5" in together.why_not


@pytest.mark.long
def test_two_specimens_tell_their_scatter_and_the_next_ones_limits(two: Path) -> None:
    found = identified_tests([two / "first.h5", two / "second.h5", two / "bare.h5"])
    assert found.pairing is not None
    assert [one.path.name for one in found.counted] == ["first.h5", "second.h5"]
    assert found.pairing.scatter.median > 1.1
    middle = 1e9 * found.pairing.coefficient.median
    assert 0.8 * TRUE < middle < 1.1 * TRUE
    assert found.pairing.next.low < found.pairing.coefficient.low
    assert found.pairing.prior.source == "2 specimens: first.h5, second.h5"
    with pytest.raises(UnusableInput, match="give it once"):
        identified_tests([two / "first.h5", two / "first.h5"])


@pytest.mark.long
def test_the_printed_prior_makes_the_limits_of_the_next_test_narrower(
    two: Path, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    files = [two / "first.h5", two / "second.h5"]
    assert identify_tests(files, None, as_json=False) == 0
    said = capsys.readouterr().out
    lines = said[said.index("[prediction.prior]") :]
    recipe = (EXAMPLES / "quick.toml").read_text("utf-8").replace("[model]", f"{lines}\n[model]", 1)
    (tmp_path / "next.toml").write_text(recipe, "utf-8")
    prior = read_test(tmp_path / "next.toml").record.prediction.prior
    assert prior is not None
    assert prior.source == "2 specimens: first.h5, second.h5"
    known = []
    for asked in (RECORDED, msgspec.structs.replace(RECORDED, prior=prior)):
        found = identified_test(
            record(tmp_path / f"{asked.prior is None}.h5", 0.9, asked, 48)
        ).known
        assert found is not None
        assert found.coefficient.low < 0.9e-9 * TRUE < found.coefficient.high
        known.append(found)
    assert known[1].spread < 0.95 * known[0].spread
    assert known[1].prior.source == prior.source


def test_a_file_whose_probes_have_no_record_is_refused_in_words(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert identify_tests([folder / "bare.h5"], None, as_json=False) == 1
    said = capsys.readouterr().out
    assert "cannot be determined, because the probes have no calibration record" in said
    assert identify_tests([folder / "bare.h5"], None, as_json=True) == 1
    tree = json.loads(capsys.readouterr().out)
    assert tree["tests"][0]["refused"] is True
    assert "wear_coefficient" not in tree["tests"][0]
    assert tree["pairing"] is None
    for each in (tree, tree["tests"][0]):
        assert each["wear_coefficient_mm3_per_Nm"] is None
        assert each["remaining_revolutions"] is None
        assert "no calibration record" in each["reason"]


def test_the_promised_keys_hold_value_limits_and_level(folder: Path, tmp_path: Path) -> None:
    to = tmp_path / "wear.json"
    assert identify_tests([folder / "first.h5"], to, as_json=False) == 0
    tree = json.loads(to.read_bytes())
    for each in (tree, tree["tests"][0]):
        coefficient, left = each["wear_coefficient_mm3_per_Nm"], each["remaining_revolutions"]
        assert coefficient["low"] < 1.1 * TRUE < coefficient["high"]
        for one in (coefficient, left):
            assert one["low"] < one["estimate"] < one["high"]
            assert one["level"] == 0.95
        assert each["reason"] == ""
        assert each["wear_model"] == "constant"
        assert each["odds"] > 0.5
    assert tree["tests"][0]["wear_coefficient"]["median"] == coefficient["estimate"]


@pytest.mark.long
def test_of_two_specimens_the_promised_keys_hold_what_both_tell(two: Path, tmp_path: Path) -> None:
    to = tmp_path / "wear.json"
    files = [two / "first.h5", two / "second.h5"]
    assert identify_tests(files, to, as_json=False) == 0
    tree = json.loads(to.read_bytes())
    middle = tree["pairing"]["wear_coefficient"]["median"]
    assert tree["wear_coefficient_mm3_per_Nm"]["estimate"] == middle
    assert tree["remaining_revolutions"] is None
    assert tree["reason"]


@pytest.mark.long
@pytest.mark.parametrize("ending", [".csv", ".json", ".html", ".pdf"])
def test_it_is_written_in_each_form(
    two: Path, tmp_path: Path, ending: str, capsys: pytest.CaptureFixture[str]
) -> None:
    to = tmp_path / f"wear{ending}"
    files = [two / "first.h5", two / "second.h5"]
    assert identify_tests(files, to, as_json=False) == 0
    said = capsys.readouterr().out
    assert "Scatter between specimens: a factor of" in said
    data = to.read_bytes()
    if ending == ".csv":
        head, *rows = data.decode().splitlines()
        assert head.startswith("file,specimen,revolution,wear_coefficient_mm3_per_N_m,")
        assert {row.partition(",")[0] for row in rows} == {"first.h5", "second.h5"}
        assert all(row.count(",") == head.count(",") for row in rows)
    elif ending == ".json":
        tree = json.loads(data)
        assert tree["tests"][0]["wear_coefficient"]["unit"] == "mm^3/(N m)"
        assert tree["tests"][0]["bands"][-1]["after_revolution"] <= REVOLUTIONS
        assert tree["pairing"]["prior"]["spread_ln"] > 0.0
    else:
        assert data.startswith(b"%PDF" if ending == ".pdf" else b"<!doctype html>")


def test_a_target_of_another_kind_is_refused_before_anything_is_read(tmp_path: Path) -> None:
    with pytest.raises(UnusableInput, match="the name must end with one of"):
        identify_tests([tmp_path / "missing.h5"], tmp_path / "wear.txt", as_json=False)


def test_a_test_that_its_twin_never_followed_says_so(folder: Path, tmp_path: Path) -> None:
    path = tmp_path / "short.h5"
    shutil.copy(folder / "first.h5", path)
    path.chmod(0o600)
    with h5py.File(path, "r+") as file:
        file["entry/prediction/checkpoint_length"][:] = 0
    found = identified_test(path)
    assert found.known is None
    assert "the twin had followed no revolution" in found.said


def test_the_ramp_at_the_end_does_not_count_for_the_time_that_remains(
    folder: Path, tmp_path: Path
) -> None:
    path = tmp_path / "stopped.h5"
    shutil.copy(folder / "first.h5", path)
    path.chmod(0o600)
    with h5py.File(path, "r+") as file:
        rows = file["entry/revolutions"]
        rows["speed"][REVOLUTIONS - 1] = 28.0
        rows["quality"][REVOLUTIONS - 1] = Flag.RAMP
    remains_s = identified_test(path).remaining_s
    assert remains_s == pytest.approx(identified_test(folder / "first.h5").remaining_s)
