"""Node `sequence`: actions from a file and the pose in, the twist that performs them out."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Annotated, Any

from std_srvs.srv import SetBool, Trigger

from agv_motion.activity import Activity, Cause
from agv_motion.errors import AgvMotionError, ConfigurationError, SignalError
from agv_motion.nodes.driving import DrivingNode
from agv_motion.nodes.driving_parameters import DrivingParameters
from agv_motion.nodes.sequence_report import SequenceReport
from agv_motion.parameters import Spec
from agv_motion.ros.config import find_config
from agv_motion.ros.diagnosis import ERROR, OK, WARN, Diagnosis
from agv_motion.ros.run import run
from agv_motion.route.parameters import FollowParameters
from agv_motion.sequence.prediction import predict
from agv_motion.sequence.runner import SequenceRunner, SequenceState
from agv_motion.sequence.sequence_file import load_sequence
from agv_motion.trajectory.follower_parameters import FollowerParameters

if TYPE_CHECKING:
    from agv_motion.ros.port import Port
    from agv_motion.sequence.prediction import Predicted
    from agv_motion.twist_limits import TwistLimits


ACTIVITIES = {
    SequenceState.READY: (Activity.WAITING, Cause.NOTHING),
    SequenceState.RUNNING: (Activity.DRIVING, Cause.GOAL),
    SequenceState.PAUSED: (Activity.PAUSED, Cause.PERSON),
    SequenceState.STOPPING: (Activity.STOPPED, Cause.PERSON),
    SequenceState.BLIND: (Activity.STOPPED, Cause.POSE),
    SequenceState.DONE: (Activity.ARRIVED, Cause.GOAL),
    SequenceState.FAILED: (Activity.FAILED, Cause.MOTION),
    SequenceState.ABORTED: (Activity.STOPPED, Cause.PERSON),
}


@dataclass(frozen=True)
class SequenceParameters(DrivingParameters):
    """Which sequence, and how the robot follows Ghosts and routes."""

    rate: float = 50.0
    file: Annotated[
        str, Spec('the sequence: a path, or a file of config/; read at each start', dynamic=True)
    ] = ''
    autorun: Annotated[bool, Spec('start it as soon as the pose is known')] = False
    tracking: FollowerParameters = field(default_factory=FollowerParameters)
    follow: FollowParameters = field(default_factory=FollowParameters)

    def __post_init__(self) -> None:
        """Check every row, and hand the track of the platform on."""
        super().__post_init__()
        object.__setattr__(self, 'tracking', self.tracking.on_track(self.effective_track))


class SequenceNode(DrivingNode[SequenceParameters]):
    """`odom` -> `cmd_vel`, `sequence/status`, `sequence/progress`, `sequence/path`, `.../state`.

    Pause, abort, time-outs, failures, silence of the pose and every end are explicit zeros.
    """

    state_topic = 'sequence/state'
    release = 'start it again'

    name = 'sequence'
    takes = SequenceParameters

    def __init__(self, port: Port, parameters: SequenceParameters) -> None:
        """Open the topics; look at the file, if there is one."""
        super().__init__(port, parameters)
        self.runner: SequenceRunner | None = None
        """What is running, or has run"""
        self.predicted: list[Predicted] = []
        """What it was to take"""
        self.refusal = ''
        """Why it did not start by itself"""
        self._armed = parameters.autorun
        self._report = SequenceReport(port)
        port.serve(Trigger, '~/start', self._on_start)
        port.serve(SetBool, '~/pause', self._on_pause)
        port.serve(Trigger, '~/abort', self._on_abort)
        if parameters.file:
            load_sequence(find_config(parameters.file))
        elif self._armed:
            msg = 'autorun without a file: give the parameter file'
            raise ConfigurationError(msg)

    def begin(self) -> None:
        """Say that a start may come."""
        super().begin()
        self.tell('waiting for ~/start')

    def halt(self) -> None:
        """Forget the sequence, and send the last word: no motion."""
        self.runner = None
        super().halt()

    def limits(self) -> TwistLimits:
        """Return those of the robot, behind a Ghost or on a route."""
        return self.parameters.tracking.ghost

    def accept(self, parameters: SequenceParameters) -> None:
        """Look at another file; it counts from the next start on."""
        if parameters.file and parameters.file != self.parameters.file:
            load_sequence(find_config(parameters.file))

    def diagnose(self) -> Diagnosis:
        """Tell what it does, and why it failed."""
        failed = self.runner is not None and self.runner.status.state is SequenceState.FAILED
        blind = bool(self.lost) and self.runner is not None and not self.runner.ended
        failed = failed or bool(self.guard.reason)
        level = ERROR if failed else WARN if blind else OK
        return Diagnosis(level, self.told, self.activity_values())

    def activity(self) -> tuple[Activity, Cause]:
        """Return what the robot does, for programs, and what that goes back to."""
        runner = self.runner
        if runner is None:
            return Activity.WAITING, Cause.NOTHING
        if self.obstacle and not runner.ended:
            return self.hindered()
        return ACTIVITIES[runner.status.state]

    def cycle(self, dt: float) -> None:
        """Command one step of the sequence, or none."""
        if self._armed and not self.lost:
            self._armed = False
            self._start_by_itself()
        runner = self.runner
        if runner is None or runner.ended:
            self.leave(dt)
            return
        number = runner.status.number
        reason = runner.status.reason
        if self.guard.reason and not self.parameters.blocked.tries_again:
            runner.fail(self.guard.reason)
            self.guard.release()
        self.drive(runner.step(None if self.obstacle else self.pose_now(), dt))
        if runner.status.reason != reason:
            self.port.error(runner.status.reason)
        self.tell(self._words(runner))
        due = self._report.is_due(dt)
        if due or runner.ended or runner.status.number != number:
            failed = runner.status.state is SequenceState.FAILED
            level = ERROR if failed else OK
            self._report.publish(runner, level, self.told, self.share_done())
        if runner.ended:
            self.stand()
            self.port.info(self.told)

    def _start_by_itself(self) -> None:
        try:
            self.port.info(self._on_start(None))
        except AgvMotionError as error:
            self.refusal = self.port.message_of(error)
            self.port.error(f'cannot start: {self.refusal}')
            self.tell(f'cannot start: {self.refusal}')

    def share_done(self) -> float:
        """Return how much of the sequence is behind, in [0, 1], by the times predicted."""
        if self.runner is None or not self.predicted:
            return 0.0
        status = self.runner.status
        if status.state is SequenceState.DONE:
            return 1.0
        present = self.predicted[status.number]
        total = sum(each.duration for each in self.predicted)
        behind = present.begin + status.progress * present.duration
        return behind / total if total > 0.0 else 0.0

    def _words(self, runner: SequenceRunner) -> str:
        status, count = runner.status, len(runner.sequence.steps)
        where = f'{status.number + 1} of {count}: {runner.present.name}'
        if status.state is SequenceState.RUNNING:
            again = f', attempt {status.attempt}' if status.attempt > 1 else ''
            return f'{where}{again}'
        if status.state is SequenceState.BLIND:
            return f'{self.obstacle} ({where})'
        if status.state is SequenceState.FAILED:
            return f'failed: {status.reason}'
        return status.state.value if runner.ended else f'{status.state.value}, {where}'

    def _on_start(self, _: Any) -> str:
        if self.runner is not None and not self.runner.ended:
            msg = f'running already ({self.told}): call ~/abort first'
            raise SignalError(msg)
        given = self.parameters
        if not given.file:
            msg = 'no sequence: give the parameter file'
            raise ConfigurationError(msg)
        pose = self.require_pose()
        sequence = load_sequence(find_config(given.file))
        predicted = predict(sequence, pose, given.tracking.ghost, given.follow)
        self.runner = SequenceRunner(sequence, given.tracking, given.follow)
        self.predicted = predicted
        for warning in filter(None, (each.warning for each in predicted)):
            self.port.warning(warning)
        self._report.show(predicted, given.frame)
        total = sum(each.duration for each in predicted)
        return f'{sequence.name}: {len(sequence.steps)} actions, about {total:.0f} s'

    def _on_pause(self, request: Any) -> str:
        runner = self._running()
        if request.data:
            runner.pause()
            return 'easing to a halt; call again with data: false to go on'
        runner.resume()
        return 'going on'

    def _on_abort(self, _: Any) -> str:
        self._running().abort()
        return 'braking'

    def _running(self) -> SequenceRunner:
        if self.runner is None or self.runner.ended:
            msg = f'nothing is running: {self.told}'
            raise SignalError(msg)
        return self.runner


def main() -> None:
    """Run the node."""
    run(SequenceNode)


if __name__ == '__main__':
    main()
