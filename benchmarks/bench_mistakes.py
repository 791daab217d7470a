"""Plant mistakes in virtual calibrations; count how often each is named, and good ones refused.

Run with ``python benchmarks/bench_mistakes.py [--sets 200] [--word WORD]``. Each line is a kind of
calibration; a mistake is named correctly when it is refused for its codes and no others.
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

from budgets import measured, size

sys.path.insert(0, str(Path(__file__).parents[1]))

from tests.calibration.virtual_mistakes import (
    KINDS,
    MISTAKES,
    UNSEEN,
    can_be_told,
    outcomes,
    refusals,
    rightly_named,
)


def good(sets: int, word: str) -> None:
    """Print how many good calibrations of each kind are refused."""
    total = count = 0
    print(f"{'good calibrations':34} refused")
    for name, kind in KINDS.items():
        if word in name:
            refused = refusals(kind, sets, 11)
            total, count = total + refused.total(), count + sets
            print(f"{name:34} {100.0 * refused.total() / sets:5.1f} %  {dict(refused) or ''}")
    print(f"{'all':34} {100.0 * total / max(count, 1):5.2f} % of {count}")
    measured("mistakes_refused", 100.0 * total / max(count, 1))


def planted(sets: int, word: str) -> None:
    """Print how often each mistake is named correctly."""
    worst = 1.0
    for mistake, planted_mistake in MISTAKES.items():
        right = planted_mistake.right
        print(f"\n{mistake}: refused as {' or '.join(sorted(right))}")
        for name, kind in KINDS.items():
            if word not in name or not name.endswith("all"):
                continue
            counts = outcomes(kind, planted_mistake, sets, 12)
            share, tellable = rightly_named(counts, right), can_be_told(mistake, name)
            worst = min(worst, share) if tellable else worst
            rest = {code: count for code, count in counts.most_common(4) if code not in right}
            mark = "" if tellable else "(too few readings to tell)"
            print(f"  {name:32} {100.0 * share:5.1f} %  {rest or ''} {mark}")
    measured("mistakes_named", 100.0 * worst)


def unseen(sets: int) -> None:
    """Print mistakes that no reading can show, as stated in the notes."""
    print("\nevery pin angle off: no reading shows it, an angle reference must")
    for mistake, unseen_mistake in UNSEEN.items():
        counts = outcomes(KINDS["8 angles, means, all"], unseen_mistake, sets, 13)
        print(f"  {mistake:32} accepted in {100.0 * counts['accepted'] / sets:.0f} %")


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sets", type=int, default=size(200, 1))
    parser.add_argument(
        "--word",
        default="8 angles, means" if size(0, 1) else "",
        help="only kinds whose name contains it",
    )
    options = parser.parse_args()
    start = time.perf_counter()
    good(options.sets, options.word)
    planted(options.sets, options.word)
    unseen(options.sets)
    print(f"\n{time.perf_counter() - start:.0f} s")


if __name__ == "__main__":
    main()
