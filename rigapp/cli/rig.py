"""Verbs of a rig: run, stop, check, the queue of its tests, and what starts with the computer."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from rigapp.cli.options import (
    BindOption,
    CertificateOption,
    JsonOption,
    KeyOption,
    OperatorOption,
    OutOption,
    ProgressOption,
    RigArgument,
    RigOption,
    SpeedOption,
    TestArgument,
    TokenOption,
    group,
    option,
)
from rigapp.config.errors import UnusableInput

verbs = group()


@verbs.command()
def gui(
    rig: Annotated[Path | None, option("--rig", "Rig file.")] = None,
    test: Annotated[Path | None, option("--test", "Test file to offer first.")] = None,
    start: Annotated[bool, option("--start", "Start that test at once.")] = False,
    language: Annotated[
        str, option("--language", "en or de; stored. Default: the system's language.")
    ] = "",
) -> int:
    """Open the operator's window (without a rig file: on the simulated rig)."""
    from rigapp.commands.window import open_window

    return open_window(rig, test, start=start, language=language)


@verbs.command()
def run(
    test: TestArgument,
    rig: RigOption,
    out: OutOption,
    revolutions: Annotated[
        int | None, option("--revolutions", "Instead of the test file's.", min=1)
    ] = None,
    progress: ProgressOption = None,
    speed: SpeedOption = None,
    bind: BindOption = None,
    record_wire: Annotated[
        Path | None,
        option("--record-wire", "Keep all bytes of each device: FILE with its name added."),
    ] = None,
) -> int:
    """Run one test without a window."""
    from rigapp.service.registry import starting

    # First of all: a window that opens meanwhile waits for this engine.
    with starting(rig):
        from rigapp.commands.run import run_test

        return run_test(test, rig, out, revolutions, progress, speed, bind, record_wire)


@verbs.command()
def resume(
    file: Annotated[Path, typer.Argument(help="Interrupted test file.")],
    rig: RigOption,
    progress: ProgressOption = None,
    speed: SpeedOption = None,
    bind: BindOption = None,
    reason: Annotated[
        str, option("--reason", "Reason for resuming with another calibration or zero; logged.")
    ] = "",
    check: Annotated[
        bool, option("--check", "Only show the state of the file and the differences.")
    ] = False,
) -> int:
    """Resume an interrupted test in the same file, after a check of what has changed."""
    from rigapp.service.registry import starting

    with starting(rig):
        from rigapp.commands.run import examine_test, resume_test

        if check:
            return examine_test(file, rig)
        return resume_test(file, rig, progress, speed, bind, reason=reason)


@verbs.command()
def init(
    folder: Annotated[Path, typer.Argument(help="Folder to make or to fill.")] = Path(),
    real: Annotated[
        bool, option("--real", "For real devices, entered interactively or by options.")
    ] = False,
    daq: Annotated[str, option("--daq", "Driver of the data acquisition.", metavar="DRIVER")] = "",
    daq_port: Annotated[str, option("--daq-port", "Its port; default: search.")] = "",
    drive: Annotated[str, option("--drive", "Driver of the drive.", metavar="DRIVER")] = "",
    drive_port: Annotated[str, option("--drive-port", "Its port; default: search.")] = "",
) -> int:
    """Make rig, test and calibration files to start from; overwrites nothing."""
    named = {"daq": (daq, daq_port), "drive": (drive, drive_port)}
    if real:
        from rigapp.commands.init import prepare_real_folder

        return prepare_real_folder(folder, named)
    if any(named["daq"] + named["drive"]):
        raise UnusableInput("--daq, --drive and their ports are of real devices; add --real.")
    from rigapp.commands.init import prepare_folder

    return prepare_folder(folder)


@verbs.command()
def schema(
    kind: Annotated[str, typer.Argument(help="rig or test.", metavar="rig|test")],
) -> int:
    """Print the JSON Schema of a rig or test file, for editors that complete and check it."""
    from rigapp.commands.init import print_schema

    return print_schema(kind)


@verbs.command()
def check(
    rig: RigArgument,
    test: TestArgument,
    json: JsonOption = False,
) -> int:
    """Check devices, calibration, disk and limits before a test; status 1 if anything blocks."""
    from rigapp.commands.check import check_rig

    return check_rig(rig, test, as_json=json)


@verbs.command()
def reset(rig: RigArgument) -> int:
    """Release a drive that holds its emergency stop or a fault, once its cause is removed."""
    from rigapp.commands.status import reset_drive

    return reset_drive(rig)


@verbs.command(context_settings={"allow_extra_args": True, "ignore_unknown_options": True})
def sim(context: typer.Context, rig: RigArgument) -> int:
    """Start the rig's simulated devices, print one JSON line of URLs, run until interrupted."""
    from rigapp.simulation.process import main as simulate

    return simulate([str(rig), *context.args])


@verbs.command()
def wire(
    file: Annotated[Path, typer.Argument(help="Recorded line of a device.")],
    raw: Annotated[bool, option("--bytes", "Show the bytes instead of their meaning.")] = False,
    report: Annotated[
        Path | None,
        option("--bug-report", "FILE is a rig file: record its lines, packed into this ZIP file."),
    ] = None,
    seconds: Annotated[float, option("--seconds", "How long to record, with --bug-report.")] = 10.0,
) -> int:
    """Show the recorded traffic between a device and the program, decoded by its driver."""
    from rigapp.commands.status import report_lines, show_line

    if report is not None:
        return report_lines(file, report, seconds)
    return show_line(file, raw=raw)


@verbs.command()
def doctor(
    port: Annotated[str | None, option("--port", "Examine only this port.", metavar="URL")] = None,
    json: JsonOption = False,
    rules: Annotated[
        bool, option("--rules", "Print udev rules for the ports of a rig, and nothing else.")
    ] = False,
) -> int:
    """Show versions, ports with the devices on them, permissions; test the window's libraries."""
    from rigapp.commands.doctor import examine, print_rules

    return print_rules() if rules else examine(port, as_json=json)


@verbs.command()
def status(
    rig: Annotated[Path | None, option("--rig", "Only the engine of this rig.")] = None,
    json: JsonOption = False,
) -> int:
    """Show the running engines: state, revolution, alarms, who has control; 1 when none runs."""
    from rigapp.commands.status import show_engines

    return show_engines(rig, as_json=json)


@verbs.command()
def notify(
    rig: Annotated[
        Path | None, option("--rig", "Rig file; default: only the user's notification channels.")
    ] = None,
    test: Annotated[bool, option("--test", "Send a test message through every channel.")] = False,
) -> int:
    """Show the recipients of messages and the messages that wait; or send a test message."""
    from rigapp.commands.unattended import show_ways, try_ways

    return try_ways(rig) if test else show_ways(rig)


PageBindOption = Annotated[
    str,
    option(
        "--bind",
        "Where to listen; beyond this computer only with token, certificate and key.",
        metavar="ADDRESS:PORT",
    ),
]


@verbs.command()
def page(
    rig: Annotated[
        list[Path] | None,
        option("--rig", "Rig file, or entry of an engine elsewhere; repeatable. Else all here."),
    ] = None,
    bind: PageBindOption = "127.0.0.1:8750",
    token: TokenOption = None,
    certificate: CertificateOption = None,
    key: KeyOption = None,
) -> int:
    """Show the running engines as a read-only page, and as metrics for Prometheus."""
    from rigapp.commands.window import serve_page

    return serve_page(rig or [], bind, token, certificate, key)


@verbs.command()
def keys() -> None:
    """Create this user's viewer keys for remote rigs; print the file for the engine's owner."""
    from rigapp.service.registry import lasting_folder
    from rigapp.service.security import viewer_keys

    folder = lasting_folder()
    viewer_keys(folder)
    print(folder / "keys" / "viewer.key")


@verbs.command(hidden=True)
def engine(
    rig: Annotated[Path, typer.Argument()],
    speed: SpeedOption = None,
    bind: BindOption = None,
    stay: Annotated[bool, option("--stay", "Keep running without viewers.")] = False,
) -> int:
    """Host an engine for windows to attach to."""
    from rigapp.service.registry import starting

    with starting(rig):
        from rigapp.commands.engine import serve

        return serve(rig, speed, bind, stay=stay)


queue_verbs = group("Tests of one rig, one after another, each into a file of its own.")
service_verbs = group("Engines and page that start with the computer (systemd units of the user).")


@queue_verbs.command("add")
def queue_add(
    tests: Annotated[list[Path], typer.Argument(help="Test files, in their order.")],
    rig: RigOption,
    to: Annotated[Path, option("--to", "Folder for the recorded files.")] = Path("results"),
) -> int:
    """Append tests to the queue; files are named by test and time."""
    from rigapp.commands.unattended import queue_tests

    return queue_tests(tests, rig, to)


@queue_verbs.command("list")
def queue_list(rig: RigOption, json: JsonOption = False) -> int:
    """Show the queue: number, state, file, how it ended."""
    from rigapp.commands.unattended import show_queue

    return show_queue(rig, as_json=json)


@queue_verbs.command("remove")
def queue_remove(
    numbers: Annotated[list[int], typer.Argument(help="Numbers, as the list shows them.")],
    rig: RigOption,
) -> int:
    """Take tests out of the queue; what they have recorded stays."""
    from rigapp.commands.unattended import unqueue_tests

    return unqueue_tests(numbers, rig)


@queue_verbs.command("start")
def queue_start(rig: RigOption, operator: OperatorOption = "") -> int:
    """Start the next test, or resume the one that stopped; the rest follows by itself.

    It stops at the first test that does not end as planned.
    """
    from rigapp.commands.unattended import start_queue

    return start_queue(rig, operator)


@queue_verbs.command("stop")
def queue_stop(rig: RigOption, operator: OperatorOption = "") -> int:
    """Start no other test; the running one continues to its end."""
    from rigapp.commands.unattended import stop_queue

    return stop_queue(rig, operator)


@service_verbs.command("install")
def service_install(
    rig: Annotated[
        list[Path] | None, option("--rig", "Rig file whose engine is to start; repeatable.")
    ] = None,
    page: Annotated[bool, option("--page", "The page as well.")] = False,
    page_bind: Annotated[
        str, option("--page-bind", "Where the page listens.", metavar="ADDRESS:PORT")
    ] = "127.0.0.1:8750",
    token: TokenOption = None,
    certificate: CertificateOption = None,
    key: KeyOption = None,
    rules: Annotated[
        bool, option("--rules", "Only the udev rules for the ports of a rig; needs root.")
    ] = False,
    show: Annotated[bool, option("--show", "Print the units; write and start nothing.")] = False,
) -> int:
    """Start engines and page with the computer; engines connect and report, nothing moves."""
    from rigapp.commands import unattended

    if rules:
        if rig or page or show:
            raise UnusableInput("--rules is for root, the other options are for a user; part them.")
        return unattended.install_rules()

    units = [unattended.engine_unit(path) for path in rig or []]
    if page:
        units.append(unattended.page_unit(page_bind, token, certificate, key))
    if not units:
        raise UnusableInput(
            "Name what is to start with the computer: --rig RIG.toml, --page; or --rules."
        )
    return unattended.show_units(units) if show else unattended.install_units(units)


@service_verbs.command("remove")
def service_remove(
    rig: Annotated[
        list[Path] | None,
        option("--rig", "Rig file of the engine; default: all engines and the page."),
    ] = None,
) -> int:
    """Stop the services and remove them from the start-up; a running test ends as by a signal."""
    from rigapp.commands import unattended

    return unattended.remove_units(rig or [])
