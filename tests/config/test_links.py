"""What is written goes through no link that somebody else could have laid."""

from __future__ import annotations

import logging
import os
import subprocess
import sys
from pathlib import Path

import pytest

from rigapp.config.writing import whole_file
from rigapp.process.logs import in_file


def laid(folder: Path, name: str) -> tuple[Path, Path]:
    """Return a private file, and a link to it under a name in a folder that others can write."""
    private = folder / "private.txt"
    private.write_text("secret")
    public = folder / "public"
    public.mkdir()
    public.chmod(0o777)
    link = public / name
    link.symlink_to(private)
    return private, link


def test_a_report_replaces_a_link_in_a_public_folder(tmp_path: Path) -> None:
    private, link = laid(tmp_path, "report.html")
    with whole_file(link) as part:
        part.write_text("report")
    assert private.read_text() == "secret"
    assert not link.is_symlink()
    assert link.read_text() == "report"


def test_a_link_in_a_folder_of_ones_own_is_followed(tmp_path: Path) -> None:
    tmp_path.chmod(0o755)
    target, link = tmp_path / "target.html", tmp_path / "link.html"
    target.write_text("before")
    link.symlink_to(target)
    with whole_file(link) as part:
        part.write_text("after")
    assert link.is_symlink()
    assert target.read_text() == "after"


@pytest.mark.parametrize("kind", ["link", "pipe"])
def test_a_log_goes_through_no_link_and_waits_for_no_pipe(tmp_path: Path, kind: str) -> None:
    private, log = laid(tmp_path, "test.log")
    if kind == "pipe":
        log.unlink()
        os.mkfifo(log)
    with in_file(log):
        logging.getLogger("rigapp.test").warning("a remark")
    assert private.read_text() == "secret"


@pytest.mark.long
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that is always full")
def test_a_full_disk_makes_no_traceback_of_the_log(tmp_path: Path) -> None:
    code = (
        "import logging, os, sys; from pathlib import Path; from rigapp.process import logs\n"
        "path = Path(sys.argv[1])\n"
        "with logs.in_file(path):\n"
        "    log = logging.getLogger('rigapp.test'); log.warning('one')\n"
        "    import time; time.sleep(0.5)\n"
        "    full = os.open('/dev/full', os.O_WRONLY)\n"
        "    for fd in os.listdir('/proc/self/fd'):\n"
        "        try:\n"
        "            if os.readlink(f'/proc/self/fd/{fd}') == str(path): os.dup2(full, int(fd))\n"
        "        except OSError: pass\n"
        "    log.warning('two')\n"
        "    time.sleep(0.5)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, tmp_path / "a.log"], capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0
    assert done.stderr == ""
