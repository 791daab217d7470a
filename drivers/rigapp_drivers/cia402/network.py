"""One CANopen node on a CAN bus through python-can and canopen: frames, SDO, host heartbeat.

A dedicated thread receives, because python-can's notifier ends silently at the first exception. One
lock serialises the SDOs.
"""

from __future__ import annotations

import contextlib
import struct
import threading
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Final

import can
import canopen
from canopen.sdo import SdoClient

from rigapp.texts import say, sentence_of_error
from rigapp_drivers.api import (
    ConnectionFailed,
    DeviceError,
    DeviceLost,
    Identity,
    PortInUse,
    ReplyTimeout,
    SettingRefused,
    WrongDevice,
)
from rigapp_drivers.cia402.protocol import (
    HEARTBEAT_BASE,
    NMT_ID,
    PROFILE_402,
    SDO_REPLY_BASE,
    SDO_REQUEST_BASE,
    VENDOR_MAXON,
    Nmt,
    NodeState,
)
from rigapp_drivers.cia402.slcan import Frame, encode_frame
from rigapp_drivers.exchange import NamedQuestions
from rigapp_drivers.transport import SerialPort
from rigapp_drivers.wire.ports import RECORDED, PortNotFound, actual_port
from rigapp_drivers.wire.recorder import recorders_of

TRIES: Final = 3  # one lost frame must not stop a test; after three the node is considered lost
FIRST_TRIES: Final = 10  # until it is identified nothing turns, and a busy computer may be late
_SLCAN_BAUD_RATE: Final = 115200  # as python-can opens it
_OBJECTS: Final = Path(__file__).with_name("objects.eds")
_WAIT_S: Final = 0.05  # maximum delay until the receiver notices its end
_SEND_S: Final = 1.0
"""Time-out after which an adapter that accepts no frame is lost. Not shorter: pyserial reports a
time-out for a sent frame if the program was delayed; the drive's supervision stops it meanwhile."""
_JOIN_S: Final = 2.0  # many times the wait of the receiver
_NAMES_OBJECT: Final = (2, 3, 4)  # begun upload, begun download, abort (CiA 301, 7.2.4.3)
_MISSING: Final = (0x0602_0000, 0x0609_0011)  # no such object, no such sub-index (CiA 301)

Taker = Callable[[bytes, int], None]


class _Bus(canopen.Network):  # type: ignore[misc]
    """Route the frames of canopen's SDO client through the node, with a time-out."""

    def __init__(self, send: Callable[[int, bytes], None]) -> None:
        super().__init__()
        self._send = send

    def send_message(self, can_id: int, data: bytes, remote: bool = False) -> None:
        """Send one frame."""
        self._send(can_id, bytes(data))


class CanNode:
    """Communicate with one node. ``send`` may be called by any thread; SDOs are serialised.

    ``tries``: default number of tries of a request.
    ``hurry`` ends the retries of a pending SDO, so that a stop need not wait for them.
    ``stop_requests`` counts stops: a call that began before the last one does not enable the drive.
    """

    def __init__(
        self, device: str, port: str, node_id: int, bus_options: Mapping[str, Any], timeout_s: float
    ) -> None:
        self.device = device
        self.port = port
        self.node_id = node_id
        self.hurry = threading.Event()
        self.stop_requests = 0
        self.bad_frames = 0
        self.frames_received = 0
        self.frames_sent = 0
        self.retries = 0
        self.tries = FIRST_TRIES
        self.last_beat_ns = 0
        self._bus_options = dict(bus_options)
        self._timeout_s = timeout_s
        self._host_id: int | None = None
        self._bus: Any = None
        self._thread: threading.Thread | None = None
        self._closing = threading.Event()
        self._failure: Exception | None = None
        self._takers: dict[int, Taker] = {}
        self._sending = threading.Lock()
        self._transfer = threading.RLock()
        self._requested = NamedQuestions(device, timeout_s, "sdo_timeout_ms", 1e3)
        self._network = _Bus(self.send)
        self._sdo = self._client()

    def _client(self) -> Any:
        objects = canopen.import_od(str(_OBJECTS), self.node_id)
        client = SdoClient(SDO_REQUEST_BASE + self.node_id, SDO_REPLY_BASE + self.node_id, objects)
        client.RESPONSE_TIMEOUT = self._timeout_s
        client.network = self._network

        def answered(data: bytes, host_time_ns: int) -> None:
            # canopen checks the object only for reads, so a late reply could confirm a write.
            named = data[:1] and data[0] >> 5 in _NAMES_OBJECT
            if named and not self._requested.is_answer(data[1:4]):
                return
            client.on_response(0, data, 0)

        self._takers[SDO_REPLY_BASE + self.node_id] = answered
        return client

    # --- bus -------------------------------------------------------------------------------------

    def open(self) -> None:
        """Open the bus and start receiving; raise ConnectionFailed."""
        try:
            self._refuse_shared_port()
            options = dict(self._bus_options)
            channel = str(options["channel"])
            if channel.startswith(RECORDED):  # for any adapter of the recording
                options |= {"interface": "slcan", "timeout": 0.01, "sleep_after_open": 0.0}
            if options["interface"] == "slcan":
                options["channel"] = actual_port(channel)
            self._bus = can.Bus(**options)
            _hold_port(self._bus)
        except ConnectionFailed:
            raise
        except PortNotFound as error:
            raise ConnectionFailed.at(self, sentence_of_error(error)) from error
        except Exception as error:  # each interface has its own exception classes
            interface = self._bus_options["interface"]
            raise ConnectionFailed.at(
                self,
                "the CAN interface {} cannot be opened ‹{}›; check the channel's name,"
                " the adapter and that no other program uses it.",
                interface,
                error,
            ) from error
        name = say("{} CAN receiver", self.device)
        self._thread = threading.Thread(target=self._receive, name=name, daemon=True)
        self._thread.start()

    def _refuse_shared_port(self) -> None:
        """Refuse an slcan adapter that another program uses; python-can would share it."""
        channel = str(self._bus_options["channel"])
        recorded = channel.startswith(RECORDED)
        if self._bus_options["interface"] != "slcan" or "://" in channel or recorded:
            return
        line = SerialPort(self.device, channel.partition("@")[0], _SLCAN_BAUD_RATE)
        try:
            line.open()
        except PortInUse:
            raise
        except ConnectionFailed:  # python-can's error is more specific
            return
        finally:
            line.close()

    def listen(self, identifier: int, taker: Taker) -> None:
        """Call taker(data, host_time_ns) in the receiving thread for frames of an identifier."""
        self._takers[identifier] = taker

    def send(self, identifier: int, data: bytes) -> None:
        """Send one frame; raise DeviceLost."""
        self._check()
        message = can.Message(arbitration_id=identifier, data=data, is_extended_id=False)
        try:
            with self._sending:
                for recorder in recorders_of(self.device, self.port):
                    recorder.sent(encode_frame(Frame(identifier, bytes(data))))
                self._bus.send(message, timeout=_SEND_S)
                self.frames_sent += 1
        except Exception as error:
            raise self._lost(error) from error

    def close(self) -> None:
        """Stop receiving and release the bus; never raises."""
        self._closing.set()
        thread, self._thread = self._thread, None
        if thread is not None and thread is not threading.current_thread():
            thread.join(_JOIN_S)
        bus, self._bus = self._bus, None
        if bus is not None:
            try:
                bus.shutdown()
            except Exception:
                _close_port(bus)
        for recorder in recorders_of(self.device, self.port):
            recorder.close()

    def _receive(self) -> None:
        bus = self._bus
        while not self._closing.is_set():
            message = None
            try:
                message = bus.recv(_WAIT_S)
            except (ValueError, IndexError):  # slcan: an invalid line
                self.bad_frames += 1
                continue
            except can.CanOperationError as error:
                if not isinstance(error.__cause__, UnicodeDecodeError):
                    self._failure = error
                    return
                # python-can would decode a non-ASCII byte again with all following bytes.
                self.bad_frames += 1
                bus._buffer.clear()
            except Exception as error:
                self._failure = error
                return
            if message is not None:
                self._deliver(message)

    def _deliver(self, message: Any) -> None:
        # python-can accepts an slcan line with missing digits as a shorter frame.
        cut = not message.is_remote_frame and len(message.data) != message.dlc
        if message.is_error_frame or cut:
            self.bad_frames += 1
            return
        self.frames_received += 1
        for recorder in recorders_of(self.device, self.port):
            recorder.received(_line_of(message))
        taker = self._takers.get(message.arbitration_id)
        if taker is not None and not message.is_remote_frame and not message.is_extended_id:
            taker(bytes(message.data), time.monotonic_ns())

    def _check(self) -> None:
        failure = self._failure
        if failure is not None:
            raise self._lost(failure) from failure
        if self._bus is None:
            raise DeviceLost.at(self, "the CAN bus is not open.")

    def _lost(self, error: Exception) -> DeviceError:
        return DeviceLost.at(
            self, "the CAN adapter broke off ‹{}›; check its cable and the bus.", error
        )

    # --- node ------------------------------------------------------------------------------------

    def command(self, command: Nmt) -> None:
        """Send a network management command to the node."""
        self.send(NMT_ID, bytes((command, self.node_id)))

    def start_beating(self, host_id: int) -> None:
        """Start sending the host's heartbeat with every ``beat`` and every SDO."""
        self._host_id = host_id
        self.beat()

    def stop_beating(self) -> None:
        """Stop sending heartbeats."""
        self._host_id = None

    def beat(self) -> None:
        """Send one heartbeat of the host; no thread sends it otherwise."""
        if self._host_id is not None:
            self.send(HEARTBEAT_BASE + self._host_id, bytes((NodeState.OPERATIONAL,)))
            self.last_beat_ns = time.monotonic_ns()

    # --- SDO -------------------------------------------------------------------------------------

    def read(self, index: int, subindex: int = 0, tries: int | None = None) -> int:
        """Return a number; raise SettingRefused on an abort, ReplyTimeout, DeviceLost."""
        variable = self._variable(index, subindex)
        data = self._try(index, subindex, tries, lambda: self._sdo.upload(index, subindex))
        try:
            return int(variable.decode_raw(data))
        except Exception as error:
            raise self._refused(index, subindex, say("{}, {}", data.hex(), error)) from error

    def read_if_there(self, index: int, subindex: int = 0) -> int | None:
        """Return a number, None if the drive has no such object."""
        try:
            return self.read(index, subindex)
        except SettingRefused as refusal:
            cause = refusal.__cause__
            if isinstance(cause, canopen.SdoAbortedError) and cause.code in _MISSING:
                return None
            raise

    def read_text(self, index: int) -> str:
        """Return a text, "" if the drive has none."""
        try:
            data = self._try(index, 0, None, lambda: self._sdo.upload(index, 0))
        except SettingRefused:
            return ""
        return bytes(data).decode("ascii", "replace").rstrip("\0 ")

    def write(self, index: int, value: int, subindex: int = 0, tries: int | None = None) -> None:
        """Set a number; errors as ``read``."""
        data = self._variable(index, subindex).encode_raw(value)
        self._try(index, subindex, tries, lambda: self._sdo.download(index, subindex, data))

    def overtake(self, index: int, value: int) -> None:
        """Send a download during a pending transfer without waiting for the reply."""
        data = self._variable(index, 0).encode_raw(value)
        head = struct.pack("<BHB", 0x23 | (4 - len(data)) << 2, index, 0)
        self.send(SDO_REQUEST_BASE + self.node_id, head + data.ljust(4, b"\0"))

    def _variable(self, index: int, subindex: int) -> Any:
        return self._sdo.od.get_variable(index, subindex)

    def _try(
        self, index: int, subindex: int, tries: int | None, transfer: Callable[[], Any]
    ) -> Any:
        most = self.tries if tries is None else tries
        with self._transfer:
            self._requested.begin(struct.pack("<HB", index, subindex))
            for attempt in range(1, most + 1):
                self._check()
                self.beat()
                self.retries += attempt > 1
                self._requested.requested()
                try:
                    result = transfer()
                    self._requested.leave(answered=True)
                    return result
                except canopen.SdoAbortedError as error:
                    self._requested.leave(answered=True)
                    raise self._refused(index, subindex, sentence_of_error(error)) from error
                except canopen.SdoCommunicationError as error:
                    self._check()
                    if attempt < most and not self.hurry.is_set():
                        continue
                    self._requested.leave(answered=False)
                    if self._requested.late_s:
                        raise ReplyTimeout.at(
                            self,
                            "no answer of node {} in time; {} ‹object {}›.",
                            self.node_id,
                            self._requested.words(),
                            _shown(index, subindex),
                        ) from error
                    raise ReplyTimeout.at(
                        self,
                        "node {} did not answer in {} tries of {:.0f} ms: check"
                        " power, wiring, terminators, node id and bit rate ‹object"
                        " {}›.",
                        self.node_id,
                        attempt,
                        self._timeout_s * 1000.0,
                        _shown(index, subindex),
                    ) from error
        raise AssertionError(say("at least one try"))

    def _refused(self, index: int, subindex: int, what: str) -> SettingRefused:
        return SettingRefused.at(
            self,
            "node {} refused to be read or set; check the drive's manual and its"
            " settings ‹object {}: {}›.",
            self.node_id,
            _shown(index, subindex),
            what,
        )


def _shown(index: int, subindex: int) -> str:
    return f"{index:04X}:{subindex}"


def _line_of(message: Any) -> bytes:
    """Return a received frame as an slcan line for the recording, for any adapter."""
    remote = bool(message.is_remote_frame)
    data = b"" if remote else bytes(message.data)
    return encode_frame(
        Frame(message.arbitration_id, data, bool(message.is_extended_id), remote, message.dlc)
    )


def _hold_port(bus: Any) -> None:
    """Lock the serial port of an slcan bus against other programs."""
    port: Any = getattr(bus, "serialPortOrig", None)
    if not hasattr(port, "fd"):
        return
    try:
        port.exclusive = True
    except Exception:  # another program was faster
        with contextlib.suppress(Exception):
            bus.shutdown()
        raise


def _close_port(bus: Any) -> None:
    """Close the serial port of an slcan bus after a failed shutdown (cable pulled)."""
    port = getattr(bus, "serialPortOrig", None)
    if port is not None:
        try:
            port.close()
        except Exception:
            return


_WAKING_TRIES: Final = 3  # the first is lost while a drive finds its bit rate


def identify(node: CanNode, interface: str, objects: str) -> Identity:
    """Return the drive's identity; details["objects"] is "epos4" or "generic".

    objects: the setting. Raises ConnectionFailed if the node does not answer, WrongDevice if it is
    no CiA 402 drive.
    """
    try:
        device_type = _wake(node)
    except ReplyTimeout as error:
        raise ConnectionFailed.at(node, error.sentence) from error
    if device_type & 0xFFFF != PROFILE_402:
        raise WrongDevice.at(
            node,
            "node {} is no CiA 402 drive ‹device type {}›.",
            node.node_id,
            f"{device_type:08X}",
        )
    vendor, product, revision, serial = (node.read_if_there(0x1018, sub) for sub in range(1, 5))
    if objects == "auto":
        objects = "epos4" if vendor == VENDOR_MAXON else "generic"
    return Identity(
        maker="maxon" if vendor == VENDOR_MAXON else say("vendor {}", f"{vendor or 0:08X}"),
        model=node.read_text(0x1008) or say("product {}", f"{product or 0:08X}"),
        firmware=f"{(revision or 0) >> 16:04X}",
        serial_number=f"{serial:08X}" if serial else "",
        port=node.port,
        details={"node_id": str(node.node_id), "interface": interface, "objects": objects},
    )


def _wake(node: CanNode) -> int:
    """Read the device type; wake a stopped node, or one that is detecting the bit rate."""
    try:
        return node.read(0x1000, tries=_WAKING_TRIES)
    except ReplyTimeout:
        node.command(Nmt.PRE_OPERATIONAL)
        return node.read(0x1000)


_NUMBERED_CHANNELS: Final = ("kvaser", "gs_usb")


def bus_options(port: str, settings: Mapping[str, Any]) -> dict[str, Any]:
    """Return the arguments of ``can.Bus`` for a port; raise ValueError for a wrong channel."""
    interface = str(settings["interface"])
    options: dict[str, Any] = {
        "interface": interface,
        "channel": port,
        "bitrate": int(settings["bit_rate"]),
    }
    if interface == "slcan":
        options["sleep_after_open"] = float(settings["sleep_after_open_s"])
        options["timeout"] = 0.01
    elif interface in _NUMBERED_CHANNELS:
        if not port.isdecimal():
            raise ValueError(say("the channel of {} is a number, not {}", interface, repr(port)))
        options["channel"] = int(port)
        if interface == "gs_usb":
            options["index"] = int(port)
    return options
