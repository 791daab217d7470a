"""The table of calibration types.

A new type is an entry here, and its parts: its fit and checks (``calibration``), its
result and, if it is taken step by step, its session (beside this module), the sections of its
certificate, and where a rig file names its records (``records_in_use``). The command line has one
function for its options (``rigapp.cli``), the window one for its pages (``rigapp.gui.wizard``).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from rigapp.calibrating.certificates.comparisons import channel_parts, running_parts
from rigapp.calibrating.certificates.formatting import Parts
from rigapp.calibrating.certificates.load_cell import load_cell_parts
from rigapp.calibrating.certificates.probes import probe_parts, run_out_parts
from rigapp.calibrating.channel import KIND as CHANNEL
from rigapp.calibrating.channel import fit_channel
from rigapp.calibrating.load_cell_result import fit_load_cell
from rigapp.calibrating.load_cell_session import LoadCellSession, load_cell_plan
from rigapp.calibrating.probe_result import fit_probes
from rigapp.calibrating.probe_session import PROBES as WHICH_PROBES
from rigapp.calibrating.probe_session import ProbeSession, probe_plan
from rigapp.calibrating.records_in_use import LOAD_CELL, PROBES, RUN_OUT, RecordPlace
from rigapp.calibrating.rolls import FASTEST_RPM, REVOLUTIONS, roll_plan
from rigapp.calibrating.run_out import RUN_OUT_COLUMNS
from rigapp.calibrating.running_check import RUNNING_COLUMNS
from rigapp.calibrating.session import LiveSession, Outcome
from rigapp.config.calibration_settings import (
    CalibrationFile,
    ChannelFile,
    LoadCellFile,
    ProbeFile,
    RunOutFile,
    probe_meaning,
)
from rigapp.config.errors import UnusableInput
from rigapp.texts import joined, say
from rigapp_calibration.channel import CHANNEL_COLUMNS
from rigapp_calibration.load_cell.readings import LOAD_CELL_COLUMNS
from rigapp_calibration.probes.readings import PROBE_COLUMNS
from rigapp_calibration.taking.readings import read_table


@dataclass(frozen=True, slots=True)
class Subject:
    """One calibration type.

    name: of the command, with blanks. plan (choices by name, settings): of live readings; raises
    UnusableInput. kinds: of its records. columns: of its readings. settings: of its file.
    fit (readings as CSV, settings, where they are from, which of several): raises
    ReadingsError or UnusableInput; None where the readings are test files. session: with live
    readings step by step, None for others. certificate: of a record's content. place: where a rig
    file names its records, None for a check that changes nothing there, and for free channels, of
    which each rig has its own. fastest_rpm: fastest speed of the spindle, 0: never.
    """

    name: str
    kinds: tuple[str, ...]
    columns: tuple[str, ...]
    settings: type[CalibrationFile]
    certificate: Callable[[Mapping[str, Any]], Parts]
    fit: Callable[[str, Any, str, str], Outcome] | None = None
    session: type[LiveSession[Any, Any, Any]] | None = None
    plan: Callable[[Mapping[str, Any], Any], Any] | None = None
    place: RecordPlace | None = None
    fastest_rpm: float = 0.0


def _fit_load_cell(text: str, file: LoadCellFile, where: str, which: str) -> Outcome:
    return fit_load_cell(read_table(text, LOAD_CELL_COLUMNS), file, where)


def _fit_probes(text: str, file: ProbeFile, where: str, which: str) -> Outcome:
    """Fit one probe, whichever it is, or a pair, whose series are 1.x and 2.x."""
    if which not in WHICH_PROBES:
        raise UnusableInput("--probe {}: choose {}.", which, joined(", ", WHICH_PROBES))
    rows = read_table(text, PROBE_COLUMNS)
    return fit_probes(rows, [probe_meaning(file)] * len(WHICH_PROBES[which]))


SUBJECTS: Mapping[str, Subject] = {
    subject.name: subject
    for subject in (
        Subject(
            name="load cell",
            kinds=LOAD_CELL.kinds,
            columns=LOAD_CELL_COLUMNS,
            settings=LoadCellFile,
            certificate=load_cell_parts,
            fit=_fit_load_cell,
            session=LoadCellSession,
            plan=load_cell_plan,
            place=LOAD_CELL,
        ),
        Subject(
            name="probes",
            kinds=PROBES.kinds,
            columns=PROBE_COLUMNS,
            settings=ProbeFile,
            certificate=probe_parts,
            fit=_fit_probes,
            session=ProbeSession,
            plan=probe_plan,
            place=PROBES,
        ),
        Subject(
            name="run-out",
            kinds=RUN_OUT.kinds,
            columns=RUN_OUT_COLUMNS,
            settings=RunOutFile,
            certificate=run_out_parts,
            plan=lambda choices, _: roll_plan(
                choices["speeds"], REVOLUTIONS[choices["plan"]], choices["orders"]
            ),
            place=RUN_OUT,
            fastest_rpm=FASTEST_RPM,
        ),
        Subject(
            name="channel",
            kinds=(CHANNEL,),
            columns=CHANNEL_COLUMNS,
            settings=ChannelFile,
            certificate=channel_parts,
            fit=fit_channel,
        ),
        Subject(
            name="running check",
            kinds=(say("running check"),),
            columns=RUNNING_COLUMNS,
            settings=LoadCellFile,
            certificate=running_parts,
        ),
    )
}


def subject_of(kind: str) -> Subject:
    """Return the subject whose records are of a kind; raise UnusableInput for an unknown kind."""
    known = {known_kind: subject for subject in SUBJECTS.values() for known_kind in subject.kinds}
    if kind not in known:
        raise UnusableInput(
            (
                "the record is of the kind {}, and this version supports only {}; it may be from"
                " a newer version"
            ),
            repr(kind),
            joined(", ", known),
        )
    return known[kind]
