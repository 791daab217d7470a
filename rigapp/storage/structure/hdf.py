"""Open an HDF5 file from any source for reading; refuse malicious content.

A file from elsewhere may be malicious: HDF5 reads other files of the computer where a dataset or a
link points to them, and loads a plug-in for an unknown filter. Nothing of a file is read before
``refuse_traps`` has checked each of its objects.
"""

from __future__ import annotations

import contextlib
import stat
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import h5py
from h5py import h5a, h5d, h5g, h5l, h5o, h5t, h5z

from rigapp.config.errors import UnusableInput
from rigapp.texts import say

NOT_A_VARIABLE = "This is a netCDF dimension but not a netCDF variable. "
"""Mark of netCDF for a dimension without coordinates; its length follows in ten characters."""


OWN_FILTERS = frozenset((h5z.FILTER_DEFLATE, h5z.FILTER_SHUFFLE, h5z.FILTER_FLETCHER32))
"""Filters that this program writes, all of them within HDF5."""
MAX_OBJECTS = 10_000
"""Maximum number of groups and datasets in a file; one of the simulated rig has 366."""
MAX_EXPANSION = 200
"""Maximum expansion factor of compressed data. Tests of the simulated rig have 1, one of 20,000
revolutions with identical rows 25; the filter itself could reach 1,032."""
SMALL = 1 << 20
"""Size in bytes up to which a dataset is harmless at any expansion factor."""


def open_for_reading(path: Path) -> h5py.File:
    """Open a file that reads no other file; raises OSError, UnusableInput."""
    if path.exists() and not stat.S_ISREG(path.stat().st_mode):
        raise UnusableInput("{}: this is no file but a device or a pipe; give a test file", path)
    file = _opened(path)
    try:
        refuse_traps(path, file)
    except BaseException:
        file.close()
        raise
    return file


def _opened(path: Path) -> h5py.File:
    """Open a file as HDF5; raises OSError.

    HDF5's own default of locking is tried first; the others serve file systems without locks, and
    files that this process already has open with another setting: all must agree.
    """
    for locking in (None, False):
        try:
            return h5py.File(path, "r", locking=locking)
        except OSError as error:
            if "lock" not in str(error):
                raise
    return h5py.File(path, "r", locking=True)


@dataclass(frozen=True, slots=True)
class _Link:
    """The kind of a link and the address of its target."""

    kind: int
    address: int


def refuse_traps(path: Path, file: h5py.File) -> None:
    """Raise UnusableInput where an object refers to another file or expands excessively."""
    with refuse_damage(path, say("its tree")):
        trap = _first_trap(file, path.stat().st_size)
    if trap:
        raise UnusableInput(
            "{}: {}; rigapp writes no such file: do not use it, and ask who sent it", path, trap
        )


def _first_trap(file: h5py.File, size: int) -> str:
    """Return the problem of the first object that a test cannot have, else an empty text."""
    seen = {h5o.get_info(file.id).addr}
    waiting: list[tuple[bytes, h5g.GroupID]] = [(b"", file.id)]
    claimed = 0
    while waiting:
        above, group = waiting.pop()
        for name, link in _links(group):
            path = above + b"/" + name
            if link.kind != h5l.TYPE_HARD:
                return say("{} is a link to another place", _shown(path))
            if link.address in seen:
                return say("{} is in two places", _shown(path))
            seen.add(link.address)
            if len(seen) > MAX_OBJECTS:
                return say("it has more than {} groups and datasets", MAX_OBJECTS)
            # A damaged object is harmless here: reading it raises an error.
            with contextlib.suppress(OSError, RuntimeError, LookupError, ValueError, TypeError):
                item = h5o.open(group, name)
                if odd := _odd_attribute(item):
                    return say("{} of {} is a list of lists", _shown(odd), _shown(path))
                if isinstance(item, h5g.GroupID):
                    waiting.append((path, item))
                elif isinstance(item, h5d.DatasetID):
                    length = item.get_space().get_simple_extent_npoints()
                    length *= item.get_type().get_size()
                    if trap := _trap(item, length):
                        return say("{} {}", _shown(path), trap)
                    claimed += length if item.get_storage_size() else 0
    if claimed > MAX_EXPANSION * size + SMALL:
        return say("its {:.1f} MB would become {:.0f} MB", 1e-6 * size, 1e-6 * claimed)
    return ""


def _links(group: h5g.GroupID) -> list[tuple[bytes, _Link]]:
    """Return the links of a group with their kinds, up to the first damaged one."""
    result: list[tuple[bytes, _Link]] = []
    with contextlib.suppress(OSError, RuntimeError):
        group.links.iterate(
            lambda name, info: result.append((name, _Link(info.type, info.u))), info=True
        )
    return result


def _shown(path: bytes) -> str:
    return path.decode(errors="replace")


def _odd_attribute(item: h5o.ObjectID) -> bytes:
    """Return the name of an attribute whose content may crash HDF5, else nothing.

    Where one flipped bit turns a text into a list of lists, the library uses letters as addresses.
    """
    for number in range(h5a.get_num_attrs(item)):
        attribute = h5a.open(item, index=number)
        kind = attribute.get_type()
        if kind.get_class() == h5t.VLEN and kind.get_super().get_class() != h5t.REFERENCE:
            return bytes(attribute.name)
    return b""


def _trap(dataset: h5d.DatasetID, length: int) -> str:
    """Return why reading ``length`` bytes of a dataset is harmful, else an empty text."""
    made = dataset.get_create_plist()
    layout = made.get_layout()
    if layout == h5d.VIRTUAL:
        return say("is made of values of other files")
    if layout == h5d.CHUNKED:
        filters = {made.get_filter(number)[0] for number in range(made.get_nfilters())}
        if foreign := sorted(filters - OWN_FILTERS):
            return say("needs the filter {}", foreign[0])
    elif made.get_external_count():
        return say("has its values in another file")
    if dataset.get_type().get_class() == h5t.VLEN:
        return say("is a list of lists")
    if length > SMALL and dataset.get_storage_size() == 0 and not is_bare(h5py.Dataset(dataset)):
        return say("claims {:.0f} MB and has none", 1e-6 * length)
    return ""


@contextlib.contextmanager
def refuse_damage(path: Path, what: str) -> Iterator[None]:
    """Convert errors of a block that reads a damaged file into UnusableInput.

    what: the part of the file. HDF5 and NumPy raise many kinds of error, depending on the damage.
    """
    try:
        yield
    except (OSError, RuntimeError, LookupError, ValueError, TypeError, MemoryError) as error:
        raise UnusableInput(
            "{}: the file is damaged, {} cannot be read ‹{}›; take a copy made before,"
            " and check the disk",
            path,
            what,
            error,
        ) from error


def is_bare(dataset: h5py.Dataset) -> bool:
    """Return whether a dataset is a dimension without coordinates."""
    name = dataset.attrs.get("NAME", b"")
    return bool(name.startswith(NOT_A_VARIABLE.encode()))
