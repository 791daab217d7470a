"""Motion of the crank during a test: steps, pauses, rests, stops."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager

from rigapp.config.sequence import StepPlace
from rigapp.engine.activetest import ActiveTest, Rest
from rigapp.engine.connectedrig import ConnectedRig
from rigapp.engine.core import Core
from rigapp.engine.drive.driving import Ramp
from rigapp.engine.drive.sequences import DriveStep
from rigapp.schema.alarms import make_alarm
from rigapp.schema.messages import FinishReason, RunState
from rigapp.schema.states import ACTIVE, Ending, Trigger, transition
from rigapp.texts import say, sentence_of_error
from rigapp_drivers.api import DeviceError


class CrankMotion:
    """Motion of the crank of a connected rig for the active test."""

    def __init__(self, core: Core, rig: ConnectedRig) -> None:
        self._core = core
        self._rig = rig
        self._control = rig.control

    def begin_test(self) -> None:
        """Assign the revolutions from the next index on to the test."""
        self._rig.processor.begin_test()

    def pause(self, reason: str) -> bool:
        """Start a pause at the safe angle if the state allows it; return whether it does.

        A rest between two steps becomes a pause: the test resumes on the operator's command.
        """
        core, test = self._core, self._core.test
        if test is None:
            return False
        if test.resting is not None:
            test.resting = None
            core.republish(say("the rest has become a pause: {}", reason))
            return True
        if not core.fire_if(Trigger.PAUSE, reason):
            return False
        self._control.pause_at(test.document.record.run.pause_angle_deg)
        return True

    def start_step(self, stage: StepPlace) -> None:
        """Start the next step of the test: the rest before it, or a ramp to its speed.

        In an operator's pause the speed applies after the resume, and the pause is the rest.
        """
        core, test = self._core, self._core.test
        if test is None:
            return
        ended, test.stage = test.stage, stage
        test.changes += 1
        words = say("{}: {:g} rpm to revolution {}", stage.words, stage.speed_rpm, stage.last)
        if test.logs_steps:
            if core.state is RunState.STARTING:
                text = say(
                    "{} ended before the spindle reached {:g} rpm", ended.words, ended.speed_rpm
                )
                core.event("step", "engine", text, level="warning")
            core.event("step", "engine", words, before=ended.words, after=stage.words)
        if ended.rest_s and test.resting is not None:
            test.resting.duration_s += ended.rest_s  # the step ended while the crank slowed down
            test.resting.step = ended.step
        elif ended.rest_s and self.pause(
            say("{} is done: a rest of {:g} s", ended.words, ended.rest_s)
        ):
            test.resting = Rest(ended.rest_s, ended.step)
        elif stage.speed_rpm != ended.speed_rpm:
            highest = max(stage.speed_rpm, ended.speed_rpm)
            test.deadline_s = self._rig.ramp_deadline_s(highest, test.ramp_rpm_per_s)
            if core.fire_if(Trigger.STEP, words):
                self._control.change(Ramp(test.target_rpm, test.ramp_rpm_per_s))

    def resume(self, test: ActiveTest) -> None:
        """Resume after a pause with the speed of the step; raise Refused, DeviceError.

        A DeviceError of the drive ends the test.
        """
        transition(self._core.state, Trigger.RESUME)
        test.resting = None
        test.deadline_s = self._rig.ramp_deadline_s(test.target_rpm, test.ramp_rpm_per_s)
        self._core.fire(Trigger.RESUME)
        with self.turning():
            self._control.resume(Ramp(test.target_rpm, test.ramp_rpm_per_s))

    @contextmanager
    def turning(self) -> Iterator[None]:
        """End the test on a DeviceError of the drive inside the block, and raise it."""
        try:
            yield
        except DeviceError as error:
            self._core.trip(Ending(FinishReason.DEVICE, sentence_of_error(error)))
            raise

    def follow(self, do: DriveStep) -> None:
        """Act on the result of one step of a pause or a stop sequence."""
        core, control = self._core, self._control
        stop = control.stopping
        if stop is None:
            if do is DriveStep.STANDING:
                angle = self._rig.processor.motion.angle_deg(time.monotonic())
                where = (
                    say("at {:.1f} deg", angle) if angle is not None else say("at an unknown angle")
                )
                core.fire_if(Trigger.STANDING, say("paused {}", where))
            elif do is DriveStep.GIVE_UP:
                core.act_on(make_alarm("pause_failed"))
            return
        if do is DriveStep.STANDING:
            if stop.unseen:
                core.stop_unseen(self._rig.spindle.name)
            core.reached_standstill(stop.witnesses, stop.how)
        elif do is DriveStep.POWER_OFF and stop.by_itself and core.state not in ACTIVE:
            self._turns_by_itself()
        elif do is DriveStep.NO_EFFECT:
            core.stop_without_effect(self._rig.spindle.name)
        elif do is DriveStep.GIVE_UP:
            core.will_not_stop(
                say(
                    (
                        "The stop was commanded and the power switched off, but the standstill"
                        " is not confirmed (cause of the stop: {})."
                    ),
                    stop.witnesses,
                )
            )

    def _turns_by_itself(self) -> None:
        """Raise an alarm if the crank turns without a command; without power it turns by hand."""
        status, rpm = self._control.status, self._rig.processor.motion.speed_rpm()
        if status is not None and status.enabled:
            drive = self._rig.spindle.name
            self._core.act_on(make_alarm("turns_by_itself", drive=drive, speed_rpm=rpm))
