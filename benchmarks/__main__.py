"""Run every benchmark in a process of its own: ``python -m benchmarks [WORD ...] [--json FILE]``.

The last table has one line for each budget: name, figure, peer with its ratio, budget, kept or
missed; skipped ones follow. Status 1 when a benchmark failed, or when a ratio to a
peer measured in the same run fell by more than a third of the stored one (``ratios.json``); not
when a budget is missed: figures of a busy machine are unreliable, ratios of one run less so.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from benchmarks.budgets import BUDGETS, COLLECTED

HERE = Path(__file__).parent
RATIOS = HERE / "ratios.json"
"""Ratio of each figure to its peer, if any, as stored by ``--keep-ratios``."""
COSTS = frozenset({"help", "reduce"})
"""Figures whose ratio is their time as a multiple of the peer's; for others, it is how many times
faster than the peer they are."""
LEAST_SHARE = 2.0 / 3.0
"""Part of the stored ratio: a lower ratio is not due to the machine, whose load both sides
share."""


def fallen(rows: list[dict[str, Any]], stored: dict[str, float]) -> list[str]:
    """Return a sentence for each ratio that fell by more than a third of the stored one."""
    names = []
    for row in rows:
        name, now = row.get("name", ""), row.get("ratio")
        if name not in stored or not now:
            continue
        share = stored[name] / now if name in COSTS else now / stored[name]
        if share < LEAST_SHARE:
            names.append(
                f"{row['what']}: {now:,.4g} x {row['peer']}, {stored[name]:,.4g} x stored:"
                f" {100 * share:.0f} % of it is left"
            )
    return names


def ratios_of(rows: list[dict[str, Any]]) -> dict[str, float]:
    """Return the ratios of a run by the names of their figures, to four digits."""
    return {row["name"]: float(f"{row['ratio']:.4g}") for row in rows if row.get("ratio")}


def table(figures: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return a row for each measured budget, then the skipped ones."""
    rows = []
    for figure in figures:
        if "skipped" in figure:
            continue
        budget = BUDGETS[figure["name"]]
        kept = budget.kept(figure["value"])
        limit = {"limit": budget.limit, "at_least": budget.at_least, "unit": budget.unit}
        rows.append({"what": budget.what, **figure, **limit, "kept": kept})
    return rows + [figure for figure in figures if "skipped" in figure]


def line(row: dict[str, Any]) -> str:
    """Return a row as text."""
    if "skipped" in row:
        return f"{row['skipped']:<52} SKIPPED: {row['why']}"
    peer = f"{row['ratio']:,.1f} x {row['peer']}" if row["ratio"] is not None else ""
    budget = f"{'>=' if row['at_least'] else '<='} {row['limit']:g} {row['unit']}"
    return (
        f"{row['what']:<52}{row['value']:>12,.4g}  {budget:<26}"
        f"{'kept' if row['kept'] else 'MISSED':<8}{peer}"
    )


def main() -> int:
    """Run the benchmarks whose names contain one of the words (all without words)."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("words", nargs="*", help="only benchmarks whose name contains one of them")
    parser.add_argument("--json", type=Path, help="write the last table to this file too")
    parser.add_argument("--keep-ratios", action="store_true", help=f"store them in {RATIOS.name}")
    options = parser.parse_args()
    failed, figures = [], []
    with tempfile.TemporaryDirectory() as folder:
        collected = Path(folder) / "figures"
        collected.touch()
        for path in sorted(HERE.glob("bench_*.py")):
            name = path.stem.removeprefix("bench_")
            if options.words and not any(word in name for word in options.words):
                continue
            print(f"== {name}", flush=True)
            environment = {**os.environ, COLLECTED: str(collected)}
            command = [sys.executable, str(path)]
            before = collected.stat().st_size
            status = subprocess.run(command, env=environment, check=False).returncode
            # Some return 1 for a missed budget; a benchmark that fails leaves no figure.
            if status != 0 and collected.stat().st_size == before:
                failed.append(name)
            print(flush=True)
        figures = [json.loads(line) for line in collected.read_text("utf-8").splitlines()]
    rows = table(figures)
    print("\n".join(map(line, rows)))
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1) + "\n", "utf-8")
    stored: dict[str, float] = json.loads(RATIOS.read_text("utf-8"))
    worse = fallen(rows, stored)
    if options.keep_ratios:
        worse, kept = [], stored | ratios_of(rows)
        RATIOS.write_text(json.dumps(kept, indent=1, sort_keys=True) + "\n", "utf-8")
    if failed:
        print(f"failed: {', '.join(failed)}", file=sys.stderr)
    for name in worse:
        print(f"fallen: {name}", file=sys.stderr)
    return 1 if failed or worse else 0


if __name__ == "__main__":
    sys.exit(main())
