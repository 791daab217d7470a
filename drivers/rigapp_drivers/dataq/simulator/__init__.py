"""The DATAQ DI-2108 and DI-4108 at the byte level: command lines and voltages in, words out.

Loaded by the simulated rig and by tests; no driver at run time imports it.

After power-on it is idle, and its scan list is analog channel 0. Packets are sent when full.
"""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np

from rigapp_drivers.dataq import protocol as p
from rigapp_drivers.dataq.rates import LARGEST_SRATE, SMALLEST_SRATE, TICKS_PER_ENTRY
from rigapp_drivers.dataq.simulator.terminals import Terminals, known_word, words_of
from rigapp_drivers.simulated import FaultPlan, Faults
from rigapp_drivers.simulator_api import RigSignals

COMMANDS: Final = (
    *("start", "stop", "info", "slist", "srate", "dec", "deca", "filter", "ps", "encode"),
    *("eol", "reset", "led", "endo", "dout", "din", "ffl", "keepalive", "rrate"),
)
_RANGES: Final[Mapping[str, tuple[int, int]]] = {
    "srate": (SMALLEST_SRATE, LARGEST_SRATE),
    "dec": (1, 512),
    "deca": (1, 40000),
    "ps": (0, len(p.PACKET_SIZES) - 1),
    "encode": (0, 1),
    "eol": (0, 2),
    "led": (0, 7),
    "endo": (0, 127),
    "dout": (0, 127),
    "ffl": (1, 64),
    "keepalive": (0, 65535),
}
_CLOCKS: Final[Mapping[tuple[int, ...], bool]] = {(): False, (0,): False, (2,): True}
_LONGEST_LINE: Final = 64


class DataqFault(enum.StrEnum):
    """Kinds of fault; the comment gives the meaning of ``value`` and its default."""

    # in the stream, once
    DROPPED_BYTE = "dropped_byte"  # index of the byte in the next transmission (3)
    GARBAGE = "garbage"  # number of inserted random bytes (7)
    OVERRUN = "overrun"  # number of lost whole scans (10); not reported by the device
    OVERRUN_BYTES = "overrun_bytes"  # number of lost bytes (7); not reported by the device
    # at the inputs, while active
    SATURATED_INPUT = "saturated_input"  # analog channel (1), beyond its range
    STUCK_INPUT = "stuck_input"  # analog channel (1)
    STUCK_COUNTER = "stuck_counter"
    # at the counter, once
    COUNTER_SLIP = "counter_slip"  # counts too many (100)
    # in the replies; count: number of replies, target: index of the command in ``COMMANDS``
    NO_REPLY = "no_reply"
    SLOW_REPLY = "slow_reply"  # delay in s (0.3)
    WRONG_ECHO = "wrong_echo"
    # the device
    HANG = "hang"  # while active: neither sends nor replies
    RESET = "reset"  # power off and on; s until it replies again (0.2)


@dataclass(slots=True)
class Volatile:
    """State that the device loses at power-off."""

    scan_list: list[int] = field(default_factory=lambda: [0])
    filters: dict[int, int] = field(default_factory=dict)
    values: dict[str, int] = field(
        default_factory=lambda: {"srate": 60000, "dec": 1, "deca": 1, "ps": 0, "encode": 0}
    )
    scanning: bool = False
    by_encoder: bool = False
    hung: bool = False
    text: bytes = b""
    packet: bytes = b""


class DataqSimulator:
    """Respond and stream as a DI-2108 or DI-4108 does; implements ``SimulatedDataSource``.

    counts_per_revolution: lines of the encoder, whose line A drives counter and D6. firmware: in
    hundredths. start_echo: echo ``start`` before the first sample. echo_nuls: NULs after every
    echo. srate_rewrites_ps: some firmware sets another packet size with each srate.
    stop_sends_rest: an incomplete packet is sent at stop (else it is lost). overrun_drops: "scans"
    or "bytes", lost after an overrun of the link. encoder_rate_Hz: sample rate of the rig under the
    encoder clock; readings are interpolated at the edges. bridge_amplifiers: V at an input for
    1 mV/V of the bridge before it, by the input's name. direction_line, index_line: digital inputs
    with lines B and Z of the encoder, "none" or "D0" to "D5". master_clock_Hz: reply to ``info 9``.
    A scan rate above 160 kHz over all entries hangs the device. faults: ``Fault`` records or tables
    of their fields, see ``DataqFault``.
    """

    kinds = DataqFault

    def __init__(
        self,
        model: int = 2108,
        *,
        seed: int = 0,
        counts_per_revolution: int = 900,
        firmware: int = 137,
        serial_number: str = "5A0C21F700",
        start_echo: bool = False,
        echo_nuls: int = 0,
        srate_rewrites_ps: bool = False,
        stop_sends_rest: bool = True,
        overrun_drops: str = "scans",
        encoder_rate_Hz: float = 2000.0,
        bridge_amplifiers: dict[str, float] | None = None,
        direction_line: str = "none",
        index_line: str = "none",
        master_clock_Hz: int = p.MASTER_CLOCK_HZ,
        tells_rate: bool = True,
        faults: Faults = (),
    ) -> None:
        if overrun_drops not in ("scans", "bytes"):
            raise ValueError(f"overrun_drops is {overrun_drops!r}, must be 'scans' or 'bytes'")
        self.model = p.MODELS[model]
        self._firmware = firmware
        self._serial_number = serial_number
        self._start_echo = start_echo
        self._echo_nuls = echo_nuls
        self._srate_rewrites_ps = srate_rewrites_ps
        self._stop_sends_rest = stop_sends_rest
        self._overrun_drops = overrun_drops
        self._encoder_rate_Hz = encoder_rate_Hz
        gains = bridge_amplifiers or {}
        self._gains = {int(name.removeprefix("analog_")): gains[name] for name in gains}
        self._plan = FaultPlan(DataqFault, faults)
        self.inject, self.clear = self._plan.add, self._plan.clear
        self._rng = np.random.default_rng(seed)
        self._master_clock_Hz = master_clock_Hz
        self._tells_rate = tells_rate
        self._terminals = Terminals(
            counts_per_revolution, line_b=_line(direction_line), line_z=_line(index_line)
        )
        self._state = Volatile()
        self._silent_until_s = 0.0
        self._to_drop = 0

    # --- interface to the rig -------------------------------------------------------------------

    @property
    def sample_rate_Hz(self) -> float:
        """Return the scan rate; with the encoder clock the sample rate of the rig.

        While idle it is at most that of the encoder clock, as no samples are sent.
        """
        if not self._state.scanning:
            return min(self._scan_rate_Hz(), self._encoder_rate_Hz)
        return self._encoder_rate_Hz if self._state.by_encoder else self._scan_rate_Hz()

    @property
    def streaming(self) -> bool:
        """Return whether the device scans."""
        return self._state.scanning

    @property
    def packet_bytes(self) -> int:
        """Return the packet size in bytes."""
        return p.PACKET_SIZES[self._state.values["ps"]]

    @property
    def scan_list(self) -> tuple[int, ...]:
        """Return the scan list's words."""
        return tuple(self._state.scan_list)

    @property
    def settings(self) -> Mapping[str, int]:
        """Return the present srate, dec, deca, ps and other settings of the device."""
        return dict(self._state.values)

    @property
    def filters(self) -> Mapping[int, int]:
        """Return the set filter modes by channel."""
        return dict(self._state.filters)

    def overrun(self, now_s: float) -> None:
        """Record that the link dropped old data, which the device does not report."""
        if self._overrun_drops == "bytes":
            self._to_drop += 1

    def receive(self, data: bytes, now_s: float) -> bytes:
        """Process bytes from the host and return the replies."""
        self._tick(now_s)
        state = self._state
        if self._is_silent():
            state.text = b""
            return b""
        *lines, rest = (state.text + data.replace(b"\n", b"")).split(b"\r")
        state.text = rest[-_LONGEST_LINE:]
        replies = b"".join(self._reply(text) for text in lines)
        return self._plan.due() + replies

    def sample(self, signals: RigSignals, now_s: float) -> bytes:
        """Return the bytes sent for these samples (b"" when not streaming)."""
        self._tick(now_s)
        replies = b"" if self._is_silent() else self._plan.due()
        if signals.shaft_revolutions.size == 0:
            return replies
        state = self._state
        self._disturb()
        readings = self._terminals.read(
            self._amplified(signals),
            self.sample_rate_Hz,
            by_encoder=state.by_encoder and state.scanning,
        )
        if not state.scanning or self._is_silent():
            return replies
        words = words_of(readings, state.scan_list, self.model, self._rng)
        state.packet += self._damaged(words.astype("<u2"))
        size = self.packet_bytes
        length = len(state.packet) // size * size
        data, state.packet = state.packet[:length], state.packet[length:]
        return replies + data

    def _amplified(self, signals: RigSignals) -> RigSignals:
        """Return the output signals of the bridge amplifiers: V instead of mV/V."""
        analog = {n: signal * self._gains.get(n, 1.0) for n, signal in signals.analog.items()}
        return RigSignals(analog, signals.shaft_revolutions)

    def _scan_rate_Hz(self) -> float:
        values = self._state.values
        return p.MASTER_CLOCK_HZ / (values["srate"] * values["dec"] * values["deca"])

    # --- the time of the wire -------------------------------------------------------------------

    def _tick(self, now_s: float) -> None:
        time_s = self._plan.tick(now_s)
        boot_s = self._plan.take(DataqFault.RESET, 0.2)
        if boot_s is not None:
            self._state = Volatile()
            self._terminals.count = 0
            self._plan.forget_late()
            self._silent_until_s = time_s + boot_s

    def _is_silent(self) -> bool:
        booting = self._plan.time_s < self._silent_until_s
        return self._state.hung or booting or self._plan.on(DataqFault.HANG)

    # --- commands -------------------------------------------------------------------------------

    def _reply(self, text: bytes) -> bytes:
        state = self._state
        words = text.decode("ascii", "replace").split()
        if not words or words[0] not in COMMANDS or (state.scanning and words[0] != "stop"):
            return b""
        before = state.packet if self._stop_sends_rest and words[0] == "stop" else b""
        answer = self._obey(words[0], words[1:])
        if answer is None:
            return b""
        link_fault, target = self._plan.link_fault, COMMANDS.index(words[0])
        reply = (text.decode("ascii").rstrip() + answer).encode("ascii") + b"\r"
        if words[0] == "start" and not self._start_echo:
            return b""
        if link_fault(DataqFault.NO_REPLY, target) is not None:
            return before
        if link_fault(DataqFault.WRONG_ECHO, target) is not None:
            reply = b"?" + reply
        reply = before + reply + bytes(self._echo_nuls)
        return self._plan.in_time(reply, DataqFault.SLOW_REPLY, target, 0.3)

    def _obey(self, command: str, fields: list[str]) -> str | None:
        """Execute a command; return the text after its echo, None if it is invalid."""
        try:
            numbers = tuple(int(text) for text in fields)
        except ValueError:
            return None
        if command == "start":
            return self._begin(numbers)
        if command == "stop":
            self._state.scanning = False
            self._state.packet = b""
            return ""
        if command == "info":
            return self._info(numbers)
        if command == "slist":
            return self._list(numbers)
        if command == "filter":
            if len(numbers) != 2 or not (0 <= numbers[0] < 8 and 0 <= numbers[1] < 4):
                return None
            self._state.filters[numbers[0]] = numbers[1]
            return ""
        if command == "reset":
            if numbers != (1,):
                return None
            self._terminals.count = 0
            return ""
        if command == "din":
            return " 0"
        if command == "rrate":
            return f" {self._scan_rate_Hz():g}" if self._tells_rate else None
        return self._set(command, numbers)

    def _begin(self, numbers: tuple[int, ...]) -> str | None:
        clock = _CLOCKS.get(numbers)
        state = self._state
        if clock is None:
            return None
        state.hung = state.values["srate"] < TICKS_PER_ENTRY * len(state.scan_list)
        state.scanning = True
        state.by_encoder = clock
        return ""

    def _info(self, numbers: tuple[int, ...]) -> str | None:
        items = {
            0: "DATAQ",
            1: str(self.model.number),
            2: f"{self._firmware:X}",
            6: self._serial_number,
            9: str(self._master_clock_Hz),
        }
        if len(numbers) != 1 or numbers[0] not in items:
            return None
        return f" {items[numbers[0]]}"

    def _list(self, numbers: tuple[int, ...]) -> str | None:
        scan_list = self._state.scan_list
        if len(numbers) != 2 or not 0 <= numbers[0] <= min(len(scan_list), p.MOST_ENTRIES):
            return None
        index, word = numbers
        if word == p.END_OF_LIST:
            del scan_list[max(1, index) :]
            return ""
        if not known_word(word, self.model) or index == p.MOST_ENTRIES:
            return None
        scan_list[index : index + 1] = [word]
        return ""

    def _set(self, command: str, numbers: tuple[int, ...]) -> str | None:
        lowest, highest = _RANGES[command]
        if len(numbers) != 1 or not lowest <= numbers[0] <= highest:
            return None
        self._state.values[command] = numbers[0]
        if command == "srate" and self._srate_rewrites_ps:
            self._state.values["ps"] = len(p.PACKET_SIZES) - 1
        return ""

    # --- faults ---------------------------------------------------------------------------------

    def _disturb(self) -> None:
        active, terminals = self._plan.active, self._terminals
        saturated = active(DataqFault.SATURATED_INPUT, 1.0)
        stuck = active(DataqFault.STUCK_INPUT, 1.0)
        terminals.saturated = None if saturated is None else int(saturated)
        terminals.stuck = None if stuck is None else int(stuck)
        terminals.stuck_counter = self._plan.on(DataqFault.STUCK_COUNTER)
        slip = self._plan.take(DataqFault.COUNTER_SLIP, 100.0)
        terminals.count += int(slip or 0)

    def _damaged(self, words: np.ndarray[Any, Any]) -> bytes:
        """Return the bytes of scans with the effects of faults."""
        if len(words) == 0:
            return b""
        take = self._plan.take
        lost = take(DataqFault.OVERRUN, 10.0)
        if lost is not None:
            words = words[int(lost) :]
        data = words.tobytes()
        lost_bytes = int(take(DataqFault.OVERRUN_BYTES, 7.0) or 0) + self._to_drop
        self._to_drop = max(0, lost_bytes - len(data))
        data = data[lost_bytes:]
        dropped = take(DataqFault.DROPPED_BYTE, 3.0)
        if dropped is not None:
            index = int(dropped) % max(1, len(data))
            data = data[:index] + data[index + 1 :]
        garbage = take(DataqFault.GARBAGE, 7.0)
        if garbage is not None:
            data = self._rng.bytes(max(1, int(garbage))) + data
        return data


def _line(name: str) -> int | None:
    """Return the number of a digital line; None for "none"."""
    return None if name == "none" else int(name.removeprefix("D"))


__all__ = ["COMMANDS", "DataqFault", "DataqSimulator"]
