"""Verbs over recorded tests: what they hold, tables, reports, packages, what was learnt."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from rigapp.cli.options import JsonOption, RecordedArgument, file_option, group, option

verbs = group()


@verbs.command()
def info(
    file: RecordedArgument,
    json: JsonOption = False,
    verify: Annotated[
        bool, option("--verify", "Check checksums and seal; status 1 where a part differs.")
    ] = False,
) -> int:
    """Tell what a test file holds and how the test ended."""
    if verify:
        from rigapp.commands.upkeep import verify_file

        return verify_file(file, as_json=json)
    from rigapp.commands.files import print_info

    return print_info(file, as_json=json)


@verbs.command()
def close(file: RecordedArgument) -> int:
    """End a file whose writer is gone, without its rig; trim it to what is saved."""
    from rigapp.commands.upkeep import close_file

    return close_file(file)


@verbs.command()
def salvage(
    file: RecordedArgument,
    to: Annotated[Path, file_option("--to", "NEW.h5 to make; never overwritten.")],
) -> int:
    """Copy what checksums confirm out of a damaged or truncated file; say what is lost."""
    from rigapp.commands.upkeep import salvage_file

    return salvage_file(file, to)


@verbs.command()
def export(
    file: RecordedArgument,
    to: Annotated[Path, file_option("--to", "FILE.csv, .parquet or .xlsx")],
    cycles: Annotated[bool, option("--cycles", "Saved cycles, not statistics.")] = False,
    points: Annotated[
        int | None, option("--points", "With --cycles: put each on so many even crank angles.")
    ] = None,
    decimal: Annotated[str, option("--decimal", "Decimal sign of a CSV file: . or a comma.")] = "",
    separator: Annotated[
        str, option("--separator", "Between its numbers: a comma, a semicolon or tab.")
    ] = "",
) -> int:
    """Write statistics or saved cycles as CSV, Parquet or a workbook of Excel."""
    from rigapp.commands.files import export_file

    return export_file(file, to, cycles=cycles, points=points, decimal=decimal, separator=separator)


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
    settings: Annotated[
        Path | None,
        file_option("--settings", "Laboratory, customer, number; else report.toml beside FILE."),
    ] = None,
    language: Annotated[
        str, option("--language", "en or de; else report.language of the settings.")
    ] = "",
) -> int:
    """Write the report of a test, the same bytes each time."""
    from rigapp.commands.files import write_report

    return write_report(file, to, as_json=json, settings=settings, language=language)


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
def picture(
    file: RecordedArgument,
    to: Annotated[Path, file_option("--to", "FIGURE.svg, .pdf or .png")],
    figure: Annotated[
        str,
        option(
            "--figure",
            "wear, forces, displacement, agreement, cycles, profile, prediction, trip or mechanism;"
            " else the first that the test has data of.",
        ),
    ] = "",
    width_mm: Annotated[
        float, option("--width-mm", "86 for one column, 178 for two.", min=60.0, max=400.0)
    ] = 178.0,
) -> int:
    """Draw a figure of a recorded test for a paper: SVG, PDF or PNG."""
    from rigapp.commands.files import draw_figure

    return draw_figure(file, to, figure, width_mm)
