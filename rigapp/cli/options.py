"""Common options and arguments of verbs, and groups of verbs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperGroup

from rigapp.config.errors import UnusableInput
from rigapp.config.names import name_refusal


class WholeSentences(TyperGroup):
    """A group of verbs whose list shows complete sentences in a terminal of any width."""

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Write the verbs, each with its first sentence."""
        verbs = [(name, self.get_command(ctx, name)) for name in self.list_commands(ctx)]
        rows = [
            (name, " ".join((verb.help or "").split("\n\n")[0].split()))
            for name, verb in verbs
            if verb is not None and not verb.hidden
        ]
        with formatter.section("Commands"):
            formatter.write_dl(rows)


def group(words: str = "") -> typer.Typer:
    """Return an empty group of verbs; without a help text its verbs join those of other groups."""
    return typer.Typer(
        help=words or None, no_args_is_help=True, rich_markup_mode=None, cls=WholeSentences
    )


def _file_name(parameter: typer.CallbackParam, path: Path | None) -> Path | None:
    """Refuse an impossible file name before any work starts."""
    wrong = name_refusal(path) if path is not None else ""
    if wrong:
        raise UnusableInput(f"{parameter.opts[0]}: {wrong}.")
    return path


def option(flag: str, words: str, **more: Any) -> Any:
    """Return an option without a short name."""
    return typer.Option(flag, help=words, **more)


def file_option(flag: str, words: str) -> Any:
    """Return the option for an output file."""
    return option(flag, words, callback=_file_name)


RecordedArgument = Annotated[Path, typer.Argument(help="Test file (HDF5).")]
RigArgument = Annotated[Path, typer.Argument(help="Rig file.")]
TestArgument = Annotated[Path, typer.Argument(help="Test file.")]
RigOption = Annotated[Path, option("--rig", "Rig file (devices, inputs, calibration).")]
OutOption = Annotated[Path, file_option("--out", "HDF5 file to make; never overwritten.")]
ToOption = Annotated[Path, file_option("--to", "File to write.")]
JsonOption = Annotated[bool, option("--json", "Print JSON.")]
SpeedOption = Annotated[
    str | None, option("--speed", "Simulated rigs only: N times real time, or 'max'.")
]
ProgressOption = Annotated[
    str | None, option("--progress", "'json': one JSON object a line on standard output.")
]
BindOption = Annotated[
    str | None,
    option(
        "--bind",
        "Let viewers attach there; beyond this computer only with authorised keys.",
        metavar="tcp://ADDRESS:PORT",
    ),
]
OperatorOption = Annotated[str, option("--operator", "Operator's name for the log.")]
TokenOption = Annotated[Path | None, option("--token", "File (mode 0600) with the access token.")]
CertificateOption = Annotated[Path | None, option("--certificate", "Certificate (PEM).")]
KeyOption = Annotated[Path | None, option("--key", "Its private key (PEM), mode 0600.")]
