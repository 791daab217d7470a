"""Verbs that need no rig: recorded tests, the model, studies."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from rigapp.cli.options import JsonOption, RecordedArgument, ToOption, file_option, group, option
from rigapp_model.wear.techniques import listed

verbs = group()
model_verbs = group("Compute forces, wear, pressure and the paper's figures.")
study_verbs = group()


@verbs.command()
def info(
    file: RecordedArgument,
    json: JsonOption = False,
    verify: Annotated[
        bool, option("--verify", "Check checksums and seal; status 1 where a part differs.")
    ] = False,
) -> int:
    """Show what a test file holds and how the test ended."""
    if verify:
        from rigapp.commands.files import verify_file

        return verify_file(file, as_json=json)
    from rigapp.commands.files import print_info

    return print_info(file, as_json=json)


@verbs.command()
def close(file: RecordedArgument) -> int:
    """End an interrupted test file without its rig; trim it to what is saved."""
    from rigapp.commands.files import close_file

    return close_file(file)


@verbs.command()
def salvage(
    file: RecordedArgument,
    to: Annotated[Path, file_option("--to", "NEW.h5 to make; never overwritten.")],
) -> int:
    """Copy the intact data of a damaged or truncated file; report what is lost."""
    from rigapp.commands.files import salvage_file

    return salvage_file(file, to)


@verbs.command()
def export(
    file: RecordedArgument,
    to: Annotated[Path, file_option("--to", "FILE.csv, .parquet or .xlsx")],
    cycles: Annotated[bool, option("--cycles", "Saved cycles, not statistics.")] = False,
    points: Annotated[
        int | None,
        option("--points", "With --cycles: resample each to this number of crank angles."),
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
    licence: Annotated[
        str, option("--licence", "Licence of the data (SPDX identifier).")
    ] = "CC-BY-4.0",
    allow_private: Annotated[
        bool, option("--allow-private", "Pack even if private data are found; they are listed.")
    ] = False,
) -> int:
    """Pack tests for publication; status 1 when something private is in them."""
    from rigapp.commands.files import package_tests

    return package_tests(files, to, author or [], licence, allow_private=allow_private)


@verbs.command()
def identify(
    files: Annotated[list[Path], typer.Argument(help="Test files (HDF5).", metavar="FILE...")],
    to: Annotated[
        Path | None, file_option("--to", "Write it: REPORT.html, .pdf, or a .csv or .json.")
    ] = None,
    json: JsonOption = False,
    after: Annotated[
        int | None, option("--after", "Use only data up to this revolution.", min=1)
    ] = None,
) -> int:
    """Identify the wear coefficient of recorded tests, remaining life and scatter of specimens."""
    from rigapp.commands.files import identify_tests

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


ParametersArgument = Annotated[Path, typer.Argument(metavar="PARAMS.toml", help="Parameters.")]
RpmOption = Annotated[float, option("--rpm", "Crank speed, rpm.")]
JointOption = Annotated[str, option("--joint", f"{listed()} (paper: 3.1, 3.2).")]
ContactLawOption = Annotated[
    str | None, option("--contact-law", "Joint contact: law instead of the file's; see docs.")
]
RestitutionOption = Annotated[
    float | None, option("--restitution", "Joint contact: restitution instead of the file's.")
]
TimeLimitOption = Annotated[
    float | None,
    option("--time-limit-s", "Stop after this time, write the partial result, exit with 1."),
]


@model_verbs.command("forces")
def model_forces(
    params: ParametersArgument,
    rpm: RpmOption,
    to: ToOption,
    joint: JointOption = "perfect",
    clearance_mm: Annotated[
        float | None, option("--clearance-mm", "Radial clearance instead of the file's.")
    ] = None,
    points: Annotated[int, option("--points", "Crank angles of the cycle.")] = 360,
    revolutions: Annotated[
        int | None,
        option("--revolutions", "Joint contact: add means over this number of revolutions."),
    ] = None,
    tolerance: Annotated[
        float | None, option("--tolerance", "Joint contact: error of a step, of the penetration.")
    ] = None,
    contact_law: ContactLawOption = None,
    restitution: RestitutionOption = None,
    time_limit_s: TimeLimitOption = None,
) -> int:
    """Write motion and forces over one cycle of the mechanism as CSV."""
    from rigapp.commands.model.forces import Impacting, write_forces

    impacting = Impacting(revolutions, tolerance, time_limit_s, contact_law, restitution)
    return write_forces(params, rpm, joint, clearance_mm, points, to, impacting)


@model_verbs.command("wear")
def model_wear(
    params: ParametersArgument,
    rpm: RpmOption,
    cycles: Annotated[int, option("--cycles", "Cycles of the whole life.")],
    to: ToOption,
    joint: JointOption = "continuous",
    force_n: Annotated[
        float | None,
        option("--force-N", "Constant force along the follower, N, not the mechanism's."),
    ] = None,
    tolerance: Annotated[
        float, option("--tolerance", "Largest relative error of the depth.")
    ] = 1e-3,
    method: Annotated[
        str, option("--method", "implicit, or explicit: extrapolated as in the paper.")
    ] = "implicit",
    extrapolation: Annotated[
        float | None,
        option(
            "--extrapolation",
            "Method explicit: most cycles of a step; by default half the stability limit.",
        ),
    ] = None,
    contact: Annotated[
        str, option("--contact", "finite-element, or winkler: a bed of springs.")
    ] = "finite-element",
    profile: Annotated[
        Path | None, file_option("--profile", "CSV of the worn profile at the end.")
    ] = None,
    contact_law: ContactLawOption = None,
    restitution: RestitutionOption = None,
    time_limit_s: TimeLimitOption = None,
) -> int:
    """Write the life of the bushing as CSV."""
    from rigapp.commands.model.wear import Scheme, write_wear

    scheme = Scheme(method, extrapolation, contact, contact_law, restitution)
    return write_wear(
        params, rpm, cycles, joint, force_n, tolerance, to, profile, time_limit_s, scheme
    )


@model_verbs.command("pressure")
def model_pressure(
    params: ParametersArgument,
    force_n: Annotated[float, option("--force-N", "Force of the pin, N.")],
    to: ToOption,
) -> int:
    """Write the contact pressure of one load as CSV and print the pin displacement."""
    from rigapp.commands.model.wear import write_pressure

    return write_pressure(params, force_n, to)


@model_verbs.command("paper")
def model_paper(
    to: Annotated[Path, option("--to", "Folder for plots and tables.")] = Path("paper"),
    file: Annotated[
        Path | None, option("--file", "Recorded test (HDF5) for Figs 20 and 21.")
    ] = None,
    time_limit_s: TimeLimitOption = None,
) -> int:
    """Make the paper's comparisons (Figs 6-10, 13, 15, 20, 21, Table 2) as plots and tables."""
    from rigapp.commands.model.wear import write_paper

    return write_paper(to, file, time_limit_s)


@study_verbs.command()
def study(
    file: Annotated[Path, typer.Argument(help="Study file (TOML).")],
    to: Annotated[Path, option("--to", "Folder of the results; a study there is continued.")],
    scheduler: Annotated[
        str, option("--scheduler", "Dask scheduler, tcp://ADDRESS:PORT; else this computer.")
    ] = "",
    workers: Annotated[
        int | None, option("--workers", "Local processes; default: one per core.", min=1)
    ] = None,
) -> int:
    """Vary parameters of the model, or of virtual tests, and gather the results in a table."""
    from rigapp.commands.study import make_study

    return make_study(file, to, scheduler, workers)
