"""Chunks that are compressed here are those that HDF5 would make, and HDF5 reads them."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest

from rigapp.storage.upkeep.duplicate import GZIP_LEVEL, fletcher32, write_chunks

ROWS, CHUNK = 1000, 128
TABLES = {
    "f8": np.linspace(-1.0, 1.0, ROWS),
    "i4": np.arange(ROWS, dtype="<i4") % 7,
    "u1": np.arange(ROWS * 9, dtype="|u1").reshape(ROWS, 9),
    "S5": np.array([b"%d" % number for number in range(ROWS)], "S5"),
    "f4": np.random.default_rng(1).normal(size=(ROWS, 3)).astype("<f4"),
    "zeros": np.zeros(ROWS),
}


@pytest.mark.parametrize("name", TABLES)
def test_hdf5_reads_what_was_compressed_here(tmp_path: Path, name: str) -> None:
    table = TABLES[name]
    with h5py.File(tmp_path / "file.h5", "w") as file:
        how = {"compression": "gzip", "compression_opts": GZIP_LEVEL, "shuffle": True}
        chunks = (CHUNK, *table.shape[1:])
        options = {**how, "chunks": chunks, "fletcher32": True}
        mine = file.create_dataset("mine", table.shape, table.dtype, **options)
        theirs = file.create_dataset("theirs", data=table, **options)
        write_chunks(mine, (table[row : row + 2 * CHUNK] for row in range(0, ROWS, 2 * CHUNK)), 2)
        assert mine[()].tobytes() == table.tobytes()
        for row in range(0, ROWS, CHUNK):
            offsets = (row, *(0,) * (table.ndim - 1))
            stored = [one.id.read_direct_chunk(offsets)[1] for one in (mine, theirs)]
            assert fletcher32(stored[1][:-4]) == int.from_bytes(stored[1][-4:], "little")
            assert fletcher32(stored[0][:-4]) == int.from_bytes(stored[0][-4:], "little")
