"""The simulator under the vendor's own client and an independent one, and the bytes they send.

gsv86lib keeps its queues in class attributes and never ends its threads: each use has a process of
its own. Its reader polls without a pause, so the sessions are short.
"""

from __future__ import annotations

import json
import subprocess
import sys
import textwrap
from itertools import pairwise
from typing import Any

import pytest

from rigapp_drivers.api import DataRequest
from rigapp_drivers.gsv8.protocol import Command, f32, request, u8, u16

PREAMBLE = """
import json, os, sys, time, warnings, logging
warnings.simplefilter("ignore")
logging.disable(logging.CRITICAL)
port = sys.argv[1]

def finish(result):
    print(json.dumps(result), flush=True)
    os._exit(0)
"""


def _run(script: str, port: str) -> Any:
    """Run a client in a process of its own and return the JSON that it printed last."""
    code = PREAMBLE + textwrap.dedent(script)
    done = subprocess.run(
        [sys.executable, "-c", code, port], capture_output=True, text=True, timeout=300, check=False
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.strip().splitlines()[-1])


def test_vendors_client_configures_zeroes_and_streams(bench: Any) -> None:
    b = bench()
    result = _run(
        """
        from gsv86lib import gsv86
        gsv = gsv86(port, 115200)
        before = gsv.readDataRate()
        gsv.writeDataRate(500.0)
        rate = gsv.readDataRate()
        bridge = gsv.getInputType(3, 0xFF)
        gsv.setInputTypeToSingle_Ended(3)
        voltage = gsv.getInputType(3, 0xFF)
        single = gsv.ReadValue()
        one = [single.getChannel1(), single.getChannel2(), single.getChannel3()]
        gsv.StartTransmission()
        frames = []
        deadline = time.time() + 10
        while len(frames) < 200 and time.time() < deadline:
            frames += gsv.ReadMultiple()
            time.sleep(0.02)
        gsv.StopTransmission()
        gsv.SetZero(1)
        zeroed = gsv.ReadValue().getChannel1()
        finish({"before": before, "rate": rate, "bridge": bridge, "voltage": voltage, "one": one,
                "frames": len(frames), "first": list(frames[0][1].values()), "zeroed": zeroed})
        """,
        b.wire.port,
    )
    assert result["before"] == 10.0
    assert result["rate"] == 500.0
    assert (result["bridge"][-1], result["voltage"][-1]) == (350, 1_000_000)
    assert result["one"] == pytest.approx([0.5, -0.25, 2.5], abs=1e-5)
    assert result["frames"] >= 200
    assert result["first"][:3] == pytest.approx([0.5, -0.25, 2.5], abs=1e-5)
    assert len(result["first"]) == 8
    assert result["zeroed"] == pytest.approx(0.0, abs=1e-5)
    assert b.simulator.sample_rate_Hz == 500.0
    sent = bytes(b.wire.received)
    for command, parameters in (
        (Command.STOP_TRANSMISSION, b""),
        (Command.READ_DATA_RATE, b""),
        (Command.WRITE_DATA_RATE, f32(500.0)),
        (Command.GET_INPUT_TYPE, u8(3, 0xFF)),
        (Command.SET_INPUT_TYPE, u8(3, 3)),
        (Command.GET_VALUE, b""),
        (Command.START_TRANSMISSION, b""),
        (Command.SET_ZERO, u8(1)),
    ):
        assert request(command, parameters) in sent


def test_vendors_client_sees_refusals_and_digital_lines(bench: Any) -> None:
    b = bench()
    result = _run(
        """
        from gsv86lib import gsv86
        gsv = gsv86(port, 115200)
        try:
            gsv.writeDataRate(961.0)
            refused = False
        except Exception as error:
            refused = True
        gsv.setDIOgroupToOutput(2)
        gsv.writeUpperDIOthreshold(5, 1.5)
        finish({"refused": refused, "output": bool(gsv.isDIOgroupOutput(2)),
                "threshold": gsv.readUpperDIOthreshold(5), "rate": gsv.readDataRate()})
        """,
        b.wire.port,
    )
    assert result == {"refused": True, "output": True, "threshold": 1.5, "rate": 10.0}


def test_vendors_client_reads_the_counter_that_our_driver_set_up(bench: Any) -> None:
    b = bench()
    b.driver.open()
    inputs = {"analog_1": ("bridge", 3.5), "counter_1": ("counter", 3600.0)}
    b.driver.configure(DataRequest(480.0, inputs))
    b.driver.close()
    result = _run(
        """
        from gsv86lib import gsv86
        gsv = gsv86(port, 115200)
        gsv.StartTransmission()
        frames = []
        deadline = time.time() + 10
        while len(frames) < 300 and time.time() < deadline:
            frames += gsv.ReadMultiple()
            time.sleep(0.02)
        finish([list(frame[1].values()) for frame in frames[:300]])
        """,
        b.wire.port,
    )
    assert len(result) == 300
    assert {len(values) for values in result} == {2}
    counts = [values[1] for values in result]
    steps = {(after - before) % 3600 for before, after in pairwise(counts)}
    assert steps <= {7.0, 8.0}
    assert all(values[0] == pytest.approx(0.5, abs=1e-5) for values in result)


@pytest.mark.long
def test_independent_client_configures_and_streams(bench: Any) -> None:
    b = bench()
    result = _run(
        """
        from gsvpiko.transport import transport_serial
        from gsvpiko.transport.transport_serial import SerialTransport
        from gsvpiko.device.device_gsv import GsvDevice, GsvResponseError
        # Its quarter of a second is for a port that hangs, not for a computer that is busy.
        transport_serial.DRIVER_READ_CALL_TIMEOUT_S = 60.0
        device = GsvDevice(SerialTransport(port, 115200, 60.0))
        device.open()
        device.acquisition.stop_transmission()
        a = device.acquisition
        out = {"firmware": device.interface.get_firmware_version()["payload"].hex()}
        out["rate"] = a.configure_sample_rate(1000.0)["sample_rate_hz"]
        out["highest"] = a.read_max_sample_rate()["sample_rate_hz"]
        out["mapping"] = a.configure_tx_mapping_count(4)["tx_mapping_count"]
        out["type"] = a.configure_datatype("float32")["datatype_name"]
        before = device.input.read_input_mode(3)
        device.scaling.write_scaling_factor(3, 12.5)
        device.input.write_input_mode(3, 3)
        out["scale"] = device.scaling.read_scaling_factor(3)["scaling_factor"]
        device.scaling.configure_scaling_factor(3, 10.0)
        after = device.input.read_input_mode(3)
        out["mode"] = [before["sensor_input_mode"], after["sensor_input_mode"]]
        out["filter"] = device.filters.disable_analog_filter_automatic()["mode_write_executed"]
        try:
            device.request_ok(0xEE)
            out["unknown"] = ""
        except GsvResponseError as error:
            out["unknown"] = str(error)
        try:
            a.write_sample_rate(16000.0)
            out["fast"] = ""
        except GsvResponseError as error:
            out["fast"] = str(error)
        a.start_transmission()
        frames = [a.read_next_measurement_frame() for _ in range(200)]
        out["interleaved"] = a.read_sample_rate()["sample_rate_hz"]
        a.stop_transmission()
        device.close()
        out["keys"] = sorted(frames[0])
        out["values"] = [list(f.get("values") or f.get("channels")) for f in frames]
        finish(out)
        """,
        b.wire.port,
    )
    assert result["firmware"] == "00010038"
    assert (result["rate"], result["highest"], result["mapping"]) == (1000.0, 12000.0, 4)
    assert result["type"] == "float32"
    assert result["scale"] == 12.5
    assert result["mode"] == [1, 3]
    assert result["filter"] is True
    assert "0x40" in result["unknown"]
    assert "0x64" in result["fast"]
    assert result["interleaved"] == 1000.0
    assert len(result["values"]) == 200
    for values in result["values"]:
        assert values == pytest.approx([0.5, -0.25, 2.5, -2.5], abs=1e-5)


def test_independent_client_builds_the_same_bytes() -> None:
    result = _run(
        """
        from gsvpiko.protocol.protocol_frame_builder import build_command_frame
        from gsvpiko.constants import constants_commands as C
        from gsvpiko.protocol.protocol_payload_codec import (
            pack_float32, pack_uint8, pack_uint8_float32, pack_uint8_uint16, pack_uint8_uint8)
        finish([build_command_frame(*frame).hex() for frame in (
            (C.STOP_TRANSMISSION, b""), (C.START_TRANSMISSION, b""), (C.FIRMWARE_VERSION, b""),
            (C.READ_DATA_RATE, b""), (C.WRITE_DATA_RATE, pack_float32(12000.0)),
            (C.SET_ZERO, pack_uint8(0)), (C.GET_TX_MAPPING, pack_uint8(0)),
            (C.SET_TX_MAPPING, pack_uint8_uint16(0, 5)), (C.GET_TX_MODE, pack_uint8(1)),
            (C.SET_TX_MODE, pack_uint8_uint16(1, 3)), (C.READ_USER_SCALE, pack_uint8(1)),
            (C.WRITE_USER_SCALE, pack_uint8_float32(3, 10.0)),
            (C.GET_INPUT_TYPE, pack_uint8_uint8(1, 0xFF)),
            (C.SET_INPUT_TYPE, pack_uint8_uint8(3, 3)), (C.GET_LAST_PROTOCOL_ERROR, pack_uint8(1)),
            (C.RELEASE_INTERFACE, b""))])
        """,
        "no port",
    )
    ours = [
        request(Command.STOP_TRANSMISSION),
        request(Command.START_TRANSMISSION),
        request(Command.FIRMWARE_VERSION),
        request(Command.READ_DATA_RATE),
        request(Command.WRITE_DATA_RATE, f32(12000.0)),
        request(Command.SET_ZERO, u8(0)),
        request(Command.GET_TX_MAPPING, u8(0)),
        request(Command.SET_TX_MAPPING, u8(0) + u16(5)),
        request(Command.GET_TX_MODE, u8(1)),
        request(Command.SET_TX_MODE, u8(1) + u16(3)),
        request(Command.READ_USER_SCALE, u8(1)),
        request(Command.WRITE_USER_SCALE, u8(3) + f32(10.0)),
        request(Command.GET_INPUT_TYPE, u8(1, 0xFF)),
        request(Command.SET_INPUT_TYPE, u8(3, 3)),
        request(Command.GET_LAST_PROTOCOL_ERROR, u8(1)),
        request(Command.RELEASE_INTERFACE),
    ]
    assert result == [frame.hex() for frame in ours]


def test_our_driver_sends_the_golden_start_and_stop(bench: Any) -> None:
    b = bench()
    b.stream()
    b.blocks(10)
    b.driver.close()
    sent = bytes(b.wire.received).hex().upper()
    assert sent.startswith("AA902385AA91010185AA902B85AA901F85AA902A85")
    assert sent.endswith("AA902385AA907A85")
    assert "AA956A000000003A85" in sent
    assert "AA934A00000585" in sent
    assert "AA902485" in sent
