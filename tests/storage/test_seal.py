"""A seal names the part that was changed on purpose, its checksums made anew."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import google_crc32c
import h5py
import pytest
from cryptography.hazmat.primitives import serialization
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey
from storage_samples import ended, write

from rigapp.config.errors import UnusableInput
from rigapp.schema.messages import FinishReason
from rigapp.schema.notices import Finished
from rigapp.service.recorded import settle
from rigapp.storage import (
    broken_seals,
    compact_test,
    damage_of,
    open_test,
    reopen_test,
    seal_description,
    seal_test,
)
from rigapp.storage.reading import seal
from rigapp.storage.upkeep import compact


def sealed(folder: Path) -> Path:
    """Return a test that was ended, compressed and sealed, writable."""
    path = ended(folder, 100)
    compact_test(path)
    path.chmod(0o644)
    return path


def faults(path: Path) -> list[str]:
    """Return what is not as it was sealed."""
    with open_test(path) as reader:
        return list(broken_seals(reader))


def with_new_checksums(file: h5py.File) -> None:
    """Make the checksums of all rows anew, as a forger would."""
    rows = file["/entry/revolutions"]
    with open_test(Path(file.filename)) as reader:
        names = list(reader.column_units())
    columns = [rows[name][:] for name in names]
    rows["checksum"][:] = [
        google_crc32c.value(b"".join(column[i].tobytes() for column in columns))
        for i in range(len(rows["checksum"]))
    ]


def scaled_force(file: h5py.File) -> None:
    file["/entry/revolutions/force_max"][:] *= 0.8
    with_new_checksums(file)


def cut_rows(file: h5py.File) -> None:
    file["/entry/revolutions/committed"][()] = 90


def cut_log(file: h5py.File) -> None:
    file["/entry/events/committed"][()] = 1


def other_setting(file: h5py.File) -> None:
    file["/entry/configuration/parameters/mechanism/crank_radius_mm"][()] = 80.0


def other_sample(file: h5py.File) -> None:
    file["/entry/cycles/force"][70] = 1.0


def other_reason(file: h5py.File) -> None:
    file["/entry/state/reason"][()] = b"something else"


CHANGES: list[tuple[Callable[[h5py.File], None], str]] = [
    (scaled_force, "the revolutions: not as they were sealed between the rows 0 and 99"),
    (cut_rows, "the revolutions: 100 rows were sealed, 90 are there"),
    (cut_log, "the log: 2 rows were sealed, 1 are there"),
    (other_setting, "the configuration: not as it was sealed"),
    (other_sample, "the complete cycles: not as they were sealed"),
    (other_reason, "how the test ended: not as it was sealed"),
]


@pytest.mark.sampled
@pytest.mark.parametrize(("change", "words"), CHANGES, ids=lambda one: getattr(one, "__name__", ""))
def test_the_part_that_was_changed_is_named(
    quick_folder: Path, change: Callable[[h5py.File], None], words: str
) -> None:
    path = sealed(quick_folder)
    assert faults(path) == []
    with h5py.File(path, "r+") as file:
        change(file)
    assert any(words in one for one in faults(path)), faults(path)


def test_a_seal_made_anew_differs_from_the_one_beside(quick_folder: Path) -> None:
    path = sealed(quick_folder)
    aside = quick_folder / "aside.json"
    shutil.copy(seal.beside(path), aside)
    with h5py.File(path, "r+") as file:
        scaled_force(file)
    with open_test(path) as reader:
        new = seal.make_seal(reader)
    with h5py.File(path, "r+") as file:
        del file["/entry/seal/seal"]
        file["/entry/seal/seal"] = seal.json_bytes(new).decode()
    assert damage_of(path) == []
    assert any("test.h5.seal.json: the revolutions: not as" in one for one in faults(path))
    seal.beside(path).unlink()
    assert faults(path) == [], "without the seal beside and a key nobody can tell"


@pytest.mark.long
@pytest.mark.parametrize("where", ['"leaves":["', '"public_key":"'])
def test_a_seal_with_a_digit_that_is_none_is_damaged(quick_folder: Path, where: str) -> None:
    path = sealed(quick_folder)
    beside = seal.beside(path)
    beside.chmod(0o644)
    beside.write_text(beside.read_text().replace(where, f"{where}g", 1))
    assert any("The seal is damaged" in one for one in faults(path)), faults(path)


def test_a_signed_seal_cannot_be_made_without_the_key(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    key = quick_folder / "seal-key.pem"
    key.write_bytes(
        Ed25519PrivateKey.generate().private_bytes(
            serialization.Encoding.PEM,
            serialization.PrivateFormat.PKCS8,
            serialization.NoEncryption(),
        )
    )
    key.chmod(0o600)
    monkeypatch.setattr(seal, "key_path", lambda: key)
    path = sealed(quick_folder)
    with open_test(path) as reader:
        assert "Sealed and signed" in seal_description(reader)
    assert faults(path) == []
    with h5py.File(path, "r+") as file:
        scaled_force(file)
        text = json.loads(file["/entry/seal/seal"][()])
    with open_test(path) as reader:
        parts = seal.parts_of(reader)
        root = seal.root_of(text["identifier"], parts)
    text |= {"root": root, "parts": json.loads(seal.json_bytes(parts))}
    with h5py.File(path, "r+") as file:
        del file["/entry/seal/seal"]
        file["/entry/seal/seal"] = json.dumps(text)
    seal.beside(path).unlink()
    assert faults(path) == ["Seal in the file: its signature does not hold."]


def test_a_stopped_test_is_sealed_as_it_stands_and_again_after_it_went_on(
    quick_folder: Path,
) -> None:
    path = ended(quick_folder, 60, status="stopped")
    end = Finished(FinishReason.OPERATOR, "enough", "stopped", 60, str(path))
    settle(end)
    assert seal.beside(path).is_file()
    assert faults(path) == []
    with open_test(path) as reader:
        assert not reader.compressed
        assert seal_description(reader).startswith("Sealed, not signed")
    with reopen_test(path) as writer:
        assert not seal.beside(path).exists(), "it is that of an end that is none any more"
        write(writer, 61, 80)
        assert not seal_test_quietly(path)
        writer.finish("stopped", "operator", "enough")
    settle(end)
    assert faults(path) == []
    path.chmod(0o644)
    with open_test(path) as reader:
        column = reader.stored_rows("/entry/revolutions/force_max", 0, 80)
    with h5py.File(path, "r+") as file:
        file["/entry/revolutions/force_max"][:80] = 0.8 * column
        with_new_checksums(file)
    assert any("the revolutions: not as they were sealed" in one for one in faults(path))


def seal_test_quietly(path: Path) -> bool:
    """Try to seal a test; False where it is refused."""
    try:
        return seal_test(path)
    except UnusableInput:
        return False


def test_a_seal_that_comes_when_the_test_goes_on_is_taken_back(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = ended(quick_folder, 30, status="stopped")

    def resumed_meanwhile(target: Path, made: seal.Seal) -> None:
        seal.write_beside(target, made)
        reopen_test(target).close()
        seal.write_beside(target, made)

    monkeypatch.setattr(compact, "write_beside", resumed_meanwhile)
    assert not seal_test(path)
    assert not seal.beside(path).exists()
