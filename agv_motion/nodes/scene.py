"""Node `scene`: the robot and all that it goes by, as markers in the map, for RViz and Foxglove."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from math import hypot, isfinite
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from nav_msgs.msg import Odometry, Path
from sensor_msgs.msg import Illuminance, JointState
from std_msgs.msg import String
from visualization_msgs.msg import Marker, MarkerArray

from agv_motion.model.footprint import corners_above
from agv_motion.model.scene_shapes import (
    SceneShape,
    ShapeKind,
    outline,
    ring,
    rotation_centre,
    shadow,
    sun_arrow,
    uncertainty,
    way,
    wheels,
)
from agv_motion.motion.navigation.zone_text import zone_of_text
from agv_motion.nodes.platform_parameters import STEERING, RobotPlatformParameters
from agv_motion.nodes.scene_marker import marker_of
from agv_motion.parameters import Spec, check
from agv_motion.planar import REST, Pose, Twist, require_finite
from agv_motion.ros.diagnosis import OK, WARN, Diagnosis
from agv_motion.ros.messages import points_of, pose_of, require_frame, twist_of
from agv_motion.ros.plain_node import PlainNode
from agv_motion.ros.qos import LATCHED, SENSOR
from agv_motion.ros.run import run
from agv_motion.sun import sun

if TYPE_CHECKING:
    from collections.abc import Iterator

    from agv_motion.model.transform import Vector
    from agv_motion.ros.port import Port

DIM = 0.25, 0.30, 0.40, 0.35
INK, EDGE, HOLE, SOFT, LEAF, SKY, GOAL, WAY, DUST = (
    (0.15, 0.15, 0.15, 1.0), (0.20, 0.35, 0.60, 1.0), (0.75, 0.20, 0.15, 1.0),
    (0.85, 0.60, 0.10, 1.0), (0.16, 0.45, 0.25, 1.0), (0.98, 0.80, 0.15, 1.0),
    (0.60, 0.20, 0.60, 1.0), (0.25, 0.55, 0.85, 1.0), (0.55, 0.55, 0.55, 0.8),
)  # fmt: skip
TRAIL_STEP, MOST_IN_TRAIL = 0.1, 2000
"""[m] between two places of the trail, and how many there are at most"""
MOST_POINTS = 2000
"""of a path"""
SHADE = 20_000.0
"""[lx] below which a robot by day stands in the shade"""


@dataclass(frozen=True)
class ShowParameters:
    """Namespaces of markers, each of which may be left out."""

    zone: Annotated[bool, Spec('the edge of the zone', dynamic=True)] = True
    margin: Annotated[bool, Spec('the edge of where its centre may go', dynamic=True)] = True
    holes: Annotated[bool, Spec('what is cut out of the zone', dynamic=True)] = True
    delicate: Annotated[bool, Spec('floor on which it may not turn', dynamic=True)] = True
    outline: Annotated[bool, Spec('the rim of the platform', dynamic=True)] = True
    turrets: Annotated[bool, Spec('wheels, and their speeds as arrows', dynamic=True)] = True
    icr: Annotated[bool, Spec('the centre of rotation', dynamic=True)] = True
    goal: Annotated[bool, Spec('the goal, and what the robot does, in words', dynamic=True)] = True
    path: Annotated[bool, Spec('the path to the goal', dynamic=True)] = True
    trail: Annotated[bool, Spec('where it was', dynamic=True)] = True
    sun: Annotated[bool, Spec('the sun, and whether it reaches the robot', dynamic=True)] = True
    shadow: Annotated[bool, Spec('its shadow on the floor, in the sun', dynamic=True)] = True
    uncertainty: Annotated[bool, Spec('the ellipse of two deviations', dynamic=True)] = True


@dataclass(frozen=True)
class SceneParameters(RobotPlatformParameters):
    """What is drawn, how often, and where the sun stands."""

    rate: Annotated[float, Spec('pictures per second at most, in real time', 'Hz', (0.1, 50))] = 5.0
    stale_after: Annotated[
        float, Spec('silence of an input after which its part is deleted', 's', (0.1, 3600.0))
    ] = 5.0
    map_frame: Annotated[str, Spec('frame of all markers')] = 'map'
    latitude: Annotated[float, Spec('of the place, north positive', 'deg', (-90, 90))] = 48.86
    longitude: Annotated[float, Spec('of the place, east positive', 'deg', (-180, 180))] = 2.35
    show: ShowParameters = field(default_factory=ShowParameters)

    def __post_init__(self) -> None:
        """Check every row."""
        check(self)


class _Heard(NamedTuple):
    at: float
    value: Any


class Scene(PlainNode[SceneParameters]):
    """`pose`, `odom`, `joint_states`, `zone`, `goal`, `path`, `state`, `sunlight` -> `scene`.

    Only the newest counts; what is not told any more, or left out, is deleted from the picture.
    """

    name = 'scene'
    takes = SceneParameters

    def __init__(self, port: Port, parameters: SceneParameters) -> None:
        """Open the topics."""
        super().__init__(port, parameters)
        self._model, self._radii = parameters.model(), parameters.radii()
        self._heard: dict[str, _Heard] = {}
        self._zone: list[SceneShape] = []
        self._trail: list[tuple[float, float]] = []
        self._shown: set[tuple[str, int]] = set()
        self._scene = port.publisher(MarkerArray, 'scene', LATCHED, sole=True)
        port.listen(PoseWithCovarianceStamped, 'pose', self._on_pose, SENSOR)
        port.need('pose')
        port.listen(Odometry, 'odom', self._on_odometry, SENSOR)
        port.listen(JointState, 'joint_states', self._on_joints, SENSOR)
        port.listen(Illuminance, 'sunlight', self._on_light, SENSOR)
        port.listen(String, 'zone', self._on_zone, LATCHED)
        port.listen(String, 'state', lambda m: self._note('state', m.data[:200]), LATCHED)
        port.listen(PoseStamped, 'goal', self._on_goal, LATCHED)
        port.listen(Path, 'path', self._on_path, LATCHED)
        port.every(1.0 / parameters.rate, self.draw, steady=True)

    @cached_property
    def _corners(self) -> list[Vector]:
        """What casts the shadow of the robot, seen from its base [m]."""
        return corners_above(self._model)

    def begin(self) -> None:
        """Know nothing of before."""
        self._heard.clear()
        self._trail.clear()

    def halt(self) -> None:
        """Take the picture away."""
        self._publish([])

    def diagnose(self) -> Diagnosis:
        """Tell whether there is a robot to be drawn."""
        if self._fresh('pose') is None:
            return Diagnosis(WARN, 'no pose: no robot in the picture', {})
        return Diagnosis(OK, 'drawing', {'markers': str(len(self._shown))})

    # What comes in

    def _note(self, name: str, value: Any) -> None:
        self._heard[name] = _Heard(self.port.steady_seconds(), value)

    def _fresh(self, name: str) -> Any:
        """Return what was heard last, if that is not long ago."""
        heard = self._heard.get(name)
        old = heard is None or (self.port.steady_seconds() - heard.at > self.parameters.stale_after)
        return None if old or heard is None else heard.value

    def _lasting(self, name: str) -> Any:
        heard = self._heard.get(name)
        return None if heard is None else heard.value

    def _on_pose(self, message: PoseWithCovarianceStamped) -> None:
        require_frame(message.header.frame_id, self.parameters.map_frame)
        pose, covariance = pose_of(message.pose.pose), message.pose.covariance
        self._note('pose', (pose, [float(covariance[i]) for i in (0, 1, 7)]))
        last = self._trail[-1] if self._trail else None
        if last is None or hypot(pose.x - last[0], pose.y - last[1]) >= TRAIL_STEP:
            self._trail.append((pose.x, pose.y))
            del self._trail[:-MOST_IN_TRAIL]

    def _on_odometry(self, message: Odometry) -> None:
        self._note('twist', twist_of(message.twist.twist))

    def _on_joints(self, message: JointState) -> None:
        told = []
        for values in (message.position, message.velocity):
            pairs = zip(message.name, values, strict=False)
            told.append({name: value for name, value in pairs if isfinite(value)})
        self._note('joints', tuple(told))

    def _on_light(self, message: Illuminance) -> None:
        require_finite('sunlight [lx]', (message.illuminance,))
        self._note('light', message.illuminance)

    def _on_goal(self, message: PoseStamped) -> None:
        require_frame(message.header.frame_id, self.parameters.map_frame)
        self._note('goal', pose_of(message.pose))

    def _on_path(self, message: Path) -> None:
        require_frame(message.header.frame_id, self.parameters.map_frame)
        self._note('path', points_of(message)[:MOST_POINTS])

    def _on_zone(self, message: String) -> None:
        zone = zone_of_text(message.data, self.parameters.rim())
        self._zone = [ring('zone', zone.boundary.exterior.coords[:-1], EDGE, 0.06)]
        self._zone += [ring('holes', hole.exterior.coords[:-1], HOLE, 0.06) for hole in zone.holes]
        self._zone += [ring('delicate', part.exterior.coords[:-1], SOFT)
                       for part in zone.translation_only]  # fmt: skip
        for part in zone.parts:
            for edge in (part.exterior, *part.interiors):
                self._zone.append(ring('margin', edge.coords[:-1], EDGE, 0.02))

    # What goes out

    def draw(self) -> None:
        """Tell the picture of now, where someone looks."""
        if self._scene.get_subscription_count():
            shown = [shape for shape in self._shapes() if shape.is_drawable]
            self._publish([s for s in shown if getattr(self.parameters.show, s.namespace)])

    def _shapes(self) -> Iterator[SceneShape]:
        yield from self._zone
        if len(self._trail) > 1:
            yield way('trail', self._trail, DUST, 0.03)
        if (path := self._lasting('path')) is not None:
            yield way('path', path, WAY, 0.05)
        if (goal := self._lasting('goal')) is not None:
            yield from self._goal_shapes(goal)
        told = self._fresh('pose')
        if told is not None:
            yield from self._robot_shapes(*told)

    def _goal_shapes(self, goal: Pose) -> Iterator[SceneShape]:
        arms = [(goal.x + d, goal.y + e) for d, e in ((0.2, 0), (-0.2, 0), (0, 0.2), (0, -0.2))]
        yield way('goal', arms, GOAL)._replace(kind=ShapeKind.PAIRS)
        if state := self._lasting('state'):
            words = ((goal.x, goal.y, 0.5),)
            yield SceneShape('goal', ShapeKind.TEXT, words, GOAL, 0.3, state)

    def _robot_shapes(self, pose: Pose, covariance: list[float]) -> Iterator[SceneShape]:
        yield from outline(pose, self.parameters.rim(), LEAF)
        xx, xy, yy = covariance
        yield from uncertainty(pose, xx, xy, yy, LEAF)
        places, speeds = self._wheels()
        yield from wheels(pose, places, speeds, max(self._radii), INK)
        twist: Twist = self._fresh('twist') or REST
        yield from rotation_centre(pose, twist, places, HOLE)
        light, given = self._fresh('light'), self.parameters
        if light is not None:
            words = f'{"in the sun" if light >= SHADE else "in the shade"}, {light:.0f} lx'
            direction = sun(self.port.seconds(), given.latitude, given.longitude)
            yield from sun_arrow(pose, direction.elevation, direction.azimuth, words, SKY)
            if light >= SHADE:
                yield from shadow(pose, self._corners, *direction, DIM)

    def _wheels(self) -> tuple[list[tuple[float, float, float]], list[float]]:
        """Return where each wheel stands [m, m, rad] in the robot, and its speed [m/s]."""
        nothing: dict[str, float] = {}
        positions, rates = self._fresh('joints') or (nothing, nothing)
        places, speeds = [], []
        holders = {joint.child: joint for joint in self._model.joints}
        rolling = [name for name in self._model.moving if not name.endswith(STEERING)]
        for name, radius in zip(rolling, self._radii, strict=True):
            joint = self._model.moving[name]
            turret = holders.get(joint.parent)
            if turret is None:
                places.append((*joint.place[:2], joint.angles[2]))
            else:
                places.append((*turret.place[:2], positions.get(turret.name, 0.0)))
            speeds.append(rates.get(name, 0.0) * radius)
        return places, speeds

    def _publish(self, shapes: list[SceneShape]) -> None:
        """Send the shapes, and delete those that were there before."""
        markers, numbers = [], dict.fromkeys((s.namespace for s in shapes), 0)
        for shape in shapes:
            marker = marker_of(shape, numbers[shape.namespace])
            self.port.stamp(marker)
            marker.header.frame_id = self.parameters.map_frame
            markers.append(marker)
            numbers[shape.namespace] += 1
        shown = {(marker.ns, marker.id) for marker in markers}
        for namespace, number in sorted(self._shown - shown):
            gone = Marker(ns=namespace, id=number, action=Marker.DELETE)
            self.port.stamp(gone)
            gone.header.frame_id = self.parameters.map_frame
            markers.append(gone)
        self._shown = shown
        self._scene.publish(MarkerArray(markers=markers))


def main() -> None:
    """Run the node."""
    run(Scene)


if __name__ == '__main__':
    main()
