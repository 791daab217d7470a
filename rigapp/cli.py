"""The command line: verbs, thin. Each imports what it needs when it is called.

Exit status: 0 done, 1 the test or check failed or was stopped by a limit, 2 unusable input, 3 a
device failed. One plain sentence on stderr; a traceback only with ``--debug``.
"""

from __future__ import annotations

import errno
import os
import sys
from pathlib import Path
from typing import Annotated, Any, NoReturn

import typer

from model.wear.techniques import listed
from rigapp.config.errors import UnusableInput
from rigapp.config.names import name_refusal

app = typer.Typer(
    name="rigapp",
    help="Control, record and understand slider-crank joint wear tests.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    add_completion=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
model_app = typer.Typer(
    help="Compute forces, wear, pressure and the paper's figures.",
    no_args_is_help=True,
    rich_markup_mode=None,
)
calibrate_app = typer.Typer(
    help="Fit dead-weight and micrometer readings; certificates.",
    no_args_is_help=True,
    rich_markup_mode=None,
)
service_app = typer.Typer(
    help="Engines and page that start with the computer (systemd units of the user).",
    no_args_is_help=True,
    rich_markup_mode=None,
)
queue_app = typer.Typer(
    help="Tests of one rig, one after another, each into a file of its own.",
    no_args_is_help=True,
    rich_markup_mode=None,
)
app.add_typer(queue_app, name="queue")
app.add_typer(service_app, name="service")
app.add_typer(model_app, name="model")
app.add_typer(calibrate_app, name="calibrate")


def _file_name(parameter: typer.CallbackParam, path: Path | None) -> Path | None:
    """Refuse a name that no file can have, before anything is begun."""
    wrong = name_refusal(path) if path is not None else ""
    if wrong:
        raise UnusableInput(f"{parameter.opts[0]}: {wrong}.")
    return path


def _option(flag: str, words: str, **more: Any) -> Any:
    """Return an option that is given by its whole name."""
    return typer.Option(flag, help=words, **more)


def _file(flag: str, words: str) -> Any:
    """Return the option for a file that is written."""
    return _option(flag, words, callback=_file_name)


RecordedArgument = Annotated[Path, typer.Argument(help="Test file (HDF5).")]
RigArgument = Annotated[Path, typer.Argument(help="Rig file.")]
TestArgument = Annotated[Path, typer.Argument(help="Test file.")]
RigOption = Annotated[Path, _option("--rig", "Rig file (devices, inputs, calibration).")]
OutOption = Annotated[Path, _file("--out", "HDF5 file to make; never overwritten.")]
ToOption = Annotated[Path, _file("--to", "File to write.")]
JsonOption = Annotated[bool, _option("--json", "Print JSON.")]
SpeedOption = Annotated[
    str | None, _option("--speed", "Simulated rigs only: N times real time, or 'max'.")
]
ProgressOption = Annotated[
    str | None, _option("--progress", "'json': one JSON object a line on standard output.")
]
BindOption = Annotated[
    str | None,
    _option(
        "--bind",
        "Let viewers attach there; beyond this computer only with authorised keys.",
        metavar="tcp://ADDRESS:PORT",
    ),
]


def _show_version(wanted: bool) -> None:
    """Print the version and end, before anything else is loaded."""
    if wanted:
        from importlib.metadata import version

        print(f"rigapp {version('rigapp')}")
        raise typer.Exit


@app.callback()
def options(
    context: typer.Context,
    version: Annotated[
        bool,
        _option("--version", "Show the version.", callback=_show_version, is_eager=True),
    ] = False,
    debug: Annotated[bool, _option("--debug", "Show a traceback on errors.")] = False,
    log_level: Annotated[
        str | None,
        _option(
            "--log-level",
            "Remarks on standard error from this level on: debug, info, warning or error.",
            metavar="LEVEL",
        ),
    ] = None,
) -> None:
    """Take the options that every verb has (``--debug`` is read by ``main``)."""
    from rigapp.process.logs import chosen_level, on_terminal

    context.with_resource(on_terminal(chosen_level(log_level)))


@app.command()
def gui(
    rig: Annotated[Path | None, _option("--rig", "Rig file.")] = None,
    test: Annotated[Path | None, _option("--test", "Test file to offer first.")] = None,
    start: Annotated[bool, _option("--start", "Start that test at once.")] = False,
    language: Annotated[
        str, _option("--language", "en or de; kept for the next time. Else as the system.")
    ] = "",
) -> int:
    """Open the operator's window (without a rig file: on the simulated rig)."""
    from rigapp.commands.window import open_window

    return open_window(rig, test, start=start, language=language)


@app.command()
def run(
    test: TestArgument,
    rig: RigOption,
    out: OutOption,
    revolutions: Annotated[
        int | None, _option("--revolutions", "Instead of the test file's.", min=1)
    ] = None,
    progress: ProgressOption = None,
    speed: SpeedOption = None,
    bind: BindOption = None,
) -> int:
    """Run one test without a window."""
    from rigapp.service.registry import starting

    # First of all: a window that opens meanwhile waits for this engine.
    with starting(rig):
        from rigapp.commands.run import run_test

        return run_test(test, rig, out, revolutions, progress, speed, bind)


@app.command()
def resume(
    file: Annotated[Path, typer.Argument(help="Interrupted test file.")],
    rig: RigOption,
    progress: ProgressOption = None,
    speed: SpeedOption = None,
    bind: BindOption = None,
    reason: Annotated[
        str, _option("--reason", "Why it may go on with another calibration or zero; logged.")
    ] = "",
    check: Annotated[bool, _option("--check", "Only show what is there and what differs.")] = False,
) -> int:
    """Go on with an interrupted test in the same file, after a look at what has changed."""
    from rigapp.service.registry import starting

    with starting(rig):
        from rigapp.commands.run import examine_test, resume_test

        if check:
            return examine_test(file, rig)
        return resume_test(file, rig, progress, speed, bind, reason=reason)


@app.command()
def init(
    folder: Annotated[Path, typer.Argument(help="Folder to make or to fill.")] = Path(),
) -> int:
    """Make rig, test and calibration files to start from; overwrites nothing."""
    from rigapp.commands.init import start_folder

    return start_folder(folder)


@app.command()
def check(
    rig: RigArgument,
    test: TestArgument,
) -> int:
    """Check devices, calibration, disk and limits before a test; status 1 if anything blocks."""
    from rigapp.commands.check import check_rig

    return check_rig(rig, test)


@app.command()
def notify(
    rig: Annotated[Path | None, _option("--rig", "Rig file; else the user's ways alone.")] = None,
    test: Annotated[bool, _option("--test", "Send one message by every way.")] = False,
) -> int:
    """Show by which ways an absent operator is told, and what waits; or try them."""
    from rigapp.commands.notify import show_ways, try_ways

    return try_ways(rig) if test else show_ways(rig)


@app.command()
def reset(rig: RigArgument) -> int:
    """Release a drive that holds its emergency stop or a fault, once its cause is removed."""
    from rigapp.commands.reset import reset_drive

    return reset_drive(rig)


@app.command(context_settings={"allow_extra_args": True, "ignore_unknown_options": True})
def sim(context: typer.Context, rig: RigArgument) -> int:
    """Start the rig's simulated devices, print one JSON line of URLs, run until interrupted."""
    from rigapp.simulation.process import main as simulate

    return simulate([str(rig), *context.args])


@app.command()
def info(
    file: RecordedArgument,
    json: JsonOption = False,
) -> int:
    """Tell what a test file holds and how the test ended."""
    from rigapp.commands.files import print_info

    return print_info(file, as_json=json)


@app.command()
def export(
    file: RecordedArgument,
    to: Annotated[Path, _file("--to", "FILE.csv or FILE.parquet")],
    cycles: Annotated[bool, _option("--cycles", "Saved cycles, not statistics.")] = False,
    points: Annotated[
        int | None, _option("--points", "With --cycles: put each on so many even crank angles.")
    ] = None,
) -> int:
    """Write statistics or saved cycles as CSV or Parquet."""
    from rigapp.commands.files import export_file

    return export_file(file, to, cycles=cycles, points=points)


@app.command()
def replay(file: RecordedArgument) -> int:
    """Show a recorded test through the same window."""
    from rigapp.commands.window import replay_file

    return replay_file(file)


@app.command()
def report(
    file: RecordedArgument,
    to: Annotated[Path, _file("--to", "REPORT.html or REPORT.pdf")],
) -> int:
    """Write the report of a test, the same bytes each time."""
    from rigapp.commands.report import write_report

    return write_report(file, to)


@app.command()
def package(
    files: Annotated[list[Path], typer.Argument(help="Test files (HDF5).", metavar="FILE...")],
    to: Annotated[Path, _file("--to", "FILE.zip to make; never overwritten.")],
    author: Annotated[
        list[str] | None, _option("--author", "'Family, Given'; repeatable. Else the operators.")
    ] = None,
    licence: Annotated[str, _option("--licence", "Of the data, as SPDX names it.")] = "CC-BY-4.0",
    allow_private: Annotated[
        bool, _option("--allow-private", "Also with what looks private; it is shown.")
    ] = False,
) -> int:
    """Pack tests as they are published; status 1 when something private is in them."""
    from rigapp.commands.package import package_tests

    return package_tests(files, to, author or [], licence, allow_private=allow_private)


@app.command()
def identify(
    files: Annotated[list[Path], typer.Argument(help="Test files (HDF5).", metavar="FILE...")],
    to: Annotated[
        Path | None, _file("--to", "Write it: REPORT.html, .pdf, or a .csv or .json.")
    ] = None,
    json: JsonOption = False,
    after: Annotated[
        int | None, _option("--after", "As it was known after so many revolutions.", min=1)
    ] = None,
) -> int:
    """Tell the wear coefficient of recorded tests, what remains, and how specimens scatter."""
    from rigapp.commands.identify import identify_tests

    return identify_tests(files, to, as_json=json, after=after)


@app.command()
def picture(file: RecordedArgument, to: ToOption) -> int:
    """Draw a recorded test as the window shows it (PNG)."""
    from rigapp.commands.window import draw_picture

    return draw_picture(file, to)


ParametersArgument = Annotated[Path, typer.Argument(metavar="PARAMS.toml", help="Parameters.")]
RpmOption = Annotated[float, _option("--rpm", "Crank speed, rpm.")]
JointOption = Annotated[str, _option("--joint", f"{listed()} (paper: 3.1, 3.2).")]
TimeLimitOption = Annotated[
    float | None, _option("--time-limit-s", "Write what was reached by then and end with status 1.")
]


@model_app.command("forces")
def model_forces(
    params: ParametersArgument,
    rpm: RpmOption,
    to: ToOption,
    joint: JointOption = "perfect",
    clearance_mm: Annotated[
        float | None, _option("--clearance-mm", "Radial clearance instead of the file's.")
    ] = None,
    points: Annotated[int, _option("--points", "Crank angles of the cycle.")] = 360,
    revolutions: Annotated[
        int | None, _option("--revolutions", "Joint contact: add means over so many, with errors.")
    ] = None,
    tolerance: Annotated[
        float | None, _option("--tolerance", "Joint contact: error of a step, of the penetration.")
    ] = None,
    time_limit_s: TimeLimitOption = None,
) -> int:
    """Write motion and forces over one cycle of the mechanism as CSV."""
    from rigapp.commands.model.forces import write_forces
    from rigapp.commands.model.impacts import Impacting

    impacting = Impacting(revolutions, tolerance, time_limit_s)
    return write_forces(params, rpm, joint, clearance_mm, points, to, impacting)


@model_app.command("wear")
def model_wear(
    params: ParametersArgument,
    rpm: RpmOption,
    cycles: Annotated[int, _option("--cycles", "Cycles of the whole life.")],
    to: ToOption,
    joint: JointOption = "continuous",
    force_n: Annotated[
        float | None,
        _option("--force-N", "Constant force along the follower, N, not the mechanism's."),
    ] = None,
    tolerance: Annotated[
        float, _option("--tolerance", "Largest relative error of the depth.")
    ] = 1e-3,
    method: Annotated[
        str, _option("--method", "implicit, or explicit: extrapolated as in the paper.")
    ] = "implicit",
    extrapolation: Annotated[
        float | None,
        _option(
            "--extrapolation",
            "Method explicit: most cycles of a step; by default half the stability limit.",
        ),
    ] = None,
    contact: Annotated[
        str, _option("--contact", "finite-element, or winkler: a bed of springs.")
    ] = "finite-element",
    profile: Annotated[
        Path | None, _file("--profile", "CSV of the worn profile at the end.")
    ] = None,
    time_limit_s: TimeLimitOption = None,
) -> int:
    """Write the life of the bushing as CSV."""
    from rigapp.commands.model.wear import Scheme, write_wear

    scheme = Scheme(method, extrapolation, contact)
    return write_wear(
        params, rpm, cycles, joint, force_n, tolerance, to, profile, time_limit_s, scheme
    )


@model_app.command("pressure")
def model_pressure(
    params: ParametersArgument,
    force_n: Annotated[float, _option("--force-N", "Force of the pin, N.")],
    to: ToOption,
) -> int:
    """Write the contact pressure of one load as CSV and print the pin displacement."""
    from rigapp.commands.model.wear import write_pressure

    return write_pressure(params, force_n, to)


@model_app.command("paper")
def model_paper(
    to: Annotated[Path, _option("--to", "Folder for plots and tables.")] = Path("paper"),
    file: Annotated[
        Path | None, _option("--file", "Recorded test (HDF5) for Figs 20 and 21.")
    ] = None,
    time_limit_s: TimeLimitOption = None,
) -> int:
    """Make the paper's comparisons (Figs 6-10, 13, 15, 20, 21, Table 2) as plots and tables."""
    from rigapp.commands.model.paper import write_paper

    return write_paper(to, file, time_limit_s)


@app.command()
def study(
    file: Annotated[Path, typer.Argument(help="Study file (TOML).")],
    to: Annotated[Path, _option("--to", "Folder of the results; a study there is gone on with.")],
    scheduler: Annotated[
        str, _option("--scheduler", "Dask scheduler, tcp://ADDRESS:PORT; else this computer.")
    ] = "",
    workers: Annotated[
        int | None, _option("--workers", "Processes here; by default one a core.", min=1)
    ] = None,
) -> int:
    """Vary parameters of the model, or of virtual tests, and gather the results in a table."""
    from rigapp.commands.study import make_study

    return make_study(file, to, scheduler, workers)


TableOption = Annotated[Path | None, _option("--readings", "CSV of readings as taken; or --rig.")]
LiveOption = Annotated[Path | None, _option("--rig", "Rig file: take the readings live.")]
SettingsOption = Annotated[Path, _option("--settings", "Settings file (TOML).")]
RecordOption = Annotated[Path, _file("--to", "Record to make; never overwritten.")]
RecordArgument = Annotated[Path, typer.Argument(help="Calibration record.")]
JournalOption = Annotated[
    Path | None, _file("--journal", "Where events are kept; taken up if there.")
]
PractiseOption = Annotated[
    bool, _option("--practise", "Simulated rig: simulated hands do the work.")
]


@calibrate_app.command("load-cell")
def calibrate_load_cell(
    settings: SettingsOption,
    to: RecordOption,
    readings: TableOption = None,
    json: JsonOption = False,
    rig: LiveOption = None,
    plan: Annotated[str, _option("--plan", "daily, routine or full.")] = "routine",
    weights: Annotated[
        str, _option("--weights", "Pieces in kg; 5x8: eight pieces of 5 kg.")
    ] = "5x8,2,2,1,0.5",
    journal: JournalOption = None,
    practise: PractiseOption = False,
) -> int:
    """Calibrate the load cell from a CSV of readings or live; a bad fit is refused, not saved."""
    from rigapp.commands.live.terminal import calibrate

    asked = {"plan": plan, "weights": weights}
    return calibrate(
        "load cell", asked, settings, to, readings, rig,
        journal=journal, practise=practise, as_json=json,
    )  # fmt: skip


@calibrate_app.command("probes")
def calibrate_probes(
    settings: SettingsOption,
    to: RecordOption,
    readings: TableOption = None,
    json: JsonOption = False,
    rig: LiveOption = None,
    probe: Annotated[str, _option("--probe", "1, 2, or both with their alignment.")] = "1",
    plan: Annotated[
        str, _option("--plan", "routine (1 run up and down) or full (3 runs).")
    ] = "full",
    positions: Annotated[int, _option("--positions", "Positions of a run.")] = 11,
    reach_um: Annotated[
        float | None, _option("--reach-um", "Largest position; else 80 % of the probe's range.")
    ] = None,
    journal: JournalOption = None,
    practise: PractiseOption = False,
) -> int:
    """Calibrate probes by micrometer steps, from a CSV or live; a bad fit is refused, not saved."""
    from rigapp.commands.live.terminal import calibrate

    asked = {"which": probe, "plan": plan, "reach": reach_um, "positions": positions}
    return calibrate(
        "probes", asked, settings, to, readings, rig,
        journal=journal, practise=practise, as_json=json,
    )  # fmt: skip


@calibrate_app.command("channel")
def calibrate_channel(
    settings: SettingsOption,
    to: RecordOption,
    readings: Annotated[Path, _option("--readings", "CSV of voltages beside a reference.")],
    json: JsonOption = False,
) -> int:
    """Calibrate a free channel, as a line or a table, from a CSV; a bad fit is refused."""
    from rigapp.commands.calibrate import calibrate_table

    return calibrate_table("channel", readings, settings, to, as_json=json)


@calibrate_app.command("run-out")
def calibrate_run_out(
    to: RecordOption,
    rig: Annotated[Path | None, _option("--rig", "Rig file: roll the spindle slowly now.")] = None,
    recorded: Annotated[
        list[Path] | None,
        _option("--from", "Test file of a slow roll, whole cycles kept; repeatable."),
    ] = None,
    settings: Annotated[
        Path | None, _option("--settings", "Settings file: [pin], [paperwork].")
    ] = None,
    test: Annotated[
        Path | None, _option("--test", "Test file whose mechanism and limits are kept.")
    ] = None,
    rpm: Annotated[
        str, _option("--rpm", "Speeds of the rolls; two tell inertia from run-out.")
    ] = "3,6",
    revolutions: Annotated[int, _option("--revolutions", "Of each roll.")] = 12,
    orders: Annotated[int, _option("--orders", "Fourier orders of the map.")] = 8,
    json: JsonOption = False,
) -> int:
    """Map the pin's run-out by a slow roll of the spindle; a bad roll is refused, not saved."""
    from rigapp.commands.live.spindle_runs import calibrate_run_out as make

    return make(
        rig,
        recorded or [],
        to,
        settings=settings,
        test=test,
        rpm=rpm,
        revolutions=revolutions,
        orders=orders,
        as_json=json,
    )


@calibrate_app.command("running-check")
def calibrate_running_check(
    rig: RigOption,
    to: RecordOption,
    speeds: Annotated[
        str, _option("--speeds", "Speeds in rpm; the slowest is the zero.")
    ] = "30,120,240",
    revolutions: Annotated[int, _option("--revolutions", "At each speed.")] = 20,
    mass_kg: Annotated[
        float | None,
        _option("--mass-kg", "Of the pin outboard of the gauges; else the rig file's."),
    ] = None,
    radius_mm: Annotated[
        float | None, _option("--radius-mm", "Of that mass; else the rig file's.")
    ] = None,
    follower_off: Annotated[
        bool, _option("--follower-off", "The follower is off, nothing hangs on the pin.")
    ] = False,
    settings: Annotated[
        Path | None, _option("--settings", "Settings file of a calibration: paperwork.")
    ] = None,
    json: JsonOption = False,
) -> int:
    """Turn the pin alone: does the cell show its known inertia, - m r w^2 in force_1?"""
    from rigapp.commands.live.spindle_runs import check_running

    return check_running(
        rig,
        to,
        speeds=speeds,
        revolutions=revolutions,
        mass_kg=mass_kg,
        radius_mm=radius_mm,
        follower_off=follower_off,
        settings=settings,
        as_json=json,
    )


@calibrate_app.command("history")
def calibrate_history(
    store: Annotated[Path, typer.Argument(help="Store of daily checks.")] = Path(
        "daily-checks.jsonl"
    ),
    to: Annotated[Path | None, _file("--to", "Draw the charts: .png, .html or .pdf.")] = None,
    rig: Annotated[
        str | None, _option("--rig-name", "Only this rig; else that of the last check.")
    ] = None,
    json: JsonOption = False,
) -> int:
    """Show the daily checks and their control charts; status 1 when a rule asks for action."""
    from rigapp.commands.calibrate import show_history

    return show_history(store, to, rig, as_json=json)


@calibrate_app.command("certificate")
def calibrate_certificate(
    record: RecordArgument,
    to: Annotated[Path, _file("--to", "FILE.pdf or FILE.html")],
    issued: Annotated[str, _option("--issued", "Date of issue; else that of the record.")] = "",
) -> int:
    """Write the certificate of a record, the same bytes each time."""
    from rigapp.commands.records import certify

    return certify(record, to, issued)


@calibrate_app.command("verify")
def calibrate_verify(
    record: RecordArgument,
    public_key: Annotated[
        Path | None, _option("--public-key", "Key of the laboratory that must have signed it.")
    ] = None,
    json: JsonOption = False,
) -> int:
    """Fit the readings of a record again and compare; status 1 where they differ."""
    from rigapp.commands.records import verify_record

    return verify_record(record, public_key, as_json=json)


@calibrate_app.command("key")
def calibrate_key(
    to: Annotated[Path, _file("--to", "Private key to make; FILE.pub beside.")],
) -> int:
    """Make the key with which a laboratory signs records, and its public key."""
    from rigapp.commands.records import make_key

    return make_key(to)


@calibrate_app.command("sign")
def calibrate_sign(
    record: RecordArgument,
    key: Annotated[Path, _option("--key", "Private key, readable by its owner alone.")],
    to: RecordOption,
) -> int:
    """Sign a record that follows from its readings; the signed one is a new file."""
    from rigapp.commands.records import sign_record

    return sign_record(record, key, to)


@app.command()
def doctor(
    port: Annotated[
        str | None, _option("--port", "Ask only this port who is there.", metavar="URL")
    ] = None,
) -> int:
    """Show versions, ports with the devices on them, permissions; test the window's libraries."""
    from rigapp.commands.doctor import examine

    return examine(port)


@app.command()
def status(
    rig: Annotated[Path | None, _option("--rig", "Only the engine of this rig.")] = None,
    json: JsonOption = False,
) -> int:
    """Show the engines that run: state, revolution, alarms, who is in command; 1 when none does."""
    from rigapp.commands.status import show_engines

    return show_engines(rig, as_json=json)


PageBindOption = Annotated[
    str,
    _option(
        "--bind",
        "Where to listen; beyond this computer only with token, certificate and key.",
        metavar="ADDRESS:PORT",
    ),
]
TokenOption = Annotated[
    Path | None, _option("--token", "File of mode 0600 with what a visitor must know.")
]
CertificateOption = Annotated[Path | None, _option("--certificate", "Certificate (PEM).")]
KeyOption = Annotated[Path | None, _option("--key", "Its private key (PEM), mode 0600.")]


@app.command()
def page(
    rig: Annotated[
        list[Path] | None,
        _option("--rig", "Rig file, or entry of an engine elsewhere; repeatable. Else all here."),
    ] = None,
    bind: PageBindOption = "127.0.0.1:8750",
    token: TokenOption = None,
    certificate: CertificateOption = None,
    key: KeyOption = None,
) -> int:
    """Show the engines that run as a read-only page, and as metrics for Prometheus."""
    from rigapp.commands.page import serve_page

    return serve_page(rig or [], bind, token, certificate, key)


OperatorOption = Annotated[str, _option("--operator", "Who asks; stands in the log.")]


@queue_app.command("add")
def queue_add(
    tests: Annotated[list[Path], typer.Argument(help="Test files, in their order.")],
    rig: RigOption,
    to: Annotated[Path, _option("--to", "Folder for the recorded files.")] = Path("results"),
) -> int:
    """Put tests at the end of the queue; each file is named after its test and the moment."""
    from rigapp.commands import queue

    return queue.add(tests, rig, to)


@queue_app.command("list")
def queue_list(rig: RigOption, json: JsonOption = False) -> int:
    """Show the queue: number, state, file, how it ended."""
    from rigapp.commands import queue

    return queue.show(rig, as_json=json)


@queue_app.command("remove")
def queue_remove(
    numbers: Annotated[list[int], typer.Argument(help="Numbers, as the list shows them.")],
    rig: RigOption,
) -> int:
    """Take tests out of the queue; what they have recorded stays."""
    from rigapp.commands import queue

    return queue.remove(numbers, rig)


@queue_app.command("start")
def queue_start(rig: RigOption, operator: OperatorOption = "") -> int:
    """Begin the next test, or go on with the one that stopped; the rest follows by itself.

    It stops at the first test that does not end as planned.
    """
    from rigapp.commands import queue

    return queue.start(rig, operator)


@queue_app.command("stop")
def queue_stop(rig: RigOption, operator: OperatorOption = "") -> int:
    """Begin no other test; the one that runs goes on to its end."""
    from rigapp.commands import queue

    return queue.stop(rig, operator)


@service_app.command("install")
def service_install(
    rig: Annotated[
        list[Path] | None, _option("--rig", "Rig file whose engine is to start; repeatable.")
    ] = None,
    page: Annotated[bool, _option("--page", "The page as well.")] = False,
    page_bind: Annotated[
        str, _option("--page-bind", "Where the page listens.", metavar="ADDRESS:PORT")
    ] = "127.0.0.1:8750",
    token: TokenOption = None,
    certificate: CertificateOption = None,
    key: KeyOption = None,
    show: Annotated[bool, _option("--show", "Print the units; write and start nothing.")] = False,
) -> int:
    """Start engines and page with the computer; an engine connects and tells, nothing turns."""
    from rigapp.commands import service

    units = [service.engine_unit(one) for one in rig or []]
    if page:
        units.append(service.page_unit(page_bind, token, certificate, key))
    if not units:
        raise UnusableInput("Name what is to start with the computer: --rig RIG.toml, --page.")
    return service.show(units) if show else service.install(units)


@service_app.command("remove")
def service_remove(
    rig: Annotated[
        list[Path] | None, _option("--rig", "Rig file whose engine is meant; else all, and page.")
    ] = None,
) -> int:
    """Stop them and start them no more; what runs is ended as by a signal."""
    from rigapp.commands import service

    return service.remove(rig or [])


@app.command()
def keys() -> None:
    """Make this user's key pair as a viewer of rigs elsewhere; print the file to hand over."""
    from rigapp.service.registry import lasting_folder
    from rigapp.service.security import viewer_keys

    folder = lasting_folder()
    viewer_keys(folder)
    print(folder / "keys" / "viewer.key")


@app.command(hidden=True)
def engine(
    rig: Annotated[Path, typer.Argument()],
    speed: SpeedOption = None,
    bind: BindOption = None,
    stay: Annotated[bool, _option("--stay", "Also while nobody looks on.")] = False,
) -> int:
    """Host an engine for windows to attach to."""
    from rigapp.service.registry import starting

    with starting(rig):
        from rigapp.service.host import serve

        return serve(rig, speed, bind, stay=stay)


INTERRUPTED = 130
"""What the command line's library returns after Ctrl-C."""


def main() -> NoReturn:
    """Run the command line and exit with its status."""
    # Threads of the linear algebra would fight the acquisition for the cores.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    debug = "--debug" in sys.argv
    arguments = [word for word in sys.argv[1:] if word != "--debug"]
    try:
        status = app(args=arguments, prog_name="rigapp", standalone_mode=False)
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
    """Say what went wrong in one sentence and return the exit status that it stands for."""
    if isinstance(error, OSError) and error.errno == errno.ENAMETOOLONG:
        start = str(error.filename)[:40]
        print(f"rigapp: the name {start}... is too long; shorten it.", file=sys.stderr)
        return 2
    wrong_call = getattr(error, "format_message", None)
    if wrong_call is None:
        print(f"rigapp: {error or type(error).__name__}", file=sys.stderr)
        return _status_of(error)
    if type(error).__name__ == "NoArgsIsHelpError":
        print(wrong_call())
    else:
        print(f"rigapp: {wrong_call()} See 'rigapp --help'.", file=sys.stderr)
    return 2


def _status_of(error: Exception) -> int:
    """Return the exit status of an error that a verb raised."""
    if isinstance(error, UnusableInput):
        return 2
    module = sys.modules.get("drivers.api")
    if module is not None and isinstance(error, module.DeviceError):
        return 3
    return 1
