"""`rigapp package`: what is in a package, that it is whole, and the same each time."""

from __future__ import annotations

import csv
import hashlib
import json
import shutil
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path
from urllib.parse import unquote

import h5py
import pytest
import yaml
from publishing_samples import ADA, event, new_test, recorded
from rocrate.rocrate import ROCrate

from rigapp.commands.files import export_file, package_tests
from rigapp.config.errors import UnusableInput
from rigapp.publishing import package as packaging
from rigapp.publishing.package import write_archive
from rigapp.publishing.packaged import AT_A_TIME, PackedFile
from rigapp.storage import compact_test, open_test
from rigapp_calibration.records import unseal

NAMES = [
    "CITATION.cff",
    "LICENSE",
    "README.txt",
    "SHA256SUMS",
    "ptfe 1/calibration.json",
    "ptfe 1/ptfe 1.h5",
    "ptfe 1/record_load_cell.json",
    "ptfe 1/record_probes.json",
    "ptfe 1/report.html",
    "ptfe 1/rig.toml",
    "ptfe 1/statistics.csv",
    "ptfe 1/test.toml",
    "ptfe 1/versions.json",
    "ro-crate-metadata.json",
]


def package(
    *paths: Path, to: Path, authors: tuple[str, ...] = (), licence: str = "CC-BY-4.0"
) -> Path:
    assert package_tests(paths, to, authors, licence, allow_private=False) == 0
    return to


@pytest.fixture(scope="module")
def packed(clean_file: Path, quick_place: Path) -> Path:
    return package(clean_file, to=quick_place / "packed.zip")


@pytest.fixture(scope="module")
def unpacked(packed: Path) -> Path:
    folder = packed.with_suffix("")
    with zipfile.ZipFile(packed) as archive:
        archive.extractall(folder)
    return folder


def test_it_holds_what_was_promised_in_order(packed: Path) -> None:
    with zipfile.ZipFile(packed) as archive:
        assert archive.namelist() == NAMES
        assert archive.testzip() is None
        assert {one.date_time for one in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}


def test_the_test_is_in_it_with_all_its_data(clean_file: Path, unpacked: Path) -> None:
    with open_test(clean_file) as recorded_test, open_test(unpacked / "ptfe 1/ptfe 1.h5") as packed:
        assert packed.compressed
        assert packed.summary() == recorded_test.summary()
        assert packed.configuration() == recorded_test.configuration()
        for name, values in recorded_test.rows().items():
            assert packed.rows()[name].tobytes() == values.tobytes()


def test_the_sums_are_those_of_all_other_files(unpacked: Path) -> None:
    lines = (unpacked / "SHA256SUMS").read_text().splitlines()
    sums = {name: digest for digest, _, name in (line.partition("  ") for line in lines)}
    assert list(sums) == [name for name in NAMES if name != "SHA256SUMS"]
    for name, digest in sums.items():
        assert hashlib.sha256((unpacked / name).read_bytes()).hexdigest() == digest


def test_it_has_the_same_bytes_each_time(packed: Path, clean_file: Path, folder: Path) -> None:
    moved = folder / "elsewhere"
    moved.mkdir()
    copy = shutil.copyfile(clean_file, moved / clean_file.name)
    again = package(copy, to=folder / "again.zip")
    assert again.read_bytes() == packed.read_bytes()


def test_the_statistics_are_those_of_export(clean_file: Path, unpacked: Path, folder: Path) -> None:
    export_file(clean_file, folder / "table.csv", cycles=False)
    statistics = unpacked / "ptfe 1" / "statistics.csv"
    assert statistics.read_bytes() == (folder / "table.csv").read_bytes()
    with statistics.open(newline="") as file:
        header, *rows = csv.reader(file)
    assert len(rows) == 8
    readme = (unpacked / "README.txt").read_text()
    assert [name for name in header if f"\n{name}" not in readme] == []


def test_the_readme_names_every_file(unpacked: Path) -> None:
    lines = (unpacked / "README.txt").read_text().splitlines()
    assert [name for name in NAMES if name not in lines] == []


def test_the_settings_are_as_recorded_and_the_records_hold(unpacked: Path) -> None:
    folder = unpacked / "ptfe 1"
    assert 'name = "Rig 2"' in (folder / "rig.toml").read_text()
    assert "revolutions = 400" in (folder / "test.toml").read_text()
    assert unseal((folder / "record_load_cell.json").read_bytes()).kind == "load cell"
    numbers = json.loads((folder / "calibration.json").read_text())
    assert numbers["probes"]["sensitivity_um_per_V"] == [100.0, 101.0]
    assert "rigapp" in json.loads((folder / "versions.json").read_text())


@pytest.mark.long
def test_it_can_be_cited(clean_file: Path, folder: Path) -> None:
    to = package(clean_file, to=folder / "p.zip", authors=(ADA, 'Laboratory "North": wear'))
    with zipfile.ZipFile(to) as archive:
        found = yaml.safe_load(archive.read("CITATION.cff"))
    assert (found["cff-version"], found["type"]) == ("1.2.0", "dataset")
    assert found["title"] == "Wear test: PTFE, dry"
    assert found["authors"] == [
        {"family-names": "Lovelace", "given-names": "Ada"},
        {"name": 'Laboratory "North": wear'},
    ]
    assert found["license"] == "CC-BY-4.0"
    assert len(found["date-released"]) == len("2027-01-15")
    assert found["version"]
    (test,) = found["identifiers"]
    assert test["value"] == "urn:uuid:11111111-2222-3333-4444-555555555555"


def test_without_authors_it_is_the_operator_s(unpacked: Path) -> None:
    assert 'name: "Ada Lovelace"' in (unpacked / "CITATION.cff").read_text()


def test_it_is_a_crate_whose_files_are_all_there(unpacked: Path) -> None:
    crate = ROCrate(unpacked)
    described = {unquote(one.id) for one in crate.data_entities}
    assert described == set(NAMES) - {"ro-crate-metadata.json", "SHA256SUMS"}
    for one in crate.data_entities:
        assert int(one["contentSize"]) == (unpacked / unquote(one.id)).stat().st_size
    root = crate.root_dataset
    assert root["license"]["identifier"] == "CC-BY-4.0"
    assert [one["name"] for one in root["author"]] == ["Ada Lovelace"]
    (run,) = root["mentions"]
    assert run["instrument"]["name"] == "rigapp"
    assert unquote(run["result"].id) == "ptfe 1/ptfe 1.h5"


@pytest.mark.long
def test_the_licence_is_named_and_linked(clean_file: Path, folder: Path) -> None:
    to = package(clean_file, to=folder / "p.zip", licence="cc0-1.0")
    with zipfile.ZipFile(to) as archive:
        text = archive.read("LICENSE").decode()
        assert b"license: CC0-1.0" in archive.read("CITATION.cff")
    assert "SPDX-License-Identifier: CC0-1.0" in text
    assert "https://creativecommons.org/publicdomain/zero/1.0/" in text


def test_an_unknown_licence_is_refused_with_those_that_are_known(
    clean_file: Path, folder: Path
) -> None:
    with pytest.raises(UnusableInput, match=r"--licence CC-BY: .* CC-BY-4\.0"):
        package(clean_file, to=folder / "p.zip", licence="CC-BY")


@pytest.mark.long
def test_several_tests_are_in_one_package(clean_file: Path, folder: Path) -> None:
    other = recorded(folder / "other.h5")
    to = package(clean_file, other, to=folder / "both.zip")
    with zipfile.ZipFile(to) as archive:
        names = archive.namelist()
        assert {"ptfe 1/ptfe 1.h5", "other/other.h5"} <= set(names)
        assert b"16 revolutions" in archive.read("README.txt")
    assert names == sorted(names)


def test_two_tests_of_one_name_are_refused(clean_file: Path, folder: Path) -> None:
    copy = shutil.copyfile(clean_file, folder / "PTFE 1.h5")
    for second in (copy, clean_file):
        with pytest.raises(UnusableInput, match="has the same name"):
            package(clean_file, second, to=folder / "p.zip")


def test_nothing_is_overwritten(clean_file: Path, folder: Path) -> None:
    to = folder / "p.zip"
    to.write_bytes(b"mine")
    with pytest.raises(UnusableInput, match="exists and is not overwritten"):
        package(clean_file, to=to)
    assert to.read_bytes() == b"mine"


@pytest.mark.long
def test_what_appears_meanwhile_is_not_overwritten(
    clean_file: Path, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    to = folder / "p.zip"

    def slowly(*arguments: object) -> None:
        write_archive(*arguments)  # type: ignore[arg-type]
        to.write_bytes(b"mine")

    monkeypatch.setattr(packaging, "write_archive", slowly)
    with pytest.raises(UnusableInput, match="exists and is not overwritten"):
        package(clean_file, to=to)
    assert [one.name for one in folder.iterdir()] == ["p.zip"]
    assert to.read_bytes() == b"mine"


@pytest.mark.parametrize(
    ("name", "words"),
    [("p.tar", "a package is a .zip file"), ("no/p.zip", "does not exist; create it first")],
)
def test_a_name_that_cannot_be_is_refused(
    clean_file: Path, folder: Path, name: str, words: str
) -> None:
    with pytest.raises(UnusableInput, match=words):
        package(clean_file, to=folder / name)


def test_a_running_test_is_refused(folder: Path) -> None:
    path = folder / "running.h5"
    with new_test(path) as writer:
        writer.commit()
        with pytest.raises(UnusableInput, match="the test is running; package it when it has end"):
            package(path, to=folder / "p.zip")
    assert not (folder / "p.zip").exists()


@pytest.mark.long
def test_an_interrupted_test_is_packaged(folder: Path) -> None:
    path = recorded(folder / "cut.h5", closed=False)
    to = folder / "p.zip"
    assert package_tests([path], to, [], "CC-BY-4.0", allow_private=True) == 0
    with zipfile.ZipFile(to) as archive:
        with h5py.File(archive.open("cut/cut.h5")) as file, open_test(path) as reader:
            rows = file["/entry/revolutions"]
            # Whoever takes all of a column takes no row that is not there.
            assert len(rows["force_max"]) == rows["committed"][()] == reader.committed() > 0
            assert float(rows["force_max"][:].mean()) == float(reader.column("force_max").mean())
        assert b"interrupted, its file never closed" in archive.read("README.txt")


@pytest.mark.long
def test_the_room_of_a_file_in_place_costs_nothing_and_a_compressed_one_is_stored(
    folder: Path,
) -> None:
    path = recorded(folder / "test.h5")
    with zipfile.ZipFile(package(path, to=folder / "before.zip")) as archive:
        about = archive.getinfo("test/test.h5")
        assert about.file_size < path.stat().st_size / 4
        assert about.compress_type == zipfile.ZIP_STORED
    compact_test(path)
    with zipfile.ZipFile(package(path, to=folder / "after.zip")) as archive:
        assert archive.getinfo("test/test.h5").compress_type == zipfile.ZIP_STORED


def test_a_large_file_is_read_a_piece_at_a_time(folder: Path) -> None:
    large = folder / "large.h5"
    with large.open("wb") as file:
        file.truncate(5 * AT_A_TIME + 7)
    piece = PackedFile("large.h5", large, "", "")
    assert [len(one) for one in piece.parts()] == [*[AT_A_TIME] * 5, 7]


@pytest.mark.sampled
@pytest.mark.usefixtures("no_report")
@pytest.mark.parametrize("change", [Path.touch, compact_test, Path.unlink])
def test_a_test_that_changes_meanwhile_is_told(
    folder: Path, monkeypatch: pytest.MonkeyPatch, change: Callable[[Path], object]
) -> None:
    path = recorded(folder / "test.h5")

    def slowly(*arguments: object) -> None:
        write_archive(*arguments)  # type: ignore[arg-type]
        change(path)

    monkeypatch.setattr(packaging, "write_archive", slowly)
    with pytest.raises(UnusableInput, match=r"test\.h5: was changed or compressed while"):
        package(path, to=folder / "p.zip")
    assert not any(one.suffix == ".zip" or "zip" in one.name for one in folder.iterdir())


def test_a_test_without_a_revolution_is_packaged(folder: Path) -> None:
    path = folder / "none.h5"
    with new_test(path) as writer:
        writer.finish("stopped", "operator", "stop button")
    with zipfile.ZipFile(package(path, to=folder / "p.zip")) as archive:
        assert len(archive.read("none/statistics.csv").splitlines()) == 1
        assert b"stopped before its planned end" in archive.read("README.txt")


def test_bytes_that_change_between_two_looks_are_told(folder: Path) -> None:
    path = folder / "test.h5"
    path.write_bytes(b"new")
    piece = PackedFile("test.h5", path, "", "")
    with pytest.raises(UnusableInput, match="changed while it was packed"):
        write_archive(folder / "p.zip", [piece], {"test.h5": "of the old"}, lambda _: None)


@pytest.mark.long
def test_a_test_without_operator_needs_an_author(folder: Path) -> None:
    path = recorded(folder / "t.h5", operator="")
    with pytest.raises(UnusableInput, match="No author is known"):
        package(path, to=folder / "p.zip")
    package(path, to=folder / "p.zip", authors=(ADA,))


def test_an_author_without_a_name_is_refused(clean_file: Path, folder: Path) -> None:
    with pytest.raises(UnusableInput, match="names nobody"):
        package(clean_file, to=folder / "p.zip", authors=(" , ",))


def test_a_missing_library_is_named(
    clean_file: Path, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "rocrate", None)
    with pytest.raises(UnusableInput, match=r"pip install 'rigapp\[publish\]'"):
        package(clean_file, to=folder / "p.zip")


def test_a_file_that_is_no_test_is_refused(folder: Path) -> None:
    path = folder / "t.h5"
    path.write_bytes(b"x")
    with pytest.raises(UnusableInput, match="not an HDF5 file"):
        package(path, to=folder / "p.zip")


@pytest.mark.long
def test_an_event_by_the_program_needs_no_author(folder: Path) -> None:
    by_program = [
        event("device", "daq", "a cable is loose"),
        event("message", "messages", "told"),
        event("note", "operator", "nobody said who"),
    ]
    package(recorded(folder / "t.h5", events=by_program), to=folder / "p.zip")
