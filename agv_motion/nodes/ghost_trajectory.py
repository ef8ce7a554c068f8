"""Node `ghost_trajectory`: a goal and the pose in, the twist that follows the Ghost there out."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Annotated, Any

from geometry_msgs.msg import PoseStamped, Vector3Stamped
from nav_msgs.msg import Path
from std_msgs.msg import String
from std_srvs.srv import SetBool, Trigger

from agv_motion.activity import Activity, Cause
from agv_motion.errors import SignalError
from agv_motion.nodes.driving import DrivingNode
from agv_motion.nodes.driving_parameters import DrivingParameters
from agv_motion.parameters import Spec
from agv_motion.ros.diagnosis import ERROR, OK, WARN, Diagnosis
from agv_motion.ros.messages import fill_path, fill_pose, pose_of
from agv_motion.ros.qos import COMMAND, LATCHED
from agv_motion.ros.run import run
from agv_motion.trajectory.follower import Follower
from agv_motion.trajectory.follower_parameters import FollowerParameters
from agv_motion.trajectory.follower_state import FollowerState
from agv_motion.trajectory.path_headings import are_places, stood_on, with_headings

if TYPE_CHECKING:
    from collections.abc import Callable

    from agv_motion.planar import Pose
    from agv_motion.ros.port import Port
    from agv_motion.trajectory.ghost import Ghost
    from agv_motion.trajectory.trajectory import Trajectory
    from agv_motion.twist_limits import TwistLimits


DRAWN = 0.05
"""[s] between two poses of the path that is shown."""

MOST_DRAWN = 500
"""Poses of that path: a longer trajectory is shown in longer steps."""

WORDS = {
    FollowerState.IDLE: 'waiting for a goal',
    FollowerState.LOCKED: 'locked: call ~/lock with data: false to go on',
    FollowerState.WAITING: 'the Ghost waits for the robot',
    FollowerState.SETTLING: 'settling',
    FollowerState.CORRECTING: 'correcting: driving to where the Ghost stands',
    FollowerState.ARRIVED: 'arrived',
    FollowerState.ABORTED: 'aborted',
}


ACTIVITIES = {
    FollowerState.IDLE: (Activity.WAITING, Cause.NOTHING),
    FollowerState.LOCKED: (Activity.PAUSED, Cause.PERSON),
    FollowerState.DRIVING: (Activity.DRIVING, Cause.GOAL),
    FollowerState.WAITING: (Activity.WAITING, Cause.MOTION),
    FollowerState.SETTLING: (Activity.DRIVING, Cause.GOAL),
    FollowerState.CORRECTING: (Activity.DRIVING, Cause.GOAL),
    FollowerState.ARRIVED: (Activity.ARRIVED, Cause.GOAL),
    FollowerState.ABORTED: (Activity.STOPPED, Cause.PERSON),
    FollowerState.LOST: (Activity.FAILED, Cause.MOTION),
    FollowerState.NOT_ARRIVED: (Activity.FAILED, Cause.MOTION),
}


@dataclass(frozen=True)
class GhostTrajectoryParameters(DrivingParameters):
    """How the Ghost goes to a goal, and how the robot follows it."""

    rate: float = 50.0
    cruising_speed: Annotated[float, Spec('of the Ghost', 'm/s', (0.001, 100.0), dynamic=True)] = (
        0.4
    )
    speed_ramps: Annotated[
        float,
        Spec(
            'acceleration and braking of the Ghost; 0: no ramp', 'm/s2', (0.0, 100.0), dynamic=True
        ),
    ] = 0.4
    delta_curve: Annotated[
        float,
        Spec(
            'handles of the curves as a share of the distance; 0: straight lines, turns on the '
            'spot', '1', (0.0, 5.0), dynamic=True,
        ),
    ] = 0.4  # fmt: skip
    backward: Annotated[bool, Spec('go to goals backwards', dynamic=True)] = False
    lock_goals: Annotated[
        bool, Spec('a new goal waits for ~/lock with false: read its report first', dynamic=True)
    ] = False
    follow: FollowerParameters = field(default_factory=FollowerParameters)

    def __post_init__(self) -> None:
        """Check every row, and hand the track of the platform on."""
        super().__post_init__()
        object.__setattr__(self, 'follow', self.follow.on_track(self.effective_track))


class GhostTrajectory(DrivingNode[GhostTrajectoryParameters]):
    """`goal_pose`, `path`, `arc`, `turn` and the pose -> `cmd_vel`, `ghost/pose`, `ghost/path`, ...

    Silence of the pose, a robot that is lost, `~/abort`, arrival and the end of the node are
    explicit zeros.
    """

    state_topic = 'ghost/state'
    release = 'call ~/lock with data: false, or send a goal'

    name = 'ghost_trajectory'
    takes = GhostTrajectoryParameters

    def __init__(self, port: Port, parameters: GhostTrajectoryParameters) -> None:
        """Open the topics."""
        super().__init__(port, parameters)
        self._follower = Follower(parameters.follow)
        self._ghost_pose = PoseStamped()
        self._ghost_pose.header.frame_id = parameters.frame
        self._pose_publisher = port.publisher(PoseStamped, 'ghost/pose', COMMAND)
        self._path = port.publisher(Path, 'ghost/path', LATCHED)
        self._report = port.publisher(String, 'ghost/report', LATCHED)
        port.listen(PoseStamped, 'goal_pose', self._on_goal, COMMAND)
        port.listen(Path, 'path', self._on_path, COMMAND)
        port.listen(Vector3Stamped, 'arc', self._on_arc, COMMAND)
        port.listen(Vector3Stamped, 'turn', self._on_turn, COMMAND)
        port.serve(SetBool, '~/lock', self._on_lock)
        port.serve(Trigger, '~/abort', self._on_abort)

    def begin(self) -> None:
        """Say that a goal may come."""
        super().begin()
        self._follower = Follower(self.parameters.follow)
        self.tell(WORDS[FollowerState.IDLE])

    def halt(self) -> None:
        """Forget the goal and send the last word: no motion."""
        self._follower.end_now()
        super().halt()

    def limits(self) -> TwistLimits:
        """Return those of the robot behind the Ghost."""
        return self.parameters.follow.ghost

    def accept(self, parameters: GhostTrajectoryParameters) -> None:
        """Take over other gains at once; speeds and ramps count from the next goal on."""
        self._follower.retune(parameters.follow)

    def diagnose(self) -> Diagnosis:
        """Tell what the robot does, and how far it is from its Ghost."""
        follower = self._follower
        along, across, heading = follower.error
        values = {
            'along [m]': f'{along:.4f}', 'across [m]': f'{across:.4f}',
            'heading [rad]': f'{heading:.4f}',
            'Ghost': f'{follower.ghost.time:.1f} s of {follower.ghost.trajectory.duration:.1f} s',
            'locked': str(follower.ghost.locked), 'rotating': str(follower.ghost.rotating),
            'backward': str(follower.ghost.backward), 'finished': str(follower.ghost.finished),
        } | self.activity_values()  # fmt: skip
        if follower.failure or self.guard.reason:
            return Diagnosis(ERROR, self.told, values)
        blind = bool(self.lost) and not follower.at_rest
        waits = follower.state is FollowerState.WAITING
        return Diagnosis(WARN if blind or waits else OK, self.told, values)

    def activity(self) -> tuple[Activity, Cause]:
        """Return what the robot does, for programs, and what that goes back to."""
        follower = self._follower
        if self.obstacle and not follower.at_rest:
            return self.hindered()
        if follower.state is FollowerState.DRIVING and follower.ghost.rotating:
            return Activity.TURNING, Cause.GOAL
        return ACTIVITIES[follower.state]

    def cycle(self, dt: float) -> None:
        """Command the robot to stay with its Ghost, or not at all."""
        follower, pose = self._follower, self.pose_now()
        if follower.at_rest:
            self.leave(dt)
        elif pose is None or self.obstacle:
            follower.freeze()
            self.stand()
            if not follower.at_rest:
                self.tell(self.obstacle)
                return
        else:
            self.drive(follower.step(pose, dt))
            self._show_ghost()
        self.tell(self._words())

    def _words(self) -> str:
        follower = self._follower
        if follower.failure:
            return f'{follower.state.value}: {follower.failure}'
        if follower.state is FollowerState.DRIVING:
            ghost = follower.ghost
            return 'turning' if ghost.rotating else 'backing' if ghost.backward else 'driving'
        return WORDS[follower.state]

    def _show_ghost(self) -> None:
        self.port.stamp(self._ghost_pose)
        fill_pose(self._ghost_pose.pose, self._follower.leader.pose)
        self._pose_publisher.publish(self._ghost_pose)

    # Goals

    def _on_goal(self, message: PoseStamped) -> None:
        self.require_frame(message.header.frame_id)
        self._go([pose_of(message.pose)], self.parameters.delta_curve)

    def _on_path(self, message: Path) -> None:
        """Drive through the poses of a path; along it where they are but places."""
        self._follower.ghost.require_count(len(message.poses))
        self.require_frame_of_all(message)
        poses = [pose_of(stamped.pose) for stamped in message.poses]
        if are_places(poses):
            given, here = self.parameters, self.require_pose()
            poses = with_headings(here, poses, given.follow.tolerance, backward=given.backward)
            if len(poses) == 1:  # one place is no curve: straight there, turning on the spot first
                self._go(poses, 0.0)
                return
        self._go(poses, self.parameters.delta_curve)

    def _go(self, goals: list[Pose], curve: float) -> None:
        given = self.parameters
        if len(goals) == 1 and self._follower.at_rest:
            goals = [stood_on(self.require_pose(), goals[0], given.follow.tolerance)]
        shape = curve, given.speed_ramps, given.cruising_speed
        self._depart(lambda ghost: ghost.compute_path(goals, *shape, backward=given.backward))

    def _on_arc(self, message: Vector3Stamped) -> None:
        """Drive an arc: x is its angle [rad], y its inner diameter [m], z the speed [m/s]."""
        angle, diameter, speed = message.vector.x, message.vector.y, message.vector.z
        ramps = self.parameters.speed_ramps
        self._depart(lambda ghost: ghost.compute_arc(angle, diameter, ramps, speed))

    def _on_turn(self, message: Vector3Stamped) -> None:
        """Turn on the spot: x is the angle [rad], y the ramps [rad/s2], z the rate [rad/s]."""
        angle, ramps, rate = message.vector.x, message.vector.y, message.vector.z
        self._depart(lambda ghost: ghost.compute_turn(angle, ramps, rate))

    def _depart(self, plan: Callable[[Ghost], Trajectory]) -> None:
        follower, pose = self._follower, self.require_pose()
        if self.guard.reason:
            self.guard.release()
            follower.end_now()  # it leaves from where it is, not from where its Ghost waits
        if self.parameters.lock_goals:
            follower.ease_to_halt()
        trajectory = follower.depart(pose, plan)
        lines = follower.ghost.report().lines()
        self._report.publish(String(data='\n'.join(lines)))
        self.port.info('; '.join(lines))
        self._show_path(trajectory)
        self.tell(self._words())

    def _show_path(self, trajectory: Trajectory) -> None:
        message = Path()
        self.port.stamp(message)
        message.header.frame_id = self.parameters.frame
        fill_path(message, trajectory.polyline(DRAWN, MOST_DRAWN))
        self._path.publish(message)

    # Services

    def _on_lock(self, request: Any) -> str:
        if request.data:
            self._follower.ease_to_halt()
            return 'the Ghost comes to a halt'
        self._follower.go_on()
        self.guard.release()
        return 'the Ghost is free to go'

    def _on_abort(self, _: Any) -> str:
        if self._follower.at_rest:
            msg = f'nothing to abort: {self.told}'
            raise SignalError(msg)
        self._follower.brake_and_end()
        return 'braking'


def main() -> None:
    """Run the node."""
    run(GhostTrajectory)


if __name__ == '__main__':
    main()
