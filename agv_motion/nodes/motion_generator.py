"""Node `motion_generator`: sap flow and pose in, the twist of the tree out."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, Any

from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, TwistStamped, Vector3Stamped
from geometry_msgs.msg import Twist as TwistMessage
from nav_msgs.msg import Path
from std_msgs.msg import Bool, String
from std_srvs.srv import SetBool

from agv_motion.errors import ConfigurationError, GeometryError
from agv_motion.motion import generator
from agv_motion.motion.generator import RestParameters, SapFlow, checked_sap_flow
from agv_motion.motion.paths import Paths, next_waypoint
from agv_motion.motion.polar import LINEAR_SPEED, PLATFORM_RADIUS, to_twist
from agv_motion.motion.watchdog import Silence, Watchdog
from agv_motion.motion.zone_file import load_zone
from agv_motion.parameters import Spec, check
from agv_motion.planar import REST, Pose, Twist
from agv_motion.ros.config import find_config
from agv_motion.ros.messages import fill_pose, fill_twist, pose_of
from agv_motion.ros.node import OK, WARN, Diagnosis, ManagedNode
from agv_motion.ros.qos import COMMAND, LATCHED, SENSOR
from agv_motion.ros.run import run

WAYPOINT_REACHED = 0.3
"""[m] A corner of the way counts as reached from here: twice the noise of a position fix."""


@dataclass(frozen=True)
class MotionGeneratorParameters:
    """How sap flow becomes motion."""

    rate: Annotated[float, Spec('commands per second', 'Hz', (0.1, 1000.0))] = 10.0
    linear_speed: Annotated[
        float, Spec("the trunk's speed at full sap flow", 'm/s', (1e-4, 10.0))
    ] = LINEAR_SPEED
    platform_radius: Annotated[
        float, Spec('centre to turret: its rim has the same top speed', 'm', (0.01, 100.0))
    ] = PLATFORM_RADIUS
    goal: Annotated[
        tuple[float, ...], Spec('where to go, x and y in the map; RViz may set another', 'm')
    ] = (10.0, 7.5)
    report_after: Annotated[
        float, Spec('silence of sap flow or pose to report', 's', (0.01, 3600))
    ] = 3.0
    stop_after: Annotated[float, Spec('silence of sap flow or pose to stop', 's', (0.01, 3600))] = (
        5.0
    )
    map_frame: Annotated[str, Spec('frame of pose and goal')] = 'map'
    base_frame: Annotated[str, Spec('frame of the twist')] = 'base_link'
    stamped: Annotated[bool, Spec('cmd_vel is TwistStamped (else Twist)')] = True
    zone_file: Annotated[
        str, Spec('zone that is never left: a path, or a file of config/; empty: anywhere')
    ] = ''
    rest: RestParameters = field(default_factory=RestParameters)

    def __post_init__(self) -> None:
        """Check every row, and that the goal is a point."""
        check(self)
        if len(self.goal) != 2:
            msg = f'goal = {list(self.goal)}: give x and y in metres'
            raise ConfigurationError(msg)


class MotionGenerator(ManagedNode[MotionGeneratorParameters]):
    """`granier/sap_flow`, `granier/valid` and `pose` -> `cmd_vel`, `goal` and `state`.

    Without a fresh and valid sap flow, or without a pose, the command is an explicit zero.
    """

    def __init__(self, **kwargs: Any) -> None:
        """Declare the parameters."""
        super().__init__('motion_generator', MotionGeneratorParameters, **kwargs)

    def open(self) -> None:
        """Build the generator and open the topics."""
        given = self.parameters
        self._generator = generator.MotionGenerator(given.rest)
        self._sap_flow: SapFlow | None = None
        self._pose: Pose | None = None
        self._zone = load_zone(find_config(given.zone_file)) if given.zone_file else None
        self._paths = None if self._zone is None else Paths(self._zone)
        self._goal = self._reachable(given.goal[0], given.goal[1])
        self._waypoint: tuple[float, float] | None = None
        self._no_way = ''
        self._valid = True
        self._paused = False
        self._told = ''
        self._told_way: list[tuple[float, float]] = []
        self._lost = 'sap flow'
        self._obstacle = 'resting: no input'
        self._watchdogs = {
            name: Watchdog(given.report_after, given.stop_after) for name in ('sap flow', 'pose')
        }
        kind = TwistStamped if given.stamped else TwistMessage
        self._message = kind()
        if given.stamped:
            self._message.header.frame_id = given.base_frame
        self._command = self.publisher(kind, 'cmd_vel', COMMAND)
        self._way = self.publisher(Path, 'way', LATCHED)
        self._goal_publisher = self.publisher(PoseStamped, 'goal', LATCHED)
        self._state = self.publisher(String, 'state', LATCHED)
        self.listen(Vector3Stamped, 'granier/sap_flow', self._on_sap_flow, SENSOR)
        self.listen(Bool, 'granier/valid', self._on_valid, LATCHED)
        self.listen(PoseWithCovarianceStamped, 'pose', self._on_pose, SENSOR)
        self.listen(PoseStamped, 'goal_pose', self._on_goal, COMMAND)
        self.serve(SetBool, '~/pause', self._on_pause)
        self.every(1.0 / given.rate, self._tick)
        self.every(1.0, self._plan)

    def begin(self) -> None:
        """Tell where the tree means to go."""
        self._publish_goal()

    def halt(self) -> None:
        """Send the last word: no motion."""
        self._publish(REST, 'stopped')

    def accept(self, parameters: MotionGeneratorParameters) -> None:
        """Take over new thresholds."""
        self._generator.parameters = parameters.rest

    def diagnose(self) -> Diagnosis:
        """Tell what the tree does, and what it misses."""
        return Diagnosis(WARN if self._lost else OK, self._told, {})

    def _on_sap_flow(self, message: Vector3Stamped) -> None:
        vector = message.vector
        self._sap_flow = checked_sap_flow(SapFlow(vector.x, vector.y, vector.z))
        self._watchdogs['sap flow'].feed()
        if self._obstacle:
            self._judge()
        self._move()

    def _on_valid(self, message: Bool) -> None:
        self._valid = message.data
        if not self._valid:
            self._judge()
            self._move()

    def _on_pose(self, message: PoseWithCovarianceStamped) -> None:
        self._require_map(message.header.frame_id)
        self._pose = pose_of(message.pose.pose)
        self._watchdogs['pose'].feed()
        self._judge()

    def _on_goal(self, message: PoseStamped) -> None:
        self._require_map(message.header.frame_id)
        goal = pose_of(message.pose)
        self._goal = self._reachable(goal.x, goal.y)
        self._plan()
        self.get_logger().info(f'new goal ({goal.x:.2f}, {goal.y:.2f})')
        self._publish_goal()

    def _plan(self) -> None:
        """Find the way to the goal from where the tree is now."""
        self._waypoint, self._no_way = None, ''
        if self._paths is None or self._pose is None:
            return
        try:
            way = self._paths.way((self._pose.x, self._pose.y), self._goal)
        except GeometryError as error:
            self._no_way = str(error)
            return
        self._waypoint = next_waypoint(way, WAYPOINT_REACHED)
        if way[1:] != self._told_way[1:]:
            self._told_way = way
            self._publish_way(way)

    def _publish_way(self, way: list[tuple[float, float]]) -> None:
        message = Path()
        message.header.frame_id = self.parameters.map_frame
        self.stamp(message)
        for x, y in way:
            corner = PoseStamped(header=message.header)
            fill_pose(corner.pose, Pose(x, y, 0.0))
            message.poses.append(corner)
        self._way.publish(message)

    def _reachable(self, x: float, y: float) -> tuple[float, float]:
        if self._zone is not None and not self._zone.walkable(x, y):
            msg = f'goal ({x:.2f}, {y:.2f}) {self._zone.why_not(x, y)}: choose another'
            raise ConfigurationError(msg)
        return x, y

    def _require_map(self, frame: str) -> None:
        if frame not in {'', self.parameters.map_frame}:
            msg = f"frame '{frame}': expected '{self.parameters.map_frame}'; transform it first"
            raise ConfigurationError(msg)

    def _on_pause(self, request: Any) -> str:
        self._paused = request.data
        self._judge()
        self._move()
        return 'paused' if self._paused else 'going on'

    def _tick(self) -> None:
        """Judge the silence of both inputs and keep the command alive."""
        now = self.seconds()
        self._lost = ''
        for name, watchdog in self._watchdogs.items():
            silence = watchdog.judge(now)
            if silence is not Silence.FRESH and watchdog.age(now) is not None:
                self.get_logger().warning(
                    f'no {name} for {watchdog.age(now):.1f} s: '
                    + ('stopping' if silence is Silence.LOST else 'still moving'),
                    throttle_duration_sec=5.0,
                )
            if silence is Silence.LOST:
                self._lost = self._lost or name
        self._judge()
        self._move()

    def _judge(self) -> None:
        """Find out whether the tree may move; again whenever what it knows has changed."""
        self._obstacle = self._find_obstacle()

    def _find_obstacle(self) -> str:
        """Return why the tree must not move now, in words; empty if it may."""
        if self._paused:
            return 'paused'
        if not self._valid:
            return 'resting: a probe cannot be believed'
        if self._lost or self._sap_flow is None or self._pose is None:
            return f'resting: no {self._lost or "input"}'
        if self._zone is not None and not self._zone.contains(self._pose.x, self._pose.y):
            return f'stopped: the tree {self._zone.why_not(self._pose.x, self._pose.y)}'
        if self._paths is not None and self._waypoint is None:
            self._plan()
        return f'stopped: {self._no_way}' if self._no_way else ''

    def _move(self) -> None:
        """Command what the sap flow asks for, or an explicit zero."""
        if self._obstacle or self._sap_flow is None or self._pose is None:
            self._publish(REST, self._obstacle)
            return
        command, activity = self._generator.decide(
            self._sap_flow, self._pose, self._goal, self._waypoint
        )
        given = self.parameters
        twist = to_twist(command, given.linear_speed, given.platform_radius)
        self._publish(twist, activity.value)

    def _publish(self, twist: Twist, state: str) -> None:
        if self.parameters.stamped:
            self.stamp(self._message)
            fill_twist(self._message.twist, twist)
        else:
            fill_twist(self._message, twist)
        self._command.publish(self._message)
        if state != self._told:
            self._told = state
            self._state.publish(String(data=state))

    def _publish_goal(self) -> None:
        message = PoseStamped()
        self.stamp(message)
        message.header.frame_id = self.parameters.map_frame
        fill_pose(message.pose, Pose(*self._goal, 0.0))
        self._goal_publisher.publish(message)


def main() -> None:
    """Run the node."""
    run(MotionGenerator)


if __name__ == '__main__':
    main()
