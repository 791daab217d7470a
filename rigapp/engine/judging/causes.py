"""The alarms that the engine can raise: cause, consequence and action in an operator's words."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from rigapp.engine.judging.criteria import Met
from rigapp.schema.criteria import CRITERIA
from rigapp.schema.messages import Ends, Severity


@dataclass(frozen=True, slots=True)
class Cause:
    """Describe an alarm. latched: it stays on the list until it is reset. ends: what ends it."""

    key: str
    severity: Severity
    title: str
    cause: str
    consequence: str
    action: str
    latched: bool = False
    ends: Ends = Ends.SEEN


@dataclass(frozen=True, slots=True)
class Kind:
    """Say what all alarms of a kind share. title: ``{}`` stands for the name of what it is about.

    ends: what ends its condition, at the latest. A critical alarm latches.
    """

    severity: Severity
    title: str
    consequence: str
    action: str
    ends: Ends = Ends.SEEN


def _critical(title: str, consequence: str, action: str, ends: Ends = Ends.SEEN) -> Kind:
    return Kind(Severity.CRITICAL, title, consequence, action, ends)


def _warning(title: str, consequence: str, action: str, ends: Ends = Ends.SEEN) -> Kind:
    return Kind(Severity.WARNING, title, consequence, action, ends)


KINDS: Mapping[str, Kind] = {
    "overload": _critical(
        "Overload",
        "The drive was switched off to protect the load cell.",
        "Look at joint, spring and guide; check the zero; then reset and start again.",
        Ends.TEST,
    ),
    "invalid_signal": _critical(
        "Load cell signal invalid",
        "The force is not known, so the drive was switched off.",
        "Check the load cell's cable and the amplifier's input; then reset.",
    ),
    "saturated": _critical(
        "Load cell input saturated: {}",
        "The force is not known, so the drive was switched off.",
        "Check plug, cable and bridge of this input, and its range in the rig file; then reset.",
    ),
    "input_saturated": _warning(
        "Input saturated: {}",
        "What this input shows is cut off at the end of its range; its samples are flagged.",
        "Check plug, cable and sensor of this input, and its range in the rig file.",
    ),
    "overspeed": _critical(
        "Overspeed",
        "The drive was switched off.",
        "Check the drive's tuning and its encoder; then reset and start again.",
        Ends.TEST,
    ),
    "stale_data": _critical(
        "No data",
        "Force and angle are unknown, so the drive was switched off.",
        "Check the cable and the power of the device; then reconnect.",
        Ends.CONNECTION,
    ),
    "encoder_lost": _critical(
        "Encoder lost",
        "The crank angle is unknown, so the drive was switched off.",
        "Check the encoder's cable, its supply and its coupling; then reset.",
        Ends.TEST,
    ),
    "senses_differ": _critical(
        "Direction wrong",
        "Every angle would be mirrored, or the motor run away, so the test was stopped.",
        "Set it right, connect again, and watch the first turn.",
        Ends.TEST,
    ),
    "speeds_differ": _critical(
        "Speeds differ",
        "Speed, revolutions or every angle would be wrong by their ratio, so the test was stopped.",
        "Set it right in the rig file, connect again, and compare both speeds on the Devices tab.",
        Ends.TEST,
    ),
    "index_missed": _critical(
        "Encoder index missing",
        "Revolutions cannot be cut at the index, so the test was stopped.",
        "Check the index line of the encoder and restarts_at_index in the rig file.",
        Ends.TEST,
    ),
    "count_mismatch": _warning(
        "Encoder counts lost",
        "Angles of that revolution are uncertain; its row is flagged.",
        "If it comes again, check the encoder's cable, shield and supply.",
        Ends.TEST,
    ),
    "lost_samples": _warning(
        "Samples lost",
        "The revolutions concerned are flagged; nothing is interpolated.",
        "Close other programs, check the USB cable, or lower the sample rate.",
        Ends.TEST,
    ),
    "overrun": _warning(
        "Engine too slow",
        "The revolutions concerned are flagged as gaps.",
        "Close other programs or lower the sample rate.",
    ),
    "queue_age": _critical(
        "Engine lags behind",
        "An overload would be seen too late, so the drive was switched off.",
        "Close other programs, lower the sample rate, or take a faster computer; then reset.",
    ),
    "input:broken": _critical(
        "Load cell broken",
        "The force is not known, an overload would not be seen: the test was ended and the "
        "spindle stopped. The samples since then are flagged.",
        "Check the bridge's wires, plug and cell; then reconnect and reset.",
        Ends.CONNECTION,
    ),
    "input:suspect": _warning(
        "Sensor broken",
        "Every sample is flagged until the devices are connected again.",
        "Check the sensor's wires and plug, then reconnect.",
        Ends.CONNECTION,
    ),
    "input:saturated": _warning(
        "Input saturated",
        "What this input shows is wrong as long as it is; the samples are flagged.",
        "Look at the signal, its sensor, its range and its cable.",
    ),
    "input": _warning(
        "Input {}",
        "What this input shows may be wrong.",
        "Look at the signal, its sensor, its range and its cable.",
        Ends.CONNECTION,
    ),
    "time_jump": _warning(
        "Clocks parted",
        "Samples may have been lost unseen; the revolution is flagged.",
        "Check for suspend mode and load of this computer.",
        Ends.TEST,
    ),
    "device_lost": _critical(
        "{} lost",
        "The test was ended and the spindle stopped.",
        "Check cable and power, then reconnect.",
        Ends.CONNECTION,
    ),
    "drive_fault": _critical(
        "Drive fault",
        "The test was ended; the drive has taken or lost its power.",
        "Remove the cause as the drive's manual says, then reset.",
        Ends.DRIVE,
    ),
    "emergency_stop": _critical(
        "Emergency stop",
        "The motor has no power; the test was ended.",
        "Make the rig safe, release the button, then reset. Nothing restarts by itself.",
        Ends.DRIVE,
    ),
    "drive_silent": _critical(
        "Drive does not answer",
        "Its own watchdog stops the motor.",
        "Check cable and power of the drive, then reconnect.",
        Ends.CONNECTION,
    ),
    "slow_silent": _warning(
        "No answer from {}",
        "What it tells is not recorded until it answers; the test goes on.",
        "Check its cable, its power and its port in the rig file.",
        Ends.CONNECTION,
    ),
    "drive_warning": _warning(
        "Drive warning",
        "The drive may switch off by itself soon.",
        "Look at supply, temperature and load of the drive.",
    ),
    "thread": _critical(
        "Internal failure",
        "The test was ended and the spindle stopped; the data so far are safe.",
        "Save the log and report it; reconnect before the next test.",
        Ends.CONNECTION,
    ),
    "storage": _critical(
        "File cannot be written",
        "The test was ended; the committed revolutions are safe.",
        "Check the disk; start again with another file.",
        Ends.TEST,
    ),
    "file_moved": _warning(
        "File deleted, moved or replaced",
        "Nothing is lost; the test goes on and is recorded.",
        "Leave the file of a running test alone. Look where it is now before you copy it.",
        Ends.TEST,
    ),
    "file_unsaved": _critical(
        "File has no name any more",
        "The test goes on. Its data are kept only as long as this program runs; saving them is "
        "tried again every few seconds.",
        "Make room, or bring the folder back. Do not end the program before.",
        Ends.TEST,
    ),
    "disk_slow": _warning(
        "Disk slow",
        "The test goes on, its data wait in memory; after 20 s it would be stopped.",
        "Stop other programs that write to this disk; look at its health and its network.",
        Ends.TEST,
    ),
    "service": _warning(
        "Windows cannot be served",
        "The test goes on and is recorded; windows may show nothing and cannot command it.",
        "Stop the test where it was started (Ctrl-C), or by the emergency stop.",
        Ends.ENGINE,
    ),
    "will_not_stop": _critical(
        "Spindle not shown to stand",
        "THE SPINDLE MAY STILL TURN.",
        "Press the emergency stop. Do not touch the rig before the crank stands.",
        Ends.STAND,
    ),
    "start_failed": _critical(
        "Set speed not reached",
        "The test was stopped.",
        "Check the mechanism for stiffness, the drive's current limit and its tuning.",
        Ends.TEST,
    ),
    "speed_lost": _critical(
        "Set speed lost",
        "The test was stopped.",
        "Check the mechanism for stiffness, the coupling, and whether the drive has switched off.",
        Ends.TEST,
    ),
    "moved_in_pause": _critical(
        "Crank moves in the pause",
        "The drive was switched off and the test ended.",
        "Keep clear of the crank; check the drive's holding torque and the spring.",
        Ends.TEST,
    ),
    "device_overrun": _warning(
        "Device dropped data",
        "The revolutions concerned are flagged.",
        "Close other programs, check the USB cable, or lower the sample rate.",
        Ends.TEST,
    ),
    "pause_failed": _critical(
        "Pause not reached",
        "The test was stopped.",
        "Check the drive's tuning at low speed.",
        Ends.TEST,
    ),
    "cycles_refused": _warning(
        "Whole cycles not kept",
        "Their statistics are kept, their samples are not.",
        "Plan fewer whole cycles, or a new test.",
        Ends.TEST,
    ),
    "stop": _critical(
        "Stop criterion: {}",
        "The test was stopped, as its test file says.",
        "Look at the trend and the joint; go on with the test in its file, or end it here.",
        Ends.TEST,
    ),
    "blind": _warning(
        "Stop criterion not judged: {}",
        "The test goes on without this criterion.",
        "Check the probes, or the prediction's process, or stop the test.",
        Ends.TEST,
    ),
}
"""The kinds of alarms by key. The key of an alarm is that of its kind, or begins with it and
``:``. Rules of the test file make alarms of their own, ``rule:...``."""


def _cause(kind: str, sentence: str, *, key: str = "", name: str = "") -> Cause:
    """Return an alarm of a kind. key: of this alarm, when a kind has several."""
    shared = KINDS[kind]
    return Cause(
        key=key or kind,
        severity=shared.severity,
        title=shared.title.format(name),
        cause=sentence,
        consequence=shared.consequence,
        action=shared.action,
        latched=shared.severity is Severity.CRITICAL,
        ends=shared.ends,
    )


def overload(force_N: float, limit_N: float) -> Cause:
    """The joint force of one sample exceeds the overload limit."""
    return _cause(
        "overload", f"The joint force reached {force_N:.1f} N; the limit is {limit_N:g} N."
    )


def invalid_signal() -> Cause:
    """A sample of the load cell is not a number."""
    return _cause("invalid_signal", "The load cell sent a value that is not a number.")


def saturated(name: str, wired: str, device: str, range_text: str, *, critical: bool) -> Cause:
    """An input is at the end of its range. critical: it carries a force of the test under way."""
    return _cause(
        "saturated" if critical else "input_saturated",
        f"{name} ({wired} of {device}) is at the end of its range, {range_text}: its cable or plug,"
        " its range, or a signal beyond it.",
        key=saturated_key(name, critical=critical),
        name=name,
    )


def saturated_key(name: str, *, critical: bool) -> str:
    """Return the key of the alarm that an input is saturated."""
    return f"{'saturated' if critical else 'input_saturated'}:{name}"


def overspeed(speed_rpm: float, limit_rpm: float, by: str) -> Cause:
    """The crank turns faster than the limit."""
    return _cause(
        "overspeed", f"The {by} shows {speed_rpm:.1f} rpm; the limit is {limit_rpm:g} rpm."
    )


def stale_data(device: str, port: str, age_s: float) -> Cause:
    """No samples came for too long."""
    return _cause("stale_data", f"{device} on {port} has sent no samples for {age_s:.1f} s.")


def encoder_lost(drive_rpm: float) -> Cause:
    """The drive says that it turns, and the count does not move."""
    return _cause(
        "encoder_lost",
        f"The drive reports {drive_rpm:.1f} rpm, but the crank encoder does not move.",
    )


def senses_differ(encoder_back: bool, drive_back: bool, directions: tuple[int, int]) -> Cause:
    """Encoder or drive show the crank turning backwards in the first quarter turn of a test.

    directions: present values of encoder.direction and spindle.direction.
    """
    encoder, spindle = directions
    if encoder_back and drive_back:
        words = (
            "Encoder and drive show the crank turning backwards, though forwards was commanded: "
            "check the motor's leads, and A and B of the drive's encoder."
        )
    elif encoder_back:
        words = (
            "The encoder shows the crank turning backwards, while the drive turns forwards. If the "
            "crank turned counter-clockwise, exchange A and B of the crank encoder or set "
            f"encoder.direction = {-encoder} in the rig file; if it did not, set "
            f"spindle.direction = {-spindle}."
        )
    else:
        words = (
            "The drive reports that it turns backwards, while the encoder shows forwards: exchange "
            "A and B of the drive's own encoder."
        )
    return _cause("senses_differ", words)


def speeds_differ(encoder_rpm: float, drive_rpm: float) -> Cause:
    """Encoder and drive tell different speeds of the crank, steadily."""
    return _cause(
        "speeds_differ",
        f"The crank encoder shows {encoder_rpm:.1f} rpm, the drive {drive_rpm:.1f} rpm: "
        "spindle.gear_ratio, the drive's counts per revolution or encoder.counts_per_revolution "
        "is not what the rig has, or a belt or coupling slips.",
    )


def index_missed(revolutions: float) -> Cause:
    """The index did not come."""
    return _cause(
        "index_missed",
        f"The encoder counted {revolutions:.1f} revolutions without its index pulse.",
    )


def count_mismatch(revolution: int) -> Cause:
    """The count at the index is wrong."""
    return _cause(
        "count_mismatch",
        f"In revolution {revolution} the count at the index differs from a whole turn.",
    )


def lost_samples(device: str, samples: int) -> Cause:
    """Samples were lost."""
    return _cause(
        "lost_samples",
        f"{samples} samples of {device} were lost in all."
        if samples
        else f"Samples of {device} were lost; how many is not known.",
    )


def overrun(device: str, blocks: int) -> Cause:
    """The engine could not keep up, and data were dropped."""
    return _cause("overrun", f"The queue behind {device} was full; {blocks} blocks were dropped.")


def queue_age(device: str, age_s: float, limit_s: float) -> Cause:
    """Samples wait too long for the processing thread."""
    return _cause(
        "queue_age",
        f"Samples of {device} have waited {age_s:.1f} s to be looked at; the limit is "
        f"{limit_s:g} s.",
    )


def _input(device: str, port: str, words: str, named: str) -> str:
    return f"{device} on {port}: {words}" + (f" ({named})." if named else ".")


def sensor_broken(device: str, port: str, words: str, named: str) -> Cause:
    """The device says that a sensor of the load cell or its cable is broken."""
    kind = "input:broken"
    return _cause(kind, _input(device, port, words, named), key=f"{kind}:{named}")


def sensor_suspect(device: str, port: str, words: str, named: str, *, before: bool) -> Cause:
    """The device says that a sensor is broken: of a probe, while no test runs, or of before."""
    kind = "input:suspect"
    found = _cause(kind, _input(device, port, words, named), key=f"{kind}:{named}")
    if before:
        action = "Check that it is repaired, then reconnect."
        return replace(found, title=f"{found.title} before", action=action)
    return found


def input_fault(device: str, port: str, kind: str, words: str, named: str) -> Cause:
    """The device says that something is wrong at an input."""
    key = f"input:{kind}"
    told = _input(device, port, words, named)
    return _cause(key if key in KINDS else "input", told, key=f"{key}:{named}", name=kind)


def time_jump(seconds: float) -> Cause:
    """The device's clock and the host's have parted."""
    return _cause(
        "time_jump",
        f"The device's samples lag {seconds:.2f} s more behind this computer's clock than before.",
    )


def device_lost(device: str, port: str, sentence: str) -> Cause:
    """A device is gone."""
    key = f"device_lost:{device}"
    return _cause("device_lost", f"{device} on {port}: {sentence}", key=key, name=device)


def drive_fault(drive: str, faults: str) -> Cause:
    """The drive reports faults."""
    return _cause("drive_fault", f"{drive} reports: {faults}.")


def emergency_stop(drive: str) -> Cause:
    """The emergency stop is pressed."""
    return _cause("emergency_stop", f"{drive} reports that the emergency stop is pressed.")


def drive_silent(drive: str, port: str, sentence: str) -> Cause:
    """The drive does not answer."""
    return _cause("drive_silent", f"{drive} on {port}: {sentence}")


def slow_silent(device: str, port: str, age_s: float, sentence: str) -> Cause:
    """A device that tells slow channels does not answer. sentence: its last error, if any."""
    why = f" ({sentence.rstrip('.')})" if sentence else ""
    return _cause(
        "slow_silent",
        f"{device} on {port} has told nothing for {age_s:.0f} s{why}.",
        key=slow_key(device),
        name=device,
    )


def slow_key(device: str) -> str:
    """Return the key of the alarm that a slow device is silent."""
    return f"slow_silent:{device}"


def drive_warning(drive: str, warnings: str) -> Cause:
    """The drive warns."""
    return _cause("drive_warning", f"{drive} warns: {warnings}.")


def thread_dead(name: str, sentence: str) -> Cause:
    """A thread of the engine died or hangs."""
    return _cause("thread", f'The engine\'s part "{name}" failed: {sentence}', key=f"thread:{name}")


def storage_failed(sentence: str) -> Cause:
    """The file cannot be written."""
    return _cause("storage", sentence)


def file_moved(sentence: str) -> Cause:
    """The file was deleted, moved or replaced, and has been saved."""
    return _cause("file_moved", sentence)


def file_unsaved(sentence: str) -> Cause:
    """The file was deleted, moved or replaced, and could not be saved yet."""
    return _cause("file_unsaved", sentence)


def disk_slow(seconds: float) -> Cause:
    """The disk takes long over a commit."""
    return _cause("disk_slow", f"The disk takes {seconds:.1f} s or longer to make the data safe.")


def service_failed(sentence: str) -> Cause:
    """Windows cannot be served any more."""
    return _cause("service", sentence)


def will_not_stop(sentence: str) -> Cause:
    """The spindle could not be shown to stand."""
    return _cause("will_not_stop", sentence)


def start_failed(sentence: str) -> Cause:
    """The set speed was not reached."""
    return _cause("start_failed", sentence)


def speed_lost(speed_rpm: float, target_rpm: float) -> Cause:
    """The crank does not keep the set speed."""
    return _cause(
        "speed_lost", f"The crank turns at {speed_rpm:.1f} rpm; {target_rpm:g} rpm are set."
    )


def moved_in_pause(speed_rpm: float) -> Cause:
    """The crank moves while it should be held."""
    return _cause(
        "moved_in_pause", f"The crank turns at {speed_rpm:.1f} rpm while the test is paused."
    )


def device_overrun(device: str, sentence: str) -> Cause:
    """The device says that it dropped data."""
    return _cause("device_overrun", f"{device}: {sentence}")


def pause_failed(sentence: str) -> Cause:
    """The pause angle was not reached."""
    return _cause("pause_failed", sentence)


def cycles_refused(number: int) -> Cause:
    """Whole cycles had no room."""
    return _cause("cycles_refused", f"{number} whole cycles had no reserved room in the file.")


RULE_CONSEQUENCES = {
    "none": "Nothing was done.",
    "warn": "The test goes on.",
    "pause": "The test pauses at the safe angle.",
    "stop": "The test was stopped.",
    "drive_off": "The drive was switched off.",
}
"""What the action of a rule leads to."""


def rule(
    quantity: str, severity: Severity, value: float, limit: float, above: bool, action: str
) -> Cause:
    """A limit of the test is exceeded."""
    side = "above" if above else "below"
    return Cause(
        key=f"rule:{quantity}:{severity.value}:{side}",
        severity=severity,
        title=f"{quantity} {side} limit",
        cause=f"{quantity} is {value:.6g}, {side} the {severity.value} limit {limit:.6g}.",
        consequence=RULE_CONSEQUENCES[action],
        action="Look at the trend of this quantity; acknowledge, or change the limit with reason.",
        latched=severity is Severity.CRITICAL,
        ends=Ends.TEST,
    )


def criterion(met: Met) -> Cause:
    """A stop criterion of the test that guards the joint is met."""
    return _cause("stop", met.sentence, key=f"stop:{met.name}", name=CRITERIA[met.name].title)


def blind_key(name: str) -> str:
    """Return the key of the alarm that a criterion cannot be judged."""
    return f"blind:{name}"


def criterion_blind(name: str) -> Cause:
    """Nothing is known of a stop criterion."""
    return _cause(
        "blind",
        f"Nothing has been measured or predicted for stop.{name} in many revolutions.",
        key=blind_key(name),
        name=CRITERIA[name].title,
    )
