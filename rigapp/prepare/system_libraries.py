"""Install the system libraries that Qt needs if possible, else list them.

Runs before the installation, so it uses only the standard library and is called by path:
``python rigapp/prepare/system_libraries.py [--test]``. Never fails: missing libraries are listed in
one sentence, and the command line works without them.
"""

from __future__ import annotations

import ctypes
import importlib.util
import os
import shutil
import subprocess
import sys

WINDOW = {
    "libglib-2.0.so.0": "libglib2.0-0",
    "libGL.so.1": "libgl1",
    "libEGL.so.1": "libegl1",
    "libxkbcommon.so.0": "libxkbcommon0",
    "libfontconfig.so.1": "libfontconfig1",
    "libdbus-1.so.3": "libdbus-1-3",
    "libxcb-cursor.so.0": "libxcb-cursor0",
    "libxcb-icccm.so.4": "libxcb-icccm4",
    "libxcb-keysyms.so.1": "libxcb-keysyms1",
    "libxcb-shape.so.0": "libxcb-shape0",
    "libxkbcommon-x11.so.0": "libxkbcommon-x11-0",
}
"""Library that Qt loads -> its Debian package."""

SCREEN_TEST = {
    "Xvfb": "xvfb",
    "xauth": "xauth",
    "xdotool": "xdotool",
    "import": "imagemagick",
    "openbox": "openbox",
    "h5dump": "hdf5-tools",
    "chromium": "chromium",
}
"""Program called by the tests of window, file and page -> its Debian package."""


def missing_packages(for_tests: bool) -> list[str]:
    """Return the Debian packages that are missing on this machine."""
    missing = [package for library, package in WINDOW.items() if not _loads(library)]
    if importlib.util.find_spec("ensurepip") is None:
        missing.append(f"python{sys.version_info[0]}.{sys.version_info[1]}-venv")
    if for_tests:
        missing += [package for tool, package in SCREEN_TEST.items() if not shutil.which(tool)]
    return missing


def _loads(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def _administrator() -> list[str] | None:
    """Return the prefix for running a command as administrator, None when not allowed."""
    if sys.platform == "win32":
        return None
    if os.geteuid() == 0:
        return []
    if shutil.which("sudo"):
        allowed = subprocess.run(["sudo", "-n", "true"], capture_output=True, check=False)
        if allowed.returncode == 0:
            return ["sudo", "-n"]
    return None


def _install(prefix: list[str], packages: list[str]) -> bool:
    quiet = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    for command in (["update"], ["install", "-y", "--no-install-recommends", *packages]):
        done = subprocess.run(
            [*prefix, "apt-get", "-qq", *command], env=quiet, capture_output=True, check=False
        )
        if command[0] == "install" and done.returncode != 0:
            return False
    return True


def main(arguments: list[str]) -> int:
    """Install or list the missing packages; always return 0."""
    if not sys.platform.startswith("linux"):
        return 0
    packages = missing_packages(for_tests="--test" in arguments)
    if not packages:
        return 0
    prefix = _administrator() if shutil.which("apt-get") else None
    if prefix is not None:
        print(f"Installing system libraries: {' '.join(packages)}", flush=True)
        if _install(prefix, packages):
            return 0
    print(
        f"For the window, please have an administrator install: {' '.join(packages)}"
        " (Debian and Ubuntu names); everything else works without.",
        file=sys.stderr,
    )
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
