"""Verbs for tests that nobody stands beside: the queue, and what starts with the computer."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from rigapp.cli.options import (
    CertificateOption,
    JsonOption,
    KeyOption,
    OperatorOption,
    RigOption,
    TokenOption,
    group,
    option,
)
from rigapp.config.errors import UnusableInput

queue_verbs = group("Tests of one rig, one after another, each into a file of its own.")
service_verbs = group("Engines and page that start with the computer (systemd units of the user).")


@queue_verbs.command("add")
def queue_add(
    tests: Annotated[list[Path], typer.Argument(help="Test files, in their order.")],
    rig: RigOption,
    to: Annotated[Path, option("--to", "Folder for the recorded files.")] = Path("results"),
) -> int:
    """Put tests at the end of the queue; each file is named after its test and the moment."""
    from rigapp.commands import queue

    return queue.add(tests, rig, to)


@queue_verbs.command("list")
def queue_list(rig: RigOption, json: JsonOption = False) -> int:
    """Show the queue: number, state, file, how it ended."""
    from rigapp.commands import queue

    return queue.show(rig, as_json=json)


@queue_verbs.command("remove")
def queue_remove(
    numbers: Annotated[list[int], typer.Argument(help="Numbers, as the list shows them.")],
    rig: RigOption,
) -> int:
    """Take tests out of the queue; what they have recorded stays."""
    from rigapp.commands import queue

    return queue.remove(numbers, rig)


@queue_verbs.command("start")
def queue_start(rig: RigOption, operator: OperatorOption = "") -> int:
    """Begin the next test, or go on with the one that stopped; the rest follows by itself.

    It stops at the first test that does not end as planned.
    """
    from rigapp.commands import queue

    return queue.start(rig, operator)


@queue_verbs.command("stop")
def queue_stop(rig: RigOption, operator: OperatorOption = "") -> int:
    """Begin no other test; the one that runs goes on to its end."""
    from rigapp.commands import queue

    return queue.stop(rig, operator)


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
    """Start engines and page with the computer; an engine connects and tells, nothing turns."""
    from rigapp.commands import service

    if rules:
        if rig or page or show:
            raise UnusableInput("--rules is for root, the other options are for a user; part them.")
        return service.install_rules()

    units = [service.engine_unit(one) for one in rig or []]
    if page:
        units.append(service.page_unit(page_bind, token, certificate, key))
    if not units:
        raise UnusableInput(
            "Name what is to start with the computer: --rig RIG.toml, --page; or --rules."
        )
    return service.show(units) if show else service.install(units)


@service_verbs.command("remove")
def service_remove(
    rig: Annotated[
        list[Path] | None, option("--rig", "Rig file whose engine is meant; else all, and page.")
    ] = None,
) -> int:
    """Stop them and start them no more; what runs is ended as by a signal."""
    from rigapp.commands import service

    return service.remove(rig or [])
