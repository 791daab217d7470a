"""Time and peak memory of each command on files of long tests of growing length.

Run with ``python benchmarks/bench_length.py [--rows 1e5 1e7] [--folder DIR] [--only VERB]``. The
files have every column, of the prediction too (``longtest.py``); 10^7 rows take 6 GB of disk, the
CSV of their package 6 GB more. Each command is a process of its own: its whole time, imports
included, and its largest resident memory. ``--docs`` puts table and picture into
docs/performance.md.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from budgets import BUDGETS, measured, size

RESUME = """
import sys, time
from pathlib import Path
from types import SimpleNamespace
from rigapp.engine.recording import store
from rigapp.schema.channels import BASE
from rigapp.service.resumption import read_past
path = Path(sys.argv[1])
begin = time.perf_counter()
read_past(path)
opened = store._resume(SimpleNamespace(path=path, calibration=SimpleNamespace(table=BASE)))
assert opened.depths(opened.rows - 1000).shape == (2, 1000)
assert sum(piece.shape[1] for piece in opened.history()) == opened.rows
opened.store.close()
print("resume", time.perf_counter() - begin)
"""
REPLAY = """
import os, sys, time
os.environ["QT_QPA_PLATFORM"] = "offscreen"
from pathlib import Path
from PySide6.QtWidgets import QApplication
from rigapp.gui.look.dress import apply_theme
from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import LIGHT
from rigapp.replay.client import ReplayClient
from rigapp.viewer.connection import EngineConnection
from rigapp.viewer.showntest import ShownTest
application = QApplication([])
apply_theme(application, LIGHT)
begin = time.perf_counter()
client = ReplayClient(Path(sys.argv[1]))
window = MainWindow(EngineConnection(lambda: client), ShownTest(), LIGHT)
window.resize(1440, 900)
window.show()

def reach(rows):
    seen = False
    while not (seen and window.settled):
        seen = window.settled and len(window._test.data.rows) >= rows
        if seen:
            window.draw_now()  # what is looked at for the first time is read then
        window.tick()
        application.processEvents()
        time.sleep(0.002)
    window.draw_now()
    application.processEvents()

reach(1)
last = client.last_recorded
worst = 0.0
client.request("pause")
for at, place in enumerate((last, last // 3, last // 2, last - 5, last // 7, last - 1)):
    if at:
        begin = time.perf_counter()
    client.request("seek", {"revolution": place})
    while len(window._test.data.rows) != place:
        window.tick()
        time.sleep(0.002)
    reach(place)
    if at == 0:
        print("open", time.perf_counter() - begin)  # all that is seen of beginning and end
    else:
        worst = max(worst, time.perf_counter() - begin)
print("seek", worst)
window.close()
"""
COMMAND = "import sys; from rigapp.__main__ import main; sys.exit(main())"


TOLD = ("resume", "open", "seek")
"""Times measured by the programs, without imports: the rig has made those before."""


@dataclass(frozen=True, slots=True)
class Verb:
    """One command: its program, its arguments after the file, its output."""

    program: str
    arguments: tuple[str, ...] = ()
    ended: bool = True


PAGE = Path(__file__).parents[1] / "docs" / "performance.md"
PICTURE = PAGE.parent / "images" / "length.svg"
TABLE_BEGINS, TABLE_ENDS = "<!-- cost against length -->\n", "<!-- end -->\n"

VERBS = {
    "resume": Verb(RESUME, ended=False),
    "replay": Verb(REPLAY),
    "picture": Verb(COMMAND, ("picture", "FILE", "--to", "out.png")),
    "report": Verb(COMMAND, ("report", "FILE", "--to", "out.html")),
    "export": Verb(COMMAND, ("export", "FILE", "--to", "out.csv")),
    "parquet": Verb(COMMAND, ("export", "FILE", "--to", "out.parquet")),
    "package": Verb(COMMAND, ("package", "FILE", "--to", "out.zip", "--allow-private")),
}


@dataclass(frozen=True, slots=True)
class Cost:
    """Cost of a command: wall-clock and processor seconds, peak memory in MB, its output."""

    seconds: float
    processor_s: float
    memory_MB: float
    told: dict[str, float]
    status: int


def cost_of(verb: Verb, path: Path, folder: Path) -> Cost:
    """Run a command on a file in a process of its own, in a folder that is emptied afterwards."""
    arguments = [str(path) if word == "FILE" else word for word in verb.arguments or ("FILE",)]
    command = [sys.executable, "-c", verb.program, *arguments]
    log = folder / "told.txt"
    begin = time.perf_counter()
    with log.open("w+", encoding="utf-8") as stream:
        child = subprocess.Popen(command, cwd=folder, stdout=stream, stderr=stream)
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        took = time.perf_counter() - begin
        stream.seek(0)
        lines = stream.read().splitlines()
    for path in folder.iterdir():
        path.unlink()
    if child.returncode:
        print("\n".join(lines[-5:]))
    words = [line.split() for line in lines]
    figures = {line[0]: float(line[1]) for line in words if len(line) == 2 and line[0] in TOLD}
    cpu = used.ru_utime + used.ru_stime
    return Cost(took, cpu, used.ru_maxrss / 1024, figures, child.returncode)


def main() -> None:
    """Print the table and the figures of the longest file."""
    parser = argparse.ArgumentParser(description=__doc__)
    lengths = size([1e4, 1e5, 1e6, 1e7], [2e3])
    usual = ["resume", "replay", "picture", "report"]
    parser.add_argument("--rows", type=float, nargs="+", default=lengths)
    parser.add_argument("--folder", type=Path, default=None, help="with room for the files")
    parser.add_argument("--only", nargs="+", choices=list(VERBS), default=usual)
    parser.add_argument("--docs", action="store_true", help="write table and picture of the docs")
    options = parser.parse_args()
    costs: dict[str, dict[int, Cost]] = {verb: {} for verb in options.only}
    print(f"{'verb':<10}{'rows':>12}{'s':>9}{'processor s':>13}{'MB':>8}")
    for rows in map(int, options.rows):
        with tempfile.TemporaryDirectory(dir=options.folder) as name:
            folder = Path(name) / "made"
            folder.mkdir()
            path = Path(name) / "long.h5"
            for ended in (False, True):
                verbs = [verb for verb in options.only if VERBS[verb].ended == ended]
                if not verbs:
                    continue
                path.unlink(missing_ok=True)
                # Its memory would count as the commands': they start as copies of this process.
                maker = [sys.executable, str(Path(__file__).with_name("longtest.py")), str(path)]
                subprocess.run([*maker, f"{rows}", "ended" if ended else ""], check=True)
                for verb in verbs:
                    cost = cost_of(VERBS[verb], path, folder)
                    show(verb, rows, cost)
                    costs[verb][rows] = cost
                    if rows == int(options.rows[-1]) and not cost.status:
                        compare(verb, cost)
    if options.docs:
        before, rest = PAGE.read_text("utf-8").split(TABLE_BEGINS)
        after = rest.partition(TABLE_ENDS)[2]
        PAGE.write_text(before + TABLE_BEGINS + table(costs) + TABLE_ENDS + after, "utf-8")
        draw(costs)


def table(costs: dict[str, dict[int, Cost]]) -> str:
    """Return processor time and peak memory of each command at each length, as Markdown."""
    lengths = sorted({rows for course in costs.values() for rows in course})
    lines = [
        "| revolutions | " + " | ".join(f"{rows:,}" for rows in lengths) + " |",
        "| --- |" + " --- |" * len(lengths),
    ]
    for verb, course in costs.items():
        cells = (f"{course[n].processor_s:.1f} s, {course[n].memory_MB:.0f} MB" for n in lengths)
        lines.append(f"| {verb} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def draw(costs: dict[str, dict[int, Cost]]) -> None:
    """Draw processor time and peak memory over the length, one named line per command."""
    from matplotlib.figure import Figure

    from rigapp.report.page.figures import in_style

    with in_style():
        figure = Figure(figsize=(7.0, 2.8), layout="constrained")
        values = {
            "processor time, s": lambda cost: cost.processor_s,
            "peak memory, MB": lambda cost: cost.memory_MB,
        }
        for axes, (title, value) in zip(figure.subplots(1, 2), values.items(), strict=True):
            for verb, course in costs.items():
                axes.plot(list(course), list(map(value, course.values())), "o-", label=verb)
            axes.set(xscale="log", xlabel="revolutions", ylabel=title)
            axes.set_ylim(bottom=0.0)
        axes.legend(loc="lower left")
        figure.savefig(PICTURE, metadata={"Date": None})


def show(verb: str, rows: int, cost: Cost) -> None:
    """Print a line of the table."""
    said = "".join(f"  {name} {value:.2f} s" for name, value in cost.told.items())
    failed = f"  FAILED with {cost.status}" if cost.status else ""
    print(
        f"{verb:<10}{rows:>12,}{cost.seconds:>9.1f}{cost.processor_s:>13.1f}{cost.memory_MB:>8.0f}"
        f"{said}{failed}",
        flush=True,
    )


def compare(verb: str, cost: Cost) -> None:
    """Print the figures of the longest file beside their budgets, which are for 10^7 rows."""
    for name, value in {verb: cost.seconds, **cost.told}.items():
        if f"length_{name}" in BUDGETS:
            measured(f"length_{name}", value)
    if f"length_{verb}_memory" in BUDGETS:
        measured(f"length_{verb}_memory", cost.memory_MB)


if __name__ == "__main__":
    main()
