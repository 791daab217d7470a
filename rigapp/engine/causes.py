"""The alarms that the engine can raise: cause, consequence and action in an operator's words."""

from __future__ import annotations

from dataclasses import dataclass

from rigapp.engine.criteria import TITLES, Met
from rigapp.engine.messages import Severity


@dataclass(frozen=True, slots=True)
class Cause:
    """Describe an alarm. latched: it stays on the list until it is reset."""

    key: str
    severity: Severity
    title: str
    cause: str
    consequence: str
    action: str
    latched: bool = False


def _critical(key: str, title: str, cause: str, consequence: str, action: str) -> Cause:
    return Cause(key, Severity.CRITICAL, title, cause, consequence, action, latched=True)


def _warning(key: str, title: str, cause: str, consequence: str, action: str) -> Cause:
    return Cause(key, Severity.WARNING, title, cause, consequence, action)


def overload(force_N: float, limit_N: float) -> Cause:
    """The joint force of one sample exceeds the overload limit."""
    return _critical(
        "overload",
        "Overload",
        f"The joint force reached {force_N:.1f} N; the limit is {limit_N:g} N.",
        "The drive was switched off to protect the load cell.",
        "Look at joint, spring and guide; check the zero; then reset and start again.",
    )


def invalid_signal() -> Cause:
    """A sample of the load cell is not a number."""
    return _critical(
        "invalid_signal",
        "Load cell signal invalid",
        "The load cell sent a value that is not a number.",
        "The force is not known, so the drive was switched off.",
        "Check the load cell's cable and the amplifier's input; then reset.",
    )


def overspeed(speed_rpm: float, limit_rpm: float, by: str) -> Cause:
    """The crank turns faster than the limit."""
    return _critical(
        "overspeed",
        "Overspeed",
        f"The {by} shows {speed_rpm:.1f} rpm; the limit is {limit_rpm:g} rpm.",
        "The drive was switched off.",
        "Check the drive's tuning and its encoder; then reset and start again.",
    )


def stale_data(device: str, port: str, age_s: float) -> Cause:
    """No samples came for too long."""
    return _critical(
        "stale_data",
        "No data",
        f"{device} on {port} has sent no samples for {age_s:.1f} s.",
        "Force and angle are unknown, so the drive was switched off.",
        "Check the cable and the power of the device; then reconnect.",
    )


def encoder_lost(drive_rpm: float) -> Cause:
    """The drive says that it turns, and the count does not move."""
    return _critical(
        "encoder_lost",
        "Encoder lost",
        f"The drive reports {drive_rpm:.1f} rpm, but the crank encoder does not move.",
        "The crank angle is unknown, so the drive was switched off.",
        "Check the encoder's cable, its supply and its coupling; then reset.",
    )


def index_missed(revolutions: float) -> Cause:
    """The index did not come."""
    return _critical(
        "index_missed",
        "Encoder index missing",
        f"The encoder counted {revolutions:.1f} revolutions without its index pulse.",
        "Revolutions cannot be cut at the index, so the test was stopped.",
        "Check the index line of the encoder and restarts_at_index in the rig file.",
    )


def count_mismatch(revolution: int) -> Cause:
    """The count at the index is wrong."""
    return _warning(
        "count_mismatch",
        "Encoder counts lost",
        f"In revolution {revolution} the count at the index differs from a whole turn.",
        "Angles of that revolution are uncertain; its row is flagged.",
        "If it comes again, check the encoder's cable, shield and supply.",
    )


def lost_samples(device: str, samples: int) -> Cause:
    """Samples were lost."""
    return _warning(
        "lost_samples",
        "Samples lost",
        f"{samples} samples of {device} were lost in all."
        if samples
        else f"Samples of {device} were lost; how many is not known.",
        "The revolutions concerned are flagged; nothing is interpolated.",
        "Close other programs, check the USB cable, or lower the sample rate.",
    )


def overrun(device: str, blocks: int) -> Cause:
    """The engine could not keep up, and data were dropped."""
    return _warning(
        "overrun",
        "Engine too slow",
        f"The queue behind {device} was full; {blocks} blocks were dropped.",
        "The revolutions concerned are flagged as gaps.",
        "Close other programs or lower the sample rate.",
    )


def queue_age(device: str, age_s: float, limit_s: float) -> Cause:
    """Samples wait too long for the processing thread."""
    return _critical(
        "queue_age",
        "Engine lags behind",
        f"Samples of {device} have waited {age_s:.1f} s to be looked at; the limit is "
        f"{limit_s:g} s.",
        "An overload would be seen too late, so the drive was switched off.",
        "Close other programs, lower the sample rate, or take a faster computer; then reset.",
    )


def sensor_broken(device: str, port: str, words: str, named: str) -> Cause:
    """The device says that a sensor of the load cell or its cable is broken."""
    return _critical(
        f"input:broken:{named}",
        "Load cell broken",
        f"{device} on {port}: {words}" + (f" ({named})." if named else "."),
        "The force is not known, an overload would not be seen: the test was ended and the "
        "spindle stopped. The samples since then are flagged.",
        "Check the bridge's wires, plug and cell; then reconnect and reset.",
    )


def sensor_suspect(device: str, port: str, words: str, named: str, *, before: bool) -> Cause:
    """The device says that a sensor is broken: of a probe, while no test runs, or of before."""
    return _warning(
        f"input:suspect:{named}",
        "Sensor broken before" if before else "Sensor broken",
        f"{device} on {port}: {words}" + (f" ({named})." if named else "."),
        "Every sample is flagged until the devices are connected again.",
        "Check that it is repaired, then reconnect."
        if before
        else "Check the sensor's wires and plug, then reconnect.",
    )


def input_fault(device: str, port: str, kind: str, words: str, named: str) -> Cause:
    """The device says that something is wrong at an input."""
    return _warning(
        f"input:{kind}:{named}",
        f"Input {kind}",
        f"{device} on {port}: {words}" + (f" ({named})." if named else "."),
        "What this input shows may be wrong.",
        "Look at the signal, its sensor, its range and its cable.",
    )


def time_jump(seconds: float) -> Cause:
    """The device's clock and the host's have parted."""
    return _warning(
        "time_jump",
        "Clocks parted",
        f"The device's samples lag {seconds:.2f} s more behind this computer's clock than before.",
        "Samples may have been lost unseen; the revolution is flagged.",
        "Check for suspend mode and load of this computer.",
    )


def device_lost(device: str, port: str, sentence: str) -> Cause:
    """A device is gone."""
    return _critical(
        f"device_lost:{device}",
        f"{device} lost",
        f"{device} on {port}: {sentence}",
        "The test was ended and the spindle stopped.",
        "Check cable and power, then reconnect.",
    )


def drive_fault(drive: str, faults: str) -> Cause:
    """The drive reports faults."""
    return _critical(
        "drive_fault",
        "Drive fault",
        f"{drive} reports: {faults}.",
        "The test was ended; the drive has taken or lost its power.",
        "Remove the cause as the drive's manual says, then reset.",
    )


def emergency_stop(drive: str) -> Cause:
    """The emergency stop is pressed."""
    return _critical(
        "emergency_stop",
        "Emergency stop",
        f"{drive} reports that the emergency stop is pressed.",
        "The motor has no power; the test was ended.",
        "Make the rig safe, release the button, then reset. Nothing restarts by itself.",
    )


def drive_silent(drive: str, port: str, sentence: str) -> Cause:
    """The drive does not answer."""
    return _critical(
        "drive_silent",
        "Drive does not answer",
        f"{drive} on {port}: {sentence}",
        "Its own watchdog stops the motor.",
        "Check cable and power of the drive, then reconnect.",
    )


def drive_warning(drive: str, warnings: str) -> Cause:
    """The drive warns."""
    return _warning(
        "drive_warning",
        "Drive warning",
        f"{drive} warns: {warnings}.",
        "The drive may switch off by itself soon.",
        "Look at supply, temperature and load of the drive.",
    )


def thread_dead(name: str, sentence: str) -> Cause:
    """A thread of the engine died or hangs."""
    return _critical(
        f"thread:{name}",
        "Internal failure",
        f'The engine\'s part "{name}" failed: {sentence}',
        "The test was ended and the spindle stopped; the data so far are safe.",
        "Save the log and report it; reconnect before the next test.",
    )


def storage_failed(sentence: str) -> Cause:
    """The file cannot be written."""
    return _critical(
        "storage",
        "File cannot be written",
        sentence,
        "The test was ended; the committed revolutions are safe.",
        "Check the disk; start again with another file.",
    )


def disk_slow(seconds: float) -> Cause:
    """The disk takes long over a commit."""
    return _warning(
        "disk_slow",
        "Disk slow",
        f"The disk takes {seconds:.1f} s or longer to make the data safe.",
        "The test goes on, its data wait in memory; after 20 s it would be stopped.",
        "Stop other programs that write to this disk; look at its health and its network.",
    )


def service_failed(sentence: str) -> Cause:
    """Windows cannot be served any more."""
    return _warning(
        "service",
        "Windows cannot be served",
        sentence,
        "The test goes on and is recorded; windows may show nothing and cannot command it.",
        "Stop the test where it was started (Ctrl-C), or by the emergency stop.",
    )


def will_not_stop(sentence: str) -> Cause:
    """The spindle could not be shown to stand."""
    return _critical(
        "will_not_stop",
        "Spindle not shown to stand",
        sentence,
        "THE SPINDLE MAY STILL TURN.",
        "Press the emergency stop. Do not touch the rig before the crank stands.",
    )


def start_failed(sentence: str) -> Cause:
    """The set speed was not reached."""
    return _critical(
        "start_failed",
        "Set speed not reached",
        sentence,
        "The test was stopped.",
        "Check the mechanism for stiffness, the drive's current limit and its tuning.",
    )


def speed_lost(speed_rpm: float, target_rpm: float) -> Cause:
    """The crank does not keep the set speed."""
    return _critical(
        "speed_lost",
        "Set speed lost",
        f"The crank turns at {speed_rpm:.1f} rpm; {target_rpm:g} rpm are set.",
        "The test was stopped.",
        "Check the mechanism for stiffness, the coupling, and whether the drive has switched off.",
    )


def moved_in_pause(speed_rpm: float) -> Cause:
    """The crank moves while it should be held."""
    return _critical(
        "moved_in_pause",
        "Crank moves in the pause",
        f"The crank turns at {speed_rpm:.1f} rpm while the test is paused.",
        "The drive was switched off and the test ended.",
        "Keep clear of the crank; check the drive's holding torque and the spring.",
    )


def device_overrun(device: str, sentence: str) -> Cause:
    """The device says that it dropped data."""
    return _warning(
        "device_overrun",
        "Device dropped data",
        f"{device}: {sentence}",
        "The revolutions concerned are flagged.",
        "Close other programs, check the USB cable, or lower the sample rate.",
    )


def pause_failed(sentence: str) -> Cause:
    """The pause angle was not reached."""
    return _critical(
        "pause_failed",
        "Pause not reached",
        sentence,
        "The test was stopped.",
        "Check the drive's tuning at low speed.",
    )


def cycles_refused(number: int) -> Cause:
    """Whole cycles had no room."""
    return _warning(
        "cycles_refused",
        "Whole cycles not kept",
        f"{number} whole cycles had no reserved room in the file.",
        "Their statistics are kept, their samples are not.",
        "Plan fewer whole cycles, or a new test.",
    )


def rule(
    quantity: str, severity: Severity, value: float, limit: float, above: bool, action: str
) -> Cause:
    """A limit of the test is exceeded."""
    side = "above" if above else "below"
    consequences = {
        "none": "Nothing was done.",
        "warn": "The test goes on.",
        "pause": "The test pauses at the safe angle.",
        "stop": "The test was stopped.",
        "drive_off": "The drive was switched off.",
    }
    return Cause(
        key=f"rule:{quantity}:{severity.value}:{side}",
        severity=severity,
        title=f"{quantity} {side} limit",
        cause=f"{quantity} is {value:.6g}, {side} the {severity.value} limit {limit:.6g}.",
        consequence=consequences[action],
        action="Look at the trend of this quantity; acknowledge, or change the limit with reason.",
        latched=severity is Severity.CRITICAL,
    )


def criterion(met: Met) -> Cause:
    """A stop criterion of the test that guards the joint is met."""
    return _critical(
        f"stop:{met.name}",
        f"Stop criterion: {TITLES[met.name]}",
        met.sentence,
        "The test was stopped, as its test file says.",
        "Look at the trend and the joint; go on with the test in its file, or end it here.",
    )


def blind_key(name: str) -> str:
    """Return the key of the alarm that a criterion cannot be judged."""
    return f"blind:{name}"


def criterion_blind(name: str) -> Cause:
    """Nothing is known of a stop criterion."""
    return _warning(
        blind_key(name),
        f"Stop criterion not judged: {TITLES[name]}",
        f"Nothing has been measured or predicted for stop.{name} in many revolutions.",
        "The test goes on without this criterion.",
        "Check the probes, or the prediction's process, or stop the test.",
    )
