"""The twin's identification as the file of a test keeps it."""

from __future__ import annotations

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_test
from rigapp.config.parameters import to_parameters
from rigapp.storage import TestReader
from rigapp.texts import say
from rigapp.twin.checkpoint import Checkpoint, restore
from rigapp.twin.identifying import Identifier
from rigapp.twin.link import IdentificationTarget
from rigapp.twin.twin import Twin
from rigapp_model.identification import DepthLife, NotIdentifiable

NO_BIN = say("no bin of revolutions is complete yet: wait")
"""Reason before the first bin."""


def kept_of(reader: TestReader) -> tuple[Identifier, int]:
    """Return the identification of a test at its twin's end; raise NotIdentifiable for none.

    Its readings are in bins, and its life is computed as far as it had come. The second value: the
    revolutions that the bushing had made when the test began, which its readings count.
    """
    if "wear_coefficient" not in reader.column_units("prediction"):
        raise NotIdentifiable(
            say(
                "the file was recorded without a prediction, or by a version that did not"
                " request it"
            )
        )
    state = reader.checkpoint()
    if not state:
        raise NotIdentifiable(say("the twin had followed no revolution of it when the test ended"))
    try:
        text = str(reader.configuration()["test"])
        test = parse_test(text, say("its test"), recorded=True)
        left = msgspec.msgpack.decode(state, type=Checkpoint)
    except (UnusableInput, msgspec.DecodeError) as error:
        raise NotIdentifiable(
            say("the twin left nothing readable in the file ‹{}›", error)
        ) from error
    parameters = to_parameters(test.model)
    if left.identified is None:
        nobody = Identifier(parameters, IdentificationTarget())
        nobody.prior()
        nobody.errors()
        raise NotIdentifiable(say("the twin did not request it"))
    identifier = Identifier(parameters, left.identified.sought)
    twin = Twin(parameters, test.prediction.joint, identifier=identifier)
    restore(twin, state)
    return identifier, twin.before


def life_of(identifier: Identifier) -> DepthLife:
    """Return the life that readings are compared with; raise NotIdentifiable for none yet."""
    life = identifier.ahead.life() if identifier.ahead is not None else None
    if life is None:
        raise NotIdentifiable(say("hardly any revolution has been measured yet: wait"))
    return life
