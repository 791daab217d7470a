"""A file that somebody sent may be made to harm: it is refused before anything of it is read."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import h5py
import msgspec
import numpy as np
import pytest
from commandline import rigapp as run_verb
from storage_samples import ended

import rigapp
from rigapp.config.errors import UnusableInput
from rigapp.storage import compact_test, open_for_reading, open_test, reopen_test
from rigapp.storage.structure.hdf import MAX_OBJECTS
from rigapp.storage.structure.layout import PLAN

SECRET = b"-----BEGIN PRIVATE KEY----- 31415926535897932384626433832795"
Trap = Callable[[h5py.File, Path], None]
FORCE = "/entry/revolutions/force_max"
SENT = "ask who sent it"


def in_place_of(file: h5py.File, path: str) -> tuple[h5py.Group, str, int]:
    """Take a dataset out; return its group, its name and its length."""
    group, name = file[path].parent, path.rpartition("/")[2]
    length = len(file[path]) if file[path].shape else 1
    del group[name]
    return group, name, length


def external_storage(file: h5py.File, secret: Path) -> None:
    group, name, _ = in_place_of(file, "/entry/title")
    group.create_dataset(name, (1,), f"S{len(SECRET)}", external=[(str(secret), 0, len(SECRET))])


def external_numbers(file: h5py.File, secret: Path) -> None:
    group, name, length = in_place_of(file, FORCE)
    group.create_dataset(name, (length,), "u1", external=[(str(secret), 0, length)])


def external_pipe(file: h5py.File, secret: Path) -> None:
    os.mkfifo(secret.with_name("pipe"))
    external_numbers(file, secret.with_name("pipe"))


def external_link(file: h5py.File, secret: Path) -> None:
    with h5py.File(secret.with_name("other.h5"), "w") as other:
        other["title"] = SECRET
    group, name, _ = in_place_of(file, "/entry/title")
    group[name] = h5py.ExternalLink(str(secret.with_name("other.h5")), "/title")


def link_beside_the_data(file: h5py.File, secret: Path) -> None:
    file["/entry/configuration/more"] = h5py.ExternalLink(str(secret.with_name("other.h5")), "/")


def soft_link(file: h5py.File, secret: Path) -> None:
    file["/entry/configuration/more"] = h5py.SoftLink("/entry/title")


def virtual_dataset(file: h5py.File, secret: Path) -> None:
    with h5py.File(secret.with_name("other.h5"), "w") as other:
        other["numbers"] = np.frombuffer(SECRET, "u1")
    group, name, length = in_place_of(file, FORCE)
    layout = h5py.VirtualLayout((length,), "u1")
    source = h5py.VirtualSource(str(secret.with_name("other.h5")), "numbers", (len(SECRET),))
    layout[: len(SECRET)] = source
    group.create_virtual_dataset(name, layout)


def swelling(file: h5py.File, secret: Path) -> None:
    group, name, _ = in_place_of(file, FORCE)
    rows = 3_000_000_000
    bomb = group.create_dataset(name, (rows,), "<f4", chunks=(1_000_000,), compression="gzip")
    bomb[:1_000_000] = 0.0


def claims_what_it_has_not(file: h5py.File, secret: Path) -> None:
    group, name, _ = in_place_of(file, FORCE)
    group.create_dataset(name, (3_000_000_000,), "<f4", chunks=(1000,))


def foreign_filter(file: h5py.File, secret: Path) -> None:
    group, name, length = in_place_of(file, FORCE)
    group.create_dataset(name, (length,), "<f4", chunks=(length,), compression="lzf")


def circle(file: h5py.File, secret: Path) -> None:
    file["/entry/configuration/again"] = file["/entry"]


def twice(file: h5py.File, secret: Path) -> None:
    file["/entry/configuration/again"] = file["/entry/title"]


def crowd(file: h5py.File, secret: Path) -> None:
    group = file.create_group("/entry/crowd")
    for number in range(MAX_OBJECTS + 1):
        group.create_group(str(number))


def renamed(file: h5py.File, name: str) -> None:
    plan = msgspec.json.decode(file[PLAN][()])
    for kind in ("revolution_columns", "cycle_columns"):
        for one in plan[kind]:
            if one["name"] in ("force_max", "force"):
                group = file[f"/entry/{'revolutions' if kind[0] == 'r' else 'cycles'}"]
                if "/" not in name:
                    group.move(one["name"], name)
                one["name"] = name
    text = msgspec.json.encode(plan)
    group, last, _ = in_place_of(file, PLAN)
    group[last] = text.decode()


def formula(file: h5py.File, secret: Path) -> None:
    renamed(file, '=HYPERLINK("http://example.org","click")')


def markup(file: h5py.File, secret: Path) -> None:
    renamed(file, "<script>alert(1)<|script>")


def way_out(file: h5py.File, secret: Path) -> None:
    renamed(file, "../configuration/rig")


TRAPS: dict[str, Trap] = {
    one.__name__: one
    for one in (
        external_storage,
        external_numbers,
        external_pipe,
        external_link,
        link_beside_the_data,
        soft_link,
        virtual_dataset,
        swelling,
        claims_what_it_has_not,
        foreign_filter,
        circle,
        twice,
        crowd,
        formula,
        markup,
        way_out,
    )
}


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a finished, compressed test."""
    path = ended(tmp_path_factory.mktemp("whole"), 60)
    compact_test(path)
    return path


@pytest.fixture
def finished(whole: Path, tmp_path: Path) -> Path:
    """Return a copy of it that may be spoilt."""
    return Path(shutil.copy(whole, tmp_path / "test.h5"))


def sent(path: Path, trap: Trap) -> Path:
    """Return the file with a trap in it, and a secret beside it."""
    secret = path.with_name("key.pem")
    secret.write_bytes(SECRET * 20)
    copy = path.with_name("sent.h5")
    shutil.copy(path, copy)
    with h5py.File(copy, "r+") as file:
        trap(file, secret)
    return copy


@pytest.mark.sampled(every=3)
@pytest.mark.parametrize("trap", TRAPS.values(), ids=TRAPS)
def test_a_trap_is_refused_before_anything_is_read(finished: Path, trap: Trap) -> None:
    path = sent(finished, trap)
    with pytest.raises(UnusableInput, match=SENT) as refused:
        open_test(path)
    assert str(path) in str(refused.value)
    assert "PRIVATE" not in str(refused.value)


@pytest.mark.parametrize("trap", [external_storage, virtual_dataset], ids=lambda one: one.__name__)
def test_no_way_in_reads_another_file(finished: Path, trap: Trap, tmp_path: Path) -> None:
    path = sent(finished, trap)
    made = tmp_path / "made"
    made.mkdir()
    for words in (
        ("info", path),
        ("info", path, "--verify"),
        ("export", path, "--to", made / "rows.csv"),
        ("export", path, "--cycles", "--to", made / "cycles.csv"),
        ("report", path, "--to", made / "report.html"),
        ("package", path, "--to", made / "package.zip"),
        ("identify", path),
        ("resume", path, "--rig", Path("examples/simulated.toml").absolute()),
        ("compact", path),
    ):
        done = run_verb(*words)
        said = done.stdout + done.stderr
        assert done.returncode not in (0, 70), (words, said)
        assert "PRIVATE" not in said
        assert "Traceback" not in said
    assert not any(made.iterdir())
    with pytest.raises(UnusableInput, match=SENT):
        rigapp.open(path).revolutions  # noqa: B018
    with pytest.raises(UnusableInput, match=SENT):
        reopen_test(path)


def test_what_this_program_writes_is_no_trap(quick_folder: Path) -> None:
    path = ended(quick_folder, 60)
    open_for_reading(path).close()
    compact_test(path)
    open_for_reading(path).close()


def test_a_pipe_is_no_file(quick_folder: Path) -> None:
    path = quick_folder / "pipe.h5"
    os.mkfifo(path)
    with pytest.raises(UnusableInput, match="a device or a pipe"):
        open_for_reading(path)


def test_one_door_opens_files_for_reading() -> None:
    root = Path(rigapp.__file__).parent
    found = {
        str(path.relative_to(root))
        for path in root.rglob("*.py")
        if "h5py.File(" in path.read_text("utf-8")
    }
    assert found == {
        "storage/structure/hdf.py",
        "storage/structure/build.py",
        "storage/upkeep/duplicate.py",
    }
