"""The twin's process: setup first, then one answer for each measured revolution.

Started by ``rigapp.twin.link``; ends with the engine's process. Errors are reported in a
``TwinAnswer``, for the log of the test.
"""

from __future__ import annotations

import logging
import sys
from collections import deque

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.parameters import to_parameters
from rigapp.process.children import Parent
from rigapp.schema.details import error_text
from rigapp.schema.messages import RevolutionMeasured
from rigapp.texts import Sentence, say, sentence_of_error
from rigapp.twin.checkpoint import packed, restore, take_over
from rigapp.twin.identifying import Identifier
from rigapp.twin.link import TwinAnswer, TwinSetup
from rigapp.twin.predict import PredictionError, unpack
from rigapp.twin.twin import Twin
from rigapp_model.errors import ModelError
from rigapp_model.friction_circle import COVERAGE_FACTOR, CellDoubt
from rigapp_model.wear.techniques import solve_of

WAIT_S = 0.5
LINGER_S = 2.0
SAID_AT_ONCE = 8

log = logging.getLogger(__name__)


class Remarks(logging.Handler):
    """Collect the warnings of the model and the twin for the next answer, the newest few."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self._texts: deque[str] = deque(maxlen=SAID_AT_ONCE)

    def emit(self, record: logging.LogRecord) -> None:
        """Store a warning."""
        text = record.msg  # with its structure, so that a window can translate it
        self._texts.append(text if isinstance(text, Sentence) else record.getMessage())

    def take(self) -> tuple[str, ...]:
        """Return the warnings since the last call, each once."""
        texts = tuple(dict.fromkeys(self._texts))
        self._texts.clear()
        return texts


def new_twin(setup: TwinSetup) -> Twin:
    """Return the twin of a setup, as its checkpoint left it where there is one that fits.

    Raises UnusableInput, ModelError for a setup that no twin can be made of.
    """
    solve_of(setup.joint)
    parameters = to_parameters(setup.parameters)
    identifier = Identifier(parameters, setup.sought)
    twin = Twin(
        parameters,
        setup.joint,
        cell=_cell(setup.force_uncertainty_N),
        identifier=identifier if identifier.possible() else None,
    )
    if setup.new_test:
        take_over(twin, setup.checkpoint, setup.same_model)
    else:
        restore(twin, setup.checkpoint)
    if twin.reference is None:
        twin.new_position_um = setup.new_position_um
    return twin


def _cell(stated: tuple[float, float] | None) -> CellDoubt | None:
    """Return the uncertainty of the load cell; log the consequence where none is stated."""
    if stated is None:
        log.warning(
            say(
                "The friction coefficient is not stated: the load cell has no calibration record"
                " that states its uncertainty."
            )
        )
        return None
    constant, relative = (part / COVERAGE_FACTOR for part in stated)
    return CellDoubt(constant, relative)


def answer(twin: Twin, measured: RevolutionMeasured) -> TwinAnswer:
    """Return the prediction for a revolution, with a checkpoint where it is a new one.

    A revolution without a solution of the model is refused.
    """
    try:
        prediction = twin.predict(unpack(measured))
    except (PredictionError, ModelError, ArithmeticError) as error:
        return TwinAnswer(refused=error_text(error, say("the model has no solution")))
    if twin.changed:
        prediction = msgspec.structs.replace(prediction, checkpoint=packed(twin))
    return TwinAnswer(prediction)


def set_up(setup: TwinSetup) -> tuple[Twin | None, TwinAnswer]:
    """Return the twin of a setup, or the reason why there is none."""
    try:
        return new_twin(setup), TwinAnswer()
    except Exception as error:
        return None, TwinAnswer(failed=_failure(error), hopeless=True)


def serve(twin: Twin, measured: RevolutionMeasured) -> TwinAnswer:
    """Return the answer to a message; an error of the model becomes a sentence."""
    try:
        return answer(twin, measured)
    except Exception as error:
        return TwinAnswer(failed=_failure(error))


def _failure(error: Exception) -> str:
    if isinstance(error, UnusableInput):
        return sentence_of_error(error).rstrip(".")
    return say("the twin failed ‹{}›", repr(error))


def main(arguments: list[str]) -> int:
    """Serve predictions until the engine has ended."""
    engine = Parent(arguments)
    remarks = Remarks()
    logging.getLogger().addHandler(remarks)
    setup = engine.wait_for(TwinSetup)
    if setup is None:
        return 0
    twin, reply = set_up(setup)
    if reply.failed:
        reply = msgspec.structs.replace(reply, remarks=remarks.take())
    engine.send(reply)
    while twin is not None and not reply.failed and engine.alive:
        measured = engine.receive(RevolutionMeasured, WAIT_S)
        if measured is not None:
            # Remarks on the setup are sent with the first revolution: then the test has its log.
            reply = msgspec.structs.replace(serve(twin, measured), remarks=remarks.take())
            engine.send(reply)
    engine.close(LINGER_S if reply.failed else 0.0)
    return int(bool(reply.failed))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
