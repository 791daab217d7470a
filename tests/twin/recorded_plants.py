"""Tests of the simulated plant recorded with their twin, without an engine: quick to make."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from twin.plant_revolutions import EXAMPLES, PARAMETERS, measured_revolutions

from rigapp.schema.channels import BASE
from rigapp.schema.messages import as_array
from rigapp.storage import FilePlan, TestMetadata, create_test, open_test
from rigapp.twin.checkpoint import packed, take_over
from rigapp.twin.identifying import Identifier
from rigapp.twin.link import IdentificationTarget
from rigapp.twin.twin import Twin

REVOLUTIONS, PLANNED = 130, 800
RECORDED = IdentificationTarget(0.01, 0.3, 20.0, 400.0, "P-3")


def record(
    path: Path,
    factor: float,
    sought: IdentificationTarget,
    number: int = REVOLUTIONS,
    *,
    after: Path | None = None,
    made: int = 0,
) -> Path:
    """Record a test of the simulated plant with its twin, without an engine.

    after: the test of the same specimen before it, of so many revolutions made.
    """
    plan = FilePlan(revolutions=PLANNED, cycles=1, samples_per_cycle=400, profiles=40)
    metadata = TestMetadata(
        title="Virtual test",
        rig_text='name = "rig"\n',
        test_text=(EXAMPLES / "quick.toml").read_text("utf-8"),
        specimen=path.stem if after is None else after.stem,
        started=1.8e9,
        identifier=path.stem,
    )
    identifier = Identifier(PARAMETERS, sought)
    asked = identifier if identifier.possible() else None
    twin = Twin(PARAMETERS, "continuous", identifier=asked)
    if after is not None:
        with open_test(after) as reader:
            take_over(twin, reader.checkpoint(), same_model=True)
    writer = create_test(path, plan, metadata)
    row = dict.fromkeys(BASE.names, 0.0) | {"speed": 60.0}
    for whole, _ in measured_revolutions(factor, made + number)[made:]:
        measured = replace(whole, revolution=whole.revolution - made)
        row["revolution"] = float(measured.revolution)
        writer.append_row(list(row.values()))
        writer.append_prediction(as_array(twin.predict(measured).values, "<f8"))
        writer.keep_checkpoint(measured.revolution, packed(twin))
    writer.commit()
    writer.finish("complete", "complete", "All revolutions are done.")
    return path
