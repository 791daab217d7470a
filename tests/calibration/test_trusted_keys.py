"""A rig file that names the keys it trusts uses no record that none of them signed."""

from __future__ import annotations

import json
import os
import shutil
from pathlib import Path

import pytest
from commandline import rigapp

from rigapp.calibrating.records_in_use import with_records
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import RigRecords, read_rig
from rigapp_calibration.records import Signature, seal

EXAMPLES = Path(__file__).parents[2] / "examples"
TRUST = '[records]\ntrusted_keys = ["keys/lab.pub"]\n'


@pytest.fixture(scope="module")
def signed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with a signed record, one without, and one signed by somebody else."""
    tmp_path = tmp_path_factory.mktemp("signed")
    (tmp_path / "keys").mkdir()
    readings, settings = (EXAMPLES / "calibration" / f"load_cell.{one}" for one in ("csv", "toml"))
    done = rigapp(
        "calibrate", "load-cell", "--readings", readings, "--settings", settings,
        "--to", tmp_path / "plain.json",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    for name in ("lab", "other"):
        rigapp("calibrate", "key", "--to", tmp_path / "keys" / f"{name}.key")
        rigapp(
            "calibrate", "sign", tmp_path / "plain.json",
            "--key", tmp_path / "keys" / f"{name}.key", "--to", tmp_path / f"{name}.json",
        )  # fmt: skip
    return tmp_path


@pytest.fixture
def folder(signed: Path, tmp_path: Path) -> Path:
    """Return a copy of that folder."""
    return Path(shutil.copytree(signed, tmp_path, dirs_exist_ok=True))


def rig(folder: Path, record: str, more: str = "", trust: str = TRUST) -> RigRecords:
    text = (EXAMPLES / "simulated.toml").read_text()
    head, tail = text.split("[probes]")
    path = folder / "rig.toml"
    path.write_text(f'{head}calibration = "{record}"\n{more}{trust}[probes]{tail}')
    return with_records(read_rig(path))


def test_who_signed_is_said(folder: Path) -> None:
    found = rig(folder, "lab.json")
    assert not found.blocking
    assert "signed by lab (" in found.remarks["load_cell"]
    unnamed = rig(folder, "lab.json", trust="")
    assert "signed by an unknown key (" in unnamed.remarks["load_cell"]
    assert not rig(folder, "plain.json", trust="").blocking


@pytest.mark.sampled
@pytest.mark.parametrize(
    ("record", "words"),
    [("plain.json", "is not signed"), ("other.json", "that the rig file does not trust")],
)
def test_a_foreign_or_stripped_signature_blocks_unless_overridden(
    folder: Path, record: str, words: str
) -> None:
    assert words in rig(folder, record).blocking["load_cell"]
    overridden = rig(folder, record, 'calibration_override = "the laboratory moves"\n')
    assert not overridden.blocking
    assert words in overridden.remarks["load_cell"]
    assert "the laboratory moves" in overridden.remarks["load_cell"]


def test_a_signature_of_an_older_record_blocks(folder: Path) -> None:
    """The signature of one record under the content of another one."""
    signed, other = folder / "lab.json", folder / "pasted.json"
    content = json.loads(signed.read_text())
    stated = content.pop("signature")
    for key in ("digest", "number"):
        content.pop(key)
    content["recorded_at"] = "2020-01-01T00:00:00Z"
    other.write_bytes(seal(content, Signature(stated["public_key"], stated["value"])))
    assert "signature does not hold" in rig(folder, "pasted.json").blocking["load_cell"]


def test_a_key_that_cannot_be_read_is_named(folder: Path) -> None:
    with pytest.raises(UnusableInput, match=r"trusted_keys = 'keys/none\.pub'"):
        rig(folder, "lab.json", trust=TRUST.replace("lab.pub", "none.pub"))
    shutil.copy(folder / "keys" / "lab.key", folder / "keys" / "wrong.pub")
    os.chmod(folder / "keys" / "wrong.pub", 0o644)
    with pytest.raises(UnusableInput, match="no public key"):
        rig(folder, "lab.json", trust=TRUST.replace("lab.pub", "wrong.pub"))


@pytest.mark.long
def test_check_shows_who_signed(folder: Path) -> None:
    rig(folder, "lab.json")
    done = rigapp("check", folder / "rig.toml", EXAMPLES / "quick.toml")
    assert "signed by lab" in " ".join(done.stdout.split())
