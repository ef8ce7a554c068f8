"""Node `route_follower`: a route and the pose in, the twist that follows it out."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import isinf
from typing import TYPE_CHECKING, Annotated, Any

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from geometry_msgs.msg import PointStamped
from nav_msgs.msg import Path
from std_srvs.srv import SetBool, Trigger

from agv_motion.activity import Activity, Cause, Doing
from agv_motion.errors import SignalError
from agv_motion.nodes.driving import DrivingNode
from agv_motion.nodes.driving_parameters import DrivingParameters
from agv_motion.parameters import Spec
from agv_motion.planar import Pose
from agv_motion.ros.config import find_config
from agv_motion.ros.diagnosis import ERROR, OK, WARN, Diagnosis
from agv_motion.ros.messages import fill_path, points_of
from agv_motion.ros.qos import COMMAND, LATCHED, SENSOR
from agv_motion.ros.run import run
from agv_motion.route.follower import RouteFollower, RouteLimits
from agv_motion.route.parameters import FollowParameters
from agv_motion.route.route import Point, Route
from agv_motion.route.route_file import load_route
from agv_motion.twist_limits import TwistLimits

if TYPE_CHECKING:
    from agv_motion.ros.port import Port

IDLE = 'waiting for a route'


@dataclass(frozen=True)
class RouteFollowerParameters(DrivingParameters):
    """Where the route comes from, and how it is followed."""

    route_file: Annotated[
        str,
        Spec('CSV or YAML to follow from the start on; empty: wait for the topic', dynamic=True),
    ] = ''
    laps: Annotated[
        int,
        Spec('rounds where route_file does not say; 0: without end', '1', (0, 1e6), dynamic=True),
    ] = 1
    limits: TwistLimits = field(default_factory=TwistLimits)
    follow: FollowParameters = field(default_factory=FollowParameters)

    def __post_init__(self) -> None:
        """Check every row, and hand the track of the platform on."""
        super().__post_init__()
        object.__setattr__(self, 'limits', replace(self.limits, track=self.effective_track))


class RouteFollowerNode(DrivingNode[RouteFollowerParameters]):
    """`route` and `odom` -> `cmd_vel`, `route/virtual_point`, `route/limits`, `route/state`.

    Silence of `odom`, `~/pause`, `~/abort`, arrival and the end of the node are explicit zeros.
    """

    state_topic = 'route/state'
    release = 'call ~/pause with data: false, or send a route'

    name = 'route_follower'
    takes = RouteFollowerParameters

    def __init__(self, port: Port, parameters: RouteFollowerParameters) -> None:
        """Open the topics; load the route if there is a file."""
        super().__init__(port, parameters)
        self._follower: RouteFollower | None = None
        self._route: Route | None = None
        self._idle = Doing(IDLE, Activity.WAITING, Cause.NOTHING)
        """What it does without a route"""
        self._paused = False
        self._point = port.publisher(PointStamped, 'route/virtual_point', SENSOR)
        self._limits = port.publisher(DiagnosticStatus, 'route/limits', SENSOR)
        self._path = port.publisher(Path, 'route/path', LATCHED)
        port.listen(Path, 'route', self._on_route, COMMAND)
        port.serve(SetBool, '~/pause', self._on_pause)
        port.serve(Trigger, '~/abort', self._on_abort)
        port.serve(Trigger, '~/restart', self._on_restart)
        warning = parameters.follow.orbit()
        if warning:
            port.warning(warning)
        if parameters.route_file:
            self._route = _loaded(parameters)
            self._follower = RouteFollower(self._route, parameters.follow)

    def begin(self) -> None:
        """Show the route, if there is one already."""
        super().begin()
        if self._route is not None:
            self._show(self._route)

    def halt(self) -> None:
        """Leave the route, and send the last word: no motion."""
        if self._follower is not None:
            self._follower = None
            self._idle = self._idle._replace(
                state='left the route: ~/restart follows it from its start'
            )
        super().halt()

    def limits(self) -> TwistLimits:
        """Return those of the robot."""
        return self.parameters.limits

    def accept(self, parameters: RouteFollowerParameters) -> None:
        """Take over new tables, or the route of another file."""
        before = self.parameters
        if parameters.route_file and parameters.route_file != before.route_file:
            self._follow(_loaded(parameters), parameters.follow)
        elif self._follower is not None:
            self._follower.retune(parameters.follow)

    def diagnose(self) -> Diagnosis:
        """Tell what the robot does, and what is missing."""
        values = self.activity_values()
        if self.guard.reason:
            return Diagnosis(ERROR, self.guard.reason, values)
        waiting = self._follower is not None and bool(self.lost)
        return Diagnosis(WARN if waiting else OK, self.told or IDLE, values)

    def activity(self) -> tuple[Activity, Cause]:
        """Return what the robot does, for programs, and what that goes back to."""
        if self._follower is None:
            return self._idle.activity, self._idle.because
        if self._paused:
            return Activity.PAUSED, Cause.PERSON
        return self.hindered() if self.obstacle else (Activity.DRIVING, Cause.GOAL)

    def cycle(self, dt: float) -> None:
        """Command one step along the route, or none."""
        follower, pose = self._follower, self.pose_now()
        if follower is None:
            self.leave(dt)
            self.tell(self._idle.state)
        elif self._paused or pose is None or self.obstacle:
            follower.rest()
            self.stand()
            self.tell('paused' if self._paused else self.obstacle)
        else:
            self._step(follower, pose, dt)

    def _step(self, follower: RouteFollower, pose: Pose, dt: float) -> None:
        twist, point, limits, arrived = follower.step(pose, dt)
        self.drive(twist)
        self._publish(point, limits)
        if arrived:
            self._end('arrived', Activity.ARRIVED, Cause.GOAL)
        else:
            self.tell(_progress(follower))

    def _publish(self, point: Point, limits: RouteLimits) -> None:
        message = PointStamped()
        self.port.stamp(message)
        message.header.frame_id = self.parameters.frame
        message.point.x, message.point.y = point
        self._point.publish(message)
        if self._limits.get_subscription_count():
            pairs = {'limiter': limits.limiter.value} | {
                name: f'{value:.4f}'
                for name, value in limits._asdict().items()
                if name != 'limiter'
            }
            self._limits.publish(
                DiagnosticStatus(
                    name=f'{self.port.name}: what holds the speed down',
                    message=limits.limiter.value,
                    values=[KeyValue(key=key, value=value) for key, value in pairs.items()],
                )
            )

    def _end(self, how: str, activity: Activity, because: Cause) -> None:
        self._follower = None
        self._idle = Doing(how, activity, because)
        self.port.info(how)
        self.tell(how)

    def _follow(self, route: Route, parameters: FollowParameters) -> None:
        """Start on ``route``; in motion, without a jump of speed."""
        self.guard.release()
        old = self._follower
        speed, turn_rate = (old.speed, old.turn_rate) if old else (0.0, 0.0)
        self._follower = RouteFollower(route, parameters, speed, turn_rate)
        self._route = route
        self._show(route)

    def _show(self, route: Route) -> None:
        message = Path()
        self.port.stamp(message)
        message.header.frame_id = self.parameters.frame
        fill_path(message, [Pose(x, y, 0.0) for x, y in route.waypoints])
        self._path.publish(message)
        laps = 'without end' if isinf(route.length) else f'{route.length:.1f} m'
        self.port.info(f'route of {len(route.waypoints)} waypoints, {laps}')

    def _on_route(self, message: Path) -> None:
        """Follow what is published, once: who wants more rounds of it publishes them all."""
        self.require_frame_of_all(message)
        self._follow(Route(points_of(message)), self.parameters.follow)

    def _on_pause(self, request: Any) -> str:
        self._paused = request.data
        if self._paused and self._follower is not None:
            self.stand()
        if not self._paused:
            self.guard.release()
        return 'paused' if self._paused else 'going on'

    def _on_abort(self, _: Any) -> str:
        if self._follower is None:
            msg = 'no route is being followed'
            raise SignalError(msg)
        self.stand()
        self._end('aborted', Activity.STOPPED, Cause.PERSON)
        return 'stopped; ~/restart follows the same route from its start'

    def _on_restart(self, _: Any) -> str:
        if self._route is None:
            msg = f'there has been no route: publish one on {self.port.full_name("route")}'
            raise SignalError(msg)
        self._follow(self._route, self.parameters.follow)
        return 'from the start of the route'


def _loaded(parameters: RouteFollowerParameters) -> Route:
    return load_route(find_config(parameters.route_file), parameters.laps)


def _progress(follower: RouteFollower) -> str:
    """Return where on the route the virtual point is, in words."""
    route, each = follower.route, len(follower.route.segments)
    lap, segment = divmod(follower.segment, each)
    where = f'following: segment {segment + 1} of {each}'
    if route.laps == 1:
        return where
    return f'{where}, lap {lap + 1}' + (f' of {route.laps}' if route.laps else '')


def main() -> None:
    """Run the node."""
    run(RouteFollowerNode)


if __name__ == '__main__':
    main()
