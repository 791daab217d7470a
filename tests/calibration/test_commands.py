"""`rigapp calibrate` as a person types it: results, refusals, records, certificates."""

from __future__ import annotations

import json
import os
import stat
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from commandline import Done, program, rigapp

from rigapp_calibration.load_cell.readings import LoadCellReadings
from rigapp_calibration.probes.readings import parse_probe
from rigapp_calibration.records import RecordError, seal, unseal
from rigapp_calibration.taking.readings import ReadingsError
from tests.calibration.simulated_cell import Cell, take

SETTINGS = """
schema = 1
[cell]
name = "pin load cell"
[place]
gravity_m_s2 = 9.8123
"""


def as_csv(readings: LoadCellReadings) -> str:
    lines = ["series,step,mass_kg,pin_angle_deg,signal_1,signal_2"]
    for i in range(len(readings)):
        degrees = np.degrees(readings.angle[i])
        one, two = readings.signal[i]
        lines.append(
            f"{readings.series[i]},{readings.step[i]},{readings.mass[i]},{degrees},{one},{two}"
        )
    return "\n".join(lines) + "\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    readings = take(Cell(), np.random.default_rng(4), angles=4)
    (tmp_path / "readings.csv").write_text(as_csv(readings))
    (tmp_path / "settings.toml").write_text(SETTINGS)
    return tmp_path


def fit(folder: Path, record: str, *more: str) -> Done:
    return rigapp(
        "calibrate", "load-cell", "--readings", folder / "readings.csv",
        "--settings", folder / "settings.toml", "--to", folder / record, *more,
    )  # fmt: skip


def test_good_readings_make_a_sealed_record_and_a_certificate(folder: Path) -> None:
    done = fit(folder, "record.json", "--json")
    assert done.returncode == 0, done.stderr
    result = json.loads(done.stdout)
    assert result["accepted"] is True
    assert np.array(result["matrix_N_per_unit"]) == pytest.approx(
        np.linalg.inv(Cell().sensitivity), abs=1.5
    )
    assert {"zero", "residual_std_N", "expanded_uncertainty_N", "coverage_factor"} <= set(result)
    record = folder / "record.json"
    assert not record.stat().st_mode & stat.S_IWUSR
    assert unseal(record.read_bytes()).kind == "load cell"
    for ending in ("pdf", "html"):
        made = rigapp("calibrate", "certificate", record, "--to", folder / f"a.{ending}")
        assert made.returncode == 0, made.stderr
    assert b"Not classifiable" in (folder / "a.html").read_bytes()
    assert (folder / "a.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.long
@pytest.mark.parametrize("ending", ["html", "pdf"])
def test_another_process_makes_the_same_certificate(folder: Path, ending: str) -> None:
    assert fit(folder, "record.json").returncode == 0
    for name, run in (("a", rigapp), ("b", program)):
        target = folder / f"{name}.{ending}"
        made = run("calibrate", "certificate", folder / "record.json", "--to", target)
        assert made.returncode == 0, made.stderr
    assert (folder / f"a.{ending}").read_bytes() == (folder / f"b.{ending}").read_bytes()


def test_existing_record_is_not_overwritten(folder: Path) -> None:
    (folder / "record.json").write_text("precious")
    done = fit(folder, "record.json")
    assert done.returncode == 2
    assert "never overwritten" in done.stderr
    assert (folder / "record.json").read_text() == "precious"


def test_bad_fit_is_refused_and_not_saved(folder: Path) -> None:
    readings = take(Cell(hysteresis=9.0), np.random.default_rng(4), angles=4)
    (folder / "readings.csv").write_text(as_csv(readings))
    done = fit(folder, "record.json", "--json")
    assert done.returncode == 1
    result = json.loads(done.stdout)
    assert result["accepted"] is False
    assert "hysteresis" in [one["code"] for one in result["problems"]]
    in_words = fit(folder, "record.json")
    assert in_words.returncode == 1
    assert in_words.stdout == ""  # no numbers that somebody could use all the same
    assert "Going down the cell reads" in in_words.stderr
    assert "the calibration is refused, nothing was saved" in in_words.stderr
    assert not os.path.lexists(folder / "record.json")


@pytest.mark.parametrize(
    ("old", "new", "needle"),
    [
        ("mass_kg", "mass_g", "column mass_kg is missing"),
        ("1,2,8.0", "1,2,eight", "line 3: mass_kg 'eight' is not a number"),
        ("1,2,8.0", "1,2,", "line 3 has an empty field (mass_kg)"),
        ("1,2,8.0", "1,2,8,0", "line 3 has more fields than the header's 6: '"),
        ("1,2,8.0", "1,2.5,8.0", "line 3: step '2.5' is not an integer"),
        ("1,2,8.0", "1,inf,8.0", "line 3: step 'inf' is not an integer"),
        ("1,2,8.0", "1,-2,8.0", "line 3: step '-2' is not an integer from 0 on"),
        ("series,step", "series,series,step", "the header names column series twice"),
    ],
)
def test_unreadable_readings_are_named(folder: Path, old: str, new: str, needle: str) -> None:
    path = folder / "readings.csv"
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))
    done = fit(folder, "record.json")
    assert done.returncode == 2
    assert needle in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    ("separator", "name"), [(";", "semicolons"), ("\t", "tabs"), ("|", "vertical bars")]
)
def test_another_separator_is_named(folder: Path, separator: str, name: str) -> None:
    path = folder / "readings.csv"
    path.write_text(path.read_text().replace(",", separator))
    done = fit(folder, "record.json")
    assert done.returncode == 2
    assert f"readings.csv: the fields are separated by {name}; separate them by commas" in (
        done.stderr
    )
    with pytest.raises(ReadingsError, match=name):
        parse_probe(probe_csv().replace(",", separator))


def test_a_column_that_nothing_reads_is_a_note(folder: Path) -> None:
    path = folder / "readings.csv"
    first, *rest = path.read_text().splitlines()
    path.write_text("\n".join([f"{first},remark", *(f"{line},calm" for line in rest)]))
    done = fit(folder, "record.json")
    assert done.returncode == 0
    assert "note: The table has columns that are ignored: remark;" in done.stderr
    text = probe_csv(0.001).replace("signal_V", "signal_V,other_signal_v").replace("\n1", ",0\n1")
    text = text.replace("\n2", ",0\n2").replace("\n3", ",0\n3").replace("v,0", "v") + ",0"
    made = probes(folder, text.replace("\n,0", ",0"))
    assert made.returncode == 0, made.stderr
    assert [one["code"] for one in json.loads(made.stdout)["problems"]] == ["unused_columns"]


@pytest.mark.parametrize(
    ("unit", "factor", "needle"),
    [
        ("V", 1.0, "signal_unit = 'V', but a rig reads its load cell in mV/V"),
        ("counts", 1.0, "signal_unit = 'counts', but"),
        ("mV/V", 5.0, "The signal at full scale = 9.9"),
        ("mV/V", 1e-3, "did you mean V/V? Then write 1.99"),
        ("mV/V", 1e3, "did you mean uV/V? Then write 1.99"),
        ("mV/V", 4e6, "Are the signals volts of an amplifier, counts, or N?"),
    ],
)
def test_a_wrong_signal_unit_is_refused(
    folder: Path, unit: str, factor: float, needle: str
) -> None:
    (folder / "settings.toml").write_text(
        SETTINGS.replace('load cell"', f'load cell"\nsignal_unit = "{unit}"')
    )
    taken = take(Cell(), np.random.default_rng(4), angles=4)
    (folder / "readings.csv").write_text(as_csv(replace(taken, signal=factor * taken.signal)))
    done = fit(folder, "record.json", "--json")
    assert done.returncode == 1
    problems = {one["code"]: one["sentence"] for one in json.loads(done.stdout)["problems"]}
    assert needle in problems["signal_unit"]
    assert not os.path.lexists(folder / "record.json")


@pytest.mark.parametrize(
    ("section", "line", "code", "needle"),
    [
        ("weights", "density_kg_per_m3 = 8.0", "weight_density", "mean g/cm^3? Then write 8000"),
        ("weights", "density_kg_per_m3 = 80000.0", "weight_density", "1500 .. 22700 kg/m^3"),
        ("weights", "hanger_mass_kg = 99.0", "hanger_mass", "more than the cell may bear"),
        ("place", "air_density_kg_per_m3 = 0.0012", "air_density", "mean g/cm^3? Then write 1.2"),
        ("place", "gravity_m_s2 = 981.23", "wrong_gravity", "did you mean cm/s^2 (Gal)?"),
        ("place", "gravity_m_s2 = 9812.3", "wrong_gravity", "mean mm/s^2? Then write 9.8123"),
    ],
)  # fmt: skip
def test_an_implausible_setting_names_the_likely_unit(
    folder: Path, section: str, line: str, code: str, needle: str
) -> None:
    text = SETTINGS if section == "place" else f"{SETTINGS}[weights]\n{line}\n"
    if section == "place":
        start = SETTINGS.replace("gravity_m_s2 = 9.8123\n", "") if "gravity" in line else SETTINGS
        text = f"{start}{line}\n"
    (folder / "settings.toml").write_text(text)
    done = fit(folder, "record.json", "--json")
    assert done.returncode == 1
    result = json.loads(done.stdout)
    assert result["accepted"] is False
    told = [one["sentence"] for one in result["problems"] if one["code"] == code]
    assert any(needle in sentence for sentence in told), told
    assert not os.path.lexists(folder / "record.json")


@pytest.mark.parametrize(
    ("line", "needle"),
    [
        ("pressure_hPa = 101325.0", "did you mean Pa? Then write 1013.25"),
        ("temperature_degC = 293.15", "did you mean K? Then write 20"),
        ("latitude_deg = 95.0", "place.latitude_deg = 95 is outside -90 to 90 deg"),
        ("height_m = nan", "place.height_m = nan is not a finite number"),
    ],
)
def test_an_impossible_setting_is_refused(folder: Path, line: str, needle: str) -> None:
    (folder / "settings.toml").write_text(f"{SETTINGS}{line}\n")
    done = fit(folder, "record.json")
    assert done.returncode == 2
    assert needle in done.stderr


def test_a_calibration_without_an_angle_reference_says_so(folder: Path) -> None:
    done = fit(folder, "record.json")
    assert done.returncode == 0
    assert "note: No angle reference is stated" in done.stderr
    made = rigapp("calibrate", "certificate", folder / "record.json", "--to", folder / "c.html")
    assert made.returncode == 0, made.stderr
    page = (folder / "c.html").read_text()
    assert "No angle reference is stated" in page
    assert "none was stated; offset taken as 0 deg" in page
    (folder / "settings.toml").write_text(f"{SETTINGS}[angle]\noffset_deg = 0.0\n")
    assert "angle reference" not in fit(folder, "again.json").stderr


def test_a_mistake_that_makes_u_large_is_named_alone(folder: Path) -> None:
    readings = take(Cell(), np.random.default_rng(4), angles=8)
    late = np.array([int(name) > 4 for name in readings.series])
    signal = np.where(late[:, None], readings.signal[:, ::-1], readings.signal)
    (folder / "readings.csv").write_text(as_csv(replace(readings, signal=signal)))
    done = fit(folder, "record.json", "--json")
    assert done.returncode == 1
    problems = [one for one in json.loads(done.stdout)["problems"] if one["blocks"]]
    assert [one["code"] for one in problems] == ["axes_swapped"]
    assert problems[0]["sentence"].startswith("From series 5 on: the two signals are swapped")


def test_a_step_number_twice_is_refused(folder: Path) -> None:
    path = folder / "readings.csv"
    lines = path.read_text().splitlines()
    again = lines[4].split(",")
    again[-1] = "0.123456"
    path.write_text("\n".join([*lines, ",".join(again)]) + "\n")
    done = fit(folder, "record.json", "--json")
    assert done.returncode == 1
    problems = {one["code"]: one["sentence"] for one in json.loads(done.stdout)["problems"]}
    assert "series 1, step 4 occurs twice" in problems["duplicated_step"]


def test_steps_out_of_order_are_refused_and_one_left_out_is_told(folder: Path) -> None:
    path = folder / "readings.csv"
    lines = path.read_text().splitlines()
    path.write_text("\n".join([*lines[:2], *lines[10:12], *lines[2:10], *lines[12:]]))
    done = fit(folder, "record.json")
    assert done.returncode == 1
    assert "The step numbers decrease at series 1, step 2; write the readings in the" in done.stderr
    path.write_text("\n".join([*lines[:4], *lines[5:]]))
    done = fit(folder, "record.json")
    assert done.returncode == 0
    assert "note: A step number is left out before series 1, step 5:" in done.stderr


def test_missing_gravity_is_asked_for(folder: Path) -> None:
    text = SETTINGS.replace("gravity_m_s2 = 9.8123", "")
    (folder / "settings.toml").write_text(text)
    done = fit(folder, "record.json")
    assert done.returncode == 2
    assert "place.gravity_m_s2" in done.stderr


def test_latitude_replaces_gravity(folder: Path) -> None:
    text = SETTINGS.replace("gravity_m_s2 = 9.8123", "latitude_deg = 52.0\nheight_m = 50.0")
    (folder / "settings.toml").write_text(text)
    assert fit(folder, "record.json").returncode == 0


def test_changed_record_is_refused(folder: Path) -> None:
    data = seal({"kind": "probe", "result": {"sensitivity_um_per_V": 50.0}})
    assert unseal(data).content["result"] == {"sensitivity_um_per_V": 50.0}
    with pytest.raises(RecordError, match="changed"):
        unseal(data.replace(b"50.0", b"51.0"))
    with pytest.raises(RecordError, match="not a calibration record"):
        unseal(b"{}")


def probe_csv(noise: float = 0.0, backlash: float = 0.0) -> str:
    rng = np.random.default_rng(2)
    lines = ["series,step,position_um,signal_V"]
    up = np.linspace(0.0, 1000.0, 11)
    for series in range(3):
        for step, (position, down) in enumerate([(p, 0) for p in up] + [(p, 1) for p in up[::-1]]):
            voltage = -5.0 + 0.01 * (position + down * backlash) + rng.normal(0.0, noise)
            lines.append(f"{series + 1},{step + 1},{position},{voltage}")
    return "\n".join(lines) + "\n"


def probes(folder: Path, text: str) -> Done:
    (folder / "probe.csv").write_text(text)
    (folder / "probe.toml").write_text('schema = 1\n[probe]\nname = "probe 1"\n')
    return rigapp(
        "calibrate", "probes", "--readings", folder / "probe.csv",
        "--settings", folder / "probe.toml", "--to", folder / "probe.json", "--json",
    )  # fmt: skip


def test_probe_is_recovered(folder: Path) -> None:
    done = probes(folder, probe_csv(noise=0.001))
    assert done.returncode == 0, done.stderr
    result = json.loads(done.stdout)
    assert result["sensitivity_um_per_V"] == pytest.approx(100.0, rel=1e-3)
    assert result["offset_V"] == pytest.approx(-5.0, abs=2e-3)
    assert result["linearity_percent"] < 0.1
    made = rigapp("calibrate", "certificate", folder / "probe.json", "--to", folder / "probe.pdf")
    assert made.returncode == 0, made.stderr


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (probe_csv(noise=0.001, backlash=15.0), "backlash"),
        (probe_csv(noise=0.001).replace("1,4,300.0", "1,4,350.0"), "wrong_position"),
        (probe_csv(noise=0.001).replace("1,4,300.0,", "1,4,300.0,nan #"), "not_a_number"),
        ("series,step,position_um,signal_V\n1,1,0,0\n1,2,10,1\n", "too_few_positions"),
    ],
    ids=["backlash", "wrong position", "not a number", "too few"],
)
def test_probe_mistakes_are_named(folder: Path, text: str, code: str) -> None:
    text = "\n".join(line.split(" #")[0] for line in text.splitlines()) + "\n"
    done = probes(folder, text)
    assert done.returncode == 1, done.stderr
    assert code in [one["code"] for one in json.loads(done.stdout)["problems"]]
