"""Contradictions within one file, each as a sentence without the file's name."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator

import msgspec

from rigapp.config.channels import channel_faults, input_keys
from rigapp.config.errors import UnusableInput
from rigapp.config.notify import NotifyFile, notify_faults
from rigapp.config.parameters import ParameterFile, to_parameters
from rigapp.config.ranges import refusals
from rigapp.config.recipe import MOST_STEPS, LimitsSection, TestFile
from rigapp.config.rig import Matrix, RigFile
from rigapp.config.rules import check_rules
from rigapp.config.sequence import Sequence
from rigapp.schema.criteria import CRITERIA
from rigapp.texts import joined, say, sentence_of_error

SECTIONS = ("spindle", "encoder", "load_cell", "probes")
CELL_CONDITION = 1e6
"""Condition number above which a load cell's bridges measure only one force: its calibration
resolves about 1e-4 of the full scale, so that the second component is lost even before."""

ALIGNMENT_CONDITION = 100.0
"""The same for two probes: their axes would be 1 deg apart, which no mounting has."""


def faults(record: msgspec.Struct) -> Iterator[str]:
    """Yield the contradictions in a rig, test, parameter or settings file."""
    yield from _of_texts(record, "")
    if isinstance(record, RigFile):
        yield from _of_rig(record)
    elif isinstance(record, TestFile):
        yield from _of_test(record)
    elif isinstance(record, ParameterFile):
        yield from _of_parameters(record, "")
    if isinstance(record, RigFile | NotifyFile):
        yield from notify_faults(record.notify, record.ping)


def _of_texts(value: object, key: str) -> Iterator[str]:
    """Yield texts with characters that cannot be stored or shown, at which readers cut a text."""
    if isinstance(value, msgspec.Struct):
        for name in value.__struct_fields__:
            yield from _of_texts(getattr(value, name), f"{key}.{name}".lstrip("."))
    elif isinstance(value, tuple):
        for number, item in enumerate(value, 1):
            yield from _of_texts(item, say("{} {}", key, number))
    elif isinstance(value, str):
        control = next((char for char in value if char < " " and char not in "\n\t"), "")
        if control:
            yield say(
                "{} holds the control character \\u{}; take it out", key, f"{ord(control):04x}"
            )


def _of_rig(rig: RigFile) -> Iterator[str]:
    for section in SECTIONS:
        device = getattr(rig, section).device
        if device not in rig.devices:
            known = joined(", ", rig.devices) or "none"
            yield say("{}.device = {} is not among the devices ({})", section, repr(device), known)
    sources = {rig.encoder.device, rig.load_cell.device, rig.probes.device}
    if len(sources) > 1:
        yield say(
            (
                "encoder, load_cell and probes must be on one device, so that their samples are"
                " taken together; they name {}"
            ),
            joined(", ", sorted(sources)),
        )
    for name, device in rig.devices.items():
        if not device.port.strip():
            yield say("devices.{}.port is empty; name the port", name)
    if rig.simulation is None:
        for name in rig.simulated_devices:
            yield say(
                "devices.{}.port is 'simulated' but there is no [simulation]; name the"
                " port or add the section",
                name,
            )
    elif not rig.simulated_devices:
        yield say(
            "[simulation] is in the file of a real rig, where no device has port ="
            " 'simulated'; remove the line [simulation] and the keys below it"
        )
    yield from channel_faults(rig)
    yield from _of_inputs(rig)
    yield from _of_numbers(rig)


def _of_inputs(rig: RigFile) -> Iterator[str]:
    named = input_keys(rig)
    for name, count in Counter(named.values()).items():
        if count > 1:
            keys = joined(say(" and "), (key for key, value in named.items() if value == name))
            yield say("{} both name {}; each needs an input of its own", keys, repr(name))


def number_faults(rig: RigFile) -> Iterator[str]:
    """Yield the faults of the numbers of a rig, including those of its calibration records."""
    yield from refusals(rig)
    yield from _of_numbers(rig)


def _of_numbers(rig: RigFile) -> Iterator[str]:
    cell, probes = rig.load_cell, rig.probes
    for key, matrix, most in (
        ("load_cell.matrix_N_per_mV_per_V", cell.matrix_N_per_mV_per_V, CELL_CONDITION),
        ("probes.alignment", probes.alignment, ALIGNMENT_CONDITION),
    ):
        if not _condition(matrix) <= most:
            yield say(
                "{} = {} cannot be inverted; two rows are dependent or 0",
                key,
                [list(row) for row in matrix],
            )
    for number, zero in enumerate(cell.zero_mV_per_V, 1):
        if abs(zero) >= cell.range_mV_per_V:
            yield say(
                "load_cell.zero_mV_per_V {} = {:g} is not within load_cell.range_mV_per_V = {:g}",
                number,
                zero,
                cell.range_mV_per_V,
            )
    if cell.resolution_N >= cell.full_scale_N:
        yield say(
            "load_cell.resolution_N = {:g} is not below load_cell.full_scale_N = {:g}",
            cell.resolution_N,
            cell.full_scale_N,
        )
    for number, (cosines, sines) in enumerate(
        zip(probes.run_out_cos_um, probes.run_out_sin_um, strict=True), 1
    ):
        if len(cosines) != len(sines):
            yield say(
                "probes.run_out_cos_um {} has {} orders and probes.run_out_sin_um {}"
                " has {}; give as many",
                number,
                len(cosines),
                number,
                len(sines),
            )
    if len({len(orders) for orders in probes.run_out_cos_um}) > 1:
        yield say(
            "probes.run_out_cos_um has other orders for one probe than the other; give as many"
        )


def _condition(matrix: Matrix) -> float:
    """Return the condition number (2-norm) of a matrix, infinite where it is singular."""
    (a, b), (c, d) = matrix
    determinant = abs(a * d - b * c)
    if determinant == 0.0:
        return math.inf
    half = math.hypot(a, b, c, d) ** 2 / (2.0 * determinant)
    return half + math.sqrt(max(half * half - 1.0, 0.0))


def _of_test(test: TestFile) -> Iterator[str]:
    wrong = list(_of_sequence(test))
    yield from wrong
    # Contradictory steps have no fastest one; the speed of [run] is then checked.
    run = msgspec.structs.replace(test.run, step=()) if wrong else test.run
    yield from overspeed_faults(test.limits, Sequence(run))
    stop, limits = test.stop, test.limits
    if stop.force_N is not None and stop.force_N >= limits.overload_N:
        yield say(
            "stop.force_N = {:g} can never be met, because limits.overload_N = {:g}"
            " switches the drive off before; lower stop.force_N",
            stop.force_N,
            limits.overload_N,
        )
    for name, criterion in CRITERIA.items():
        blind = criterion.model and not test.prediction.enabled
        if blind and getattr(stop, name) is not None:
            yield say(
                "stop.{} {}, but prediction.enabled is false; enable the prediction or"
                " leave the criterion out",
                name,
                criterion.model,
            )
    if stop.remaining_revolutions is not None and stop.wear_depth_um is None:
        yield say(
            "stop.remaining_revolutions needs stop.wear_depth_um, the depth to which they remain"
        )
    try:
        check_rules(limits.rule)
    except UnusableInput as error:
        yield sentence_of_error(error)
    yield from _of_parameters(test.model, "model")


def overspeed_faults(limits: LimitsSection, sequence: Sequence) -> Iterator[str]:
    """Yield a fault if the overspeed limit is not above the fastest speed of a test."""
    if limits.overspeed_rpm <= sequence.fastest_rpm:
        yield say(
            "limits.overspeed_rpm = {:g} is not above {} = {:g}; the test would trip at once",
            limits.overspeed_rpm,
            sequence.fastest_key,
            sequence.fastest_rpm,
        )


def _of_sequence(test: TestFile) -> Iterator[str]:
    run, count = test.run, len(test.run.step)
    if count > MOST_STEPS:
        yield say(
            "there are {} entries of run.step; {} are possible, and they can be repeated",
            count,
            MOST_STEPS,
        )
    for number, step in enumerate(run.step, start=1):
        if (step.revolutions is None) == (step.duration_s is None):
            yield say("run.step {}: give revolutions or duration_s, one of the two", number)
    if run.repeat_from_step > max(1, count):
        yield say(
            "run.repeat_from_step = {}, but there are {} entries of run.step",
            run.repeat_from_step,
            count,
        )
    for rule in test.limits.rule:
        for number in rule.steps:
            if not 1 <= number <= count:
                yield say(
                    ("limits.rule ({}): steps names step {}, but there are {} entries of run.step"),
                    rule.quantity,
                    number,
                    count,
                )


def _of_parameters(parameters: ParameterFile, section: str) -> Iterator[str]:
    if parameters.schema != 1:
        key = f"{section}.schema" if section else "schema"
        yield say("{} = {} is not readable; write 1", key, parameters.schema)
    try:
        to_parameters(parameters, section=section)
    except UnusableInput as error:
        yield sentence_of_error(error).rstrip(".")
