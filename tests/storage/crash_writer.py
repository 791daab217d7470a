"""Write a test as fast as it goes and say on stdout what is safe, until somebody kills this.

With ``ending`` as second word the test is ended and taken up again after every few revolutions.
"""

from __future__ import annotations

import sys
import threading
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from storage_samples import METADATA, PLAN, write

from rigapp.storage import TestWriter, create_test, reopen_test


def commit_often(writer: TestWriter) -> None:
    """Commit and announce, again and again."""
    announced = -1
    while True:
        safe = writer.commit()
        if safe != announced:
            print(safe, flush=True)
            announced = safe


def end_again_and_again(path: Path) -> None:
    """End the test, which gives its spare room back, and take it up again, until it is full."""
    writer = reopen_test(path) if path.exists() else create_test(path, PLAN, METADATA)
    print("ready", flush=True)
    while True:
        rows = writer.revolutions
        write(writer, rows + 1, min(rows + 3, PLAN.revolutions))
        writer.finish("stopped", "operator", "enough")
        print(writer.revolutions, flush=True)
        writer.close()
        writer = reopen_test(path)


def main() -> None:
    """Create or resume the file named on the command line and write until killed."""
    path = Path(sys.argv[1])
    if sys.argv[2:] == ["ending"]:
        end_again_and_again(path)
    writer = reopen_test(path) if path.exists() else create_test(path, PLAN, METADATA)
    print("ready", flush=True)
    threading.Thread(target=commit_often, args=(writer,), daemon=True, name="committer").start()
    pause = threading.Event()
    for revolution in range(writer.revolutions + 1, 1500):
        write(writer, revolution, revolution)
        pause.wait(0.0002)
    pause.wait(60.0)


main()
