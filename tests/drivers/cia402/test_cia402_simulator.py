"""The simulated CiA 402 drive against golden frames, without a wire."""

from __future__ import annotations

import struct
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rigapp_drivers.cia402.protocol import MILLI_RPM, State, state_of
from rigapp_drivers.cia402.simulator import Cia402Simulator
from rigapp_drivers.cia402.slcan import Frame, decode_frame, encode_frame
from rigapp_drivers.simulator_api import DriveMode, MotorState

OPENING = b"C\rS6\r\rO\rO\r"


class Bench:
    """A simulated node 5 with an open adapter and a clock of its own."""

    def __init__(self, **options: Any) -> None:
        self.simulator = Cia402Simulator(node_id=5, **options)
        self.now_s = 100.0
        self.simulator.receive(OPENING, self.now_s)

    def send(self, text: str) -> list[str]:
        """Send a frame written as hex, and return the frames that come."""
        identifier, _, data = text.partition(" ")
        frame = Frame(int(identifier, 16), bytes.fromhex(data))
        return self._shown(self.simulator.receive(encode_frame(frame), self.now_s))

    def wait(self, seconds: float, steps: int = 10) -> list[str]:
        """Let time pass on the wire and in the plant; return the frames that come."""
        shown = []
        for _ in range(steps):
            self.now_s += seconds / steps
            self.simulator.command(seconds / steps, self.now_s)
            shown += self._shown(self.simulator.emit(self.now_s))
        return shown

    def write(self, index: int, value: int, subindex: int = 0, size: int = 4) -> None:
        """Write an object by SDO and require the confirmation."""
        head = 0x23 | (4 - size) << 2
        data = (value & (1 << 8 * size) - 1).to_bytes(4, "little")
        request = struct.pack("<BHB", head, index, subindex) + data
        replies = self.send(f"605 {request.hex()}")
        reply = next(frame for frame in replies if frame.startswith("585"))
        assert reply.startswith("585 60"), reply

    def read(self, index: int, subindex: int = 0) -> int:
        """Read an object by SDO, unsigned."""
        request = struct.pack("<BHBI", 0x40, index, subindex, 0)
        (reply,) = [f for f in self.send(f"605 {request.hex()}") if f.startswith("585")]
        data = bytes.fromhex(reply[4:])
        assert data[0] & 0xE3 == 0x43, reply
        return int.from_bytes(data[4 : 8 - (data[0] >> 2 & 3)], "little")

    def enable(self, velocity: int = 0) -> None:
        """Go to operation enabled in profile velocity mode."""
        self.write(0x6060, 3, size=1)
        for control in (0x06, 0x07, 0x0F):
            self.write(0x6040, control, size=2)
        self.write(0x60FF, velocity)
        assert self.state is State.ENABLED

    @property
    def state(self) -> State | None:
        """Return the state that the status word tells."""
        return state_of(self.read(0x6041))

    @property
    def rpm(self) -> float:
        """Return the set-point in rpm."""
        return self.simulator.command(0.0, self.now_s).speed_count_per_s / 60.0

    @staticmethod
    def _shown(lines: bytes) -> list[str]:
        frames = []
        for line in lines.split(b"\r"):
            frame = decode_frame(line.decode())
            if frame is not None:
                frames.append(f"{frame.identifier:03X} {frame.data.hex(' ').upper()}".strip())
        return frames


def test_golden_transfers_are_answered_byte_for_byte(golden_transfer: dict[str, Any]) -> None:
    bench = Bench()
    for frame in golden_transfer.get("before", []):
        bench.send(frame)
    assert bench.send(golden_transfer["request"]) == [golden_transfer["reply"]]


def test_the_golden_walk_through_the_state_machine(golden_states: list[dict[str, str]]) -> None:
    bench = Bench()
    bench.write(0x6060, 3, size=1)
    for step in golden_states:
        bench.wait(0.01)
        assert bench.send(step["send"]) == [step["told"]], step["meaning"]


def test_fault_reset_needs_a_rising_edge() -> None:
    bench = Bench()
    bench.send("000 01 05")
    bench.send("205 80 00")
    bench.simulator.inject("emergency", value=0x2310)
    shown = bench.wait(0.01)
    assert "085 10 23 02 00 00 00 00 00" in shown
    assert bench.state is State.FAULT
    assert bench.read(0x603F) == 0x2310
    assert bench.read(0x1001) == 0x02
    assert (bench.read(0x1003), bench.read(0x1003, 1)) == (1, 0x2310)
    bench.send("205 80 00")
    assert bench.state is State.FAULT, "bit 7 was already set"
    bench.send("205 00 00")
    assert "085 00 00 00 00 00 00 00 00" in bench.send("205 80 00")
    assert bench.state is State.SWITCH_ON_DISABLED
    assert bench.read(0x603F) == 0
    bench.write(0x1003, 0, size=1)
    assert bench.read(0x1003) == 0


def test_the_device_name_comes_in_segments() -> None:
    bench = Bench(device_name="EPOS4 simulated")
    assert bench.send("605 40 08 10 00 00 00 00 00") == ["585 41 08 10 00 0F 00 00 00"]
    assert bench.send("605 60 00 00 00 00 00 00 00") == ["585 00 45 50 4F 53 34 20 73"]
    assert bench.send("605 70 00 00 00 00 00 00 00") == ["585 10 69 6D 75 6C 61 74 65"]
    assert bench.send("605 60 00 00 00 00 00 00 00") == ["585 0D 64 00 00 00 00 00 00"]
    assert bench.send("605 60 00 00 00 00 00 00 00") == ["585 80 08 10 00 01 00 04 05"]
    bench.send("605 40 08 10 00 00 00 00 00")
    assert bench.send("605 70 00 00 00 00 00 00 00") == ["585 80 08 10 00 00 00 03 05"]


def test_ramps_follow_their_objects_and_bits_10_and_12_tell_the_truth() -> None:
    bench = Bench()
    bench.write(0x6083, 600)
    bench.write(0x6084, 300)
    bench.write(0x6085, 1200)
    bench.enable(velocity=600)
    bench.wait(0.5)
    assert bench.rpm == pytest.approx(300, rel=1e-6)
    assert bench.read(0x606B) == 300
    assert not bench.read(0x6041) & (1 << 10 | 1 << 12)
    bench.wait(0.6)
    assert bench.read(0x606C) == 600
    assert bench.read(0x6041) & (1 << 10 | 1 << 12) == 1 << 10
    bench.write(0x60FF, 0)
    bench.wait(1.0)
    assert bench.read(0x606B) == 300
    bench.wait(1.1)
    assert bench.read(0x6041) & (1 << 10 | 1 << 12) == 1 << 10 | 1 << 12
    bench.write(0x60FF, 600)
    bench.wait(1.1)
    bench.write(0x6040, 0x02, size=2)
    assert bench.state is State.QUICK_STOP
    bench.wait(0.25)
    assert bench.read(0x606B) == 300
    bench.wait(0.3)
    assert bench.state is State.QUICK_STOP, "option 6 stays"
    bench.write(0x6040, 0x0F, size=2)
    assert bench.state is State.ENABLED


def test_a_quick_stop_with_option_2_ends_without_power() -> None:
    bench = Bench()
    bench.write(0x605A, 2, size=2)
    bench.enable(velocity=600)
    bench.wait(0.5)
    bench.write(0x6040, 0x02, size=2)
    bench.wait(0.5)
    assert bench.state is State.SWITCH_ON_DISABLED
    assert bench.simulator.command(0.0, bench.now_s).mode is DriveMode.OFF


def test_halt_and_disable_operation_ramp_down() -> None:
    bench = Bench()
    bench.enable(velocity=600)
    bench.wait(0.5)
    bench.write(0x6040, 0x10F, size=2)
    bench.wait(0.5)
    assert bench.rpm == 0
    assert bench.state is State.ENABLED
    bench.write(0x6040, 0x0F, size=2)
    bench.wait(0.5)
    bench.write(0x6040, 0x07, size=2)
    bench.wait(0.5)
    assert bench.state is State.SWITCHED_ON


def test_the_velocity_unit_scales_target_and_actual() -> None:
    bench = Bench(velocity_unit=MILLI_RPM)
    bench.write(0x607F, 1_000_000)
    bench.enable(velocity=30_500)
    bench.wait(1.0)
    assert bench.rpm == pytest.approx(30.5)
    assert bench.read(0x606C) == 30_500


def test_the_target_is_limited_by_the_maximum_profile_velocity() -> None:
    bench = Bench()
    bench.write(0x607F, 100)
    bench.enable(velocity=600)
    bench.wait(1.0)
    assert bench.read(0x606C) == 100
    assert bench.read(0x6041) & 1 << 11


def test_other_modes_do_not_turn_the_motor() -> None:
    bench = Bench()
    for control in (0x06, 0x07, 0x0F):
        bench.write(0x6040, control, size=2)
    bench.write(0x60FF, 600)
    bench.wait(1.0)
    assert bench.rpm == 0


def test_the_plant_is_seen_in_the_objects() -> None:
    bench = Bench()
    bench.simulator.observe(MotorState(-12345, -1800.0, 2.5, supply_V=47.9, temperature_C=30.2))
    assert bench.read(0x6064) == 2**32 - 12345
    assert bench.read(0x606C) == 2**32 - 30
    assert bench.read(0x2200, 1) == 479
    assert bench.read(0x30D1, 2) == 2500
    assert bench.read(0x3201, 1) == 302
    assert bench.read(0x3202, 1) == 3


def test_a_generic_drive_has_no_maker_objects() -> None:
    bench = Bench(vendor=0x1234)
    assert bench.read(0x1018, 1) == 0x1234
    assert bench.send("605 40 00 22 01 00 00 00 00") == ["585 80 00 22 01 00 00 02 06"]


# --- heartbeats and NMT ---------------------------------------------------------------------------


def test_the_heartbeat_tells_the_state_in_its_period() -> None:
    bench = Bench()
    assert bench.wait(1.0) == []
    bench.write(0x1017, 100, size=2)
    beats = [frame for frame in bench.wait(1.0, steps=100) if frame.startswith("705")]
    assert beats == ["705 7F"] * len(beats)
    assert 9 <= len(beats) <= 11
    bench.send("000 01 05")
    assert "705 05" in bench.wait(0.2)
    bench.send("000 02 00")
    assert "705 04" in bench.wait(0.2)
    assert bench.send("605 40 00 10 00 00 00 00 00") == [], "no SDO in state stopped"
    bench.send("000 80 05")
    assert "705 7F" in bench.wait(0.2)


def test_a_reset_of_the_node_says_boot_up_and_forgets_what_was_set() -> None:
    bench = Bench()
    bench.write(0x6084, 888)
    bench.send("000 81 05")
    assert bench.send("605 40 00 10 00 00 00 00 00") == []
    assert "705 00" in bench.wait(0.2)
    assert bench.read(0x6084) == 10000


def test_other_nodes_and_other_frames_do_not_concern_it() -> None:
    bench = Bench()
    for frame in ("000 01 06", "606 40 00 10 00 00 00 00 00", "206 06 00", "7E5 04", "000 01"):
        assert bench.send(frame) == []
    line = encode_frame(Frame(0x605, bytes.fromhex("4000100000000000"), extended=True))
    assert bench.simulator.receive(line, bench.now_s) == b"Z\r"


@pytest.mark.parametrize(
    ("option", "state"),
    [
        (0, State.ENABLED),
        (1, State.FAULT),
        (2, State.SWITCH_ON_DISABLED),
        (3, State.QUICK_STOP),
    ],
)
def test_a_missing_heartbeat_of_the_host_has_the_reaction_that_is_set(
    option: int, state: State
) -> None:
    bench = Bench()
    bench.send("000 01 05")
    bench.write(0x6007, option, size=2)
    bench.write(0x1016, 0x007F_012C, subindex=1)
    bench.enable(velocity=600)
    bench.wait(1.0)
    assert bench.state is State.ENABLED, "supervision begins with the first heartbeat"
    for _ in range(5):
        bench.send("77F 05")
        bench.wait(0.25)
    assert bench.rpm != 0
    shown = bench.wait(0.5, steps=50)
    assert "085 30 81 10 00 00 00 00 00" in shown
    assert bench.state is state
    assert (bench.rpm == 0) == (option != 0)
    assert bench.read(0x603F) == 0x8130


@pytest.mark.parametrize(("behaviour", "told"), [(0, "7F"), (1, "05"), (2, "04")])
def test_the_communication_error_behaviour_is_obeyed(behaviour: int, told: str) -> None:
    bench = Bench()
    bench.write(0x1029, behaviour, subindex=1, size=1)
    bench.write(0x1016, 0x007F_012C, subindex=1)
    bench.write(0x1017, 50, size=2)
    bench.send("000 01 05")
    bench.send("77F 05")
    assert f"705 {told}" in bench.wait(0.5)


# --- PDOs -----------------------------------------------------------------------------------------


def test_tpdo1_comes_on_change_and_tpdo4_on_sync_when_mapped_so() -> None:
    bench = Bench()
    bench.write(0x6060, 3, size=1)
    bench.write(0x1803, 1, subindex=2, size=1)
    bench.write(0x1803, 0x4000_0485, subindex=1)
    assert bench.send("000 01 05") == ["185 50 12"]
    assert bench.wait(1.0) == []
    assert bench.send("080") == ["485 50 12 00 00 00 00"]
    bench.simulator.observe(MotorState(0, -1800.0, 0.0))
    assert bench.wait(0.01) == ["185 50 02"]
    assert bench.send("080") == ["485 50 02 E2 FF FF FF"]


def test_tpdo1_is_periodic_only_when_asked_for() -> None:
    bench = Bench(tpdo1_period_s=0.05)
    bench.send("000 01 05")
    frames = [frame for frame in bench.wait(1.0, steps=100) if frame.startswith("185")]
    assert 15 <= len(frames) <= 21


def test_rpdo4_sets_target_and_control_word() -> None:
    bench = Bench()
    bench.write(0x6060, 3, size=1)
    bench.write(0x1403, 0x505, subindex=1)
    bench.send("000 01 05")
    for control in ("06", "07"):
        bench.send(f"205 {control} 00")
    bench.send("505 0F 00 58 02 00 00")
    bench.wait(1.0)
    assert bench.read(0x606C) == 600
    assert "085 10 82 10 00 00 00 00 00" in bench.send("505 0F 00 58")
    assert bench.state is State.FAULT_REACTION


def test_pdos_are_deaf_before_operational() -> None:
    bench = Bench()
    assert bench.send("205 06 00") == []
    assert bench.send("080") == []
    assert bench.state is State.SWITCH_ON_DISABLED


def test_a_mapping_is_changed_in_the_prescribed_order_only() -> None:
    bench = Bench()
    count = "605 2F 03 1A 00 00 00 00 00"
    bench.write(0x1803, 0x4000_0485, subindex=1)
    assert bench.send(count) == ["585 80 03 1A 00 22 00 00 08"]
    bench.write(0x1803, 0xC000_0485, subindex=1)
    entry = "605 23 03 1A 02 20 00 64 60"
    assert bench.send(entry) == ["585 80 03 1A 02 22 00 00 08"]
    bench.write(0x1A03, 0, size=1)
    bench.write(0x1A03, 0x6064_0020, subindex=2)
    assert bench.send("605 23 03 1A 02 20 00 00 10") == ["585 80 03 1A 02 41 00 04 06"]
    bench.write(0x1A03, 0x6064_0020, subindex=1)
    bench.write(0x1A03, 0x6064_0020, subindex=3)
    assert bench.send("605 2F 03 1A 00 03 00 00 00") == ["585 80 03 1A 00 42 00 04 06"]
    bench.write(0x1A03, 2, size=1)


# --- faults ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("code", "register"),
    [
        (0x1000, 0x01),
        (0x2310, 0x02),
        (0x3210, 0x04),
        (0x3220, 0x04),
        (0x4210, 0x08),
        (0x5113, 0x04),
        (0x6100, 0x20),
        (0x6320, 0x20),
        (0x7320, 0x20),
        (0x8110, 0x10),
        (0x8120, 0x10),
        (0x8130, 0x10),
        (0x81FD, 0x10),
        (0x8210, 0x10),
        (0x8611, 0x20),
        (0xFF01, 0x80),
        (0xFF0B, 0x20),
    ],
)
def test_an_emergency_of_each_code_during_a_run(code: int, register: int) -> None:
    bench = Bench(faults=[{"kind": "emergency", "start_s": 1.0, "value": code}])
    bench.write(0x6085, 600)
    bench.enable(velocity=60)
    bench.wait(0.9)
    assert bench.rpm != 0
    shown = bench.wait(0.12, steps=100)
    assert f"085 {code & 0xFF:02X} {code >> 8:02X} {register:02X} 00 00 00 00 00" in shown
    assert bench.state is State.FAULT_REACTION
    bench.wait(0.2)
    assert bench.state is State.FAULT
    assert bench.simulator.command(0.0, bench.now_s).mode is DriveMode.OFF
    bench.write(0x6040, 0x0F, size=2)
    assert bench.state is State.FAULT


def test_safe_torque_off_takes_the_power_and_keeps_it() -> None:
    bench = Bench()
    bench.enable(velocity=600)
    bench.simulator.inject("torque_off")
    bench.wait(0.01)
    assert bench.state is State.SWITCH_ON_DISABLED
    assert bench.read(0x3202, 1) == 0
    for control in (0x06, 0x07, 0x0F):
        bench.write(0x6040, control, size=2)
    assert bench.state is State.SWITCH_ON_DISABLED
    bench.simulator.clear("torque_off")
    bench.wait(0.01)
    bench.enable()


def test_link_faults_are_as_told() -> None:
    bench = Bench(
        faults=[
            {"kind": "sdo_abort", "target": 0x6041, "count": 1, "value": 0x0800_0000},
            {"kind": "no_sdo_reply", "target": 0x6064, "count": 1},
            {"kind": "silent_node", "start_s": 10.0, "end_s": 11.0},
            {"kind": "bus_off", "start_s": 20.0, "end_s": 21.0},
            {"kind": "lost_heartbeat", "start_s": 30.0, "end_s": 31.0},
            {"kind": "boot_up", "start_s": 40.0, "value": 0.2},
        ]
    )
    status = "605 40 41 60 00 00 00 00 00"
    assert bench.send(status) == ["585 80 41 60 00 00 00 00 08"]
    assert bench.send(status)[0].startswith("585 4B")
    position = "605 40 64 60 00 00 00 00 00"
    assert bench.send(position) == []
    assert len(bench.send(position)) == 1
    bench.write(0x1017, 100, size=2)
    bench.wait(10.5, steps=100)
    assert bench.wait(0.4) == []
    assert bench.send(status) == []
    bench.wait(9.6, steps=100)
    assert bench.send(status) == []
    assert "085 FD 81 10 00 00 00 00 00" in bench.wait(0.6, steps=20)
    bench.wait(9.1, steps=100)
    assert not any(frame.startswith("705") for frame in bench.wait(0.4))
    assert len(bench.send(status)) == 1
    assert "705 00" in bench.wait(11.0, steps=200)
    assert bench.read(0x1017) == 0


def test_late_and_missing_tpdos() -> None:
    bench = Bench(
        faults=[
            {"kind": "late_tpdo", "start_s": 1.0, "end_s": 2.0, "value": 0.3},
            {"kind": "no_tpdo", "start_s": 3.0},
        ]
    )
    bench.wait(1.5)
    assert bench.send("000 01 05") == []
    assert bench.wait(0.2) == []
    assert bench.wait(0.2, steps=1) == ["185 50 02"]
    bench.wait(2.0)
    bench.simulator.observe(MotorState(0, -1800.0, 0.0))
    assert bench.wait(1.0) == []


def test_a_wrong_bit_rate_hears_nothing() -> None:
    bench = Bench(bit_rate=1_000_000)
    assert bench.send("605 40 00 10 00 00 00 00 00") == []
    bench.simulator.receive(b"C\rS8\r\rO\r", bench.now_s)
    assert len(bench.send("605 40 00 10 00 00 00 00 00")) == 1


IDENTIFIERS = st.sampled_from([0x000, 0x080, 0x205, 0x305, 0x405, 0x505, 0x605, 0x77F, 0x123])


@given(
    st.lists(
        st.tuples(IDENTIFIERS, st.binary(max_size=8) | st.binary(min_size=8, max_size=8)),
        max_size=20,
    )
)
def test_any_frames_are_borne_and_the_drive_answers_again(
    frames: list[tuple[int, bytes]],
) -> None:
    bench = Bench()
    for identifier, data in frames:
        line = encode_frame(Frame(identifier, data))
        bench.simulator.receive(line, bench.now_s)
        bench.now_s += 0.01
        bench.simulator.command(0.01, bench.now_s)
    bench.send("000 81 05")
    bench.wait(0.3)
    assert bench.send("605 40 02 65 00 00 00 00 00") == ["585 43 02 65 00 FF 03 00 00"]


@given(st.binary(min_size=8, max_size=8), st.sampled_from([0x6083, 0x60FF, 0x1016, 0x1A03]))
def test_any_request_to_a_real_object_gets_one_answer(data: bytes, index: int) -> None:
    bench = Bench()
    request = data[:1] + index.to_bytes(2, "little") + bytes((data[3] % 3,)) + data[4:]
    replies = [f for f in bench.send(f"605 {request.hex()}") if f.startswith("585")]
    assert len(replies) == (0 if request[0] >> 5 == 4 else 1)


def test_counts_that_no_encoder_has_are_refused() -> None:
    with pytest.raises(ValueError, match="four times"):
        Cia402Simulator(counts_per_revolution=3601)
