"""Verbs over recorded tests: what they hold, tables, reports, packages, what was learnt."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from rigapp.cli.options import JsonOption, RecordedArgument, ToOption, file_option, group, option

verbs = group()


@verbs.command()
def info(
    file: RecordedArgument,
    json: JsonOption = False,
) -> int:
    """Tell what a test file holds and how the test ended."""
    from rigapp.commands.files import print_info

    return print_info(file, as_json=json)


@verbs.command()
def export(
    file: RecordedArgument,
    to: Annotated[Path, file_option("--to", "FILE.csv or FILE.parquet")],
    cycles: Annotated[bool, option("--cycles", "Saved cycles, not statistics.")] = False,
    points: Annotated[
        int | None, option("--points", "With --cycles: put each on so many even crank angles.")
    ] = None,
) -> int:
    """Write statistics or saved cycles as CSV or Parquet."""
    from rigapp.commands.files import export_file

    return export_file(file, to, cycles=cycles, points=points)


@verbs.command()
def replay(file: RecordedArgument) -> int:
    """Show a recorded test through the same window."""
    from rigapp.commands.window import replay_file

    return replay_file(file)


@verbs.command()
def report(
    file: RecordedArgument,
    to: Annotated[Path | None, file_option("--to", "REPORT.html or REPORT.pdf")] = None,
    json: Annotated[bool, option("--json", "Print its texts and tables as JSON.")] = False,
) -> int:
    """Write the report of a test, the same bytes each time."""
    from rigapp.commands.report import write_report

    return write_report(file, to, as_json=json)


@verbs.command()
def package(
    files: Annotated[list[Path], typer.Argument(help="Test files (HDF5).", metavar="FILE...")],
    to: Annotated[Path, file_option("--to", "FILE.zip to make; never overwritten.")],
    author: Annotated[
        list[str] | None, option("--author", "'Family, Given'; repeatable. Else the operators.")
    ] = None,
    licence: Annotated[str, option("--licence", "Of the data, as SPDX names it.")] = "CC-BY-4.0",
    allow_private: Annotated[
        bool, option("--allow-private", "Also with what looks private; it is shown.")
    ] = False,
) -> int:
    """Pack tests as they are published; status 1 when something private is in them."""
    from rigapp.commands.package import package_tests

    return package_tests(files, to, author or [], licence, allow_private=allow_private)


@verbs.command()
def identify(
    files: Annotated[list[Path], typer.Argument(help="Test files (HDF5).", metavar="FILE...")],
    to: Annotated[
        Path | None, file_option("--to", "Write it: REPORT.html, .pdf, or a .csv or .json.")
    ] = None,
    json: JsonOption = False,
    after: Annotated[
        int | None, option("--after", "As it was known after so many revolutions.", min=1)
    ] = None,
) -> int:
    """Tell the wear coefficient of recorded tests, what remains, and how specimens scatter."""
    from rigapp.commands.identify import identify_tests

    return identify_tests(files, to, as_json=json, after=after)


@verbs.command()
def picture(file: RecordedArgument, to: ToOption) -> int:
    """Draw a recorded test as the window shows it (PNG)."""
    from rigapp.commands.window import draw_picture

    return draw_picture(file, to)
