"""The twin's process: setup first, then one prediction for each measured revolution.

Started by ``rigapp.twin.link`` as ``python -m rigapp.twin.worker ADDRESS ENGINE_PID``; ends when
the engine's process is gone or asks for it with an empty message.
"""

from __future__ import annotations

import os
import sys

import msgspec
import zmq

from rigapp.config.model_parameters import to_parameters
from rigapp.config.parameters import ParameterFile
from rigapp.engine.messages import Prediction, RevolutionMeasured
from rigapp.twin.checkpoint import packed, restore
from rigapp.twin.predict import unpack
from rigapp.twin.twin import Twin

WAIT_MS = 500
READY = b""
"""What the worker says once it can predict."""


class TwinSetup(msgspec.Struct, frozen=True):
    """Tell the twin which model to run.

    new_position_um: mean pin position (probe_1, probe_2) of the new bushing, where the file of a
    resumed test knows it; else the first revolutions tell. checkpoint: what an earlier twin of the
    same test left, to go on from there.
    """

    parameters: ParameterFile
    joint: str
    new_position_um: tuple[float, float] | None = None
    checkpoint: bytes = b""


def new_twin(setup: TwinSetup) -> Twin:
    """Return the twin of a setup, as its checkpoint left it where there is one that fits."""
    twin = Twin(to_parameters(setup.parameters), setup.joint)
    restore(twin, setup.checkpoint)
    if twin.reference is None:
        twin.new_position_um = setup.new_position_um
    return twin


def answer(twin: Twin, measured: RevolutionMeasured) -> Prediction:
    """Return the prediction for a revolution, with a checkpoint where it is a new one."""
    prediction = twin.predict(unpack(measured))
    if not twin.changed:
        return prediction
    return msgspec.structs.replace(prediction, checkpoint=packed(twin))


def main(arguments: list[str]) -> int:
    """Serve predictions until the engine is gone."""
    engine = int(arguments[1])
    context = zmq.Context()
    socket = context.socket(zmq.PAIR)
    socket.setsockopt(zmq.LINGER, 0)
    socket.connect(arguments[0])
    setup: TwinSetup | None = None
    while os.getppid() == engine:
        if not socket.poll(WAIT_MS):
            continue
        body = socket.recv()
        if not body:
            break
        if setup is None:
            setup = msgspec.msgpack.decode(body, type=TwinSetup)
            twin = new_twin(setup)
            socket.send(READY)
            continue
        measured = msgspec.msgpack.decode(body, type=RevolutionMeasured)
        socket.send(msgspec.msgpack.encode(answer(twin, measured)))
    context.destroy(linger=0)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
