"""The report says what the file says: of running, broken off, empty, eventful and long tests."""

from __future__ import annotations

import hashlib
import json
import re
import subprocess
import sys
from pathlib import Path

import h5py
import pytest
from commandline import program, rigapp
from report_samples import append, event, eventful, new_test
from reportpage import Page, read

from rigapp.commands.files import write_report
from rigapp.config.errors import UnusableInput
from rigapp.presentation.tokens import LIGHT
from rigapp.schema.messages import Flag
from rigapp.storage import compact_test

REPOSITORY = Path(__file__).parents[2]


def html(path: Path, folder: Path) -> Page:
    """Return the HTML report of a test file as a page."""
    target = folder / "report.html"
    assert write_report(path, target) == 0
    return read(target.read_bytes())


@pytest.fixture(scope="module")
def page(eventful_file: Path, quick_folder: Path) -> Page:
    """Return the report of the eventful test."""
    return html(eventful_file, quick_folder)


def test_summary_says_what_who_when_and_how_it_ended(page: Page) -> None:
    assert page.headings[:3] == ["Test report: PTFE, dry", "Result", "Summary"]
    found = {row[0]: row[1] for row in page.rows("Summary")}
    assert found["Operator"] == "Ann O'Hara & Bjørn"
    assert found["Rig"] == "Rig 2 <main hall>"
    assert found["Specimen"] == "PTFE 1"
    assert found["Started"] == "2027-01-15 08:00:00 UTC"
    assert found["Revolutions"] == "295 of 400 planned"
    assert found["Reason"].startswith("Stopped by a limit. force_max is 121.5")
    assert found["Gaps"] == "1 gap, 5 revolutions not recorded"
    assert found["Revolutions without a quality flag"] == "292 of 295"
    assert "simulated" not in page.text


def test_gap_has_its_place_and_its_length(page: Page) -> None:
    assert page.rows("Gaps")[1] == ["206", "5", "0", "35.0 s"]
    assert page.rows("Gaps")[3][1:] == ["206", "the test was resumed after revolution 200"]


def test_limits_show_the_change_and_what_was_reached(page: Page) -> None:
    limits = {row[0]: row[1:] for row in page.rows("Limits and alarms")}
    assert limits["overload"] == ["200", "200", "88.0", "N", "drive off"]
    assert limits["overspeed"] == ["90", "90", "61.00", "rpm", "drive off"]
    assert limits["stale data"][:3] == ["2", "2", "–"]
    assert limits["force max, critical above"] == ["120", "121", "88.0", "N", "stop"]


def test_alarm_that_ended_the_test_is_first_out_and_no_other(page: Page) -> None:
    rows = [row for row in page.rows("Limits and alarms") if row[2].startswith("force_max above")]
    assert [row[2] for row in rows] == [
        "force_max above limit",
        "force_max above limit (first out)",
    ]
    assert rows[0][4:] == ["2027-01-15 08:02:50", "by Ann"]
    assert rows[1][4:] == ["not in the log", "no"]


def test_notes_and_changes_have_before_and_after(page: Page) -> None:
    note, changed = page.rows("Notes and changes")[1:]
    assert note[2:5] == ["note", "Ann", "squeak <heard> at 50, ≈ 3 kHz"]
    assert changed[1:] == [
        "120", "limit changed", "Bjørn", "limit force_max.critical_above changed: wear-in",
        "120", "121",
    ]  # fmt: skip


def test_extremes_agree_with_the_file(page: Page, eventful_file: Path) -> None:
    rows = {row[0]: row[1:] for row in page.rows("Extremes and RMS of every channel")}
    with h5py.File(eventful_file) as file:
        group = file["/entry/revolutions"]
        safe = group["committed"][()]
        smallest = group["probe_1_min"][:safe].min()
        rms = (group["force_rms"][:safe] ** 2).mean() ** 0.5
    assert len(rows) == 7
    probe, force = rows["pin along the follower, probe_1"], rows["joint force |F|"]
    assert probe[0] == "µm"
    assert probe[3:5] == [f"{smallest:.1f}", "300"]
    assert force[:3] == ["N", "88.0", "1*"]
    assert force[5] == f"{rms:.1f}"
    assert "revolution 1: the speed was being changed" in page.text


def test_model_and_wear(page: Page) -> None:
    rows = {row[0]: row[1:] for row in page.rows("Agreement with the model")}
    assert rows["phase shift of |F|"][:2] == ["°", "-0.35"]
    assert rows["minimum of force_2"] == ["-45.3", "-46.0", "0.7"]
    assert "295 revolutions of 295 compared" in page.text
    wear = {row[0]: row[1:] for row in page.rows("Wear")}
    assert wear["measured (probes)"] == ["7.50 ± 0.40", "300", "25"]
    assert wear["predicted (model)"] == ["6.00", "300", "20"]


def test_quality_is_counted_in_words(page: Page) -> None:
    rows = {row[0]: row[1] for row in page.rows("Quality of the data")}
    assert rows["no flag, good"] == "292"
    assert rows["samples lost in or just before the revolution"] == "1"
    assert rows["the speed was being changed"] == "1"
    assert "7 samples lost in all" in page.text


def test_calibration_configuration_and_file(page: Page, eventful_file: Path) -> None:
    assert page.value("Calibration used", "matrix") == "200, 1.5; -0.8, 199.2 N/(mV/V)"
    assert page.value("Calibration used", "sensitivity") == "100, 101 µm/V"
    assert page.value("Devices", "speed limit") == "44000 count/s"
    assert 'quantity = "force_max"' in page.text
    digest = hashlib.sha256(eventful_file.read_bytes()).hexdigest()
    assert page.value("File and versions", "SHA-256") == digest
    assert page.value("File and versions", "Chain of the log").startswith("unbroken")


def test_calibration_records_are_checked(page: Page) -> None:
    rows = page.rows("Calibration used")
    found = {row[0]: row[1] for row in rows[-7:-1]}
    assert found["number"].endswith("the digest of the record holds")
    assert found["serial number"] == "S-4711"
    assert found["due"] == "2027-03-02T09:00:00Z"
    assert found["expanded uncertainty"] == "2.35 N (k = 2.05)"
    assert rows[-1][0] == "record"
    assert rows[-1][1].startswith("cannot be read:")


def test_page_needs_nothing_else_and_can_be_read_aloud(page: Page) -> None:
    assert page.language == "en"
    assert all(link.startswith("data:image/svg+xml;base64,") for link in page.links)
    assert len(page.images) == 5
    assert all(len(one["alt"]) > 40 for one in page.images)
    assert page.header_cells > 60
    pictures = [page.picture(i).decode() for i in range(len(page.images))]
    assert not any(re.search(r'href="(?!#)', one) for one in pictures)
    wear = pictures[0].lower()
    assert "stroke-dasharray" in wear
    assert LIGHT.curves["model"] in wear
    assert LIGHT.text in wear


@pytest.mark.long
@pytest.mark.parametrize("ending", ["html", "pdf"])
def test_same_file_gives_the_same_bytes(eventful_file: Path, tmp_path: Path, ending: str) -> None:
    script = (
        "import sys; from pathlib import Path; from rigapp.commands.files import write_report;"
        "write_report(Path(sys.argv[1]), Path(sys.argv[2]))"
    )
    first, second = tmp_path / f"one.{ending}", tmp_path / f"two.{ending.upper()}"
    write_report(eventful_file, first)
    subprocess.run(
        [sys.executable, "-c", script, str(eventful_file), str(second)], check=True, cwd=REPOSITORY
    )
    assert first.read_bytes() == second.read_bytes()
    if ending == "pdf":
        assert first.read_bytes().startswith(b"%PDF")
    assert sorted(one.name for one in tmp_path.iterdir()) == [first.name, second.name]


def test_empty_test_says_so(quick_folder: Path, tmp_path: Path) -> None:
    path = quick_folder / "empty.h5"
    with new_test(path) as writer:
        writer.finish("stopped", "operator", "stopped by Ann before the first revolution")
    found = html(path, tmp_path)
    assert found.value("Summary", "Revolutions") == "0 of 400 planned"
    assert found.text.count("No revolution is recorded") == 2
    assert "No complete cycle is saved" in found.text
    assert found.images == []
    assert found.rows("Wear")[1][1:] == ["unknown"] * 3
    assert write_report(path, tmp_path / "report.pdf") == 0


def test_running_and_interrupted_tests(quick_folder: Path, tmp_path: Path) -> None:
    path = quick_folder / "running.h5"
    with new_test(path) as writer:
        for revolution in range(1, 31):
            append(writer, revolution, keep=revolution == 30, model=False)
        writer.append_event(event(3, "note", "Ann", "quiet"))
        writer.commit()
        found = html(path, tmp_path)
        assert found.value("Summary", "Status") == "Running while the report was made"
        assert found.value("File and versions", "SHA-256").startswith("not stated")
        assert "No prediction is recorded" in found.text
        assert "Complete cycles, the only one" in found.text
    found = html(path, tmp_path)
    assert found.value("Summary", "Status").startswith("Interrupted")
    assert found.value("Summary", "Ended") == "unknown, the test was not closed"
    assert "30 revolutions are safe" in found.value("Summary", "Reason")
    assert found.value("Summary", "Revolutions") == "30 of 400 planned"


@pytest.mark.long
def test_compacted_test_differs_only_in_what_the_file_is(
    quick_folder: Path, tmp_path: Path
) -> None:
    path = eventful(quick_folder / "small.h5")
    before = html(path, tmp_path)
    assert compact_test(path)
    after = html(path, tmp_path)
    differing = {
        row[0]
        for (_, first), (_, second) in zip(before.tables, after.tables, strict=True)
        for row, other in zip(first, second, strict=True)
        if row != other
    }
    assert differing == {"Size", "SHA-256", "Schema, form"}
    assert after.images == before.images


def test_altered_log_is_told(quick_folder: Path, tmp_path: Path) -> None:
    path = quick_folder / "altered.h5"
    with new_test(path) as writer:
        for revolution in range(4):
            writer.append_event(event(revolution, "note", "Ann", f"note {revolution}"))
        writer.finish("stopped", "operator", "stopped")
    assert (
        html(path, tmp_path).value("File and versions", "Chain of the log").startswith("unbroken")
    )
    path.chmod(0o644)
    with h5py.File(path, "r+") as file:
        file["/entry/events/text"][2] = b"note 7"
    found = html(path, tmp_path).value("File and versions", "Chain of the log")
    assert found.startswith("BROKEN at line 3")


@pytest.mark.long
def test_unknown_flags_missing_values_and_odd_texts(quick_folder: Path, tmp_path: Path) -> None:
    path = quick_folder / "odd.h5"
    with new_test(path, cycles=1) as writer:
        append(writer, 1, quality=1 << 20, keep=True, measured_wear=False)
        append(writer, 2, quality=int(Flag.SATURATED | Flag.REVERSED), model=False, keep=True)
        writer.append_event(event(2, "alarm", "engine", "words of another version"))
        writer.append_event(event(2, "note", "中村", "\x07 bell, \ud800 half a character"))
        writer.finish("fault", "other", "")
    found = html(path, tmp_path)
    rows = {row[0]: row[1] for row in found.rows("Quality of the data")}
    assert rows["flags unknown to this version"] == "1"
    assert rows["an input at the end of its range"] == "1"
    assert found.rows("Wear")[1][1:] == ["unknown"] * 3
    assert found.rows("Wear")[2][1:3] == ["0.02", "1"]
    assert write_report(path, tmp_path / "report.pdf") == 0


@pytest.mark.parametrize(
    ("target", "words"),
    [
        ("report.docx", ".html or .pdf"),
        ("missing/report.pdf", "create it first"),
        ("folder.html", "this is a folder"),
    ],
)
def test_unusable_targets(eventful_file: Path, tmp_path: Path, target: str, words: str) -> None:
    (tmp_path / "folder.html").mkdir()
    with pytest.raises(UnusableInput, match=words):
        write_report(eventful_file, tmp_path / target)
    assert [one.name for one in tmp_path.iterdir()] == ["folder.html"]


def test_its_texts_and_tables_are_told_as_values(
    eventful_file: Path, page: Page, capsys: pytest.CaptureFixture[str]
) -> None:
    assert write_report(eventful_file, None, as_json=True) == 0
    told = json.loads(capsys.readouterr().out)
    titles = [one["title"] for one in told["sections"] if one["title"]]
    assert [told["title"], "Result", *titles] == page.headings
    assert told["results"][0]["name"] == "Wear depth"
    (section,) = (one for one in told["sections"] if one["title"] == "Limits and alarms")
    rows = next(block["rows"] for block in section["blocks"] if block["kind"] == "table")
    limits = {row[0]: row[1:] for row in rows}
    assert limits["overload"] == ["200", "200", "88.0", "N", "drive off"]
    assert {"text", "table", "figure"} <= {
        block["kind"] for section in told["sections"] for block in section["blocks"]
    }


def test_nothing_asked_for_is_refused(eventful_file: Path) -> None:
    with pytest.raises(UnusableInput, match="--to REPORT"):
        write_report(eventful_file, None)


def test_target_that_cannot_be_written(eventful_file: Path) -> None:
    with pytest.raises(UnusableInput, match="cannot be written"):
        write_report(eventful_file, Path("/proc/report.html"))


@pytest.mark.parametrize("content", [b"", b"not a test"])
def test_not_a_test_file(tmp_path: Path, content: bytes) -> None:
    path, target = tmp_path / "odd.h5", tmp_path / "report.html"
    path.write_bytes(content)
    with pytest.raises(UnusableInput):
        write_report(path, target)
    with pytest.raises(UnusableInput, match="no such file"):
        write_report(tmp_path / "missing.h5", target)
    assert not target.exists()


@pytest.mark.long
def test_report_of_a_real_run(tmp_path: Path) -> None:
    path = tmp_path / "quick.h5"
    asked = ("--revolutions", "40", "--speed", "max", "--out", path)
    made = program(
        "run", "examples/quick.toml", "--rig", "examples/simulated.toml", *asked, folder=REPOSITORY
    )
    assert made.returncode == 0, made.stderr
    done = rigapp("report", path, "--to", tmp_path / "quick.html", folder=REPOSITORY)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    found = read((tmp_path / "quick.html").read_bytes())
    assert "The rig was simulated: these are not measurements." in found.text
    assert found.value("Summary", "Revolutions") == "40 of 40 planned"
    assert found.value("Summary", "Status") == "Complete"
    assert "N/(mV/V)" in found.value("Calibration used", "matrix")
    assert "[simulation]" in found.text
