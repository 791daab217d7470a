"""Records stored per second, in place and by other methods, the same records in one run.

Run with ``python benchmarks/bench_storage.py [--seconds 3] [--folder DIR]``. A record is one
revolution: its row of statistics and, every tenth, its whole cycle of 3600 samples; a second table
is of the rows alone. All methods of a table store the same records, each for the same time, with a
commit once a second and a sync at the end: "taken" is the rate until then, "on disk" the rate with
that sync. The methods alternate, ROUNDS times; the tables show medians and the ratio to the
in-place file. PyMeasure and bluesky take part where they are installed.
"""

from __future__ import annotations

import argparse
import importlib.util
import os
import resource
import shutil
import tempfile
import threading
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, Protocol

import h5py
import numpy as np
from budgets import measured, size, skipped
from numpy.typing import NDArray

from rigapp.storage import FilePlan, TestMetadata, create_test, open_test

SAMPLES = 3600
EVERY = 10
ROUNDS = size(3, 1)
BATCH = 64
PLACE_S = 0.02
PACED_HZ = size(1000, 100)
METADATA = TestMetadata(title="benchmark", rig_text="", test_text="")
PLAN = FilePlan(revolutions=1, cycles=1, samples_per_cycle=SAMPLES, prediction=False)
ROW_NAMES = [column.name for column in PLAN.revolution_columns]
CYCLE_TYPES = {column.name: column.dtype for column in PLAN.cycle_columns}
ROW_BYTES = sum(np.dtype(column.dtype).itemsize for column in PLAN.revolution_columns)
CYCLE_BYTES = SAMPLES * sum(np.dtype(kind).itemsize for kind in CYCLE_TYPES.values())

Row = NDArray[np.float64]
Cycle = dict[str, NDArray[np.float32]]


class Way(Protocol):
    """A method of storing records."""

    def row(self, values: Row) -> None: ...

    def cycle(self, number: int, columns: Cycle) -> None: ...

    def commit(self) -> None: ...

    def close(self) -> None: ...


class InPlace:
    """Store in the file made beforehand; a thread places and commits, as in the engine."""

    def __init__(self, folder: Path, revolutions: int) -> None:
        plan = FilePlan(
            revolutions, revolutions // EVERY, SAMPLES,
            prediction=False, cycle_reason=True, checksums=True,
        )  # fmt: skip
        self.path = folder / "in-place.h5"
        self._writer = create_test(self.path, plan, METADATA)
        self.row = self._writer.append_row
        self.cycle = self._writer.append_cycle
        self._due = threading.Event()
        self._ended = False
        self._thread = threading.Thread(target=self._commit_when_due, name="committer")
        self._thread.start()

    def commit(self) -> None:
        self._due.set()

    def close(self) -> None:
        self._ended = True
        self._due.set()
        self._thread.join()
        self._writer.close()
        self.bytes_written = self._writer.bytes_written

    def _commit_when_due(self) -> None:
        while not self._ended:
            if self._due.wait(PLACE_S):
                self._due.clear()
                self._writer.commit()
            else:
                self._writer.place()


class Columns:
    """Store with h5py, one resizable dataset a column, resized for every revolution."""

    def __init__(self, folder: Path, revolutions: int) -> None:
        self._file = h5py.File(folder / "columns.h5", "w")
        self._rows = [_growing(self._file, f"rows/{name}", "<f8", 4096) for name in ROW_NAMES]
        self._cycles = {
            name: _growing(self._file, f"cycles/{name}", dtype, 16384)
            for name, dtype in CYCLE_TYPES.items()
        }

    def row(self, values: Row) -> None:
        for dataset, value in zip(self._rows, values, strict=True):
            size = dataset.shape[0]
            dataset.resize(size + 1, axis=0)
            dataset[size] = value

    def cycle(self, number: int, columns: Cycle) -> None:
        for name, dataset in self._cycles.items():
            size = dataset.shape[0]
            dataset.resize(size + SAMPLES, axis=0)
            dataset[size:] = columns[name]

    def commit(self) -> None:
        self._file.flush()

    def close(self) -> None:
        name = self._file.filename
        self._file.close()
        _sync(Path(name))


class Table(Columns):
    """Store with h5py at its best: one compound table, 64 rows at a time, SWMR."""

    def __init__(self, folder: Path, revolutions: int) -> None:
        self._file = h5py.File(folder / "table.h5", "w", libver="latest")
        self._table = self._file.create_dataset(
            "rows", (0,), np.dtype([(name, "<f8") for name in ROW_NAMES]), maxshape=(None,),
            chunks=(1024,),
        )  # fmt: skip
        self._cycles = {
            name: _growing(self._file, f"cycles/{name}", dtype, 16384)
            for name, dtype in CYCLE_TYPES.items()
        }
        self._file.swmr_mode = True
        self._batch = np.zeros(BATCH, self._table.dtype)
        self._flat = self._batch.view("<f8").reshape(BATCH, len(ROW_NAMES))
        self._fill = 0

    def row(self, values: Row) -> None:
        self._flat[self._fill] = values
        self._fill += 1
        if self._fill == BATCH:
            self._append()

    def commit(self) -> None:
        self._append()
        self._file.flush()

    def close(self) -> None:
        self._append()
        super().close()

    def _append(self) -> None:
        size = self._table.shape[0]
        self._table.resize(size + self._fill, axis=0)
        self._table[size:] = self._batch[: self._fill]
        self._fill = 0


class PyMeasureCsv:
    """Store as PyMeasure does: its CSV formatter and log file handlers, a line a row or sample."""

    def __init__(self, folder: Path, revolutions: int) -> None:
        import logging

        from pymeasure.experiment.results import CSVFormatter

        self._handlers = []
        for name, columns in (("rows", ROW_NAMES), ("cycles", list(CYCLE_TYPES))):
            handler = logging.FileHandler(folder / f"pymeasure-{name}.csv")
            handler.setFormatter(CSVFormatter(columns=columns))
            self._handlers.append(handler)

    def row(self, values: Row) -> None:
        # Its recorder hands dictionaries to the handler as well.
        self._handlers[0].emit(dict(zip(ROW_NAMES, values.tolist(), strict=True)))

    def cycle(self, number: int, columns: Cycle) -> None:
        for sample in zip(*(column.tolist() for column in columns.values()), strict=True):
            self._handlers[1].emit(dict(zip(columns, sample, strict=True)))

    def commit(self) -> None:
        for handler in self._handlers:
            handler.flush()

    def close(self) -> None:
        for handler in self._handlers:
            handler.close()
            _sync(Path(handler.baseFilename))


class BlueskyJson:
    """Store as bluesky does: event documents as JSON lines, a cycle as one of arrays."""

    def __init__(self, folder: Path, revolutions: int) -> None:
        from bluesky.callbacks.json_writer import JSONLinesWriter

        self._folder = folder
        self._write = JSONLinesWriter(str(folder), "bluesky.jsonl")
        self._write("start", {"uid": "run", "time": 0.0})
        self._number = 0

    def row(self, values: Row) -> None:
        self._event("rows", dict(zip(ROW_NAMES, values.tolist(), strict=True)))

    def cycle(self, number: int, columns: Cycle) -> None:
        self._event("cycles", {name: values.tolist() for name, values in columns.items()})

    def _event(self, descriptor: str, data: dict[str, Any]) -> None:
        self._number += 1
        stamps = dict.fromkeys(data, 0.0)
        about = {"uid": str(self._number), "descriptor": descriptor, "seq_num": self._number}
        event = {**about, "time": 0.0, "data": data, "timestamps": stamps, "filled": {}}
        self._write("event", event)

    def commit(self) -> None:
        return

    def close(self) -> None:
        _sync(self._folder / "bluesky.jsonl")


WAYS: dict[str, tuple[Callable[[Path, int], Way], str]] = {
    "in place": (InPlace, ""),
    "h5py, compound table, SWMR, 64 rows a time": (Table, ""),
    "h5py, one dataset a column, resized": (Columns, ""),
    "PyMeasure CSV recorder": (PyMeasureCsv, "pymeasure"),
    "bluesky, JSON lines": (BlueskyJson, "bluesky"),
}


GOALS = (
    (2, "h5py, compound table, SWMR, 64 rows a time"),
    (2, "h5py, one dataset a column, resized"),
    (4, "PyMeasure CSV recorder"),
    (100, "bluesky, JSON lines"),
)
"""Required ratio of records per second of the in-place file to each peer."""


def store(
    way: Way, seconds: float, most: int, every: int
) -> tuple[int, float, float, NDArray[np.int64]]:
    """Store records for a time; return their number, the time, that with the last sync, calls."""
    values = np.arange(len(ROW_NAMES), dtype=np.float64)
    noise = np.random.default_rng(1).normal(0.0, 50.0, SAMPLES)
    columns = {name: noise.astype(dtype) for name, dtype in CYCLE_TYPES.items()}
    calls = np.empty(most + most // EVERY + 1, np.int64)
    clock = time.perf_counter_ns
    start = clock()
    end, due = start + int(seconds * 1e9), start + 1_000_000_000
    number = call = 0
    before = start
    while before < end and number < most:
        number += 1
        values[0] = number
        before = clock()
        way.row(values)
        calls[call] = clock() - before
        call += 1
        if number % every == 0:
            before = clock()
            way.cycle(number, columns)
            calls[call] = clock() - before
            call += 1
        if before > due:
            way.commit()
            due += 1_000_000_000
    taken = clock() - start
    way.close()
    return number, taken / 1e9, (clock() - start) / 1e9, calls[:call]


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=size(100, 2) / 100)
    parser.add_argument("--folder", type=Path, default=None, help="on the disk to be measured")
    parser.add_argument(
        "--rows", type=int, default=size(1_000_000, 20_000), help="of the test of memory"
    )
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=options.folder) as name:
        compare(Path(name), options.seconds, cycles=True)
        compare(Path(name), options.seconds, cycles=False)
        compare_checksums(Path(name))
        time_calls(Path(name), 4.0 * options.seconds)
        watch_memory(Path(name), options.rows)
        count_pages(Path(name))


def compare(folder: Path, seconds: float, cycles: bool) -> None:
    """Alternate the methods; print records per second, ratios, calls and bytes."""
    every = EVERY if cycles else 1 << 62
    free = shutil.disk_usage(folder).free
    most = int(min(80_000 * seconds, free / 4 / (CYCLE_BYTES / EVERY)))
    rates: dict[str, list[tuple[float, float]]] = {}
    calls: list[NDArray[np.int64]] = []
    amplification = 0.0
    for _ in range(ROUNDS):
        for name, (make, package) in WAYS.items():
            if package and not _present(package):
                continue
            way = make(folder, most)
            number, taken, synced, times = store(way, seconds, most, every)
            rates.setdefault(name, []).append((number / taken, number / synced))
            if isinstance(way, InPlace):
                calls.append(times)
                payload = number * ROW_BYTES + number // every * CYCLE_BYTES
                amplification = max(amplification, way.bytes_written / payload)
                with open_test(way.path) as reader:
                    assert reader.committed() == number
            for path in folder.iterdir():
                path.unlink()
    own = np.median(rates["in place"], axis=0)
    what = "row, every tenth a whole cycle" if cycles else "row only"
    print(f"{f'records a second ({what})':<48}{'taken':>10}{'ratio':>8}{'on disk':>10}{'ratio':>8}")
    for name, (_, package) in WAYS.items():
        if name in rates:
            rate = np.median(rates[name], axis=0)
            pairs = zip(rate, rate / own, strict=True)
            print(
                f"{name:<48}" + "".join(f"{value:>10,.0f}{share:>8.3f}" for value, share in pairs)
            )
        else:
            skipped(f"storing by {name}", f"{package} is not installed")
    _judge_peers(rates)
    if cycles:
        peers = [np.median([rate for rate, _ in rates[name]]) for name in rates if "h5py" in name]
        measured("store", float(own[0]), "best h5py", float(own[0] / max(peers)))
        measured("store_peer", float(own[0] / max(peers)))
    times = np.concatenate(calls) / 1e3
    print(f"in place, one call of a flood: median {np.median(times):.1f} us,", end="")
    print(
        f" 99 % {_part(times, 99)}, 99.9 % {_part(times, 99.9)}, longest {times.max() / 1e3:.1f} ms"
    )
    print(f"in place, bytes written per byte of payload: {amplification:.4f} (goal 1.05)\n")


def _judge_peers(rates: dict[str, list[tuple[float, float]]]) -> None:
    """Print the ratio of the in-place file's records per second to each peer's, with the goals."""
    own = float(np.median([taken for taken, _ in rates["in place"]]))
    for goal, name in GOALS:
        if name not in rates:
            print(f"in place against {name}: not measured here (goal {goal})")
            continue
        ratio = own / float(np.median([taken for taken, _ in rates[name]]))
        print(f"in place against {name}: {ratio:.1f} times (goal {goal})")


def compare_checksums(folder: Path) -> None:
    """Print the cost of placing a row and a whole cycle, with and without checksums.

    Least processor time of many alternating rounds: other programs of this computer only add.
    """
    values = np.arange(len(ROW_NAMES), dtype=np.float64)
    noise = np.random.default_rng(1).normal(0.0, 50.0, SAMPLES)
    columns = {name: noise.astype(dtype) for name, dtype in CYCLE_TYPES.items()}
    rounds, rows, cycles = size(60, 2), 1024, 16
    least = {(checksums, what): np.inf for checksums in (False, True) for what in ("row", "cycle")}
    writers = {
        checksums: create_test(
            folder / f"checksums-{checksums}.h5",
            FilePlan(
                rounds * rows, rounds * cycles, SAMPLES,
                prediction=False, cycle_reason=True, checksums=checksums,
            ),
            METADATA,
        )
        for checksums in (False, True)
    }  # fmt: skip
    for _ in range(rounds):
        for checksums, writer in writers.items():
            calls: dict[str, tuple[int, Callable[[], object]]] = {
                "row": (rows, partial(writer.append_row, values)),
                "cycle": (cycles, partial(writer.append_cycle, 1, columns)),
            }
            for what, (number, call) in calls.items():
                begin = time.thread_time_ns()
                for _ in range(number):
                    call()
                writer.place()
                spent = (time.thread_time_ns() - begin) / number / 1e3
                least[checksums, what] = min(least[checksums, what], spent)
    for writer in writers.values():
        writer.discard()
    for what in ("row", "cycle"):
        without, with_them = least[False, what], least[True, what]
        print(f"one {what}: {without:.2f} us without checksums, {with_them:.2f} us with them")
    print()


def time_calls(folder: Path, seconds: float) -> None:
    """Store at a realistic rate; print the cost of one call to the calling thread.

    Processor time of the calling thread excludes other programs on this computer.
    """
    wall: list[int] = []
    spent: list[int] = []
    rows = int(seconds * PACED_HZ)
    way = InPlace(folder, rows)
    values = np.arange(len(ROW_NAMES), dtype=np.float64)
    noise = np.random.default_rng(1).normal(0.0, 50.0, SAMPLES)
    columns = {name: noise.astype(dtype) for name, dtype in CYCLE_TYPES.items()}
    pace = threading.Event()
    start = time.perf_counter()
    for number in range(1, rows + 1):
        values[0] = number
        for call in (partial(way.row, values), partial(way.cycle, number, columns)):
            if call.func == way.cycle and number % EVERY:
                continue
            before, cpu = time.perf_counter_ns(), time.thread_time_ns()
            call()
            spent.append(time.thread_time_ns() - cpu)
            wall.append(time.perf_counter_ns() - before)
        if number % PACED_HZ == 0:
            way.commit()
        pace.wait(max(0.0, start + number / PACED_HZ - time.perf_counter()))
    way.close()
    way.path.unlink()
    for name, seconds in (("processor time", spent), ("elapsed", wall)):
        times = np.array(seconds) / 1e3
        print(
            f"in place at {PACED_HZ} rev/s, one call, {name}: median {np.median(times):.1f} us,",
            end="",
        )
        print(f" 99 % {_part(times, 99)}, 99.9 % {_part(times, 99.9)}")
    measured("store_call", float(np.percentile(np.array(spent) / 1e3, 99.9)))


def watch_memory(folder: Path, rows: int) -> None:
    """Store rows only, committing every 20,000; print the growth of the peak memory."""
    plan = FilePlan(rows, 0, 0, prediction=False)
    values = np.arange(len(ROW_NAMES), dtype=np.float64)
    with create_test(folder / "memory.h5", plan, METADATA) as writer:
        peak = 0
        start = time.perf_counter()
        for number in range(1, rows + 1):
            values[0] = number
            writer.append_row(values)
            if number % 20_000 == 0:
                writer.commit()
            if number == rows // 10:
                peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        took = time.perf_counter() - start
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - peak
    print(f"in place, {rows:,} rows without cycles: {rows / took:,.0f} per s, ", end="")
    print(f"peak of memory grew by {grown / 1024:.1f} MB after the first tenth")
    (folder / "memory.h5").unlink()


def count_pages(folder: Path) -> None:
    """Commit single rows, as a slow test does; print the pages written to the disk."""
    commits = 30
    with create_test(
        folder / "slow.h5", FilePlan(1000, 0, 0, prediction=False), METADATA
    ) as writer:
        before, start = _disk_bytes(), time.perf_counter()
        for number in range(commits):
            writer.append_row(np.full(len(ROW_NAMES), float(number)))
            writer.commit()
        took = (time.perf_counter() - start) / commits
    written = (_disk_bytes() - before) / commits
    print(f"in place, a commit of one row ({ROW_BYTES} bytes): ", end="")
    print(f"{took * 1e3:.1f} ms, {written / 1024:.0f} kB of disk pages")


def _growing(file: h5py.File, name: str, dtype: str, chunk: int) -> h5py.Dataset:
    return file.create_dataset(name, (0,), dtype, maxshape=(None,), chunks=(chunk,))


def _present(package: str) -> bool:
    return importlib.util.find_spec(package) is not None


def _part(times: NDArray[np.float64], percent: float) -> str:
    return f"{np.percentile(times, percent):.0f} us"


def _disk_bytes() -> int:
    lines = Path("/proc/self/io").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith("write_bytes"))


def _sync(path: Path) -> None:
    fd = os.open(path, os.O_RDONLY)
    os.fsync(fd)
    os.close(fd)


if __name__ == "__main__":
    main()
