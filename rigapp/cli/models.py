"""Verbs over the model: forces, wear, pressure, the paper's figures; studies of many."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from rigapp.cli.options import ToOption, file_option, group, option
from rigapp_model.wear.techniques import listed

model_verbs = group("Compute forces, wear, pressure and the paper's figures.")
study_verbs = group()

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
    float | None, option("--time-limit-s", "Write what was reached by then and end with status 1.")
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
        int | None, option("--revolutions", "Joint contact: add means over so many, with errors.")
    ] = None,
    tolerance: Annotated[
        float | None, option("--tolerance", "Joint contact: error of a step, of the penetration.")
    ] = None,
    contact_law: ContactLawOption = None,
    restitution: RestitutionOption = None,
    time_limit_s: TimeLimitOption = None,
) -> int:
    """Write motion and forces over one cycle of the mechanism as CSV."""
    from rigapp.commands.model.forces import write_forces
    from rigapp.commands.model.impacts import Impacting

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
    from rigapp.commands.model.paper import write_paper

    return write_paper(to, file, time_limit_s)


@study_verbs.command()
def study(
    file: Annotated[Path, typer.Argument(help="Study file (TOML).")],
    to: Annotated[Path, option("--to", "Folder of the results; a study there is continued.")],
    scheduler: Annotated[
        str, option("--scheduler", "Dask scheduler, tcp://ADDRESS:PORT; else this computer.")
    ] = "",
    workers: Annotated[
        int | None, option("--workers", "Processes here; by default one a core.", min=1)
    ] = None,
) -> int:
    """Vary parameters of the model, or of virtual tests, and gather the results in a table."""
    from rigapp.commands.study import make_study

    return make_study(file, to, scheduler, workers)
