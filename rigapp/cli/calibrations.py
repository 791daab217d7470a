"""Verbs over calibrations: each subject from readings or live, records, certificates, checks."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from rigapp.cli.options import JsonOption, RigOption, file_option, group, option

calibrate_verbs = group("Fit dead-weight and micrometer readings; certificates.")

TableOption = Annotated[Path | None, option("--readings", "CSV of readings; or use --rig.")]
LiveOption = Annotated[Path | None, option("--rig", "Rig file: take the readings live.")]
SettingsOption = Annotated[Path, option("--settings", "Settings file (TOML).")]
WeightsOption = Annotated[str, option("--weights", "Pieces in kg; 5x8: eight pieces of 5 kg.")]
RecordOption = Annotated[Path, file_option("--to", "Record to make; never overwritten.")]
RecordArgument = Annotated[Path, typer.Argument(help="Calibration record.")]
JournalOption = Annotated[
    Path | None, file_option("--journal", "Journal file; an existing one is resumed.")
]
PractiseOption = Annotated[
    bool, option("--practise", "Simulated rig: a simulated operator does the work.")
]
FormerOption = Annotated[
    Path | None, option("--former", "Previous record for comparison; by default the rig file's.")
]


@calibrate_verbs.command("load-cell")
def calibrate_load_cell(
    settings: SettingsOption,
    to: RecordOption,
    readings: TableOption = None,
    json: JsonOption = False,
    rig: LiveOption = None,
    plan: Annotated[str, option("--plan", "daily, routine or full.")] = "routine",
    weights: WeightsOption = "5x8,2,2,1,0.5",
    journal: JournalOption = None,
    practise: PractiseOption = False,
    former: FormerOption = None,
) -> int:
    """Calibrate the load cell from a CSV of readings or live; a bad fit is refused, not saved."""
    from rigapp.commands.live.terminal import calibrate

    requested = {"plan": plan, "weights": weights}
    return calibrate(
        "load cell", requested, settings, to, readings, rig,
        journal=journal, practise=practise, as_json=json, former=former,
    )  # fmt: skip


@calibrate_verbs.command("worksheet")
def calibrate_worksheet(
    settings: SettingsOption,
    to: Annotated[Path, file_option("--to", "FILE.pdf, .html, or .csv to be typed in.")],
    plan: Annotated[str, option("--plan", "routine or full.")] = "routine",
    weights: WeightsOption = "5x8,2,2,1,0.5",
) -> int:
    """Write the plan of a load-cell calibration for paper, or as a table of readings to fill in."""
    from rigapp.commands.calibrate import make_worksheet

    return make_worksheet(settings, to, plan, weights)


@calibrate_verbs.command("probes")
def calibrate_probes(
    settings: SettingsOption,
    to: RecordOption,
    readings: TableOption = None,
    json: JsonOption = False,
    rig: LiveOption = None,
    probe: Annotated[str, option("--probe", "1, 2, or both with their alignment.")] = "1",
    plan: Annotated[
        str, option("--plan", "routine (1 run up and down) or full (3 runs).")
    ] = "full",
    positions: Annotated[int, option("--positions", "Positions of a run.")] = 11,
    reach_um: Annotated[
        float | None, option("--reach-um", "Largest position; default: 80 % of the probe's range.")
    ] = None,
    journal: JournalOption = None,
    practise: PractiseOption = False,
    former: FormerOption = None,
) -> int:
    """Calibrate probes by micrometer steps, from a CSV or live; a bad fit is refused, not saved."""
    from rigapp.commands.live.terminal import calibrate

    requested = {"which": probe, "plan": plan, "reach": reach_um, "positions": positions}
    return calibrate(
        "probes", requested, settings, to, readings, rig,
        journal=journal, practise=practise, as_json=json, former=former,
    )  # fmt: skip


@calibrate_verbs.command("channel")
def calibrate_channel(
    settings: SettingsOption,
    to: RecordOption,
    readings: Annotated[Path, option("--readings", "CSV of voltages and reference values.")],
    json: JsonOption = False,
) -> int:
    """Calibrate a free channel, as a line or a table, from a CSV; a bad fit is refused."""
    from rigapp.commands.calibrate import calibrate_table

    return calibrate_table("channel", readings, settings, to, as_json=json)


@calibrate_verbs.command("run-out")
def calibrate_run_out(
    to: RecordOption,
    rig: Annotated[Path | None, option("--rig", "Rig file: roll the spindle slowly now.")] = None,
    recorded: Annotated[
        list[Path] | None,
        option("--from", "Test file of a slow roll with complete cycles; repeatable."),
    ] = None,
    settings: Annotated[
        Path | None, option("--settings", "Settings file: [pin], [paperwork].")
    ] = None,
    test: Annotated[
        Path | None, option("--test", "Test file whose mechanism and limits apply.")
    ] = None,
    rpm: Annotated[
        str, option("--rpm", "Speeds of the rolls; two separate inertia from run-out.")
    ] = "3,6",
    revolutions: Annotated[int, option("--revolutions", "Revolutions of each roll.")] = 12,
    orders: Annotated[int, option("--orders", "Fourier orders of the map.")] = 8,
    json: JsonOption = False,
) -> int:
    """Map the pin's run-out by a slow roll of the spindle; a bad roll is refused, not saved."""
    from rigapp.commands.live.spindle_runs import calibrate_run_out as make

    return make(
        rig, recorded or [], to, settings=settings, test=test,
        rpm=rpm, revolutions=revolutions, orders=orders, as_json=json,
    )  # fmt: skip


@calibrate_verbs.command("running-check")
def calibrate_running_check(
    rig: RigOption,
    to: RecordOption,
    speeds: Annotated[
        str, option("--speeds", "Speeds in rpm; the slowest is the zero.")
    ] = "30,120,240",
    revolutions: Annotated[int, option("--revolutions", "Revolutions at each speed.")] = 20,
    mass_kg: Annotated[
        float | None,
        option("--mass-kg", "Of the pin outboard of the gauges; else the rig file's."),
    ] = None,
    radius_mm: Annotated[
        float | None, option("--radius-mm", "Of that mass; else the rig file's.")
    ] = None,
    follower_off: Annotated[
        bool, option("--follower-off", "The follower is off, nothing hangs on the pin.")
    ] = False,
    settings: Annotated[
        Path | None, option("--settings", "Settings file of a calibration: paperwork.")
    ] = None,
    json: JsonOption = False,
) -> int:
    """Check the load cell by the pin's inertia while it turns alone: - m r w^2 in force_1."""
    from rigapp.commands.live.spindle_runs import check_running

    return check_running(
        rig, to, speeds=speeds, revolutions=revolutions, mass_kg=mass_kg, radius_mm=radius_mm,
        follower_off=follower_off, settings=settings, as_json=json,
    )  # fmt: skip


@calibrate_verbs.command("release")
def calibrate_release(
    rig: RigOption,
    yes: Annotated[bool, option("--yes", "Confirm that the pin is free; do not ask.")] = False,
    reason: Annotated[str, option("--reason", "Reason for the log.")] = "",
) -> int:
    """End a calibration whose window has failed, so that the rig is free again."""
    from rigapp.commands.live.engine_line import release_calibration

    return release_calibration(rig, reason, sure=yes)


@calibrate_verbs.command("history")
def calibrate_history(
    store: Annotated[Path, typer.Argument(help="Store of daily checks.")] = Path(
        "daily-checks.jsonl"
    ),
    to: Annotated[Path | None, file_option("--to", "Draw the charts: .png, .html or .pdf.")] = None,
    rig: Annotated[
        str | None, option("--rig-name", "Only this rig; else that of the last check.")
    ] = None,
    json: JsonOption = False,
) -> int:
    """Show the daily checks and their control charts; status 1 when a rule asks for action."""
    from rigapp.commands.calibrate import show_history

    return show_history(store, to, rig, as_json=json)


@calibrate_verbs.command("trend")
def calibrate_trend(
    folder: Annotated[Path, typer.Argument(help="Folder of calibration records.")] = Path(),
    to: Annotated[Path | None, file_option("--to", "Draw the trend: .pdf or .html.")] = None,
    json: JsonOption = False,
) -> int:
    """Show records, oldest first, each against the one before; status 1 for a change beyond U."""
    from rigapp.commands.calibrate import show_trend

    return show_trend(folder, to, as_json=json)


@calibrate_verbs.command("certificate")
def calibrate_certificate(
    record: RecordArgument,
    to: Annotated[Path, file_option("--to", "FILE.pdf or FILE.html")],
    issued: Annotated[str, option("--issued", "Date of issue; else that of the record.")] = "",
) -> int:
    """Write the certificate of a record, the same bytes each time."""
    from rigapp.commands.calibrate import certify

    return certify(record, to, issued)


@calibrate_verbs.command("verify")
def calibrate_verify(
    record: RecordArgument,
    public_key: Annotated[
        Path | None, option("--public-key", "Key of the laboratory that must have signed it.")
    ] = None,
    json: JsonOption = False,
) -> int:
    """Fit the readings of a record again and compare; status 1 where they differ."""
    from rigapp.commands.calibrate import verify_record

    return verify_record(record, public_key, as_json=json)


@calibrate_verbs.command("key")
def calibrate_key(
    to: Annotated[Path, file_option("--to", "Private key to create; the public key is FILE.pub.")],
) -> int:
    """Make the key with which a laboratory signs records, and its public key."""
    from rigapp.commands.calibrate import make_key

    return make_key(to)


@calibrate_verbs.command("sign")
def calibrate_sign(
    record: RecordArgument,
    key: Annotated[Path, option("--key", "Private key, readable by its owner alone.")],
    to: RecordOption,
) -> int:
    """Sign a record that follows from its readings; the signed one is a new file."""
    from rigapp.commands.calibrate import sign_record

    return sign_record(record, key, to)
