"""The program: the tree of verbs, their common options, and the exit status.

Exit status: 0 done, 1 the test or check failed or was stopped by a limit, 2 unusable input, 3 a
device failed. One plain sentence on stderr; a traceback only with ``--debug``.
"""

from __future__ import annotations

import errno
import os
import sys
from functools import cache
from typing import Annotated, Any, NoReturn

import typer

from rigapp.cli import calibrations, files, rig
from rigapp.cli.options import WholeSentences, option
from rigapp.config.errors import UnusableInput
from rigapp.schema.details import error_text, indented

app = typer.Typer(
    name="rigapp",
    help="Control, record and understand slider-crank joint wear tests.",
    cls=WholeSentences,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.add_typer(rig.verbs)
app.add_typer(files.verbs)
app.add_typer(files.study_verbs)
app.add_typer(files.model_verbs, name="model")
app.add_typer(calibrations.calibrate_verbs, name="calibrate")
app.add_typer(rig.queue_verbs, name="queue")
app.add_typer(rig.service_verbs, name="service")


def _show_version(wanted: bool) -> None:
    """Print the version and exit before other modules are loaded."""
    if wanted:
        from importlib.metadata import version

        print(f"rigapp {version('rigapp')}")
        raise typer.Exit


@app.callback()
def options(
    context: typer.Context,
    version: Annotated[
        bool,
        option("--version", "Show the version.", callback=_show_version, is_eager=True),
    ] = False,
    debug: Annotated[bool, option("--debug", "Show a traceback on errors.")] = False,
    log_level: Annotated[
        str | None,
        option(
            "--log-level",
            "Remarks on standard error from this level on: debug, info, warning or error.",
            metavar="LEVEL",
        ),
    ] = None,
) -> None:
    """Take the options that every verb has (``--debug`` is read by ``main``)."""
    from rigapp.process.logs import chosen_level, on_terminal

    context.with_resource(on_terminal(chosen_level(log_level)))


INTERRUPTED = 130
"""Status that the command-line library returns after Ctrl-C."""


@cache  # repeated calls of ``main`` build the tree of verbs only once
def _verbs() -> Any:
    return typer.main.get_command(app)


def main() -> NoReturn:
    """Run the command line and exit with its status."""
    # Threads of linear algebra would take cores from the acquisition.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:  # closed by the parent process
            setattr(sys, name, open(os.devnull, "w"))  # noqa: SIM115, open until the process ends
    debug = "--debug" in sys.argv
    arguments = [word for word in sys.argv[1:] if word != "--debug"]
    try:
        status = _verbs()(args=arguments, prog_name="rigapp", standalone_mode=False)
    except (KeyboardInterrupt, typer.Abort):
        status = INTERRUPTED
    except Exception as error:
        if debug:
            raise
        status = _report(error)
    if status == INTERRUPTED:
        print("rigapp: interrupted.", file=sys.stderr)
        status = 1
    sys.stdout.flush()
    raise SystemExit(status or 0)


def _report(error: Exception) -> int:
    """Print an error as one sentence and return the exit status."""
    if isinstance(error, OSError) and error.errno == errno.ENAMETOOLONG:
        start = str(error.filename)[:40]
        print(f"rigapp: the name {start}... is too long; shorten it.", file=sys.stderr)
        return 2
    wrong_call = getattr(error, "format_message", None)
    if wrong_call is None:
        text = error_text(error, "an unexpected error; --debug shows where.")
        print(f"rigapp: {indented(text)}", file=sys.stderr)
        for section in _sections(error):
            print(f"    See troubleshooting.md#{section}", file=sys.stderr)
        return _status_of(error)
    if type(error).__name__ == "NoArgsIsHelpError":
        print(wrong_call())
    else:
        message = wrong_call().rstrip()
        stop = "" if message.endswith((".", "?", "!")) else "."
        verb = getattr(getattr(error, "ctx", None), "command_path", None) or "rigapp"
        print(f"rigapp: {message}{stop} See '{verb} --help'.", file=sys.stderr)
    return 2


def _sections(error: Exception) -> list[str]:
    """Return the sections of the troubleshooting guide for a device error, each once."""
    module = sys.modules.get("rigapp_drivers.api")
    if module is None or not isinstance(error, module.DeviceError):
        return []
    return [section for section in dict.fromkeys(map(module.help_of, error.each)) if section]


def _status_of(error: Exception) -> int:
    """Return the exit status for an error raised by a verb."""
    if isinstance(error, UnusableInput):
        return 2
    module = sys.modules.get("rigapp_drivers.api")
    if module is not None and isinstance(error, module.DeviceError):
        return 3
    return 1
