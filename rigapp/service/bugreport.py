"""Record the lines of devices for a bug report, and pack it with logs and settings.

The report names no people, computers, folders or addresses; serial numbers stay.
"""

from __future__ import annotations

import getpass
import json
import platform
import re
import socket
import tempfile
import threading
import time
import zipfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack
from importlib import metadata
from pathlib import Path
from typing import Any, Final

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document
from rigapp.config.rig import RigFile
from rigapp.config.toml import toml_text, toml_tree
from rigapp.config.writing import whole_file
from rigapp.engine.engine import Engine
from rigapp.process.logs import in_file
from rigapp.publishing.private import PROGRAM, without_private
from rigapp.schema.messages import LineReport
from rigapp.schema.states import Refused
from rigapp.schema.verbs import LinesToReport
from rigapp.texts import say, sentence_of_error
from rigapp_drivers.wire.trace import MAGIC, RecordKind, encode_note, encode_record, read_trace

PRIVATE_SECTIONS: Final = ("notify", "ping", "records")
"""Private sections of a rig file: recipients of messages, and paths of keys."""
PRIVATE_FIELDS: Final = ("operator", "in_command", "queue", "file", "line_report")
"""Private fields of a status: people, and their folders."""
MOST_NAMES: Final = 1000
SHORTEST_NAME: Final = 3
"""Minimum length of a name; shorter ones occur in many words by chance."""

ABOUT: Final = """\
Lines of {devices}, recorded by rigapp {version} from {since} to {until} (UTC).

*.wire        what was said on the line: rigapp wire FILE shows it, port = "wire:FILE" plays it
rig.toml      the rig file without comments
log.txt       the program's remarks meanwhile
status.json   state, alarms and counters at the end
versions.json the program's and the system's versions

Names of people and computers, folders, addresses and keys are taken out. Serial numbers are in it.
{silent}"""


class BugReports:
    """Record for one report at a time; the recording is packed when its time is up.

    rig: the rig file in use. connect: connects the devices; its errors are passed on.
    """

    def __init__(
        self, engine: Engine, rig: Callable[[], Document[RigFile]], connect: Callable[[], None]
    ) -> None:
        self._engine, self._rig, self._connect = engine, rig, connect
        self._lock = threading.RLock()
        self._names = set(_names_here())
        self._open: ExitStack | None = None
        self._folder = Path()
        self._timer: threading.Timer | None = None
        self.shown: LineReport | None = None

    def note_name(self, name: str) -> None:
        """Store the name of an operator, to remove it from the package."""
        if name not in PROGRAM and len(self._names) < MOST_NAMES:
            self._names.update(_spellings(name))

    def begin(self, request: LinesToReport) -> None:
        """Start recording; raises Refused, UnusableInput."""
        rig, file = self._rig(), Path(request.file)
        known = tuple(rig.record.devices)
        for device in request.devices:
            if device not in known:
                raise UnusableInput("{}: there is no device {}.", rig.path, repr(device))
        if file.suffix != ".zip" or not file.is_absolute():
            raise UnusableInput("{}: give the full path of a file with the ending .zip.", file)
        if file.exists():
            raise UnusableInput("{}: exists already and is not overwritten.", file)
        with self._lock:
            if self._open is not None:
                raise Refused("the lines are being recorded already; end that first")
            devices = request.devices or known
            with ExitStack() as opened:
                folder = opened.enter_context(tempfile.TemporaryDirectory(prefix="rigapp-report-"))
                self._folder = Path(folder)
                opened.enter_context(in_file(self._folder / "log.txt"))
                self._engine.begin_report(self._folder, devices)
                opened.callback(self._engine.end_report)
                self._open = opened.pop_all()
            self.shown = LineReport(str(file), devices, time.time())
        if request.reconnect:
            try:
                self._connect()
            except Exception as error:  # the failure is part of the report
                self._engine.log("device", sentence_of_error(error), "engine")
        if request.duration_s:
            self._end_after(request.duration_s)

    def _end_after(self, seconds: float) -> None:
        with self._lock:
            if self._open is None or self.shown is None:
                return
            self.shown = msgspec.structs.replace(self.shown, until=time.time() + seconds)
            self._timer = threading.Timer(seconds, self._time_is_up)
            self._timer.name, self._timer.daemon = "end of report", True
            self._timer.start()

    def _time_is_up(self) -> None:
        try:
            self.end()
        except (UnusableInput, Refused):  # the status shows its sentence
            return

    def end(self) -> str:
        """End the recording and pack it; return the file. Raises Refused, UnusableInput."""
        with self._lock:
            if self._open is None or self.shown is None:
                raise Refused("no line is being recorded for a report")
            opened, self._open = self._open, None
            if self._timer is not None:
                self._timer.cancel()
                self._timer = None
            self._engine.end_report()
            with opened:
                try:
                    self._pack(self.shown)
                except (OSError, UnusableInput) as error:
                    words = say("The report could not be written ‹{}›.", sentence_of_error(error))
                    self.shown = msgspec.structs.replace(self.shown, sentence=words)
                    raise UnusableInput("{}: {}", self.shown.file, words) from error
            words = say("The report is in {}.", self.shown.file)
            self.shown = msgspec.structs.replace(self.shown, sentence=words)
            return self.shown.file

    def close(self) -> None:
        """Pack a running recording."""
        if self._open is not None:
            self._time_is_up()

    def _pack(self, report: LineReport) -> None:
        status = self._engine.status()
        names = frozenset({*self._names, *_spellings(status.engine.operator)})
        tree = {key: value for key, value in status.tree().items() if key not in PRIVATE_FIELDS}
        traces = sorted(self._folder.glob("*.wire*"))
        recorded = {trace.name.partition(".wire")[0] for trace in traces}
        silent = [device for device in report.devices if device not in recorded]
        texts = {
            "report.txt": ABOUT.format(
                devices=", ".join(report.devices),
                version=_version("rigapp"),
                since=_utc(report.since),
                until=_utc(time.time()),
                silent=f"Nothing was said on the line of {', '.join(silent)}." if silent else "",
            ),
            "rig.toml": _public_rig(self._rig()),
            "status.json": json.dumps(tree, indent=1, default=str, ensure_ascii=False),
            "versions.json": json.dumps(versions(), indent=1),
            "log.txt": _text_of(self._folder / "log.txt"),
        }
        Path(report.file).parent.mkdir(parents=True, exist_ok=True)
        with (
            whole_file(Path(report.file), new=True) as part,
            zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED) as package,
        ):
            for name, text in texts.items():
                package.writestr(name, without_private(text, names))
            for trace in traces:
                package.writestr(trace.name, b"".join(_public_trace(trace, names)))


def versions() -> dict[str, str]:
    """Return the versions of the program, of its packages, and of the system."""
    needed = (re.split(r"[^\w.-]", need)[0] for need in metadata.requires("rigapp") or ())
    result = {name: _version(name) for name in dict.fromkeys(("rigapp", *needed))}
    system = {"python": platform.python_version(), "system": platform.platform()}
    return {**system, **{name: version for name, version in result.items() if version}}


def _version(package: str) -> str:
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return ""


def _utc(moment: float) -> str:
    return time.strftime("%Y-%m-%d %H:%M:%S", time.gmtime(moment))


def _text_of(log: Path) -> str:
    """Return the text of a log, after that of its predecessor."""
    parts = (log.with_name(f"{log.name}.1"), log)
    return "".join(part.read_text("utf-8", "replace") for part in parts if part.exists())


def _public_rig(rig: Document[RigFile]) -> str:
    """Return the contents of a rig file without comments and private sections."""
    tree = toml_tree(rig.text, rig.path)
    return toml_text({key: value for key, value in tree.items() if key not in PRIVATE_SECTIONS})


def _public_trace(path: Path, names: Iterable[str]) -> Iterator[bytes]:
    """Yield a recorded line with private data removed from its notes, its bytes unchanged."""
    trace = read_trace(path)
    first_ns = trace.records[0].time_ns if trace.records else 0
    yield MAGIC
    yield encode_note(first_ns, _public(trace.header, names))
    for record in trace.records:
        if record.kind is RecordKind.NOTE:
            yield encode_note(record.time_ns, _public(record.note, names))
        else:
            yield encode_record(record.kind, record.time_ns, record.data)


def _public(tree: Any, names: Iterable[str]) -> Any:
    if isinstance(tree, str):
        return without_private(tree, names)
    if isinstance(tree, dict):
        return {key: _public(value, names) for key, value in tree.items()}
    if isinstance(tree, list):
        return [_public(value, names) for value in tree]
    return tree


def _names_here() -> Iterator[str]:
    """Yield the names of this account and this computer."""
    host = socket.gethostname()
    yield from (name for name in (host, host.partition(".")[0]) if len(name) >= SHORTEST_NAME)
    try:
        login = getpass.getuser()
    except (KeyError, OSError, ImportError):
        return
    yield from _spellings(login)
    try:
        import pwd

        yield from _spellings(pwd.getpwnam(login).pw_gecos.partition(",")[0])
    except (ImportError, KeyError):
        return


def _spellings(name: str) -> Iterator[str]:
    """Yield a name and its words, those long enough to identify a person."""
    for spelling in (name.strip(), *re.split(r"[\s.,_-]+", name)):
        if len(spelling) >= SHORTEST_NAME:
            yield spelling
