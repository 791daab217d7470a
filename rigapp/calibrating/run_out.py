"""The map of the pin's run-out: from the files of slow rolls to a record."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from rigapp.calibrating.probe_result import UM
from rigapp.calibrating.records import problems_of
from rigapp.calibrating.session import Outcome
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_test
from rigapp.config.parameters import ParameterFile
from rigapp.schema.messages import Flag
from rigapp.texts import say
from rigapp_calibration.arrays import Array
from rigapp_calibration.taking.readings import numbers, read_table
from rigapp_calibration.turning.run_out import (
    Harmonics,
    Roll,
    RunOutError,
    RunOutMap,
    SlowRevolution,
    evaluate,
    make_map,
    map_of_harmonics,
    spread_at,
)

GRID_DEG = 5
"""Grid of the map in the record; its orders are applied."""
RUN_OUT_COLUMNS = (
    "roll", "revolution", "probe", "order", "cos_um", "sin_um", "elastic_cos_um", "elastic_sin_um",
)  # fmt: skip


def map_of(files: Sequence[Path], orders: int) -> tuple[Outcome, str, list[dict[str, Any]]]:
    """Make a map from the files of slow rolls: outcome, readings as CSV, facts of each file.

    Raises UnusableInput for a file that gives no map.
    """
    from rigapp.twin.predict import DOUBTS

    rolls = [read_roll(path) for path in files]
    try:
        run_out = make_map([roll for roll, _ in rolls], orders, elastic_doubts=DOUBTS)
    except RunOutError as error:
        raise UnusableInput("run-out: {}.", error) from error
    outcome = Outcome(say("run-out map"), run_out_result(run_out), tuple(run_out_lines(run_out)))
    return outcome, harmonics_csv(run_out), [facts for _, facts in rolls]


def read_roll(path: Path) -> tuple[Roll, dict[str, Any]]:
    """Read the undisturbed whole cycles of a test file, as read by the probes.

    A map and an alignment that were applied while it was recorded are removed. Each cycle has the
    motion of the pin by its forces in an unworn bushing of the file's test. Returns the roll and
    the record's facts of the file. Raises UnusableInput.
    """
    from rigapp.storage import open_test

    with open_test(path) as reader:
        numbers = reader.column("revolution").tolist()
        quality = dict(zip(numbers, reader.column("quality").tolist(), strict=True))
        speed = dict(zip(numbers, reader.column("speed").tolist(), strict=True))
        probes = reader.calibration().get("probes", {})
        test = parse_test(reader.configuration()["test"], say("{} (its test)", path), recorded=True)
        turns, forces, rpm = [], [], []
        digest = hashlib.sha256()
        for cycle in reader.cycles():
            number = int(cycle.revolution)
            if quality.get(number, int(Flag.PARTIAL)) & ~int(Flag.SATURATED):
                continue
            angle = np.radians(cycle.columns["angle"].astype(np.float64))
            shown = np.array([cycle.columns["probe_1"], cycle.columns["probe_2"]], np.float64)
            saturated = bool(quality[number] & int(Flag.SATURATED))
            read = _as_read(shown, angle, probes) / UM
            turns.append(SlowRevolution(number, angle, read, saturated))
            forces.append(
                np.array([cycle.columns["force_1"], cycle.columns["force_2"]], np.float64)
            )
            rpm.append(speed[number])
            for name in ("angle", "probe_1", "probe_2", "force_1", "force_2"):
                digest.update(np.ascontiguousarray(cycle.columns[name]).tobytes())
    turns = _with_elastic(turns, forces, test.model, probes, path)
    mean = float(np.mean(rpm)) if rpm else 0.0
    facts = {
        "name": path.name,
        "sha256_of_samples": digest.hexdigest(),
        "revolutions": len(turns),
        "speed_rpm": mean,
    }
    return Roll(f"{path.name}", mean * 2.0 * math.pi / 60.0, tuple(turns)), facts


def _with_elastic(
    turns: Sequence[SlowRevolution],
    forces: Sequence[Array],
    model: ParameterFile,
    probes: Mapping[str, Any],
    path: Path,
) -> list[SlowRevolution]:
    """Return the revolutions with the elastic motion of the pin by their forces (2, n), N."""
    from rigapp.config.parameters import to_parameters
    from rigapp.twin.predict import PredictionError, elastic_motions
    from rigapp_model.errors import ModelError

    parameters = to_parameters(model, say("{} (its test)", path), "model")
    try:
        motions = elastic_motions(parameters, [turn.angle for turn in turns], forces)
    except (ModelError, PredictionError) as error:
        raise UnusableInput(
            "{}: the elastic motion of the pin cannot be taken off: {}; roll again with"
            " --test and the test file of this bushing.",
            path,
            error,
        ) from error
    matrix = _alignment(probes)
    return [
        replace(turn, elastic=np.asarray(np.linalg.solve(matrix, motion), np.float64))
        for turn, motion in zip(turns, motions, strict=True)
    ]


def _alignment(probes: Mapping[str, Any]) -> Array:
    return np.asarray(probes.get("alignment", np.eye(2)), np.float64)


def _as_read(shown: Array, angle: Array, probes: Mapping[str, Any]) -> Array:
    """Return the probes' readings (2, n), um, before alignment and map were applied."""
    read = np.linalg.solve(_alignment(probes), shown)
    cosines = probes.get("run_out_cos_um")
    if cosines is None or not np.size(cosines):
        return np.asarray(read, np.float64)
    together = np.stack((cosines, probes["run_out_sin_um"]), axis=-1).reshape(2, -1)
    return np.asarray(read + evaluate(together, angle), np.float64)


def run_out_result(run_out: RunOutMap) -> dict[str, Any]:
    """Return the result for ``--json`` and the record, units in the keys."""
    result: dict[str, Any] = {
        "accepted": run_out.accepted,
        "problems": problems_of(run_out.problems),
        "expanded_uncertainty_um": None,
        "coverage_factor": run_out.coverage_factor,
    }
    if run_out.coefficients is None or run_out.covariance is None or run_out.expanded is None:
        return result
    grid = np.radians(np.arange(0.0, 360.0, GRID_DEG))
    return {
        **result,
        "cos_um": (UM * run_out.coefficients[:, 0::2]).tolist(),
        "sin_um": (UM * run_out.coefficients[:, 1::2]).tolist(),
        "covariance_um2": (UM**2 * run_out.covariance).tolist(),
        "map_um": (UM * evaluate(run_out.coefficients, grid)).tolist(),
        "map_standard_uncertainty_um": (UM * spread_at(run_out.covariance, grid)).tolist(),
        "map_step_deg": GRID_DEG,
        "expanded_uncertainty_um": float(UM * run_out.expanded.max()),
        **{
            f"{name}_um": None if values is None else (UM * values).tolist()
            for name, values in (
                ("peak_to_peak", run_out.peak),
                ("inertia", run_out.inertia),
                ("elastic", run_out.elastic),
                ("between_rolls", run_out.between),
                ("drift", run_out.drift),
                ("rest", run_out.rest),
                ("expanded_uncertainties", run_out.expanded),
            )
        },
    }


def harmonics_csv(run_out: RunOutMap) -> str:
    """Return the orders of every revolution: the readings of the record."""
    lines = [",".join(RUN_OUT_COLUMNS)]
    for turn in run_out.harmonics:
        for probe in range(2):
            both = np.vstack((turn.coefficients[probe], turn.elastic[probe]))
            pairs = (UM * both).reshape(2, -1, 2).transpose(1, 0, 2).reshape(-1, 4)
            lines += [
                f"{turn.roll + 1},{turn.number},{probe + 1},{order},{','.join(map(repr, numbers))}"
                for order, numbers in enumerate(pairs.tolist(), 1)
            ]
    return "\n".join(lines) + "\n"


def parse_harmonics(text: str) -> tuple[Harmonics, ...]:
    """Read what ``harmonics_csv`` wrote; raise ReadingsError.

    Older records lack the elastic motion: none was removed. The residuals of the samples are in no
    record.
    """
    names = RUN_OUT_COLUMNS if "elastic_cos_um" in text.partition("\n")[0] else RUN_OUT_COLUMNS[:6]
    rows = read_table(text, names)
    columns = np.column_stack([numbers(rows, name) for name in names])
    harmonics = []
    for roll, number in dict.fromkeys(map(tuple, columns[:, :2].astype(int).tolist())):
        turn = columns[(columns[:, 0] == roll) & (columns[:, 1] == number), 4:] / UM
        shown = turn[:, :2].reshape(2, -1)
        moved = turn[:, 2:].reshape(2, -1) if turn.shape[1] > 2 else np.zeros_like(shown)
        harmonics.append(Harmonics(roll - 1, number, shown, moved, np.full(2, math.nan)))
    return tuple(harmonics)


def map_again(content: Mapping[str, Any]) -> dict[str, Any]:
    """Return the result that the revolutions in a record's content give; raise ReadingsError."""
    from rigapp.twin.predict import DOUBTS

    speeds = [file["speed_rpm"] * 2.0 * math.pi / 60.0 for file in content["taken"]["files"]]
    run_out = map_of_harmonics(parse_harmonics(content["readings_csv"]), speeds, DOUBTS)
    return run_out_result(run_out)


def run_out_lines(run_out: RunOutMap) -> list[str]:
    """Return the result in words and numbers, a line each."""
    if run_out.peak is None or run_out.expanded is None or run_out.drift is None:
        return []
    lines: list[str] = [
        say(
            "Probe {}: run-out {:.2f} um from lowest to highest, expanded uncertainty"
            " {:.2f} um (k = {:.2f}).",
            probe + 1,
            UM * run_out.peak[probe],
            UM * run_out.expanded[probe],
            run_out.coverage_factor,
        )
        for probe in range(2)
    ]
    if run_out.inertia is None:
        lines.append(
            say("One speed only: the contribution of inertia is not known. Add a second speed.")
        )
    else:
        lines.append(
            say(
                "Motion with the speed, taken off the slowest roll: up to {:.2f} um.",
                UM * run_out.inertia.max(),
            )
        )
    if run_out.elastic is not None:
        lines.append(
            say(
                "Elastic motion of the pin with the force, by the model of the unworn"
                " bushing, taken off: up to {:.2f} um about its mean.",
                UM * run_out.elastic.max(),
            )
        )
    return lines
