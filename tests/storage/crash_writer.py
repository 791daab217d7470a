"""Write a test as fast as it goes and say on stdout what is safe, until somebody kills this."""

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


def main() -> None:
    """Create or resume the file named on the command line and write until killed."""
    path = Path(sys.argv[1])
    writer = reopen_test(path) if path.exists() else create_test(path, PLAN, METADATA)
    print("ready", flush=True)
    threading.Thread(target=commit_often, args=(writer,), daemon=True, name="committer").start()
    pause = threading.Event()
    for revolution in range(writer.revolutions + 1, 1500):
        write(writer, revolution, revolution)
        pause.wait(0.0002)
    pause.wait(60.0)


main()
